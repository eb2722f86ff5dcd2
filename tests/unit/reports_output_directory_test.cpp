// Copyright Isotach contributors. SPDX-License-Identifier: BSD-3-Clause
// Tests of the atomic publishing of results.
#include <gtest/gtest.h>
#include <stdlib.h>
#include <sys/stat.h>

#include <fstream>
#include <iterator>
#include <limits>
#include <set>
#include <string>

#include "reports/output_directory.hpp"

namespace isotach::reports {
namespace {

namespace fs = std::filesystem;

class OutputDirectoryTest : public ::testing::Test {
 protected:
  OutputDirectoryTest() {
    std::string name = (fs::temp_directory_path() / "isotach-test-XXXXXX").string();
    root_ = mkdtemp(name.data());
  }
  ~OutputDirectoryTest() override { fs::remove_all(root_); }

  /// Everything below root_, hidden things included.
  [[nodiscard]] std::set<std::string> tree() const {
    std::set<std::string> names;
    for (const auto& entry : fs::recursive_directory_iterator(root_)) {
      names.insert(entry.path().lexically_relative(root_).string());
    }
    return names;
  }

  void put(const fs::path& name, const std::string& content) const { std::ofstream(root_ / name) << content; }

  [[nodiscard]] std::string content(const fs::path& name) const {
    std::ifstream file(root_ / name, std::ios::binary);
    return {std::istreambuf_iterator<char>(file), {}};
  }

