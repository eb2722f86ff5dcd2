// Copyright Isotach contributors. SPDX-License-Identifier: BSD-3-Clause
// What an effect is: something that a test may show and the model, by itself, lacks.
#pragma once

#include <cstddef>
#include <span>
#include <string_view>

namespace isotach::effects {

/// Where an effect enters.
enum class Seam {
  law,            ///< a constant of the law, or a term of it
  boundary,       ///< what the specimen touches
  initial_state,  ///< the state that the test starts from
  instrument      ///< what is between the specimen and the readings
};

/// The kind of test that can show an effect.
enum class TestKind { oedometer, slump };

/// What an effect needs of a test besides its readings of stress and strain.
enum class Need {
  nothing,
  diameter,    ///< of the specimen
  temperature  ///< in the data file
};

/// Where a file need not name a parameter, what it then is.
enum class Default {
  none,         ///< it has to be named
  typical,      ///< EffectParameter::typical
  material_D_r  ///< D_r of [material]
};

/// One parameter of an effect. Bounds and typical value are in `unit`; the lower bound is excluded where
/// `lower_open`, the upper one never.
struct EffectParameter {
  std::string_view name;     ///< as in files; carries the unit
  std::string_view unit;     ///< of `name`, "-" if none
  std::string_view meaning;  ///< in the field's words
  double to_si;              ///< factor from `unit` to SI
  double lower;
  double upper;
  bool lower_open;
  double typical;                     ///< where a search starts, and its scale; > 0
  Default otherwise = Default::none;  ///< one with a default is a convention, which no fit moves

  [[nodiscard]] constexpr bool searched() const { return otherwise == Default::none; }
  [[nodiscard]] constexpr double lower_si() const { return to_si * lower; }
  [[nodiscard]] constexpr double upper_si() const { return to_si * upper; }
  [[nodiscard]] constexpr double typical_si() const { return to_si * typical; }
};

/// An effect, described. Its first parameter is its amplitude: where that is zero the effect is exactly
/// nothing, whatever the others are.
struct Effect {
  std::string_view name;
  std::string_view meaning;   ///< in plain words
  std::string_view equation;  ///< as text, in the symbols of docs/effects.md
  std::string_view source;    ///< of the equation
  Seam seam;
  TestKind test;
  /// n, where what it does to the readings grows as H^n with the height H of specimen or fill, all else
  /// equal; in slumps against what the weight does.
  int height_exponent;
  std::span<const EffectParameter> parameters;  ///< at most kMostParameters
  Need need = Need::nothing;

  /// A parameter's value (SI) where the amplitude is zero: there the others take their typical ones.
  [[nodiscard]] constexpr double at_zero(std::size_t parameter) const {
    return parameter == 0 ? 0.0 : parameters[parameter].typical_si();
  }
};

inline constexpr std::size_t kMostParameters = 4;

[[nodiscard]] std::string_view name_of(Seam seam);
[[nodiscard]] std::string_view name_of(TestKind test);

}  // namespace isotach::effects
