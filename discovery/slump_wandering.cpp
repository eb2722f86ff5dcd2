// Copyright Isotach contributors. SPDX-License-Identifier: BSD-3-Clause
#include "discovery/slump_wandering.hpp"

#include <algorithm>
#include <cmath>

#include "calibration/corrected_slumps.hpp"
#include "calibration/parallel.hpp"
#include "datasets/slump_effects.hpp"
#include "discovery/limits.hpp"
#include "discovery/linear_model.hpp"
#include "effects/basal_slip.hpp"
#include "effects/wall_adhesion.hpp"

namespace isotach::discovery {

namespace {

using mpm::WanderSlot;

/// Strain rates (1/s) between which slumps are seen: late creep, and the fall of mud let go.
constexpr double kSlowest = 1e-3;
constexpr double kFastest = 10.0;

struct SlotOfSlumps {
  WanderSlot slot;
  WanderedSlot shown;
  double plausible;  ///< size of a change that a test may well show, and the one that is simulated
  const effects::Effect* needs = nullptr;  ///< an effect that tests can have where they can have the slot
};

std::vector<SlotOfSlumps> all_slots() {
  namespace wall = effects::wall_adhesion;
  namespace base = effects::basal_slip;
  const auto typical = [](const effects::Effect& effect) { return effect.parameters[0].typical_si(); };
  // strength to a tenth, as preconsolidation_pressure of oedometer tests
  return {
      {WanderSlot::wall_in_time,
       {"wall_adhesion", &kOverSlumpTime, false, "Pa", 1.0},
       typical(wall::kEffect),
       &wall::kEffect},
      {WanderSlot::base_in_time,
       {"slip_length", &kOverSlumpTime, false, "mm", 1e-3},
       typical(base::kEffect),
       &base::kEffect},
      {WanderSlot::strength_in_time, {"strength", &kOverSlumpTime, true}, 0.1},
      {WanderSlot::strength_in_height, {"strength", &kOverFill, true}, 0.1},
      {WanderSlot::strength_in_rate, {"strength", &kOverRate, true}, 0.1},
  };
}

/// Equally spaced.
std::vector<double> spread(double first, double last) {
  std::vector<double> knots;
  for (std::size_t k = 0; k < kWanderKnots; ++k) {
    knots.push_back(first + (last - first) * static_cast<double>(k) / static_cast<double>(kWanderKnots - 1));
  }
  return knots;
}

/// When the mould's rim leaves the mud as it was filled (s).
double lifted(const mpm::Mould& mould, double last) {
  double before = 0.0;
  double after = last;
  if (mould.rim(last) < mould.fill_height) return last;
  for (int i = 0; i < 40; ++i) {
    const double middle = 0.5 * (before + after);
    (mould.rim(middle) < mould.fill_height ? before : after) = middle;
  }
  return after;
}

/// Knots of a slot in a test, as mpm::Wander has them: a wall acts while the mould is lifted.
std::vector<double> knots_of(WanderSlot slot, const mpm::SlumpSetup& setup) {
  switch (slot) {
    case WanderSlot::strength_in_height:
      return spread(0.0, 1.0);
    case WanderSlot::strength_in_rate:
      return spread(std::log(kSlowest), std::log(kFastest));
    case WanderSlot::wall_in_time: {
      const double end = std::log(lifted(setup.mould, setup.times.back()));
      return spread(end - std::log(8.0), end);
    }
    case WanderSlot::base_in_time:
    case WanderSlot::strength_in_time:
    case WanderSlot::nothing:
      break;
  }
  return spread(std::log(std::min(setup.times.front(), 0.1 * setup.times.back())),
                std::log(setup.times.back()));
}

/// What a hat of plausible height at each knot of each test does to the residuals of all tests, before they
/// are whitened: zero but for those of the test.
using Changes = std::vector<std::vector<Eigen::VectorXd>>;

class SlumpWandering {
 public:
  SlumpWandering(const SlumpBasis& basis, const SlumpCandidate& base, const calibration::CommonError& common)
      : basis_(basis),
        base_(base),
        common_(common),
        fitted_(calibration::fitted_of(base.tests)),
        rows_(rows_of(*base.problem)),
        unchanged_(common.as_read(base.at.residuals)),
        parameters_(base.at.jacobian) {}

  /// Nothing where it could not be simulated.
  tl::expected<std::optional<WanderTrial>, calibration::FitFailure> let_wander(
      const SlotOfSlumps& slot) const {
    auto changes = changes_of(slot);
    if (!changes) return tl::unexpected(changes.error());
    if (changes->empty()) return std::optional<WanderTrial>();
    const Eigen::MatrixXd all = columns_of(slot, *changes);
    Eigen::MatrixXd left = common_.whitened(all);
    for (Eigen::Index k = 0; k < left.cols(); ++k) left.col(k) = parameters_.freed(left.col(k));
    WanderTrial trial = try_slot(slot.shown, left, slot.plausible, base_.at.residuals);
    describe(slot, trial);
    return std::optional(std::move(trial));
  }

