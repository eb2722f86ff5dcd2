// Copyright Isotach contributors. SPDX-License-Identifier: BSD-3-Clause
// isotach fit-oedometer on a laboratory's file as it was recorded; skipped where the file is not at hand.
#include <fmt/format.h>

#include <cstdlib>
#include <nlohmann/json.hpp>
#include <set>

#include "tests/consumer/consumer_test.hpp"

namespace isotach::consumer {
namespace {

using nlohmann::json;

class MiniSoilLab : public ConsumerTest {
 protected:
  void SetUp() override {
    const char* realdata = std::getenv("ISOTACH_REALDATA");
    if (realdata == nullptr) GTEST_SKIP() << "ISOTACH_REALDATA does not say where the measured data are";
    data_ = std::filesystem::path(realdata) / "minisoillab" / "Oedo-CRS-Visko_01.csv";
    ASSERT_TRUE(std::filesystem::exists(data_)) << data_;
    const auto study = std::filesystem::path(ISOTACH_SOURCE_DIR) / "tests/data/minisoillab/study.toml";
    write("study.toml", datasets::replaced(content_of(study), "\"Oedo-CRS-Visko_01.csv\"",
                                           fmt::format("\"{}\"", std::filesystem::absolute(data_).string())));
  }

  /// Lines whose time is not after all before them, or whose force is not positive, from the file itself.
  [[nodiscard]] std::set<int> lines_to_drop() const {
    std::set<int> lines;
    std::ifstream stream(data_);
    std::string text;
    std::getline(stream, text);
    double latest = -1.0;
    for (int line = 2; std::getline(stream, text); ++line) {
      double time = 0.0;
      double force = 0.0;
      EXPECT_EQ(std::sscanf(text.c_str(), "%lf,%lf", &time, &force), 2) << text;
      if (time <= latest || force <= 0.0) lines.insert(line);
      latest = std::max(latest, time);
    }
    return lines;
  }

  std::filesystem::path data_;
};

TEST_F(MiniSoilLab, FitFindsLambdaAndNamesEveryRowItDropped) {
  const Ended ended = run({"fit-oedometer", "study.toml", "--out", "results"});
  ASSERT_EQ(ended.code, 0) << ended.err;
  const json result = json::parse(content_of(folder() / "results/result.json"));
  EXPECT_EQ(result.at("status"), "ok");

  const json& lambda = result.at("parameters").at("lambda");
  EXPECT_GE(lambda.at("value").get<double>(), 0.068);
  EXPECT_LE(lambda.at("value").get<double>(), 0.082);
  EXPECT_GT(lambda.at("std_error").get<double>(), 0.0);
  EXPECT_EQ(result.at("parameters").at("D_r").at("verdict"), "gauge");
  EXPECT_LE(result.at("disagreement_in_std_errors").get<double>(), 0.1);

  const std::set<int> expected = lines_to_drop();
  ASSERT_TRUE(expected.contains(265) && expected.contains(298)) << "the two steps back in time";
  std::set<int> named;
  const std::string report = content_of(folder() / "results/report.html");
  for (const json& note : result.at("tests")[0].at("rows_dropped")) {
    const int line = note.at("line").get<int>();
    named.insert(line);
    EXPECT_NE(report.find(fmt::format(">{}<", line)), std::string::npos) << "line " << line;
    EXPECT_TRUE(note.at("what").get<std::string>().starts_with("dropped: ")) << note;
  }
  EXPECT_EQ(named, expected);
  EXPECT_EQ(result.at("tests")[0].at("values").get<std::size_t>() + expected.size(), 585)
      << "586 rows are the start, compared or dropped";
}

}  // namespace
}  // namespace isotach::consumer
