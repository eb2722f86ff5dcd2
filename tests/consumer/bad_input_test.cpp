// Copyright Isotach contributors. SPDX-License-Identifier: BSD-3-Clause
// What a user can get wrong: exit code 2, a message that names place, value and accepted range, nothing left
// behind.
#include "tests/consumer/consumer_test.hpp"

namespace isotach::consumer {
namespace {

using datasets::replaced;

constexpr std::string_view kStudy = R"([material]
e100 = 1.358
lambda = 0.154
kappa = 0.0129
I_v = 0.03
D_r_per_s = 6.8e-7
phi_c_deg = 15.3
C_1 = 0.05
[[oedometer]]
name = "crs"
data = "crs.csv"
height_mm = 20.0
void_ratio = 2.5
initial_K0 = 0.8
noise = { stress_relative = 0.005, stress_floor_kPa = 0.02, strain = 2e-5 }
)";

constexpr std::string_view kElement = R"([material]
e100 = 1.5
lambda = 0.1
kappa = 0.02
I_v = 0.05
D_r_per_s = 1e-6
phi_c_deg = 25
C_1 = 0
[state]
stress_kPa = [100, 100, 100, 0, 0, 0]
void_ratio = 1.5
[[stage]]
duration_s = 1e4
rows = 3
strain_rate_per_s = { 11 = 1e-6 }
)";

constexpr std::string_view kData = R"(time_s,axial_strain,axial_stress_kPa
0,0.00,4
1000,0.01,8
2000,0.02,12
3000,0.03,16
)";

class BadInput : public ConsumerTest {
 protected:
  void SetUp() override {
    write("study.toml", kStudy);
    write("crs.csv", kData);
    write("slump.toml", kTinySlump);
    write("element.toml", kElement);
  }
  void change(std::string_view file, std::string_view from, std::string_view to) const {
    write(file, replaced(content_of(folder() / file), from, to));
  }
};

TEST_F(BadInput, MissingColumn) {
  change("crs.csv", "axial_stress_kPa", "load");
  expect_refused({"fit-oedometer", "study.toml"},
                 {"crs.csv:1: ", "axial_stress_kPa or axial_force_kN", "axial_strain", "load"});
}

TEST_F(BadInput, TextInANumber) {
  change("crs.csv", "2000,0.02,12", "2000,0.02,twelve");
  expect_refused({"fit-oedometer", "study.toml"},
                 {"crs.csv:4: ", "column axial_stress_kPa", "\"twelve\" is not a number", "accepted: "});
}

TEST_F(BadInput, NothingLeftToFit) {
  write("study.toml", content_of(folder() / "study.toml") + "[fit]\noedometer = [\"D_r\"]\n");
  expect_refused({"fit-oedometer", "study.toml"}, {"study.toml: ", "[fit] oedometer", "D_r alone"});
}

TEST_F(BadInput, ValueOfACellOutOfRange) {
  change("crs.csv", "2000,0.02,12", "2000,1.2,12");
  expect_refused({"fit-oedometer", "study.toml"},
                 {"crs.csv:4: ", "column axial_strain", "1.2", "> -1 and < 1"});
}

TEST_F(BadInput, UnknownKeyOfAStudy) {
  change("study.toml", "initial_K0", "initial_Ko");
  expect_refused({"fit-oedometer", "study.toml"},
                 {"study.toml:14: ", "key initial_Ko in [[oedometer]]", "it is unknown", "initial_K0"});
}

TEST_F(BadInput, UnknownKeyOfASlumpFile) {
  change("slump.toml", "cell_size_mm = 13.0", "cell_size_m = 0.013");
  expect_refused({"slump", "slump.toml"},
                 {"slump.toml:21: ", "key cell_size_m in [numerics]", "cell_size_mm"});
}

TEST_F(BadInput, ComponentOfAnElementTestUnderTwoControls) {
  change("element.toml", "rows = 3", "stress_rate_kPa_per_s = { 11 = 0.0 }");
  expect_refused({"element", "element.toml"},
                 {"element.toml:14: ", "key 11 in [stage.stress_rate_kPa_per_s]",
                  "component 11 has its strain_rate_per_s already", "accepted: "});
}

TEST_F(BadInput, StateOfAnElementTestOutsideOfTheLaw) {
  change("element.toml", "[100, 100, 100, 0, 0, 0]", "[100, -20, -20, 0, 0, 0]");
  expect_refused({"element", "element.toml"},
                 {"element.toml:10: ", "stress_kPa", "q = 120 at p = 20", "q < 3 p"});
}

TEST_F(BadInput, ParameterOutOfItsRange) {
  change("study.toml", "phi_c_deg = 15.3", "phi_c_deg = 95");
  expect_refused({"fit-oedometer", "study.toml"},
                 {"study.toml:7: ", "key phi_c_deg in [material]", "95 is out of range", "> 0 and < 90"});
}

