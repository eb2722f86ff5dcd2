// Copyright Isotach contributors. SPDX-License-Identifier: BSD-3-Clause
// An elastic slab as a body of points on a grid of its own, for mud to rest on (Engine::rest_on).
#pragma once

#include <memory>

#include "mpm/elastic_slab.hpp"
#include "mpm/engine.hpp"

namespace isotach::mpm {

/// What presses on the slab from the start, so that it begins at rest.
struct SlabLoad {
  double pressure = 0.0;  ///< Pa, >= 0
  double radius = 0.0;    ///< m; on what lies within
};

/// The slab on cells of `cell_size` (m), its lower face fixed.
///
/// It is as thick as the nearest number of whole cells, at least one, since its upper face has to lie between
/// two rows of nodes; modulus and density are changed so that what an area of it weighs, and how far it gives
/// way to pressure and to shear, remains that of the slab as it is. Its waves cross it in the same time. In
/// the plane of the slab the stiffness is then not the same, which one that is held below does not feel.
///
/// The slab bears its own weight from before: gravity does not act on it. The load that presses on it from
/// the start has a stress of that pressure below it, vertical only, which is in equilibrium as it stands, and
/// which answers as any other when the load leaves; the face is at rest where it is.
[[nodiscard]] std::unique_ptr<Engine> slab_engine(const ElasticSlab& slab, double cell_size,
                                                  const SlabLoad& load, const EngineSettings& settings);

}  // namespace isotach::mpm
