// Copyright Isotach contributors. SPDX-License-Identifier: BSD-3-Clause
// The seam between the motion of points and what they are made of.
#pragma once

#include <array>
#include <cstddef>

#include "mpm/particles.hpp"

namespace isotach::mpm {

/// Points whose stress is updated together: many, so that the few that need more work can share it.
inline constexpr std::size_t kChunk = 1024;

/// The motion of some points in a step, and what comes of it. Entries belong to the points from `begin`
/// on; those past the body's last point are its padding.
struct MaterialChunk {
  std::size_t begin = 0;                                              ///< a multiple of kBlock
  std::size_t count = 0;                                              ///< <= kChunk
  double time = 0.0;                                                  ///< s, at the start of the step
  double dt = 0.0;                                                    ///< s
  alignas(64) std::array<std::array<double, kChunk>, 4> strain_rate;  ///< plane Mandel (1/s)
  alignas(64) std::array<double, kChunk> spin;                        ///< W_rz (1/s)
  /// Where the strength is not the void ratio's alone: ln of the factor on p_B at each point; else null.
  const double* log_strength = nullptr;
  alignas(
      64) std::array<double, kChunk> total_pressure;  ///< out: mean total stress (Pa), compression positive
};

/// What a step met, added up over chunks.
struct MaterialCount {
  long substepped = 0;    ///< point updates that needed adaptive substeps of their own
  long floored = 0;       ///< point updates that ended at the least mean effective pressure
  double stiffest = 0.0;  ///< largest modulus of a plane wave met (Pa)

  MaterialCount& operator+=(const MaterialCount& other) {
    substepped += other.substepped;
    floored += other.floored;
    stiffest = stiffest > other.stiffest ? stiffest : other.stiffest;
    return *this;
  }
};

/// A constitutive law as the engine sees it. Stress in the points is what the law keeps; the total stress
/// that acts is its deviator and the total pressure that the law gives.
class Material {
 public:
  Material() = default;
  Material(const Material&) = delete;
  Material& operator=(const Material&) = delete;
  virtual ~Material() = default;

  /// Advances stress and void ratio of the chunk's points and gives their total pressures.
  virtual void update(Particles& particles, MaterialChunk& chunk, MaterialCount& count) const = 0;

  /// Total pressure of the points begin .. begin + count - 1 as they are (Pa).
  virtual void total_pressure(const Particles& particles, std::size_t begin, std::size_t count,
                              double* pressures) const = 0;

  /// Modulus of a plane wave at point i (Pa), > 0: with the density it limits the time step.
  [[nodiscard]] virtual double wave_modulus(const Particles& particles, std::size_t i) const = 0;
};

}  // namespace isotach::mpm
