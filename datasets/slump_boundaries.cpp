// Copyright Isotach contributors. SPDX-License-Identifier: BSD-3-Clause
// The sections of a slump test that say what the mud meets: mould and base.
#include <fmt/format.h>

#include <array>

#include "datasets/study_sections.hpp"
#include "mpm/slump.hpp"

namespace isotach::datasets {
namespace {

constexpr Range kLength_mm = Range::positive(10000.0);
constexpr Range kDistance_mm{0.0, 10000.0};
constexpr Range kShear_kPa{0.0, 1000.0};
constexpr Range kFriction{0.0, 10.0};
constexpr Range kSlumpTime_s{0.0, 1e7};
constexpr Range kYoung_kPa = Range::positive(1e9);
constexpr Range kPoisson{0.0, 0.45};

mpm::Wall read_wall(TomlTable& mould, Assumptions& assumptions) {
  if (mould.is_table("wall")) {
    TomlTable table = mould.table("wall");
    mpm::Wall wall;
    wall.adhesion = 1e3 * table.number_if("adhesion_kPa", kShear_kPa).value_or(0.0);
    wall.friction = table.number_if("friction", kFriction).value_or(0.0);
    table.reject_unknown_keys();
    return wall;
  }
  constexpr std::array<std::string_view, 2> kWalls{"smooth", "rough"};
  const auto wall = mould.choice_if("wall", kWalls);
  if (!wall) assumptions.add("wall of the mould not given, smooth assumed");
  return wall.value_or(0) == 0 ? mpm::Wall::smooth() : mpm::Wall::rough();
}

/// A motion as it was filmed: heights of the rim at times.
std::vector<mpm::RimPlace> read_lift_table(TomlTable& mould) {
  constexpr std::string_view kTimes = "lift_times_s";
  constexpr std::string_view kHeights = "lift_heights_mm";
  const auto times = mould.numbers_if(kTimes, kSlumpTime_s, "two or more increasing times");
  const auto heights = mould.numbers_if(kHeights, kDistance_mm, "as many heights, none below the one before");
  if (!times && !heights) return {};
  if (!times || !heights) {
    throw mould.error(times ? kHeights : kTimes, "it is missing",
                      fmt::format("{} and {} together", kTimes, kHeights));
  }
  if (times->size() < 2)
    throw mould.error(kTimes, "it has fewer than two times", "two or more increasing times");
  if (heights->size() != times->size()) {
    throw mould.error(kHeights, fmt::format("{} heights for {} times", heights->size(), times->size()),
                      "one height for each time");
  }
  std::vector<mpm::RimPlace> table;
  for (std::size_t i = 0; i < times->size(); ++i) {
    if (i > 0 && !((*times)[i] > (*times)[i - 1])) {
      throw mould.error(kTimes, fmt::format("{} follows {}", (*times)[i], (*times)[i - 1]),
                        "increasing times");
    }
    if (i > 0 && (*heights)[i] < (*heights)[i - 1]) {
      throw mould.error(kHeights, fmt::format("{} follows {}", (*heights)[i], (*heights)[i - 1]),
                        "heights that do not decrease");
    }
    table.push_back({(*times)[i], 1e-3 * (*heights)[i]});
  }
  return table;
}

mpm::ElasticSlab read_slab(TomlTable& base, Assumptions& assumptions) {
  mpm::ElasticSlab slab;
  const auto given = [&](std::string_view key, const Range& accepted, double unit, double& value) {
    if (const auto number = base.number_if(key, accepted)) {
      value = unit * *number;
    } else {
      assumptions.add(fmt::format("{} of the elastic base not given, {:.6g} assumed", key, value / unit));
    }
  };
  given("thickness_mm", kLength_mm, 1e-3, slab.thickness);
  given("length_mm", kLength_mm, 1e-3, slab.length);
  given("youngs_modulus_kPa", kYoung_kPa, 1e3, slab.youngs_modulus);
  given("poissons_ratio", kPoisson, 1.0, slab.poissons_ratio);
  return slab;
}

}  // namespace

mpm::Mould read_mould(TomlTable mould, Assumptions& assumptions) {
  mpm::Mould result;
  result.diameter = 1e-3 * mould.number("diameter_mm", kLength_mm);
  result.fill_height = 1e-3 * mould.number("fill_height_mm", kLength_mm);
  result.lift_table = read_lift_table(mould);
  const Range speed = Range::positive(10.0);
  if (result.lift_table.empty()) {
    result.lift_speed = mould.number("lift_speed_m_per_s", speed);
  } else if (mould.has("lift_speed_m_per_s")) {
    throw mould.error("lift_speed_m_per_s", "given beside lift_times_s and lift_heights_mm",
                      "a speed or a table, not both");
  } else {
    const mpm::RimPlace& first = result.lift_table.front();
    const mpm::RimPlace& last = result.lift_table.back();
    result.lift_speed = (last.height - first.height) / (last.time - first.time);  // the mean, for reports
  }
  result.lift_delay = mould.number_if("lift_delay_s", kSlumpTime_s).value_or(0.0);
  result.wall = read_wall(mould, assumptions);
  mould.reject_unknown_keys();
  return result;
}

mpm::Base read_base(TomlTable& parent, Assumptions& assumptions) {
  auto base = parent.table_if("base");
  if (!base) {
    assumptions.add("base not given, rough assumed");
    return {};
  }
  constexpr std::array<std::string_view, 4> kKinds{"rough", "limited", "navier", "elastic"};
  const auto kind = base->choice_if("kind", kKinds);
  if (!kind) assumptions.add("base not given, rough assumed");
  mpm::Base result;
  if (kind == std::size_t{1}) {
    result.friction.adhesion = 1e3 * base->number("shear_limit_kPa", kShear_kPa);
    result.friction.friction = base->number_if("friction", kFriction).value_or(0.0);
  } else if (kind == std::size_t{2}) {
    result.friction.slip_length = 1e-3 * base->number("slip_length_mm", kDistance_mm);
  } else if (kind == std::size_t{3}) {
    result.slab = read_slab(*base, assumptions);
  }
  base->reject_unknown_keys();
  return result;
}

void check_slab(TomlTable& parent, const model::Parameters<double>& material, const mpm::SlumpSetup& setup) {
  if (!setup.base.slab) return;
  const mpm::ElasticSlab& slab = *setup.base.slab;
  TomlTable base = parent.table("base");
  const double radius = 0.5 * setup.mould.diameter;
  if (slab.length <= radius) {
    throw base.error("length_mm", fmt::format("{:.6g} is out of range", 1e3 * slab.length),
                     fmt::format("more than the mould's radius, {:.6g}", 1e3 * radius));
  }
  const double settlement = slab.settlement(mpm::fill_pressure(material, setup));
  const double limit = mpm::kLargestSettlement * setup.numerics.cell_size;
  if (settlement <= limit) return;
  throw base.error("youngs_modulus_kPa",
                   fmt::format("{:.6g}, with which the fill settles by {:.3g} mm,",
                               1e-3 * slab.youngs_modulus, 1e3 * settlement),
                   fmt::format("about {:.3g} or more, with which it settles by a twentieth of a cell",
                               1e-3 * slab.youngs_modulus * settlement / limit));
}

}  // namespace isotach::datasets
