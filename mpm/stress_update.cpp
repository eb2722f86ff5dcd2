// Copyright Isotach contributors. SPDX-License-Identifier: BSD-3-Clause
#include "mpm/stress_update.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "mpm/lanes.hpp"

namespace isotach::mpm {

namespace {

using model::Fabric;
using model::kPlane;

constexpr double kSubstepMargin = 1.2;
constexpr int kMostPackSubsteps = 24;      // beyond, substeps for single points are cheaper
constexpr long kMostPointSubsteps = 1000;  // beyond, the point is on its way out of the domain
constexpr double kFloorTolerance = 0.1;  // of the least pressure: stresses near it need no relative accuracy
constexpr double kHopeless = 1e18;       // squared error of a point that left the law's domain

/// A pack of points and their motion over the step.
template <Fabric K>
struct Pack {
  model::State<Lanes, kPlane, K> state;
  model::Mandel<Lanes, kPlane> strain_rate;
  Eigen::Matrix<Lanes, 3, 1> spin;
};

template <Fabric K>
Pack<K> load(const Particles& particles, std::size_t start) {
  Pack<K> pack;
  for (std::size_t k = 0; k < kPlane; ++k) {
    const int component = static_cast<int>(k);
    pack.state.stress[component] = Lanes::load(&particles.stress[k][start]);
    pack.strain_rate[component] = Lanes::load(&particles.strain_rate[k][start]);
    if constexpr (K == Fabric::omega) pack.state.omega[component] = Lanes::load(&particles.omega[k][start]);
  }
  pack.state.void_ratio = Lanes::load(&particles.void_ratio[start]);
  pack.spin[0] = Lanes::load(&particles.spin[start]);
  pack.spin[1] = pack.spin[2] = Lanes(0.0);
  return pack;
}

template <Fabric K>
void store(const model::State<Lanes, kPlane, K>& state, Particles& particles, std::size_t start) {
  for (std::size_t k = 0; k < kPlane; ++k) {
    const int component = static_cast<int>(k);
    state.stress[component].store(&particles.stress[k][start]);
    if constexpr (K == Fabric::omega) state.omega[component].store(&particles.omega[k][start]);
  }
  state.void_ratio.store(&particles.void_ratio[start]);
}

template <Fabric K>
void store(const model::State<double, kPlane, K>& state, Particles& particles, std::size_t i) {
  for (std::size_t k = 0; k < kPlane; ++k) {
    particles.stress[k][i] = state.stress[static_cast<int>(k)];
    if constexpr (K == Fabric::omega) particles.omega[k][i] = state.omega[static_cast<int>(k)];
  }
  particles.void_ratio[i] = state.void_ratio;
}

template <Fabric K>
model::State<double, kPlane, K> lane_of(const model::State<Lanes, kPlane, K>& pack, std::size_t lane) {
  model::State<double, kPlane, K> state;
  for (int k = 0; k < kPlane; ++k) {
    state.stress[k] = pack.stress[k][lane];
    if constexpr (K == Fabric::omega) state.omega[k] = pack.omega[k][lane];
  }
  state.void_ratio = pack.void_ratio[lane];
  return state;
}

/// ln(1 + x), to 2e-16 absolute: it is added to values of order one.
Lanes log_of_one_plus(const Lanes& x) {
  constexpr double kSmall = 1.0 / 512.0;  // the first term left out is x^7/7 < 2e-20
  if (!(largest(abs(x)) < kSmall)) return log(1.0 + x);
  const Lanes tail = 1.0 / 3.0 + x * (-0.25 + x * (0.2 - x * (1.0 / 6.0)));
  return x + x * x * (x * tail - 0.5);
}

/// A pack after the step, with each point's largest (EST/TOL)^2, or kHopeless where it left the law's domain.
template <Fabric K>
struct Trial {
  model::State<Lanes, kPlane, K> state;
  Lanes errors;
  double worst;  ///< largest of the errors
};

/// Advances packs in equal substeps and estimates their errors.
template <Fabric K>
class PackSteps {
 public:
  PackSteps(const model::Law<double>& law, double tolerance, double least_pressure)
      : law_(law),
        inverse_tolerance_squared_(1.0 / (tolerance * tolerance)),
        least_pressure_(least_pressure) {}

