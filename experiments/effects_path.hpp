// Copyright Isotach contributors. SPDX-License-Identifier: BSD-3-Clause
// The law with effects led through an oedometer test's history, with any scalar.
#pragma once

#include <optional>
#include <span>
#include <utility>

#include "effects/anisotropy.hpp"
#include "effects/delayed_creep.hpp"
#include "effects/rate_dependent_viscosity.hpp"
#include "effects/small_strain_stiffness.hpp"
#include "effects/structure.hpp"
#include "effects/temperature.hpp"
#include "experiments/effects_substeps.hpp"
#include "experiments/oedometer_path.hpp"
#include "experiments/wander.hpp"

namespace isotach::experiments::detail {

/// The terms of the law among the effects.
template <class S>
[[nodiscard]] model::LawTerms<S> law_terms(const effects::Values<S>& values) {
  namespace fx = effects;
  model::LawTerms<S> terms;
  if (const auto* p = values.find(fx::structure::kEffect)) {
    terms.structure = {(*p)[fx::structure::r], (*p)[fx::structure::k]};
  }
  if (const auto* p = values.find(fx::temperature::kEffect)) terms.temperature = (*p)[fx::temperature::a];
  if (const auto* p = values.find(fx::rate_dependent_viscosity::kEffect)) {
    terms.rate_dependence = {(*p)[fx::rate_dependent_viscosity::b],
                             (*p)[fx::rate_dependent_viscosity::D_ref]};
  }
  if (const auto* p = values.find(fx::small_strain_stiffness::kEffect)) {
    terms.small_strain = {(*p)[fx::small_strain_stiffness::m], (*p)[fx::small_strain_stiffness::eps_r]};
  }
  if (const auto* p = values.find(fx::delayed_creep::kEffect)) {
    terms.delayed_creep = (*p)[fx::delayed_creep::c];
  }
  return terms;
}

/// The law's parameters, with C_2 and C_3 of the anisotropy effect where it is on. An error in words where
/// the material rotates already, or where the effect's fabric is not admissible.
template <class S>
[[nodiscard]] tl::expected<model::Parameters<S>, std::string> with_anisotropy(
    const model::Parameters<S>& parameters, const effects::Values<S>& values) {
  namespace fx = effects::anisotropy;
  const auto* p = values.find(fx::kEffect);
  if (p == nullptr) return parameters;
  if (parameters.rotates())
    return tl::unexpected(std::string("anisotropy is both in the material and an effect"));
  model::ParameterValues<S> raw = parameters.values();
  raw[model::ParameterId::C_2] = (*p)[fx::C_2];
  raw[model::ParameterId::C_3] = (*p)[fx::Omega_0] * (*p)[fx::C_3];
  auto result = model::Parameters<S>::create(raw);
  if (!result) return tl::unexpected("anisotropy: " + result.error().message());
  return *result;
}

/// What effects make of the start of a test.
template <class S>
class AlteredStart {
 public:
  AlteredStart(const effects::Values<S>& values, const EffectsModel<S>& model,
               const OedometerProtocol& protocol)
      : model_(model), read_(protocol.start.row != kNoRow) {
    namespace fx = effects::anisotropy;
    if (const auto* p = values.find(fx::kEffect)) omega_ = (*p)[fx::Omega_0];
    if (!protocol.temperatures.empty()) {
      history_.temperature_excess = protocol.temperatures.front() - model.reference_temperature;
    }
    strain_ = protocol.start.axial_strain;
    direction_ = protocol.steps.front().direction;
  }

  /// A stress that was read holds what the ring took; one that the study gives is the specimen's.
  [[nodiscard]] S axial_stress(const S& K0, double read) const {
    if (!read_) return S(read);
    return read / (1.0 + K0 * model_.instrument.friction_ratio(S(strain_), direction_));
  }
  template <model::Fabric K>
  void prepare(AxialState<S, K>& state) const {
    if constexpr (K == model::Fabric::omega) {
      // -Omega_0 diag(2, -1, -1)/3, tension positive
      if (!omega_) return;
      state.omega[0] = *omega_ * (-2.0 / 3.0);
      state.omega[1] = *omega_ * (std::numbers::sqrt2 / 3.0);
    }
  }
  [[nodiscard]] S law_pressure(const S& p_B) const {
    using std::exp;
    const S any(1.0);  // void ratio: the terms alter ln p_B by the same everywhere
    return p_B * exp(model_.law.log_preconsolidation_pressure(any) -
                     model_.terms.log_preconsolidation_pressure(model_.law, any, history_));
  }

