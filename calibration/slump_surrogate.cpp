// Copyright Isotach contributors. SPDX-License-Identifier: BSD-3-Clause
#include "calibration/slump_surrogate.hpp"

#include <Eigen/SVD>
#include <algorithm>
#include <cmath>
#include <optional>
#include <stdexcept>

#include "calibration/latin_hypercube.hpp"
#include "calibration/parallel.hpp"

namespace isotach::calibration {

namespace {

constexpr double kLeftOut = 0.02;  // rms of what further components hold, in units of noise
constexpr Eigen::Index kMostComponents = 12;

Eigen::VectorXd in_box(const CoordinateBox& box, const std::vector<double>& x) {
  Eigen::VectorXd unit(static_cast<Eigen::Index>(x.size()));
  for (std::size_t k = 0; k < x.size(); ++k) {
    unit[static_cast<Eigen::Index>(k)] = (x[k] - box.lower[k]) / (box.upper[k] - box.lower[k]);
  }
  return unit;
}

/// A test whose predictions are some rows of the surrogate's.
class StandIn final : public experiments::Experiment {
 public:
  StandIn(std::shared_ptr<const experiments::Experiment> real,
          std::shared_ptr<const SlumpSurrogate> surrogate, std::vector<Coordinate> coordinates,
          Eigen::Index first)
      : real_(std::move(real)),
        surrogate_(std::move(surrogate)),
        coordinates_(std::move(coordinates)),
        first_(first) {}

  [[nodiscard]] const std::string& name() const override { return real_->name(); }
  [[nodiscard]] bool held_out() const override { return real_->held_out(); }
  [[nodiscard]] const experiments::Values& measured() const override { return real_->measured(); }
  [[nodiscard]] std::string_view quantity() const override { return real_->quantity(); }
  [[nodiscard]] const experiments::Values& noise() const override { return real_->noise(); }
  [[nodiscard]] tl::expected<experiments::Values, experiments::PredictionFailure> predict(
      const model::Parameters<double>& parameters, std::span<const double> /*local*/) const override {
    std::vector<double> x;
    for (const Coordinate& coordinate : coordinates_) {
      const double quantity = parameters[*coordinate.id];
      x.push_back(coordinate.logarithmic ? std::log(quantity) : quantity);
    }
    const Eigen::VectorXd all = surrogate_->values(x);
    const double* begin = all.data() + first_;
    return experiments::Values(begin, begin + real_->measured().size());
  }

