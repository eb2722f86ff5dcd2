// Copyright Isotach contributors. SPDX-License-Identifier: BSD-3-Clause
// What the variables of the launchers say.
#include <gtest/gtest.h>

#include <map>
#include <string>

#include "cluster/launch.hpp"

namespace isotach::cluster {
namespace {

int launched_with(const std::map<std::string, const char*>& variables) {
  return launched_together([&](const char* name) {
    const auto found = variables.find(name);
    return found == variables.end() ? nullptr : found->second;
  });
}

TEST(Launch, WithoutALauncherAProcessIsAlone) {
  EXPECT_EQ(launched_with({}), 1);
}

TEST(Launch, EachLauncherTellsTheNumberOfProcesses) {
  EXPECT_EQ(launched_with({{"OMPI_COMM_WORLD_SIZE", "8"}}), 8);
  EXPECT_EQ(launched_with({{"PMI_SIZE", "5"}}), 5);
  EXPECT_EQ(launched_with({{"SLURM_STEP_NUM_TASKS", "1000"}, {"PMIX_RANK", "3"}}), 1000);
}

// Slurm's variables are those of the job that mpirun, or a plain start, is part of.
TEST(Launch, MpirunWithinAJobOfSlurmTellsItsOwnNumber) {
  EXPECT_EQ(launched_with({{"SLURM_NTASKS", "16"}}), 1);
  EXPECT_EQ(launched_with({{"SLURM_STEP_NUM_TASKS", "2"}, {"OMPI_COMM_WORLD_SIZE", "16"}}), 16);
}

TEST(Launch, WhatIsNoNumberIsOneProcess) {
  EXPECT_EQ(launched_with({{"PMI_SIZE", "many"}}), 1);
  EXPECT_EQ(launched_with({{"PMI_SIZE", "-3"}}), 1);
}

}  // namespace
}  // namespace isotach::cluster
