// Copyright Isotach contributors. SPDX-License-Identifier: BSD-3-Clause
#include "datasets/candidates.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <set>

#include "datasets/study_sections.hpp"
#include "datasets/toml_table.hpp"

namespace isotach::datasets {
namespace {

constexpr Range kTime_s = Range::positive(1e7);
constexpr Range kRate_per_s = Range::positive(1.0);
constexpr Range kStrain{0.0, 0.95, false, true};
constexpr Range kLength_mm = Range::positive(10000.0);
constexpr Range kSpeed_m_per_s = Range::positive(10.0);
constexpr Range kAdhesion_kPa{0.0, 1000.0};
constexpr Range kStress_kPa = Range::positive(1e5);
constexpr int kReadings = 200;  // a test, so that none wins by being read more often

using PictureTable = std::map<std::string, std::vector<double>, std::less<>>;

void check_times(const TomlTable& table, std::string_view key, const std::vector<double>& times) {
  for (std::size_t i = 1; i < times.size(); ++i) {
    if (times[i] > times[i - 1]) continue;
    throw table.error(key, fmt::format("{} follows {}", times[i], times[i - 1]), "increasing times");
  }
  if (times.empty()) throw table.error(key, "an empty list", "at least one time");
}

/// The names that [pictures] may have are not known beforehand: all of its keys.
PictureTable read_pictures(TomlTable& root) {
  PictureTable pictures;
  auto table = root.table_if("pictures");
  if (!table) return pictures;
  for (const std::string& name : table->keys()) {
    pictures[name] = *table->numbers_if(name, kTime_s, "a list of increasing times (s)");
    check_times(*table, name, pictures[name]);
  }
  return pictures;
}

/// The sets that a test names, or one of its own by `times_s`.
std::vector<PictureTimes> read_choice(TomlTable& test, const PictureTable& pictures) {
  constexpr std::string_view kShape = "names of [pictures]";
  std::vector<PictureTimes> chosen;
  if (auto times = test.numbers_if("times_s", kTime_s, "a list of increasing times (s)")) {
    check_times(test, "times_s", *times);
    if (test.has("pictures")) throw test.error("pictures", "given beside times_s", "one of the two");
    chosen.push_back({"", std::move(*times)});
    return chosen;
  }
  const auto names = test.texts_if("pictures", kShape);
  if (!names || names->empty()) {
    throw test.error("pictures", names ? "an empty list" : "it is missing",
                     "names of [pictures], or times_s");
  }
  for (const std::string& name : *names) {
    const auto found = pictures.find(name);
    if (found == pictures.end()) {
      throw test.error("pictures", fmt::format("\"{}\" is not in [pictures]", name), kShape);
    }
    chosen.push_back({name, found->second});
  }
  return chosen;
}

/// Times of all choices, each once, in order.
std::vector<double> all_times(const std::vector<PictureTimes>& pictures) {
  std::set<double> times;
  for (const PictureTimes& choice : pictures) times.insert(choice.times.begin(), choice.times.end());
  return {times.begin(), times.end()};
}

const SlumpTest* first_fitted(const std::vector<SlumpTest>& tests) {
  const auto found =
      std::find_if(tests.begin(), tests.end(), [](const SlumpTest& test) { return !test.hold_out; });
  return found == tests.end() ? nullptr : &*found;
}

/// Reads slump candidates in the setting of a study.
class SlumpReader {
 public:
  SlumpReader(TomlTable& root, const Study& study, Candidates& candidates)
      : root_(root), pictures_(read_pictures(root)), candidates_(candidates) {
    const SlumpTest* model = first_fitted(study.slump_tests);
    if (model != nullptr) model_ = model->setup;
    if (root.has("numerics") || model == nullptr) numerics_ = read_numerics(root);
  }

  void read_one(TomlTable test, std::set<std::string>& names) {
    CandidateSlump slump;
    slump.name = read_test_name(test, names);
    if (test.has("programme")) slump.programme = test.text("programme");
    Assumptions assumptions("candidate " + slump.name, candidates_.assumptions);
    slump.setup.mould = read_mould(test.table("mould"), assumptions);
    finish(test, slump, assumptions);
    candidates_.slumps.push_back(std::move(slump));
  }

  void read_grid(TomlTable grid, std::set<std::string>& names) {
    const double diameter = 1e-3 * grid.number("diameter_mm", kLength_mm);
    const auto heights = list(grid, "fill_heights_mm", kLength_mm);
    const auto speeds = list(grid, "lift_speeds_m_per_s", kSpeed_m_per_s);
    const auto walls = read_walls(grid);
    CandidateSlump slump;
    if (grid.has("programme")) slump.programme = grid.text("programme");
    Assumptions assumptions("candidates of a grid", candidates_.assumptions);
    finish(grid, slump, assumptions);
    for (const double height : heights) {
      for (const double speed : speeds) {
        for (const auto& [name, wall] : walls) {
          CandidateSlump one = slump;
          one.setup.mould.diameter = diameter;
          one.setup.mould.fill_height = 1e-3 * height;
          one.setup.mould.lift_speed = speed;
          one.setup.mould.wall = wall;
          one.name =
              fmt::format("h/D {:.2g}, {:g} m/s, {}", one.setup.mould.fill_height / diameter, speed, name);
          if (!names.insert(one.name).second) {
            throw grid.error("fill_heights_mm", fmt::format("\"{}\" occurs twice", one.name),
                             "combinations that differ");
          }
          candidates_.slumps.push_back(std::move(one));
        }
      }
    }
  }

