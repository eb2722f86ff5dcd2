// Copyright Isotach contributors. SPDX-License-Identifier: BSD-3-Clause
// Discovery in all tests of a study: the oedometer's first, which tell the slumps what the material is.
#pragma once

#include <functional>
#include <string>

#include "experiments/slump_experiment.hpp"
#include "reports/discovery_report.hpp"

namespace isotach::app {

/// Which tests are looked at.
enum class TestsLookedAt { all, oedometer, slump };

struct DiscoverStudyOptions {
  int threads = 1;
  int slump_threads = 1;
  experiments::Simulate simulate;
  std::function<void(double, const std::string&)> progress;
  TestsLookedAt tests = TestsLookedAt::all;
};

/// Oedometer tests are fitted also where only slumps are looked at. Where the model, with what was named,
/// meets the oedometer tests, slumps start from its answer and hold its standard errors for what is known of
/// the material; else from that answer alone.
[[nodiscard]] tl::expected<reports::Discoveries, calibration::FitFailure> discover_study(
    const datasets::Study& study, const DiscoverStudyOptions& options);

}  // namespace isotach::app
