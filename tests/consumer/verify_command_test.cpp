// Copyright Isotach contributors. SPDX-License-Identifier: BSD-3-Clause
// isotach verify as a user runs it: the quick size passes, its files are there, a random path can be
// repeated.
#include <nlohmann/json.hpp>
#include <set>

#include "tests/consumer/consumer_test.hpp"

namespace isotach::consumer {
namespace {

using nlohmann::json;
using VerifyCommand = ConsumerTest;

TEST_F(VerifyCommand, QuickSizePassesEveryCheckAndSaysWhatItSampled) {
  const Ended ended = run({"verify", "--sampling", "quick", "--out", "out", "--quiet"});
  ASSERT_EQ(ended.code, 0) << ended.err;
  EXPECT_EQ(ended.out + ended.err, "");
  const json result = json::parse(content_of(folder() / "out/result.json"));
  EXPECT_EQ(result.at("command"), "verify");
  EXPECT_EQ(result.at("status"), "ok");
  EXPECT_EQ(result.at("sampling"), "quick");
  EXPECT_EQ(result.at("random_paths").at("paths"), 1000);
  std::set<std::string> groups;
  for (const json& check : result.at("checks")) {
    EXPECT_TRUE(check.at("pass").get<bool>()) << check.dump();
    for (const char* key : {"name", "expected", "got", "tolerance"}) EXPECT_TRUE(check.contains(key)) << key;
    groups.insert(check.at("group").get<std::string>());
  }
  EXPECT_EQ(groups, (std::set<std::string>{"closed forms", "convergence", "cross-check", "properties",
                                           "random paths", "reference numbers", "tangent"}));
  for (const char* file : {"report.html", "convergence.csv", "random_paths.csv", "random_paths_worst.csv",
                           "tangents.csv", "work_precision.csv", "cross_check/simple-shear.csv"}) {
    EXPECT_TRUE(std::filesystem::exists(folder() / "out" / file)) << file;
  }
}

TEST_F(VerifyCommand, ARandomPathIsWrittenAsAnElementTestThatEndsWhereThePathDoes) {
  const Ended ended = run({"verify", "--seed", "1", "--random-path", "42", "--out", "out"});
  ASSERT_EQ(ended.code, 0) << ended.err;
  EXPECT_NE(ended.out.find("seed 1 path 42: complete"), std::string::npos) << ended.out;
  const Ended element = run({"element", "out/path-1-42.toml", "--out", "element", "--quiet"});
  EXPECT_EQ(element.code, 0) << element.err;
  EXPECT_TRUE(std::filesystem::exists(folder() / "element/curve.csv"));
}

TEST_F(VerifyCommand, UnknownSamplingIsRefused) {
  const Ended ended = run({"verify", "--sampling", "huge", "--out", "out"});
  EXPECT_EQ(ended.code, 2);
  EXPECT_NE(ended.err.find("quick"), std::string::npos) << ended.err;
  EXPECT_TRUE(everything().empty());
}

}  // namespace
}  // namespace isotach::consumer
