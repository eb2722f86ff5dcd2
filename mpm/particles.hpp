// Copyright Isotach contributors. SPDX-License-Identifier: BSD-3-Clause
// The material points, as a structure of arrays.
#pragma once

#include <array>
#include <cstddef>
#include <vector>

#include "model/state.hpp"

namespace isotach::mpm {

/// Material points of an axisymmetric body. Mass and volume are per radian. Arrays have padded() entries, so
/// that packs of lanes may run past the last point; the padding repeats a valid state and has no mass.
///
/// Stress components are those of a plane Mandel vector: rr, zz, hoop, sqrt2 rz; tension positive (Pa).
struct Particles {
  std::size_t count = 0;

  std::vector<double> r, z;                              ///< position (m)
  std::vector<double> velocity_r, velocity_z;            ///< m/s
  std::vector<double> path_velocity_r, path_velocity_z;  ///< of the grid at the point, which moves it (m/s)
  std::vector<double> c_rr, c_rz, c_zr, c_zz;  ///< affine velocity dv_r/dr, dv_r/dz, dv_z/dr, dv_z/dz (1/s)
  std::vector<double> mass;                    ///< kg/rad
  std::vector<double> solid_volume;            ///< m3/rad; the volume is solid_volume (1 + e)
  std::array<std::vector<double>, 4> stress;   ///< effective stress (Pa)
  std::vector<double> void_ratio;
  std::array<std::vector<double>, 4>
      omega;  ///< anisotropy tensor (-), plane Mandel; empty where it stays zero
  std::vector<double> initial_pore_pressure;       ///< u at e = e0 (Pa), compression positive
  std::array<std::vector<double>, 4> strain_rate;  ///< of the last step (1/s), volumetric part averaged
  std::vector<double> spin;                        ///< W_rz of the last step (1/s)
  std::vector<double> divergence;                  ///< tr D of the last step, before averaging (1/s)
  std::vector<double> total_pressure;              ///< p' + u (Pa), compression positive

  /// Number of entries of each array for a body of n points.
  [[nodiscard]] static std::size_t padded(std::size_t n, std::size_t lanes) {
    return (n + lanes - 1) / lanes * lanes;
  }

  /// Calls f(array) for every array that all bodies have: omega is left out.
  template <class F>
  void for_each_array(F&& f) {
    for (auto* a :
         {&r, &z, &velocity_r, &velocity_z, &path_velocity_r, &path_velocity_z, &c_rr, &c_rz, &c_zr, &c_zz,
          &mass, &solid_volume, &void_ratio, &initial_pore_pressure, &spin, &divergence, &total_pressure}) {
      f(*a);
    }
    for (auto& a : stress) f(a);
    for (auto& a : strain_rate) f(a);
  }

  [[nodiscard]] double volume(std::size_t i) const { return solid_volume[i] * (1.0 + void_ratio[i]); }

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