TEST_F(BadInput, ParameterOutOfRangeForAnother) {
  change("slump.toml", "kappa = 0.0129", "kappa = 0.2");
  expect_refused({"slump", "slump.toml"}, {"slump.toml:4: ", "key kappa in [material]", "0.2", "0.154"});
}

TEST_F(BadInput, EmptyFile) {
  write("crs.csv", "");
  expect_refused({"fit-oedometer", "study.toml"}, {"crs.csv: ", "it is empty", "accepted: "});
  write("study.toml", "");
  expect_refused({"calibrate", "study.toml"}, {"study.toml: ", "it is empty", "accepted: "});
}

TEST_F(BadInput, DirectoryInPlaceOfAFile) {
  std::filesystem::remove(folder() / "crs.csv");
  std::filesystem::create_directory(folder() / "crs.csv");
  expect_refused({"fit-oedometer", "study.toml"},
                 {"crs.csv: ", "it is a directory", "accepted: a text file"});
  expect_refused({"fit-slump", "."}, {".: ", "it is a directory", "accepted: a text file"});
}

TEST_F(BadInput, FileBeyondTheSizeLimit) {
  // larger than the study, so that the limit between them refuses the data and nothing else
  std::string data(kData);
  for (int row = 4; data.size() < 2000; ++row) data += std::to_string(1000 * row) + ",0.03,16\n";
  ASSERT_LT(kStudy.size(), 1000);
  write("crs.csv", data);
  expect_refused({"fit-oedometer", "study.toml", "--max-file-mb", "0.001"},
                 {"crs.csv: ", "file size", std::to_string(data.size()) + " bytes", "at most 1000 bytes"});
  expect_refused({"fit-oedometer", "study.toml", "--max-file-mb", "0.0001"},
                 {"study.toml: ", std::to_string(kStudy.size()) + " bytes", "at most 100 bytes"});
}

TEST_F(BadInput, SizeLimitIsAHundredMegabytesUnlessRaised) {
  std::filesystem::resize_file(folder() / "crs.csv", 100'000'001);  // sparse
  expect_refused({"fit-oedometer", "study.toml"},
                 {"crs.csv: ", "100000001 bytes", "at most 100000000 bytes"});
  // raised, it is read, and found to hold what no text file does
  expect_refused({"fit-oedometer", "study.toml", "--max-file-mb", "101"}, {"crs.csv:6: ", "a NUL byte"});
}

TEST_F(BadInput, MissingStudyAndMissingData) {
  expect_refused({"calibrate", "stduy.toml"}, {"stduy.toml: ", "it does not exist"});
  std::filesystem::remove(folder() / "crs.csv");
  expect_refused({"fit-oedometer", "study.toml"}, {"crs.csv: ", "it does not exist"});
}

TEST_F(BadInput, StudyWithoutTheTestsThatACommandFits) {
  expect_refused({"fit-slump", "study.toml"}, {"study.toml: ", "[[slump]]", "at least one test to fit"});
  expect_refused({"calibrate", "study.toml"}, {"study.toml: ", "[[slump]]", "at least one test to fit"});
}

TEST_F(BadInput, OutIsAFile) {
  write("taken", "precious");
  const std::vector<std::string> before = everything();
  for (const char* out : {"taken", "taken/below"}) {
    const Ended ended = run({"slump", "slump.toml", "--out", out});
    EXPECT_EQ(ended.code, 2);
    EXPECT_NE(ended.err.find("taken"), std::string::npos) << ended.err;
    EXPECT_EQ(everything(), before);
    EXPECT_EQ(content_of(folder() / "taken"), "precious");
  }
}

TEST_F(BadInput, UnknownCommandIsNamedAmongThoseThereAre) {
  expect_refused({"bogus", "study.toml"},
                 {"unknown command \"bogus\"", "accepted: ", "calibrate", "element", "slump"});
}

TEST_F(BadInput, CommandLineThatIsNone) {
  const std::vector<std::string> before = everything();
  const std::vector<std::vector<std::string>> lines{
      {},
      {"bogus", "study.toml"},
      {"slump"},
      {"slump", "slump.toml", "--bogus"},
      {"slump", "slump.toml", "extra"},
      {"slump", "slump.toml", "--threads", "0"},
      {"slump", "slump.toml", "--threads", "two"},
      {"slump", "slump.toml", "--max-file-mb", "-1"},
      {"slump", "slump.toml", "--max-file-mb", "nan"},
      {"slump", "slump.toml", "--integrator", "cvode"},
      {"element", "element.toml", "--integrator", "euler"},
      {"element", "element.toml", "--tolerance", "0"},
      {"element", "element.toml", "--tolerance", "nan"},
      {"element", "element.toml", "--tolerance", "1"},
  };
  for (const auto& line : lines) {
    const Ended ended = run(line);
    const std::string last = line.empty() ? "nothing" : line.back();
    EXPECT_EQ(ended.code, 2) << last;
    EXPECT_EQ(ended.out, "") << last;
    EXPECT_NE(ended.err, "") << last;
    EXPECT_EQ(everything(), before) << last;
  }
}

}  // namespace
}  // namespace isotach::consumer