 private:
  [[nodiscard]] tl::expected<Changes, calibration::FitFailure> changes_of(const SlotOfSlumps& slot) const {
    using Result = tl::expected<experiments::Values, experiments::PredictionFailure>;
    std::vector<Result> runs(fitted_.size() * kWanderKnots);
    calibration::parallel_for(runs.size(), basis_.threads, [&](std::size_t i) {
      const experiments::SlumpExperiment& test = *fitted_[i / kWanderKnots];
      mpm::Wander wander{slot.slot, knots_of(slot.slot, test.test().setup),
                         std::vector<double>(kWanderKnots, 0.0)};
      wander.change[i % kWanderKnots] = slot.plausible;
      runs[i] = test.predict_wandering(wander, *base_.parameters,
                                       base_.problem->parametrisation().local_of(test, base_.at.coordinates));
    });
    Changes changes(fitted_.size());
    for (std::size_t i = 0; i < runs.size(); ++i) {
      if (!runs[i]) {
        if (runs[i].error().interrupted) return tl::unexpected(calibration::FitFailure{"interrupted", true});
        return Changes{};
      }
      const auto [first, count] = rows_[i / kWanderKnots];
      Eigen::VectorXd change = Eigen::VectorXd::Zero(base_.at.residuals.size());
      change.segment(first, count) =
          Eigen::Map<const Eigen::VectorXd>(runs[i]->data(), count) - unchanged_.segment(first, count);
      changes[i / kWanderKnots].push_back(std::move(change));
    }
    return changes;
  }

  /// A column for each knot: of each test over time, of all tests else.
  [[nodiscard]] static Eigen::MatrixXd columns_of(const SlotOfSlumps& slot, const Changes& changes) {
    const bool own = slot.shown.along == &kOverSlumpTime;
    const auto knots = static_cast<Eigen::Index>(kWanderKnots);
    const auto tests = static_cast<Eigen::Index>(changes.size());
    Eigen::MatrixXd all = Eigen::MatrixXd::Zero(changes.front().front().size(), own ? knots * tests : knots);
    for (Eigen::Index t = 0; t < tests; ++t) {
      for (Eigen::Index k = 0; k < knots; ++k) {
        all.col(own ? t * knots + k : k) += changes[static_cast<std::size_t>(t)][static_cast<std::size_t>(k)];
      }
    }
    return all;
  }

  void describe(const SlotOfSlumps& slot, WanderTrial& trial) const {
    const bool own = slot.shown.along == &kOverSlumpTime;
    Eigen::Index next = 0;
    for (std::size_t t = 0; t < (own ? fitted_.size() : 1); ++t) {
      WanderCurve curve;
      if (own) curve.test = fitted_[t]->name();
      for (const double knot : knots_of(slot.slot, fitted_[t]->test().setup)) {
        curve.at.push_back(slot.shown.along->logarithmic ? std::exp(knot) : knot);
        curve.change.push_back(trial.change[next]);
        curve.std_error.push_back(trial.std_error[next++]);
      }
      trial.slot.curves.push_back(std::move(curve));
    }
  }

  const SlumpBasis& basis_;
  const SlumpCandidate& base_;
  const calibration::CommonError& common_;
  SlumpTests fitted_;
  std::vector<std::pair<Eigen::Index, Eigen::Index>> rows_;
  Eigen::VectorXd unchanged_;  // residuals of the base, not whitened
  Projection parameters_;
};

bool can_have(const SlumpTests& tests, const effects::Effect* effect) {
  return effect == nullptr || std::none_of(tests.begin(), tests.end(), [&](const auto& test) {
           return datasets::why_not(test->test().setup, *effect).has_value();
         });
}

}  // namespace

tl::expected<Wandering, calibration::FitFailure> let_wander(const SlumpBasis& basis,
                                                            const SlumpCandidate& base,
                                                            const calibration::CommonError& common,
                                                            const std::function<void(double)>& progress) {
  const SlumpWandering wandering(basis, base, common);
  const std::vector<SlotOfSlumps> slots = all_slots();
  std::vector<WanderTrial> trials;
  for (std::size_t k = 0; k < slots.size(); ++k) {
    if (progress) progress(static_cast<double>(k) / static_cast<double>(slots.size()));
    if (!can_have(base.tests, slots[k].needs)) continue;
    auto trial = wandering.let_wander(slots[k]);
    if (!trial) return tl::unexpected(trial.error());
    if (*trial) trials.push_back(std::move(**trial));
  }
  return ranked(std::move(trials));
}

}  // namespace isotach::discovery
