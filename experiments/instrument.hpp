// Copyright Isotach contributors. SPDX-License-Identifier: BSD-3-Clause
// What stands between an oedometer specimen and its readings: friction, pore pressure, what gives in series.
#pragma once

#include <cmath>
#include <optional>

#include "datasets/study.hpp"
#include "effects/apparatus_compliance.hpp"
#include "effects/gas.hpp"
#include "effects/pore_pressure.hpp"
#include "effects/ring_friction.hpp"
#include "effects/seating.hpp"
#include "effects/sensor_drift.hpp"
#include "effects/values.hpp"

namespace isotach::experiments::detail {

/// The effects that enter at the instrument. Stress and strain compression positive, strain engineering.
///
/// The load of a specimen is sigma' and what the ring takes, G = sigma' + s 2 mu sigma_h H/D. The stress
/// measured is G, the pore pressure's share and the sensor's drift. What gives in series with the specimen
/// (apparatus, seating, gas) gives under G, and counts from the start of the test, where strain is zero.
template <class S>
class Instrument {
 public:
  Instrument(const effects::Values<S>& values, const datasets::OedometerTest& test)
      : height_(test.height), diameter_(test.diameter.value_or(HUGE_VAL)), void_ratio_(test.void_ratio) {
    namespace fx = effects;
    if (const auto* p = values.find(fx::ring_friction::kEffect)) friction_ = (*p)[fx::ring_friction::mu];
    if (const auto* p = values.find(fx::apparatus_compliance::kEffect)) {
      compliance_ = (*p)[fx::apparatus_compliance::C];
    }
    if (const auto* p = values.find(fx::seating::kEffect)) {
      seating_ = Seating{(*p)[fx::seating::delta], (*p)[fx::seating::sigma_s]};
    }
    if (const auto* p = values.find(fx::gas::kEffect)) gas_ = (*p)[fx::gas::S_g];
    if (const auto* p = values.find(fx::pore_pressure::kEffect)) {
      pore_pressure_ = PorePressure{(*p)[fx::pore_pressure::inverse_k], (*p)[fx::pore_pressure::c_k]};
    }
    if (const auto* p = values.find(fx::sensor_drift::kEffect)) drift_ = (*p)[fx::sensor_drift::drift];
  }

  /// What the ring takes over the radial stress (-), at an axial strain, loading (+1) or unloading (-1).
  [[nodiscard]] S friction_ratio(const S& strain, double direction) const {
    if (!friction_) return S(0.0);
    return *friction_ * (2.0 * direction * height_ / diameter_) * (1.0 - strain);
  }

  /// Whether anything gives in series with the specimen.
  [[nodiscard]] bool gives() const { return compliance_ || seating_ || gas_; }
  /// Strain (-) that it gives under a load G whose largest so far is `largest` (Pa).
  [[nodiscard]] S given_strain(const S& load, const S& largest) const {
    using std::exp;
    S strain(0.0);
    if (compliance_) strain += *compliance_ * load / height_;
    if (seating_) strain += seating_->delta / height_ * (1.0 - exp(-largest / seating_->sigma_s));
    if (gas_) strain += *gas_ * porosity() * load / (kAtmosphere + load);
    return strain;
  }
  /// Its derivative by the load (1/Pa); `beyond`: the load grows beyond its largest.
  [[nodiscard]] S given_per_load(const S& load, bool beyond) const {
    using std::exp;
    S slope(0.0);
    if (compliance_) slope += *compliance_ / height_;
    if (seating_ && beyond) {
      slope += seating_->delta / (height_ * seating_->sigma_s) * exp(-load / seating_->sigma_s);
    }
    if (gas_) slope += *gas_ * (porosity() * kAtmosphere) / ((kAtmosphere + load) * (kAtmosphere + load));
    return slope;
  }

  /// Whether pore pressure has a share in the stress measured.
  [[nodiscard]] bool holds_water() const { return pore_pressure_.has_value(); }
  /// That share over the rate of compression -dH/dt/H (Pa s), at an axial strain: (2/3) gamma_w H^2/(2 k).
  [[nodiscard]] S pore_pressure_per_rate(const S& strain) const {
    using std::exp;
    const S height = height_ * (1.0 - strain);
    const S decades = strain * (-(1.0 + void_ratio_) / void_ratio_) / pore_pressure_->c_k;
    return pore_pressure_->inverse_k * exp(-std::log(10.0) * decades) *
           (kWaterWeight / 3.0 * height * height);
  }

  /// What the sensor reads too much (Pa), a time (s) after the start.
  [[nodiscard]] S drift(double time) const { return drift_ ? S(*drift_ * time) : S(0.0); }

 private:
  static constexpr double kAtmosphere = 101.3e3;  // Pa
  static constexpr double kWaterWeight = 9.81e3;  // N/m3

  struct Seating {
    S delta;
    S sigma_s;
  };
  struct PorePressure {
    S inverse_k;
    S c_k;
  };

  [[nodiscard]] double porosity() const { return void_ratio_ / (1.0 + void_ratio_); }

  double height_;
  double diameter_;
  double void_ratio_;  // at time 0, by the height
  std::optional<S> friction_;
  std::optional<S> compliance_;
  std::optional<Seating> seating_;
  std::optional<S> gas_;
  std::optional<PorePressure> pore_pressure_;
  std::optional<S> drift_;
};

}  // namespace isotach::experiments::detail
