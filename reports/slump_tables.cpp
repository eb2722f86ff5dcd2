// Copyright Isotach contributors. SPDX-License-Identifier: BSD-3-Clause
// Tables and figures of simulated slumps.
#include "reports/slump_tables.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "reports/number.hpp"
#include "reports/slump_json.hpp"
#include "reports/units.hpp"

namespace isotach::reports {
namespace {

constexpr double kPercent = 100.0;

std::string percent(double ratio) {
  return format_number(kPercent * ratio, 2);
}

/// A count of point updates as a share of all.
std::string share_of_updates(long count, const mpm::SlumpResult& result) {
  if (count == 0) return "0";
  return fmt::format("{} %", percent(static_cast<double>(count) / result.particle_steps));
}

}  // namespace

std::string time_label(double seconds) {
  return fmt::format("{:.4g} s", seconds);
}

Table start_table(std::span<const NamedRun> runs) {
  using enum Alignment;
  Table table{.caption = "Moulds and the state the mud starts from.",
              .header = {"Run", "Mould D (mm)", "Fill h (mm)", "h/D", "Lift (m/s)", "Wall", "e0", "ρ (kg/m³)",
                         "p_B0 (kPa)", "p′ (kPa)", "C_u (kPa)"},
              .alignment = {left, right, right, right, right, left, right, right, right, right, right}};
  for (const NamedRun& run : runs) {
    const mpm::Mould& mould = run.setup.mould;
    const mpm::InitialState& initial = run.result->initial;
    table.rows.push_back({run.name, format_number(kMillimetres * mould.diameter, 3),
                          format_number(kMillimetres * mould.fill_height, 3),
                          format_number(mould.fill_height / mould.diameter, 3),
                          format_number(mould.lift_speed, 2), words_of(mould.wall),
                          format_number(initial.void_ratio), format_number(initial.density),
                          format_number(1e-3 * initial.preconsolidation_pressure, 3),
                          format_number(1e-3 * initial.mean_effective_pressure, 3),
                          format_number(1e-3 * initial.undrained_strength, 3)});
  }
  const auto rate_of = [](const NamedRun& run) { return run.result->initial.strength_rate; };
  const bool one_rate = std::all_of(runs.begin(), runs.end(),
                                    [&](const auto& r) { return rate_of(r) == rate_of(runs.front()); });
  std::string rate = "the |D| of its column";
  if (one_rate) {
    rate = fmt::format("|D| = {} 1/s", format_number(runs.empty() ? 0.0 : rate_of(runs.front()), 3));
  } else {
    table.header.emplace_back("|D| (1/s)");
    table.alignment.push_back(right);
    for (std::size_t k = 0; k < runs.size(); ++k) {
      table.rows[k].push_back(format_number(rate_of(runs[k]), 2));
    }
  }
  table.notes = {fmt::format(
      "C_u is the undrained strength at the critical state at {}; p_B0 the preconsolidation pressure, p′ the "
      "isotropic effective pressure of the start.",
      rate)};
  return table;
}

Table budget_table(std::span<const NamedRun> runs) {
  using enum Alignment;
  Table table{.caption = "Budgets of volume and energy.",
              .header = {"Run", "Volume (%)", "Outline volume (%)", "Energy (%)", "Points", "Steps",
                         "Substepped", "Floored", "Inertia factor"},
              .alignment = {left, right, right, right, right, right, right, right, right}};
  for (const NamedRun& run : runs) {
    const mpm::SlumpResult& result = *run.result;
    table.rows.push_back({run.name, percent(result.volume_error), percent(result.outline_volume_error),
                          percent(result.energy_error), fmt::format("{}", result.points),
                          fmt::format("{}", result.steps), share_of_updates(result.substepped, result),
                          share_of_updates(result.floored, result),
                          format_number(largest_inertia_scaling(result), 3)});
  }
  table.notes = {
      "The errors are the largest of the run. Volume: of the material points; outline volume: inside the "
      "traced "
      "outlines, against the first. Energy: |E_kin + E_pot + stress work + boundary work − E_0| over the "
      "potential "
      "energy at the start.",
      "Substepped: point updates whose stress needed substeps. Floored: point updates that left the domain "
      "of the law "
      "and were set to its least pressure, as where the skeleton has lost contact. Inertia factor: the "
      "largest used."};
  return table;
}

std::string numerics_text(const NamedRun& run) {
  const mpm::Numerics& numerics = run.setup.numerics;
  return fmt::format(
      "Axisymmetric material point method, explicit, undrained: cells of {} mm ({} mm asked for; they divide "
      "the "
      "mould's radius), {} points a cell at the start, bulk modulus of the water {} kPa, a "
      "viscosity of {} Pa s beside the law, stress update to a relative tolerance of {}, time step "
      "{} of "
      "the critical one. While the flow is quasi-static, inertia may be scaled up to a factor of {}.{}",
      format_number(kMillimetres * run.result->cell_size, 3),
      format_number(kMillimetres * numerics.cell_size, 3), numerics.points_per_cell,
      format_number(1e-3 * numerics.water_bulk_modulus, 3), format_number(numerics.background_viscosity, 2),
      format_number(numerics.tolerance, 2), format_number(numerics.courant, 2),
      format_number(numerics.inertia_scaling, 3),
      numerics.scheme == mpm::Scheme::plain
          ? " Plain scheme, for comparison with other codes: it loses energy, "
            "and mud stays above its base by a part of a cell."
          : "");
}

Series outline_series(const mpm::Outline& outline, std::string label) {
  Series series;
  series.label = std::move(label);
  for (const mpm::OutlinePoint& point : outline.points) {
    series.x.push_back(kMillimetres * point.r);
    series.y.push_back(kMillimetres * point.z);
  }
  return series;
}

Figure meridian_figure() {
  Figure figure;
  figure.x = {.label = "r (mm)", .min = 0.0};
  figure.y = {.label = "z (mm)", .min = 0.0};
  figure.equal_aspect = true;
  return figure;
}

std::vector<std::size_t> spread_indices(std::size_t size, std::size_t count) {
  std::vector<std::size_t> indices;
  if (size <= count) {
    for (std::size_t i = 0; i < size; ++i) indices.push_back(i);
    return indices;
  }
  for (std::size_t i = 0; i < count; ++i) indices.push_back(i * (size - 1) / (count - 1));
  return indices;
}

namespace {

std::string words_of_limit(double adhesion, double friction) {
  std::string words;
  if (adhesion > 0.0) words = fmt::format("adhesion {} kPa", format_number(1e-3 * adhesion, 3));
  if (friction > 0.0) {
    words += fmt::format("{}friction {}", words.empty() ? "" : ", ", format_number(friction, 3));
  }
  return words.empty() ? "smooth" : words;
}

}  // namespace

std::string words_of(const mpm::Wall& wall) {
  return wall.is_rough() ? "rough" : words_of_limit(wall.adhesion, wall.friction);
}

std::string words_of(const mpm::Base& base) {
  if (base.slab) {
    const mpm::ElasticSlab& slab = *base.slab;
    return fmt::format("elastic slab, {} mm thick, to {} mm from the axis, E = {} kPa, ν = {}, rough",
                       format_number(kMillimetres * slab.thickness, 3),
                       format_number(kMillimetres * slab.length, 3),
                       format_number(1e-3 * slab.youngs_modulus, 3), format_number(slab.poissons_ratio, 2));
  }
  if (base.friction.slip_length > 0.0) {
    return fmt::format("slip length {} mm", format_number(kMillimetres * base.friction.slip_length, 3));
  }
  return base.friction.limited() ? words_of_limit(base.friction.adhesion, base.friction.friction) : "rough";
}

}  // namespace isotach::reports
