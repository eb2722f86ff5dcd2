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
  refused("[mud]", "[effects]\nlift_delay = { delay_s = -1 }\n[mud]", {"delay_s", "-1", "accepted: "});
  refused("[mud]", "[effects]\nlift = { delay_s = 1 }\n[mud]", {"lift", "it is unknown"});
  refused("diameter_mm = 78", "diameter_mm = 7.8",
          {"cell_size_mm", "4 is out of range (its default)", "3.9"});
}

TEST_F(SlumpFileTest, WallsBasesAndLiftsComeOutInSI) {
  const auto setup = [&](std::string_view from, std::string_view to) {
    return read_slump_file(folder_.write("slump.toml", replaced(std::string(kSlump), from, to))).setup;
  };
  EXPECT_TRUE(setup("", "").mould.wall.is_smooth());
  const auto with = [&](const std::string& keys) {
    return setup("lift_speed_m_per_s = 0.01\n", "lift_speed_m_per_s = 0.01\n" + keys + "\n");
  };
  EXPECT_TRUE(with("wall = \"rough\"").mould.wall.is_rough());
  const mpm::Wall wall = with("wall = { adhesion_kPa = 0.05, friction = 0.2 }").mould.wall;
  EXPECT_DOUBLE_EQ(wall.adhesion, 50.0);
  EXPECT_DOUBLE_EQ(wall.friction, 0.2);
  EXPECT_DOUBLE_EQ(with("lift_delay_s = 0.5").mould.lift_delay, 0.5);
  EXPECT_DOUBLE_EQ(with("[base]\nkind = \"limited\"\nshear_limit_kPa = 0.1").base.friction.adhesion, 100.0);
  EXPECT_DOUBLE_EQ(with("[base]\nkind = \"navier\"\nslip_length_mm = 2").base.friction.slip_length, 0.002);
  EXPECT_FALSE(with("[base]\nkind = \"rough\"").base.friction.yields());
  EXPECT_FALSE(with("[base]\nkind = \"rough\"").base.slab.has_value());
  const mpm::Base elastic = with(
                                "[base]\nkind = \"elastic\"\nthickness_mm = 6\nlength_mm = 150\n"
                                "youngs_modulus_kPa = 2000\npoissons_ratio = 0.2")
                                .base;
  ASSERT_TRUE(elastic.slab.has_value());
  EXPECT_DOUBLE_EQ(elastic.slab->thickness, 0.006);
  EXPECT_DOUBLE_EQ(elastic.slab->length, 0.15);
  EXPECT_DOUBLE_EQ(elastic.slab->youngs_modulus, 2e6);
  EXPECT_DOUBLE_EQ(elastic.slab->poissons_ratio, 0.2);
  EXPECT_FALSE(elastic.friction.yields());
  const mpm::Mould filmed =
      setup("lift_speed_m_per_s = 0.01", "lift_times_s = [0.2, 1, 3]\nlift_heights_mm = [0, 10, 160]").mould;
  ASSERT_EQ(filmed.lift_table.size(), 3U);
  EXPECT_DOUBLE_EQ(filmed.rim(1.0), 0.01);
  EXPECT_DOUBLE_EQ(filmed.rim(2.0), 0.085);
}

// Pippi et al.'s slab, 5 mm thick and 0.2 m long; its stiffness they do not give.
TEST_F(SlumpFileTest, AnElasticBaseIsTheSeedsWhereNothingElseIsSaid) {
  const SlumpFile slump = read_slump_file(folder_.write(
      "slump.toml", replaced(std::string(kSlump), "[mould]", "[base]\nkind = \"elastic\"\n[mould]")));
  ASSERT_TRUE(slump.setup.base.slab.has_value());
  EXPECT_DOUBLE_EQ(slump.setup.base.slab->thickness, 0.005);
  EXPECT_DOUBLE_EQ(slump.setup.base.slab->length, 0.2);
  EXPECT_DOUBLE_EQ(slump.setup.base.slab->youngs_modulus, 1e6);
  EXPECT_DOUBLE_EQ(slump.setup.base.slab->poissons_ratio, 0.3);
  EXPECT_EQ(slump.assumptions.size(), 7U);  // specific gravity, OCR, wall, four of the base
}

TEST_F(SlumpFileTest, MistakesInWallsBasesAndLiftsAreNamed) {
  const auto refused = [&](const std::string& keys, std::initializer_list<std::string_view> parts) {
    const auto file =
        folder_.write("slump.toml", replaced(std::string(kSlump), "lift_speed_m_per_s = 0.01", keys));
    expect_input_error([&] { static_cast<void>(read_slump_file(file)); }, parts);
  };
  const std::string speed = "lift_speed_m_per_s = 0.01\n";
  refused(speed + "wall = { adhesion_kPa = -1 }", {"slump.toml:16: key adhesion_kPa", "-1 is out of range"});
  refused(speed + "wall = { cohesion = 1 }", {"key cohesion", "it is unknown"});
  refused(speed + "wall = \"sticky\"", {"slump.toml:16: key wall", "smooth", "rough"});
  refused("lift_times_s = [0, 1]", {"key lift_heights_mm in [mould]: it is missing"});
  refused("lift_times_s = [0]\nlift_heights_mm = [0]", {"key lift_times_s", "fewer than two"});
  refused("lift_times_s = [0, 1]\nlift_heights_mm = [0]", {"key lift_heights_mm", "1 heights for 2 times"});
  refused("lift_times_s = [0, 0]\nlift_heights_mm = [0, 1]", {"key lift_times_s", "0 follows 0"});
  refused("lift_times_s = [0, 1]\nlift_heights_mm = [2, 1]", {"key lift_heights_mm", "1 follows 2"});
  refused(speed + "lift_times_s = [0, 1]\nlift_heights_mm = [0, 1]", {"key lift_speed_m_per_s", "not both"});
  refused(speed + "[base]\nkind = \"limited\"", {"key shear_limit_kPa in [base]: it is missing"});
  const std::string elastic = speed + "[base]\nkind = \"elastic\"\n";
  refused(elastic + "thickness_mm = 0", {"slump.toml:18: key thickness_mm in [base]", "0 is out of range"});
  refused(elastic + "poissons_ratio = 0.5", {"key poissons_ratio", "0.5 is out of range", "<= 0.45"});
  refused(elastic + "youngs_modulus_kPa = -1", {"key youngs_modulus_kPa", "-1 is out of range", "> 0"});
  refused(elastic + "length_mm = 39", {"slump.toml:18: key length_mm", "more than the mould's radius, 39"});
  refused(elastic + "slip_length_mm = 1", {"key slip_length_mm", "it is unknown"});
  refused(elastic + "youngs_modulus_kPa = 2",
          {"slump.toml:18: key youngs_modulus_kPa in [base]: 2, with which", "a twentieth of a cell"});
  refused(speed + "[base]\nkind = \"rough\"\nslip_length_mm = 1", {"key slip_length_mm", "it is unknown"});
}

TEST_F(SlumpFileTest, WhatIsNoTomlFileIsRefused) {
  expect_input_error([&] { static_cast<void>(read_slump_file(folder_.path())); }, {"it is a directory"});
  expect_input_error([&] { static_cast<void>(read_slump_file(folder_.write("slump.toml", ""))); },
                     {"slump.toml: file: it is empty"});
}

}  // namespace
}  // namespace isotach::datasets
