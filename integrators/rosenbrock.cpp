// Copyright Isotach contributors. SPDX-License-Identifier: BSD-3-Clause
// The substeps of the Rosenbrock method and their control.
#include "integrators/rosenbrock.hpp"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <cstddef>

#include "integrators/increment_system.hpp"
#include "integrators/rosenbrock_tableau.hpp"

namespace isotach::integrators {

namespace {

using Scheme = Rodas5P;
constexpr double kErrorExponent = 1.0 / (Scheme::kEmbeddedOrder + 1);

/// The trial substeps of one increment.
template <model::Fabric K>
class Substeps {
 public:
  using System = IncrementSystem<K>;
  using Unknowns = typename System::Unknowns;

  Substeps(System& system, const Tolerance& tolerance) : system_(system), tolerance_(tolerance) {}

  /// Starts the next substep at y; false where there is no rate.
  [[nodiscard]] bool start(const Unknowns& y) {
    y_ = y;
    return system_.rate_and_jacobian(y, rate_, jacobian_);
  }

  /// A first substep (s) with an error near the tolerance, at most `longest`. With y'' = J y' exact and
  /// 1/theta = |y''|/|y'|, each in units of the tolerance, the n-th derivative is guessed as
  /// |y'|/theta^(n-1).
  [[nodiscard]] double first_substep(double longest) const {
    constexpr double kErrorConstant = 0.01;
    const double speed = scaled_size(y_, rate_);
    const double change = scaled_size(y_, jacobian_ * rate_.template head<System::kState>()) / speed;
    const double error_at_one_second = kErrorConstant * speed * std::pow(change, Scheme::kEmbeddedOrder);
    const double h = std::pow(error_at_one_second, -kErrorExponent);
    return h > 0.0 ? std::min(h, longest) : longest;  // not a number where nothing moves
  }

  /// Tries a substep of h (s); its error in units of the tolerance, infinite where it cannot be taken.
  [[nodiscard]] double attempt(double h, Unknowns& end) {
    Matrix matrix = -jacobian_.template topRows<System::kState>();
    matrix.diagonal().array() += 1.0 / (h * Scheme::kGamma);
    factors_.compute(matrix);
    solve_stage(0, h, rate_);
    for (std::size_t i = 1; i < Scheme::kStages; ++i) {
      end = y_;
      for (std::size_t j = 0; j < i; ++j) end += Scheme::kA[i][j] * stage(j);
      Unknowns right;
      if (!system_.rate(end, right)) return HUGE_VAL;
      for (std::size_t j = 0; j < i; ++j) right += (Scheme::kC[i][j] / h) * stage(j);
      solve_stage(i, h, right);
    }
    const auto last = stage(Scheme::kStages - 1);
    end += last;
    if (!system_.contains(system_.template state<double>(end))) return HUGE_VAL;
    const double error = scaled_size(end, last);
    return std::isnan(error) ? HUGE_VAL : error;
  }

 private:
  using Matrix = Eigen::Matrix<double, System::kState, System::kState>;

  [[nodiscard]] auto stage(std::size_t i) { return stages_.col(static_cast<Eigen::Index>(i)); }

  // nothing depends on the strain, so that its part follows from that of the state
  void solve_stage(std::size_t i, double h, const Unknowns& right) {
    auto k = stage(i);
    k.template head<System::kState>() = factors_.solve(right.template head<System::kState>());
    k.template tail<6>() =
        (h * Scheme::kGamma) *
        (right.template tail<6>() + jacobian_.template bottomRows<6>() * k.template head<System::kState>());
  }

  /// |difference| in units of the tolerance at y: the largest of those of T, e, Omega and the strain; NaN
  /// stays.
  [[nodiscard]] double scaled_size(const Unknowns& y, const Unknowns& difference) const {
    const double relative = tolerance_.relative;
    double result = 0.0;
    const auto include = [&result](double size, double unit) {
      if (!(size / unit <= result)) result = size / unit;
    };
    include(difference.template head<6>().norm(),
            relative * y.template head<6>().norm() + tolerance_.absolute_stress / system_.stress_scale());
    include(std::abs(difference[6]), relative * (1.0 + y[6]) + tolerance_.absolute_void_ratio);
    if constexpr (K == model::Fabric::omega) {
      include(difference.template segment<6>(7).norm(),
              relative * (1.0 + y.template segment<6>(7).norm()) + tolerance_.absolute_omega);
    }
    include(difference.template tail<6>().norm(), relative * (1.0 + y.template tail<6>().norm()));
    return result;
  }

