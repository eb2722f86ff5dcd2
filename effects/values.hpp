// Copyright Isotach contributors. SPDX-License-Identifier: BSD-3-Clause
// Which effects a model has, and with which parameters: a validated, immutable value.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <span>
#include <string>
#include <tl/expected.hpp>
#include <utility>
#include <vector>

#include "effects/catalogue.hpp"
#include "model/scalar.hpp"

namespace isotach::effects {

/// One effect that is on.
template <class S>
struct Chosen {
  const Effect* effect;                 ///< of the catalogue
  std::array<S, kMostParameters> si{};  ///< its parameters, in their order, SI
};

/// Why a set of effects is not admissible.
struct EffectError {
  ParameterRef parameter;
  double value;          ///< in the unit of the parameter's name
  std::string accepted;  ///< the accepted range, in words

  [[nodiscard]] std::string message() const;
};

/// The effect with every parameter at its value of zero amplitude, and the amplitude as given (SI).
[[nodiscard]] Chosen<double> with_amplitude(const Effect& effect, double amplitude);

/// Checks every bound, and that no effect is there twice.
[[nodiscard]] std::optional<EffectError> check(const std::vector<Chosen<double>>& chosen);

/// The effects that are on; none by default. In the order of the catalogue.
template <class S>
class Values {
 public:
  Values() = default;

  [[nodiscard]] static tl::expected<Values, EffectError> create(std::vector<Chosen<S>> chosen) {
    std::vector<Chosen<double>> plain;
    for (const Chosen<S>& one : chosen) {
      plain.push_back({one.effect, {}});
      for (std::size_t i = 0; i < kMostParameters; ++i) plain.back().si[i] = model::value_of(one.si[i]);
    }
    if (auto error = check(plain)) return tl::unexpected(std::move(*error));
    const auto place = [](const Effect* effect) {
      return std::find(catalogue().begin(), catalogue().end(), effect) - catalogue().begin();
    };
    std::sort(chosen.begin(), chosen.end(),
              [&](const Chosen<S>& a, const Chosen<S>& b) { return place(a.effect) < place(b.effect); });
    return Values(std::move(chosen));
  }

  [[nodiscard]] bool empty() const { return chosen_.empty(); }
  [[nodiscard]] const std::vector<Chosen<S>>& chosen() const { return chosen_; }
  [[nodiscard]] bool has(const Effect& effect) const { return find(effect) != nullptr; }
  /// The parameters (SI) of an effect; null where it is off.
  [[nodiscard]] const std::array<S, kMostParameters>* find(const Effect& effect) const {
    for (const Chosen<S>& one : chosen_) {
      if (one.effect == &effect) return &one.si;
    }
    return nullptr;
  }
  /// A parameter (SI) of an effect that is on.
  [[nodiscard]] const S& operator[](const ParameterRef& parameter) const {
    return (*find(*parameter.effect))[parameter.index];
  }

  /// Those of that kind of test that do anything: one whose amplitude is zero, with all derivatives, does
  /// not.
  [[nodiscard]] Values acting_on(TestKind test) const {
    Values result;
    for (const Chosen<S>& one : chosen_) {
      if (one.effect->test == test && !model::is_exactly_zero(one.si[0])) result.chosen_.push_back(one);
    }
    return result;
  }

  /// The same with one effect more; one that is on already is replaced.
  [[nodiscard]] tl::expected<Values, EffectError> with(const Chosen<S>& effect) const {
    std::vector<Chosen<S>> chosen = without(*effect.effect).chosen_;
    chosen.push_back(effect);
    return create(std::move(chosen));
  }
  /// The same without an effect.
  [[nodiscard]] Values without(const Effect& effect) const {
    Values result;
    for (const Chosen<S>& one : chosen_) {
      if (one.effect != &effect) result.chosen_.push_back(one);
    }
    return result;
  }
  /// The same as constants of another scalar.
  template <class T>
  [[nodiscard]] Values<T> cast() const {
    Values<T> result;
    for (const Chosen<S>& one : chosen_) {
      Chosen<T> other{one.effect, {}};
      for (std::size_t i = 0; i < kMostParameters; ++i) other.si[i] = T(model::value_of(one.si[i]));
      result.chosen_.push_back(other);
    }
    return result;
  }
  /// The same with parameters (SI) of effects that are on set to other values, in the order of `parameters`.
  [[nodiscard]] tl::expected<Values, EffectError> with(std::span<const ParameterRef> parameters,
                                                       std::span<const S> si) const {
    std::vector<Chosen<S>> chosen = chosen_;
    for (std::size_t k = 0; k < parameters.size(); ++k) {
      for (Chosen<S>& one : chosen) {
        if (one.effect == parameters[k].effect) one.si[parameters[k].index] = si[k];
      }
    }
    return create(std::move(chosen));
  }

 private:
  template <class T>
  friend class Values;
  explicit Values(std::vector<Chosen<S>> chosen) : chosen_(std::move(chosen)) {}
  std::vector<Chosen<S>> chosen_;
};

}  // namespace isotach::effects
