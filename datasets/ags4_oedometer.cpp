// Copyright Isotach contributors. SPDX-License-Identifier: BSD-3-Clause
// Oedometer tests of an AGS4 file: implementation.
#include "datasets/ags4_oedometer.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cctype>
#include <map>
#include <utility>

#include "datasets/delimited_line.hpp"
#include "datasets/load_steps.hpp"
#include "datasets/soil_ranges.hpp"
#include "datasets/study_sections.hpp"

namespace isotach::datasets {
namespace {

constexpr Range kSpecimenLength_mm = Range::positive(1000.0);
constexpr Range kGrainDensity{1.0, 8.0, true};  // likewise, of grains
constexpr Range kStress{0.0, 1e6};              // kPa; 0 where unloaded to nothing
constexpr double kGravity = 9.80665;            // m/s2
constexpr double kLargestDensity = 5.0;         // Mg/m3; above it a number is a unit weight in kN/m3

std::string in_small_letters(std::string_view text) {
  std::string small(text);
  std::transform(small.begin(), small.end(), small.begin(),
                 [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  return small;
}

/// kPa per unit of the heading.
double stress_unit(const Ags4File& file, const Ags4Group& group, std::string_view heading) {
  const std::string unit = in_small_letters(group.unit(heading));
  if (unit.empty() || unit == "kpa" || unit == "kn/m2") return 1.0;
  if (unit == "mpa" || unit == "mn/m2") return 1e3;
  throw InputError({file.file(), group.line}, fmt::format("unit of {}", heading),
                   fmt::format("\"{}\"", group.unit(heading)), "kPa, kN/m2, MPa or MN/m2");
}

void require_unit(const Ags4File& file, const Ags4Group& group, std::string_view heading,
                  std::string_view wanted) {
  const std::string_view unit = group.unit(heading);
  if (unit.empty() || in_small_letters(unit) == wanted) return;
  throw InputError({file.file(), group.line}, fmt::format("unit of {}", heading), fmt::format("\"{}\"", unit),
                   wanted);
}

/// Reads the numbers of one row of CONG.
class SpecimenRow {
 public:
  SpecimenRow(const Ags4File& file, const Ags4Group& group, const Ags4Group::Row& row)
      : file_(file), group_(group), row_(row) {}

  [[nodiscard]] SpecimenData read() {
    SpecimenData data;
    data.height = length("CONG_HIGT");
    data.diameter = length("CONG_SDIA");
    if (!data.diameter) data.diameter = length("CONG_DIA");
    data.void_ratio = number("CONG_IVR", kVoidRatio);
    if (const auto water = number("CONG_MCI", kWaterContent_pct)) data.water_content = 1e-2 * *water;
    if (const auto density = density_of("CONG_BDEN", kDensity)) data.bulk_density = 1e3 * *density;
    data.specific_gravity = density_of("CONG_PDEN", kGrainDensity);
    data.assumptions = std::move(assumptions_);
    return data;
  }

 private:
  std::optional<double> number(std::string_view heading, const Range& accepted) {
    std::string_view cell = group_.text(row_, heading);
    const bool assumed = cell.starts_with('#');
    if (assumed) cell = trimmed(cell.substr(1));
    if (cell.empty()) return std::nullopt;
    const double value =
        number_in(cell, false, accepted, file_.place(row_), fmt::format("heading {}", heading));
    if (assumed) {
      assumptions_.push_back(fmt::format("{} = {} was assumed by the laboratory", heading, cell));
    }
    return value;
  }

  std::optional<double> length(std::string_view heading) {
    require_unit(file_, group_, heading, "mm");
    const auto value = number(heading, kSpecimenLength_mm);
    return value ? std::optional(1e-3 * *value) : std::nullopt;
  }

  /// Mg/m3
  std::optional<double> density_of(std::string_view heading, const Range& accepted) {
    const auto value = number(heading, Range::positive(1e5));
    if (!value) return std::nullopt;
    const std::string unit = in_small_letters(group_.unit(heading));
    double density = *value;
    if (unit == "kg/m3") {
      density *= 1e-3;
    } else if (unit == "kn/m3") {
      density /= kGravity;
    } else if (!unit.empty() && unit != "mg/m3" && unit != "t/m3" && unit != "g/cm3") {
      throw InputError({file_.file(), group_.line}, fmt::format("unit of {}", heading),
                       fmt::format("\"{}\"", group_.unit(heading)), "Mg/m3, kg/m3 or kN/m3");
    } else if (density > kLargestDensity && heading == "CONG_BDEN") {
      density /= kGravity;
      assumptions_.push_back(
          fmt::format("{} = {:.6g} is too much for Mg/m3, taken as kN/m3", heading, *value));
    }
    if (!accepted.contains(density)) {
      throw InputError(file_.place(row_), fmt::format("heading {}", heading),
                       fmt::format("{:.6g}, which is {:.4g} Mg/m3", *value, density),
                       fmt::format("{} Mg/m3", accepted.words()));
    }
    return density;
  }

  const Ags4File& file_;
  const Ags4Group& group_;
  const Ags4Group::Row& row_;
  std::vector<std::string> assumptions_;
};

Selection name_of_row(const Ags4Group& group, const Ags4Group::Row& row) {
  Selection name;
  for (const std::string_view key : kAgs4SpecimenKeys) {
    if (const std::string_view value = group.text(row, key); !value.empty()) name.emplace_back(key, value);
  }
  return name;
}

/// Whether a row of CONG describes the specimen: all headings that both give agree.
bool describes(const Ags4Group& group, const Ags4Group::Row& row, const Selection& name) {
  return std::all_of(name.begin(), name.end(), [&](const auto& entry) {
    const std::string_view cell = group.text(row, entry.first);
    return cell.empty() || same_value(cell, entry.second);
  });
}

const Ags4Group& require_group(const Ags4File& file) {
  const Ags4Group* group = file.find("CONS");
  if (group == nullptr) {
    throw InputError({file.file()}, "file",
                     fmt::format("it has no group CONS, only {}", fmt::join(file.group_names(), ", ")),
                     "an AGS4 file with oedometer tests");
  }
  for (const std::string_view heading : {"CONS_INCF", "CONS_INCE"}) {
    if (group->find(heading)) continue;
    throw InputError({file.file(), group->line}, "group CONS", fmt::format("it has no heading {}", heading),
                     "CONS_INCF and CONS_INCE, stress and void ratio at the end of each increment");
  }
  return *group;
}

void sort_by_number(std::vector<Ags4Increment>& increments) {
  std::vector<std::pair<double, std::size_t>> order;
  for (std::size_t i = 0; i < increments.size(); ++i) {
    try {
      order.emplace_back(number_in(increments[i].number, false, {}, {}, "CONS_INCN"), i);
    } catch (const InputError&) {
      return;  // names, not numbers: the file's order stands
    }
  }
  std::sort(order.begin(), order.end());
  std::vector<Ags4Increment> sorted;
  for (const auto& [number, index] : order) sorted.push_back(std::move(increments[index]));
  increments = std::move(sorted);
}

}  // namespace

std::vector<Ags4Oedometer> find_ags4_oedometers(const Ags4File& file) {
  const Ags4Group& group = require_group(file);
  std::vector<Ags4Oedometer> tests;
  std::map<Selection, std::size_t> index;
  for (std::size_t row = 0; row < group.rows.size(); ++row) {
    Selection name = name_of_row(group, group.rows[row]);
    const auto [found, is_new] = index.try_emplace(name, tests.size());
    if (is_new) tests.push_back({std::move(name), {}, {}, {}});
    tests[found->second].rows.push_back(row);
  }
  if (tests.empty()) {
    throw InputError({file.file(), group.line}, "group CONS", "it has no row", "one row each increment");
  }
  return tests;
}

Ags4Oedometer read_ags4_oedometer(const Ags4File& file, Ags4Oedometer test) {
  const Ags4Group* const about = file.find("CONG");
  const Ags4Group::Row* described = nullptr;
  for (std::size_t i = 0; about != nullptr && i < about->rows.size(); ++i) {
    const Ags4Group::Row& row = about->rows[i];
    if (!describes(*about, row, test.name)) continue;
    if (described != nullptr) {
      throw InputError(
          file.place(row), "group CONG",
          fmt::format("a second row for {}, after line {}", words_of(test.name), described->line),
          "one row each specimen");
    }
    described = &row;
  }
  if (described != nullptr) {
    test.specimen = SpecimenRow(file, *about, *described).read();
  } else {
    test.specimen.assumptions.push_back("no row of CONG describes the specimen");
  }

  const Ags4Group& group = require_group(file);
  const double kPa = stress_unit(file, group, "CONS_INCF");
  for (const std::size_t i : test.rows) {
    const Ags4Group::Row& row = group.rows[i];
    Ags4Increment increment{row.line, std::string(group.text(row, "CONS_INCN")), {}, {}, {}};
    if (const auto stress = file.number(group, row, "CONS_INCF", kStress)) {
      increment.stress = 1e3 * kPa * *stress;
    }
    increment.void_ratio = file.number(group, row, "CONS_INCE", kVoidRatio);
    increment.void_ratio_before = file.number(group, row, "CONS_IVR", kVoidRatio);
    test.increments.push_back(std::move(increment));
  }
  sort_by_number(test.increments);
  if (!test.specimen.void_ratio) test.specimen.void_ratio = test.increments.front().void_ratio_before;
  return test;
}

OedometerRecord record_of(const Ags4File& file, const Ags4Oedometer& test, double void_ratio) {
  OedometerRecord record;
  record.file = file.file();
  LoadStepBuilder steps(record);
  double begin = 0.0;
  for (const Ags4Increment& increment : test.increments) {
    const auto drop = [&](std::string_view why) {
      record.notes.push_back(
          {increment.line, fmt::format("dropped: increment {} has no {}", increment.number, why)});
    };
    if (!increment.stress || !(*increment.stress > 0.0)) {
      drop("stress");
      continue;
    }
    const double end = begin + kAgs4StepDuration;
    if (increment.void_ratio) {
      const double strain = (void_ratio - *increment.void_ratio) / (1.0 + void_ratio);
      if (!(strain > -1.0 && strain < 1.0)) {
        throw InputError({file.file(), increment.line}, "heading CONS_INCE",
                         fmt::format("{:.6g} is a strain of {:.4g} from the void ratio {:.6g} of the start",
                                     *increment.void_ratio, strain, void_ratio),
                         "a strain > -1 and < 1");
      }
      OedometerRow row{};
      row.line = increment.line;
      row.time = end;
      row.axial_strain = strain;
      row.axial_stress = *increment.stress;
      steps.open(row.line, increment.number, begin, std::nullopt);
      steps.add(row);
    } else {
      drop("void ratio");
    }
    begin = end;
  }
  steps.finish();
  if (record.rows.size() < 3) throw too_few_rows(record, test.increments.size());
  return record;
}

}  // namespace isotach::datasets
