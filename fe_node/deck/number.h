// Numbers as keyword decks write them.
//
// Reals may lack the exponent letter (1.0-3 is 1e-3), use D for E, start with + or a point, and end
// with one; integers may be written as reals (2. is 2). Whole text or nothing: trailing characters,
// hexadecimal, nan, inf and values out of range are refused. Blanks around the number are allowed.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

namespace crosswalk::fe {

std::optional<double> parse_real(std::string_view text);
std::optional<std::int32_t> parse_integer(std::string_view text);

/// The text without blanks and tabs at both ends.
std::string_view trimmed(std::string_view text);
std::string upper_case(std::string_view text);

/// The closest text of at most `width` characters that parse_real() reads back; beyond 1.7e308 that
/// of this number.
std::string format_real(double value, int width);

}  // namespace crosswalk::fe
