// Copyright Isotach contributors. SPDX-License-Identifier: BSD-3-Clause
#include "calibration/simulation_error.hpp"

#include <fmt/format.h>

#include <Eigen/QR>
#include <algorithm>
#include <array>
#include <cmath>
#include <span>

#include "calibration/parallel.hpp"
#include "calibration/reference_numerics.hpp"
#include "datasets/slump_effects.hpp"
#include "experiments/outline_distance.hpp"

namespace isotach::calibration {

namespace {

constexpr std::size_t kPlaces = 24;  // along an outline
constexpr int kManyPoints = 9;       // a cell
// What tests leave open of the material. To first order a fit follows such a change; what it cannot follow is
// a jump: a column that topples beyond some C_1.
constexpr double kViscosityNudge = 0.03;  // of I_v, relative
constexpr double kC1Nudge = 0.005;
// Of incompressible water's difference three quarters; the time step is halved.
constexpr double kStifferWater = 4.0;

/// A study's numerics changed.
struct Change {
  int more_cells = 0;  ///< across the radius
  bool more_points = false;
  bool stiffer_water = false;
};
/// Variance of one more draw over the mean square of as many, and of the wider one that counts as another.
constexpr double kStudent = (kNumericalVariants + 1.0) / (kNumericalVariants - 1.0);
using Changes = std::array<Change, kNumericalVariants>;
constexpr Changes kChanges{{{1}, {2}, {0, true}, {0, true, true}}};
/// Of a reference, which is as fine as can be paid for: larger cells, which cost less.
constexpr Changes kReferenceChanges{{{-1}, {-2}, {0, true}, {0, true, true}}};

int cells_of(const mpm::SlumpSetup& setup) {
  return static_cast<int>(std::max(1.0, std::round(0.5 * setup.mould.diameter / setup.numerics.cell_size)));
}

mpm::SlumpSetup changed(mpm::SlumpSetup setup, const Change& change) {
  setup.numerics.cell_size = 0.5 * setup.mould.diameter / std::max(1, cells_of(setup) + change.more_cells);
  if (change.more_points) setup.numerics.points_per_cell = kManyPoints;
  if (change.stiffer_water) setup.numerics.water_bulk_modulus *= kStifferWater;
  return setup;
}

std::string name_of(const Change& change, const mpm::SlumpSetup& setup) {
  if (change.more_points) {
    const std::string points =
        fmt::format("{} points a cell instead of {}", kManyPoints, setup.numerics.points_per_cell);
    return change.stiffer_water ? fmt::format("{}, water {:g} times as stiff", points, kStifferWater)
                                : points;
  }
  return fmt::format("{} cells across the radius instead of {}", cells_of(setup) + change.more_cells,
                     cells_of(setup));
}

/// Sums over pairs of differences.
struct Moments {
  double squares = 0.0;
  std::size_t count = 0;
  void add(double difference) {
    squares += difference * difference;
    ++count;
  }
  Moments& operator+=(const Moments& other) {
    squares += other.squares;
    count += other.count;
    return *this;
  }
  /// Zero where there is none.
  [[nodiscard]] double mean_square() const { return count == 0 ? 0.0 : squares / static_cast<double>(count); }
  [[nodiscard]] double rms() const { return count == 0 ? std::nan("") : std::sqrt(mean_square()); }
};

/// Product moments of neighbours over their squares, and how far apart they are on average.
struct Neighbours {
  double products = 0.0;
  double squares = 0.0;
  double apart = 0.0;
  std::size_t count = 0;
  void add(double a, double b, double distance) {
    products += a * b;
    squares += 0.5 * (a * a + b * b);
    apart += distance;
    ++count;
  }
  /// The length of exp(-distance/length), within limits; `otherwise` where nothing is known.
  [[nodiscard]] double length(double otherwise, double least, double most) const {
    if (count == 0 || !(squares > 0.0)) return otherwise;
    const double correlation = std::clamp(products / squares, 1e-6, 1.0 - 1e-6);
    return std::clamp(-apart / static_cast<double>(count) / std::log(correlation), least, most);
  }
};

/// Differences while the mould is there, and later.
struct Sizes {
  Moments outline;
  Moments lifting;
};

/// Distances of places along an outline from another, outwards.
std::vector<double> distances_between(const mpm::Outline& from, const mpm::Outline& to) {
  std::vector<double> distances;
  for (const mpm::OutlinePoint& point : experiments::resampled(from.points, kPlaces)) {
    distances.push_back(experiments::signed_distance(point, to.points));
  }
  return distances;
}

double rms_of(const std::vector<double>& values) {
  Moments moments;
  for (const double value : values) moments.add(value);
  return moments.rms();
}

/// What the differences of one test say, outline by outline.
struct OfTest {
  std::vector<Moments> variants;  ///< when its numerics change
  std::vector<Moments> bends;     ///< when its material changes to either side, beyond first order
};

/// What the differences of tests say.
class Differences {
 public:
  explicit Differences(std::size_t tests) : of_tests_(tests) {}

