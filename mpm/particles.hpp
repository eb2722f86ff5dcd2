// Copyright Isotach contributors. SPDX-License-Identifier: BSD-3-Clause
// The material points of a body, as a structure of arrays.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <vector>

#include "model/state.hpp"
#include "mpm/point_array.hpp"

namespace isotach::mpm {

/// Points that are moved together; a multiple of all packs.
inline constexpr std::size_t kBlock = 64;

/// Material points. Mass and volume are per radian of an axisymmetric body, per metre of a plane one; r and z
/// are then x and y. Arrays have padded() entries, so that packs of points may run past the last one; the
/// padding has neither mass nor volume, and where steps work on it, it repeats the last point.
///
/// Stress components are those of a plane Mandel vector: rr, zz, hoop, sqrt2 rz; tension positive (Pa).
struct Particles {
  std::size_t count = 0;

  PointArray r, z;                              ///< position (m)
  PointArray velocity_r, velocity_z;            ///< m/s
  PointArray c_rr, c_rz, c_zr, c_zz;            ///< affine part of the velocity, dv_r/dr, ... (1/s)
  PointArray grid_velocity_r, grid_velocity_z;  ///< of the grid at the point, which moves it (m/s)
  PointArray l_rr, l_rz, l_zr, l_zz;            ///< gradient of the grid's velocity (1/s)
  PointArray mass;                              ///< kg/rad
  PointArray solid_volume;                      ///< m3/rad; the volume is solid_volume (1 + e)
  PointArray void_ratio;                        ///< e; of a body without pores its volumetric strain J - 1
  PointArray reference_pressure;                ///< Pa, compression positive; what it means is the material's
  std::array<PointArray, 4> stress;             ///< effective stress (Pa)
  std::array<PointArray, 4> omega;       ///< anisotropy tensor (-), plane Mandel; empty where it stays zero
  std::array<PointArray, 4> resistance;  ///< stress beside the law's (Pa), as stress; empty where
                                         ///< there is none
  std::array<PointArray, 4> capillary;   ///< the same of surface tension
  PointArray log_strength;  ///< ln of a factor on p_B that stays with the point; empty where there is none
  PointArray structure;     ///< xi (-), 1 after long rest; empty where strength is the void ratio's alone

  /// Number of entries of each array for a body of n points.
  [[nodiscard]] static std::size_t padded(std::size_t n, std::size_t lanes) {
    return (n + lanes - 1) / lanes * lanes;
  }

  /// Calls f(array) for every array; those of omega and below may be empty.
  template <class F>
  void for_each_array(F&& f) {
    for (auto* a :
         {&r, &z, &velocity_r, &velocity_z, &c_rr, &c_rz, &c_zr, &c_zz, &grid_velocity_r, &grid_velocity_z,
          &l_rr, &l_rz, &l_zr, &l_zz, &mass, &solid_volume, &void_ratio, &reference_pressure}) {
      f(*a);
    }
    for (auto& a : stress) f(a);
    for_each_optional(f);
  }
  /// Calls f(array) for those that may be empty.
  template <class F>
  void for_each_optional(F&& f) {
    for (auto* tensor : {&omega, &resistance, &capillary}) {
      for (auto& a : *tensor) f(a);
    }
    f(log_strength);
    f(structure);
  }

  /// Makes the padding that shares a pack of `lanes` with points repeat the last one. Left to itself it would
  /// drift: it moves, but nothing looks after its state.
  void repeat_last(std::size_t lanes) {
    const std::size_t end = padded(count, lanes);
    for_each_array([this, end](PointArray& array) {
      if (array.empty() || &array == &mass || &array == &solid_volume) return;
      std::fill(array.begin() + static_cast<std::ptrdiff_t>(count),
                array.begin() + static_cast<std::ptrdiff_t>(end), array[count - 1]);
    });
  }

  template <class Archive>
  void visit(Archive& archive) {
    archive(count);
    for_each_array([&archive](PointArray& array) { archive(array); });
  }

  [[nodiscard]] double volume(std::size_t i) const { return solid_volume[i] * (1.0 + void_ratio[i]); }
  /// p' = -tr T/3 (Pa).
  [[nodiscard]] double mean_effective_pressure(std::size_t i) const {
    return -(stress[0][i] + stress[1][i] + stress[2][i]) / 3.0;
  }

  /// State of point i in the law's terms.
  [[nodiscard]] model::State<double, model::kPlane> state(std::size_t i) const {
    model::State<double, model::kPlane> result;
    for (std::size_t k = 0; k < stress.size(); ++k) {
      result.stress[static_cast<int>(k)] = stress[k][i];
      if (!omega[k].empty()) result.omega[static_cast<int>(k)] = omega[k][i];
    }
    result.void_ratio = void_ratio[i];
    return result;
  }
};

}  // namespace isotach::mpm
