// Copyright Isotach contributors. SPDX-License-Identifier: BSD-3-Clause
// The UMAT through its exported function: what it refuses and how it says so, and that threads do not meet.
#include "umat/umat.hpp"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <cstddef>
#include <functional>
#include <limits>
#include <ostream>
#include <string>
#include <thread>
#include <vector>

namespace {

thread_local std::vector<std::string> messages;

}  // namespace

/// Stands in for Abaqus' routine of that name, which ends the analysis with a message.
extern "C" __attribute__((visibility("default"))) void stdb_abqerr_(
    const int* kind, const char* text, const int* /*integers*/, const double* /*reals*/,
    const char* /*words*/, std::size_t text_length, std::size_t /*words_length*/) {
  EXPECT_EQ(*kind, -3);
  messages.emplace_back(text, text_length);
}

namespace isotach::umat {
namespace {

constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();

/// A call with all its arguments: set A in kPa and s, oedometric compression.
struct Call {
  std::vector<double> props{1.5, 0.1,  0.02, 0.05, 1e-6, 25.0, 0.0, 0.0, 0.0,
                            1.0, 1e-6, 0.0,  0.0,  1e3,  1.0,  1.5, 0.0};
  std::array<double, 6> stress{-100.0, -65.0, -65.0, 0.0, 0.0, 0.0};
  std::array<double, kStateCount> statev{};
  std::array<double, 36> ddsdde{};
  std::array<double, 6> dstran{-1e-3, 0.0, 0.0, 0.0, 0.0, 0.0};
  std::array<double, 9> drot{1.0, 0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 1.0};
  double dtime = 1e3;
  double pnewdt = 1.0;
  int ndi = 3, nshr = 3, ntens = 6, nstatv = kStateCount;

  void operator()() { with_state(statev.data()); }

