// Copyright Isotach contributors. SPDX-License-Identifier: BSD-3-Clause
// A study of two small slump tests whose fit takes seconds, and what its answer is.
#pragma once

#include <nlohmann/json.hpp>
#include <string>
#include <string_view>
#include <vector>

#include "journal/journal.hpp"
#include "tests/consumer/consumer_test.hpp"

namespace isotach::consumer {

inline constexpr std::string_view kStudyHead = R"([material]
e100 = 1.358
lambda = 0.154
kappa = 0.0129
I_v = 0.02
D_r_per_s = 6.8e-7
phi_c_deg = 14.2
C_1 = 0.03
[fit]
slump = ["I_v"]
[numerics]
cell_size_mm = 8.0
)";

inline constexpr std::string_view kStudyTest = R"([[slump]]
name = "NAME"
data = "NAME.csv"
noise = { outline_mm = 0.5, lifting_mm = 0.5 }
[slump.mould]
diameter_mm = 78.0
fill_height_mm = 40.0
lift_speed_m_per_s = 0.06
[slump.mud]
void_ratio = 5.0
[slump.base]
kind = "rough"
)";

class SmallSlumpFit : public ConsumerTest {
 protected:
  /// A study of two tests, of which the data are simulated slumps at another I_v.
  void SetUp() override {
    std::string study(kStudyHead);
    for (const char* name : {"one", "two"}) {
      const char* void_ratio = name == std::string_view("one") ? "5.0" : "4.7";
      std::string slump = datasets::replaced(std::string(kTinySlump), "void_ratio = 3.891",
                                             std::string("void_ratio = ") + void_ratio);
      slump = datasets::replaced(slump, "cell_size_mm = 13.0", "cell_size_mm = 8.0");
      slump = datasets::replaced(slump, "times_s = [0.1, 0.3]", "times_s = [0.1, 1.0]");
      write("slump.toml", datasets::replaced(slump, "I_v = 0.02", "I_v = 0.03"));
      ASSERT_EQ(run({"slump", "slump.toml", "--out", "data", "--quiet"}).code, 0);
      std::filesystem::rename(folder() / "data/outlines.csv", folder() / (std::string(name) + ".csv"));
      std::string test =
          datasets::replaced(std::string(kStudyTest), "\"NAME\"", std::string("\"") + name + "\"");
      test = datasets::replaced(test, "NAME.csv", std::string(name) + ".csv");
      study += datasets::replaced(test, "void_ratio = 5.0", std::string("void_ratio = ") + void_ratio);
    }
    write("study.toml", study);
  }

  [[nodiscard]] std::vector<std::string> fit(const std::string& out,
                                             std::vector<std::string> more = {}) const {
    std::vector<std::string> arguments{"fit-slump", "study.toml", "--out", out, "--threads", "1"};
    arguments.insert(arguments.end(), more.begin(), more.end());
    return arguments;
  }
  /// result.json without the seconds, which are the only thing that may differ.
  [[nodiscard]] std::string answer(const std::string& out) const {
    auto json = nlohmann::ordered_json::parse(contents(out + "/result.json"));
    EXPECT_TRUE(json.contains("parameters"));
    json.erase("seconds");
    return json.dump(1);
  }
  [[nodiscard]] long rows(const std::string& out) const {
    const std::filesystem::path file = folder() / (out + ".journal.sqlite");
    return std::filesystem::exists(file) ? journal::Journal(file).counts().total() : 0;
  }
};

}  // namespace isotach::consumer
