#include <algorithm>
#include <tuple>

#include <fmt/format.h>

#include "common/config_impl.h"

namespace crosswalk {

namespace fs = std::filesystem;
using config::Entry;
using config::Finding;
using config::joined;
using config::Node;

void ConfigDocument::Impl::document(const std::string& key, std::string unit, std::string range,
                                    std::string fallback, std::string_view doc) {
  if (!documented.insert(key).second) return;
  rows.push_back({key, std::move(unit), std::move(range), std::move(fallback), std::string(doc)});
}

ConfigDocument::ConfigDocument(std::shared_ptr<Impl> impl) : impl_(std::move(impl)) {}

ConfigDocument::ConfigDocument(const fs::path& path) : impl_(std::make_shared<Impl>()) {
  impl_->tree = config::read_file(path);
}

ConfigDocument ConfigDocument::from_text(std::string text, const std::string& name,
                                         const fs::path& folder) {
  auto impl = std::make_shared<Impl>();
  impl->tree = config::read_text(text, name, folder);
  return ConfigDocument(std::move(impl));
}

ConfigDocument ConfigDocument::for_reference() {
  auto impl = std::make_shared<Impl>();
  impl->is_reference = true;
  return ConfigDocument(std::move(impl));
}

ConfigDocument::~ConfigDocument() = default;
ConfigDocument::ConfigDocument(ConfigDocument&&) noexcept = default;
ConfigDocument& ConfigDocument::operator=(ConfigDocument&&) noexcept = default;

ConfigTable ConfigDocument::root() {
  ConfigTable table;
  impl_->tree.is_known = true;
  table.impl_ =
      std::make_shared<ConfigTable::Impl>(ConfigTable::Impl{.document = impl_,
                                                            .node = &impl_->tree,
                                                            .path = {},
                                                            .pattern = {},
                                                            .place = impl_->tree.value_place});
  return table;
}

void ConfigDocument::override_with(const std::string& toml_text, const std::string& name) {
  config::merge_over(impl_->tree, config::read_text(toml_text, name, fs::current_path()));
}

void ConfigDocument::ignore_tables(const std::vector<std::string>& names) {
  impl_->ignored.insert(names.begin(), names.end());
}

namespace {

struct Unknown {
  Problem problem;
  std::string suggestion;  // full path of the key it was probably meant to be
};

void find_unknown(const Node& node, const std::string& path,
                  const std::map<std::string, std::vector<std::string>>& asked,
                  const std::set<std::string>& ignored, std::vector<Unknown>& unknown) {
  const auto names = asked.find(path);
  for (const Entry& entry : node.entries) {
    const std::string full = joined(path, entry.key);
    if (path.empty() && ignored.contains(entry.key)) continue;
    if (entry.node.is_known) {
      if (entry.node.kind == Node::Kind::Table)
        find_unknown(entry.node, full, asked, ignored, unknown);
      for (std::size_t i = 0; i < entry.node.items.size(); ++i)
        find_unknown(entry.node.items[i], fmt::format("{}[{}]", full, i), asked, ignored, unknown);
      continue;
    }
    std::vector<std::string> candidates;
    if (names != asked.end()) candidates = names->second;
    if (path.empty()) candidates.insert(candidates.end(), ignored.begin(), ignored.end());
    const std::string near = did_you_mean(entry.key, candidates);
    unknown.push_back({{entry.node.key_place,
                        full + ": unknown key",
                        {},
                        {},
                        near.empty() ? "" : fmt::format("did you mean `{}`?", near)},
                       near.empty() ? "" : joined(path, near)});
  }
}

/// True when `suggestion` is the key `missing`, in any unit.
bool cures(const std::string& suggestion, const std::string& missing) {
  return suggestion == missing || suggestion.starts_with(missing + "_");
}

}  // namespace

void ConfigDocument::finish() {
  std::vector<Unknown> unknown;
  find_unknown(impl_->tree, {}, impl_->asked, impl_->ignored, unknown);
  std::vector<Problem> problems;
  for (const Finding& finding : impl_->findings) {
    const bool is_misspelt = !finding.missing.empty() &&
                             std::any_of(unknown.begin(), unknown.end(), [&](const Unknown& u) {
                               return cures(u.suggestion, finding.missing);
                             });
    if (!is_misspelt) problems.push_back(finding.problem);
  }
  for (Unknown& u : unknown) problems.push_back(std::move(u.problem));
  std::stable_sort(problems.begin(), problems.end(), [](const Problem& a, const Problem& b) {
    return std::tie(a.place.file, a.place.line, a.place.column) <
           std::tie(b.place.file, b.place.line, b.place.column);
  });
  Diagnostics diagnostics;  // throws by itself at its limit
  for (Problem& problem : problems) diagnostics.add(std::move(problem));
  diagnostics.finish();
}

std::string ConfigDocument::resolved_text() const {
  return config::write(impl_->tree, config::Writing::WithOrigins);
}

std::uint64_t ConfigDocument::digest() const {
  std::uint64_t hash = 0xcbf29ce484222325u;  // FNV-1a, 64 bit
  for (const char c : config::write(impl_->tree, config::Writing::Canonical)) {
    hash ^= static_cast<unsigned char>(c);
    hash *= 0x100000001b3u;
  }
  return hash;
}

std::string ConfigDocument::key_reference() const {
  std::string out = "| key | unit | range | default | meaning |\n|---|---|---|---|---|\n";
  for (const Impl::Row& row : impl_->rows)
    out += fmt::format("| `{}` | {} | {} | {} | {} |\n", row.key, row.unit, row.range, row.fallback,
                       row.doc);
  return out;
}

}  // namespace crosswalk
