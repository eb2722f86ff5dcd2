// Copyright Isotach contributors. SPDX-License-Identifier: BSD-3-Clause
// Tests of numbers as text; the expected strings are rounded by hand.
#include <gtest/gtest.h>

#include <limits>
#include <nlohmann/json.hpp>

#include "reports/json_number.hpp"
#include "reports/number.hpp"

namespace isotach::reports {
namespace {

constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();
constexpr double kInfinity = std::numeric_limits<double>::infinity();

TEST(FormatNumber, KeepsTheDigitsAskedFor) {
  EXPECT_EQ(format_number(1.3583), "1.358");
  EXPECT_EQ(format_number(2.0), "2.000");
  EXPECT_EQ(format_number(0.0129, 3), "0.0129");
  EXPECT_EQ(format_number(123456.0), "123500");
  EXPECT_EQ(format_number(30.0, 2), "30");
}

TEST(FormatNumber, RoundingMayAddAPlace) {
  EXPECT_EQ(format_number(9.9996), "10.00");
  EXPECT_EQ(format_number(99.96, 3), "100");
  EXPECT_EQ(format_number(0.00099996), "0.001000");
  EXPECT_EQ(format_number(999960.0), "1.000×10⁶");
}

TEST(FormatNumber, FarFromOneIsScientific) {
  EXPECT_EQ(format_number(6.8e-7, 3), "6.80×10⁻⁷");
  EXPECT_EQ(format_number(-2.5e12, 2), "−2.5×10¹²");
  EXPECT_EQ(format_number(1.7976931348623157e308, 3), "1.80×10³⁰⁸");
  EXPECT_EQ(format_number(5e-324, 1), "5×10⁻³²⁴");
}

TEST(FormatNumber, SignsZeroAndMissing) {
  EXPECT_EQ(format_number(-0.25, 2), "−0.25");
  EXPECT_EQ(format_number(0.0), "0");
  EXPECT_EQ(format_number(-0.0), "0");
  EXPECT_EQ(format_number(kNaN), "–");
  EXPECT_EQ(format_number(-kInfinity), "–");
}

TEST(FormatWithError, RoundsToTheSecondDigitOfTheError) {
  EXPECT_EQ(format_with_error(1.35834, 0.00212), "1.3583 ± 0.0021");
  EXPECT_EQ(format_with_error(12345.0, 678.0), "12350 ± 680");
  EXPECT_EQ(format_with_error(-0.154, 0.0996), "−0.15 ± 0.10");
  EXPECT_EQ(format_with_error(0.03, 1.23), "0.0 ± 1.2");
  EXPECT_EQ(format_with_error(0.0, 0.5), "0.00 ± 0.50");
}

TEST(FormatWithError, SharesOnePowerOfTen) {
  EXPECT_EQ(format_with_error(6.8e-7, 1.2e-8), "(6.80 ± 0.12)×10⁻⁷");
  EXPECT_EQ(format_with_error(6.8e-7, 5.04e-6), "(0.7 ± 5.0)×10⁻⁶");
  EXPECT_EQ(format_with_error(-3.21e9, 4.5e7), "(−3.210 ± 0.045)×10⁹");
}

TEST(FormatWithError, WithoutAnErrorIsTheNumberAlone) {
  EXPECT_EQ(format_with_error(1.35834, kNaN), "1.358");
  EXPECT_EQ(format_with_error(1.35834, 0.0), "1.358");
  EXPECT_EQ(format_with_error(1.35834, kInfinity), "1.358");
  EXPECT_EQ(format_with_error(kNaN, 0.1), "–");
}

TEST(FormatDuration, ReadsAsPeopleSayIt) {
  EXPECT_EQ(format_duration(0.424), "0.42 s");
  EXPECT_EQ(format_duration(4.24), "4.2 s");
  EXPECT_EQ(format_duration(45.4), "45 s");
  EXPECT_EQ(format_duration(59.7), "1 min 00 s");
  EXPECT_EQ(format_duration(200.0), "3 min 20 s");
  EXPECT_EQ(format_duration(7500.0), "2 h 05 min");
  EXPECT_EQ(format_duration(-1.0), "–");
  EXPECT_EQ(format_duration(kNaN), "–");
}

TEST(JsonNumber, IsNullWhereThereIsNoNumber) {
  nlohmann::json value;
  value["a"] = json_number(0.1);
  value["b"] = json_number(kNaN);
  value["c"] = json_number(kInfinity);
  EXPECT_EQ(value.dump(), R"({"a":0.1,"b":null,"c":null})");
}

}  // namespace
}  // namespace isotach::reports
