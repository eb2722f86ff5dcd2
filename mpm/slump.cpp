// Copyright Isotach contributors. SPDX-License-Identifier: BSD-3-Clause
#include "mpm/slump.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <system_error>

#include "mpm/archive.hpp"
#include "mpm/checkpoint.hpp"
#include "mpm/slump_run.hpp"

namespace isotach::mpm {

namespace {

constexpr int kHistoryRows = 300;
constexpr double kEarliestHistory = 0.02;  // s; rows are dense early, when the slump is fast
constexpr long kStepsBetweenChecks = 256;
// Of the potential energy at the start. Sound runs lose or gain some hundredths with the coarsest cells; one
// that has gone unstable gains more than there was within milliseconds.
constexpr double kMostEnergyError = 0.25;

/// Times of history rows: geometric from kEarliestHistory to the end, and the output times.
std::vector<double> history_times(const std::vector<double>& outputs) {
  const double end = outputs.back();
  std::vector<double> times = outputs;
  const double first = std::min(kEarliestHistory, end);
  for (int i = 0; i <= kHistoryRows; ++i)
    times.push_back(first * std::pow(end / first, double(i) / kHistoryRows));
  std::sort(times.begin(), times.end());
  times.erase(std::unique(times.begin(), times.end()), times.end());
  while (times.back() > end) times.pop_back();
  return times;
}

double energy(const HistoryRow& row) {
  return row.kinetic + row.potential + row.stress_work + row.boundary_work;
}

/// Takes a frame where one is due: the first of `times` after the last frame's has been reached.
void take_frame(const SlumpRun& run, const std::vector<double>& times, std::vector<Frame>& frames) {
  const auto due =
      frames.empty() ? times.begin() : std::upper_bound(times.begin(), times.end(), frames.back().time);
  if (due != times.end() && *due <= run.time()) frames.push_back(run.frame());
}

/// Keeps a run's state on disk, now and then.
class Keeper {
 public:
  Keeper(const model::Parameters<double>& parameters, const SlumpSetup& setup, const RunOptions& options)
      : file_(options.checkpoint),
        interval_(options.checkpoint_interval),
        key_(run_key(parameters, setup, options.history, options.snapshots, options.frames)) {}

  /// Goes on from what is on disk. Returns whether there was something.
  [[nodiscard]] bool resume(SlumpRun& run, SlumpResult& result, std::size_t& target) const {
    if (file_.empty()) return false;
    const auto state = read_checkpoint(file_, key_);
    if (!state) return false;
    Archive archive(*state);
    visit(archive, run, result, target);
    return archive.complete();
  }
  /// A state to come back to; goes to disk if that is due.
  void remember(SlumpRun& run, SlumpResult& result, std::size_t target) {
    if (file_.empty()) return;
    Archive archive;
    visit(archive, run, result, target);
    good_ = archive.bytes();
    const auto now = std::chrono::steady_clock::now();
    if (std::chrono::duration<double>(now - last_).count() < interval_) return;
    last_ = now;
    write();
  }
  /// Puts the state remembered last on disk. A run that cannot is still a run.
  void write() const {
    if (!file_.empty() && !good_.empty()) static_cast<void>(write_checkpoint(file_, key_, good_));
  }
  /// The run is over.
  void drop() const {
    std::error_code error;
    if (!file_.empty()) std::filesystem::remove(file_, error);
  }

 private:
  static void visit(Archive& archive, SlumpRun& run, SlumpResult& result, std::size_t& target) {
    archive(run);
    archive(result);
    archive(target);
  }

