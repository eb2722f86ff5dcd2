// Copyright Isotach contributors. SPDX-License-Identifier: BSD-3-Clause
// read_slump_file: values in SI, what is assumed, and mistakes named with their line.
#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "datasets/slump_file.hpp"
#include "tests/unit/datasets_files.hpp"

namespace isotach::datasets {
namespace {

constexpr std::string_view kSlump = R"([material]
e100 = 1.358
lambda = 0.154
kappa = 0.0129
I_v = 0.02
D_r_per_s = 6.8e-7
phi_c_deg = 14.2
C_1 = 0.03
[mud]
undrained_strength_kPa = 0.117
strength_rate_per_s = 0.01
[mould]
diameter_mm = 78
fill_height_mm = 70
lift_speed_m_per_s = 0.01
[output]
times_s = [1, 2.5]
)";

class SlumpFileTest : public testing::Test {
 protected:
  TemporaryFolder folder_;
};

TEST_F(SlumpFileTest, ComesOutInSI) {
  const SlumpFile slump = read_slump_file(folder_.write("slump.toml", kSlump));
  EXPECT_DOUBLE_EQ(slump.material.I_v(), 0.02);
  EXPECT_FALSE(slump.setup.mud.void_ratio.has_value());
  EXPECT_DOUBLE_EQ(slump.setup.mud.undrained_strength.value(), 117.0);
  EXPECT_DOUBLE_EQ(slump.setup.mud.strength_rate.value(), 0.01);
  EXPECT_DOUBLE_EQ(slump.setup.mould.fill_height, 0.07);
  EXPECT_EQ(slump.setup.times, (std::vector{1.0, 2.5}));
  EXPECT_EQ(slump.assumptions.size(), 4U);  // specific gravity, OCR, wall, base
}

TEST_F(SlumpFileTest, MistakesAreNamed) {
  const auto refused = [&](std::string_view from, std::string_view to,
                           std::initializer_list<std::string_view> parts) {
    const auto file = folder_.write("slump.toml", replaced(std::string(kSlump), from, to));
    expect_input_error([&] { static_cast<void>(read_slump_file(file)); }, parts);
  };
  refused("[1, 2.5]", "[2.5, 1]", {"slump.toml:17: key times_s in [output]: 1 after 2.5", "increasing"});
  refused("[1, 2.5]", "[0, 1]", {"slump.toml:17: key times_s", "0 is out of range"});
  refused("[1, 2.5]", "[]", {"slump.toml:17: key times_s", "empty list"});
  refused("[1, 2.5]", "3", {"slump.toml:17: key times_s", "3; accepted: a list"});
  refused("times_s = [1, 2.5]", "", {"slump.toml:16: key times_s in [output]: it is missing"});
  refused("[output]", "[outputs]", {"slump.toml:16: key outputs: it is unknown"});
  refused("[output]\ntimes_s = [1, 2.5]\n", "", {"table [output]: it is missing"});
  refused("[mud]", "[effects]\nlift_delay = { delay_s = 1 }\n[mud]", {"slump.toml:9: table [effects]"});
  refused("diameter_mm = 78", "diameter_mm = 7.8",
          {"cell_size_mm", "4 is out of range (its default)", "3.9"});
}

TEST_F(SlumpFileTest, WhatIsNoTomlFileIsRefused) {
  expect_input_error([&] { static_cast<void>(read_slump_file(folder_.path())); }, {"it is a directory"});
  expect_input_error([&] { static_cast<void>(read_slump_file(folder_.write("slump.toml", ""))); },
                     {"slump.toml: file: it is empty"});
}

}  // namespace
}  // namespace isotach::datasets
