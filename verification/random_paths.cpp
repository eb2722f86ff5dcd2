// Copyright Isotach contributors. SPDX-License-Identifier: BSD-3-Clause
#include "verification/random_paths.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

#include "calibration/parallel.hpp"
#include "verification/random_path.hpp"

namespace isotach::verification {

namespace {

constexpr int kParts = 4;               // of an increment, with a checkpoint at the end of each
constexpr double kPressureGone = 1e-3;  // of p at the start
constexpr double kReferenceTolerance = 1e-10;
constexpr double kTightest = 1e-12;  // of CVODE, which checks the reference
constexpr double kAccepted = 10.0;   // error over tolerance
constexpr double kShare = 0.999;

double pressure(const State& state) {
  return model::trace<double, 6>(state.stress) / -3.0;
}

/// Fails as a law does that has no answer, not as an integrator that gives up.
bool is_domain(integrators::FailureKind kind) {
  return kind == integrators::FailureKind::outside_domain ||
         kind == integrators::FailureKind::substep_underflow;
}

Increment<double> part_of(const Increment<double>& increment) {
  Increment<double> part = increment;
  part.duration /= kParts;
  return part;
}

/// Largest difference of CVODE from the reference at the end of the path; nullopt where either fails.
std::optional<double> reference_error(const Path& path) {
  const auto reference = follow(path, options_of(integrators::Method::rosenbrock, kReferenceTolerance));
  const auto cvode = follow(path, options_of(integrators::Method::cvode, kTightest));
  if (!reference || !cvode) return std::nullopt;
  return achieved_error(reference->state, cvode->state);
}

}  // namespace

const char* name(PathOutcome outcome) {
  switch (outcome) {
    case PathOutcome::complete:
      return "complete";
    case PathOutcome::pressure_gone:
      return "p below 1e-3 of its start";
    case PathOutcome::domain_left:
      return "left the law's domain";
    case PathOutcome::failed:
      return "failed";
    case PathOutcome::no_reference:
      return "no reference";
  }
  return "";
}

PathRecord examine(const Path& path, std::uint64_t index, double tolerance) {
  PathRecord record;
  record.index = index;
  const Law law(path.parameters);
  const Options options = options_of(integrators::Method::fellin_ostermann, tolerance);
  const Options reference_options = options_of(integrators::Method::rosenbrock, kReferenceTolerance);
  State state = path.start;
  State reference = path.start;
  const double least = kPressureGone * pressure(path.start);
  for (const auto& increment : path.increments) {
    const Increment<double> part = part_of(increment);
    for (int k = 0; k < kParts; ++k) {
      const auto exact = integrators::integrate(law, reference, part, reference_options);
      if (!exact) {
        const bool domain = is_domain(exact.error().kind);
        record.outcome = domain ? PathOutcome::domain_left : PathOutcome::no_reference;
        record.message = exact.error().message();
        return record;
      }
      if (pressure(exact->state) < least) {
        record.outcome = PathOutcome::pressure_gone;
        return record;
      }
      record.log_length += std::abs(std::log(exact->state.stress.norm() / reference.stress.norm()));
      reference = exact->state;
      record.least_F = std::min(record.least_F, law.measures(reference.stress).F);
      const auto got = integrators::integrate(law, state, part, options);
      if (!got) {
        record.outcome = PathOutcome::failed;
        record.message = got.error().message();
        return record;
      }
      state = got->state;
      record.length += part.strain_rate.norm() * part.duration;
      record.substeps += got->statistics.accepted;
      record.evaluations += got->statistics.evaluations;
      record.error = std::max(record.error, achieved_error(state, reference));
    }
  }
  return record;
}

RandomPathStudy random_path_study(const SamplingPlan& plan, const std::function<void(double)>& progress,
                                  const std::atomic<bool>* stop) {
  constexpr std::size_t kBatch = 64;
  RandomPathStudy study{plan, std::vector<PathRecord>(plan.paths), {}};
  const std::size_t batches = (plan.paths + kBatch - 1) / kBatch;
  const auto stopping = [stop] { return stop != nullptr && stop->load(); };
  std::atomic<std::size_t> done{0};
  calibration::parallel_for(batches, plan.threads, [&](std::size_t batch) {
    if (stopping()) return;
    const std::size_t end = std::min(plan.paths, (batch + 1) * kBatch);
    for (std::size_t i = batch * kBatch; i < end; ++i) {
      study.records[i] = examine(random_path(plan.seed, i), i, plan.tolerance);
    }
    if (progress) progress(static_cast<double>(++done) / static_cast<double>(batches));
  });
  std::vector<std::optional<double>> errors(std::min(plan.cross_checks, plan.paths));
  calibration::parallel_for(errors.size(), plan.threads, [&](std::size_t i) {
    if (!stopping() && study.records[i].outcome == PathOutcome::complete) {
      errors[i] = reference_error(random_path(plan.seed, i));
    }
  });
  for (const auto& error : errors) {
    if (error) study.reference_errors.push_back(*error);
  }
  study.stopped = stopping();
  return study;
}

std::size_t RandomPathStudy::count(PathOutcome outcome) const {
  return static_cast<std::size_t>(
      std::count_if(records.begin(), records.end(),
                    [outcome](const PathRecord& record) { return record.outcome == outcome; }));
}

std::vector<double> RandomPathStudy::errors_over_tolerance() const {
  std::vector<double> errors;
  for (const PathRecord& record : records) {
    if (record.substeps > 0) errors.push_back(record.error / plan.tolerance);
  }
  std::sort(errors.begin(), errors.end());
  return errors;
}

std::vector<double> RandomPathStudy::errors_over_path() const {
  std::vector<double> errors;
  for (const PathRecord& record : records) {
    if (record.substeps > 0) {
      errors.push_back(record.error / (plan.tolerance * std::max(1.0, record.length / 0.1)));
    }
  }
  std::sort(errors.begin(), errors.end());
  return errors;
}

std::size_t RandomPathStudy::worst() const {
  const auto larger = [](const PathRecord& a, const PathRecord& b) { return a.error < b.error; };
  return static_cast<std::size_t>(std::max_element(records.begin(), records.end(), larger) - records.begin());
}

double quantile(const std::vector<double>& sorted, double q) {
  if (sorted.empty()) return std::numeric_limits<double>::quiet_NaN();
  const auto last = static_cast<double>(sorted.size() - 1);
  return sorted[static_cast<std::size_t>(std::llround(q * last))];
}

std::vector<Check> checks_of(const RandomPathStudy& study) {
  const char* const group = "random paths";
  const std::string scheme = fmt::format("fellin-ostermann {:.0e}", study.plan.tolerance);
  const auto errors = study.errors_over_tolerance();
  const auto within =
      static_cast<double>(std::upper_bound(errors.begin(), errors.end(), kAccepted) - errors.begin());
  const double share = errors.empty() ? 0.0 : within / static_cast<double>(errors.size());
  const double worst_reference =
      study.reference_errors.empty()
          ? std::numeric_limits<double>::quiet_NaN()
          : *std::max_element(study.reference_errors.begin(), study.reference_errors.end());
  return {{group, fmt::format("failures in {} paths", study.records.size()), scheme, 0.0,
           static_cast<double>(study.count(PathOutcome::failed)), 0.0, "none is the aim"},
          {group, "paths without a reference", scheme, 0.0,
           static_cast<double>(study.count(PathOutcome::no_reference)), 0.0, "none is the aim"},
          {group, "share of paths whose error is above 10 TOL", scheme, 0.0, 1.0 - share, 1.0 - kShare,
           "at least 99.9 % must be within"},
          {group,
           fmt::format("error of the reference over TOL, worst of {} paths", study.reference_errors.size()),
           "rosenbrock 1e-10 against cvode 1e-12", 0.0, worst_reference / study.plan.tolerance, 0.1,
           "two independent integrators"}};
}

}  // namespace isotach::verification