  /// The same with STATEV elsewhere.
  void with_state(double* state) {
    const int nprops = static_cast<int>(props.size());
    const int one = 1;
    double unused = 0.0;
    std::array<double, 9> unused_array{};
    const std::string name(80, ' ');
    umat_(stress.data(), state, ddsdde.data(), &unused, &unused, &unused, &unused, unused_array.data(),
          unused_array.data(), &unused, unused_array.data(), dstran.data(), unused_array.data(), &dtime,
          &unused, &unused, &unused, &unused, name.data(), &ndi, &nshr, &ntens, &nstatv, props.data(),
          &nprops, unused_array.data(), drot.data(), &pnewdt, &unused, unused_array.data(),
          unused_array.data(), &one, &one, &one, &one, &one, &one, name.size());
  }
};

struct Refused {
  std::string what;
  std::string said;  ///< words of the message
  std::function<void(Call&)> spoil;
};

/// Keeps test lists readable.
void PrintTo(const Refused& refused, std::ostream* out) {
  *out << refused.what;
}

class UmatRefuses : public testing::TestWithParam<Refused> {};

TEST_P(UmatRefuses, AndSaysWhyAndChangesNothingButPnewdt) {
  messages.clear();
  Call call;
  GetParam().spoil(call);
  const Call before = call;
  call();
  EXPECT_EQ(call.pnewdt, kNoIncrement);
  EXPECT_EQ(call.stress, before.stress);
  EXPECT_EQ(call.ddsdde, before.ddsdde);
  for (std::size_t i = 0; i < call.statev.size(); ++i) {
    EXPECT_TRUE(call.statev[i] == before.statev[i] || std::isnan(before.statev[i]));
  }
  ASSERT_EQ(messages.size(), 1U);
  EXPECT_NE(messages[0].find(GetParam().said), std::string::npos) << messages[0];
  EXPECT_NE(messages[0].find("accepted"), std::string::npos) << messages[0];
  EXPECT_EQ(messages[0].find('%'), std::string::npos) << "Abaqus would take it for a format";
}

INSTANTIATE_TEST_SUITE_P(
    Each, UmatRefuses,
    testing::Values(
        Refused{"PlaneStress", "(NDI, NSHR, NTENS) is (2, 1, 3)",
                [](Call& c) { c.ndi = 2, c.nshr = 1, c.ntens = 3; }},
        Refused{"CountsThatDisagree", "(3, 1, 6)", [](Call& c) { c.nshr = 1; }},
        Refused{"TooFewStateVariables", "NSTATV is 10; accepted: 11", [](Call& c) { c.nstatv = 10; }},
        Refused{"AMissingProperty", "NPROPS is 16; accepted: 17", [](Call& c) { c.props.pop_back(); }},
        Refused{"AnExtraProperty", "NPROPS is 18; accepted: 17", [](Call& c) { c.props.push_back(0.0); }},
        Refused{"KappaAboveLambda", "PROPS(3)", [](Call& c) { c.props[2] = 0.2; }},
        Refused{"NegativeRate", "PROPS(5)", [](Call& c) { c.props[4] = -1e-6; }},
        Refused{"FrictionAngleOf90", "PROPS(6)", [](Call& c) { c.props[5] = 90.0; }},
        Refused{"C1ThatLeavesNoCompression", "PROPS(7)", [](Call& c) { c.props[6] = 0.8; }},
        Refused{"C3OfOne", "PROPS(9)", [](Call& c) { c.props[8] = 1.0; }},
        Refused{"ParameterNotANumber", "PROPS(2)", [](Call& c) { c.props[1] = kNaN; }},
        Refused{"LodeSwitchOfTwo", "PROPS(10)", [](Call& c) { c.props[9] = 2.0; }},
        Refused{"ToleranceOfOne", "PROPS(11)", [](Call& c) { c.props[10] = 1.0; }},
        Refused{"NegativeStressTolerance", "PROPS(12)", [](Call& c) { c.props[11] = -1.0; }},
        Refused{"HalfASubstep", "PROPS(13)", [](Call& c) { c.props[12] = 0.5; }},
        Refused{"NoStressUnit", "PROPS(14)", [](Call& c) { c.props[13] = 0.0; }},
        Refused{"NoTimeUnit", "PROPS(15)", [](Call& c) { c.props[14] = 0.0; }},
        Refused{"NegativeVoidRatio", "PROPS(16)", [](Call& c) { c.props[15] = -0.1; }},
        Refused{"OcrNotANumber", "PROPS(17)", [](Call& c) { c.props[16] = kNaN; }},
        Refused{"VoidRatioAndOcr", "PROPS(17)", [](Call& c) { c.props[16] = 1.2; }},
        Refused{"NeitherVoidRatioNorOcr", "neither PROPS(16)", [](Call& c) { c.props[15] = 0.0; }},
        Refused{"OcrThatLeavesNoVoids", "void ratio of -",
                [](Call& c) { c.props[15] = 0.0, c.props[16] = 1e6; }},
        Refused{"StateWithoutVoids", "STATEV(1)", [](Call& c) { c.statev[0] = -0.1; }},
        Refused{"StateNotANumber", "STATEV(1)", [](Call& c) { c.statev[0] = kNaN; }},
        Refused{"OmegaWithATrace", "STATEV(2:4)", [](Call& c) { c.statev[1] = 0.1; }},
        Refused{"OmegaBeyondTheEllipse", "Omega:Omega",
                [](Call& c) { c.statev[1] = 1.0, c.statev[2] = -1.0; }},
        Refused{"NoStress", "STRESS has p = 0 kPa", [](Call& c) { c.stress.fill(0.0); }},
        Refused{"NoStressWithAnOcr", "STRESS has p = 0 kPa",
                [](Call& c) { c.stress.fill(0.0), c.props[15] = 0.0, c.props[16] = 1.2; }},
        Refused{"StressBeyondTheCone", "q = 300 kPa",
                [](Call& c) { c.stress = {-300.0, 0.0, 0.0, 0.0, 0.0, 0.0}; }},
        Refused{"NegativeTime", "DTIME is -1", [](Call& c) { c.dtime = -1.0; }},
        Refused{"NoRotation", "DROT", [](Call& c) { c.drot.fill(0.0); }}),
    [](const auto& refused) { return refused.param.what; });

TEST(Umat, RefusesWithinCodesThatStartPnewdtBelowZero) {
  Call call;
  call.pnewdt = -1.0;  // CalculiX, where a positive value below 1 asks for a shorter increment
  call.props[2] = 0.2;
  call();
  EXPECT_EQ(call.pnewdt, kNoIncrement);
}

TEST(Umat, LeavesPnewdtAloneWhereItSucceeds) {
  for (const double pnewdt : {-1.0, 0.5, 1.0, 1.5}) {
    Call call;
    call.pnewdt = pnewdt;
    call();
    EXPECT_EQ(call.pnewdt, pnewdt);
  }
}

TEST(Umat, KeepsAShorterIncrementAlreadyAskedFor) {
  Call call;
  call.dstran = {-0.4, -0.3, -0.3, 0.0, 0.0, 0.0};  // void ratio would fall below zero
  call.pnewdt = 0.1;
  call();
  EXPECT_EQ(call.pnewdt, 0.1);
  call.pnewdt = 1.0;
  call();
  EXPECT_EQ(call.pnewdt, kShorterIncrement);
}

TEST(Umat, StrainThatIsNotANumberIsAFailureNotAState) {
  Call call;
  call.dstran[3] = kNaN;
  const auto stress = call.stress;
  call();
  EXPECT_EQ(call.pnewdt, kShorterIncrement);
  EXPECT_EQ(call.stress, stress);
}

TEST(Umat, WritesNoStateVariableBeyondItsOwn) {
  Call call;
  std::vector<double> long_state(20, 7.0);
  long_state[0] = 1.5;
  for (std::size_t i = 1; i < 8; ++i) long_state[i] = 0.0;
  call.nstatv = 20;
  call.with_state(long_state.data());
  EXPECT_EQ(call.pnewdt, 1.0);
  EXPECT_NE(long_state[0], 1.5);
  for (std::size_t i = kStateCount; i < long_state.size(); ++i) EXPECT_EQ(long_state[i], 7.0);
}

/// History of one point: every point another material, start and path.
std::vector<double> history(std::size_t number) {
  const double x = static_cast<double>(number);
  Call call;
  call.props[6] = 0.01 * std::fmod(x, 7.0);
  call.props[7] = std::fmod(x, 3.0) * 5.0;  // C_2: every third point has no Omega
  call.props[8] = 0.3;
  call.stress[1] = -60.0 - std::fmod(x, 11.0);
  std::vector<double> all;
  for (int increment = 0; increment < 20; ++increment) {
    call.dstran = {-1e-3 * std::cos(0.1 * x), 2e-4 * std::sin(x), 0.0, 3e-4 * std::sin(0.3 * x), 0.0, 1e-4};
    call();
    EXPECT_EQ(call.pnewdt, 1.0);
    all.insert(all.end(), call.stress.begin(), call.stress.end());
    all.insert(all.end(), call.statev.begin(), call.statev.end());
    all.insert(all.end(), call.ddsdde.begin(), call.ddsdde.end());
  }
  return all;
}

TEST(Umat, ThreadsOnDifferentPointsGiveTheBitsOfOne) {
  constexpr std::size_t kThreads = 8;
  constexpr std::size_t kPoints = 64;
  std::vector<std::vector<double>> serial(kPoints);
  for (std::size_t i = 0; i < kPoints; ++i) serial[i] = history(i);
  std::vector<std::vector<double>> parallel(kPoints);
  std::vector<std::thread> threads;
  for (std::size_t t = 0; t < kThreads; ++t) {
    threads.emplace_back([t, &parallel] {
      for (std::size_t i = t; i < kPoints; i += kThreads) parallel[i] = history(i);
    });
  }
  for (std::thread& thread : threads) thread.join();
  for (std::size_t i = 0; i < kPoints; ++i) EXPECT_EQ(parallel[i], serial[i]);
}

}  // namespace
}  // namespace isotach::umat
