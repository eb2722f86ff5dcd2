// Copyright Isotach contributors. SPDX-License-Identifier: BSD-3-Clause
// Choice of ranges and of round numbers for ticks.
#include "reports/axis_scale.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace isotach::reports {
namespace {

constexpr double kPadding = 0.04;  // of the range, on each side that the caller left open
constexpr double kLargest = 1e300;
constexpr double kRounding = 1e-9;  // a bound that is a tick but for rounding has its tick

/// mantissa×10^exponent as a tick label: plain from 0.001 to 99999, else with a power of ten.
std::string power_label(int mantissa, int exponent) {
  if (exponent >= -3 && exponent <= 4) return fmt::format("{:g}", mantissa * std::pow(10.0, exponent));
  const std::string sign = exponent < 0 ? "−" : "";
  return fmt::format("{}10^{{{}{}}}", mantissa == 1 ? "" : fmt::format("{}×", mantissa), sign,
                     std::abs(exponent));
}

/// The multiple of 10^exponent with the decimals given as a tick label.
std::string multiple_label(double value, int exponent, int decimals) {
  if (value == 0.0) return "0";
  std::string text = fmt::format("{:.{}f}", std::abs(value) * std::pow(10.0, -exponent), decimals);
  if (value < 0.0) text.insert(0, "−");
  if (exponent != 0) text += fmt::format("×10^{{{}{}}}", exponent < 0 ? "−" : "", std::abs(exponent));
  return text;
}

}  // namespace

bool can_show(const Axis& axis, double value) {
  return std::abs(value) <= kLargest && (!axis.logarithmic || value >= 1.0 / kLargest);
}

AxisScale::AxisScale(const Axis& axis, const std::vector<double>& values) : logarithmic_(axis.logarithmic) {
  double low = std::numeric_limits<double>::infinity();
  double high = -low;
  for (const double value : values) {
    if (!can_show(axis, value)) continue;
    low = std::min(low, value);
    high = std::max(high, value);
  }
  if (low > high) {
    low = logarithmic_ ? 1.0 : 0.0;
    high = logarithmic_ ? 10.0 : 1.0;
  }
  min_ = axis.min.value_or(axis.max ? std::min(low, *axis.max) : low);
  max_ = axis.max.value_or(std::max(high, min_));
  if (!(transformed(max_) - transformed(min_) > 1e-12 * std::abs(transformed(max_)))) {  // one value only
    const double half = logarithmic_ ? std::log(2.0) : (max_ == 0.0 ? 1.0 : 0.1 * std::abs(max_));
    if (!axis.min) min_ = logarithmic_ ? min_ * std::exp(-half) : min_ - half;
    if (!axis.max) max_ = logarithmic_ ? max_ * std::exp(half) : max_ + half;
  }
  const double span = transformed(max_) - transformed(min_);
  const auto moved = [&](double value, double by) {
    if (logarithmic_) return value * std::exp(by);
    return value == 0.0 ? value : value + by;
  };
  if (!axis.min) min_ = moved(min_, -kPadding * span);
  if (!axis.max) max_ = moved(max_, kPadding * span);
}

double AxisScale::transformed(double value) const {
  return logarithmic_ ? std::log(value) : value;
}

double AxisScale::position(double value) const {
  return (transformed(value) - transformed(min_)) / (transformed(max_) - transformed(min_));
}

std::vector<Tick> AxisScale::ticks(int labels) const {
  // Below half a decade the round numbers of a logarithmic axis are too few, and a linear choice reads well.
  const bool wide = logarithmic_ && std::log10(max_ / min_) > 0.5;
  return wide ? logarithmic_ticks(labels) : linear_ticks(labels);
}

std::vector<Tick> AxisScale::linear_ticks(int labels) const {
  const double least_step = (max_ - min_) / labels;
  int exponent = static_cast<int>(std::floor(std::log10(least_step)));
  const double leading = least_step / std::pow(10.0, exponent);
  double mantissa = leading <= 1.0 + kRounding ? 1.0 : leading <= 2.0 + kRounding ? 2.0 : 5.0;
  if (leading > 5.0 + kRounding) {
    mantissa = 1.0;
    ++exponent;
  }
  const double step = mantissa * std::pow(10.0, exponent);
  const int magnitude = static_cast<int>(std::floor(std::log10(std::max(std::abs(min_), std::abs(max_)))));
  const bool plain = magnitude >= -3 && magnitude <= 5;
  const int shown_exponent = plain ? 0 : magnitude;
  const int decimals = std::clamp(shown_exponent - exponent, 0, 15);

  std::vector<Tick> ticks;
  const double last = std::floor(max_ / step + kRounding);
  for (double i = std::ceil(min_ / step - kRounding); i <= last; ++i) {
    const double value = std::clamp(i * step, min_, max_);
    ticks.push_back({value, multiple_label(i == 0.0 ? 0.0 : i * step, shown_exponent, decimals)});
  }
  return ticks;
}

std::vector<Tick> AxisScale::logarithmic_ticks(int labels) const {
  const double decades = std::log10(max_ / min_);
  const int every =
      std::max(1, static_cast<int>(std::ceil(decades / labels)));  // decades from label to label
  const int per_decade = 3.0 * decades > labels ? 1 : 3;           // labels: 1; or 1, 2 and 5
  std::vector<Tick> ticks;
  const int last = static_cast<int>(std::floor(std::log10(max_)));
  for (int exponent = static_cast<int>(std::floor(std::log10(min_))); exponent <= last; ++exponent) {
    for (int mantissa = 1; mantissa <= (every == 1 ? 9 : 1); ++mantissa) {
      const double value = mantissa * std::pow(10.0, exponent);
      if (value < min_ * (1.0 - 1e-12) || value > max_ * (1.0 + 1e-12)) continue;
      const bool labelled =
          mantissa == 1 ? exponent % every == 0 : per_decade == 3 && (mantissa == 2 || mantissa == 5);
      ticks.push_back({value, labelled ? power_label(mantissa, exponent) : ""});
    }
  }
  return ticks;
}

}  // namespace isotach::reports
