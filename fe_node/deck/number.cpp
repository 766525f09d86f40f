#include "fe_node/deck/number.h"

#include <array>
#include <cctype>
#include <charconv>
#include <cmath>
#include <limits>

namespace crosswalk::fe {

namespace {

bool is_digit(char c) { return c >= '0' && c <= '9'; }
bool is_sign(char c) { return c == '+' || c == '-'; }

/// Splits mantissa and exponent and writes them in the form std::from_chars reads; 0 when the text
/// is no number. Longer mantissas than the buffer are refused: no deck field is that wide.
constexpr std::size_t kMaxNumber = 80;

std::size_t normalise(std::string_view text, std::array<char, kMaxNumber>& out) {
  std::size_t n = 0, i = 0;
  if (text.size() + 2 > kMaxNumber) return 0;
  if (i < text.size() && is_sign(text[i])) {
    if (text[i] == '-') out[n++] = '-';
    ++i;
  }
  bool has_digit = false, has_point = false;
  for (; i < text.size() && (is_digit(text[i]) || (text[i] == '.' && !has_point)); ++i) {
    has_point = has_point || text[i] == '.';
    has_digit = has_digit || is_digit(text[i]);
    out[n++] = text[i];
  }
  if (!has_digit) return 0;
  if (i == text.size()) return n;
  const char letter = text[i];
  const bool has_letter = letter == 'e' || letter == 'E' || letter == 'd' || letter == 'D';
  if (has_letter) ++i;
  if (!has_letter && !is_sign(letter)) return 0;
  out[n++] = 'e';
  if (i < text.size() && is_sign(text[i])) {
    if (text[i] == '-') out[n++] = '-';
    ++i;
  }
  if (i == text.size()) return 0;
  for (; i < text.size(); ++i) {
    if (!is_digit(text[i])) return 0;
    out[n++] = text[i];
  }
  return n;
}

/// `value` with `digits` significant digits in exponent form, as short as a deck may write it.
std::string exponent_form(double value, int digits) {
  std::array<char, 40> buffer{};
  const auto end = std::to_chars(buffer.data(), buffer.data() + buffer.size(), value,
                                 std::chars_format::scientific, digits - 1);
  std::string text(buffer.data(), end.ptr);
  const std::size_t e = text.find('e');
  std::string mantissa = text.substr(0, e), exponent = text.substr(e + 1);
  if (mantissa.find('.') != std::string::npos) {
    while (mantissa.back() == '0') mantissa.pop_back();
  } else {
    mantissa += '.';
  }
  const bool is_negative = exponent[0] == '-';
  exponent.erase(0, 1);
  while (exponent.size() > 1 && exponent[0] == '0') exponent.erase(0, 1);
  return mantissa + (is_negative ? "E-" : "E+") + exponent;
}

std::string fixed_form(double value, int decimals) {
  std::array<char, 400> buffer{};
  const auto end = std::to_chars(buffer.data(), buffer.data() + buffer.size(), value,
                                 std::chars_format::fixed, decimals);
  std::string text(buffer.data(), end.ptr);
  if (text.find('.') == std::string::npos) return text + ".";
  while (text.back() == '0') text.pop_back();
  return text.back() == '.' ? text + "0" : text;
}

}  // namespace

std::string_view trimmed(std::string_view text) {
  const auto is_blank = [](char c) { return c == ' ' || c == '\t' || c == '\r'; };
  while (!text.empty() && is_blank(text.front())) text.remove_prefix(1);
  while (!text.empty() && is_blank(text.back())) text.remove_suffix(1);
  return text;
}

std::string upper_case(std::string_view text) {
  std::string out(text);
  for (char& c : out) c = static_cast<char>(std::toupper(static_cast<unsigned char>(c)));
  return out;
}

std::optional<double> parse_real(std::string_view text) {
  std::array<char, kMaxNumber> buffer{};
  const std::size_t size = normalise(trimmed(text), buffer);
  if (size == 0) return std::nullopt;
  double value = 0;
  const auto [end, error] = std::from_chars(buffer.data(), buffer.data() + size, value);
  if (end != buffer.data() + size) return std::nullopt;
  if (error == std::errc::result_out_of_range) {
    // An exponent below the smallest double is zero to every purpose; one above is not a number.
    const std::string_view written(buffer.data(), size);
    return written.find("e-") != std::string_view::npos ? std::optional<double>(0.0) : std::nullopt;
  }
  return error == std::errc() ? std::optional<double>(value) : std::nullopt;
}

std::optional<std::int32_t> parse_integer(std::string_view text) {
  text = trimmed(text);
  if (!text.empty() && text.front() == '+') text.remove_prefix(1);
  std::int32_t value = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  constexpr std::int32_t kLargest = std::numeric_limits<std::int32_t>::max();
  if (error == std::errc() && end == text.data() + text.size() && value >= -kLargest) return value;
  const std::optional<double> real = parse_real(text);
  if (!real || *real != std::trunc(*real) || std::abs(*real) > kLargest) return std::nullopt;
  return static_cast<std::int32_t>(*real);
}

std::string format_real(double value, int width) {
  if (value == 0) return "0.0";
  // Stands for all that no field holds, infinity and what is no number included.
  constexpr double kLargest = 1.7e308;
  if (!(std::abs(value) <= kLargest)) value = value < 0 ? -kLargest : kLargest;
  std::string best;
  double best_error = std::numeric_limits<double>::infinity();
  const auto offer = [&](const std::string& text) {
    if (text.size() > static_cast<std::size_t>(width)) return;
    const std::optional<double> read = parse_real(text);
    if (!read) return;
    const double error = std::abs(*read - value);
    if (error < best_error || (error == best_error && text.size() < best.size())) {
      best = text;
      best_error = error;
    }
  };
  const int magnitude = static_cast<int>(std::floor(std::log10(std::abs(value))));
  if (magnitude >= -4 && magnitude < width - 1)
    for (int decimals = 1; decimals <= width && best_error != 0; ++decimals)
      offer(fixed_form(value, decimals));
  if (best_error != 0)
    for (int digits = 1; digits <= 17 && best_error != 0; ++digits)
      offer(exponent_form(value, digits));
  return best;
}

}  // namespace crosswalk::fe