 private:
  const EffectsModel<S>& model_;
  bool read_;
  std::optional<S> omega_;
  model::LawHistory<S> history_;
  double strain_ = 0.0;
  double direction_ = 1.0;
};

/// What the instrument reads. Compression positive.
template <class S>
struct EffectsReading {
  S stress;  ///< Pa
  S strain;  ///< engineering

  [[nodiscard]] const S& axial_stress() const { return stress; }
  [[nodiscard]] const S& axial_strain() const { return strain; }
};

/// Leads the law with effects through a test.
template <class S, model::Fabric K>
class EffectsPath {
 public:
  EffectsPath(const model::Law<S>& law, const effects::Values<S>& values, const datasets::OedometerTest& test,
              const OedometerProtocol& protocol, const Wander<S>* wander = nullptr)
      : test_(test),
        protocol_(protocol),
        values_(values),
        wander_(wander),
        parameters_(law.parameters()),
        model_{law,
               law_terms(values),
               S(0.0),
               Instrument<S>(values, test),
               {S(0.0), protocol.start.axial_strain}} {
    if (const auto* p = values.find(effects::temperature::kEffect)) {
      model_.reference_temperature = (*p)[effects::temperature::theta_0];
    }
  }
  EffectsPath(const EffectsPath&) = delete;  // the alteration of the start refers to the model
  EffectsPath& operator=(const EffectsPath&) = delete;

  /// Finds the state at the start.
  [[nodiscard]] std::optional<PredictionFailure> begin(std::span<const S> local) {
    if (model_.terms.temperature && protocol_.temperatures.empty()) {
      return PredictionFailure{test_.name + ": the effect temperature needs readings of temperature"};
    }
    model_.strain_of.void_ratio_at_start = S(protocol_.start.void_ratio);
    const auto start = initial_state<S, K>(model_.law, test_, protocol_.start, local,
                                           AlteredStart<S>(values_, model_, protocol_));
    if (!start) return start.error();
    y_ = {*start, S(1.0), S(0.0), 0.0};
    model_.strain_of.void_ratio_at_start = start->void_ratio;
    step_.direction = protocol_.steps.front().direction;
    if (!protocol_.temperatures.empty()) step_.temperature = protocol_.temperatures.front();
    step_.void_ratio_at_reversal = start->void_ratio;
    step_.largest_load = model_.load(y_.soil, step_.direction);
    model_.given_at_start = model_.instrument.given_strain(step_.largest_load, step_.largest_load);
    return std::nullopt;
  }

  /// The first substep to try of the next step (s); 0: any.
  [[nodiscard]] double& substep() { return substep_; }
  [[nodiscard]] const EffectsState<S, K>& state() const { return y_; }
  [[nodiscard]] EffectsReading<S> at_start() const {
    return {S(protocol_.start.axial_stress), S(protocol_.start.axial_strain)};
  }
  /// ln(p_B / 1 Pa) now, by the terms of the law.
  [[nodiscard]] S log_preconsolidation_pressure() const {
    model::LawHistory<S> history;
    history.structure = y_.structure;
    if (model_.terms.temperature) {
      history.temperature_excess =
          step_.temperature + step_.temperature_rate * y_.elapsed - model_.reference_temperature;
    }
    return model_.terms.log_preconsolidation_pressure(model_.law, y_.soil.void_ratio, history);
  }

  /// Follows all steps; `visit(step, time, reading)` sees what is read at the end of each, and advance(rate,
  /// state, duration, accepted) integrates, returning the failure.
  template <class Advance, class Visit>
  [[nodiscard]] std::optional<PredictionFailure> follow(Advance&& advance, Visit&& visit) {
    double time = protocol_.start.time;
    for (std::size_t i = 0; i < protocol_.steps.size(); ++i) {
      const DriveStep& drive = protocol_.steps[i];
      prepare(i, time);
      EffectsRate<S, K> rate(model_, step_);
      const auto done = advance(rate, y_, drive, [this](const EffectsState<S, K>& y) { keep_largest(y); });
      if (!done) return step_failure(test_, protocol_, i, time, done.error());
      time += drive.duration;
      const auto read = reading(rate, time);
      if (!read) {
        return PredictionFailure{
            fmt::format("{}: at time {:.6g} s the stress read would be negative", test_.name, time)};
      }
      visit(i, time, *read);
    }
    return std::nullopt;
  }

