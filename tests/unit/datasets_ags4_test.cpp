// Copyright Isotach contributors. SPDX-License-Identifier: BSD-3-Clause
// Groups of AGS4 files and the oedometer tests in them, orderly and deviating. The headings, their units and
// the shape of the lines are those of AGS 4.1.1.
#include <gtest/gtest.h>

#include "datasets/ags4_oedometer.hpp"
#include "tests/unit/datasets_files.hpp"
#include "tests/unit/datasets_small_study.hpp"

namespace isotach::datasets {
namespace {

constexpr std::string_view kFile = R"("GROUP","PROJ"
"HEADING","PROJ_ID","PROJ_NAME"
"UNIT","",""
"TYPE","ID","X"
"DATA","1","A ""soft"" site, north"

"GROUP","CONG"
"HEADING","LOCA_ID","SAMP_TOP","SPEC_REF","CONG_SDIA","CONG_HIGT","CONG_MCI","CONG_BDEN","CONG_PDEN","CONG_IVR"
"UNIT","","m","","mm","mm","%","Mg/m3","Mg/m3",""
"TYPE","ID","2DP","X","2DP","2DP","X","2DP","XN","3DP"
"DATA","BH1","3.00","1","75.0","19.0","45","1.75","#2.70","1.250"
"DATA","BH2","5.00","1","75.0","19.0","40","1.80","2.68",""

"GROUP","CONS"
"HEADING","LOCA_ID","SAMP_TOP","SPEC_REF","CONS_INCN","CONS_IVR","CONS_INCF","CONS_INCE"
"UNIT","","m","","","","kPa",""
"TYPE","ID","2DP","X","0DP","3DP","0DP","3DP"
"DATA","BH1","3.00","1","1","1.250","25","1.205"
"DATA","BH1","3.00","1","2","1.205","50","1.160"
"DATA","BH1","3.00","1","3","1.160","100","1.115"
"DATA","BH1","3.00","1","4","1.115","50",""
"DATA","BH1","3.00","1","5","1.115","10","1.1375"
"DATA","BH1","3.00","1","6","1.1375","0","1.150"
"DATA","BH2","5.00","1","1","1.100","25","1.000"
)";

/// As small programs write them: small letters, no UNIT and TYPE lines, no quotes, CRLF, a byte order mark,
/// CONG_DIA, a unit weight for a density, rows out of order, a cell left out at the end.
constexpr std::string_view kDeviating =
    "\xEF\xBB\xBFgroup,cong\r\nheading,loca_id,cong_dia,cong_bden\r\ndata,BH1,63.5,17.6519700\r\n\r\n"
    "group,cons\r\nheading,loca_id,cons_incn,cons_incf,cons_ivr,cons_ince\r\n"
    "data,BH1,2,50,1.23,1.2\r\ndata,BH1,10,200,1.1,1.0\r\ndata,BH1,1,25,1.25,1.23\r\ndata,BH1,3,100\r\n";

TEST(Ags4, GroupsHaveTheirHeadingsUnitsAndRows) {
  const Ags4File file = Ags4File::parse(std::string(kFile), "lab.ags");
  EXPECT_EQ(file.group_names(), (std::vector<std::string_view>{"PROJ", "CONG", "CONS"}));
  const Ags4Group* project = file.find("PROJ");
  ASSERT_NE(project, nullptr);
  EXPECT_EQ(project->text(project->rows.at(0), "PROJ_NAME"), "A \"soft\" site, north");
  EXPECT_EQ(file.find("CONS")->unit("CONS_INCF"), "kPa");
  EXPECT_EQ(file.find("CONS")->rows.at(0).line, 18U);
  EXPECT_EQ(file.find("LOCA"), nullptr);
}

TEST(Ags4, LinesOutOfOrderAreRefused) {
  const auto refused = [](std::string_view text, std::initializer_list<std::string_view> parts) {
    expect_input_error([&] { static_cast<void>(Ags4File::parse(std::string(text), "lab.ags")); }, parts);
  };
  refused("\"HEADING\",\"A\"\n", {"lab.ags:1", "no GROUP line before it"});
  refused("\"GROUP\",\"CONS\"\n\"DATA\",\"1\"\n", {"lab.ags:2: DATA line", "no HEADING line"});
  refused("\"GROUP\",\"CONS\"\n", {"lab.ags:1: group CONS", "no headings"});
  refused("\"GROUP\"\n", {"lab.ags:1: GROUP line", "no name"});
  refused("\"GROUP\",\"A\"\n\"HEADING\",\"X\",\"x\"\n", {"heading X occurs twice"});
  refused("\"GROUP\",\"A\"\n\"HEADING\",\"X\"\n\"DATA\",\"1\",\"2\"\n", {"lab.ags:3", "a row of 2 cells"});
  refused("time_s,axial_strain\n", {"lab.ags:1: line: it starts with \"time_s\""});
  refused("\"**PROJ\"\n\"*PROJ_ID\"\n", {"lab.ags:1", "AGS 3", "accepted: AGS 4"});
  refused("\"GROUP\",\"A\n", {"lab.ags:1", "no closing quote"});
  refused("\r\n\r\n", {"lab.ags: file: it has no group"});
}

TEST(Ags4, IncrementsBecomeLoadStepsOfADay) {
  const Ags4File file = Ags4File::parse(std::string(kFile), "lab.ags");
  const auto tests = find_ags4_oedometers(file);
  ASSERT_EQ(tests.size(), 2U);
  const Ags4Oedometer test = read_ags4_oedometer(file, tests[0]);
  EXPECT_DOUBLE_EQ(test.specimen.height.value(), 0.019);
  EXPECT_DOUBLE_EQ(test.specimen.diameter.value(), 0.075);
  EXPECT_DOUBLE_EQ(test.specimen.water_content.value(), 0.45);
  EXPECT_DOUBLE_EQ(test.specimen.bulk_density.value(), 1750.0);
  EXPECT_DOUBLE_EQ(test.specimen.specific_gravity.value(), 2.7);
  EXPECT_EQ(test.specimen.assumptions,
            std::vector<std::string>{"CONG_PDEN = 2.70 was assumed by the laboratory"});
  const auto record = record_of(file, test, test.specimen.void_ratio.value());
  // 0.045 of 2.25: 2 % of strain in each of the first three; the fourth has no void ratio, the sixth no
  // stress
  ASSERT_EQ(record.rows.size(), 4U);
  for (std::size_t i = 0; i < 3; ++i) {
    EXPECT_NEAR(record.rows[i].axial_strain, 0.02 * static_cast<double>(i + 1), 1e-14);
    EXPECT_EQ(record.rows[i].time, 86400.0 * static_cast<double>(i + 1));
    EXPECT_EQ(record.steps[i].begin, 86400.0 * static_cast<double>(i));
    EXPECT_EQ(record.steps[i].stage, Stage::load);
  }
  EXPECT_NEAR(record.rows[3].axial_strain, 0.05, 1e-14);
  EXPECT_EQ(record.steps[3].begin, 4 * 86400.0);
  EXPECT_EQ(record.steps[3].stage, Stage::unload);
  EXPECT_DOUBLE_EQ(record.steps[3].load, 10e3);
  ASSERT_EQ(record.notes.size(), 2U);
  EXPECT_EQ(record.notes[0].what, "dropped: increment 4 has no void ratio");
  EXPECT_EQ(record.notes[1].what, "dropped: increment 6 has no stress");
}

TEST(Ags4, ADeviatingFileIsReadAndItsUnitWeightNamed) {
  const Ags4File file = Ags4File::parse(std::string(kDeviating), "lab.ags");
  const auto tests = find_ags4_oedometers(file);
  ASSERT_EQ(tests.size(), 1U);
  const Ags4Oedometer test = read_ags4_oedometer(file, tests[0]);
  EXPECT_DOUBLE_EQ(test.specimen.diameter.value(), 0.0635);
  EXPECT_NEAR(test.specimen.bulk_density.value(), 1800.0, 1e-9);  // 17.65197 kN/m3 over 9.80665 m/s2
  ASSERT_EQ(test.specimen.assumptions.size(), 1U);
  EXPECT_NE(test.specimen.assumptions[0].find("taken as kN/m3"), std::string::npos);
  EXPECT_EQ(test.specimen.void_ratio.value(), 1.25);  // of the increment numbered 1
  const auto record = record_of(file, test, 1.25);
  ASSERT_EQ(record.rows.size(), 3U);
  EXPECT_DOUBLE_EQ(record.steps[0].load, 25e3);
  EXPECT_DOUBLE_EQ(record.steps[2].load, 200e3);
}

TEST(Ags4, UnitsAreReadAndUnknownOnesRefused) {
  const auto read = [](std::string_view from, std::string_view to) {
    const Ags4File file = Ags4File::parse(replaced(std::string(kFile), from, to), "lab.ags");
    return read_ags4_oedometer(file, find_ags4_oedometers(file)[0]);
  };
  EXPECT_DOUBLE_EQ(read("\"kPa\"", "\"MN/m2\"").increments[0].stress.value(), 25e6);
  EXPECT_NEAR(read("\"1.75\"", "\"17.16\"").specimen.bulk_density.value(), 17160.0 / 9.80665, 1e-9);
  EXPECT_DOUBLE_EQ(read("\"%\",\"Mg/m3\"", "\"%\",\"g/cm3\"").specimen.bulk_density.value(), 1750.0);
  const auto refused = [&](std::string_view from, std::string_view to,
                           std::initializer_list<std::string_view> parts) {
    expect_input_error([&] { static_cast<void>(read(from, to)); }, parts);
  };
  refused("\"%\",\"Mg/m3\"", "\"%\",\"kg/m3\"", {"lab.ags:11: heading CONG_BDEN", "0.00175 Mg/m3"});
  refused("\"kPa\"", "\"psi\"", {"unit of CONS_INCF", "\"psi\"", "kPa"});
  refused("\"mm\",\"mm\"", "\"m\",\"mm\"", {"unit of CONG_SDIA", "\"m\"", "accepted: mm"});
  refused("\"1.205\"\n", "\"x\"\n", {"lab.ags:18: heading CONS_INCE", "\"x\" is not a number"});
}

class Ags4Study : public SmallStudy {
 protected:
  Ags4Study() { folder_.write("lab.AGS", kFile); }
};

TEST_F(Ags4Study, ATestIsReadWithWhatTheFileKnows) {
  const Study study = read_test("data = \"lab.AGS\"\nselect = { LOCA_ID = \"BH1\", SAMP_TOP = 3 }\n");
  const OedometerTest& test = study.oedometer_tests[0];
  EXPECT_EQ(test.void_ratio, 1.25);
  EXPECT_EQ(test.void_ratio_source, "given by the data file");
  EXPECT_DOUBLE_EQ(test.height, 0.019);
  EXPECT_DOUBLE_EQ(test.diameter.value(), 0.075);
  EXPECT_EQ(test.end_of_primary.rule, EndOfPrimary::Rule::none);
  EXPECT_TRUE(assumes(study, "each load taken to last 24 h"));
  EXPECT_TRUE(assumes(study, "CONG_PDEN = 2.70 was assumed by the laboratory"));
  EXPECT_FALSE(assumes(study, "20 mm"));
}

TEST_F(Ags4Study, SelectionsAndKeysThatDoNotFitAreRefused) {
  expect_test_refused("data = \"lab.AGS\"\n", {"2 tests and none is selected",
                                               "{ LOCA_ID = \"BH2\", SAMP_TOP = 5.00, SPEC_REF = 1 }"});
  expect_test_refused("data = \"lab.AGS\"\nselect = { bro_id = \"BH1\" }\n", {"bro_id", "AGS4", "LOCA_ID"});
  expect_test_refused("data = \"lab.AGS\"\nselect = { LOCA_ID = \"BH1\" }\nend_of_primary = \"taylor\"\n",
                      {"key end_of_primary", "end of each step only"});
  expect_test_refused("data = \"lab.AGS\"\nselect = { LOCA_ID = \"BH2\" }\n", {"rows: 1 usable of 1"});
  folder_.write("proj.ags", kFile.substr(0, kFile.find("\"GROUP\",\"CONG\"")));
  expect_test_refused("data = \"proj.ags\"\n", {"proj.ags: file: it has no group CONS, only PROJ"});
}

}  // namespace
}  // namespace isotach::datasets