 private:
  std::shared_ptr<const experiments::Experiment> real_;
  std::shared_ptr<const SlumpSurrogate> surrogate_;
  std::vector<Coordinate> coordinates_;
  Eigen::Index first_;
};

}  // namespace

bool CoordinateBox::contains(const std::vector<double>& x) const {
  for (std::size_t k = 0; k < x.size(); ++k) {
    if (x[k] < lower[k] || x[k] > upper[k]) return false;
  }
  return true;
}

void add_points(const Problem& problem, const CoordinateBox& box, std::size_t count, unsigned seed,
                int threads, const OptimiserControl& control, TrainingSet& set) {
  std::mt19937_64 random(seed);
  std::vector<std::vector<double>> points = latin_hypercube(count, box.lower.size(), random);
  for (auto& x : points) {
    for (std::size_t k = 0; k < x.size(); ++k) x[k] = box.lower[k] + x[k] * (box.upper[k] - box.lower[k]);
  }
  const Experiments& tests = problem.fitted();
  std::vector<tl::expected<experiments::Values, experiments::PredictionFailure>> runs(count * tests.size());
  std::atomic<int> done{0};
  parallel_for(runs.size(), threads, [&](std::size_t i) {
    if (control.stopped()) {
      runs[i] = tl::unexpected(experiments::PredictionFailure{"interrupted", true});
      return;
    }
    const auto parameters = problem.parametrisation().at(points[i / tests.size()]);
    if (!parameters) {
      runs[i] = tl::unexpected(experiments::PredictionFailure{parameters.error()});
      return;
    }
    const experiments::Experiment& test = *tests[i % tests.size()];
    runs[i] = test.predict(*parameters, test.local_values());
    if (control.callback) control.callback(++done, 0.0);
  });
  for (std::size_t p = 0; p < count; ++p) {
    Eigen::VectorXd values(static_cast<Eigen::Index>(problem.value_count()));
    Eigen::Index next = 0;
    bool whole = true;
    for (std::size_t t = 0; t < tests.size() && whole; ++t) {
      const auto& run = runs[p * tests.size() + t];
      whole = run.has_value();
      if (!whole) {
        set.last_failure = run.error().message;
        break;
      }
      for (const double value : *run) values[next++] = value;
    }
    if (whole) {
      set.points.push_back(points[p]);
      set.values.push_back(std::move(values));
    } else {
      ++set.failed;
    }
  }
}

std::size_t SlumpSurrogate::least_points(std::size_t coordinates) {
  return 3 * (coordinates + 1);
}

SlumpSurrogate::SlumpSurrogate(const Problem& problem, const CoordinateBox& box, const TrainingSet& set)
    : box_(box) {
  std::vector<std::size_t> inside;
  for (std::size_t i = 0; i < set.points.size(); ++i) {
    if (box.contains(set.points[i])) inside.push_back(i);
  }
  points_ = inside.size();
  if (points_ < least_points(box.lower.size())) {
    throw std::invalid_argument("too few simulations for a surrogate");
  }
  const auto n = static_cast<Eigen::Index>(points_);
  Eigen::MatrixXd inputs(n, static_cast<Eigen::Index>(box.lower.size()));
  Eigen::MatrixXd values(static_cast<Eigen::Index>(problem.value_count()), n);
  for (Eigen::Index i = 0; i < n; ++i) {
    const std::size_t k = inside[static_cast<std::size_t>(i)];
    inputs.row(i) = in_box(box, set.points[k]);
    values.col(i) = set.values[k];
  }
  mean_ = values.rowwise().mean();
  values.colwise() -= mean_;
  const Eigen::JacobiSVD<Eigen::MatrixXd> svd(values, Eigen::ComputeThinU | Eigen::ComputeThinV);
  const Eigen::VectorXd& sizes = svd.singularValues();
  const double enough = kLeftOut * kLeftOut * static_cast<double>(values.size());
  Eigen::Index kept = 0;
  for (double rest = sizes.squaredNorm(); kept < sizes.size() && kept < kMostComponents && rest > enough;
       ++kept) {
    rest -= sizes[kept] * sizes[kept];
  }
  components_ = svd.matrixU().leftCols(kept);
  error_directions_.resize(values.rows(), kept);
  Eigen::MatrixXd missed = values;  // what is left out, and by how much the processes miss what is not
  for (Eigen::Index c = 0; c < kept; ++c) {
    const Eigen::VectorXd scores = sizes[c] * svd.matrixV().col(c);
    processes_.emplace_back(inputs, scores);
    missed -= components_.col(c) * (scores - processes_.back().left_out()).transpose();
    const double rms = processes_.back().left_out().norm() / std::sqrt(static_cast<double>(points_));
    error_directions_.col(c) = rms * components_.col(c);
  }
  error_ = std::sqrt(missed.squaredNorm() / static_cast<double>(missed.size()));
}

Eigen::VectorXd SlumpSurrogate::values(const std::vector<double>& x) const {
  const Eigen::VectorXd unit = in_box(box_, x);
  Eigen::VectorXd result = mean_;
  for (std::size_t c = 0; c < processes_.size(); ++c) {
    result += processes_[c].mean(unit) * components_.col(static_cast<Eigen::Index>(c));
  }
  return result;
}

Problem with_surrogate(const Problem& problem, std::shared_ptr<const SlumpSurrogate> surrogate) {
  Experiments stand_ins;
  Eigen::Index first = 0;
  for (const auto& test : problem.fitted()) {
    stand_ins.push_back(
        std::make_shared<StandIn>(test, surrogate, problem.parametrisation().coordinates(), first));
    first += static_cast<Eigen::Index>(test->measured().size());
  }
  Problem result = problem.with_fitted(std::move(stand_ins));
  result.set_common_error(problem.common_error().with(surrogate->error_directions()));
  result.set_threads(1);
  return result;
}

}  // namespace isotach::calibration
