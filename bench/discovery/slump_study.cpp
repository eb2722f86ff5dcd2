// Copyright Isotach contributors. SPDX-License-Identifier: BSD-3-Clause
#include "bench/discovery/slump_study.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <random>

#include "bench/discovery/made_study.hpp"
#include "bench/discovery/plan.hpp"
#include "bench/discovery/slump_visibility.hpp"
#include "bench/outline_noise.hpp"
#include "bench/synthetic_oedometer.hpp"
#include "calibration/fit_slump.hpp"
#include "calibration/simulation_error.hpp"
#include "effects/bleeding.hpp"

namespace isotach::bench {

namespace {

using datasets::SlumpTest;
using model::ParameterId;

// cells across the mould's radius, of the conserving scheme
constexpr int kFitterCells = 6;         // 6.5 mm
constexpr int kReferenceCells = 10;     // 3.9 mm
constexpr std::array kSeekCells{8, 9};  // 4.9 and 4.3 mm, where an amplitude is sought
constexpr int kGeneratorCells = 11;     // 3.5 mm
constexpr double kLongest = 10.0;       // s, of mud
constexpr KnownBeforehand kKnown{.viscosity = 0.03, .c1 = 0.005};

/// Half of the variance is each point's own, half is shared.
OutlineNoise noise_of(const SlumpCase& one) {
  return {one.noise * std::sqrt(0.5), one.noise * std::sqrt(0.5)};
}

void set_cells(mpm::Numerics& numerics, const SlumpTest& test, int cells) {
  numerics.cell_size = 0.5 * test.setup.mould.diameter / cells;
}

/// The material that datasets/mud-a states, I_v and C_1 times a factor within +-25 % each.
model::Parameters<double> random_truth(const model::Parameters<double>& stated, std::mt19937_64& random) {
  model::ParameterValues<double> values = stated.values();
  for (const ParameterId id : {ParameterId::I_v, ParameterId::C_1})
    values[id] *= 0.75 + 0.5 * uniform(random);
  return *model::Parameters<double>::create(values);
}

/// Three tests of datasets/mud-a and one held out, without what was measured, by the numerics of fits.
std::vector<SlumpTest> blank_tests(const datasets::Study& from, const OutlineNoise& noise) {
  std::vector<SlumpTest> tests;
  for (const std::string name : {"slump-1", "slump-2", "slump-3", "slump-4"}) {
    const auto found = std::find_if(from.slump_tests.begin(), from.slump_tests.end(),
                                    [&](const SlumpTest& test) { return test.name == name; });
    SlumpTest test = *found;
    std::erase_if(test.outlines, [](const datasets::Outline& outline) { return outline.time > kLongest; });
    test.setup.times.clear();
    for (const datasets::Outline& outline : test.outlines) test.setup.times.push_back(outline.time);
    const double all = std::hypot(noise.reading, noise.shared);
    test.noise = {all, all, noise.shared};
    test.hold_out = name == "slump-4";
    set_cells(test.setup.numerics, test, kFitterCells);
    test.reference = test.setup.numerics;
    set_cells(*test.reference, test, kReferenceCells);
    tests.push_back(std::move(test));
  }
  return tests;
}

/// Water twice as stiff as that of fits. But not where it bleeds: how much leaves at a rate is for the
/// stiffness to say, which then is of what is hidden.
void set_water(mpm::Numerics& numerics, const SlumpCase& one) {
  if (one.effect != &effects::bleeding::kEffect) numerics.water_bulk_modulus *= 2.0;
}

/// Tests in numerics in which an amplitude is sought.
std::vector<SlumpTest> set_to_seek(std::vector<SlumpTest> tests, const SlumpCase& one, int cells) {
  for (SlumpTest& test : tests) {
    set_cells(test.setup.numerics, test, cells);
    set_water(test.setup.numerics, one);
  }
  return tests;
}

/// Tests in numerics in which studies are measured: finer and stricter than any that fits use.
std::vector<SlumpTest> set_to_measure(std::vector<SlumpTest> tests, const SlumpCase& one) {
  for (SlumpTest& test : tests) {
    mpm::Numerics& numerics = test.setup.numerics;
    set_cells(numerics, test, kGeneratorCells);
    set_water(numerics, one);
    numerics.points_per_cell = 9;
    numerics.tolerance = 1e-3;
    numerics.courant = 0.6;
    numerics.inertia_scaling = 50.0;
  }
  return tests;
}

/// Moves each point along its outline's normal by its error, outwards.
void add_noise(SlumpTest& test, const OutlineNoise& noise, std::mt19937_64& random) {
  const experiments::SlumpExperiment experiment(test);
  const experiments::Values errors = draw_errors(experiment, noise, random);
  std::size_t next = 0;
  for (datasets::Outline& outline : test.outlines) {
    const auto points = outline.points;
    for (std::size_t k = 0; k < points.size(); ++k) {
      const auto& before = points[k > 0 ? k - 1 : k];
      const auto& behind = points[std::min(k + 1, points.size() - 1)];
      const double along_r = behind.r - before.r;
      const double along_z = behind.z - before.z;
      const double length = std::hypot(along_r, along_z);
      const double error = errors[next++];
      // from the toe to the axis outwards is to the right
      outline.points[k].r += error * along_z / length;
      outline.points[k].z -= error * along_r / length;
    }
  }
}

}  // namespace

std::vector<SlumpCase> slump_plan() {
  constexpr std::size_t kRounds = 6;
  constexpr std::size_t kNulls = 2;
  constexpr std::array kNoises{1e-3, 0.5e-3, 2e-3};
  std::vector<SlumpCase> plan;
  for (std::size_t round = 0; round < kRounds; ++round) {
    std::size_t k = 0;
    for (const effects::Effect* effect : effects::catalogue()) {
      if (effect->test != effects::TestKind::slump) continue;
      const std::size_t turn = round + k;
      // the plainest first
      plan.push_back(
          {plan.size(), effect, kVisibilities[2 - turn % 3], kNoises[(turn + round / 3 + k / 3) % 3]});
      ++k;
    }
    for (std::size_t n = 0; n < kNulls; ++n) {
      plan.push_back({plan.size(), nullptr, 0.0, kNoises[(round + n) % 3]});
    }
  }
  return plan;
}

tl::expected<MadeSlumpStudy, std::string> make_slump_study(const SlumpCase& one, std::uint64_t seed) {
  std::seed_seq mixed{seed, static_cast<std::uint64_t>(one.number), std::uint64_t{7}};
  std::mt19937_64 random(mixed);
  std::normal_distribution<double> normal;
  const datasets::Study from =
      datasets::read_study(std::filesystem::path(ISOTACH_SOURCE_DIR) / "datasets/mud-a/study.toml");
  const model::Parameters<double> truth = random_truth(from.material, random);
  const OutlineNoise noise = noise_of(one);
  MadeSlumpStudy made{{"synthetic", {}, truth, {}, {}, {}, blank_tests(from, noise), {}}, {truth, {}}};
  effects::Values<double> hidden;
  if (one.effect != nullptr) {
    const auto seeking = [&](int cells) {
      return SlumpGenerator(set_to_seek(made.study.slump_tests, one, cells), truth);
    };
    std::array quick{seeking(kSeekCells[0]), seeking(kSeekCells[1])};
    for (SlumpGenerator& numerics : quick) {
      if (auto failure = numerics.measure({})) return tl::unexpected(*failure);
    }
    const auto error =
        calibration::measure_simulation_error(made.study, truth, calibration::plain_simulation(nullptr), 1);
    if (!error) return tl::unexpected(error.error().message);
    const auto visibility = SlumpVisibility::at(quick, *error, kKnown);
    if (!visibility) return tl::unexpected(std::string("no derivatives at the truth"));
    const auto with = [&](double amplitude) {
      return effects::Values<double>::create({effects::with_amplitude(*one.effect, amplitude)});
    };
    std::map<double, Eigen::VectorXd> lefts;
    const auto shown = [&](double amplitude) -> std::optional<double> {
      const auto on = with(amplitude);
      const auto found = on ? visibility->of(*on) : std::nullopt;
      if (!found) return std::nullopt;
      lefts[amplitude] = found->left;
      return found->ratio;
    };
    const effects::EffectParameter& info = one.effect->parameters[0];
    const Sought sought = seek_visibility(shown, info.typical_si(), info.upper_si(), one.visibility);
    made.amplitude = sought.amplitude;
    made.visibility = sought.visibility;
    made.reached = sought.reached;
    if (!made.reached) return made;
    made.part = plainest_part(quick[0].experiments({}, *error), lefts.at(sought.amplitude));
    hidden = *with(sought.amplitude);
  }
  SlumpGenerator generator(set_to_measure(made.study.slump_tests, one), truth);
  if (auto failure = generator.measure(hidden)) return tl::unexpected(*failure);
  for (std::size_t i = 0; i < generator.tests().size(); ++i) {
    SlumpTest& test = made.study.slump_tests[i];
    test.outlines = generator.tests()[i].outlines;
    add_noise(test, noise, random);
  }
  // oedometer tests know I_v and C_1 so well, and the rest exactly
  model::ParameterValues<double> known = truth.values();
  known[ParameterId::I_v] *= std::exp(kKnown.viscosity * normal(random));
  known[ParameterId::C_1] = std::max(0.0, known[ParameterId::C_1] + kKnown.c1 * normal(random));
  const auto place = [](ParameterId id) { return static_cast<std::size_t>(id); };
  made.knowledge.parameters = *model::Parameters<double>::create(known);
  made.knowledge.priors[place(ParameterId::I_v)] =
      datasets::Prior{known[ParameterId::I_v], kKnown.viscosity * known[ParameterId::I_v]};
  made.knowledge.priors[place(ParameterId::C_1)] = datasets::Prior{known[ParameterId::C_1], kKnown.c1};
  made.study.material = made.knowledge.parameters;
  made.study.fit.slump = {ParameterId::I_v, ParameterId::C_1};
  made.study.fit.bounds[place(ParameterId::I_v)] = datasets::Bounds{0.01, 0.1};
  made.study.fit.bounds[place(ParameterId::C_1)] = datasets::Bounds{0.0, 0.3};
  return made;
}

}  // namespace isotach::bench