  /// The pack of points from `start` on after `dt`.
  [[gnu::flatten]] void operator()(const Particles& particles, std::size_t start, double dt, int substeps,
                                   Trial<K>& trial) const {
    const Pack<K> pack = load<K>(particles, start);
    model::State<Lanes, kPlane, K> y = pack.state;
    const Lanes whole(dt / substeps);
    const Lanes half(0.5 * dt / substeps);
    const Lanes norm = model::norm_of<Lanes, kPlane>(pack.strain_rate);
    // e: 1+e grows by the same factor 1+x in every half substep, so the logarithm of p_B is known without
    // another
    const Lanes x = half * model::trace<Lanes, kPlane>(pack.strain_rate);
    const double minus_inverse_lambda = -1.0 / law_.parameters().lambda();
    const Lanes log_change_half = log_of_one_plus(x) * minus_inverse_lambda;
    Lanes log_change(0.0);
    if (substeps > 1) log_change = log_of_one_plus(2.0 * x * (1.0 + x)) * minus_inverse_lambda;
    Lanes log_p_B = law_.log_preconsolidation_pressure(y.void_ratio);

    const Lanes void_ratio_error = x * inverse(1.0 + x);  // its square: (w - v)/(1 + w)
    const Lanes square = void_ratio_error * void_ratio_error;
    Lanes worst = square * square;
    Lanes margin(HUGE_VAL);  // from the border of the domain
    Lanes lowest(HUGE_VAL);
    Lanes sum(0.0);  // a number only if everything was: the packs' max and min may pass over NaN
    for (int n = 0; n < substeps; ++n) {
      const auto f = fixed_axes_rate(pack, y, norm, log_p_B);
      const auto y_half = advanced(y, f, half);
      const auto f_half = fixed_axes_rate(pack, y_half, norm, log_p_B + log_change_half);
      // w - v = tau/2 (F_half - F); the accepted solution is 2w - v = y + tau F_half
      y = advanced(y, f_half, whole);
      log_p_B += log_change;
      const Lanes stress_squared = y.stress.squaredNorm();
      const model::Mandel<Lanes, kPlane> difference = (f_half.stress - f.stress) * half;
      const Lanes error = difference.squaredNorm() / stress_squared;
      const Lanes mean = model::trace<Lanes, kPlane>(y.stress) * (-1.0 / 3.0);
      worst = max(worst, error);
      lowest = min(lowest, mean);
      margin = min(margin, 9.0 * mean * mean - stress_squared);  // q < 3p
      sum += error + mean;
      if constexpr (K == Fabric::omega) {
        const model::Mandel<Lanes, kPlane> turn = (f_half.omega - f.omega) * half;
        const Lanes omega_squared = y.omega.squaredNorm();
        worst = max(worst, turn.squaredNorm() / (1.0 + omega_squared));
        const Lanes M = law_.measures(y).F * law_.critical_ratio();
        const Lanes left = M * M - 1.5 * omega_squared;
        margin = min(margin, left);
        sum += left;
      }
    }
    const Lanes hopeless(kHopeless);
    Lanes result = worst * inverse_tolerance_squared_;
    result = where_le(Lanes(0.0), min(margin, y.void_ratio), result, hopeless);
    result = where_le(Lanes(least_pressure_), lowest, result, hopeless);
    trial.state = y;
    trial.errors = where_le(sum, Lanes(HUGE_VAL), result, hopeless);
    trial.worst = largest(trial.errors);
  }