  System& system_;
  const Tolerance& tolerance_;
  Unknowns y_;
  Unknowns rate_;
  typename System::Jacobian jacobian_;
  Eigen::PartialPivLU<Matrix> factors_;
  Eigen::Matrix<double, System::kUnknowns, static_cast<int>(Scheme::kStages)> stages_;
};

/// How much longer or shorter the next substep should be.
class StepControl {
 public:
  /// After a rejected substep.
  [[nodiscard]] double shrink(double error) {
    rejected_ = true;
    return std::isfinite(error) ? std::max(kSmallestShrink, plain(error)) : kSmallestShrink;
  }

  /// After an accepted substep of h. Where substeps grow steadily, as over a hold, the error of the next is
  /// foreseen from the last two.
  [[nodiscard]] double growth(double h, double error) {
    constexpr double kLeastError = 1e-10;  // keeps the powers finite
    constexpr double kLeastMemory = 1e-2;  // a much smaller error was luck, or there was nothing to do
    const double bounded = std::max(error, kLeastError);
    double growth = plain(bounded);
    if (last_h_ > 0.0) {
      growth =
          std::min(growth, plain(bounded) * h / last_h_ * std::pow(last_error_ / bounded, kErrorExponent));
    }
    growth = std::clamp(growth, kSmallestShrink, rejected_ ? 1.0 : kLargestGrowth);
    last_h_ = h;
    last_error_ = std::max(bounded, kLeastMemory);
    rejected_ = false;
    return growth;
  }

 private:
  static constexpr double kLargestGrowth = 10.0;
  static constexpr double kSmallestShrink = 0.1;

  [[nodiscard]] static double plain(double error) {
    constexpr double kSafety = 0.9;
    return kSafety * std::pow(error, -kErrorExponent);
  }

  double last_h_ = 0.0;
  double last_error_ = 0.0;
  bool rejected_ = false;
};

template <model::Fabric K>
tl::expected<Integrated<double>, Failure> solve(const model::Law<double>& law,
                                                const model::State<double>& start,
                                                const Increment<double>& increment,
                                                const Tolerance& tolerance, double first_substep) {
  IncrementSystem<K> system(law, increment, start.stress.norm());
  Substeps<K> substeps(system, tolerance);
  typename Substeps<K>::Unknowns y;
  typename Substeps<K>::Unknowns end;
  system.start(model::in_form<K>(start), y);
  Statistics statistics;
  double reached = 0.0;
  const auto state = [&] { return model::with_omega(system.template state<double>(y)); };
  const auto count = [&] {
    statistics.evaluations = system.evaluations();
    statistics.jacobians = system.jacobians();
  };
  const auto failure = [&](FailureKind kind) {
    count();
    return tl::unexpected(Failure{kind, reached, state(), statistics});
  };

  if (!substeps.start(y)) return failure(FailureKind::outside_domain);
  StepControl control;
  double proposed = first_substep > 0.0 ? first_substep : substeps.first_substep(increment.duration);
  while (reached < increment.duration) {
    if (statistics.accepted + statistics.rejected >= tolerance.max_substeps) {
      return failure(FailureKind::too_many_substeps);
    }
    if (!(reached + proposed > reached)) return failure(FailureKind::substep_underflow);
    const double left = increment.duration - reached;
    const double h = std::min(proposed, left);
    const double error = substeps.attempt(h, end);
    if (error > 1.0) {
      ++statistics.rejected;
      proposed = h * control.shrink(error);
      continue;
    }
    ++statistics.accepted;
    y = end;
    reached = h < left ? reached + h : increment.duration;
    const double grown = h * control.growth(h, error);
    proposed = h < proposed ? std::max(proposed, grown) : grown;
    if (reached < increment.duration && !substeps.start(y)) return failure(FailureKind::outside_domain);
  }
  count();
  return Integrated<double>{state(), system.strain(y), proposed, statistics};
}

}  // namespace

tl::expected<Integrated<double>, Failure> integrate_rosenbrock(const model::Law<double>& law,
                                                               const model::State<double>& start,
                                                               const Increment<double>& increment,
                                                               const Tolerance& tolerance,
                                                               double first_substep) {
  if (!(increment.duration > 0.0)) {
    return Integrated<double>{start, model::Mandel<double>::Zero(), first_substep, {}};
  }
  if (!law.in_domain(start)) return tl::unexpected(Failure{FailureKind::outside_domain, 0.0, start});
  if (law.stays_upright(start)) {
    return solve<model::Fabric::none>(law, start, increment, tolerance, first_substep);
  }
  return solve<model::Fabric::omega>(law, start, increment, tolerance, first_substep);
}

}  // namespace isotach::integrators
