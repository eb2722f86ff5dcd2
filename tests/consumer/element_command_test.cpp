// Copyright Isotach contributors. SPDX-License-Identifier: BSD-3-Clause
// isotach element from file to results: what it writes, the reference numbers through files, and how it ends
// when it cannot go on.
#include <fmt/format.h>

#include <chrono>
#include <cmath>
#include <map>
#include <nlohmann/json.hpp>
#include <sstream>
#include <thread>

#include "tests/consumer/consumer_test.hpp"

namespace isotach::consumer {
namespace {

using datasets::replaced;
using nlohmann::json;

/// Set A of the reference numbers.
constexpr std::string_view kMaterial = R"([material]
e100 = 1.5
lambda = 0.1
kappa = 0.02
I_v = 0.05
D_r_per_s = 1e-6
phi_c_deg = 25
C_1 = 0
)";

constexpr std::string_view kHeader =
    "time_s,stage,strain_11,strain_22,strain_33,strain_12,strain_13,strain_23,stress_11_kPa,stress_22_kPa,"
    "stress_33_kPa,stress_12_kPa,stress_13_kPa,stress_23_kPa,void_ratio,ocr";

/// A test of one stage.
std::string element_test(std::string_view stress, std::string_view stage) {
  return fmt::format("{}[state]\nstress_kPa = {}\nvoid_ratio = 1.5\n[[stage]]\nname = \"only\"\n{}\n",
                     kMaterial, stress, stage);
}

constexpr std::string_view kIsotropic = "[100, 100, 100, 0, 0, 0]";

class ElementCommand : public ConsumerTest {
 protected:
  [[nodiscard]] json result(std::string_view out) const {
    return json::parse(content_of(folder() / out / "result.json"));
  }
  /// The last row of curve.csv, by column.
  [[nodiscard]] std::map<std::string, std::string> last_row(std::string_view out) const {
    std::istringstream lines(content_of(folder() / out / "curve.csv"));
    std::string header;
    std::string line;
    std::string last;
    std::getline(lines, header);
    while (std::getline(lines, line)) last = line;
    std::map<std::string, std::string> row;
    std::istringstream names(header);
    std::istringstream cells(last);
    std::string name;
    std::string cell;
    while (std::getline(names, name, ',') && std::getline(cells, cell, ',')) row[name] = cell;
    return row;
  }
  /// Runs the test by every integrator and expects these end values of curve.csv. The tolerances are such
  /// that the error at the end is about 1e-9 for each; CVODE's grows most on the way there.
  void expect_end(std::string_view test, const std::map<std::string, double>& expected,
                  double relative) const {
    write("test.toml", test);
    const std::map<std::string, std::string> tolerances{
        {"fellin-ostermann", "1e-9"}, {"cvode", "1e-11"}, {"rosenbrock", "1e-9"}};
    for (const auto& [integrator, tolerance] : tolerances) {
      const Ended ended =
          run({"element", "test.toml", "--integrator", integrator, "--tolerance", tolerance, "--out", "out"});
      ASSERT_EQ(ended.code, 0) << integrator << ": " << ended.err;
      const auto row = last_row("out");
      for (const auto& [column, value] : expected) {
        EXPECT_NEAR(std::stod(row.at(column)), value, relative * std::abs(value))
            << integrator << ": " << column;
      }
      EXPECT_EQ(result("out").at("integrator"), integrator);
    }
  }
};

TEST_F(ElementCommand, WritesAllResultsAndOneLineOfSummary) {
  write("test.toml", element_test(kIsotropic, R"(duration_s = 1e4
rows = 4
strain_rate_per_s = { 11 = 1e-6 }
stress_rate_kPa_per_s = { 22 = 0, 33 = 0 })"));
  const Ended ended = run({"element", "test.toml", "--out", "new/results"});
  ASSERT_EQ(ended.code, 0) << ended.err;
  EXPECT_TRUE(ended.out.starts_with("element: ends at 10000 s with p = ")) << ended.out;
  EXPECT_NE(ended.out.find("report.html\n"), std::string::npos) << ended.out;
  const std::string curve = content_of(folder() / "new/results/curve.csv");
  EXPECT_EQ(curve.substr(0, curve.find('\n')), kHeader);
  EXPECT_EQ(std::count(curve.begin(), curve.end(), '\n'), 1 + 1 + 4);
  EXPECT_NE(curve.find("\n0,only,0,0,0,0,0,0,100,100,100,0,0,0,1.5,1"), std::string::npos) << curve;
  EXPECT_NE(curve.find("\n2500,only,"), std::string::npos);
  for (const char* name : {"stress_path", "compression_path", "stress_strain", "stress_history"}) {
    EXPECT_TRUE(std::filesystem::exists(folder() / "new/results/curves" / (std::string(name) + ".csv")))
        << name;
  }
  const json written = result("new/results");
  EXPECT_EQ(written.at("command"), "element");
  EXPECT_EQ(written.at("status"), "ok");
  EXPECT_GE(written.at("seconds").get<double>(), 0.0);
  EXPECT_TRUE(written.at("warnings").empty());
  EXPECT_EQ(written.at("integrator"), "fellin-ostermann");
  EXPECT_EQ(written.at("tolerance"), 1e-6);
  EXPECT_EQ(written.at("rows"), 5);
  ASSERT_EQ(written.at("stages").size(), 1);
  EXPECT_EQ(written.at("stages")[0].at("name"), "only");
  const json& end = written.at("stages")[0].at("end");
  EXPECT_EQ(end, written.at("end"));
  EXPECT_NEAR(end.at("q_kPa").get<double>(), 3.0 * (end.at("p_kPa").get<double>() - 100.0), 1e-7);
  const std::string report = content_of(folder() / "new/results/report.html");
  EXPECT_NE(report.find("<svg"), std::string::npos);
  EXPECT_NE(report.find("</html>"), std::string::npos);
}

TEST_F(ElementCommand, QuietSaysNothingAndTheSameInputGivesTheSameCurve) {
  write("test.toml",
        element_test(kIsotropic, "duration_s = 1e4\nrows = 4\nstrain_rate_per_s = { 11 = 1e-6 }"));
  for (const char* out : {"first", "second"}) {
    const Ended ended = run({"element", "test.toml", "--out", out, "--quiet"});
    EXPECT_EQ(ended.code, 0);
    EXPECT_EQ(ended.out + ended.err, "");
  }
  for (const char* name : {"curve.csv", "report.html", "curves/stress_path.csv"}) {
    EXPECT_EQ(content_of(folder() / "first" / name), content_of(folder() / "second" / name)) << name;
    EXPECT_NE(content_of(folder() / "first" / name), "") << name;
  }
}

// The expected numbers are those of the reference table, from an implementation outside of this project; they
// have ten digits or so.
TEST_F(ElementCommand, OedometerAtConstantRateEndsAtTheReferenceStress) {
  expect_end(element_test("[100, 65, 65, 0, 0, 0]", "duration_s = 2e5\nstrain_rate_per_s = { 11 = 1e-6 }"),
             {{"stress_11_kPa", 806.17380535},
              {"stress_22_kPa", 0.72005924 * 806.17380535},
              {"void_ratio", 1.04682688},
              {"strain_11", 0.2}},
             3e-8);
}

TEST_F(ElementCommand, UndrainedTriaxialEndsAtTheReferenceStress) {
  const double p = 50.51454122;
  const double q = 49.69261978;
  expect_end(
      element_test(kIsotropic, "duration_s = 3e5\nstrain_rate_per_s = { 11 = 1e-6, 22 = -5e-7, 33 = -5e-7 }"),
      {{"stress_11_kPa", p + 2.0 * q / 3.0}, {"stress_33_kPa", p - q / 3.0}, {"void_ratio", 1.5}}, 3e-8);
}

TEST_F(ElementCommand, ShearHasTheSignOfItsStrain) {
  for (const double sign : {1.0, -1.0}) {
    expect_end(element_test("[100, 80, 80, 0, 0, 0]",
                            fmt::format("duration_s = 5e5\nstrain_rate_per_s = {{ 12 = {} }}", sign * 5e-7)),
               {{"stress_11_kPa", 49.15989},
                {"stress_22_kPa", 49.15938},
                {"stress_12_kPa", sign * 23.29878},
                {"strain_12", sign * 0.25}},
               3e-7);  // seven digits in the table
  }
}

TEST_F(ElementCommand, HoldsEndAtTheReferenceNumbers) {
  expect_end(element_test(kIsotropic,
                          "duration_s = 1e6\nstress_rate_kPa_per_s = { 11 = 0, 22 = 0, 33 = 0 }\n"
                          "first_row_s = 100"),
             {{"void_ratio", 1.427927958}, {"stress_11_kPa", 100.0}}, 1e-8);
  expect_end(element_test(kIsotropic, "duration_s = 1e6"),
             {{"stress_11_kPa", 68.87465481}, {"void_ratio", 1.5}}, 3e-8);
}

// dv1/dx2 = -1e-6 /s: the stress path under the spin of the motion is that of the opposite motion mirrored,
// which turns the sign of shear alone.
TEST_F(ElementCommand, SimpleShearOfEitherSenseIsTheSameButForTheSignOfShear) {
  std::map<std::string, std::string> rows[2];
  for (const int sense : {0, 1}) {
    const double sign = sense == 0 ? 1.0 : -1.0;
    write("test.toml", element_test("[65, 100, 65, 0, 0, 0]",
                                    fmt::format("duration_s = 5e5\nstrain_rate_per_s = {{ 12 = {} }}\n"
                                                "spin_per_s = {{ 12 = {} }}",
                                                sign * 5e-7, -sign * 5e-7)));
    ASSERT_EQ(run({"element", "test.toml", "--out", "out"}).code, 0);
    rows[sense] = last_row("out");
  }
  for (const char* column : {"stress_11_kPa", "stress_22_kPa", "stress_33_kPa", "ocr"}) {
    EXPECT_EQ(rows[0].at(column), rows[1].at(column)) << column;
  }
  EXPECT_EQ("-" + rows[0].at("stress_12_kPa"), rows[1].at("stress_12_kPa"));
  EXPECT_GT(std::stod(rows[0].at("stress_12_kPa")), 10.0);
}

TEST_F(ElementCommand, AnisotropyIsWrittenBesideTheCurve) {
  std::string test =
      replaced(element_test("[100, 65, 65, 0, 0, 0]", "duration_s = 5e5\nstrain_rate_per_s = { 11 = 1e-6 }"),
               "C_1 = 0", "C_1 = 0\nC_2 = 50\nC_3 = 0.4");
  test = replaced(test, "void_ratio = 1.5", "void_ratio = 1.5\nomega = [0.05, -0.025, -0.025, 0, 0, 0]");
  write("test.toml", test);
  ASSERT_EQ(run({"element", "test.toml", "--out", "out"}).code, 0);
  const std::string fabric = content_of(folder() / "out/fabric.csv");
  EXPECT_TRUE(fabric.starts_with(
      "time_s,stage,omega_11,omega_22,omega_33,omega_12,omega_13,omega_23\n0,only,0.05,-0.025,"))
      << fabric.substr(0, 200);
  // after long steady compression Omega = C_3 sigma*/p, less what lags behind the last strain of 1/C_2:
  // nothing, as the stress ratio no longer moves
  const json end = result("out").at("end");
  EXPECT_NEAR(end.at("omega").at("11").get<double>(),
              0.4 * (end.at("stress_kPa").at("11").get<double>() / end.at("p_kPa").get<double>() - 1.0),
              1e-5);
}

TEST_F(ElementCommand, NumericsThatFailAreAResultThatSaysWhere) {
  // pulled isotropically by 1 kPa/s, p = 0 is reached after 100 s
  write("test.toml", element_test(kIsotropic,
                                  "duration_s = 10\nrows = 2\n[[stage]]\nname = \"pull\"\nduration_s = 400\n"
                                  "rows = 8\nstress_rate_kPa_per_s = { 11 = -1, 22 = -1, 33 = -1 }"));
  for (const char* integrator : {"fellin-ostermann", "cvode", "rosenbrock"}) {
    SCOPED_TRACE(integrator);
    const Ended ended = run({"element", "test.toml", "--integrator", integrator, "--out", "out"});
    EXPECT_EQ(ended.code, 3);
    EXPECT_NE(ended.err.find("stage \"pull\""), std::string::npos) << ended.err;
    const json written = result("out");
    EXPECT_EQ(written.at("status"), "failed");
    EXPECT_EQ(written.at("stage"), "pull");
    EXPECT_EQ(written.at("stage_number"), 2);
    EXPECT_NEAR(written.at("time_s").get<double>(), 110.0, 0.1);
    EXPECT_NEAR(written.at("time_in_stage_s").get<double>(), 100.0, 0.1);
    EXPECT_NEAR(written.at("last_state").at("p_kPa").get<double>(), 0.0, 0.1);
    EXPECT_NE(written.at("failure").get<std::string>().find("pull"), std::string::npos);
    EXPECT_EQ(last_row("out").at("time_s"), "60");  // the rows before, and the report
    EXPECT_NE(content_of(folder() / "out/report.html").find("did not reach its end"), std::string::npos);
  }
}

// A thousand cycles of millions of substeps take far longer than the test waits.
TEST_F(ElementCommand, InterruptLeavesNothingBehind) {
  write("test.toml", element_test(kIsotropic,
                                  "repeat = 1000\n[[stage.stage]]\nduration_s = 1e5\n"
                                  "strain = { 11 = 0.1 }\n[[stage.stage]]\nduration_s = 1e5\n"
                                  "strain = { 11 = 0 }"));
  Process process = start({"element", "test.toml", "--tolerance", "1e-13", "--out", "new/results"});
  // results are being staged: the run has begun
  const auto deadline = std::chrono::steady_clock::now() + std::chrono::seconds(30);
  while (everything().size() < 3 && std::chrono::steady_clock::now() < deadline) {
    std::this_thread::sleep_for(std::chrono::milliseconds(10));
  }
  ASSERT_GE(everything().size(), 3) << "nothing was staged within 30 s";
  process.signal(SIGINT);
  const Ended ended = process.wait();
  EXPECT_EQ(ended.code, 130);
  EXPECT_NE(ended.err.find("interrupted"), std::string::npos) << ended.err;
  EXPECT_EQ(everything(), (std::vector<std::string>{"test.toml"}));
}

}  // namespace
}  // namespace isotach::consumer
