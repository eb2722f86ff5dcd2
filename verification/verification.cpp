// Copyright Isotach contributors. SPDX-License-Identifier: BSD-3-Clause
#include "verification/verification.hpp"

#include <algorithm>
#include <array>
#include <utility>

#include "verification/closed_forms.hpp"
#include "verification/properties.hpp"

namespace isotach::verification {

namespace {

/// Sizes of the random samples.
struct Sizes {
  std::size_t paths;
  std::size_t cross_checks;
  std::size_t tangents;
  std::size_t properties;
};

Sizes sizes_of(Sampling sampling) {
  return sampling == Sampling::full ? Sizes{100'000, 1000, 2000, 2000} : Sizes{1000, 50, 100, 100};
}

/// Turns the progress of stages into that of the whole by their shares of the time.
class Stages {
 public:
  explicit Stages(const VerificationPlan& plan) : plan_(plan) {}

  /// Starts the stage `what`, which takes `share` of the time of all.
  void start(double share, std::string_view what) {
    done_ += share_;
    share_ = share;
    what_ = what;
    update(0.0);
  }
  void update(double fraction) const {
    if (plan_.progress) plan_.progress(done_ + share_ * fraction, what_);
  }
  [[nodiscard]] bool stopped() const { return plan_.stop != nullptr && plan_.stop->load(); }

 private:
  const VerificationPlan& plan_;
  double done_ = 0.0;
  double share_ = 0.0;
  std::string_view what_;
};

}  // namespace

std::size_t Verification::failed() const {
  return static_cast<std::size_t>(
      std::count_if(checks.begin(), checks.end(), [](const Check& check) { return !check.pass(); }));
}

std::optional<Verification> verify(const VerificationPlan& plan) {
  const Sizes sizes = sizes_of(plan.sampling);
  Stages stages(plan);
  const auto progress = [&stages](double fraction) { stages.update(fraction); };

  stages.start(0.02, "convergence");
  Verification result{plan, {}, convergence_study(), {}, {}, {}, {}, {}};
  const auto add = [&result](std::vector<Check> checks) {
    std::move(checks.begin(), checks.end(), std::back_inserter(result.checks));
  };
  if (stages.stopped()) return std::nullopt;
  stages.start(0.02, "reference numbers");
  result.references = reference_table();
  add(checks_of(result.references));
  stages.start(0.02, "closed forms");
  add(closed_form_checks(result.references.contenders));
  if (stages.stopped()) return std::nullopt;
  add(checks_of(result.convergence));
  if (stages.stopped()) return std::nullopt;
  stages.start(0.04, "cross-checks");
  result.curves = cross_check_curves();
  add(checks_of(result.curves));
  if (stages.stopped()) return std::nullopt;
  stages.start(0.70, "random paths");
  result.random_paths = random_path_study({plan.seed, sizes.paths, 1e-6, sizes.cross_checks, plan.threads},
                                          progress, plan.stop);
  add(checks_of(result.random_paths));
  if (stages.stopped()) return std::nullopt;
  stages.start(0.05, "tangents");
  result.tangents = tangent_study(plan.seed, sizes.tangents, plan.threads, plan.stop);
  add(checks_of(result.tangents));
  if (stages.stopped()) return std::nullopt;
  stages.start(0.05, "properties");
  add(property_checks(plan.seed, sizes.properties, plan.threads, plan.stop));
  if (stages.stopped()) return std::nullopt;
  stages.start(0.10, "work and precision");
  result.work = work_precision_study(progress);
  if (stages.stopped()) return std::nullopt;
  return result;
}

}  // namespace isotach::verification
