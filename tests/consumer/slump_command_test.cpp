// Copyright Isotach contributors. SPDX-License-Identifier: BSD-3-Clause
// isotach slump from file to results: what it writes, that it writes it again, and how it ends when it
// cannot.
#include <chrono>
#include <nlohmann/json.hpp>
#include <thread>

#include "tests/consumer/consumer_test.hpp"

namespace isotach::consumer {
namespace {

using datasets::replaced;
using nlohmann::json;

class SlumpCommand : public ConsumerTest {
 protected:
  [[nodiscard]] json result(std::string_view out) const {
    return json::parse(content_of(folder() / out / "result.json"));
  }
};

TEST_F(SlumpCommand, WritesAllResults) {
  write("slump.toml", kTinySlump);
  const Ended ended = run({"slump", "slump.toml", "--out", "new/results", "--quiet"});
  ASSERT_EQ(ended.code, 0) << ended.err;
  EXPECT_EQ(ended.out + ended.err, "");
  EXPECT_EQ(everything(), (std::vector<std::string>{
                              "new", "new/results", "new/results/animation.svg", "new/results/fields.csv",
                              "new/results/history.csv", "new/results/outlines.csv", "new/results/particles",
                              "new/results/particles.pvd", "new/results/particles/frame_001.vtu",
                              "new/results/particles/frame_002.vtu", "new/results/report.html",
                              "new/results/result.json", "slump.toml"}));

  const json written = result("new/results");
  EXPECT_EQ(written.at("command"), "slump");
  EXPECT_EQ(written.at("version").get<std::string>() + "\n", run({"--version"}).out);
  EXPECT_EQ(written.at("status"), "ok");
  EXPECT_GT(written.at("seconds").get<double>(), 0.0);
  EXPECT_TRUE(written.at("warnings").is_array());
  ASSERT_EQ(written.at("outlines").size(), 2);
  EXPECT_EQ(written.at("outlines")[0].at("time_s"), 0.1);
  EXPECT_EQ(written.at("outlines")[1].at("time_s"), 0.3);
  for (const json& outline : written.at("outlines")) {
    // no higher than it was filled, no narrower than the mould, but for a fifth of a cell
    EXPECT_NEAR(outline.at("height_mm").get<double>(), 40.0, 13.0);
    EXPECT_GT(outline.at("toe_mm").get<double>(), 39.0 - 2.6);
    EXPECT_LT(outline.at("height_mm").get<double>(), 40.0 + 2.6);
  }
  EXPECT_LT(written.at("volume_error").get<double>(), 0.01);
  EXPECT_GE(written.at("energy_error").get<double>(), 0.0);
  EXPECT_LT(written.at("energy_error").get<double>(), 0.1);
  EXPECT_GT(written.at("particle_steps").get<double>(), 0.0);

  const auto begins = [&](std::string_view name, std::string_view text) {
    const std::string content = content_of(folder() / "new/results" / name);
    EXPECT_TRUE(content.starts_with(text)) << name << " begins: " << content.substr(0, 80);
  };
  begins("outlines.csv", "time_s,r_mm,z_mm\n0.1,");
  begins("history.csv", "time_s,height_mm,toe_mm,kinetic_J,");
  begins("fields.csv", "time_s,r_mm,z_mm,strain_rate_per_s,ocr,pore_pressure_kPa\n0.1,");
  begins("animation.svg", "<svg xmlns=\"http://www.w3.org/2000/svg\" ");
  begins("particles/frame_001.vtu", "<?xml");
  const std::string frames = content_of(folder() / "new/results/particles.pvd");
  for (const char* name : {"particles/frame_001.vtu", "particles/frame_002.vtu"}) {
    EXPECT_NE(frames.find(name), std::string::npos) << frames;
  }
  const std::string report = content_of(folder() / "new/results/report.html");
  EXPECT_NE(report.find("<svg"), std::string::npos);
  EXPECT_NE(report.find("</html>"), std::string::npos);
}

TEST_F(SlumpCommand, SameInputGivesTheSameBytesButForTheSeconds) {
  write("slump.toml", kTinySlump);
  for (const char* out : {"first", "second"}) ASSERT_EQ(run({"slump", "slump.toml", "--out", out}).code, 0);
  int compared = 0;
  for (const auto& entry : std::filesystem::recursive_directory_iterator(folder() / "first")) {
    if (!entry.is_regular_file()) continue;
    const auto name = entry.path().lexically_relative(folder() / "first");
    std::string first = content_of(entry.path());
    std::string second = content_of(folder() / "second" / name);
    if (name == "result.json") {
      const auto without_seconds = [](const std::string& text) {
        const std::size_t begin = text.find("\"seconds\":");
        EXPECT_NE(begin, std::string::npos);
        return text.substr(0, begin) + text.substr(text.find('\n', begin));
      };
      first = without_seconds(first);
      second = without_seconds(second);
    }
    EXPECT_EQ(first, second) << name;
    ++compared;
  }
  EXPECT_EQ(compared, 9);
}

TEST_F(SlumpCommand, FilesOfOthersInTheOutFolderAreLeftAlone) {
  write("slump.toml", kTinySlump);
  std::filesystem::create_directory(folder() / "results");
  write("results/notes.txt", "mine");
  write("results/result.json", "old");
  ASSERT_EQ(run({"slump", "slump.toml", "--out", "results"}).code, 0);
  EXPECT_EQ(content_of(folder() / "results/notes.txt"), "mine");
  EXPECT_EQ(result("results").at("status"), "ok");
}

// An hour of a tall slump on fine cells takes far longer than the test waits.
TEST_F(SlumpCommand, InterruptLeavesNothingButTheCheckpoint) {
  std::string slump = replaced(std::string(kTinySlump), "cell_size_mm = 13.0", "cell_size_mm = 1.0");
  slump = replaced(slump, "fill_height_mm = 40.0", "fill_height_mm = 140.0");
  write("slump.toml", replaced(slump, "times_s = [0.1, 0.3]", "times_s = [3600.0]"));
  for (const int signal : {SIGINT, SIGTERM}) {
    Process process = start({"slump", "slump.toml", "--out", "new/results"});
    // results are being staged: the run has begun
    const auto deadline = std::chrono::steady_clock::now() + std::chrono::seconds(30);
    while (everything().size() < 3 && std::chrono::steady_clock::now() < deadline) {
      std::this_thread::sleep_for(std::chrono::milliseconds(10));
    }
    ASSERT_GE(everything().size(), 3) << "nothing was staged within 30 s";
    process.signal(signal);
    const Ended ended = process.wait();
    EXPECT_EQ(ended.code, 130);
    EXPECT_NE(ended.err.find("interrupted"), std::string::npos) << ended.err;
    std::vector<std::string> left = everything();
    std::erase(left, "new");  // the folder of a checkpoint, which an early interrupt does not make
    std::erase(left, "new/results.checkpoint");
    EXPECT_EQ(left, (std::vector<std::string>{"slump.toml"}));
    std::filesystem::remove_all(folder() / "new");
  }
}

TEST_F(SlumpCommand, AnInterruptedRunGoesOnWhereItStopped) {
  std::string slump = replaced(std::string(kTinySlump), "cell_size_mm = 13.0", "cell_size_mm = 2.0");
  write("slump.toml", replaced(slump, "times_s = [0.1, 0.3]", "times_s = [0.1, 1.0]"));
  ASSERT_EQ(run({"slump", "slump.toml", "--out", "whole"}).code, 0);
  Process process = start({"slump", "slump.toml", "--out", "parts"});
  std::this_thread::sleep_for(std::chrono::milliseconds(300));
  process.signal(SIGINT);
  const int code = process.wait().code;
  if (code != 0) {  // else it was over already; not 130 where the signal came before the program was up
    EXPECT_EQ(run({"slump", "slump.toml", "--out", "parts"}).code, 0);
  }
  EXPECT_FALSE(std::filesystem::exists(folder() / "parts.checkpoint"));
  for (const char* file : {"outlines.csv", "history.csv", "particles/frame_002.vtu"}) {
    EXPECT_EQ(contents(std::string("parts/") + file), contents(std::string("whole/") + file)) << file;
  }
}

// A metre of slurry, hardly more than water, runs off the grid, which reaches six radii from the axis: 234
// mm.
TEST_F(SlumpCommand, NumericsThatFailAreAResultThatSaysWhere) {
  std::string slump = replaced(std::string(kTinySlump), "void_ratio = 3.891", "void_ratio = 29");
  slump = replaced(slump, "fill_height_mm = 40.0", "fill_height_mm = 1000.0");
  write("slump.toml", replaced(slump, "times_s = [0.1, 0.3]", "times_s = [5.0]"));
  const Ended ended = run({"slump", "slump.toml", "--out", "results"});
  EXPECT_EQ(ended.code, 3);
  EXPECT_NE(ended.err.find("leaves the grid"), std::string::npos) << ended.err;
  EXPECT_EQ(everything(),
            (std::vector<std::string>{"results", "results.checkpoint", "results/result.json", "slump.toml"}))
      << "the last good state is kept";
  const json written = result("results");
  EXPECT_EQ(written.at("command"), "slump");
  EXPECT_EQ(written.at("status"), "failed");
  EXPECT_NE(written.at("failure").get<std::string>().find("leaves the grid"), std::string::npos);
  EXPECT_GT(written.at("time_s").get<double>(), 0.0);
  EXPECT_LT(written.at("time_s").get<double>(), 5.0);
  EXPECT_NEAR(written.at("r_mm").get<double>(), 6.0 * 39.0, 13.0);
}

TEST_F(SlumpCommand, ComparesSeveralSlumps) {
  write("slow.toml",
        replaced(std::string(kTinySlump), "lift_speed_m_per_s = 0.06", "lift_speed_m_per_s = 0.01"));
  write("fast.toml", kTinySlump);
  ASSERT_EQ(run({"slump", "slow.toml", "fast.toml", "--out", "both", "--threads", "2"}).code, 0);
  ASSERT_EQ(run({"slump", "fast.toml", "--out", "alone"}).code, 0);
  const json written = result("both");
  ASSERT_EQ(written.at("slumps").size(), 2U);
  EXPECT_EQ(written.at("slumps")[0].at("name"), "slow");
  EXPECT_EQ(written.at("slumps")[1].at("outlines"), result("alone").at("outlines"));
  for (const char* file : {"outlines.csv", "history.csv"}) {
    EXPECT_EQ(contents(std::string("both/fast/") + file), contents(std::string("alone/") + file)) << file;
  }
  EXPECT_NE(contents("both/slow/outlines.csv"), contents("both/fast/outlines.csv"));
  const std::string report = contents("both/report.html");
  EXPECT_NE(report.find("lift (m/s)"), std::string::npos) << "what differs has a column";
  EXPECT_EQ(report.find("<th>lambda"), std::string::npos) << "what is the same has none";
}

TEST_F(SlumpCommand, OneOfSeveralThatFailsIsNamedAndTheOthersAreThere) {
  std::string slurry = replaced(std::string(kTinySlump), "void_ratio = 3.891", "void_ratio = 29");
  slurry = replaced(slurry, "fill_height_mm = 40.0", "fill_height_mm = 1000.0");
  write("slurry.toml", replaced(slurry, "times_s = [0.1, 0.3]", "times_s = [5.0]"));
  write("mud.toml", kTinySlump);
  const Ended ended = run({"slump", "slurry.toml", "mud.toml", "--out", "both"});
  EXPECT_EQ(ended.code, 3);
  EXPECT_NE(ended.err.find("slurry"), std::string::npos) << ended.err;
  const json written = result("both");
  EXPECT_EQ(written.at("status"), "failed");
  EXPECT_EQ(written.at("slumps")[0].at("status"), "failed");
  EXPECT_NE(written.at("slumps")[0].at("failure").get<std::string>().find("leaves the grid"),
            std::string::npos);
  EXPECT_EQ(written.at("slumps")[1].at("status"), "ok");
  EXPECT_FALSE(contents("both/mud/outlines.csv").empty());
}

}  // namespace
}  // namespace isotach::consumer
