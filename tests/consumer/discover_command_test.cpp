// Copyright Isotach contributors. SPDX-License-Identifier: BSD-3-Clause
// isotach discover: what it writes, that its answer is a study's, what it refuses.
#include <filesystem>
#include <nlohmann/json.hpp>

#include "tests/consumer/consumer_test.hpp"

namespace isotach::consumer {
namespace {

using nlohmann::json;

std::string study_of(const char* mud) {
  return std::filesystem::path(ISOTACH_SOURCE_DIR) / "datasets" / mud / "study.toml";
}

class DiscoverCommand : public ConsumerTest {
 protected:
  [[nodiscard]] json discovered(const std::string& study) const {
    const Ended ended = run({"discover", study, "--only", "oedometer", "--out", "out", "--threads", "2"});
    EXPECT_EQ(ended.code, 0) << ended.err;
    return json::parse(contents("out/result.json"));
  }
};

TEST_F(DiscoverCommand, FindsNothingInMudA) {
  const json found = discovered(study_of("mud-a"));
  EXPECT_EQ(found["command"], "discover");
  EXPECT_EQ(found["status"], "ok");
  EXPECT_TRUE(found["slump"].is_null());
  const json& oedometer = found["oedometer"];
  EXPECT_EQ(oedometer["verdict"], "adequate");
  EXPECT_TRUE(oedometer["effects"].empty());
  EXPECT_EQ(oedometer["gap"]["before"], oedometer["gap"]["after"]);
}

// What mud-b hides is not disclosed: a name has to close the gap, also of the test held out, which the base
// misses by more than six times its noise.
TEST_F(DiscoverCommand, NamesWhatClosesTheGapOfMudB) {
  const json oedometer = discovered(study_of("mud-b"))["oedometer"];
  EXPECT_EQ(oedometer["verdict"], "named");
  ASSERT_EQ(oedometer["effects"].size(), 1U);
  const json& gap = oedometer["gap"];
  EXPECT_GT(gap["before"].get<double>(), 5.0);
  EXPECT_LT(gap["after"].get<double>(), 1.1);
  EXPECT_GT(gap["held_out_before"].get<double>(), 5.0);
  EXPECT_LT(gap["held_out_after"].get<double>(), 1.3);
  EXPECT_GT(gap["best_wrong_after"].get<double>(), 2.0 * gap["after"].get<double>());
  const std::string effect = oedometer["effects"][0];
  EXPECT_FALSE(oedometer["effect_parameters"][effect].empty());
  const json& interval = oedometer["amplitude_intervals"][effect];
  const double amplitude = oedometer["effect_parameters"][effect][interval["parameter"].get<std::string>()];
  EXPECT_LT(interval["lower"].get<double>(), amplitude);
  EXPECT_GT(interval["upper"].get<double>(), amplitude);
  // by what the name explains, then the stages of the test held out by their residuals
  double before = std::numeric_limits<double>::infinity();
  bool held_out = false;
  for (const json& place : oedometer["disagreement"]) {
    if (place["held_out"].get<bool>() && !held_out) {
      held_out = true;
      before = std::numeric_limits<double>::infinity();
    }
    EXPECT_EQ(place["held_out"].get<bool>(), held_out) << "those of fitted tests come first";
    EXPECT_EQ(place["explained"].is_null(), held_out);
    const double rank = held_out ? place["score"].get<double>() : place["explained"].get<double>();
    EXPECT_LE(rank, before) << "ranked";
    before = rank;
  }
  EXPECT_TRUE(held_out);
  EXPECT_LT(oedometer["wandering"]["p_value"].get<double>(), 0.002);
  EXPECT_EQ(oedometer["wandering"]["slots"].size(), 14U);
  EXPECT_FALSE(contents("out/report.html").empty());

  // the answer is the next study's: its [effects] included
  const std::string answer = contents("out/parameters.toml");
  EXPECT_NE(answer.find("[effects]"), std::string::npos);
  EXPECT_NE(answer.find(effect), std::string::npos);
}

TEST_F(DiscoverCommand, RefusesAStudyWithoutOedometerTests) {
  write("study.toml",
        "[material]\ne100 = 1.4\nlambda = 0.15\nkappa = 0.013\nI_v = 0.03\nD_r_per_s = 7e-7\n"
        "phi_c_deg = 15\nC_1 = 0.05\n");
  expect_refused({"discover", "study.toml"}, {"study.toml"});
  expect_refused({"discover", "none.toml"}, {"none.toml"});
  const Ended ended = run({"discover", "study.toml", "--only", "slumps"});
  EXPECT_EQ(ended.code, 2);
  EXPECT_NE(ended.err.find("--only: slumps not in {oedometer,slump}"), std::string::npos) << ended.err;
}

}  // namespace
}  // namespace isotach::consumer