  std::filesystem::path file_;
  double interval_;
  std::uint64_t key_;
  std::string good_;
  std::chrono::steady_clock::time_point last_ = std::chrono::steady_clock::now();
};

}  // namespace

tl::expected<SlumpResult, SlumpFailure> run_slump(const model::Parameters<double>& parameters,
                                                  const SlumpSetup& setup, const RunOptions& options) {
  const auto begin = std::chrono::steady_clock::now();
  const double void_ratio = initial_state(parameters, setup.mud).void_ratio;
  if (!(void_ratio > 0.5 * std::abs(setup.effects.void_ratio_gradient))) {
    return tl::unexpected(SlumpFailure{
        SlumpFailure::Kind::bad_setup, 0.0, 0.0, 0.0,
        fmt::format(
            "void ratio {:.4g} with a difference of {:.4g} over the height: no voids are left somewhere",
            void_ratio, setup.effects.void_ratio_gradient)});
  }
  SlumpRun run(parameters, setup);
  SlumpResult result;
  result.initial = run.initial();
  result.cell_size = run.cell_size();
  result.points = run.particles().count;
  const HistoryRow start = run.history_row();
  const double outline_volume_0 = run.outline().volume();
  const std::vector<double> frames = frame_times(setup.times.back(), options.frames);
  const std::vector<double> targets = options.history ? history_times(setup.times) : setup.times;
  Keeper keeper(parameters, setup, options);
  std::size_t next = 0;
  if (!keeper.resume(run, result, next)) result.history.push_back(start);

  for (; next < targets.size(); ++next) {
    const double target = targets[next];
    while (run.time() < target) {
      if (auto failure = run.step(target)) {
        keeper.write();
        return tl::unexpected(*failure);
      }
      take_frame(run, frames, result.frames);
      if (run.steps() % kStepsBetweenChecks != 0) continue;
      keeper.remember(run, result, next);
      if (options.stop != nullptr && options.stop->load()) {
        keeper.write();
        return tl::unexpected(
            SlumpFailure{SlumpFailure::Kind::interrupted, run.time(), 0.0, 0.0, "the run was interrupted"});
      }
      if (std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count() >
          options.time_limit) {
        keeper.write();
        return tl::unexpected(SlumpFailure{
            SlumpFailure::Kind::timed_out, run.time(), 0.0, 0.0,
            fmt::format(
                "the run took longer than its limit of {:g} s of wall time; it had reached t = {:.3f} s",
                options.time_limit, run.time())});
      }
      if (options.progress) {
        const double left = (targets.back() - run.time()) / run.last_step();
        options.progress(run.time(),
                         static_cast<double>(run.steps()) / (static_cast<double>(run.steps()) + left));
      }
    }
    result.history.push_back(run.history_row());
    const HistoryRow& row = result.history.back();
    result.volume_error = std::max(result.volume_error, std::abs(row.volume / start.volume - 1.0));
    result.energy_error =
        std::max(result.energy_error, std::abs(energy(row) - energy(start)) / start.potential);
    // the plain scheme loses energy by its nature
    const bool loses = setup.numerics.scheme == Scheme::plain && energy(row) < energy(start);
    if (result.energy_error > kMostEnergyError && !loses) {
      keeper.drop();  // to go on from here would be to go on with it
      return tl::unexpected(SlumpFailure{
          SlumpFailure::Kind::energy, run.time(), 0.0, 0.0,
          fmt::format(
              "the balance of energy is off by {:.0f} % of the mud's potential energy at t = {:.3f} s: "
              "the numerics are unstable",
              100.0 * result.energy_error, run.time())});
    }
    const std::size_t output = result.outlines.size();
    if (output < setup.times.size() && target == setup.times[output]) {
      result.outlines.push_back(run.outline());
      const Outline& outline = result.outlines.back();
      if (outline.points.size() < 3) {
        return tl::unexpected(SlumpFailure{SlumpFailure::Kind::no_outline, run.time(), 0.0, 0.0,
                                           "no outline from base to axis could be traced"});
      }
      result.outline_volume_error =
          std::max(result.outline_volume_error, std::abs(outline.volume() / outline_volume_0 - 1.0));
      if (options.snapshots) result.snapshots.push_back(run.snapshot());
      if (options.frames > 0) result.fields.push_back(run.frame());
    }
  }
  keeper.drop();
  result.steps = run.steps();
  result.particle_steps = static_cast<double>(run.steps()) * static_cast<double>(result.points);
  result.substepped = run.substepped();
  result.floored = run.floored();
  return result;
}

}  // namespace isotach::mpm
