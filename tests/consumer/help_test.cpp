// Copyright Isotach contributors. SPDX-License-Identifier: BSD-3-Clause
// What the program says of itself: its commands and their options, and its version.
#include <map>
#include <set>
#include <sstream>

#include "tests/consumer/consumer_test.hpp"

namespace isotach::consumer {
namespace {

/// Each command with what its help must name beside the options that all have.
const std::map<std::string, std::vector<std::string>> kCommands{
    {"calibrate", {" STUDY", "--max-file-mb", "--journal", "--no-journal", "--time-limit"}},
    {"discover", {" STUDY", "--max-file-mb", "--journal", "--no-journal", "--time-limit", "--only"}},
    {"element",
     {" TEST", "--max-file-mb", "--integrator", "fellin-ostermann", "cvode", "rosenbrock", "--tolerance"}},
    {"fit-oedometer", {" STUDY", "--max-file-mb"}},
    {"fit-slump", {" STUDY", "--max-file-mb", "--journal", "--no-journal", "--time-limit"}},
    {"next-test", {" STUDY", "--candidates", "--max-file-mb", "--journal", "--no-journal", "--time-limit"}},
    {"profile",
     {" IMAGE", "--scale-mm-per-pixel", "--reference-length-mm", "--mould-picture", "--rectangle",
      "--circle-point", "--camera-distance-mm", "--base-row", "--axis-column", "--region", "--ignore",
      "--time-pattern", "--frames-per-second", "--mould-volume-ml", "--volume-limit-percent",
      "--max-file-mb"}},
    {"slump", {" TEST", "--max-file-mb"}},
    {"verify", {"--sampling", "quick", "full", "--seed"}},
};

class Help : public ConsumerTest {};

TEST_F(Help, ListsTheCommandsThereAreAndNoOther) {
  const Ended ended = run({"--help"});
  EXPECT_EQ(ended.code, 0);
  EXPECT_EQ(ended.err, "");
  const std::size_t heading = ended.out.find("Subcommands:\n");
  ASSERT_NE(heading, std::string::npos) << ended.out;
  std::istringstream lines(ended.out.substr(heading));
  std::string line;
  std::getline(lines, line);
  std::set<std::string> listed;
  while (std::getline(lines, line)) {
    std::istringstream words(line);
    std::string name;
    // a description that goes on is indented further
    if (line.starts_with("  ") && !line.starts_with("   ") && words >> name) listed.insert(name);
  }
  std::set<std::string> expected;
  for (const auto& [command, own] : kCommands) expected.insert(command);
  EXPECT_EQ(listed, expected);
}

TEST_F(Help, OfEachCommandNamesItsInputAndItsOptions) {
  for (const auto& [command, own] : kCommands) {
    const Ended ended = run({command, "--help"});
    EXPECT_EQ(ended.code, 0) << command;
    EXPECT_EQ(ended.err, "") << command;
    std::vector<std::string> parts{"--out", "--threads", "--quiet", "--help"};
    parts.insert(parts.end(), own.begin(), own.end());
    for (const std::string& part : parts) {
      EXPECT_NE(ended.out.find(part), std::string::npos) << command << ": no " << part;
    }
  }
}

TEST_F(Help, VersionIsThreeNumbers) {
  const Ended ended = run({"--version"});
  EXPECT_EQ(ended.code, 0);
  int major = -1;
  int minor = -1;
  int patch = -1;
  char newline = 0;
  ASSERT_EQ(std::sscanf(ended.out.c_str(), "%d.%d.%d%c", &major, &minor, &patch, &newline), 4) << ended.out;
  EXPECT_EQ(newline, '\n');
}

}  // namespace
}  // namespace isotach::consumer
