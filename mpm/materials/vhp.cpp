// Copyright Isotach contributors. SPDX-License-Identifier: BSD-3-Clause
#include "mpm/materials/vhp.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>

#include "mpm/lanes.hpp"

namespace isotach::mpm {

namespace {

using model::Fabric;
using model::kPlane;

constexpr double kSubstepMargin = 1.2;
constexpr double kRetryFactor = 1.5;      // at least so many more substeps where the estimate was too low
constexpr int kMostPackSubsteps = 24;     // beyond, substeps for single points are cheaper
constexpr long kMostPointSubsteps = 128;  // beyond, the point is on its way out of the domain
constexpr double kFloorTolerance = 0.1;   // of the least pressure: stresses near it need no relative accuracy
constexpr double kAtFloor = 1.0 + 1e-9;   // times the least pressure: a point that was put there
constexpr double kHopeless = 1e18;        // squared error of a point that left the law's domain

/// A pack of points and their motion over the step.
template <Fabric K>
struct Pack {
  model::State<Lanes, kPlane, K> state;
  model::Mandel<Lanes, kPlane> strain_rate;
  Eigen::Matrix<Lanes, 3, 1> spin;
  Lanes log_strength;
};

/// Points of a chunk side by side, from entry p on.
template <Fabric K>
Pack<K> load(const Particles& particles, const MaterialChunk& chunk, std::size_t p) {
  Pack<K> pack;
  const std::size_t start = chunk.begin + p;
  for (std::size_t k = 0; k < kPlane; ++k) {
    const int component = static_cast<int>(k);
    pack.state.stress[component] = Lanes::load(&particles.stress[k][start]);
    pack.strain_rate[component] = Lanes::load(&chunk.strain_rate[k][p]);
    if constexpr (K == Fabric::omega) pack.state.omega[component] = Lanes::load(&particles.omega[k][start]);
  }
  pack.state.void_ratio = Lanes::load(&particles.void_ratio[start]);
  pack.spin[0] = Lanes::load(&chunk.spin[p]);
  pack.spin[1] = pack.spin[2] = Lanes(0.0);
  pack.log_strength = chunk.log_strength != nullptr ? Lanes::load(chunk.log_strength + p) : Lanes(0.0);
  return pack;
}

/// A number of the points at the entries of a chunk.
Lanes gather(const double* values, const std::uint32_t* entries) {
  std::array<double, Lanes::kCount> lanes;
  for (std::size_t lane = 0; lane < Lanes::kCount; ++lane) lanes[lane] = values[entries[lane]];
  return Lanes::load(lanes.data());
}

/// Points of a chunk at any entries.
template <Fabric K>
Pack<K> gather(const Particles& particles, const MaterialChunk& chunk, const std::uint32_t* entries) {
  Pack<K> pack;
  for (std::size_t k = 0; k < kPlane; ++k) {
    const int component = static_cast<int>(k);
    pack.state.stress[component] = gather(&particles.stress[k][chunk.begin], entries);
    pack.strain_rate[component] = gather(chunk.strain_rate[k].data(), entries);
    if constexpr (K == Fabric::omega) {
      pack.state.omega[component] = gather(&particles.omega[k][chunk.begin], entries);
    }
  }
  pack.state.void_ratio = gather(&particles.void_ratio[chunk.begin], entries);
  pack.spin[0] = gather(chunk.spin.data(), entries);
  pack.spin[1] = pack.spin[2] = Lanes(0.0);
  pack.log_strength = chunk.log_strength != nullptr ? gather(chunk.log_strength, entries) : Lanes(0.0);
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

/// `next` in the lanes whose error is within the tolerance, `before` in the others.
template <Fabric K>
model::State<Lanes, kPlane, K> accepted(const Lanes& errors, const model::State<Lanes, kPlane, K>& next,
                                        const model::State<Lanes, kPlane, K>& before) {
  const Lanes one(1.0);
  model::State<Lanes, kPlane, K> state;
  for (int k = 0; k < kPlane; ++k) {
    state.stress[k] = where_le(errors, one, next.stress[k], before.stress[k]);
    if constexpr (K == Fabric::omega) {
      state.omega[k] = where_le(errors, one, next.omega[k], before.omega[k]);
    }
  }
  state.void_ratio = where_le(errors, one, next.void_ratio, before.void_ratio);
  return state;
}

/// The lanes of a pack, to go to places of their own.
template <Fabric K>
class Spread {
 public:
  explicit Spread(const model::State<Lanes, kPlane, K>& pack) {
    for (std::size_t k = 0; k < kPlane; ++k) {
      pack.stress[static_cast<int>(k)].store(stress_[k].data());
      if constexpr (K == Fabric::omega) pack.omega[static_cast<int>(k)].store(omega_[k].data());
    }
    pack.void_ratio.store(void_ratio_.data());
  }
  void store(std::size_t lane, Particles& particles, std::size_t i) const {
    for (std::size_t k = 0; k < kPlane; ++k) {
      particles.stress[k][i] = stress_[k][lane];
      if constexpr (K == Fabric::omega) particles.omega[k][i] = omega_[k][lane];
    }
    particles.void_ratio[i] = void_ratio_[lane];
  }

 private:
  using Column = std::array<double, Lanes::kCount>;
  std::array<Column, kPlane> stress_;
  std::array<Column, kPlane> omega_;
  Column void_ratio_;
};

/// How many times more substeps a point asks for whose squared error is this: EST is of order tau^2.
double wanted_substeps(double squared_error) {
  return kSubstepMargin * std::sqrt(std::sqrt(squared_error));
}
/// A number of substeps; beyond those of packs all are alike.
int whole(double substeps) {
  return static_cast<int>(std::ceil(std::min(substeps, kMostPackSubsteps + 1.0)));
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

  /// The pack after a step of dt (s).
  [[gnu::flatten]] void operator()(const Pack<K>& pack, double dt, int substeps, Trial<K>& trial) const {
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
    Lanes log_p_B = law_.log_preconsolidation_pressure(y.void_ratio) + pack.log_strength;

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

VhpMaterial::VhpMaterial(const model::Parameters<double>& parameters, const Settings& settings)
    : law_(parameters), settings_(settings) {
  // along That the skeleton is stiffest: f_b (F^2 + a^2 |That|^2), F <= 1, |That| <= 1
  const double a2 = law_.a_squared();
  skeleton_factor_ = 3.0 * (1.0 + a2) / ((1.0 + a2 / 3.0) * parameters.kappa());
}

double VhpMaterial::modulus(double pressure, double void_ratio) const {
  return settings_.water_bulk_modulus * (1.0 + void_ratio) / void_ratio + skeleton_factor_ * pressure;
}

double VhpMaterial::wave_modulus(const Particles& particles, std::size_t i) const {
  return modulus(particles.mean_effective_pressure(i), particles.void_ratio[i]);
}

double VhpMaterial::reference_pressure(double pore_pressure, double void_ratio) const {
  return pore_pressure + settings_.water_bulk_modulus * std::log(void_ratio);
}

double VhpMaterial::pore_pressure(const Particles& particles, std::size_t i) const {
  return particles.reference_pressure[i] - settings_.water_bulk_modulus * std::log(particles.void_ratio[i]);
}

void VhpMaterial::total_pressure(const Particles& particles, std::size_t begin, std::size_t count,
                                 double* pressures) const {
  for (std::size_t p = 0; p < count; ++p) {
    pressures[p] = particles.mean_effective_pressure(begin + p) + pore_pressure(particles, begin + p);
  }
}

void VhpMaterial::update(Particles& particles, MaterialChunk& chunk, MaterialCount& count) const {
  if (law_.parameters().rotates()) {
    update_form<Fabric::omega>(particles, chunk, count);
  } else {
    update_form<Fabric::none>(particles, chunk, count);
  }
  const Lanes bulk(settings_.water_bulk_modulus);
  Lanes highest(0.0);
  Lanes densest(-HUGE_VAL);
  for (std::size_t p = 0; p < chunk.count; p += Lanes::kCount) {
    const std::size_t start = chunk.begin + p;
    const auto& T = particles.stress;
    const Lanes pressure =
        (Lanes::load(&T[0][start]) + Lanes::load(&T[1][start]) + Lanes::load(&T[2][start])) * (-1.0 / 3.0);
    const Lanes void_ratio = Lanes::load(&particles.void_ratio[start]);
    const Lanes water = Lanes::load(&particles.reference_pressure[start]) - bulk * log(void_ratio);
    (pressure + water).store(&chunk.total_pressure[p]);
    highest = max(highest, pressure);
    densest = max(densest, -void_ratio);
  }
  count.stiffest = std::max(count.stiffest, modulus(largest(highest), -largest(densest)));
}

template <Fabric K>
void VhpMaterial::update_form(Particles& particles, MaterialChunk& chunk, MaterialCount& count) const {
  const PackSteps<K> advance(law_, settings_.tolerance, settings_.least_pressure);
  Trial<K> trial;
  std::array<Left, kChunk> left;
  std::size_t lefts = 0;
  for (std::size_t p = 0; p < chunk.count; p += Lanes::kCount) {
    const Pack<K> pack = load<K>(particles, chunk, p);
    advance(pack, chunk.dt, 1, trial);
    if (trial.worst <= 1.0) {
      store<K>(trial.state, particles, chunk.begin + p);
      continue;
    }
    store<K>(accepted<K>(trial.errors, trial.state, pack.state), particles, chunk.begin + p);
    std::array<double, Lanes::kCount> errors;
    trial.errors.store(errors.data());
    const std::size_t lanes = std::min(Lanes::kCount, chunk.count - p);
    for (std::size_t lane = 0; lane < lanes; ++lane) {
      if (!(errors[lane] <= 1.0)) {
        left[lefts++] = {static_cast<std::uint32_t>(p + lane), whole(wanted_substeps(errors[lane]))};
      }
    }
  }
  if (lefts > 0) update_left<K>(particles, chunk, {left.data(), lefts}, count);
}

/// Those that ask for most first; returns how many ask for more than packs take.
std::size_t VhpMaterial::sort_by_substeps(std::span<Left> left) {
  std::array<std::size_t, kMostPackSubsteps + 3> starts{};
  const auto rank = [](const Left& one) {
    return static_cast<std::size_t>(kMostPackSubsteps + 1 - one.substeps);
  };
  for (const Left& one : left) ++starts[rank(one) + 1];
  for (std::size_t k = 1; k < starts.size(); ++k) starts[k] += starts[k - 1];
  const std::size_t alone = starts[1];
  std::array<Left, kChunk> sorted;
  for (const Left& one : left) sorted[starts[rank(one)]++] = one;
  std::copy_n(sorted.begin(), left.size(), left.begin());
  return alone;
}

template <Fabric K>
void VhpMaterial::update_left(Particles& particles, const MaterialChunk& chunk, std::span<Left> left,
                              MaterialCount& count) const {
  const PackSteps<K> advance(law_, settings_.tolerance, settings_.least_pressure);
  Trial<K> trial;
  std::array<double, Lanes::kCount> errors;
  std::array<std::uint32_t, Lanes::kCount> entries;
  while (!left.empty()) {
    const std::size_t alone = sort_by_substeps(left);
    for (std::size_t k = 0; k < alone; ++k) {
      ++count.substepped;
      if (!substep<K>(particles, chunk, left[k].entry)) ++count.floored;
    }
    std::size_t begin = alone;
    std::size_t still_left = 0;
    while (begin < left.size()) {
      const std::size_t lanes = std::min(Lanes::kCount, left.size() - begin);
      for (std::size_t lane = 0; lane < Lanes::kCount; ++lane) {
        entries[lane] = left[begin + std::min(lane, lanes - 1)].entry;  // the last one fills the pack
      }
      const int substeps = left[begin].substeps;
      advance(gather<K>(particles, chunk, entries.data()), chunk.dt, substeps, trial);
      trial.errors.store(errors.data());
      const Spread<K> spread(trial.state);
      begin += lanes;
      for (std::size_t lane = 0; lane < lanes; ++lane) {
        if (errors[lane] <= 1.0) {
          spread.store(lane, particles, chunk.begin + entries[lane]);
        } else {  // entries before `begin` are done with
          const double factor = std::max(kRetryFactor, wanted_substeps(errors[lane]));
          left[still_left++] = {entries[lane], whole(factor * substeps)};
        }
      }
    }
    left = left.first(still_left);
  }
}

template <Fabric K>
bool VhpMaterial::substep(Particles& particles, const MaterialChunk& chunk, std::size_t p) const {
  using State = model::State<double, kPlane, K>;
  const std::size_t i = chunk.begin + p;
  const double least_pressure = settings_.least_pressure;
  State state = model::in_form<K>(particles.state(i));
  model::Mandel<double, kPlane> strain_rate;
  for (int k = 0; k < kPlane; ++k) strain_rate[k] = chunk.strain_rate[static_cast<std::size_t>(k)][p];
  const double norm = model::norm_of<double, kPlane>(strain_rate);
  const Eigen::Vector3d spin(chunk.spin[p], 0.0, 0.0);
  const double log_strength = chunk.log_strength != nullptr ? chunk.log_strength[p] : 0.0;

  integrators::Tolerance tolerance;
  tolerance.relative = settings_.tolerance;
  tolerance.estimate_share = 1.0;  // as for packs
  tolerance.absolute_stress = kFloorTolerance * least_pressure;
  tolerance.max_substeps = kMostPointSubsteps;
  double first_substep = 0.5 * chunk.dt;
  const double void_ratio_before = state.void_ratio;
  const auto pressure = [](const State& y) { return model::trace<double, kPlane>(y.stress) / -3.0; };
  const auto inside = [&](const State& y) { return pressure(y) >= least_pressure && law_.in_domain(y); };
  const auto rate = [&](const State& y, model::StateRate<double, kPlane, K>& f) {
    if (!inside(y)) return false;
    f = law_.rate(y, strain_rate, norm, law_.log_preconsolidation_pressure(y.void_ratio) + log_strength);
    model::add_corotation(f, y, spin);
    return std::isfinite(f.stress.sum());
  };
  // a point that lies at the least pressure and is pulled down further stays: no substep is short enough
  const auto sinks = [&] {
    model::StateRate<double, kPlane, K> f;
    return pressure(state) <= kAtFloor * least_pressure && rate(state, f) &&
           model::trace<double, kPlane>(f.stress) > 0.0;
  };
  const bool done = !sinks() && integrators::fellin_ostermann_substeps(
                                    state, chunk.dt, tolerance, first_substep, rate, inside, [](double) {})
                                    .has_value();
  if (!done) {
    const double volumetric_strain = model::trace<double, kPlane>(strain_rate) * chunk.dt;
    state = State{model::unit_tensor<double, kPlane>() * -least_pressure,
                  (1.0 + void_ratio_before) * std::exp(volumetric_strain) - 1.0};
  }
  store<K>(state, particles, i);
  return done;
}

}  // namespace isotach::mpm
