// Copyright Isotach contributors. SPDX-License-Identifier: BSD-3-Clause
// Reads and checks the PROPS array of the UMAT.
#include "umat/properties.hpp"

#include <fmt/format.h>

#include <cmath>
#include <optional>
#include <string_view>

namespace isotach::umat {

namespace {

constexpr double kMostSubsteps = 1e9;

std::string refusal(Property property, std::string_view name, double value, std::string_view accepted) {
  return fmt::format("PROPS({}), {}, is {}; accepted: {}", static_cast<std::size_t>(property) + 1, name,
                     value, accepted);
}

std::optional<std::string> check(std::span<const double> props) {
  const auto at = [&](Property property) { return props[static_cast<std::size_t>(property)]; };
  using P = Property;
  // each condition is written so that NaN fails it
  if (const double v = at(P::lode_dependence); !(v == 0.0 || v == 1.0)) {
    return refusal(P::lode_dependence, "Lode dependence", v, "1 (Matsuoka-Nakai) or 0 (none)");
  }
  if (const double v = at(P::relative_tolerance); !(v >= 0.0 && v < 1.0)) {
    return refusal(P::relative_tolerance, "relative tolerance", v, "0 (default) or above, below 1");
  }
  if (const double v = at(P::absolute_stress_tolerance); !(v >= 0.0 && std::isfinite(v))) {
    return refusal(P::absolute_stress_tolerance, "absolute stress tolerance (Pa)", v, "0 or above, finite");
  }
  if (const double v = at(P::max_substeps); !(v >= 0.0 && v <= kMostSubsteps && v == std::floor(v))) {
    return refusal(P::max_substeps, "limit of substeps", v, "a whole number from 0 (default) to 1e9");
  }
  if (const double v = at(P::stress_unit); !(v > 0.0 && std::isfinite(v))) {
    return refusal(P::stress_unit, "stress unit (Pa)", v, "above 0, finite");
  }
  if (const double v = at(P::time_unit); !(v > 0.0 && std::isfinite(v))) {
    return refusal(P::time_unit, "time unit (s)", v, "above 0, finite");
  }
  if (const double v = at(P::initial_void_ratio); !(v >= 0.0 && std::isfinite(v))) {
    return refusal(P::initial_void_ratio, "initial void ratio", v, "0 (not given) or above, finite");
  }
  if (const double v = at(P::initial_ocr); !(v >= 0.0 && std::isfinite(v))) {
    return refusal(P::initial_ocr, "initial OCR", v, "0 (not given) or above, finite");
  }
  if (at(P::initial_void_ratio) > 0.0 && at(P::initial_ocr) > 0.0) {
    return refusal(P::initial_ocr, "initial OCR", at(P::initial_ocr),
                   "0 where PROPS(16), the initial void ratio, is given: one follows from the other");
  }
  return std::nullopt;
}

}  // namespace

tl::expected<Properties, std::string> read_properties(std::span<const double> props) {
  if (props.size() != kPropertyCount) {
    return tl::unexpected(
        fmt::format("NPROPS is {}; accepted: {}, see docs/umat.md", props.size(), kPropertyCount));
  }
  if (auto error = check(props)) return tl::unexpected(std::move(*error));
  const auto at = [&](Property property) { return props[static_cast<std::size_t>(property)]; };

  model::ParameterValues<double> values;
  for (const model::ParameterInfo& parameter : model::kParameterTable) {
    values[parameter.id] = props[static_cast<std::size_t>(parameter.id)] * parameter.to_si;
  }
  values.lode = at(Property::lode_dependence) == 1.0 ? model::LodeDependence::matsuoka_nakai
                                                     : model::LodeDependence::none;
  auto parameters = model::Parameters<double>::create(values);
  if (!parameters) {
    const auto& error = parameters.error();
    return tl::unexpected(
        fmt::format("PROPS({}): {}", static_cast<std::size_t>(error.id) + 1, error.message()));
  }
  integrators::Tolerance tolerance;
  if (const double relative = at(Property::relative_tolerance); relative > 0.0) tolerance.relative = relative;
  tolerance.absolute_stress = at(Property::absolute_stress_tolerance);
  const long max_substeps = static_cast<long>(at(Property::max_substeps));
  tolerance.max_substeps = max_substeps > 0 ? max_substeps : kDefaultMaxSubsteps;
  return Properties{*parameters,
                    tolerance,
                    at(Property::stress_unit),
                    at(Property::time_unit),
                    at(Property::initial_void_ratio),
                    at(Property::initial_ocr)};
}

}  // namespace isotach::umat
