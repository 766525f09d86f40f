#include "common/config_tree.h"

#include <algorithm>
#include <cmath>
#include <fstream>
#include <sstream>

#include <fmt/format.h>
#include <toml++/toml.h>

#include "common/units.h"

namespace crosswalk::config {

namespace fs = std::filesystem;

Node* Node::find(std::string_view key) {
  for (Entry& entry : entries)
    if (entry.key == key) return &entry.node;
  return nullptr;
}

const Node* Node::find(std::string_view key) const { return const_cast<Node*>(this)->find(key); }

bool Node::is_table_array() const {
  return kind == Kind::Array && !items.empty() &&
         std::all_of(items.begin(), items.end(),
                     [](const Node& n) { return n.kind == Kind::Table; });
}

namespace {

struct Source {
  std::string name;
  std::shared_ptr<const fs::path> folder;
  std::vector<fs::path> chain;  // files being read, outermost first
};

Place place_of(const toml::source_region& region, const Source& source) {
  return {source.name, static_cast<int>(region.begin.line), static_cast<int>(region.begin.column)};
}

Node converted(const toml::node& in, const Source& source);

std::vector<Entry> entries_of(const toml::table& table, const Source& source) {
  std::vector<Entry> entries;
  for (const auto& [key, value] : table) {
    Entry entry{std::string(key.str()), converted(value, source)};
    if (entry.node.kind != Node::Kind::Table)  // a table stands at its header's bracket
      entry.node.key_place = place_of(key.source(), source);
    entries.push_back(std::move(entry));
  }
  // toml++ sorts by name; the reader thinks in the order of the file.
  std::stable_sort(entries.begin(), entries.end(), [](const Entry& a, const Entry& b) {
    return std::pair(a.node.key_place.line, a.node.key_place.column) <
           std::pair(b.node.key_place.line, b.node.key_place.column);
  });
  return entries;
}

Node converted(const toml::node& in, const Source& source) {
  Node out;
  out.folder = source.folder;
  out.value_place = place_of(in.source(), source);
  out.key_place = out.value_place;
  if (const auto* table = in.as_table()) {
    out.kind = Node::Kind::Table;
    out.entries = entries_of(*table, source);
  } else if (const auto* array = in.as_array()) {
    out.kind = Node::Kind::Array;
    for (const toml::node& item : *array) out.items.push_back(converted(item, source));
  } else if (const auto* text = in.as_string()) {
    out.kind = Node::Kind::Text;
    out.text = text->get();
  } else if (const auto* integer = in.as_integer()) {
    out.kind = Node::Kind::Integer;
    out.integer = integer->get();
  } else if (const auto* real = in.as_floating_point()) {
    out.kind = Node::Kind::Real;
    out.real = real->get();
  } else if (const auto* flag = in.as_boolean()) {
    out.kind = Node::Kind::Flag;
    out.flag = flag->get();
  } else {
    out.kind = Node::Kind::Date;
    std::ostringstream stream;
    in.visit([&](const auto& value) {
      if constexpr (toml::is_date<decltype(value)> || toml::is_time<decltype(value)> ||
                    toml::is_date_time<decltype(value)>)
        stream << value.get();
    });
    out.text = stream.str();
  }
  return out;
}

Node read_file_in_chain(const fs::path& path, std::vector<fs::path> chain);

/// Resolves `base` in this table and below, children first.
void resolve_bases(Node& node, const std::vector<fs::path>& chain) {
  for (Node& item : node.items) resolve_bases(item, chain);
  for (Entry& entry : node.entries) resolve_bases(entry.node, chain);
  if (node.kind != Node::Kind::Table) return;
  const auto found = std::find_if(node.entries.begin(), node.entries.end(),
                                  [](const Entry& entry) { return entry.key == "base"; });
  if (found == node.entries.end()) return;
  const Node base = std::move(found->node);
  node.entries.erase(found);
  if (base.kind != Node::Kind::Text)
    throw UserError(Problem{base.value_place, "base", "the name of a TOML file", shown(base), {}});
  const fs::path path = (*base.folder / base.text).lexically_normal();
  if (!fs::is_regular_file(path))
    throw UserError(Problem{base.value_place, "base", "an existing file",
                            fmt::format("\"{}\"", base.text),
                            fmt::format("there is no {}", path.string())});
  const fs::path canonical = fs::canonical(path);
  if (std::find(chain.begin(), chain.end(), canonical) != chain.end()) {
    std::string loop;
    for (const fs::path& link : chain) loop += link.filename().string() + " -> ";
    throw UserError(Problem{base.value_place,
                            "base",
                            "a chain of files without a loop",
                            loop + canonical.filename().string(),
                            {}});
  }
  Node merged = read_file_in_chain(path, chain);
  merged.key_place = node.key_place;
  merged.value_place = node.value_place;
  merge_over(merged, std::move(node));
  node = std::move(merged);
}

Node parsed(const std::string& text, const Source& source) {
  try {
    const toml::table table = toml::parse(std::string_view(text), std::string_view(source.name));
    Node root = converted(table, source);
    root.key_place = root.value_place = {source.name, 1, 1};
    resolve_bases(root, source.chain);
    return root;
  } catch (const toml::parse_error& error) {
    std::string what(error.description());
    const std::string opening = "Error while parsing ";
    if (what.starts_with(opening)) what = "in " + what.substr(opening.size());
    throw UserError(Problem{place_of(error.source(), source), "syntax error " + what, {}, {}, {}});
  }
}

/// As the user would type it: relative to the current folder when the file is inside it.
std::string display_name(const fs::path& path) {
  const fs::path near = fs::proximate(path);
  return near.empty() || *near.begin() == ".." ? path.string() : near.string();
}

Node read_file_in_chain(const fs::path& path, std::vector<fs::path> chain) {
  std::ifstream file(path, std::ios::binary);
  std::ostringstream text;
  if (!file || fs::is_directory(path) || !(text << file.rdbuf()))
    throw UserError(Problem{Place{path.string()}, "file", "a readable TOML file", "none", {}});
  chain.push_back(fs::canonical(path));
  const fs::path parent = path.has_parent_path() ? path.parent_path() : fs::path(".");
  return parsed(text.str(), {display_name(path), std::make_shared<const fs::path>(parent), chain});
}

/// True when both keys write the same quantity in different units: "mass_kg" and "mass_g".
bool is_same_quantity(const std::string& a, const std::string& b) {
  if (a == b) return true;
  for (int i = 1; i < kDimensionCount; ++i)
    for (const Unit& unit : units_of(static_cast<Dimension>(i))) {
      const std::string ending = "_" + std::string(unit.suffix);
      if (!a.ends_with(ending)) continue;
      const std::string stem = a.substr(0, a.size() - ending.size());
      for (const Unit& other : units_of(static_cast<Dimension>(i)))
        if (b == stem + "_" + std::string(other.suffix)) return true;
    }
  return false;
}

std::string quoted(const std::string& text) {
  std::string out = "\"";
  for (const char c : text) {
    if (c == '"' || c == '\\')
      out += fmt::format("\\{}", c);
    else if (static_cast<unsigned char>(c) < 0x20 || c == 0x7f)
      out += fmt::format("\\u{:04X}", static_cast<unsigned>(static_cast<unsigned char>(c)));
    else
      out += c;
  }
  return out + "\"";
}

std::string key_text(const std::string& key) {
  const bool is_bare = !key.empty() && std::all_of(key.begin(), key.end(), [](unsigned char c) {
    return std::isalnum(c) != 0 || c == '_' || c == '-';
  });
  return is_bare ? key : quoted(key);
}

std::string real_text(double value) {
  if (std::isnan(value)) return "nan";
  if (std::isinf(value)) return value > 0 ? "inf" : "-inf";
  std::string text = fmt::format("{}", value);
  if (text.find_first_of(".e") == std::string::npos) text += ".0";
  return text;
}

std::string value_text(const Node& node, Writing writing) {
  switch (node.kind) {
    case Node::Kind::Text:
      if (writing == Writing::WithOrigins && node.text.find('.') != std::string::npos) {
        const fs::path path = *node.folder / node.text;
        std::error_code ignored;
        if (fs::is_regular_file(path, ignored)) return quoted(fs::canonical(path).string());
      }
      return quoted(node.text);
    case Node::Kind::Integer:
      return fmt::format("{}", node.integer);
    case Node::Kind::Real:
      return real_text(node.real);
    case Node::Kind::Flag:
      return node.flag ? "true" : "false";
    case Node::Kind::Date:
      return node.text;
    case Node::Kind::Array: {
      std::string out = "[";
      for (const Node& item : node.items)
        out += (out.size() > 1 ? ", " : "") + value_text(item, writing);
      return out + "]";
    }
    case Node::Kind::Table: {
      std::string out = "{";
      for (const Entry& entry : node.entries)
        out += (out.size() > 1 ? ", " : " ") + key_text(entry.key) + " = " +
               value_text(entry.node, writing);
      return out + " }";
    }
  }
  return {};
}

void write_table(const Node& table, const std::string& path, Writing writing, std::string& out) {
  for (const Entry& entry : table.entries) {
    if (entry.node.kind == Node::Kind::Table || entry.node.is_table_array()) continue;
    out += key_text(entry.key) + " = " + value_text(entry.node, writing);
    if (writing == Writing::WithOrigins) out += "  # " + entry.node.value_place.text();
    out += '\n';
  }
  for (const Entry& entry : table.entries) {
    const std::string name = path.empty() ? key_text(entry.key) : path + "." + key_text(entry.key);
    if (entry.node.kind == Node::Kind::Table) {
      out += "\n[" + name + "]\n";
      write_table(entry.node, name, writing, out);
    } else if (entry.node.is_table_array()) {
      for (const Node& item : entry.node.items) {
        out += "\n[[" + name + "]]\n";
        write_table(item, name, writing, out);
      }
    }
  }
}

}  // namespace

Node read_file(const fs::path& path) { return read_file_in_chain(path.lexically_normal(), {}); }

Node read_text(const std::string& text, const std::string& name, const fs::path& folder) {
  return parsed(text, {name, std::make_shared<const fs::path>(folder), {}});
}

void merge_over(Node& under, Node over) {
  const std::size_t under_count = under.entries.size();
  std::vector<bool> is_replaced(under_count, false);
  for (Entry& entry : over.entries) {
    Node* same = under.find(entry.key);
    if (same != nullptr && same->kind == Node::Kind::Table &&
        entry.node.kind == Node::Kind::Table) {
      same->key_place = entry.node.key_place;
      same->value_place = entry.node.value_place;
      merge_over(*same, std::move(entry.node));
      continue;
    }
    std::size_t i = 0;
    while (i < under_count &&
           (is_replaced[i] || !is_same_quantity(under.entries[i].key, entry.key)))
      ++i;
    if (i < under_count) {
      under.entries[i] = std::move(entry);
      is_replaced[i] = true;
    } else {
      under.entries.push_back(std::move(entry));  // a unit written twice is reported by its getter
    }
  }
}

std::string write(const Node& root, Writing writing) {
  std::string out;
  write_table(root, {}, writing, out);
  return out;
}

std::string shown(const Node& node) {
  if (node.kind == Node::Kind::Table) return "a table";
  std::string text = value_text(node, Writing::Canonical);
  if (text.size() > 60) text = text.substr(0, 57) + "...";
  return text;
}

}  // namespace crosswalk::config