 private:
  static std::vector<double> list(TomlTable& grid, std::string_view key, const Range& accepted) {
    const std::string shape = fmt::format("a list of numbers {}", accepted.words());
    auto values = grid.numbers_if(key, accepted, shape);
    if (!values || values->empty()) throw grid.error(key, values ? "an empty list" : "it is missing", shape);
    return *std::move(values);
  }

  static std::vector<std::pair<std::string, mpm::Wall>> read_walls(TomlTable& grid) {
    std::vector<std::pair<std::string, mpm::Wall>> walls;
    constexpr std::string_view kShape = "a list of \"smooth\", \"rough\"";
    for (const std::string& name : grid.texts_if("walls", kShape).value_or(std::vector<std::string>{})) {
      if (name != "smooth" && name != "rough") throw grid.error("walls", "\"" + name + "\"", kShape);
      walls.emplace_back(name + " wall", name == "smooth" ? mpm::Wall::smooth() : mpm::Wall::rough());
    }
    const auto adhesions =
        grid.numbers_if("wall_adhesions_kPa", kAdhesion_kPa, "a list of numbers from 0 to 1000");
    for (const double adhesion : adhesions.value_or(std::vector<double>{})) {
      walls.emplace_back(fmt::format("adhesion {:g} kPa", adhesion), mpm::Wall{1e3 * adhesion, 0.0});
    }
    if (walls.empty()) throw grid.error("walls", "there is no wall", "walls or wall_adhesions_kPa");
    return walls;
  }

  /// Pictures, mud, base and numerics.
  void finish(TomlTable& table, CandidateSlump& slump, Assumptions& assumptions) {
    slump.pictures = read_choice(table, pictures_);
    slump.setup.times = all_times(slump.pictures);
    if (auto mud = table.table_if("mud")) {
      slump.setup.mud = read_mud(*std::move(mud), assumptions);
    } else if (model_) {
      slump.setup.mud = model_->mud;
    } else {
      throw table.error("mud", "it is missing", "a mud, since the study has no slump test to take it from");
    }
    if (table.has("base")) {
      slump.setup.base = read_base(table, assumptions);
    } else if (model_) {
      slump.setup.base = model_->base;
    }
    slump.setup.numerics = numerics_ ? *numerics_ : model_->numerics;
    if (slump.setup.mould.diameter > 0.0) check_cell_size(root_, slump.setup);
    table.reject_unknown_keys();
  }

  TomlTable& root_;
  PictureTable pictures_;
  Candidates& candidates_;
  std::optional<mpm::SlumpSetup> model_;
  std::optional<mpm::Numerics> numerics_;
};

CandidateStage read_stage(TomlTable stage, double strain) {
  CandidateStage result{Stage::relax, strain, 0.0, 0.0};
  if (const auto seconds = stage.number_if("relax_s", kTime_s)) {
    result.duration = *seconds;
  } else {
    result.strain = stage.number("to_strain", kStrain);
    result.rate = stage.number("rate_per_s", kRate_per_s);
    if (result.strain == strain) {
      throw stage.error("to_strain", fmt::format("{} is where the stage begins", strain), "another strain");
    }
    result.stage = result.strain > strain ? Stage::load : Stage::unload;
  }
  stage.reject_unknown_keys();
  return result;
}

CandidateOedometer read_oedometer_candidate(TomlTable test, std::set<std::string>& names) {
  CandidateOedometer result;
  result.name = read_test_name(test, names);
  if (test.has("programme")) result.programme = test.text("programme");
  double strain = 0.0;
  for (TomlTable& stage : test.tables("stages")) {
    result.stages.push_back(read_stage(std::move(stage), strain));
    strain = result.stages.back().strain;
  }
  constexpr std::string_view kStages = "one or more of { to_strain, rate_per_s } and { relax_s }";
  if (result.stages.empty()) throw test.error("stages", "there is none", kStages);
  result.readings = test.integer_if("readings", {4.0, 10000.0}).value_or(kReadings);
  result.void_ratio = test.number_if("void_ratio", kVoidRatio);
  if (const auto stress = test.number_if("initial_axial_stress_kPa", kStress_kPa)) {
    result.axial_stress = 1e3 * *stress;
  }
  result.K0 = test.number_if("initial_K0", {0.15, 2.0});
  test.reject_unknown_keys();
  return result;
}

Candidates read(const TomlDocument& document, const Study& study) {
  TomlTable root = document.root();
  for (const std::string_view section : {"pictures", "slump", "slump_grid", "oedometer", "numerics"}) {
    static_cast<void>(root.has(section));
  }
  root.reject_unknown_keys();
  Candidates candidates;
  std::set<std::string> names;
  SlumpReader slumps(root, study, candidates);
  for (TomlTable& test : root.tables("slump")) slumps.read_one(std::move(test), names);
  for (TomlTable& grid : root.tables("slump_grid")) slumps.read_grid(std::move(grid), names);
  for (TomlTable& test : root.tables("oedometer")) {
    candidates.oedometers.push_back(read_oedometer_candidate(std::move(test), names));
  }
  if (candidates.count() == 0) {
    throw InputError({root.file()}, "candidates", "there is none",
                     "at least one [[slump]], [[slump_grid]] or [[oedometer]]");
  }
  return candidates;
}

}  // namespace

std::size_t Candidates::count() const {
  std::size_t number = oedometers.size();
  for (const CandidateSlump& slump : slumps) number += slump.pictures.size();
  return number;
}

Candidates read_candidates(const std::filesystem::path& file, const Study& study,
                           const ReadOptions& options) {
  return read(TomlDocument::read(file, options), study);
}

Candidates parse_candidates(std::string text, const std::filesystem::path& file, const Study& study) {
  return read(TomlDocument::parse(std::move(text), file), study);
}

}  // namespace isotach::datasets
