// Copyright Isotach contributors. SPDX-License-Identifier: BSD-3-Clause
// Real results for the tests of reports, small enough to be made in seconds: fits of parts of mud-a on coarse
// cells, and a short slump.
#pragma once

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <iterator>
#include <string>

#include "calibration/calibrate.hpp"
#include "datasets/slump_file.hpp"
#include "datasets/study.hpp"
#include "reports/run_info.hpp"

namespace isotach::reports {

/// Cells that make a slump a matter of tenths of a second; what they cost in accuracy does not matter here.
inline constexpr double kCoarseCell = 0.013;
inline constexpr double kReferenceCell = 0.00975;

/// mud-a with crs-2 and the held-out crs-3, slump-2 and the held-out slump-4, the slumps' first two times
/// only.
inline const datasets::Study& small_study() {
  static const datasets::Study study = [] {
    datasets::Study small =
        datasets::read_study(std::filesystem::path(ISOTACH_SOURCE_DIR) / "datasets/mud-a/study.toml");
    small.oedometer_tests.erase(small.oedometer_tests.begin());
    // each parameter moved by one kind of test only, so that it is plain which fit a number must come from
    using enum model::ParameterId;
    small.fit.oedometer = {e100, lambda, kappa, D_r};
    small.slump_tests = {small.slump_tests[1], small.slump_tests[3]};
    for (datasets::SlumpTest& test : small.slump_tests) {
      test.outlines.resize(2);
      test.setup.times.resize(2);
      test.setup.numerics.cell_size = kCoarseCell;
      test.reference = test.setup.numerics;
      test.reference->cell_size = kReferenceCell;
    }
    return small;
  }();
  return study;
}

inline const calibration::Calibration& small_calibration() {
  static const calibration::Calibration result = [] {
    calibration::CalibrateOptions options;
    options.max_rounds = 1;
    return calibration::calibrate(small_study(), options).value();
  }();
  return result;
}

/// The study with a multi-start of three and a bootstrap of four.
inline const datasets::Study& assessed_study() {
  static const datasets::Study study = [] {
    datasets::Study assessed = small_study();
    assessed.fit.starts = 3;
    assessed.fit.bootstrap = 4;
    return assessed;
  }();
  return study;
}

/// Its oedometer fit with all of the assessment.
inline const calibration::OedometerFit& assessed_fit() {
  static const calibration::OedometerFit fit = [] {
    const datasets::Study& study = assessed_study();
    return calibration::fit_oedometer(study, study.material, study.fit.oedometer, {}).value();
  }();
  return fit;
}

inline const datasets::SlumpFile& short_slump_test() {
  static const datasets::SlumpFile test = [] {
    auto file = datasets::read_slump_file(std::filesystem::path(ISOTACH_SOURCE_DIR) /
                                          "datasets/checks/slump-test-1.toml");
    file.setup.numerics.cell_size = kCoarseCell;
    file.setup.times = {0.25, 0.5};
    return file;
  }();
  return test;
}

inline const mpm::SlumpResult& short_slump() {
  static const mpm::SlumpResult result = [] {
    mpm::RunOptions options;
    options.snapshots = true;
    options.frames = 10;
    return mpm::run_slump(short_slump_test().material, short_slump_test().setup, options).value();
  }();
  return result;
}

inline RunInfo run_of(const std::string& command) {
  return {
      .command = command, .version = "1.2.3", .input = "/somewhere/private/mud-a/study.toml", .seconds = 4.5};
}

/// A folder that lives as long as the test.
class ResultFolder : public ::testing::Test {
 protected:
  ResultFolder() {
    std::string name = (std::filesystem::temp_directory_path() / "isotach-reports-XXXXXX").string();
    if (mkdtemp(name.data()) == nullptr) throw std::runtime_error("no temporary folder");
    root_ = name;
  }
  ~ResultFolder() override {
    std::error_code ignored;
    std::filesystem::remove_all(root_, ignored);
  }

  [[nodiscard]] std::string content(const std::filesystem::path& name) const {
    std::ifstream file(root_ / name, std::ios::binary);
    return {std::istreambuf_iterator<char>(file), {}};
  }

  std::filesystem::path root_;
};

}  // namespace isotach::reports
