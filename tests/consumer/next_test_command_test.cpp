// Copyright Isotach contributors. SPDX-License-Identifier: BSD-3-Clause
// isotach next-test on a small study: what it writes, that a second start simulates nothing, what it refuses.
#include "tests/consumer/small_slump_fit.hpp"

namespace isotach::consumer {
namespace {

constexpr std::string_view kCandidates = R"([pictures]
early = [0.1, 0.3]
all = [0.1, 0.3, 1.0]
[[slump]]
name = "low"
programme = "low ones"
pictures = ["all", "early"]
mould = { diameter_mm = 78.0, fill_height_mm = 30.0, lift_speed_m_per_s = 0.06, wall = "smooth" }
[[oedometer]]
name = "one rate"
void_ratio = 3.0
stages = [{ to_strain = 0.2, rate_per_s = 7e-7 }]
[[oedometer]]
name = "steps"
void_ratio = 3.0
stages = [{ to_strain = 0.1, rate_per_s = 7e-7 }, { to_strain = 0.15, rate_per_s = 7e-5 },
          { to_strain = 0.2, rate_per_s = 7e-7 }]
)";

class NextTestCommand : public SmallSlumpFit {
 protected:
  void SetUp() override {
    SmallSlumpFit::SetUp();
    // slumps do not hold the compression line: it is known beforehand
    write("study.toml",
          datasets::replaced(contents("study.toml"), "slump = [\"I_v\"]\n",
                             "slump = [\"I_v\"]\n[fit.prior]\ne100 = { mean = 1.358, std_error = "
                             "0.005 }\nlambda = { mean = 0.154, std_error = 0.001 }\nkappa = { mean = "
                             "0.0129, std_error = 0.001 }\n"));
    write("candidates.toml", kCandidates);
  }
  [[nodiscard]] Ended rate(const std::string& out) const {
    return run(
        {"next-test", "study.toml", "--candidates", "candidates.toml", "--out", out, "--threads", "2"});
  }
};

TEST_F(NextTestCommand, RanksCandidatesAndGoesOnFromItsJournal) {
  const Ended first = rate("next");
  ASSERT_EQ(first.code, 0) << first.err;
  const auto json = nlohmann::json::parse(contents("next/result.json"));
  ASSERT_EQ(json["candidates"].size(), 4U);
  EXPECT_EQ(json["next_test"], json["candidates"][0]["name"]);
  double gain = std::numeric_limits<double>::infinity();
  const double present = json["present"]["std_error_ln_I_v"];
  for (const auto& candidate : json["candidates"]) {
    EXPECT_LE(candidate["gain"].get<double>(), gain);
    gain = candidate["gain"];
    EXPECT_GE(gain, 0.0) << candidate;
    EXPECT_LE(candidate["with_study"]["std_error_ln_I_v"].get<double>(), present * (1.0 + 1e-9));
  }
  EXPECT_EQ(json["programmes"][0]["tests"].size(), 1U) << "a programme has each slump once";
  for (const char* file : {"next/report.html", "next/candidates.csv", "next/curves/ellipses.csv"}) {
    EXPECT_FALSE(contents(file).empty()) << file;
  }
  const long held = rows("next");
  EXPECT_GT(held, 20);
  std::filesystem::rename(folder() / "next.journal.sqlite", folder() / "again.journal.sqlite");
  ASSERT_EQ(rate("again").code, 0);
  EXPECT_EQ(rows("again"), held) << "nothing was left to simulate";
  auto again = nlohmann::json::parse(contents("again/result.json"));
  auto once = json;
  again.erase("seconds");
  once.erase("seconds");
  EXPECT_EQ(again, once);
}

TEST_F(NextTestCommand, RefusesACandidateThatIsNone) {
  write("candidates.toml",
        "[[oedometer]]\nname = \"one\"\nstages = [{ to_strain = 1.5, rate_per_s = 1e-6 }]\n");
  expect_refused({"next-test", "study.toml", "--candidates", "candidates.toml"},
                 {"candidates.toml:3", "to_strain", "0.95"});
  expect_refused({"next-test", "study.toml", "--candidates", "none.toml"}, {"none.toml"});
}

}  // namespace
}  // namespace isotach::consumer
