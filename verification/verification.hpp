// Copyright Isotach contributors. SPDX-License-Identifier: BSD-3-Clause
// All studies of the law and its integration, run one after the other.
#pragma once

#include <atomic>
#include <cstdint>
#include <functional>
#include <optional>
#include <string_view>
#include <vector>

#include "verification/check.hpp"
#include "verification/convergence.hpp"
#include "verification/cross_check.hpp"
#include "verification/random_paths.hpp"
#include "verification/reference_rows.hpp"
#include "verification/tangents.hpp"
#include "verification/work_precision.hpp"

namespace isotach::verification {

/// How much is sampled at random.
enum class Sampling {
  quick,  ///< for tests
  full    ///< for the report
};

struct VerificationPlan {
  Sampling sampling = Sampling::full;
  std::uint64_t seed = 1;
  int threads = 1;
  std::function<void(double, std::string_view)> progress{};  ///< share done, and what is being done
  const std::atomic<bool>* stop = nullptr;                   ///< set: end as soon as may be
};

struct Verification {
  VerificationPlan plan;
  ReferenceTable references;
  ConvergenceStudy convergence;
  RandomPathStudy random_paths;
  TangentStudy tangents;
  std::vector<CrossCheckCurve> curves;
  std::vector<WorkPrecision> work;
  std::vector<Check> checks;  ///< of all studies, in their order

  [[nodiscard]] std::size_t failed() const;
};

/// Runs everything; nullopt where it was stopped.
[[nodiscard]] std::optional<Verification> verify(const VerificationPlan& plan);

}  // namespace isotach::verification
