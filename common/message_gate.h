// The last gate in front of a solver: a message with a non-finite or absurd number is named, never
// used.
#pragma once

#include <optional>
#include <string>

#include "common/messages.h"

namespace crosswalk {

/// Empty when every number is finite and believable (|position| < 1e4 m, speed < 500 m/s, rotation
/// < 1e4 rad/s, force < 1e7 N, impulse < 1e4 N s, counts within bounds); else field, index and
/// value.
std::optional<std::string> problem_in(const msg::step_to_mb& m);
std::optional<std::string> problem_in(const msg::mb_done& m);
std::optional<std::string> problem_in(const msg::step_to_fe& m);
std::optional<std::string> problem_in(const msg::fe_done& m);
std::optional<std::string> problem_in(const msg::mobility& m);
std::optional<std::string> problem_in(const msg::boundary_motion& m);
std::optional<std::string> problem_in(const msg::boundary_mass& m);

}  // namespace crosswalk
