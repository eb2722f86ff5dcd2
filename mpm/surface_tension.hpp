// Copyright Isotach contributors. SPDX-License-Identifier: BSD-3-Clause
// The tension of a free surface, as a stress of the points near it.
#pragma once

#include <vector>

#include "mpm/point_force.hpp"

namespace isotach::mpm {

/// The continuous surface stress of Lafaurie et al. (J. Comput. Phys. 113, 1994): gamma (I - n n) |grad c|,
/// c the share of the mud at the nodes (its volume there over the node's), n along grad c. A stress, so that
/// it makes neither momentum nor energy. c falls from 1 to 0 across a flat surface, where it is 1/2, over two
/// cells; points lie on the inner side of it only, so that they carry twice that. An edge sharper than a cell
/// is rounded as if it were no sharper. Axis and base are mirrors: no surface.
///
/// Gradients below kFaint/h, which uneven points inside have too, count as none.
class SurfaceTension final : public PointForce {
 public:
  /// `tension` gamma (N/m) of an axisymmetric body on that grid, whose points have Particles::capillary.
  SurfaceTension(double tension, const Grid& grid);

  void prepare(Particles& particles) override;
  void add(const ForceBlock& /*block*/) const override {}

  static constexpr double kFaint = 0.05;

 private:
  void fill(const Particles& particles);

  double tension_;
  double h_;
  std::size_t columns_;  ///< of nodes
  std::size_t rows_;
  bool on_base_;
  std::vector<double> share_;  ///< c (-) at nodes
};

}  // namespace isotach::mpm
