// Copyright Isotach contributors. SPDX-License-Identifier: BSD-3-Clause
// CsvTable: the forms of delimited text it takes, and what it refuses.
#include <gtest/gtest.h>

#include <string>

#include "datasets/csv_table.hpp"
#include "tests/unit/datasets_files.hpp"

namespace isotach::datasets {
namespace {

using namespace std::string_literals;

class CsvTableTest : public testing::Test {
 protected:
  CsvTable read(std::string_view content) const {
    return CsvTable::read(folder_.write("table.csv", content));
  }
  void expect_refused(std::string_view content, std::initializer_list<std::string_view> parts) const {
    expect_input_error([&] { static_cast<void>(read(content)); }, parts);
  }
  void expect_number_refused(std::string_view cell, std::initializer_list<std::string_view> parts) const {
    const CsvTable table = read("time_s;value\n1;"s + std::string(cell) + "\n");
    expect_input_error([&] { static_cast<void>(table.number(0, 1)); }, parts);
  }

  TemporaryFolder folder_;
};

TEST_F(CsvTableTest, ReadsCommas) {
  const CsvTable table = read("a,b\n1,-2.5e3\n");
  EXPECT_EQ(table.columns(), (std::vector<std::string>{"a", "b"}));
  ASSERT_EQ(table.row_count(), 1U);
  EXPECT_EQ(table.number(0, 0), 1.0);
  EXPECT_EQ(table.number(0, 1), -2500.0);
}

TEST_F(CsvTableTest, SemicolonsAndTabsAllowADecimalComma) {
  for (const std::string_view content : {"a;b\n0,5;1.25\n", "a\tb\n0,5\t1.25\n"}) {
    const CsvTable table = read(content);
    EXPECT_EQ(table.number(0, 0), 0.5);
    EXPECT_EQ(table.number(0, 1), 1.25);
  }
}

TEST_F(CsvTableTest, ByteOrderMarkCarriageReturnsCommentsAndBlankLinesLeaveNoTrace) {
  const CsvTable table =
      read("\xEF\xBB\xBF# made by a logger\r\n\r\na,b\r\n1,2\r\n# a break, of a day\r\n,\r\n3,4");
  EXPECT_EQ(table.columns().front(), "a");
  ASSERT_EQ(table.row_count(), 2U);
  EXPECT_EQ(table.number(1, 1), 4.0);
  EXPECT_EQ(table.place(0).line, 4U);
  EXPECT_EQ(table.place(1).line, 7U);
}

TEST_F(CsvTableTest, QuotedCellsMayHoldDelimitersAndQuotes) {
  const CsvTable table = read("\"a, s\", b \n \"x,\"\"y\"\"\" , \"2\"\n");
  EXPECT_EQ(table.columns(), (std::vector<std::string>{"a, s", "b"}));
  EXPECT_EQ(table.text(0, 0), "x,\"y\"");
  EXPECT_EQ(table.number(0, 1), 2.0);
}

TEST_F(CsvTableTest, EmptyCellsBeyondTheHeaderAreNotCells) {
  const CsvTable table = read("a;b;\n1;2;\n3;4;;;\n");
  EXPECT_EQ(table.columns().size(), 2U);
  EXPECT_EQ(table.number(1, 1), 4.0);
}

TEST_F(CsvTableTest, NumbersAreTheNearestDoubles) {
  const CsvTable table = read("a,b,c\n0.1,+3.3,123456.789012345\n");
  EXPECT_EQ(table.number(0, 0), 0.1);
  EXPECT_EQ(table.number(0, 1), 3.3);
  EXPECT_EQ(table.number(0, 2), 123456.789012345);
}

TEST_F(CsvTableTest, RowsSurviveBeyondTheLineReadersFirstBlock) {
  // 3 x 16 MiB: more than the reader holds at once
  std::string content = "a,b\n";
  const std::string padding(1 << 20, ' ');
  for (int i = 0; i < 48; ++i) content += std::to_string(i) + "," + padding + std::to_string(2 * i) + "\n";
  const CsvTable table = read(content);
  ASSERT_EQ(table.row_count(), 48U);
  for (std::size_t i = 0; i < 48; ++i) {
    EXPECT_EQ(table.number(i, 0), static_cast<double>(i));
    EXPECT_EQ(table.number(i, 1), static_cast<double>(2 * i));
  }
}

TEST_F(CsvTableTest, TextInANumberNamesFileLineColumnAndText) {
  const CsvTable table = read("time_s,axial_stress_kPa\n1,2\n# a comment\n2,abc\n");
  expect_input_error(
      [&] { static_cast<void>(table.number(1, 1)); },
      {"table.csv:4: column axial_stress_kPa: \"abc\" is not a number; accepted: a finite number"});
}

TEST_F(CsvTableTest, WhatIsNoFiniteDecimalNumberIsRefused) {
  expect_number_refused("nan", {"table.csv:2", "column value", "\"nan\" is not a finite number"});
  expect_number_refused("-inf", {"\"-inf\" is not a finite number"});
  expect_number_refused("1e999", {"\"1e999\" is not a finite number"});
  expect_number_refused("1.234,5", {"\"1.234,5\" is not a number"});
  expect_number_refused("0x10", {"\"0x10\" is not a number"});
  expect_number_refused("5 kPa", {"\"5 kPa\" is not a number"});
  expect_number_refused("+-5", {"\"+-5\" is not a number"});
  expect_number_refused("", {"\"\" is not a number"});
}

TEST_F(CsvTableTest, ANumberOutsideOfItsRangeNamesTheRange) {
  const CsvTable table = read("a\n-3\n");
  expect_input_error([&] { static_cast<void>(table.number(0, 0, Range::positive(5.0))); },
                     {"table.csv:2: column a: \"-3\" is out of range; accepted: > 0 and <= 5"});
}

TEST_F(CsvTableTest, AMissingColumnListsThoseFound) {
  const CsvTable table = read("# logger\ntime,b\n1,2\n");
  expect_input_error([&] { static_cast<void>(table.require("time_s")); },
                     {"table.csv:2: column time_s is missing; columns found: time, b"});
}

TEST_F(CsvTableTest, RowsOfAnotherLengthAreRefused) {
  expect_refused("a,b,c\n1,2,3\n1,2\n", {"table.csv:3", "column c", "ends after 2 cells", "3 cells"});
  expect_refused("a,b\n0,5,1,5\n", {"table.csv:2", "4 cells", "2 cells", "decimal commas"});
}

TEST_F(CsvTableTest, ADefectiveQuoteIsRefused) {
  expect_refused("a,b\n1,\"2\n", {"table.csv:2", "no closing quote"});
  expect_refused("a,b\n\"1\"x,2\n", {"table.csv:2", "\"x\" behind its closing quote"});
}

TEST_F(CsvTableTest, AColumnTwiceIsRefused) {
  expect_refused("a,b,a\n1,2,3\n", {"table.csv:1", "column a occurs twice"});
}

TEST_F(CsvTableTest, FilesWithoutDataAreRefused) {
  expect_refused("", {"table.csv: file: it is empty"});
  expect_refused("\xEF\xBB\xBF", {"table.csv: file: it is empty"});
  expect_refused("\n# nothing\n", {"table.csv: file: it has no header"});
  expect_refused("# x\na,b\n\n", {"table.csv:2: file: no row behind the header"});
}

TEST_F(CsvTableTest, ANulByteIsRefusedWithItsLine) {
  expect_refused("a,b\n1,2\n3,\0004\n"s, {"table.csv:3", "NUL byte", "UTF-8"});
}

TEST_F(CsvTableTest, ALineOf16MebibytesIsRefused) {
  expect_refused("a,b\n1," + std::string(std::size_t{1} << 24, ' ') + "2\n",
                 {"table.csv:2", "too long", "16 MiB"});
}

TEST_F(CsvTableTest, ADirectoryAndAMissingFileAreRefused) {
  expect_input_error([&] { static_cast<void>(CsvTable::read(folder_.path())); },
                     {folder_.path().string(), "it is a directory"});
  expect_input_error([&] { static_cast<void>(CsvTable::read(folder_.path() / "none.csv")); },
                     {"none.csv", "does not exist"});
}

TEST_F(CsvTableTest, AnUnreadableFileIsRefused) {
  const auto file = folder_.write("secret.csv", "a\n1\n");
  std::filesystem::permissions(file, std::filesystem::perms::none);
  if (std::ifstream(file)) GTEST_SKIP() << "this user may read every file";
  expect_input_error([&] { static_cast<void>(CsvTable::read(file)); }, {"secret.csv", "cannot be opened"});
}

TEST_F(CsvTableTest, TheSizeLimitIsTheLargestSizeAccepted) {
  const auto file = folder_.write("table.csv", "a\n1\n");
  EXPECT_EQ(CsvTable::read(file, {4}).row_count(), 1U);
  expect_input_error([&] { static_cast<void>(CsvTable::read(file, {3})); },
                     {"table.csv: file size: 4 bytes; accepted: at most 3 bytes"});
}

TEST_F(CsvTableTest, TheSizeLimitHoldsForFilesWithoutASize) {
  expect_input_error([&] { static_cast<void>(CsvTable::read("/dev/zero", {1000})); },
                     {"/dev/zero", "at most 1000"});
}

TEST_F(CsvTableTest, TheDefaultLimitIs100MB) {
  const auto file = folder_.write("huge.csv", "a\n1\n");
  std::filesystem::resize_file(file, 100'000'001);  // sparse: takes no space
  expect_input_error([&] { static_cast<void>(CsvTable::read(file)); },
                     {"huge.csv", "100000001 bytes", "at most 100000000 bytes"});
}

}  // namespace
}  // namespace isotach::datasets
