// Copyright Isotach contributors. SPDX-License-Identifier: BSD-3-Clause
#include "calibration/profile.hpp"

#include <algorithm>
#include <cmath>

namespace isotach::calibration {

namespace {

constexpr double kCloseEnough = 0.01;  // of the threshold's root
constexpr int kMostSteps = 14;         // outward
constexpr int kMostRefinements = 8;
constexpr double kFarthest = 40.0;  // standard errors

/// One side of a profile. The root of delta grows about linearly from the optimum, which makes steps that
/// aim at the root of the threshold arrive in two or three.
class Side {
 public:
  Side(const Problem& problem, const std::vector<double>& optimum, double least_cost, std::size_t k,
       double direction, double threshold, const OptimiserControl& control, Profile& profile)
      : problem_(problem),
        optimum_(optimum),
        least_cost_(least_cost),
        k_(k),
        direction_(direction),
        target_(std::sqrt(threshold)),
        control_(control),
        profile_(profile),
        best_(optimum) {
    const Coordinate& coordinate = problem.parametrisation().coordinates()[k];
    room_ = direction > 0.0 ? coordinate.upper - optimum[k] : optimum[k] - coordinate.lower;
  }

  void search(double std_error, double& end_x, ProfileEnd& end) {
    const bool known = std::isfinite(std_error) && std_error > 0.0;
    const double farthest = known ? std::min(room_, kFarthest * std_error) : room_;
    double inside = 0.0;  // distance from the optimum; delta is below the threshold there
    double inside_root = 0.0;
    double outside = 0.0;
    double outside_root = 0.0;
    double step = std::min(known ? target_ * std_error : room_ / 8.0, room_);
    bool bracketed = false;
    const auto finish = [&](double distance, ProfileEnd how) {
      end_x = optimum_[k_] + direction_ * distance;
      end = how;
    };
    if (!(room_ > 0.0)) return finish(0.0, ProfileEnd::bound);
    for (int i = 0; i < kMostSteps && !bracketed; ++i) {
      const double root = root_at(step);
      if (stopped()) return finish(inside, ProfileEnd::open);
      if (std::isnan(root)) {
        if (step - inside < 1e-3 * room_ || i + 1 == kMostSteps) {
          return finish(inside, ProfileEnd::unpredictable);
        }
        step = 0.5 * (inside + step);
        continue;
      }
      if (root >= target_) {
        outside = step;
        outside_root = root;
        bracketed = true;
        break;
      }
      inside = step;
      inside_root = root;
      if (step >= room_) return finish(step, ProfileEnd::bound);
      if (step >= farthest) return finish(step, ProfileEnd::open);
      const double growth = root > 0.0 ? std::clamp(1.1 * target_ / root, 1.2, 3.0) : 3.0;
      step = std::min(step * growth, farthest);
    }
    if (!bracketed) return finish(inside, ProfileEnd::open);
    double estimate = outside;
    for (int i = 0; i < kMostRefinements; ++i) {
      estimate = inside + (outside - inside) * (target_ - inside_root) / (outside_root - inside_root);
      const double root = root_at(estimate);
      if (stopped() || std::isnan(root) || std::abs(root - target_) <= kCloseEnough * target_) break;
      (root < target_ ? inside : outside) = estimate;
      (root < target_ ? inside_root : outside_root) = root;
    }
    finish(estimate, ProfileEnd::crossed);
    // for the eye: one point in between
    if (profile_.points.size() < 24) static_cast<void>(root_at(0.5 * estimate));
  }

 private:
  [[nodiscard]] bool stopped() const { return control_.stopped(); }

  /// sqrt(delta) at a distance from the optimum; NaN where nothing can be predicted there.
  double root_at(double distance) {
    std::vector<double> x = optimum_;
    // the others go along as they went to the last point
    const double last = std::abs(best_[k_] - optimum_[k_]);
    if (last > 0.0) {
      for (std::size_t i = 0; i < x.size(); ++i)
        x[i] += (best_[i] - optimum_[i]) * std::min(distance / last, 2.0);
    }
    x[k_] = optimum_[k_] + direction_ * distance;
    CeresOptions options;
    options.held = {k_};
    options.max_iterations = 30;
    options.function_tolerance = 1e-7;
    OptimiserControl quiet;
    quiet.stop = control_.stop;
    OptimiserResult found = minimise_with_ceres(problem_, x, options, quiet);
    if (!std::isfinite(found.cost)) {
      x = optimum_;
      x[k_] = optimum_[k_] + direction_ * distance;
      found = minimise_with_ceres(problem_, x, options, quiet);
      if (!std::isfinite(found.cost)) return std::numeric_limits<double>::quiet_NaN();
    }
    const double delta = 2.0 * (found.cost - least_cost_);
    profile_.points.push_back({x[k_], delta});
    constexpr double kLower = 1e-4;
    if (delta < -kLower && (!profile_.better || delta < better_delta_)) {
      better_delta_ = delta;
      profile_.better = found.coordinates;
    }
    best_ = found.coordinates;
    return std::sqrt(std::max(0.0, delta));
  }

  const Problem& problem_;
  const std::vector<double>& optimum_;
  double least_cost_;
  std::size_t k_;
  double direction_;
  double target_;
  const OptimiserControl& control_;
  Profile& profile_;
  std::vector<double> best_;
  double room_ = 0.0;
  double better_delta_ = 0.0;
};

}  // namespace

std::string_view name_of(ProfileEnd end) {
  switch (end) {
    case ProfileEnd::crossed:
      return "crossed";
    case ProfileEnd::bound:
      return "bound reached";
    case ProfileEnd::open:
      return "open";
    case ProfileEnd::unpredictable:
      return "open: no prediction beyond";
  }
  return "";
}

Profile profile(const Problem& problem, const std::vector<double>& x, std::size_t k, double std_error,
                double threshold, const OptimiserControl& control) {
  Profile result;
  result.coordinate = k;
  result.threshold = threshold;
  result.lower = result.upper = x[k];
  const auto at_optimum = problem.residuals(x);
  if (!at_optimum) {
    result.lower_end = result.upper_end = ProfileEnd::unpredictable;
    return result;
  }
  const double least = cost_of(*at_optimum);
  result.points.push_back({x[k], 0.0});
  Side(problem, x, least, k, -1.0, threshold, control, result)
      .search(std_error, result.lower, result.lower_end);
  Side(problem, x, least, k, 1.0, threshold, control, result)
      .search(std_error, result.upper, result.upper_end);
  std::sort(result.points.begin(), result.points.end(),
            [](const ProfilePoint& a, const ProfilePoint& b) { return a.x < b.x; });
  return result;
}

}  // namespace isotach::calibration