  /// Between two runs of a test that differ in their numerics; `variant` is of one variant of all tests.
  void add(std::size_t test, const mpm::SlumpResult& base, const mpm::SlumpResult& other,
           const mpm::SlumpSetup& setup, Sizes& variant) {
    std::vector<Moments>& own = of_tests_[test].variants;
    own.resize(base.outlines.size());
    std::vector<double> before;
    for (std::size_t k = 0; k < base.outlines.size(); ++k) {
      const double time = setup.times[k];
      const bool gone = setup.mould.rim(time) >= base.outlines[k].height();
      std::vector<double> now = distances_between(base.outlines[k], other.outlines[k]);
      for (const double distance : now) {
        own[k].add(distance);
        for (Sizes* sizes : {&variant, &all_}) (gone ? sizes->outline : sizes->lifting).add(distance);
      }
      // by their own size, so that outlines which hardly differ count as much
      const double size = rms_of(now);
      for (double& distance : now) distance = size > 0.0 ? distance / size : 0.0;
      for (std::size_t i = 1; i < now.size(); ++i) {
        along_.add(now[i - 1], now[i], 1.0 / static_cast<double>(kPlaces - 1));
      }
      for (std::size_t i = 0; i < before.size(); ++i) {
        in_time_.add(before[i], now[i], std::abs(std::log(time / setup.times[k - 1])));
      }
      before = std::move(now);
    }
  }
  /// Between a run of a test and the mean of two whose material lies as far to either side.
  void add_bend(std::size_t test, const mpm::SlumpResult& base, const mpm::SlumpResult& less,
                const mpm::SlumpResult& more) {
    std::vector<Moments>& own = of_tests_[test].bends;
    own.resize(base.outlines.size());
    for (std::size_t k = 0; k < base.outlines.size(); ++k) {
      const std::vector<double> below = distances_between(base.outlines[k], less.outlines[k]);
      const std::vector<double> above = distances_between(base.outlines[k], more.outlines[k]);
      for (std::size_t i = 0; i < below.size(); ++i) own[k].add(0.5 * (below[i] + above[i]));
    }
  }

  [[nodiscard]] experiments::SharedError error() const {
    experiments::SharedError error;
    const double outline = all_.outline.rms();
    const double lifting = all_.lifting.rms();
    error.outline = std::isfinite(outline) ? outline : lifting;
    error.lifting = std::isfinite(lifting) ? lifting : outline;
    error.along = along_.length(error.along, 0.02, 1.0);
    error.in_time = in_time_.length(error.in_time, 0.1, 10.0);
    return error;
  }

  /// That of a test: what numerics do to each of its outlines, with what they do to the test and to all tests
  /// as one variant more each, and how far it bends.
  [[nodiscard]] experiments::SharedError error_of(std::size_t test) const {
    experiments::SharedError own = error();
    const OfTest& of = of_tests_[test];
    Moments all = all_.outline;
    all += all_.lifting;
    Moments whole;
    for (const Moments& outline : of.variants) whole += outline;
    const double pooled = shrunk(whole, all.mean_square());
    for (std::size_t k = 0; k < of.variants.size(); ++k) {
      const double bent = k < of.bends.size() ? of.bends[k].mean_square() : 0.0;
      own.sizes.push_back(std::sqrt(kStudent * shrunk(of.variants[k], pooled) + bent));
    }
    return own;
  }

 private:
  /// Mean square with a wider one as one variant more.
  static double shrunk(const Moments& own, double wider) {
    const double more = std::max(1.0, static_cast<double>(own.count) / kNumericalVariants);
    return (own.squares + more * wider) / (static_cast<double>(own.count) + more);
  }

