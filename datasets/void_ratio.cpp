// Copyright Isotach contributors. SPDX-License-Identifier: BSD-3-Clause
// The initial void ratio of a specimen: implementation.
#include "datasets/void_ratio.hpp"

#include <fmt/format.h>

#include <array>
#include <numbers>
#include <string_view>

namespace isotach::datasets {
namespace {

constexpr std::string_view kOneOf = "one of void_ratio, water_content and dry_mass_g";
/// Above this water content (-) a soil is organic as a rule, and no specific gravity may be taken silently.
constexpr double kOrganicWaterContent = 1.5;

double specific_gravity_of(const TomlTable& test, const VoidRatioKeys& keys, const SpecimenData& specimen,
                           const std::optional<double>& water_content, Assumptions& assumptions) {
  if (keys.specific_gravity) return *keys.specific_gravity;
  if (!keys.soil && specimen.specific_gravity) return *specimen.specific_gravity;
  if (!keys.soil && water_content && *water_content > kOrganicWaterContent) {
    throw test.error("specific_gravity",
                     fmt::format("it is missing, and at a water content of {:.6g} the soil may be organic",
                                 *water_content),
                     "specific_gravity, or soil = \"mineral\" | \"peat\" to have 2.65 or 1.5 assumed");
  }
  const bool peat = keys.soil == Soil::peat;
  const double assumed = peat ? kAssumedPeatGravity : kAssumedSpecificGravity;
  assumptions.add(fmt::format("specific gravity not given, {} assumed{}", assumed, peat ? " (peat)" : ""));
  return assumed;
}

/// The value, unless it is none that a soil has.
VoidRatio checked(const TomlTable& test, std::string_view key, VoidRatio void_ratio) {
  if (kVoidRatio.contains(void_ratio.value)) return void_ratio;
  throw test.error(key, fmt::format("{} means a void ratio of {:.4g}", void_ratio.source, void_ratio.value),
                   fmt::format("a void ratio {}", kVoidRatio.words()));
}

VoidRatio from_bulk_density(const TomlTable& test, double water_content, double density, double gravity,
                            Assumptions& assumptions) {
  const double per_gravity = (1.0 + water_content) * kWaterDensity / density;
  VoidRatio result =
      checked(test, "bulk_density_g_per_cm3",
              {per_gravity * gravity - 1.0,
               fmt::format("water content {:.6g}, bulk density {:.6g} g/cm3 and specific gravity {:.6g}",
                           water_content, 1e-3 * density, gravity),
               per_gravity});
  const double saturation = water_content * gravity / result.value;
  result.source += fmt::format(", degree of saturation {:.3f}", saturation);
  if (!kOrdinarySaturation.contains(saturation)) {
    assumptions.add(fmt::format(
        "water content, bulk density and specific gravity mean a degree of saturation of {:.3f}, outside "
        "{} to {}: one of them may be off; the void ratio {:.4g} is taken as it follows from them",
        saturation, kOrdinarySaturation.lower, kOrdinarySaturation.upper, result.value));
  }
  return result;
}

VoidRatio from_dry_mass(const TomlTable& test, double dry_mass, double gravity,
                        const SpecimenData& specimen) {
  const auto require = [&](const std::optional<double>& length, std::string_view key) {
    if (length) return *length;
    throw test.error(key, "it is missing", "a length > 0, as the void ratio follows from a volume");
  };
  const double diameter = require(specimen.diameter, "diameter_mm");
  const double volume = 0.25 * std::numbers::pi * diameter * diameter * require(specimen.height, "height_mm");
  const double per_gravity = kWaterDensity * volume / dry_mass;
  return checked(test, "dry_mass_g",
                 {per_gravity * gravity - 1.0,
                  fmt::format("dry mass {:.6g} g in {:.6g} cm3, specific gravity {:.6g}", 1e3 * dry_mass,
                              1e6 * volume, gravity),
                  per_gravity});
}

}  // namespace

VoidRatioKeys read_void_ratio_keys(TomlTable& test) {
  VoidRatioKeys keys;
  keys.void_ratio = test.number_if("void_ratio", kVoidRatio);
  keys.water_content = test.number_if("water_content", Range::positive(40.0));
  if (const auto density = test.number_if("bulk_density_g_per_cm3", {0.5, 5.0})) {
    keys.bulk_density = 1e3 * *density;
  }
  if (const auto mass = test.number_if("dry_mass_g", Range::positive(1e6))) keys.dry_mass = 1e-3 * *mass;
  keys.specific_gravity = test.number_if("specific_gravity", kSpecificGravity);
  constexpr std::array<std::string_view, 2> kSoils{"mineral", "peat"};
  if (const auto soil = test.choice_if("soil", kSoils)) {
    keys.soil = *soil == 0 ? Soil::mineral : Soil::peat;
  }
  const int count =
      int{keys.void_ratio.has_value()} + int{keys.water_content.has_value()} + int{keys.dry_mass.has_value()};
  if (count > 1) {
    throw test.error(keys.water_content ? "water_content" : "dry_mass_g", "the void ratio is stated twice",
                     kOneOf);
  }
  if (keys.bulk_density && (keys.void_ratio || keys.dry_mass)) {
    throw test.error("bulk_density_g_per_cm3", "given together with void_ratio or dry_mass_g",
                     "a bulk density together with a water content");
  }
  return keys;
}

VoidRatio work_out_void_ratio(const TomlTable& test, const VoidRatioKeys& keys, const SpecimenData& specimen,
                              Assumptions& assumptions) {
  if (keys.void_ratio) return {*keys.void_ratio, "given", std::nullopt};
  const auto gravity = [&](const std::optional<double>& water_content) {
    return specific_gravity_of(test, keys, specimen, water_content, assumptions);
  };
  if (keys.dry_mass) return from_dry_mass(test, *keys.dry_mass, gravity(std::nullopt), specimen);

  const bool own = keys.water_content.has_value();
  if (!own && specimen.void_ratio) return {*specimen.void_ratio, "given by the data file", std::nullopt};
  const auto water_content = own ? keys.water_content : specimen.water_content;
  if (!water_content) {
    throw test.error(keys.bulk_density ? "water_content" : "void_ratio", "it is missing", kOneOf);
  }
  const auto density = keys.bulk_density || own ? keys.bulk_density : specimen.bulk_density;
  VoidRatio result{};
  if (density) {
    result = from_bulk_density(test, *water_content, *density, gravity(water_content), assumptions);
  } else {
    const double specific_gravity = gravity(water_content);
    result = checked(test, "water_content",
                     {*water_content * specific_gravity,
                      fmt::format("water content {:.6g} times specific gravity {:.6g}, saturated",
                                  *water_content, specific_gravity),
                      *water_content});
  }
  if (!own) result.source += " (water content of the data file)";
  return result;
}

}  // namespace isotach::datasets
