// Copyright Isotach contributors. SPDX-License-Identifier: BSD-3-Clause
// One slump simulation in progress: a mould full of mud, the mould raised.
#pragma once

#include <optional>

#include "mpm/engine.hpp"
#include "mpm/materials/vhp.hpp"
#include "mpm/slump.hpp"

namespace isotach::mpm {

/// The engine (engine.hpp) with what a slump test needs: mud that fills the mould at rest, in undrained
/// conditions, the mould's wall as a force on points, and a base. An elastic slab is a body with a grid of
/// its own below the mud's; heights are above its upper face as it stands under the fill, and energies the
/// mud's.
///
/// A background viscosity is a stress like any other and part of the stress work.
class SlumpRun {
 public:
  SlumpRun(const model::Parameters<double>& parameters, const SlumpSetup& setup);

  /// One time step, no longer than to `until` (s).
  [[nodiscard]] std::optional<SlumpFailure> step(double until);

  [[nodiscard]] double time() const { return engine_.time(); }
  [[nodiscard]] const Particles& particles() const { return engine_.bodies().front().particles; }
  /// Points of the elastic slab below the mud, their heights over its lower face; null where there is none.
  [[nodiscard]] const Particles* slab() const {
    return engine_.floor() ? &engine_.floor()->bodies().front().particles : nullptr;
  }
  [[nodiscard]] double cell_size() const { return engine_.grid().cell_size(); }
  [[nodiscard]] const InitialState& initial() const { return initial_; }
  [[nodiscard]] Outline outline() const { return trace_outline(particles(), cell_size(), time()); }
  [[nodiscard]] HistoryRow history_row() const;
  [[nodiscard]] Snapshot snapshot() const;
  [[nodiscard]] Frame frame() const;

  /// Saves or loads what steps change, of a run of the same parameters and setup.
  template <class Archive>
  void visit(Archive& archive) {
    archive(engine_);
  }
  /// Length of the last step (s); 0 before the first.
  [[nodiscard]] double last_step() const { return engine_.last_step(); }

  [[nodiscard]] long steps() const { return engine_.steps(); }
  [[nodiscard]] long substepped() const { return engine_.count().substepped; }
  [[nodiscard]] long floored() const { return engine_.count().floored; }

 private:
  /// Of point i, after the first step.
  [[nodiscard]] PointFields point_fields(std::size_t i) const;

  SlumpSetup setup_;
  InitialState initial_;
  Engine engine_;
  const VhpMaterial* mud_ = nullptr;  ///< of the first body
};

}  // namespace isotach::mpm
