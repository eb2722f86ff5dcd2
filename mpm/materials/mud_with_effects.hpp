// Copyright Isotach contributors. SPDX-License-Identifier: BSD-3-Clause
// Mud that obeys more than the law of its skeleton.
#pragma once

#include "mpm/materials/flow_element.hpp"
#include "mpm/materials/vhp.hpp"
#include "mpm/mud_effects.hpp"
#include "mpm/wander.hpp"

namespace isotach::mpm {

/// VhpMaterial with what MudEffects adds to stress:
/// - thixotropy raises p_B by 1 + s xi. Over a step xi follows its equation exactly at the step's shear rate;
///   the law sees the mean of its two ends. Points need Particles::structure.
/// - a flow resistance is a stress of its own, in Particles::resistance. Its elastic part takes
///   kElasticShare of the mixture's bulk modulus: stiff enough that nothing but the first tenths of a per
///   cent of strain is elastic, soft enough not to shorten the step.
/// - draining lets the pore pressure fade, u exp(-b dt) in a step, through reference_pressure; as the total
///   pressure has to balance the weight, the skeleton then is pressed together. The mass of the water that
///   leaves stays with the points.
/// - a strength that wanders changes ln p_B: with time, with a point's rate in the step, or by what points
///   carry in Particles::log_strength.
class MudWithEffects final : public Material {
 public:
  MudWithEffects(const model::Parameters<double>& parameters, const VhpMaterial::Settings& settings,
                 const MudEffects& effects, double void_ratio, const Wander& wander = {});

  void update(Particles& particles, MaterialChunk& chunk, MaterialCount& count) const override;
  void total_pressure(const Particles& particles, std::size_t begin, std::size_t count,
                      double* pressures) const override;
  [[nodiscard]] double wave_modulus(const Particles& particles, std::size_t i) const override;

  [[nodiscard]] const VhpMaterial& vhp() const { return vhp_; }

  static constexpr double kElasticShare = 0.05;

 private:
  /// ln(1 + s xi) of the chunk's points, xi advanced by the step.
  void advance_structure(Particles& particles, const MaterialChunk& chunk, double* log_strength) const;
  /// Adds what the strength wanders by.
  void add_wander(const Particles& particles, const MaterialChunk& chunk, double* log_strength) const;
  void advance_resistance(Particles& particles, const MaterialChunk& chunk) const;
  void drain(Particles& particles, MaterialChunk& chunk) const;

  VhpMaterial vhp_;
  MudEffects effects_;
  Wander wander_;
  FlowElement element_;
};

}  // namespace isotach::mpm