  Sizes all_;
  std::vector<OfTest> of_tests_;
  Neighbours along_;
  Neighbours in_time_;
};

using Run = tl::expected<mpm::SlumpResult, mpm::RunFailure>;

/// A constant of the material, changed to either side.
struct Nudge {
  model::ParameterId id;
  double size;
};

/// The material itself, and it with each constant less and more; nothing where that is none.
std::vector<std::optional<model::Parameters<double>>> nudged(const model::Parameters<double>& parameters) {
  const std::array nudges{Nudge{model::ParameterId::I_v, kViscosityNudge * parameters.I_v()},
                          Nudge{model::ParameterId::C_1, kC1Nudge}};
  std::vector<std::optional<model::Parameters<double>>> all{parameters};
  for (const Nudge& nudge : nudges) {
    for (const double side : {-1.0, 1.0}) {
      model::ParameterValues<double> values = parameters.values();
      values[nudge.id] += side * nudge.size;
      const auto there = model::Parameters<double>::create(values);
      all.push_back(there ? std::optional(*there) : std::nullopt);
    }
  }
  return all;
}

/// Adds how far simulations as fits make them bend where the material changes to either side. `at_best` are
/// those by the best numerics of each test.
tl::expected<void, FitFailure> bend(const std::vector<const datasets::SlumpTest*>& tests,
                                    std::span<const Run> at_best, const effects::Values<double>& effects,
                                    const model::Parameters<double>& parameters,
                                    const experiments::Simulate& simulate, int threads,
                                    Differences& differences) {
  const auto materials = nudged(parameters);
  std::vector<std::optional<Run>> runs(tests.size() * materials.size());
  parallel_for(runs.size(), threads, [&](std::size_t i) {
    const datasets::SlumpTest& test = *tests[i / materials.size()];
    const std::size_t k = i % materials.size();
    if (!materials[k] || (k == 0 && !test.reference)) return;  // else it is one of at_best
    runs[i] = simulate(test.name, *materials[k], datasets::with_effects(test.setup, effects));
  });
  for (const auto& run : runs) {
    if (run && !*run && run->error().status == mpm::RunStatus::interrupted) {
      return tl::unexpected(FitFailure{"interrupted", true});
    }
  }
  for (std::size_t t = 0; t < tests.size(); ++t) {
    const std::optional<Run>* own = &runs[t * materials.size()];
    const Run& base = own[0] ? *own[0] : at_best[t];
    for (std::size_t k = 1; k < materials.size(); k += 2) {
      const bool there = base && own[k] && *own[k] && own[k + 1] && *own[k + 1];
      if (there) differences.add_bend(t, *base, **own[k], **own[k + 1]);
    }
  }
  return {};
}

}  // namespace

tl::expected<SimulationError, FitFailure> measure_simulation_error(
    const datasets::Study& study, const model::Parameters<double>& parameters,
    const experiments::Simulate& simulate, int threads) {
  std::vector<const datasets::SlumpTest*> tests;
  for (const datasets::SlumpTest& test : study.slump_tests) {
    if (!test.hold_out) tests.push_back(&test);
  }
  constexpr std::size_t kVariants = kNumericalVariants;
  const Changes& changes = has_reference(study) ? kReferenceChanges : kChanges;
  // the last run of each test is that of the study's numerics
  std::vector<Run> runs(tests.size() * (kVariants + 1));
  parallel_for(runs.size(), threads, [&](std::size_t i) {
    const datasets::SlumpTest& test = *tests[i % tests.size()];
    const std::size_t variant = i / tests.size();
    const mpm::SlumpSetup setup = datasets::with_effects(test.best_setup(), study.effects);
    runs[i] = simulate(test.name, parameters, variant < kVariants ? changed(setup, changes[variant]) : setup);
  });
  SimulationError result;
  Differences differences(tests.size());
  std::string last_failure;
  const std::size_t bases = tests.size() * kVariants;
  for (const auto& run : runs) {
    if (run) continue;
    if (run.error().status == mpm::RunStatus::interrupted)
      return tl::unexpected(FitFailure{"interrupted", true});
    last_failure = run.error().message;
  }
  const auto bent =
      bend(tests, std::span(runs).subspan(bases), study.effects, parameters, simulate, threads, differences);
  if (!bent) return tl::unexpected(bent.error());
  bool any = false;
  for (std::size_t variant = 0; variant < kVariants; ++variant) {
    NumericalVariant found;
    found.name = name_of(changes[variant], tests.front()->best_setup());
    Sizes sizes;
    for (std::size_t t = 0; t < tests.size(); ++t) {
      const auto& base = runs[bases + t];
      const auto& other = runs[variant * tests.size() + t];
      if (!other) ++found.failed;
      if (!base || !other) continue;
      differences.add(t, *base, *other, tests[t]->setup, sizes);
      any = true;
    }
    for (std::size_t t = 0; t < tests.size(); ++t) {
      auto& run = runs[variant * tests.size() + t];
      found.runs.push_back(run ? std::optional(std::move(*run)) : std::nullopt);
    }
    found.outline = sizes.outline.rms();
    found.lifting = sizes.lifting.rms();
    result.variants.push_back(std::move(found));
  }
  for (std::size_t t = 0; t < tests.size(); ++t) {
    auto& run = runs[bases + t];
    result.failed += run ? 0U : 1U;
    result.runs.push_back(run ? std::optional(std::move(*run)) : std::nullopt);
  }
  if (!any) {
    return tl::unexpected(FitFailure{
        "the error of the simulations cannot be measured at the start values: " + last_failure, false});
  }
  result.error = differences.error();
  std::size_t fitted = 0;
  for (const datasets::SlumpTest& test : study.slump_tests) {
    result.of_tests.push_back(test.hold_out ? result.error : differences.error_of(fitted++));
  }
  return result;
}

Eigen::VectorXd stacked_change(const std::vector<std::shared_ptr<const experiments::SlumpExperiment>>& tests,
                               const std::vector<std::optional<mpm::SlumpResult>>& from,
                               const std::vector<std::optional<mpm::SlumpResult>>& to) {
  std::size_t rows = 0;
  for (const auto& test : tests) rows += test->measured().size();
  Eigen::VectorXd change = Eigen::VectorXd::Zero(static_cast<Eigen::Index>(rows));
  Eigen::Index row = 0;
  for (std::size_t t = 0; t < tests.size(); ++t) {
    const auto count = static_cast<Eigen::Index>(tests[t]->measured().size());
    if (from[t] && to[t]) {
      const experiments::Values there = tests[t]->decorrelated(tests[t]->distances(*to[t]));
      const experiments::Values here = tests[t]->decorrelated(tests[t]->distances(*from[t]));
      for (Eigen::Index i = 0; i < count; ++i) {
        const auto k = static_cast<std::size_t>(i);
        change[row + i] = there[k] - here[k];
      }
    }
    row += count;
  }
  return change;
}

Eigen::MatrixXd directions_of(
    const SimulationError& error,
    const std::vector<std::shared_ptr<const experiments::SlumpExperiment>>& fitted) {
  const auto all_ran = [](const std::vector<std::optional<mpm::SlumpResult>>& runs) {
    return std::all_of(runs.begin(), runs.end(), [](const auto& run) { return run.has_value(); });
  };
  std::vector<Eigen::VectorXd> columns;
  for (const NumericalVariant& variant : error.variants) {
    if (!all_ran(error.runs) || !all_ran(variant.runs)) continue;
    columns.push_back(stacked_change(fitted, error.runs, variant.runs));
  }
  if (columns.empty()) return {};
  Eigen::MatrixXd directions(columns.front().size(), static_cast<Eigen::Index>(columns.size()));
  for (std::size_t k = 0; k < columns.size(); ++k) directions.col(static_cast<Eigen::Index>(k)) = columns[k];
  return directions;
}

std::vector<NumericalShift> numerical_shifts(
    const Linearised& at, const CommonError& common,
    const std::vector<std::shared_ptr<const experiments::SlumpExperiment>>& tests,
    const SimulationError& error) {
  const Eigen::CompleteOrthogonalDecomposition<Eigen::MatrixXd> solver(at.jacobian);
  std::vector<NumericalShift> shifts;
  for (const NumericalVariant& variant : error.variants) {
    Eigen::VectorXd difference = Eigen::VectorXd::Zero(at.jacobian.rows());  // priors below stay zero
    const Eigen::VectorXd change = common.whitened(stacked_change(tests, error.runs, variant.runs));
    difference.head(change.size()) = change;
    shifts.push_back({variant.name, -solver.solve(difference)});
  }
  return shifts;
}

Eigen::MatrixXd numerical_covariance(const std::vector<NumericalShift>& shifts, Eigen::Index coordinates) {
  Eigen::MatrixXd covariance = Eigen::MatrixXd::Zero(coordinates, coordinates);
  for (const NumericalShift& shift : shifts) covariance += shift.shift * shift.shift.transpose();
  return covariance;
}

}  // namespace isotach::calibration
