// Copyright Isotach contributors. SPDX-License-Identifier: BSD-3-Clause
#include "bench/discovery/slump_study.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <random>

#include "bench/discovery/made_study.hpp"
#include "bench/discovery/plan.hpp"
#include "bench/outline_noise.hpp"
#include "bench/synthetic_oedometer.hpp"
#include "calibration/fit_slump.hpp"
#include "calibration/simulation_error.hpp"
#include "datasets/slump_effects.hpp"
#include "discovery/linear_model.hpp"

namespace isotach::bench {

namespace {

using datasets::SlumpTest;
using model::ParameterId;

// cells across the mould's radius, of the conserving scheme
constexpr int kFitterCells = 6;      // 6.5 mm
constexpr int kReferenceCells = 10;  // 3.9 mm
constexpr int kSeekCells = 8;        // 4.9 mm, where an amplitude is sought
constexpr int kGeneratorCells = 11;  // 3.5 mm
constexpr double kLongest = 10.0;    // s, of mud
constexpr std::size_t kPoints = 30;  // of an outline
// what oedometer tests leave of I_v (relative) and C_1
constexpr double kKnownViscosity = 0.03;
constexpr double kKnownC1 = 0.005;

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

const experiments::Simulate simulate = calibration::plain_simulation(nullptr);

/// Numerics in which an amplitude is sought.
void set_to_seek(SlumpTest& test) {
  set_cells(test.setup.numerics, test, kSeekCells);
}

/// Numerics in which studies are measured: finer and stricter than any that fits use, with stiffer water.
void set_to_measure(SlumpTest& test) {
  mpm::Numerics& numerics = test.setup.numerics;
  set_cells(numerics, test, kGeneratorCells);
  numerics.points_per_cell = 9;
  numerics.tolerance = 1e-3;
  numerics.water_bulk_modulus *= 2.0;
  numerics.courant = 0.6;
  numerics.inertia_scaling = 50.0;
}

/// Tests as they are with some numerics, at the truth.
class Generator {
 public:
  Generator(std::vector<SlumpTest> tests, const model::Parameters<double>& truth,
            const std::function<void(SlumpTest&)>& set_numerics)
      : tests_(std::move(tests)), truth_(truth) {
    for (SlumpTest& test : tests_) set_numerics(test);
  }

  /// Puts what the tests show with the effects in the place of what was measured.
  [[nodiscard]] std::optional<std::string> measure(const effects::Values<double>& effects) {
    for (SlumpTest& test : tests_) {
      const auto result = simulate(test.name, truth_, datasets::with_effects(test.setup, effects));
      if (!result) return test.name + ": " + result.error().message;
      for (std::size_t k = 0; k < test.outlines.size(); ++k) {
        test.outlines[k].points.clear();
        for (const auto& point : experiments::resampled(result->outlines[k].points, kPoints)) {
          test.outlines[k].points.push_back({point.r, point.z});
        }
      }
    }
    return std::nullopt;
  }
  [[nodiscard]] const std::vector<SlumpTest>& tests() const { return tests_; }

  /// The fitted tests as they were measured, with what discovery's simulations are unsure of in their
  /// covariance.
  [[nodiscard]] std::vector<std::shared_ptr<const experiments::SlumpExperiment>> experiments(
      const effects::Values<double>& effects, const calibration::SimulationError& error) const {
    std::vector<std::shared_ptr<const experiments::SlumpExperiment>> all;
    for (std::size_t i = 0; i < tests_.size(); ++i) {
      if (tests_[i].hold_out) continue;
      all.push_back(std::make_shared<experiments::SlumpExperiment>(
          tests_[i], experiments::SlumpModel{
                         .simulate = simulate, .simulation_error = error.of(i), .effects = effects}));
    }
    return all;
  }

  /// Decorrelated distances of the fitted tests' outlines, as they were measured, from those with effects.
  [[nodiscard]] std::optional<Eigen::VectorXd> seen(const effects::Values<double>& effects,
                                                    const model::Parameters<double>& parameters,
                                                    const calibration::SimulationError& error) const {
    std::vector<double> all;
    for (const auto& experiment : experiments(effects, error)) {
      const auto values = experiment->predict(parameters, experiment->local_values());
      if (!values) return std::nullopt;
      all.insert(all.end(), values->begin(), values->end());
    }
    return Eigen::Map<const Eigen::VectorXd>(all.data(), static_cast<Eigen::Index>(all.size()));
  }

