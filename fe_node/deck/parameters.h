// Values of *PARAMETER names, with the scope of *PARAMETER_LOCAL.
//
// Names are case-insensitive. A global holds from its definition on, in all files; a local holds in
// its file and in those included from it. The first definition of a name wins.
#pragma once

#include <map>
#include <optional>
#include <string>
#include <vector>

#include "fe_node/deck/deck_id.h"

namespace crosswalk::fe {

struct Parameter {
  enum class Kind { Real, Integer, Text };
  Kind kind = Kind::Real;
  double value = 0;
  std::string text;
  Source source;
};

class Parameters {
 public:
  Parameters() : locals_(1) {}
  void enter_file() { locals_.emplace_back(); }
  void leave_file() { locals_.pop_back(); }
  /// The earlier definition when there is one: it stays.
  const Parameter* define_global(const std::string& name, Parameter parameter);
  const Parameter* define_local(const std::string& name, Parameter parameter);
  /// `name` in upper case, without &.
  const Parameter* find(const std::string& name) const;
  std::vector<std::string> names() const;

 private:
  std::map<std::string, Parameter> globals_;
  std::vector<std::map<std::string, Parameter>> locals_;
};

}  // namespace crosswalk::fe
