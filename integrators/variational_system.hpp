// Copyright Isotach contributors. SPDX-License-Identifier: BSD-3-Clause
// The variational equations of an increment: how its unknowns move along directions of its inputs.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <memory>
#include <vector>

#include "integrators/increment_system.hpp"
#include "integrators/sensitivities.hpp"

namespace isotach::integrators {

/// ds/dt = (df/dy) s + df/d(direction) for several directions. One evaluation of f with Jets whose
/// derivatives are those of y (that is s), of the parameters and of the loading gives the right-hand sides of
/// kWidth directions. Refers to the system, whose unknowns and scaling it shares.
template <model::Fabric K>
class VariationalSystem {
 public:
  using System = IncrementSystem<K>;

  VariationalSystem(const System& system, const model::Law<double>& law, const Increment<double>& increment,
                    const std::vector<Direction>& directions)
      : system_(system) {
    for (std::size_t first = 0; first < directions.size(); first += kWidth) {
      const std::size_t count = std::min(kWidth, directions.size() - first);
      chunks_.push_back(std::make_unique<Chunk>(law, increment, &directions[first], count));
    }
  }

  /// The right-hand sides at y: s(k)[i] and ds(k)[i] are those of unknown i along direction k; false as
  /// System::rate.
  template <class Column>
  [[nodiscard]] bool rates(const double* y, Column s, Column ds) {
    std::size_t first = 0;
    for (const auto& chunk : chunks_) {
      std::array<Jet, System::kState> jets;
      for (std::size_t i = 0; i < jets.size(); ++i) {
        jets[i] = Jet(y[i]);
        for (std::size_t k = 0; k < chunk->count; ++k) jets[i].v[static_cast<int>(k)] = s(first + k)[i];
      }
      typename LoadingRate<Jet, Jet, K>::Rate f;
      if (!chunk->rate(system_.template state<Jet>(jets.data()), f)) return false;
      system_.spread(f, chunk->rate.strain_rate(), [&](int i, const Jet& value) {
        for (std::size_t k = 0; k < chunk->count; ++k) ds(first + k)[i] = value.v[static_cast<int>(k)];
      });
      first += chunk->count;
    }
    return true;
  }

 private:
  static constexpr std::size_t kWidth = 8;  // fills vector registers whole
  using Jet = ceres::Jet<double, static_cast<int>(kWidth)>;

  /// The law and the increment with the derivatives of up to kWidth directions.
  struct Chunk {
    Chunk(const model::Law<double>& plain_law, const Increment<double>& plain_increment,
          const Direction* directions, std::size_t direction_count)
        : count(direction_count),
          law(parameters(plain_law.parameters(), directions, direction_count)),
          increment(loading(plain_increment, directions, direction_count)),
          rate(law, increment) {}
    Chunk(const Chunk&) = delete;  // the rate refers to members
    Chunk& operator=(const Chunk&) = delete;

    static model::Parameters<Jet> parameters(const model::Parameters<double>& plain,
                                             const Direction* directions, std::size_t count) {
      model::ParameterValues<Jet> values = plain.cast<Jet>().values();
      for (std::size_t i = 0; i < model::kParameterCount; ++i) {
        for (std::size_t k = 0; k < count; ++k)
          values.values[i].v[static_cast<int>(k)] = directions[k].parameters[i];
      }
      return model::Parameters<Jet>::create(values).value();  // the plain values were admissible before
    }

    static Increment<Jet> loading(const Increment<double>& plain, const Direction* directions,
                                  std::size_t count) {
      Increment<Jet> result = plain.cast<Jet>();
      for (int i = 0; i < 6; ++i) {
        for (std::size_t k = 0; k < count; ++k) {
          result.strain_rate[i].v[static_cast<int>(k)] = directions[k].strain_rate[i];
          result.stress_rate[i].v[static_cast<int>(k)] = directions[k].stress_rate[i];
        }
      }
      return result;
    }

    std::size_t count;
    model::Law<Jet> law;
    Increment<Jet> increment;
    LoadingRate<Jet, Jet, K> rate;
  };

  const System& system_;
  std::vector<std::unique_ptr<Chunk>> chunks_;
};

}  // namespace isotach::integrators
