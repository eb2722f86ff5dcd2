// Copyright Isotach contributors. SPDX-License-Identifier: BSD-3-Clause
#include "discovery/next_experiment.hpp"

#include <Eigen/Cholesky>
#include <cmath>
#include <memory>
#include <stdexcept>
#include <vector>

#include "discovery/linear_model.hpp"

namespace isotach::discovery {

namespace {

using datasets::OedometerRow;
using datasets::OedometerTest;
using datasets::Stage;

enum class Added { nothing, rest, loop };

struct Variation {
  const char* words;
  double height;  ///< factor
  double time;    ///< factor: the same strains or loads, so much slower
  Added added;    ///< behind the last reading
};
constexpr Variation kVariations[] = {
    {"at twice the height", 2.0, 1.0, Added::nothing},
    {"at half the height", 0.5, 1.0, Added::nothing},
    {"ten times faster", 1.0, 0.1, Added::nothing},
    {"ten times slower", 1.0, 10.0, Added::nothing},
    {"at twice the height, ten times faster", 2.0, 0.1, Added::nothing},
    {"followed by a day's relaxation", 1.0, 1.0, Added::rest},
    {"followed by unloading and reloading by 2 % of strain", 1.0, 1.0, Added::loop}};
constexpr double kDay = 86400.0;
constexpr double kLoop = 0.02;          // engineering strain
constexpr std::size_t kAddedRows = 20;  // of each stage
constexpr double kFirstReading = 1e-3;  // of a relaxation's duration

void add_rest(OedometerTest& test) {
  const OedometerRow last = test.record.rows.back();
  for (std::size_t i = 1; i <= kAddedRows; ++i) {
    OedometerRow row = last;
    row.line += i;
    row.stage = Stage::relax;
    const double share = static_cast<double>(i) / static_cast<double>(kAddedRows);
    row.time += kDay * std::pow(kFirstReading, 1.0 - share);
    test.record.rows.push_back(row);
  }
}

/// At the mean rate of the test's last loading.
void add_loop(OedometerTest& test) {
  auto& rows = test.record.rows;
  const OedometerRow last = rows.back();
  std::size_t from = rows.size() - 1;
  while (from > 0 && rows[from].stage == Stage::load) --from;
  const double strain = last.axial_strain - rows[from].axial_strain;
  const double rate = strain / (last.time - rows[from].time);
  if (!(rate > 0.0)) throw std::invalid_argument("the test does not end with loading");
  for (const bool back : {true, false}) {
    const OedometerRow start = rows.back();
    for (std::size_t i = 1; i <= kAddedRows; ++i) {
      const double change = kLoop * static_cast<double>(i) / static_cast<double>(kAddedRows);
      OedometerRow row = start;
      row.line += i;
      row.stage = back ? Stage::unload : Stage::load;
      row.axial_strain += back ? -change : change;
      row.time += change / rate;
      rows.push_back(row);
    }
  }
}

/// Throws std::invalid_argument for a variation that is no test.
OedometerTest with(OedometerTest test, const Variation& variation) {
  if (test.record.rows.empty()) throw std::invalid_argument("no readings");
  test.height *= variation.height;
  const double begin = test.record.rows.front().time;
  for (OedometerRow& row : test.record.rows) row.time = begin + variation.time * (row.time - begin);
  if (variation.added == Added::nothing) return test;
  if (test.record.control != datasets::Control::strain) {
    throw std::invalid_argument("only a strain-controlled test is gone on with");
  }
  if (variation.added == Added::rest) {
    add_rest(test);
  } else {
    add_loop(test);
  }
  return test;
}

/// What an explanation says of a test, and what it leaves open.
struct Outlook {
  experiments::Values values;
  Eigen::MatrixXd open;  ///< covariance of the values
};

/// One explanation of the present tests.
class Explanation {
 public:
  Explanation(const datasets::Study& study, const Candidate& candidate,
              const std::vector<calibration::ExperimentWeights>& weights, int threads)
      : study_(study), candidate_(candidate), threads_(threads) {
    const auto linear =
        LinearModel::of(study, candidate, weights, candidate.fit.result.main.coordinates, threads);
    if (linear) covariance_ = linear->covariance();
  }

  /// Of a test in the place of the fitted one of its name.
  [[nodiscard]] std::optional<Outlook> on(const OedometerTest& test) const {
    if (covariance_.size() == 0) return std::nullopt;
    calibration::OedometerFit fit = candidate_.fit;
    std::size_t experiment = 0;
    while (fit.experiments[experiment]->name() != test.name) ++experiment;
    const experiments::OedometerExperiment& from = *fit.experiments[experiment];
    fit.experiments[experiment] =
        std::make_shared<experiments::OedometerExperiment>(test, from.effects(), from.free_effects());
    std::size_t place = 0;  // among those fitted
    for (std::size_t i = 0; i < experiment; ++i) place += fit.experiments[i]->held_out() ? 0U : 1U;
    const auto at =
        calibration::problem_of(study_, fit, candidate_.free, threads_)  // its weights are not asked for
            .predictions(fit.result.main.coordinates);
    if (!at) return std::nullopt;
    const Eigen::MatrixXd& jacobian = (*at)[place].jacobian;
    return Outlook{(*at)[place].values, jacobian * covariance_ * jacobian.transpose()};
  }

 private:
  const datasets::Study& study_;
  const Candidate& candidate_;
  int threads_;
  Eigen::MatrixXd covariance_;
};

std::optional<double> separation(const OedometerTest& test, const Explanation& a, const Explanation& b) {
  const auto one = a.on(test);
  const auto other = b.on(test);
  if (!one || !other) return std::nullopt;
  const auto count = static_cast<Eigen::Index>(one->values.size());
  Eigen::MatrixXd covariance = one->open + other->open;
  const experiments::Values noise = experiments::OedometerExperiment(test).noise();
  Eigen::VectorXd difference(count);
  for (Eigen::Index i = 0; i < count; ++i) {
    const auto k = static_cast<std::size_t>(i);
    difference[i] = one->values[k] - other->values[k];
    covariance(i, i) += noise[k] * noise[k];
  }
  const Eigen::LLT<Eigen::MatrixXd> root(covariance);
  if (root.info() != Eigen::Success) return std::nullopt;
  return root.matrixL().solve(difference).norm();
}

}  // namespace

std::optional<OedometerTest> varied(const OedometerTest& test, const std::string& change) {
  for (const Variation& variation : kVariations) {
    if (change != variation.words) continue;
    try {
      return with(test, variation);
    } catch (const std::invalid_argument&) {
      return std::nullopt;
    }
  }
  return std::nullopt;
}

std::optional<NextExperiment> tell_apart(const datasets::Study& study, const Candidate& a, const Candidate& b,
                                         const std::vector<calibration::ExperimentWeights>& weights,
                                         int threads) {
  const Explanation one(study, a, weights, threads);
  const Explanation other(study, b, weights, threads);
  std::optional<NextExperiment> best;
  for (const OedometerTest& test : study.oedometer_tests) {
    if (test.hold_out) continue;
    const auto now = separation(test, one, other);
    for (const Variation& variation : kVariations) {
      const auto changed = varied(test, variation.words);
      if (!changed) continue;
      const auto then = separation(*changed, one, other);
      if (!then || (best && *then <= best->separation)) continue;
      best = NextExperiment{test.name, variation.words, *then, now.value_or(std::nan(""))};
    }
  }
  return best;
}

}  // namespace isotach::discovery
