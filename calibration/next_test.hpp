// Copyright Isotach contributors. SPDX-License-Identifier: BSD-3-Clause
// Which test to make next: what each candidate would add to what a study's tests hold of I_v and C_1.
#pragma once

#include <functional>
#include <optional>
#include <string>
#include <tl/expected.hpp>
#include <vector>

#include "calibration/fit_result.hpp"
#include "calibration/information.hpp"
#include "calibration/simulation_error.hpp"
#include "datasets/candidates.hpp"
#include "datasets/study.hpp"

namespace isotach::calibration {

/// A test of the study that is fitted.
struct HeldTest {
  std::string name;
  std::size_t values = 0;
  int directions = 0;  ///< held by its data alone, see directions_held()
  Outlook alone;       ///< with what the study's tests together hold of all but I_v and C_1
  Outlook without;     ///< what the study's other tests hold
};

/// A test that could be made.
struct CandidateRating {
  std::string name;  ///< of a slump with its pictures: "test 1, early"
  std::string programme;
  bool slump = false;
  std::size_t values = 0;
  int directions = 0;           ///< held by its data alone, see directions_held()
  Outlook alone;                ///< with what the study's tests hold of all but I_v and C_1
  Outlook with_present;         ///< with the study's tests
  Outlook with_present_held;    ///< so, if all but I_v and C_1 were known exactly
  Eigen::MatrixXd information;  ///< of coordinates and numerics; empty where it failed
  std::string failure;          ///< why it could not be rated; empty where it could
};

/// A programme of tests.
struct ProgrammeRating {
  std::string name;
  std::vector<std::size_t> tests;  ///< of the candidates, each slump with its first choice of pictures
  Outlook alone;                   ///< with what the study's tests hold of all but I_v and C_1
  Outlook with_present;
  std::vector<Outlook> without;  ///< by test: the programme alone without it
};

/// One candidate after another, each the best once those before it are made.
struct SequenceStep {
  std::size_t candidate;
  Outlook after;
};

struct NextTest {
  std::vector<Coordinate> coordinates;  ///< all that is found along with I_v and C_1, these two among them
  Interest interest{};                  ///< I_v (its logarithm) and C_1 among them
  double reference_rate = 0.0;  ///< axial strain rate (1/s) at which the material's D_r is steady: the gauge
  Outlook present;
  Outlook present_held;  ///< if all but I_v and C_1 were known exactly
  std::vector<HeldTest> tests;
  std::vector<CandidateRating> candidates;
  std::vector<ProgrammeRating> programmes;
  std::vector<SequenceStep> sequence;
  std::optional<std::pair<std::size_t, std::size_t>> pair;  ///< the two best together; may be one twice
  Outlook after_pair;
  SimulationError simulation_error;
  std::optional<double> stress_noise;  ///< level that candidates of oedometer tests are given (-)
  double stress_correlation = 0.0;     ///< of neighbouring readings
  mpm::RunCounts runs;
  std::vector<std::string> warnings;
};

/// ln det of the covariance of (ln I_v, C_1) before, less that after; NaN where it is not known before.
[[nodiscard]] double gain(const Outlook& before, const Outlook& after);

struct NextTestOptions {
  int threads = 1;
  const std::atomic<bool>* stop = nullptr;
  experiments::Simulate simulate;  ///< where empty, plain_simulation()
  /// Fraction of the work done, and what is being done; may be empty.
  std::function<void(double, const std::string&)> progress;
};

/// Rates the candidates at the study's material, which is taken for the present fit. Data enter only by what
/// they would hold: J'C^-1J of each test, J exact for oedometer tests and by differences of simulations for
/// slumps, C as the fits have it. Everything that either list of [fit] moves is found along with I_v and C_1,
/// the starts of oedometer tests as far as they are free too. What other cells and points would do to all
/// outlines together has an amplitude of its own for each change, of unit variance, found along as well.
[[nodiscard]] tl::expected<NextTest, FitFailure> rate_candidates(const datasets::Study& study,
                                                                 const datasets::Candidates& candidates,
                                                                 const NextTestOptions& options);

}  // namespace isotach::calibration