 private:
  std::vector<SlumpTest> tests_;
  model::Parameters<double> truth_;
};

/// How plainly effects show in slump tests: by the covariance of their outlines and of discovery's
/// simulations, freed of what the base's parameters and errors that all tests share can do.
class SlumpVisibility {
 public:
  /// Nothing where the truth cannot be simulated.
  static std::optional<SlumpVisibility> at(const Generator& generator, const model::Parameters<double>& truth,
                                           const calibration::SimulationError& error) {
    auto unchanged = generator.seen({}, truth, error);
    if (!unchanged) return std::nullopt;
    const Eigen::MatrixXd shared = calibration::directions_of(error, generator.experiments({}, error));
    const Eigen::Index rows = unchanged->size();
    // with rows that say how far each column may go: one standard error of what is known
    Eigen::MatrixXd columns = Eigen::MatrixXd::Zero(rows + 2 + shared.cols(), 2 + shared.cols());
    for (Eigen::Index k = 0; k < 2; ++k) {
      model::ParameterValues<double> moved = truth.values();
      if (k == 0) {
        moved[ParameterId::I_v] *= std::exp(kKnownViscosity);
      } else {
        moved[ParameterId::C_1] += kKnownC1;
      }
      const auto there = generator.seen({}, *model::Parameters<double>::create(moved), error);
      if (!there) return std::nullopt;
      columns.col(k).head(rows) = *there - *unchanged;
    }
    if (shared.cols() > 0) columns.topRightCorner(rows, shared.cols()) = shared;
    columns.bottomRows(columns.cols()).setIdentity();
    return SlumpVisibility(generator, truth, error, std::move(*unchanged), columns);
  }

  /// Signal to noise; nothing where it cannot be simulated.
  [[nodiscard]] std::optional<double> of(const effects::Values<double>& effects) const {
    const auto there = generator_->seen(effects, truth_, *error_);
    if (!there) return std::nullopt;
    Eigen::VectorXd change = Eigen::VectorXd::Zero(rows_);
    change.head(there->size()) = *there - unchanged_;
    return base_.freed(change).norm();
  }

 private:
  SlumpVisibility(const Generator& generator, const model::Parameters<double>& truth,
                  const calibration::SimulationError& error, Eigen::VectorXd unchanged,
                  const Eigen::MatrixXd& columns)
      : generator_(&generator),
        truth_(truth),
        error_(&error),
        unchanged_(std::move(unchanged)),
        rows_(columns.rows()),
        base_(columns) {}

  const Generator* generator_;
  model::Parameters<double> truth_;
  const calibration::SimulationError* error_;
  Eigen::VectorXd unchanged_;
  Eigen::Index rows_;
  discovery::Projection base_;
};

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
    Generator quick(made.study.slump_tests, truth, set_to_seek);
    if (auto failure = quick.measure({})) return tl::unexpected(*failure);
    const auto error = calibration::measure_simulation_error(made.study, truth, simulate, 1);
    if (!error) return tl::unexpected(error.error().message);
    const auto visibility = SlumpVisibility::at(quick, truth, *error);
    if (!visibility) return tl::unexpected(std::string("no derivatives at the truth"));
    const auto with = [&](double amplitude) {
      return effects::Values<double>::create({effects::with_amplitude(*one.effect, amplitude)});
    };
    const auto shown = [&](double amplitude) -> std::optional<double> {
      const auto on = with(amplitude);
      return on ? visibility->of(*on) : std::nullopt;
    };
    const effects::EffectParameter& info = one.effect->parameters[0];
    const Sought sought = seek_visibility(shown, info.typical_si(), info.upper_si(), one.visibility);
    made.amplitude = sought.amplitude;
    made.visibility = sought.visibility;
    made.reached = sought.reached;
    if (!made.reached) return made;
    hidden = *with(sought.amplitude);
  }
  Generator generator(made.study.slump_tests, truth, set_to_measure);
  if (auto failure = generator.measure(hidden)) return tl::unexpected(*failure);
  for (std::size_t i = 0; i < generator.tests().size(); ++i) {
    SlumpTest& test = made.study.slump_tests[i];
    test.outlines = generator.tests()[i].outlines;
    add_noise(test, noise, random);
  }
  // oedometer tests know I_v and C_1 so well, and the rest exactly
  model::ParameterValues<double> known = truth.values();
  known[ParameterId::I_v] *= std::exp(kKnownViscosity * normal(random));
  known[ParameterId::C_1] = std::max(0.0, known[ParameterId::C_1] + kKnownC1 * normal(random));
  const auto place = [](ParameterId id) { return static_cast<std::size_t>(id); };
  made.knowledge.parameters = *model::Parameters<double>::create(known);
  made.knowledge.priors[place(ParameterId::I_v)] =
      datasets::Prior{known[ParameterId::I_v], kKnownViscosity * known[ParameterId::I_v]};
  made.knowledge.priors[place(ParameterId::C_1)] = datasets::Prior{known[ParameterId::C_1], kKnownC1};
  made.study.material = made.knowledge.parameters;
  made.study.fit.slump = {ParameterId::I_v, ParameterId::C_1};
  made.study.fit.bounds[place(ParameterId::I_v)] = datasets::Bounds{0.01, 0.1};
  made.study.fit.bounds[place(ParameterId::C_1)] = datasets::Bounds{0.0, 0.3};
  return made;
}

}  // namespace isotach::bench
