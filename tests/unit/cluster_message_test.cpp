// Copyright Isotach contributors. SPDX-License-Identifier: BSD-3-Clause
// What goes from rank to rank comes back to the last bit.
#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "cluster/message.hpp"
#include "tests/unit/journal_rows.hpp"

namespace isotach::cluster {
namespace {

using journal::Simulation;

/// Keys are made of every number that a result depends on, with all its digits.
std::string key_of(const Task& task) {
  return journal::Inputs(task.parameters, task.setup, "").key;
}

/// A setup none of whose fields has its default.
mpm::SlumpSetup rich_setup() {
  mpm::SlumpSetup setup = journal::small_setup();
  setup.mould = {0.1 / 3.0, 0.05, 0.017, {1.0 / 7.0, 0.1}, 0.02, {{0.0, 0.0}, {1.0 / 3.0, 0.02}}};
  setup.mud = {std::nullopt, 117.0 / 7.0, 1e-3, 2.7, 1.1};
  setup.base.friction = {0.3, 0.2, 0.001 / 3.0};
  setup.base.slab = mpm::ElasticSlab{0.006, 0.21, 1.1e6, 0.31};
  setup.numerics = {0.004 / 3.0, 9, 310e3, 0.7, 1e-3, 0.3, 2, 10.0};
  setup.times = {0.1, 1.0 / 3.0, 30.0};
  setup.wander = {mpm::WanderSlot::strength_in_rate, {0.1, 1.0 / 3.0}, {1.0 / 7.0, -0.2}};
  return setup;
}

TEST(Message, ATaskComesBackToTheLastBit) {
  const auto parameters = tests::seed_mud_with(model::ParameterId::I_v, std::nextafter(0.02, 1.0));
  for (const mpm::SlumpSetup& setup : {journal::small_setup(), rich_setup()}) {
    const Task task{parameters, setup, 1.0 / 3.0};
    const auto back = task_of(bytes_of(task));
    ASSERT_TRUE(back.has_value());
    EXPECT_EQ(key_of(*back), key_of(task));
    EXPECT_EQ(back->setup.numerics.threads, setup.numerics.threads);
    EXPECT_EQ(back->time_limit, task.time_limit);
  }
  Task other{parameters, rich_setup(), 1.0};
  other.setup.base.slab->poissons_ratio = std::nextafter(0.31, 1.0);
  EXPECT_NE(key_of(other), key_of({parameters, rich_setup(), 1.0}));
}

TEST(Message, AResultComesBackToTheLastBit) {
  const Simulation simulation = journal::simulate(tests::seed_mud(), journal::small_setup(), {});
  ASSERT_TRUE(simulation.result.has_value());
  const auto back = simulation_of(bytes_of(simulation));
  ASSERT_TRUE(back.has_value() && back->result.has_value());
  EXPECT_EQ(back->status, simulation.status);
  EXPECT_EQ(back->message, "");
  EXPECT_EQ(back->seconds, simulation.seconds);
  EXPECT_EQ(journal::bytes_of(*back->result), journal::bytes_of(*simulation.result));
}

TEST(Message, AFailureComesBackWithItsReason) {
  const Simulation failure{mpm::RunStatus::timed_out, "the limit of 2 s", 2.5, {}};
  const auto back = simulation_of(bytes_of(failure));
  ASSERT_TRUE(back.has_value());
  EXPECT_EQ(back->status, failure.status);
  EXPECT_EQ(back->message, failure.message);
  EXPECT_EQ(back->seconds, failure.seconds);
  EXPECT_FALSE(back->result.has_value());
}

TEST(Message, OneThatIsNotWholeIsNone) {
  const std::string task = bytes_of(Task{tests::seed_mud(), rich_setup(), 1.0});
  const std::string answer = bytes_of(journal::row_number(1));
  EXPECT_TRUE(task_of(task).has_value() && simulation_of(answer).has_value());
  for (std::size_t size = 0; size < task.size(); ++size) {
    EXPECT_FALSE(task_of(std::string_view(task).substr(0, size)).has_value()) << size;
  }
  for (std::size_t size = 0; size < answer.size(); ++size) {
    EXPECT_FALSE(simulation_of(std::string_view(answer).substr(0, size)).has_value()) << size;
  }
  EXPECT_FALSE(task_of(task + "x").has_value());
}

}  // namespace
}  // namespace isotach::cluster
