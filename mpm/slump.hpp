// Copyright Isotach contributors. SPDX-License-Identifier: BSD-3-Clause
// A slump test simulated by the axisymmetric material point method: what goes in, what comes out, what can
// fail.
#pragma once

#include <atomic>
#include <filesystem>
#include <functional>
#include <limits>
#include <string>
#include <tl/expected.hpp>
#include <vector>

#include "model/parameters.hpp"
#include "mpm/field_map.hpp"
#include "mpm/outline.hpp"
#include "mpm/particles.hpp"
#include "mpm/slump_setup.hpp"

namespace isotach::mpm {

/// One line of the history. Energies are those of the full body of revolution.
struct HistoryRow {
  double time;             ///< s
  double height;           ///< m, highest point of the outline
  double toe;              ///< m, largest radius of the outline
  double kinetic;          ///< J, with the inertia in use
  double potential;        ///< J
  double stress_work;      ///< J, done on the mud since the start
  double boundary_work;    ///< J, done by the mud on mould and base since the start
  double volume;           ///< m3, sum over the points
  double inertia_scaling;  ///< factor on inertia in use
};

/// The material points at an output time, for pictures.
struct Snapshot {
  double time;  ///< s
  Particles particles;
  std::vector<double> pore_pressure;            ///< Pa, compression positive
  std::vector<double> overconsolidation_ratio;  ///< -
  std::vector<double> strain_rate_norm;  ///< |D| of the last step (1/s), its mean part as the grid has it

  template <class Archive>
  void visit(Archive& archive) {
    archive(time);
    archive(particles);
    archive(pore_pressure);
    archive(overconsolidation_ratio);
    archive(strain_rate_norm);
  }
};

/// State the mud starts from.
struct InitialState {
  double void_ratio;
  double preconsolidation_pressure;  ///< p_B0 (Pa)
  double mean_effective_pressure;    ///< p' (Pa)
  double density;                    ///< kg/m3
  double undrained_strength;         ///< C_u (Pa) at strength_rate
  double strength_rate;              ///< |D| (1/s)
};

struct SlumpResult {
  InitialState initial;
  double cell_size = 0.0;  ///< m, used
  std::size_t points = 0;
  std::vector<Outline> outlines;    ///< at the times asked for
  std::vector<Snapshot> snapshots;  ///< likewise, if asked for
  std::vector<Frame> fields;        ///< likewise, if frames are asked for
  std::vector<Frame> frames;        ///< of an animation, if asked for
  std::vector<HistoryRow> history;
  double volume_error = 0.0;          ///< largest relative change of the points' volume
  double outline_volume_error = 0.0;  ///< largest relative difference of the outlines' volume from the start
  double energy_error = 0.0;  ///< largest |E_kin + E_pot + stress work + boundary work - E_0|/E_pot(0)
  long steps = 0;
  double particle_steps = 0.0;
  long substepped = 0;  ///< point updates that needed substeps
  long floored = 0;     ///< point updates that left the law's domain and were set to the least pressure

  /// What grows during a run.
  template <class Archive>
  void visit(Archive& archive) {
    archive(outlines);
    archive(snapshots);
    archive(fields);
    archive(frames);
    archive(history);
    archive(volume_error);
    archive(outline_volume_error);
    archive(energy_error);
  }
};

struct SlumpFailure {
  enum class Kind { bad_setup, left_grid, left_slab, not_finite, interrupted, timed_out, no_outline, energy };
  Kind kind;
  double time;  ///< s
  double r;     ///< m, where it has a place
  double z;     ///< m
  std::string message;
};

struct RunOptions {
  bool snapshots = false;
  bool history = true;  ///< rows between the output times as well
  /// Frames wanted of an animation, at frame_times(); those of times that one step passes are one. A frame is
  /// taken after the step that reaches its time and so changes nothing in the run.
  std::size_t frames = 0;
  /// Called now and then with the time reached (s) and the part of the work that is done, judged by the steps
  /// that are left at the length they have.
  std::function<void(double time, double done)> progress;
  /// Where the run's state is kept while it lasts, and gone on from where it is found; not at all where
  /// empty.
  std::filesystem::path checkpoint;
  double checkpoint_interval = 30.0;  ///< s of wall time between two
  /// The run ends with Kind::interrupted soon after this becomes true.
  const std::atomic<bool>* stop = nullptr;
  /// s of wall time from the call, after which the run ends with Kind::timed_out.
  double time_limit = std::numeric_limits<double>::infinity();
};

/// Initial state of the mud: e0 given, or solved from C_u by
/// q_cs = M p_B/2 [|D| (1 - C_1)/D_r]^I_v, C_u = q_cs/2, |D| = strength_rate (D_r where not given).
[[nodiscard]] InitialState initial_state(const model::Parameters<double>& parameters, const Mud& mud);

/// Undrained strength q/2 (Pa) at the critical state, in triaxial compression at the rate |D| (1/s), > 0, of
/// mud that keeps the void ratio it starts from: M p_B0/4 [|D| (1 - C_1)/D_r]^I_v.
[[nodiscard]] double critical_state_strength(const model::Parameters<double>& parameters,
                                             const InitialState& initial, double rate);

/// Total vertical stress on the base of the filled mould (Pa), compression positive.
[[nodiscard]] double fill_pressure(const model::Parameters<double>& parameters, const SlumpSetup& setup);

/// Void ratio at which the undrained strength at rate |D| (1/s) is `undrained_strength` (Pa).
[[nodiscard]] double void_ratio_from_strength(const model::Parameters<double>& parameters,
                                              double undrained_strength, double strength_rate);

/// Runs the setup to the last output time. The same input gives the same bytes at the same number of threads,
/// also where the run was interrupted and went on from its checkpoint.
[[nodiscard]] tl::expected<SlumpResult, SlumpFailure> run_slump(const model::Parameters<double>& parameters,
                                                                const SlumpSetup& setup,
                                                                const RunOptions& options = {});

}  // namespace isotach::mpm