 private:
  [[nodiscard]] S load() const { return model_.load(y_.soil, step_.direction); }
  [[nodiscard]] S measured_strain() const {
    return model_.measured_strain(y_.soil.void_ratio, load(), step_.largest_load) + strain_offset_;
  }
  /// Whether the strain read is more than the specimen's.
  [[nodiscard]] bool strain_is_led() const {
    return model_.instrument.gives() || (wander_ != nullptr && wander_->slot == Slot::strain_reading);
  }
  void let_wander(const S& change) {
    using std::exp;
    if (wander_->slot == Slot::stress_reading) {
      stress_factor_ = exp(change);
    } else if (wander_->slot == Slot::strain_reading) {
      strain_offset_ = change - wander_->change[0];
    } else {
      model_.law = model::Law<S>(changed(parameters_, wander_->slot, change));
    }
  }

  void keep_largest(const EffectsState<S, K>& y) {
    const S now = model_.load(y.soil, step_.direction);
    if (model::value_of(now) > model::value_of(step_.largest_load)) step_.largest_load = now;
  }

  /// Whether the sensor that drifts is the one that controls; loads of an incremental test are weights.
  [[nodiscard]] bool sensor_controls() const { return test_.record.control == datasets::Control::strain; }

  void prepare(std::size_t i, double time) {
    using std::log;
    const DriveStep& drive = protocol_.steps[i];
    const bool first = i == 0;
    const bool controlled_before = !first && protocol_.steps[i - 1].stress_controlled;
    if (drive.direction != step_.direction) step_.void_ratio_at_reversal = y_.soil.void_ratio;
    const bool hold_goes_on = drive.held && !first && protocol_.steps[i - 1].held;
    if (!hold_goes_on) y_.held_strain = S(0.0);
    y_.elapsed = 0.0;
    step_.direction = drive.direction;
    step_.held = drive.held;
    step_.stress_controlled = drive.stress_controlled;
    const bool strain_begins = !drive.stress_controlled && (first || controlled_before);
    if (strain_begins && strain_is_led()) log_height_ = log(1.0 - measured_strain());
    if (wander_ != nullptr) let_wander(wander_->change[i + 1]);
    if (!protocol_.temperatures.empty()) {
      step_.temperature = protocol_.temperatures[i];
      step_.temperature_rate = (protocol_.temperatures[i + 1] - protocol_.temperatures[i]) / drive.duration;
    }
    if (drive.stress_controlled) {
      S target(drive.amount);
      if (sensor_controls()) {
        target =
            target / stress_factor_ - model_.instrument.drift(time + drive.duration - protocol_.start.time);
      }
      step_.stress = load() + carried_by_water_;
      step_.rate = (target - step_.stress) / drive.duration;
    } else if (!strain_is_led()) {
      step_.rate = S(drive.amount / drive.duration);
    } else {
      // towards where the instrument is to be, so that no error of a step stays
      log_height_ -= drive.amount;
      step_.rate = (log(1.0 - measured_strain()) - log_height_) / drive.duration;
    }
    if (drive.stress_controlled != controlled_before || first) substep_ = 0.0;
  }

  [[nodiscard]] std::optional<EffectsReading<S>> reading(EffectsRate<S, K>& rate, double time) {
    const S now = load();
    if (model_.instrument.holds_water()) {
      constexpr double kLong = 1e30;  // s: the mean rate over it is the limit
      EffectsStateRate<S, K> f;
      if (!rate(y_, kLong, f)) return std::nullopt;
      step_.compression = rate.compression();
      const S c = model_.instrument.pore_pressure_per_rate(model_.strain_of(y_.soil.void_ratio));
      if (step_.stress_controlled) {
        carried_by_water_ = rate.stress_at(y_.elapsed) - now;
        if (model::value_of(c) > 0.0) step_.compression = carried_by_water_ / c;
      } else {
        carried_by_water_ = c * step_.compression;
      }
    }
    const S stress =
        (now + carried_by_water_ + model_.instrument.drift(time - protocol_.start.time)) * stress_factor_;
    if (!(model::value_of(stress) > 0.0)) return std::nullopt;
    return EffectsReading<S>{stress, measured_strain()};
  }

  const datasets::OedometerTest& test_;
  const OedometerProtocol& protocol_;
  const effects::Values<S>& values_;
  const Wander<S>* wander_;          // null where nothing wanders
  model::Parameters<S> parameters_;  // from which the law's wander
  EffectsModel<S> model_;
  EffectsStep<S> step_;
  EffectsState<S, K> y_;
  S carried_by_water_ = S(0.0);  // Pa, of the stress measured
  S log_height_ = S(0.0);        // measured, over the first height
  S stress_factor_ = S(1.0);     // of the stress read, where that wanders
  S strain_offset_ = S(0.0);     // of the strain read, likewise
  double substep_ = 0.0;
};

}  // namespace isotach::experiments::detail
