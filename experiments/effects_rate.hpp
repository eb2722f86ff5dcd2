// Copyright Isotach contributors. SPDX-License-Identifier: BSD-3-Clause
// Confined compression with effects: rates of the specimen and of what it remembers, under what is measured.
#pragma once

#include <algorithm>
#include <cmath>
#include <numbers>

#include "experiments/effects_model.hpp"

namespace isotach::experiments::detail {

/// Right-hand side dy/dt = F(y) of confined compression with effects. With pore pressure under controlled
/// stress the rate of strain x follows from what the pore water carries, u = c x, and relaxes within c/slope,
/// which may be far shorter than a substep, and is zero at zero of the effect. So F is then the mean rate
/// over a substep tau for which x relaxes exponentially to its limit, everything else kept:
///
///   mean x = x_inf + (u - c x_inf)/(slope tau) (1 - exp(-slope tau/c)),  slope x_inf = dA/dt - G_w |D_vis|.
///
/// Refers to model and step, which must outlive it.
template <class S, model::Fabric K>
class EffectsRate {
 public:
  using State = EffectsState<S, K>;
  using Rate = EffectsStateRate<S, K>;

  EffectsRate(const EffectsModel<S>& model, const EffectsStep<S>& step)
      : model_(model), step_(step), relaxes_(step.stress_controlled && model.instrument.holds_water()) {}

  [[nodiscard]] const model::LawTerms<S>& terms() const { return model_.terms; }
  /// Whether F depends on tau.
  [[nodiscard]] bool relaxes() const { return relaxes_; }

  /// F over a substep tau (s, > 0); at tau = 0 the rate at the instant, for which c must not be zero. False
  /// where the state is outside the law's domain or no strain rate gives what is commanded.
  [[nodiscard]] bool operator()(const State& y, double tau, Rate& f) {
    const model::Law<S>& law = model_.law;
    if (!law.in_domain(y.soil)) return false;
    const auto at = law.measures(y.soil);
    const model::LawHistory<S> history = history_of(y);
    const S factor = model_.terms.stiffness_factor(history);
    const Tensor flow = scaled(law.stiffness_times(at, at.m), factor);
    Tensor axial = Tensor::Constant(S(0.0));
    axial[0] = S(1.0);
    const Tensor stiffness = scaled(law.stiffness_times(at, axial), factor);
    // ln(p_B+/p_B), and so |D_vis|, but for the rate dependence of I_v
    const S log_ratio = log_of(at.equivalent_pressure) -
                        model_.terms.log_preconsolidation_pressure(law, y.soil.void_ratio, history);
    const S D_r = model_.terms.reference_rate(law, history);
    if (!find_compression(y, stiffness, flow, log_ratio, D_r, tau)) return false;
    const S& C_1 = law.parameters().C_1();
    const S irreversible = viscous_ + travelled_ * C_1;
    for (int i = 0; i < model::kAxial; ++i) {
      f.soil.stress[i] = -(stiffness[i] * compression_) - flow[i] * irreversible;
    }
    f.soil.void_ratio = -((1.0 + y.soil.void_ratio) * compression_);
    if constexpr (K == model::Fabric::omega) {
      f.soil.omega = model::rotation_rate<S, S, model::kAxial>(law.parameters().C_2(), law.parameters().C_3(),
                                                               at.ratio, y.soil.omega, viscous_);
    }
    f.structure = model_.terms.structure_rate(history, viscous_);
    f.held_strain = step_.held ? viscous_ : S(0.0);
    relaxation_ = relaxation_rate(y, at.m, flow);
    return true;
  }

  [[nodiscard]] bool contains(const State& y) const { return model_.law.in_domain(y.soil); }

  /// Rate of compression x (1/s, logarithmic) of the last call.
  [[nodiscard]] const S& compression() const { return compression_; }

  /// The longest substep (s) that damps what viscous flow damps, as of ConfinedRate, and damps it about as
  /// fast as it decays: what an effect did to a stress that has since relaxed shows in derivatives alone.
  [[nodiscard]] double largest_substep() const {
    constexpr double kDamped = 0.5;
    return relaxation_ > 0.0 ? kDamped / relaxation_ : HUGE_VAL;
  }