 private:
  [[nodiscard]] model::StateRate<Lanes, kPlane, K> fixed_axes_rate(const Pack<K>& pack,
                                                                   const model::State<Lanes, kPlane, K>& y,
                                                                   const Lanes& norm,
                                                                   const Lanes& log_p_B) const {
    auto rate = law_.rate(y, pack.strain_rate, norm, log_p_B);
    model::add_corotation(rate, y, pack.spin);
    return rate;
  }

  const model::Law<double>& law_;
  double inverse_tolerance_squared_;
  double least_pressure_;
};

}  // namespace

StressUpdate::StressUpdate(const model::Parameters<double>& parameters, double tolerance,
                           double least_pressure)
    : law_(parameters), tolerance_(tolerance), least_pressure_(least_pressure) {}

StressUpdateCount StressUpdate::update(Particles& particles, double dt) const {
  return law_.parameters().rotates() ? update_form<Fabric::omega>(particles, dt)
                                     : update_form<Fabric::none>(particles, dt);
}

template <Fabric K>
StressUpdateCount StressUpdate::update_form(Particles& particles, double dt) const {
  StressUpdateCount count;
  const PackSteps<K> advance(law_, tolerance_, least_pressure_);
  Trial<K> trial;
  for (std::size_t start = 0; start < particles.count; start += Lanes::kCount) {
    advance(particles, start, dt, 1, trial);
    if (trial.worst > 1.0) {
      // EST is of order tau^2; a pack that one substep cannot serve takes as many as its worst point asks for
      const double wanted = std::ceil(kSubstepMargin * std::pow(trial.worst, 0.25));
      advance(particles, start, dt, static_cast<int>(std::min(wanted, double{kMostPackSubsteps})), trial);
    }
    if (trial.worst <= 1.0) {
      store<K>(trial.state, particles, start);
      continue;
    }
    const std::size_t end = std::min(start + Lanes::kCount, particles.count);
    for (std::size_t i = start; i < end; ++i) {
      if (trial.errors[i - start] <= 1.0) {
        store<K>(lane_of<K>(trial.state, i - start), particles, i);
      } else {
        ++count.substepped;
        if (!substep<K>(particles, i, dt)) ++count.floored;
      }
    }
  }
  return count;
}

template <Fabric K>
bool StressUpdate::substep(Particles& particles, std::size_t i, double dt) const {
  using State = model::State<double, kPlane, K>;
  State state = model::in_form<K>(particles.state(i));
  model::Mandel<double, kPlane> strain_rate;
  for (int k = 0; k < kPlane; ++k) strain_rate[k] = particles.strain_rate[static_cast<std::size_t>(k)][i];
  const double norm = model::norm_of<double, kPlane>(strain_rate);
  const Eigen::Vector3d spin(particles.spin[i], 0.0, 0.0);

  integrators::Tolerance tolerance;
  tolerance.relative = tolerance_;
  tolerance.estimate_share = 1.0;  // as for packs
  tolerance.absolute_stress = kFloorTolerance * least_pressure_;
  tolerance.max_substeps = kMostPointSubsteps;
  double first_substep = 0.5 * dt;
  const double void_ratio_before = state.void_ratio;
  const auto inside = [this](const State& y) {
    return model::trace<double, kPlane>(y.stress) / -3.0 >= least_pressure_ && law_.in_domain(y);
  };
  const auto done = integrators::fellin_ostermann_substeps(
      state, dt, tolerance, first_substep,
      [&](const State& y, model::StateRate<double, kPlane, K>& f) {
        if (!inside(y)) return false;
        f = law_.rate(y, strain_rate, norm);
        model::add_corotation(f, y, spin);
        return std::isfinite(f.stress.sum());
      },
      inside, [](double) {});
  if (!done) {
    const double volumetric_strain = model::trace<double, kPlane>(strain_rate) * dt;
    state = State{model::unit_tensor<double, kPlane>() * -least_pressure_,
                  (1.0 + void_ratio_before) * std::exp(volumetric_strain) - 1.0};
  }
  store<K>(state, particles, i);
  return done.has_value();
}

}  // namespace isotach::mpm
