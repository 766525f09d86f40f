#include "fe_node/deck/parameters.h"

namespace crosswalk::fe {

const Parameter* Parameters::define_global(const std::string& name, Parameter parameter) {
  const auto [at, is_new] = globals_.try_emplace(name, std::move(parameter));
  return is_new ? nullptr : &at->second;
}

const Parameter* Parameters::define_local(const std::string& name, Parameter parameter) {
  const auto [at, is_new] = locals_.back().try_emplace(name, std::move(parameter));
  return is_new ? nullptr : &at->second;
}

const Parameter* Parameters::find(const std::string& name) const {
  for (auto scope = locals_.rbegin(); scope != locals_.rend(); ++scope)
    if (const auto at = scope->find(name); at != scope->end()) return &at->second;
  const auto at = globals_.find(name);
  return at == globals_.end() ? nullptr : &at->second;
}

std::vector<std::string> Parameters::names() const {
  std::vector<std::string> out;
  for (const auto& [name, parameter] : globals_) out.push_back(name);
  for (const auto& scope : locals_)
    for (const auto& [name, parameter] : scope) out.push_back(name);
  return out;
}

}  // namespace crosswalk::fe