  /// The true stress (Pa) at a time within a step that controls it.
  [[nodiscard]] S stress_at(double elapsed) const { return step_.stress + step_.rate * elapsed; }

 private:
  using Tensor = model::Mandel<S, model::kAxial>;

  /// A rate q' = x_part x + viscous_part |D_vis| + |x| C_1 viscous_part of what is controlled.
  struct Controlled {
    S x_part;
    S viscous_part;
    S rate;

    [[nodiscard]] S slope(const S& C_1, bool compression) const {
      const S hypoplastic = viscous_part * C_1;
      return compression ? S(x_part + hypoplastic) : S(x_part - hypoplastic);
    }
  };

  [[nodiscard]] static S log_of(const S& x) {
    using std::log;
    return log(x);
  }
  [[nodiscard]] static S size_of(const S& x) { return model::value_of(x) < 0.0 ? S(-x) : x; }
  [[nodiscard]] static Tensor scaled(const Tensor& a, const S& factor) {
    Tensor result;
    for (int i = 0; i < model::kAxial; ++i) result[i] = a[i] * factor;
    return result;
  }

  [[nodiscard]] model::LawHistory<S> history_of(const State& y) const {
    model::LawHistory<S> history;
    history.structure = y.structure;
    history.held_strain = y.held_strain;
    history.since_reversal = model_.strain_of.size(size_of(y.soil.void_ratio - step_.void_ratio_at_reversal));
    if (model_.terms.temperature) {
      history.temperature_excess =
          step_.temperature + step_.temperature_rate * y.elapsed - model_.reference_temperature;
    }
    return history;
  }

  /// |D_vis| at a strain rate of size |x|, which counts only where I_v depends on it.
  [[nodiscard]] S viscous_at(const S& log_ratio, const S& D_r, const S& size) const {
    using std::exp;
    return exp(log_ratio / model_.terms.viscosity_index(model_.law, size)) * D_r;
  }

  /// Finds compression_, travelled_ and viscous_.
  bool find_compression(const State& y, const Tensor& stiffness, const Tensor& flow, const S& log_ratio,
                        const S& D_r, double tau) {
    if (!solve_at(y, stiffness, flow, log_ratio, D_r)) return false;
    travelled_ = size_of(compression_);
    if (relaxes_) relax(y, controlled_load(y, stiffness, flow), tau);
    return true;
  }

  /// G' = axial + rho (radial - sigma_h x), rho following the height.
  [[nodiscard]] Controlled controlled_load(const State& y, const Tensor& stiffness,
                                           const Tensor& flow) const {
    constexpr double kRadial = 1.0 / std::numbers::sqrt2;
    const S rho = model_.friction_ratio(y.soil.void_ratio, step_.direction);
    return {stiffness[0] + rho * kRadial * (stiffness[1] + y.soil.stress[1]),
            flow[0] + rho * kRadial * flow[1], step_.rate};
  }

  /// The x of the instant, or its limit where it relaxes, and |D_vis|.
  bool solve_at(const State& y, const Tensor& stiffness, const Tensor& flow, const S& log_ratio,
                const S& D_r) {
    const Controlled load = controlled_load(y, stiffness, flow);
    if (step_.stress_controlled) return solve(load, log_ratio, D_r);
    if (!model_.instrument.gives()) {
      compression_ = step_.rate;
      viscous_ = viscous_at(log_ratio, D_r, size_of(compression_));
      return true;
    }
    // (1 - eps) x + g' G' = (1 - eps_m) r; g' has seating only while the load grows beyond its largest
    const S now = model_.load(y.soil, step_.direction);
    const S strain = model_.strain_of(y.soil.void_ratio);
    const bool at_largest = model::value_of(now) >= model::value_of(step_.largest_load);
    const S measured = model_.measured_strain(y.soil.void_ratio, now, at_largest ? now : step_.largest_load);
    for (const bool beyond : {true, false}) {
      if (beyond && !at_largest) continue;
      const S give = model_.instrument.given_per_load(now, beyond);
      const Controlled both{(1.0 - strain) + give * load.x_part, give * load.viscous_part,
                            (1.0 - measured) * step_.rate};
      if (!solve(both, log_ratio, D_r)) return false;
      if (!beyond) break;
      const S irreversible = viscous_ + size_of(compression_) * model_.law.parameters().C_1();
      const double growth = model::value_of(load.x_part * compression_ + load.viscous_part * irreversible);
      if (growth >= 0.0) break;
    }
    return true;
  }

