#include "common/config.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include <fmt/format.h>

#include "common/config_impl.h"

namespace crosswalk {

namespace fs = std::filesystem;
using config::Entry;
using config::joined;
using config::Node;

namespace {

std::string with_suffix(std::string_view name, const Unit& unit) {
  return std::string(name) + "_" + std::string(unit.suffix);
}

std::string range_text(Range range, const Unit* unit) {
  const double factor = unit != nullptr ? unit->factor : 1.0;
  const double offset = unit != nullptr ? unit->offset : 0.0;
  const std::string symbol = unit != nullptr ? " " + std::string(unit->symbol) : "";
  const auto shown = [&](double si) { return fmt::format("{:.6g}", (si - offset) / factor); };
  if (range.min == kPositive.min && std::isinf(range.max)) return "a positive number";
  if (range.min == kPositive.min) return "above 0, up to " + shown(range.max) + symbol;
  if (std::isinf(range.min) && std::isinf(range.max)) return "a number";
  if (std::isinf(range.max)) return "at least " + shown(range.min) + symbol;
  if (std::isinf(range.min)) return "at most " + shown(range.max) + symbol;
  return shown(range.min) + " .. " + shown(range.max) + symbol;
}

}  // namespace

void ConfigTable::Impl::add(Problem problem, std::string missing) {
  if (document->is_reference) return;
  document->findings.push_back({std::move(problem), std::move(missing)});
}

void ConfigTable::Impl::wrong(const Found& found, std::string expected, std::string hint) {
  add({found.node->value_place, joined(path, found.key), std::move(expected),
       config::shown(*found.node), std::move(hint)});
}

void ConfigTable::Impl::missing(std::string_view name, std::string_view hint) {
  add({place, joined(path, name) + ": missing", {}, {}, std::string(hint)}, joined(path, name));
}

ConfigTable::Impl::Found ConfigTable::Impl::plain(std::string_view name) {
  document->asked[path].emplace_back(name);
  Node* found = node != nullptr ? node->find(name) : nullptr;
  if (found != nullptr) found->is_known = true;
  return {found, std::string(name), nullptr};
}

bool ConfigTable::Impl::report_foreign_unit(std::string_view name, Dimension dimension) {
  if (node == nullptr) return false;
  std::vector<std::string> written = {std::string(name)};
  for (int i = 1; i < kDimensionCount; ++i)
    for (const Unit& unit : units_of(static_cast<Dimension>(i)))
      written.push_back(with_suffix(name, unit));
  for (const std::string& key : written) {
    Node* found = node->find(key);
    if (found == nullptr || found->is_known) continue;
    found->is_known = true;
    const Unit& unit = units_of(dimension).front();
    add({found->key_place, joined(path, key),
         fmt::format("{} with its unit ({})", dimension_name(dimension), suffix_list(dimension)),
         fmt::format("`{}`", key), fmt::format("write for example `{}`", with_suffix(name, unit))});
    return true;
  }
  return false;
}

ConfigTable::Impl::Found ConfigTable::Impl::quantity(std::string_view name, Dimension dimension,
                                                     bool is_required, std::string_view example) {
  Found found;
  if (dimension == Dimension::None) {
    found = plain(name);
    if (found.node == nullptr && is_required)
      missing(name, fmt::format("expected a number, for example `{} = {}`", name, example));
    return found;
  }
  for (const Unit& unit : units_of(dimension)) {
    const std::string key = with_suffix(name, unit);
    document->asked[path].push_back(key);
    Node* candidate = node != nullptr ? node->find(key) : nullptr;
    if (candidate == nullptr) continue;
    candidate->is_known = true;
    if (found.node != nullptr) {
      add({candidate->key_place, joined(path, key), "one value",
           fmt::format("`{}` and `{}`", found.key, key), "keep one of the two"});
      continue;
    }
    found = {candidate, key, &unit};
  }
  if (found.node == nullptr && !report_foreign_unit(name, dimension) && is_required) {
    const Unit& unit = units_of(dimension).front();
    missing(name, fmt::format("expected {}, for example `{} = {}`", dimension_name(dimension),
                              with_suffix(name, unit), example));
  }
  return found;
}

bool ConfigTable::Impl::read_number(const Found& found, Range range, std::string_view name,
                                    Dimension dimension, double& value) {
  if (!found.node->is_number() || !std::isfinite(found.node->number())) {
    wrong(found, range_text(range, found.unit),
          found.node->kind == Node::Kind::Text ? "write the number without quotes" : "");
    return false;
  }
  const double written = found.node->number();
  value = found.unit != nullptr ? found.unit->factor * written + found.unit->offset : written;
  // Ranges are stated in decimal numbers; a rounding of the unit factor must not push the edge out.
  const auto is_inside = [&](double si) {
    const double slack = 1e-12 * std::abs(si);
    return si >= range.min - slack && si <= range.max + slack && !(range.min > 0 && si <= 0);
  };
  if (is_inside(value)) return true;
  std::string hint;
  for (const Unit& unit : units_of(dimension)) {
    if (found.unit == nullptr || &unit == found.unit || written == 0) continue;
    if (!is_inside(unit.factor * written + unit.offset)) continue;
    hint = fmt::format("is the value in {}? write `{}`", unit.symbol, with_suffix(name, unit));
    break;
  }
  wrong(found, range_text(range, found.unit), hint);
  return false;
}

namespace {

std::string unit_column(Dimension dimension) {
  return dimension == Dimension::None ? std::string("-") : suffix_list(dimension);
}

std::string range_column(Range range, Dimension dimension) {
  const auto units = units_of(dimension);
  return range_text(range, units.empty() ? nullptr : &units.front());
}

std::string quantity_default(double fallback, Dimension dimension) {
  if (std::isnan(fallback)) return "none";
  const auto units = units_of(dimension);
  return fmt::format("{:.6g}", fallback) +
         (units.empty() ? "" : " " + std::string(units.front().symbol));
}

}  // namespace

double ConfigTable::quantity(std::string_view name, Dimension dimension, Range range,
                             std::string_view doc) {
  impl_->document->document(joined(impl_->pattern, name), unit_column(dimension),
                            range_column(range, dimension), "required", doc);
  double value = std::numeric_limits<double>::quiet_NaN();
  const Impl::Found found = impl_->quantity(name, dimension, true, "1.0");
  if (found.node != nullptr) impl_->read_number(found, range, name, dimension, value);
  return value;
}

double ConfigTable::quantity_or(std::string_view name, Dimension dimension, Range range,
                                double fallback, std::string_view doc) {
  impl_->document->document(joined(impl_->pattern, name), unit_column(dimension),
                            range_column(range, dimension), quantity_default(fallback, dimension),
                            doc);
  const Impl::Found found = impl_->quantity(name, dimension, false, {});
  double value = fallback;
  if (found.node != nullptr && !impl_->read_number(found, range, name, dimension, value))
    return fallback;
  return value;
}

std::vector<double> ConfigTable::quantities(std::string_view name, Dimension dimension, int count,
                                            std::string_view doc) {
  const std::string expected =
      count > 0 ? fmt::format("{} numbers", count) : std::string("numbers");
  impl_->document->document(joined(impl_->pattern, name), unit_column(dimension), expected,
                            "required", doc);
  const Impl::Found found = impl_->quantity(name, dimension, true, "[0.0, 1.0]");
  std::vector<double> values;
  if (found.node != nullptr) {
    const auto& items = found.node->items;
    const bool is_right = found.node->kind == Node::Kind::Array &&
                          (count == 0 || static_cast<int>(items.size()) == count) &&
                          std::all_of(items.begin(), items.end(), [](const Node& item) {
                            return item.is_number() && std::isfinite(item.number());
                          });
    if (is_right) {
      for (const Node& item : items)
        values.push_back(found.unit == nullptr
                             ? item.number()
                             : found.unit->factor * item.number() + found.unit->offset);
      return values;
    }
    impl_->wrong(found, "an array of " + expected);
  }
  values.assign(static_cast<std::size_t>(count), 0.0);
  return values;
}

Curve ConfigTable::curve(std::string_view name, Dimension x, Dimension y, Curve::Outside outside,
                         std::string_view doc) {
  const std::string x_name = std::string(name) + "_x", y_name = std::string(name) + "_y";
  const std::vector<double> xs = quantities(x_name, x, 0, std::string(doc) + " (abscissae)");
  const std::vector<double> ys = quantities(y_name, y, 0, std::string(doc) + " (ordinates)");
  if (xs.empty() || ys.empty()) return Curve({0.0}, {0.0}, outside);
  try {
    return Curve(xs, ys, outside);
  } catch (const std::invalid_argument& error) {
    problem(x_name, "a curve", error.what());
    return Curve({0.0}, {0.0}, outside);
  }
}

int ConfigTable::integer_or(std::string_view name, int min, int max, int fallback,
                            std::string_view doc) {
  const std::string expected = fmt::format("an integer {} .. {}", min, max);
  impl_->document->document(joined(impl_->pattern, name), "-", expected,
                            fmt::format("{}", fallback), doc);
  const Impl::Found found = impl_->plain(name);
  if (found.node == nullptr) return fallback;
  if (found.node->kind == Node::Kind::Integer && found.node->integer >= min &&
      found.node->integer <= max)
    return static_cast<int>(found.node->integer);
  impl_->wrong(found, expected);
  return fallback;
}

bool ConfigTable::flag_or(std::string_view name, bool fallback, std::string_view doc) {
  impl_->document->document(joined(impl_->pattern, name), "-", "true or false",
                            fallback ? "true" : "false", doc);
  const Impl::Found found = impl_->plain(name);
  if (found.node == nullptr) return fallback;
  if (found.node->kind == Node::Kind::Flag) return found.node->flag;
  impl_->wrong(found, "true or false");
  return fallback;
}

std::string ConfigTable::text(std::string_view name, std::string_view doc) {
  impl_->document->document(joined(impl_->pattern, name), "-", "text", "required", doc);
  const Impl::Found found = impl_->plain(name);
  if (found.node == nullptr) {
    impl_->missing(name, fmt::format("expected text, for example `{} = \"...\"`", name));
    return {};
  }
  if (found.node->kind == Node::Kind::Text) return found.node->text;
  impl_->wrong(found, "text in quotes");
  return {};
}

std::string ConfigTable::text_or(std::string_view name, std::string_view fallback,
                                 std::string_view doc) {
  impl_->document->document(joined(impl_->pattern, name), "-", "text",
                            fallback.empty() ? "none" : fmt::format("\"{}\"", fallback), doc);
  const Impl::Found found = impl_->plain(name);
  if (found.node == nullptr) return std::string(fallback);
  if (found.node->kind == Node::Kind::Text) return found.node->text;
  impl_->wrong(found, "text in quotes");
  return std::string(fallback);
}

std::string ConfigTable::choice_or(std::string_view name, const std::vector<std::string>& options,
                                   std::string_view fallback, std::string_view doc) {
  std::string expected;
  for (std::size_t i = 0; i < options.size(); ++i)
    expected += (i == 0                    ? ""
                 : i + 1 == options.size() ? " or "
                                           : ", ") +
                fmt::format("\"{}\"", options[i]);
  impl_->document->document(joined(impl_->pattern, name), "-", expected,
                            fallback.empty() ? "none" : fmt::format("\"{}\"", fallback), doc);
  const Impl::Found found = impl_->plain(name);
  if (found.node == nullptr) return std::string(fallback);
  const bool is_text = found.node->kind == Node::Kind::Text;
  if (is_text && std::find(options.begin(), options.end(), found.node->text) != options.end())
    return found.node->text;
  const std::string near = is_text ? did_you_mean(found.node->text, options) : std::string();
  impl_->wrong(found, expected, near.empty() ? "" : fmt::format("did you mean `\"{}\"`?", near));
  return std::string(fallback);
}

fs::path ConfigTable::file(std::string_view name, std::string_view doc) {
  impl_->document->document(joined(impl_->pattern, name), "-", "a file", "required", doc);
  const Impl::Found found = impl_->plain(name);
  if (found.node == nullptr) {
    impl_->missing(name, fmt::format("expected a file, for example `{} = \"...\"`", name));
    return {};
  }
  if (found.node->kind != Node::Kind::Text) {
    impl_->wrong(found, "the path of a file, in quotes");
    return {};
  }
  const fs::path path = (*found.node->folder / found.node->text).lexically_normal();
  std::error_code ignored;
  if (!fs::is_regular_file(path, ignored)) {
    impl_->wrong(found, "an existing file",
                 fmt::format("there is no {}; paths are relative to the file that holds the key",
                             path.string()));
    return {};
  }
  return fs::canonical(path);
}

ConfigTable ConfigTable::table(std::string_view name, std::string_view doc) {
  const std::string pattern = joined(impl_->pattern, impl_->is_open_set ? "<name>" : name);
  impl_->document->document("[" + pattern + "]", "", "", "", doc);
  const Impl::Found found = impl_->plain(name);
  ConfigTable child;
  child.impl_ = std::make_shared<Impl>(Impl{.document = impl_->document,
                                            .node = found.node,
                                            .path = joined(impl_->path, name),
                                            .pattern = pattern,
                                            .place = impl_->place});
  if (found.node == nullptr) return child;
  child.impl_->place = found.node->key_place;
  if (found.node->kind != Node::Kind::Table) {
    impl_->wrong(found, fmt::format("a table, written `[{}]`", joined(impl_->path, name)));
    child.impl_->node = nullptr;
  }
  return child;
}

std::vector<ConfigTable> ConfigTable::tables(std::string_view name, std::string_view doc) {
  const std::string pattern = joined(impl_->pattern, name) + "[]";
  impl_->document->document("[[" + joined(impl_->pattern, name) + "]]", "", "", "", doc);
  const Impl::Found found = impl_->plain(name);
  std::vector<ConfigTable> children;
  if (impl_->document->is_reference) {
    children.emplace_back().impl_ = std::make_shared<Impl>(Impl{.document = impl_->document,
                                                                .node = nullptr,
                                                                .path = pattern,
                                                                .pattern = pattern,
                                                                .place = {}});
  }
  if (found.node == nullptr) return children;
  const bool is_empty_array = found.node->kind == Node::Kind::Array && found.node->items.empty();
  if (!found.node->is_table_array() && !is_empty_array) {
    impl_->wrong(found, fmt::format("tables, written `[[{}]]`", joined(impl_->path, name)));
    return children;
  }
  for (std::size_t i = 0; i < found.node->items.size(); ++i) {
    Node& item = found.node->items[i];
    item.is_known = true;
    ConfigTable child;
    child.impl_ =
        std::make_shared<Impl>(Impl{.document = impl_->document,
                                    .node = &item,
                                    .path = fmt::format("{}[{}]", joined(impl_->path, name), i),
                                    .pattern = pattern,
                                    .place = item.value_place});
    children.push_back(std::move(child));
  }
  return children;
}

std::vector<std::string> ConfigTable::table_names() const {
  impl_->is_open_set = true;
  std::vector<std::string> names;
  if (impl_->document->is_reference) names.emplace_back("<name>");
  if (impl_->node == nullptr) return names;
  for (const Entry& entry : impl_->node->entries)
    if (entry.node.kind == Node::Kind::Table) names.push_back(entry.key);
  return names;
}

bool ConfigTable::has(std::string_view name) const {
  if (impl_->node == nullptr) return false;
  if (impl_->node->find(name) != nullptr) return true;
  for (int i = 1; i < kDimensionCount; ++i)
    for (const Unit& unit : units_of(static_cast<Dimension>(i)))
      if (impl_->node->find(with_suffix(name, unit)) != nullptr) return true;
  return false;
}

Place ConfigTable::place(std::string_view key) const {
  if (impl_->node == nullptr || key.empty()) return impl_->place;
  if (const Node* node = impl_->node->find(key)) return node->value_place;
  for (int i = 1; i < kDimensionCount; ++i)
    for (const Unit& unit : units_of(static_cast<Dimension>(i)))
      if (const Node* node = impl_->node->find(with_suffix(key, unit))) return node->value_place;
  return impl_->place;
}

void ConfigTable::problem(std::string_view key, std::string expected, std::string found,
                          std::string hint) {
  impl_->add({place(key), key.empty() ? impl_->path : joined(impl_->path, key), std::move(expected),
              std::move(found), std::move(hint)});
}

}  // namespace crosswalk
