// Copyright Isotach contributors. SPDX-License-Identifier: BSD-3-Clause
// A study of one oedometer test, whose keys a test of the readers writes.
#pragma once

#include <algorithm>
#include <string>
#include <string_view>

#include "datasets/study.hpp"
#include "tests/unit/datasets_files.hpp"

namespace isotach::datasets {

class SmallStudy : public testing::Test {
 protected:
  /// The material, [fit] as in `fit`, and one test "t" (line 9 where `fit` is empty) with the keys `test`.
  Study read_test(std::string_view test, std::string_view fit = "") const {
    constexpr std::string_view kMaterial =
        "[material]\ne100 = 1.4\nlambda = 0.15\nkappa = 0.02\nI_v = 0.03\nD_r_per_s = 1e-6\nphi_c_deg = "
        "30.0\nC_1 = 0.1\n";
    return read_study(folder_.write("study.toml", std::string(kMaterial) + std::string(fit) +
                                                      "[[oedometer]]\nname = \"t\"\n" + std::string(test)));
  }
  void expect_test_refused(std::string_view test, std::initializer_list<std::string_view> parts,
                           std::string_view fit = "") const {
    expect_input_error([&] { static_cast<void>(read_test(test, fit)); }, parts);
  }
  static bool assumes(const Study& study, std::string_view text) {
    return std::any_of(study.assumptions.begin(), study.assumptions.end(),
                       [&](const std::string& line) { return line.find(text) != std::string::npos; });
  }

  TemporaryFolder folder_;
};

}  // namespace isotach::datasets
