// Copyright Isotach contributors. SPDX-License-Identifier: BSD-3-Clause
// The sections on slump and spread of a yield-stress material.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <string>
#include <vector>

#include "bench/mpm_problems/yield_stress_flow.hpp"

namespace isotach::bench {

namespace {

constexpr std::array<double, 4> kYieldStresses{0.05, 0.1, 0.2, 0.4};  // tau'

/// A column 0.1 m high; its cells are parts of its radius.
Pile column(double yield_stress, double slenderness, bool rough, double cells) {
  Pile pile;
  pile.radius = 0.5 * pile.height / slenderness;
  pile.yield_stress = yield_stress * kPileDensity * kPileGravity * pile.height;
  pile.rough = rough;
  pile.cell_size = pile.radius / cells;
  pile.width = (slenderness < 3.0 ? 3.6 : 5.0) * pile.radius;
  pile.drag = 100.0;
  pile.duration = 6.0;
  if (slenderness > 4.0) pile.bulk_modulus = pile.shear_modulus = 6e4;
  return pile;
}

/// s/H (-); not a number where the run broke off.
double slump(const Pile& pile, const PileAtRest& rest) {
  return rest.failed ? std::nan("") : 1.0 - rest.height / pile.height;
}

std::string percent(double share) {
  return fmt::format("{:.2f} %", 100.0 * share);
}

SectionTable slenderness_table() {
  SectionTable table{{"tau'", "law", "base", "H/D = 1", "H/D = 2", "H/D = 4", "E_kin/E_pot, end (largest)",
                      "dh/dt, end (mm/s, largest)", "volume"},
                     {}};
  for (const double yield : kYieldStresses) {
    for (const bool rough : {false, true}) {
      std::vector<std::string> row{fmt::format("{:.2f}", yield), fmt::format("{:.3f}", slump_law(yield)),
                                   rough ? "rough" : "smooth"};
      double kinetic = 0.0;
      double rate = 0.0;
      double volume = 0.0;
      for (const double slenderness : {1.0, 2.0, 4.0}) {
        const Pile pile = column(yield, slenderness, rough, slenderness > 2.0 ? 4.0 : 6.0);
        const PileAtRest rest = settle(pile);
        row.push_back(fmt::format("{:.3f}", slump(pile, rest)));
        kinetic = std::max(kinetic, rest.kinetic_share);
        rate = std::max(rate, std::abs(rest.height_rate));
        volume = std::max(volume, std::abs(rest.volume_error));
      }
      row.push_back(fmt::format("{:.0e}", kinetic));
      row.push_back(fmt::format("{:.3f}", 1e3 * rate));
      row.push_back(percent(volume));
      table.rows.push_back(row);
    }
  }
  return table;
}

SectionTable cells_table() {
  SectionTable table{{"tau'", "H/D", "base", "R/4", "R/8", "R/12", "R/12, cells not averaged"}, {}};
  for (const double slenderness : {1.0, 2.0}) {
    for (const bool rough : {false, true}) {
      std::vector<std::string> row{"0.20", fmt::format("{:.0f}", slenderness), rough ? "rough" : "smooth"};
      const std::vector<double> resolutions =
          slenderness > 1.0 ? std::vector{4.0, 8.0} : std::vector{4.0, 8.0, 12.0};
      for (const double cells : resolutions) {
        const Pile pile = column(0.2, slenderness, rough, cells);
        row.push_back(fmt::format("{:.3f}", slump(pile, settle(pile))));
      }
      if (slenderness > 1.0) {
        row.insert(row.end(), 2, "");
      } else {
        Pile pile = column(0.2, slenderness, rough, 12.0);
        pile.averaged = false;
        row.push_back(fmt::format("{:.3f}", slump(pile, settle(pile))));
      }
      table.rows.push_back(row);
    }
  }
  return table;
}

SectionTable slender_table() {
  SectionTable table{{"H/D", "smooth", "rough", "law"}, {}};
  for (const double slenderness : {4.0, 8.0, 16.0}) {
    std::vector<std::string> row{fmt::format("{:.0f}", slenderness)};
    for (const bool rough : {false, true}) {
      const Pile pile = column(0.2, slenderness, rough, 4.0);
      row.push_back(fmt::format("{:.3f}", slump(pile, settle(pile))));
    }
    row.push_back(fmt::format("{:.3f}", slump_law(0.2)));
    table.rows.push_back(row);
  }
  return table;
}

/// A flat cylinder 0.05 m high and 0.2 m wide that spreads over a rough base.
Pile flat(double yield_stress, double cell_size, double duration) {
  Pile pile;
  pile.height = 0.05;
  pile.radius = 0.1;
  pile.yield_stress = yield_stress;
  pile.cell_size = cell_size;
  pile.width = 0.28;
  pile.drag = 80.0;
  pile.duration = duration;
  pile.consistency = 0.05;
  pile.bulk_modulus = 2e4;
  pile.shear_modulus = 1e4;
  return pile;
}

std::vector<std::string> spread_row(const Pile& pile) {
  const PileAtRest rest = settle(pile);
  const double volume = std::numbers::pi * pile.radius * pile.radius * pile.height;
  const double radius = spread_law(kPileDensity, volume, pile.yield_stress);
  const double with_front = spread_law_with_front(kPileDensity, volume, pile.yield_stress, 0.0);
  const double with_layer = spread_law_with_front(kPileDensity, volume, pile.yield_stress, pile.cell_size);
  const double height = std::sqrt(2.0 * pile.yield_stress * radius / (kPileDensity * kPileGravity));
  return {fmt::format("{:.2f}", pile.yield_stress),
          fmt::format("{:.3f}", height / radius),
          fmt::format("{:.2f}", 1e3 * pile.cell_size),
          fmt::format("{:.1f}", 1e3 * radius),
          fmt::format("{:.1f}", 1e3 * with_front),
          fmt::format("{:.1f}", 1e3 * with_layer),
          fmt::format("{:.1f}", 1e3 * rest.toe),
          fmt::format("{:.1f}", 1e3 * rest.reach),
          fmt::format("{:.3f}", rest.reach / radius),
          fmt::format("{:.3f}", rest.reach / with_front),
          fmt::format("{:.3f}", rest.height / height),
          fmt::format("{:.0e}", rest.kinetic_share),
          fmt::format("{:.0e}", rest.fastest_kinetic),
          fmt::format("{:.3f}", 1e3 * rest.toe_rate),
          percent(rest.volume_error)};
}

}  // namespace

Section slump_section() {
  return {
      "Slump of a yield-stress column",
      "A column of Bingham material, released against drag so slowly that inertia has no say (E_kin below "
      "1 % of the initial potential energy throughout), comes to rest at s/H, tau' = tau_y/(rho g H), von "
      "Mises. The law (Pashias et al. 1996 with sqrt3 tau' for 2 tau') lets each horizontal slice spread "
      "by itself, in uniaxial stress, until it carries the weight above: no shear between slices nor on "
      "the base. It is the limit of slender columns, not a bound for all: neighbours that must spread "
      "together let a squat column on a smooth base slump more, and a rough base holds the widest slices "
      "back. Smooth and rough answers lie on either side of the law and close in on it.\n\n"
      "Cells are R/6, from H/D = 4 on R/4; R/8 halves what a column of H/D = 8 slumps beyond the law.",
      {slenderness_table(), cells_table(), slender_table()}};
}

Section spread_section() {
  Section section{
      "Spread of a thin deposit",
      "A cylinder, 50 mm high and 200 mm wide, spreads over a rough base: h = sqrt(2 tau_c (R - r)/(rho g)), "
      "R "
      "= (225 rho g V^2/(128 pi^2 tau_c))^(1/5) (Roussel & Coussot 2005). tau_c is the yield stress in "
      "simple "
      "shear, which on the base is tau_y itself: the criterion makes no difference while h << R. At the next "
      "order in h/R stretching above the base carries part of the yield stress; in plane flow that turns h^2 "
      "= 2 d x, d = tau_c/(rho g), into h^2 - pi d h = 2 d x (integrate sqrt(tau_c^2 - tau_rz^2) over the "
      "height), a front pi d high and h larger by pi d/2 behind it. With the same volume R falls: column "
      "'with front'. A grid smears the shear on the base over about a cell, in which weight drives half as "
      "much: h^2 - (pi d + cell) h = 2 d x, column 'and a cell', an error of first order in the cell size "
      "that "
      "matters where the deposit is a few cells high. Drag keeps E_kin near 1 % of the initial potential "
      "energy; a faster release (the third row of 13.47 Pa) overshoots. The thinnest deposit is a few cells "
      "high and "
      "still creeps when the run ends (column 'toe').",
      {{{"tau_c (Pa)", "h0/R", "cell (mm)", "R (mm)", "with front", "and a cell", "outline",
         "outermost point", "over R", "over with front", "height over sqrt(2 d R)", "E_kin/E_pot, end",
         "largest", "toe (mm/s)", "volume"},
        {}}}};
  Pile fast = flat(13.47, 0.005, 8.0);
  fast.drag = 20.0;
  for (const Pile& pile :
       {flat(40.0, 0.005, 8.0), flat(40.0, 0.0025, 8.0), flat(13.47, 0.005, 12.0), flat(13.47, 0.0025, 12.0),
        fast, flat(4.4, 0.005, 24.0), flat(4.4, 0.0025, 24.0)}) {
    section.tables.front().rows.push_back(spread_row(pile));
  }
  return section;
}

}  // namespace isotach::bench
