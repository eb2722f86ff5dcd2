// Copyright Isotach contributors. SPDX-License-Identifier: BSD-3-Clause
#include "mpm/stress_update.hpp"

#include <algorithm>
#include <array>
#include <cmath>

namespace isotach::mpm {

namespace {

using model::kPlane;

constexpr double kSubstepMargin = 1.2;
constexpr int kMostPackSubsteps = 24;      // beyond, substeps for single points are cheaper
constexpr long kMostPointSubsteps = 1000;  // beyond, the point is on its way out of the domain
constexpr double kFloorTolerance = 0.1;  // of the least pressure: stresses near it need no relative accuracy
constexpr double kHopeless = 1e9;        // error of a point that left the law's domain

template <class S>
model::StateRate<S, kPlane> fixed_axes_rate(const model::Law<S>& law, const model::State<S, kPlane>& state,
                                            const model::Mandel<S, kPlane>& strain_rate,
                                            const Eigen::Matrix<S, 3, 1>& spin) {
  model::StateRate<S, kPlane> rate = law.template rate<kPlane>(state, strain_rate);
  rate.stress += model::corotation<S, kPlane>(state.stress, spin);
  return rate;
}

}  // namespace

StressUpdate::StressUpdate(const model::Parameters<double>& parameters, double tolerance,
                           double least_pressure)
    : law_(parameters),
      lanes_law_(parameters.cast<Lanes>()),
      tolerance_(tolerance),
      least_pressure_(least_pressure) {}

StressUpdateCount StressUpdate::update(Particles& particles, double dt) const {
  StressUpdateCount count;
  std::array<double, Lanes::kCount> error;
  Eigen::Matrix<Lanes, 3, 1> spin;
  spin[1] = spin[2] = Lanes(0.0);

  for (std::size_t start = 0; start < particles.count; start += Lanes::kCount) {
    PlaneState y;
    model::Mandel<Lanes, kPlane> strain_rate;
    for (int k = 0; k < kPlane; ++k) {
      const auto component = static_cast<std::size_t>(k);
      y.stress[k] = Lanes::load(&particles.stress[component][start]);
      strain_rate[k] = Lanes::load(&particles.strain_rate[component][start]);
    }
    y.void_ratio = Lanes::load(&particles.void_ratio[start]);
    spin[0] = Lanes::load(&particles.spin[start]);

    PlaneState done = y;
    double worst = advance(done, strain_rate, spin, dt, 1, error);
    if (worst > 1.0) {
      // EST is of order tau^2; a pack that one substep cannot serve takes as many as its worst point asks for
      const double wanted = std::ceil(kSubstepMargin * std::sqrt(worst));
      const int substeps = static_cast<int>(std::min(wanted, double{kMostPackSubsteps}));
      done = y;
      worst = advance(done, strain_rate, spin, dt, substeps, error);
    }
    if (worst <= 1.0) {
      for (int k = 0; k < kPlane; ++k)
        done.stress[k].store(&particles.stress[static_cast<std::size_t>(k)][start]);
      done.void_ratio.store(&particles.void_ratio[start]);
      continue;
    }
    const std::size_t end = std::min(start + Lanes::kCount, particles.count);
    for (std::size_t i = start; i < end; ++i) {
      const std::size_t lane = i - start;
      if (error[lane] <= 1.0) {
        for (int k = 0; k < kPlane; ++k)
          particles.stress[static_cast<std::size_t>(k)][i] = done.stress[k][lane];
        particles.void_ratio[i] = done.void_ratio[lane];
      } else {
        ++count.substepped;
        if (!substep(particles, i, dt)) ++count.floored;
      }
    }
  }
  return count;
}

double StressUpdate::advance(PlaneState& y, const model::Mandel<Lanes, kPlane>& strain_rate,
                             const Eigen::Matrix<Lanes, 3, 1>& spin, double dt, int substeps,
                             std::array<double, Lanes::kCount>& error) const {
  const Lanes whole(dt / substeps);
  const Lanes half(0.5 * dt / substeps);
  const Lanes tolerance_squared(tolerance_ * tolerance_);
  Lanes worst(0.0);
  Lanes lowest(HUGE_VAL);
  Lanes sum(0.0);  // finite only if everything was: the packs' max and min may pass over NaN
  for (int n = 0; n < substeps; ++n) {
    const auto f = fixed_axes_rate(lanes_law_, y, strain_rate, spin);
    const PlaneState y_half{y.stress + f.stress * half, y.void_ratio + f.void_ratio * half};
    const auto f_half = fixed_axes_rate(lanes_law_, y_half, strain_rate, spin);
    // w - v = tau/2 (F_half - F); the accepted solution is 2w - v = y + tau F_half
    const model::Mandel<Lanes, kPlane> difference = (f_half.stress - f.stress) * half;
    y.stress += f_half.stress * whole;
    y.void_ratio += f_half.void_ratio * whole;
    const Lanes scaled = sqrt(difference.squaredNorm() / (tolerance_squared * y.stress.squaredNorm()));
    const Lanes mean = model::trace<Lanes, kPlane>(y.stress) * Lanes(-1.0 / 3.0);
    worst = max(worst, scaled);
    lowest = min(lowest, mean);
    sum += scaled + mean;
  }
  worst.store(error.data());
  for (std::size_t lane = 0; lane < Lanes::kCount; ++lane) {
    if (!std::isfinite(sum[lane]) || lowest[lane] < least_pressure_) error[lane] = kHopeless;
  }
  return *std::max_element(error.begin(), error.end());
}

bool StressUpdate::substep(Particles& particles, std::size_t i, double dt) const {
  model::State<double, kPlane> state;
  model::Mandel<double, kPlane> strain_rate;
  for (int k = 0; k < kPlane; ++k) {
    state.stress[k] = particles.stress[static_cast<std::size_t>(k)][i];
    strain_rate[k] = particles.strain_rate[static_cast<std::size_t>(k)][i];
  }
  state.void_ratio = particles.void_ratio[i];
  const Eigen::Vector3d spin(particles.spin[i], 0.0, 0.0);

  integrators::Tolerance tolerance;
  tolerance.relative = tolerance_;
  tolerance.absolute_stress = kFloorTolerance * least_pressure_;
  tolerance.max_substeps = kMostPointSubsteps;
  double first_substep = 0.5 * dt;
  const double void_ratio_before = state.void_ratio;
  const auto done = integrators::fellin_ostermann_substeps<double, kPlane>(
      state, dt, tolerance, first_substep,
      [&](const model::State<double, kPlane>& y, model::StateRate<double, kPlane>& f) {
        const double p = model::trace<double, kPlane>(y.stress) / -3.0;
        if (!(p >= least_pressure_) || !model::Law<double>::in_domain(y)) return false;
        f = fixed_axes_rate(law_, y, strain_rate, spin);
        return std::isfinite(f.stress.sum());
      },
      [](double) {});
  const bool inside = done.has_value();
  if (!inside) {
    state.stress = model::unit_tensor<double, kPlane>() * -least_pressure_;
    const double volumetric_strain = model::trace<double, kPlane>(strain_rate) * dt;
    state.void_ratio = (1.0 + void_ratio_before) * std::exp(volumetric_strain) - 1.0;
  }
  for (int k = 0; k < kPlane; ++k) particles.stress[static_cast<std::size_t>(k)][i] = state.stress[k];
  particles.void_ratio[i] = state.void_ratio;
  return inside;
}

}  // namespace isotach::mpm
