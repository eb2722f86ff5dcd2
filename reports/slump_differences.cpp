// Copyright Isotach contributors. SPDX-License-Identifier: BSD-3-Clause
#include "reports/slump_differences.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <string>

#include "mpm/gravity.hpp"
#include "reports/json_number.hpp"
#include "reports/number.hpp"
#include "reports/slump_tables.hpp"
#include "reports/units.hpp"

namespace isotach::reports {
namespace {

// |D| (1/s) in the fall, a second later, and after some minutes
constexpr std::array<double, 3> kRates{1.0, 1e-2, 1e-4};
constexpr double kSlumpRate = kRates[1];

double strength_at(const ComparedSlump& slump, double rate) {
  return mpm::critical_state_strength(slump.test.material, slump.result->initial, rate);
}

/// C_u at kSlumpRate over the vertical stress at the foot of the filled mould: what a slump without inertia
/// goes by.
double strength_over_fill(const ComparedSlump& slump) {
  return strength_at(slump, kSlumpRate) /
         (slump.result->initial.density * mpm::kGravity * slump.test.setup.mould.fill_height);
}

template <class Length>
Spread spread_of(const EndedSlumps& slumps, Length&& length) {
  const auto shorter = [&](const ComparedSlump* a, const ComparedSlump* b) {
    return length(*a) < length(*b);
  };
  const ComparedSlump* least = *std::min_element(slumps.begin(), slumps.end(), shorter);
  const ComparedSlump* greatest = *std::max_element(slumps.begin(), slumps.end(), shorter);
  return {length(*least), length(*greatest), least, greatest};
}

std::string millimetres(double length) {
  return format_number(kMillimetres * length, 3);
}

/// "Heights differ most at 5.2 s, by 14.4 mm (iv-0.03, iv-0.06), at 30 s by 10.7 mm."
std::string sentence_of(const std::string& lengths, const std::vector<SpreadAt>& spreads,
                        Spread SpreadAt::*which) {
  const auto most =
      std::max_element(spreads.begin(), spreads.end(), [which](const SpreadAt& a, const SpreadAt& b) {
        return (a.*which).difference() < (b.*which).difference();
      });
  const Spread& spread = (*most).*which;
  std::string sentence =
      fmt::format("{} differ{} at {}, by {} mm ({}, {})", lengths, spreads.size() > 1 ? " most" : "",
                  time_label(most->time), millimetres(spread.difference()), spread.least_in->name,
                  spread.greatest_in->name);
  if (most + 1 != spreads.end()) {
    const SpreadAt& last = spreads.back();
    sentence += fmt::format(", at {} by {} mm ({}, {})", time_label(last.time),
                            millimetres((last.*which).difference()), (last.*which).least_in->name,
                            (last.*which).greatest_in->name);
  }
  return sentence + ".";
}

Table spread_table(const std::vector<SpreadAt>& spreads) {
  using enum Alignment;
  Table table{
      .caption =
          "The lowest and the highest, the shortest and the longest, and how far they are apart "
          "(mm).",
      .header = {"Time", "Lowest", "Highest", "Heights apart", "Shortest toe", "Longest toe", "Toes apart"},
      .alignment = {left, right, right, right, right, right, right}};
  for (const SpreadAt& at : spreads) {
    std::vector<std::string> row{time_label(at.time)};
    for (const Spread* spread : {&at.height, &at.toe}) {
      row.push_back(fmt::format("{} ({})", millimetres(spread->least), spread->least_in->name));
      row.push_back(fmt::format("{} ({})", millimetres(spread->greatest), spread->greatest_in->name));
      row.push_back(millimetres(spread->difference()));
    }
    table.rows.push_back(std::move(row));
  }
  return table;
}

Table strength_table(const EndedSlumps& slumps) {
  Table table{.caption = "Undrained strength C_u (kPa) at the critical state at rates |D| in 1/s.",
              .header = {"Slump", "p_B0 (kPa)"},
              .alignment = {Alignment::left, Alignment::right}};
  const auto column = [&table](std::string name) {
    table.header.push_back(std::move(name));
    table.alignment.push_back(Alignment::right);
  };
  for (const double rate : kRates) column(fmt::format("|D| = {}", format_number(rate, 1)));
  column(fmt::format("C_u/(ρgh), |D| = {}", format_number(kSlumpRate, 1)));
  for (const ComparedSlump* slump : slumps) {
    std::vector<std::string> row{
        slump->name, format_number(kPerPascal * slump->result->initial.preconsolidation_pressure, 3)};
    for (const double rate : kRates) row.push_back(format_number(kPerPascal * strength_at(*slump, rate), 3));
    row.push_back(format_number(strength_over_fill(*slump), 3));
    table.rows.push_back(std::move(row));
  }
  table.notes = {
      "C_u = q/2 = M p_B0/4 [|D| (1 − C_1)/D_r]^I_v in triaxial compression, of mud that keeps its void "
      "ratio. ρgh is the vertical stress at the foot of the filled mould."};
  return table;
}

nlohmann::ordered_json json_of(const Spread& spread) {
  return {{"least", json_number(kMillimetres * spread.least)},
          {"least_in", spread.least_in->name},
          {"greatest", json_number(kMillimetres * spread.greatest)},
          {"greatest_in", spread.greatest_in->name}};
}

}  // namespace

std::vector<SpreadAt> spreads(const EndedSlumps& slumps) {
  std::vector<SpreadAt> result;
  for (const double time : shared_times(slumps)) {
    result.push_back({time, spread_of(slumps, [time](const auto& s) { return outline_at(s, time).height(); }),
                      spread_of(slumps, [time](const auto& s) { return outline_at(s, time).toe(); })});
  }
  return result;
}

void add_difference_section(Page& page, const EndedSlumps& slumps) {
  page.section("What differs between these runs");
  const std::vector<SpreadAt> all = spreads(slumps);
  if (slumps.size() > 1 && !all.empty()) {
    page.paragraph(sentence_of("Heights", all, &SpreadAt::height) + " " +
                   sentence_of("Toes", all, &SpreadAt::toe));
    page.table(spread_table(all));
  }
  page.table(strength_table(slumps));
}

nlohmann::ordered_json differences_json(const EndedSlumps& slumps) {
  nlohmann::ordered_json json = nlohmann::ordered_json::array();
  for (const SpreadAt& at : spreads(slumps)) {
    json.push_back(
        {{"time_s", json_number(at.time)}, {"height_mm", json_of(at.height)}, {"toe_mm", json_of(at.toe)}});
  }
  return json;
}

nlohmann::ordered_json strengths_json(const ComparedSlump& slump) {
  nlohmann::ordered_json json = nlohmann::ordered_json::array();
  for (const double rate : kRates) {
    json.push_back({{"rate_per_s", json_number(rate)},
                    {"strength_kPa", json_number(kPerPascal * strength_at(slump, rate))}});
  }
  return json;
}

}  // namespace isotach::reports