  /// The x with which the controlled quantity has its rate.
  bool solve(const Controlled& controlled, const S& log_ratio, const S& D_r) {
    if (model_.terms.rate_dependence) return solve_rate_dependent(controlled, log_ratio, D_r);
    viscous_ = viscous_at(log_ratio, D_r, S(0.0));
    const S driving = controlled.rate - controlled.viscous_part * viscous_;
    const S slope = controlled.slope(model_.law.parameters().C_1(), model::value_of(driving) > 0.0);
    if (!(model::value_of(slope) > 0.0)) return false;
    compression_ = driving / slope;
    return true;
  }

  /// The same where |D_vis| depends on |x|: Newton's method on plain values, between what the least and the
  /// largest I_v would give, and one step more in S, which makes the derivatives exact.
  bool solve_rate_dependent(const Controlled& controlled, const S& log_ratio, const S& D_r) {
    using model::value_of;
    using Jet = ceres::Jet<double, 1>;
    constexpr int kMostSteps = 100;
    constexpr double kSmallStep = 1e-9;
    const double C_1 = value_of(model_.law.parameters().C_1());
    const double I_v = value_of(model_.law.parameters().I_v());
    const double b = value_of(model_.terms.rate_dependence->b);
    const double D_ref = value_of(model_.terms.rate_dependence->D_ref);
    const double L = value_of(log_ratio);
    const double part = value_of(controlled.viscous_part);
    const double hypoplastic = part * C_1;
    const auto slope = [&](bool compression) {
      return value_of(controlled.x_part) + (compression ? hypoplastic : -hypoplastic);
    };
    if (!(slope(true) > 0.0 && slope(false) > 0.0)) return false;
    const auto viscous = [&](const Jet& size) {
      const Jet power = exp((2.0 / 3.0) * log((size + 1e-150) / D_ref));
      return exp(L / (I_v * (1.0 + b * ((power - 1.0) / (power + 1.0))))) * value_of(D_r);
    };
    const auto with_index = [&](double index) {
      const double driving = value_of(controlled.rate) - part * std::exp(L / index) * value_of(D_r);
      return driving / slope(driving > 0.0);
    };
    double low = std::min(with_index(I_v * (1.0 - b)), with_index(I_v * (1.0 + b)));
    double high = std::max(with_index(I_v * (1.0 - b)), with_index(I_v * (1.0 + b)));
    const double least_step = kSmallStep * std::max(std::abs(low), std::abs(high));
    double x = std::clamp(value_of(compression_), low, high);
    double derivative = 0.0;
    bool converged = false;
    for (int step = 0; step < kMostSteps && !converged; ++step) {
      const bool compression = x > 0.0;
      const Jet jet_x(x, 0);
      const Jet rest = slope(compression) * jet_x + part * viscous(compression ? jet_x : -jet_x) -
                       value_of(controlled.rate);
      derivative = rest.v[0];
      (rest.a > 0.0 ? high : low) = x;
      double next = x - rest.a / derivative;
      if (!(next >= low && next <= high)) next = 0.5 * (low + high);
      converged = std::abs(next - x) <= least_step;
      x = next;
    }
    if (!converged || !(std::abs(derivative) > 0.0)) return false;
    compression_ = S(x);
    const S rest = controlled.slope(model_.law.parameters().C_1(), x > 0.0) * compression_ +
                   controlled.viscous_part * viscous_at(log_ratio, D_r, size_of(compression_)) -
                   controlled.rate;
    compression_ -= rest * (1.0 / derivative);
    viscous_ = viscous_at(log_ratio, D_r, size_of(compression_));
    return true;
  }

