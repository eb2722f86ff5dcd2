// Copyright Isotach contributors. SPDX-License-Identifier: BSD-3-Clause
// Rounding to significant digits and the typography of numbers.
#include "reports/number.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <string_view>

namespace isotach::reports {
namespace {

constexpr int kLeastFixedExponent = -3;    // 0.001 is still fixed
constexpr int kGreatestFixedExponent = 5;  // and so is 999999
constexpr double kLongestDuration = 1e9;   // s; beyond 30 years nobody wants minutes

/// Decimal exponent of |value| once rounded to the digits given: 9.996 has 1 at three digits.
int rounded_exponent(double value, int digits) {
  const std::string text = fmt::format("{:.{}e}", std::abs(value), digits - 1);
  return std::stoi(text.substr(text.find('e') + 1));
}

/// The number with this many decimals, rounded to tens, hundreds, ... where the count is negative.
std::string fixed(double value, int decimals) {
  if (decimals < 0) {
    const double unit = std::pow(10.0, -decimals);
    value = std::round(value / unit) * unit;
  }
  std::string text = fmt::format("{:.{}f}", std::abs(value), std::max(decimals, 0));
  const bool zero = text.find_first_not_of("0.") == std::string::npos;
  return std::signbit(value) && !zero ? "−" + text : text;
}

/// "×10⁻⁷"
std::string power_of_ten(int exponent) {
  static constexpr std::string_view kSuperscript[] = {"⁰", "¹", "²", "³", "⁴", "⁵", "⁶", "⁷", "⁸", "⁹"};
  std::string text = "×10";
  if (exponent < 0) text += "⁻";
  for (const char digit : fmt::format("{}", std::abs(exponent))) text += kSuperscript[digit - '0'];
  return text;
}

bool is_fixed(int exponent) {
  return exponent >= kLeastFixedExponent && exponent <= kGreatestFixedExponent;
}

/// value/10^exponent, exact enough for 17 digits also where 10^exponent is no longer a normal number.
double mantissa(double value, int exponent) {
  const int half = exponent / 2;
  return value / std::pow(10.0, half) / std::pow(10.0, exponent - half);
}

}  // namespace

std::string format_number(double value, int significant_digits) {
  if (!std::isfinite(value)) return kMissing;
  if (value == 0.0) return "0";
  const int digits = std::clamp(significant_digits, 1, 17);
  const int exponent = rounded_exponent(value, digits);
  if (is_fixed(exponent)) return fixed(value, digits - 1 - exponent);
  return fixed(mantissa(value, exponent), digits - 1) + power_of_ten(exponent);
}

std::string format_with_error(double value, double standard_error) {
  if (!std::isfinite(value)) return kMissing;
  if (!std::isfinite(standard_error) || standard_error <= 0.0) return format_number(value);
  const int error_exponent = rounded_exponent(standard_error, 2);
  const int last_digit = error_exponent - 1;  // the exponent of the last digit shown of both
  // The larger of the two sets the notation, so that an error beyond its value is not hidden in a power of
  // ten.
  int exponent = error_exponent;
  if (value != 0.0) exponent = std::max(exponent, rounded_exponent(value, 17));
  if (is_fixed(exponent)) {
    return fmt::format("{} ± {}", fixed(value, -last_digit), fixed(standard_error, -last_digit));
  }
  const int decimals = exponent - last_digit;
  return fmt::format("({} ± {}){}", fixed(mantissa(value, exponent), decimals),
                     fixed(mantissa(standard_error, exponent), decimals), power_of_ten(exponent));
}

std::string format_duration(double seconds) {
  if (!std::isfinite(seconds) || seconds < 0.0) return kMissing;
  if (seconds < 10.0) return fmt::format("{:.{}f} s", seconds, seconds < 1.0 ? 2 : 1);
  if (seconds > kLongestDuration) return format_number(seconds, 3) + " s";
  const long whole = std::lround(seconds);
  if (whole < 60) return fmt::format("{} s", whole);
  if (whole < 3600) return fmt::format("{} min {:02} s", whole / 60, whole % 60);
  return fmt::format("{} h {:02} min", whole / 3600, whole % 3600 / 60);
}

}  // namespace isotach::reports
