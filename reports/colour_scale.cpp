// Copyright Isotach contributors. SPDX-License-Identifier: BSD-3-Clause
#include "reports/colour_scale.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

namespace isotach::reports {
namespace {

constexpr std::array<Rgb, 18> kViridis{{{68, 1, 84},
                                        {72, 23, 105},
                                        {71, 42, 122},
                                        {67, 61, 132},
                                        {61, 78, 138},
                                        {53, 94, 141},
                                        {46, 109, 142},
                                        {41, 123, 142},
                                        {35, 137, 142},
                                        {31, 151, 139},
                                        {33, 165, 133},
                                        {46, 179, 124},
                                        {70, 192, 111},
                                        {101, 203, 94},
                                        {137, 213, 72},
                                        {176, 221, 47},
                                        {216, 226, 25},
                                        {253, 231, 37}}};

constexpr double kLeastDecades = 2.0;
constexpr double kMostDecades = 6.0;
constexpr double kLinearSteps = 5.0;  // about as many round steps between the limits

/// The value below which a part of the values lies; there is one at least.
double quantile(std::vector<float>& values, double part) {
  const auto place = static_cast<std::ptrdiff_t>(std::lround(part * static_cast<double>(values.size() - 1)));
  std::nth_element(values.begin(), values.begin() + place, values.end());
  return static_cast<double>(values[static_cast<std::size_t>(place)]);
}

template <class Keep>
void keep_only(std::vector<float>& values, Keep&& keep) {
  values.erase(std::remove_if(values.begin(), values.end(), [&](float v) { return !keep(v); }), values.end());
}

/// 1, 2 or 5 times a power of ten, at least `least`.
double round_step(double least) {
  const double power = std::pow(10.0, std::floor(std::log10(least)));
  for (const double mantissa : {1.0, 2.0, 5.0}) {
    if (least <= mantissa * power * (1.0 + 1e-9)) return mantissa * power;
  }
  return 10.0 * power;
}

}  // namespace

Rgb viridis(double position) {
  const double place = std::clamp(position, 0.0, 1.0) * static_cast<double>(kViridis.size() - 1);
  const std::size_t below = std::min(static_cast<std::size_t>(place), kViridis.size() - 2);
  const double part = place - static_cast<double>(below);
  const auto mixed = [&](std::uint8_t Rgb::*component) {
    const double a = kViridis[below].*component;
    const double b = kViridis[below + 1].*component;
    return static_cast<std::uint8_t>(std::lround(a + part * (b - a)));
  };
  return {mixed(&Rgb::red), mixed(&Rgb::green), mixed(&Rgb::blue)};
}

std::string hex(const Rgb& colour) {
  return fmt::format("#{:02x}{:02x}{:02x}", colour.red, colour.green, colour.blue);
}

ColourScale::ColourScale(Axis axis) : axis_(std::move(axis)), scale_(axis_, {}) {}

std::uint8_t ColourScale::level(double value) const {
  if (std::isnan(value)) return 0;
  if (axis_.logarithmic && value <= 0.0) return 1;
  const double place = std::floor(scale_.position(value) * kLevels);
  return static_cast<std::uint8_t>(1.0 + std::clamp(place, 0.0, kLevels - 1.0));
}

std::span<const Rgb> ColourScale::palette() {
  static const std::vector<Rgb> colours = [] {
    std::vector<Rgb> result;
    for (int level = 0; level < kLevels; ++level) {
      result.push_back(viridis(static_cast<double>(level) / (kLevels - 1)));
    }
    return result;
  }();
  return colours;
}

Axis logarithmic_limits(std::string label, std::vector<float> values) {
  keep_only(values, [](float v) { return v > 0.0F && std::isfinite(v); });
  if (values.empty()) values.push_back(1.0F);
  const double top = std::ceil(std::log10(quantile(values, 0.999)) - 1e-6);
  const double bottom = std::floor(std::log10(quantile(values, 0.02)) + 1e-6);
  return {.label = std::move(label),
          .logarithmic = true,
          .min = std::pow(10.0, std::clamp(bottom, top - kMostDecades, top - kLeastDecades)),
          .max = std::pow(10.0, top)};
}

Axis linear_limits(std::string label, std::vector<float> values) {
  keep_only(values, [](float v) { return std::isfinite(v); });
  if (values.empty()) values = {0.0F, 1.0F};
  const double low = quantile(values, 0.01);
  const double high = quantile(values, 0.95);
  // equal values, but for round-off, still have limits
  const double least = std::max(1e-3 * std::max(std::abs(low), std::abs(high)), 1e-30);
  const double step = round_step(std::max(high - low, least) / kLinearSteps);
  const double bottom = step * std::floor(low / step + 1e-6);
  return {.label = std::move(label),
          .min = bottom,
          .max = std::max(step * std::ceil(high / step - 1e-6), bottom + step)};
}

}  // namespace isotach::reports
