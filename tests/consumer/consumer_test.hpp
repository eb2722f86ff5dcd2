// Copyright Isotach contributors. SPDX-License-Identifier: BSD-3-Clause
// What the tests of the program share: a working folder, and runs whose traces can be looked for.
#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <initializer_list>
#include <iterator>
#include <string>
#include <string_view>
#include <vector>

#include "tests/consumer/program.hpp"
#include "tests/unit/datasets_files.hpp"

namespace isotach::consumer {

/// Runs the program in a folder of the test's own; what it prints is kept in another, so that whatever
/// appears in the first was left by the program.
class ConsumerTest : public testing::Test {
 protected:
  [[nodiscard]] const std::filesystem::path& folder() const { return folder_.path(); }
  std::filesystem::path write(std::string_view name, std::string_view content) const {
    return folder_.write(name, content);
  }

  /// Of the program, begun by `launcher` where there is one, with these arguments.
  [[nodiscard]] Process start(const std::vector<std::string>& arguments,
                              std::vector<std::string> launcher = {}) const {
    launcher.emplace_back(ISOTACH_PROGRAM);
    launcher.insert(launcher.end(), arguments.begin(), arguments.end());
    return start_command(std::move(launcher));
  }
  [[nodiscard]] Process start_command(std::vector<std::string> command) const {
    return {std::move(command), folder(), streams_.path() / "streams"};
  }
  [[nodiscard]] Ended run(const std::vector<std::string>& arguments) const { return start(arguments).wait(); }

  [[nodiscard]] std::string contents(const std::string& name) const {
    std::ifstream in(folder() / name, std::ios::binary);
    return {std::istreambuf_iterator<char>(in), std::istreambuf_iterator<char>()};
  }
  /// Names of all that is in the working folder and below, sorted.
  [[nodiscard]] std::vector<std::string> everything() const {
    std::vector<std::string> names;
    for (const auto& entry : std::filesystem::recursive_directory_iterator(folder())) {
      names.push_back(entry.path().lexically_relative(folder()).string());
    }
    std::sort(names.begin(), names.end());
    return names;
  }

  /// Expects exit code 2, one message on stderr that holds all `parts`, and no trace in the working folder.
  void expect_refused(std::vector<std::string> arguments,
                      std::initializer_list<std::string_view> parts) const {
    const std::vector<std::string> before = everything();
    for (const char* option : {"--out", "new/results"}) arguments.emplace_back(option);
    const Ended ended = run(arguments);
    EXPECT_EQ(ended.code, 2);
    EXPECT_EQ(ended.out, "");
    for (const std::string_view part : parts) {
      EXPECT_NE(ended.err.find(part), std::string::npos) << "\"" << part << "\" is not in: " << ended.err;
    }
    EXPECT_EQ(std::count(ended.err.begin(), ended.err.end(), '\n'), 1) << ended.err;
    EXPECT_EQ(everything(), before);
  }

 private:
  datasets::TemporaryFolder folder_;
  datasets::TemporaryFolder streams_;
};

/// A cylinder of mud of the mould's radius, on cells so large that a run takes a fraction of a second.
inline constexpr std::string_view kTinySlump = R"([material]
e100 = 1.358
lambda = 0.154
kappa = 0.0129
I_v = 0.02
D_r_per_s = 6.8e-7
phi_c_deg = 14.2
C_1 = 0.03
[mud]
void_ratio = 3.891
specific_gravity = 2.65
ocr = 1.5
[mould]
diameter_mm = 78.0
fill_height_mm = 40.0
lift_speed_m_per_s = 0.06
wall = "smooth"
[base]
kind = "rough"
[numerics]
cell_size_mm = 13.0
[output]
times_s = [0.1, 0.3]
)";

}  // namespace isotach::consumer