  fs::path root_;
};

using Names = std::set<std::string>;

TEST_F(OutputDirectoryTest, NothingIsVisibleBeforeCommit) {
  OutputDirectory output(root_ / "a/b/out");
  output.write_text("report.html", "x");
  EXPECT_FALSE(fs::exists(root_ / "a/b/out"));
  output.commit();
  EXPECT_EQ(tree(), (Names{"a", "a/b", "a/b/out", "a/b/out/report.html"}));
  EXPECT_EQ(content("a/b/out/report.html"), "x");
}

TEST_F(OutputDirectoryTest, WithoutCommitNothingRemains) {
  {
    OutputDirectory output(root_ / "a/b/out");
    output.write_text("particles/frame.vtu", "x");
    EXPECT_GT(tree().size(), 2U);
  }
  EXPECT_EQ(tree(), Names{});
}

TEST_F(OutputDirectoryTest, WithoutCommitAnExistingFolderIsAsItWas) {
  fs::create_directory(root_ / "out");
  put("out/mine.txt", "mine");
  {
    OutputDirectory output(root_ / "out");
    output.write_text("mine.txt", "new");
  }
  EXPECT_EQ(tree(), (Names{"out", "out/mine.txt"}));
  EXPECT_EQ(content("out/mine.txt"), "mine");
}

TEST_F(OutputDirectoryTest, AParentThatSomebodyUsesStays) {
  {
    OutputDirectory output(root_ / "a/out");
    put("a/theirs.txt", "theirs");
  }
  EXPECT_EQ(tree(), (Names{"a", "a/theirs.txt"}));
}

TEST_F(OutputDirectoryTest, JoinsAnExistingFolderAndLeavesOtherFilesAlone) {
  fs::create_directories(root_ / "out/particles");
  put("out/mine.txt", "mine");
  put("out/result.json", "old");
  put("out/particles/old.vtu", "old");
  OutputDirectory output(root_ / "out");
  output.write_text("result.json", "new");
  output.write_text("particles/new.vtu", "new");
  output.commit();
  EXPECT_EQ(tree(), (Names{"out", "out/mine.txt", "out/result.json", "out/particles", "out/particles/old.vtu",
                           "out/particles/new.vtu"}));
  EXPECT_EQ(content("out/mine.txt"), "mine");
  EXPECT_EQ(content("out/result.json"), "new");
}

TEST_F(OutputDirectoryTest, JoinsAFolderThatAppearedInTheMeantime) {
  OutputDirectory output(root_ / "out");
  output.write_text("a.txt", "a");
  fs::create_directory(root_ / "out");
  put("out/b.txt", "b");
  output.commit();
  EXPECT_EQ(tree(), (Names{"out", "out/a.txt", "out/b.txt"}));
}

TEST_F(OutputDirectoryTest, NothingMovesWhereAFolderIsInTheWay) {
  fs::create_directories(root_ / "out/report.html");
  OutputDirectory output(root_ / "out");
  output.write_text("a.txt", "a");
  output.write_text("report.html", "x");
  EXPECT_THROW(output.commit(), OutputError);
  EXPECT_FALSE(fs::exists(root_ / "out/a.txt"));
}

TEST_F(OutputDirectoryTest, ResultsHaveTheUsualPermissions) {
  OutputDirectory output(root_ / "out");
  output.commit();
  fs::create_directory(root_ / "usual");
  EXPECT_EQ(fs::status(root_ / "out").permissions(), fs::status(root_ / "usual").permissions());
}

TEST_F(OutputDirectoryTest, ATrailingSlashChangesNothing) {
  OutputDirectory output((root_ / "out").string() + "/");
  output.write_text("a.txt", "a");
  output.commit();
  EXPECT_EQ(tree(), (Names{"out", "out/a.txt"}));
}

/// The message of the OutputError that a destination raises at once; empty where it raises none.
std::string refusal(const fs::path& destination) {
  try {
    const OutputDirectory output(destination);
  } catch (const OutputError& error) {
    return error.what();
  }
  return {};
}

TEST_F(OutputDirectoryTest, RefusesAtOnceWhatCannotBeWritten) {
  put("file", "x");
  EXPECT_NE(refusal(root_ / "file").find((root_ / "file").string()), std::string::npos);
  EXPECT_NE(refusal(root_ / "file/out").find((root_ / "file").string()), std::string::npos);
  EXPECT_NE(refusal("/proc/isotach/out").find("/proc/isotach"), std::string::npos);
  EXPECT_NE(refusal("/proc").find("/proc"), std::string::npos);
  EXPECT_NE(refusal(""), "");
  fs::create_symlink(root_ / "nowhere", root_ / "link");
  fs::create_symlink(root_ / "file", root_ / "file-link");
  EXPECT_NE(refusal(root_ / "file-link"), "");
  EXPECT_EQ(tree(), (Names{"file", "link", "file-link"}));
}

TEST_F(OutputDirectoryTest, FollowsALinkToAFolder) {
  fs::create_directory(root_ / "real");
  fs::create_symlink(root_ / "real", root_ / "link");
  OutputDirectory output(root_ / "link");
  output.write_text("a.txt", "a");
  output.commit();
  EXPECT_EQ(tree(), (Names{"link", "real", "real/a.txt"}));
}

TEST_F(OutputDirectoryTest, NamesStayInside) {
  OutputDirectory output(root_ / "out");
  for (const char* name : {"", ".", "..", "../x", "a/../../x", "/etc/x", "a/"}) {
    EXPECT_THROW(output.write_text(name, "x"), std::invalid_argument) << name;
  }
  output.commit();
  EXPECT_THROW(output.write_text("late.txt", "x"), std::logic_error);
  EXPECT_THROW(output.commit(), std::logic_error);
}

TEST_F(OutputDirectoryTest, OtherWritersUseTheStagingPath) {
  OutputDirectory output(root_ / "out");
  std::ofstream(output.staging_path("particles/frame.vtu")) << "vtu";
  output.commit();
  EXPECT_EQ(content("out/particles/frame.vtu"), "vtu");
}

TEST_F(OutputDirectoryTest, JsonKeepsOrderAndHasNullForNoNumber) {
  OutputDirectory output(root_ / "out");
  nlohmann::ordered_json value;
  value["z"] = std::numeric_limits<double>::quiet_NaN();
  value["a"] = 0.1;
  value["bad"] = "\xff";
  output.write_json("result.json", value);
  output.write_json("sorted.json", nlohmann::json{{"z", 1}, {"a", 2}});
  output.commit();
  EXPECT_EQ(content("out/result.json"), "{\n  \"z\": null,\n  \"a\": 0.1,\n  \"bad\": \"\xEF\xBF\xBD\"\n}\n");
  EXPECT_EQ(content("out/sorted.json"), "{\n  \"a\": 2,\n  \"z\": 1\n}\n");
}

TEST_F(OutputDirectoryTest, CsvRoundTripsAndQuotes) {
  OutputDirectory output(root_ / "out");
  const double third = 1.0 / 3.0;
  const std::vector<CsvColumn> columns = {
      {"time_s", std::vector<double>{0.1, third, 1e-300, std::numeric_limits<double>::quiet_NaN()}},
      {"stage, name", std::vector<std::string>{"load", "a,b", "say \"x\"", ""}}};
  output.write_csv("curve.csv", columns);
  output.commit();
  EXPECT_EQ(content("out/curve.csv"),
            "time_s,\"stage, name\"\n0.1,load\n0.3333333333333333,\"a,b\"\n1e-300,\"say \"\"x\"\"\"\n,\n");
}

TEST_F(OutputDirectoryTest, CsvColumnsHaveOneLength) {
  OutputDirectory output(root_ / "out");
  const std::vector<CsvColumn> columns = {{"a", std::vector<double>{1.0}}, {"b", std::vector<double>{}}};
  EXPECT_THROW(output.write_csv("curve.csv", columns), std::invalid_argument);
}

}  // namespace
}  // namespace isotach::reports