  /// Makes of the limit x_inf the mean x over tau. The slope depends on the sign of x, so that where x passes
  /// through zero on its way there are two stretches, u = c x being zero between them.
  void relax(const State& y, const Controlled& load, double tau) {
    using std::log;
    const S c = model_.instrument.pore_pressure_per_rate(model_.strain_of(y.soil.void_ratio));
    const S carried = stress_at(y.elapsed) - model_.load(y.soil, step_.direction);
    const bool tight = !(model::value_of(c) > 0.0);
    if (!(tau > 0.0)) {
      compression_ = carried / c;
      travelled_ = size_of(compression_);
      return;
    }
    const S& C_1 = model_.law.parameters().C_1();
    const bool end_compresses = model::value_of(compression_) > 0.0;
    const S end_slope = load.slope(C_1, end_compresses);
    const S driving = compression_ * end_slope;
    // as a step begins x is known, later it is u/c, and where c is zero it has reached its limit
    const bool begins = y.elapsed == 0.0;
    const double x = begins ? model::value_of(step_.compression)
                            : (tight ? model::value_of(compression_) : model::value_of(carried));
    S squeezed(0.0);  // strain before x passes through zero
    S from = carried;
    S left(tau);
    if ((x > 0.0) != end_compresses && x != 0.0 && model::value_of(driving) != 0.0) {
      const S slope = load.slope(C_1, x > 0.0);
      const S now = begins ? step_.compression : S(carried / c);
      const S turn = c / slope * log(1.0 - slope * now / driving);
      if (model::value_of(turn) >= tau) {
        compression_ = integral_over(slope, driving, c, carried, S(tau)) / tau;
        travelled_ = size_of(compression_);
        return;
      }
      squeezed = (carried + driving * turn) / slope;
      from = S(0.0);
      left -= turn;
    }
    const S rest = integral_over(end_slope, driving, c, from, left);
    compression_ = (squeezed + rest) / tau;
    // the stretches have opposite signs; of one alone it is the size
    travelled_ = (end_compresses ? S(rest - squeezed) : S(squeezed - rest)) / tau;
  }

  /// Integral of x over a time t, where du/dt = driving - slope x and u = c x, from u = `from` on.
  [[nodiscard]] static S integral_over(const S& slope, const S& driving, const S& c, const S& from,
                                       const S& t) {
    using std::exp;
    constexpr double kGone = 700.0;  // exp(-700) is nothing; beyond it c may be zero
    const S limit = driving / slope;
    const S excess = (from - c * limit) / slope;
    if (model::value_of(slope) * model::value_of(t) >= kGone * model::value_of(c)) return limit * t + excess;
    return limit * t + excess * (1.0 - exp(-slope * t / c));
  }

  /// Rate (1/s) at which deviations decay: as of ConfinedRate, or that of structure or delayed creep.
  [[nodiscard]] double relaxation_rate(const State& y, const Tensor& m, const Tensor& flow) const {
    using model::value_of;
    double along = 0.0;
    double stiffness = 0.0;
    for (int i = 0; i < model::kAxial; ++i) {
      along += value_of(m[i]) * value_of(y.soil.stress[i]);
      stiffness += value_of(m[i]) * value_of(flow[i]);
    }
    const double viscous = value_of(viscous_);
    const double I_v = value_of(model_.terms.viscosity_index(model_.law, size_of(compression_)));
    double rate = along > 0.0 ? viscous * stiffness / (I_v * along) : 0.0;
    if (model_.terms.structure) rate = std::max(rate, value_of(model_.terms.structure->k) * viscous);
    if (model_.terms.delayed_creep) rate = std::max(rate, value_of(*model_.terms.delayed_creep) * viscous);
    return rate;
  }

  const EffectsModel<S>& model_;
  const EffectsStep<S>& step_;
  bool relaxes_;
  S compression_ = S(0.0);
  S travelled_ = S(0.0);  // mean of |x|
  S viscous_ = S(0.0);
  double relaxation_ = 0.0;
};

}  // namespace isotach::experiments::detail
