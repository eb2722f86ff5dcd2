// Copyright Isotach contributors. SPDX-License-Identifier: BSD-3-Clause
// The parts of the discovery benchmark that could be wrong unseen: what is hidden, how plainly, and the
// counting.
#include <gtest/gtest.h>

#include <Eigen/LU>
#include <cmath>
#include <fstream>
#include <map>

#include "bench/discovery/made_study.hpp"
#include "bench/discovery/rates.hpp"
#include "bench/discovery/slump_results.hpp"
#include "bench/discovery/wilson.hpp"
#include "bench/synthetic_oedometer.hpp"

namespace isotach::bench {
namespace {

TEST(Wilson, IsThatOfNewcombesTable) {
  // Newcombe, Statistics in Medicine 17 (1998) 857-872, table I, method 3
  struct Published {
    std::size_t hits, count;
    double lower, upper;
  };
  for (const Published& one : {Published{81, 263, 0.2553, 0.3662}, Published{15, 148, 0.0624, 0.1605},
                               Published{0, 20, 0.0, 0.1611}, Published{1, 29, 0.0061, 0.1718}}) {
    const Interval interval = wilson(one.hits, one.count);
    EXPECT_NEAR(interval.lower, one.lower, 5e-5) << one.hits << " of " << one.count;
    EXPECT_NEAR(interval.upper, one.upper, 5e-5) << one.hits << " of " << one.count;
  }
}

TEST(ReadingNoise, HalfOfItsVarianceIsAutocorrelated) {
  const ReadingNoise noise{2.0};
  std::mt19937_64 random(3);
  const auto errors = noise.draw(400000, random);
  const Eigen::MatrixXd covariance = noise.covariance(4);
  for (std::size_t lag = 0; lag < 4; ++lag) {
    double sum = 0.0;
    for (std::size_t i = lag; i < errors.size(); ++i) sum += errors[i] * errors[i - lag];
    const double found = sum / static_cast<double>(errors.size() - lag);
    const double expected = 4.0 * (lag == 0 ? 1.0 : 0.5 * std::pow(0.8, static_cast<double>(lag)));
    EXPECT_NEAR(found, expected, 0.05) << "lag " << lag;
    EXPECT_NEAR(covariance(0, static_cast<Eigen::Index>(lag)), expected, 1e-12) << "lag " << lag;
  }
}

TEST(SeekVisibility, FindsTheAmplitudeThatShowsAsAsked) {
  const auto bent = [](double a) -> std::optional<double> {
    return std::abs(a) > 2.0 ? std::nullopt : std::optional(40.0 * a * a / (1.0 + std::abs(a)));
  };
  for (const double wanted : {0.1, 5.0, 30.0}) {
    for (const double sign : {1.0, -1.0}) {
      const Sought found = seek_visibility(bent, sign * 0.1, sign * 100.0, wanted);
      EXPECT_TRUE(found.reached) << wanted;
      EXPECT_NEAR(*bent(found.amplitude) / wanted, 1.0, kVisibilityTolerance);
      EXPECT_GT(found.amplitude * sign, 0.0);
    }
  }
  EXPECT_FALSE(seek_visibility(bent, 0.1, 0.2, 5.0).reached) << "no more than 0.2 may be";
  EXPECT_FALSE(seek_visibility(bent, 0.1, 100.0, 100.0).reached) << "beyond 2 it cannot be had";
}

/// The case of one effect.
Case hidden(const char* name, Programme programme, double visibility) {
  return {7, Kind::effect, {effects::find_effect(name)}, {}, programme, 0.01, visibility};
}

TEST(MadeStudy, ShowsItsEffectAsAsked) {
  // another way to the same number: derivatives by differences of the reference integration, the covariance
  // inverted whole
  const auto made = make_study(hidden("ring_friction", Programme::rich, 10.0), 11);
  ASSERT_TRUE(made.has_value()) << made.error();
  ASSERT_TRUE(made->reached);
  using model::ParameterId;
  double square = 0.0;
  Eigen::MatrixXd information = Eigen::MatrixXd::Zero(5, 5);  // D_r goes with e100
  Eigen::VectorXd gradient = Eigen::VectorXd::Zero(5);
  std::size_t fitted = 0;
  for (datasets::OedometerTest test : made->study.oedometer_tests) {
    if (test.hold_out) continue;
    ++fitted;
    // the strain that was commanded lies between readings of which each has noise of 1e-5: no matter here
    const auto read = [&](const model::Parameters<double>& parameters, const Hidden& what) {
      const auto values = *exact_log_stress(test, parameters, what);
      return Eigen::VectorXd(
          Eigen::Map<const Eigen::VectorXd>(values.data(), static_cast<Eigen::Index>(values.size())));
    };
    const Eigen::VectorXd change = read(made->truth, made->hidden) - read(made->truth, {});
    Eigen::MatrixXd jacobian(change.size(), 5);
    Eigen::Index column = 0;
    for (const ParameterId id :
         {ParameterId::e100, ParameterId::lambda, ParameterId::kappa, ParameterId::I_v, ParameterId::C_1}) {
      auto above = made->truth.values();
      auto below = above;
      const double step = 1e-3 * above[id];
      above[id] += step;
      below[id] -= step;
      jacobian.col(column++) = (read(*model::Parameters<double>::create(above), {}) -
                                read(*model::Parameters<double>::create(below), {})) /
                               (2.0 * step);
    }
    const Eigen::MatrixXd inverse = ReadingNoise{0.01}.covariance(change.size()).inverse();
    square += change.dot(inverse * change);
    information += jacobian.transpose() * inverse * jacobian;
    gradient += jacobian.transpose() * inverse * change;
  }
  EXPECT_EQ(fitted, 2U);
  const double left = std::sqrt(square - gradient.dot(information.inverse() * gradient));
  EXPECT_NEAR(left, made->visibility, 0.03 * left);
  EXPECT_NEAR(made->visibility, 10.0, 10.0 * kVisibilityTolerance);
  EXPECT_LE(made->beside_another, made->visibility * (1.0 + 1e-9));
}

TEST(MadeStudy, OutsideEffectsAreNothingAtZeroAndShowOtherwise) {
  std::mt19937_64 random(5);
  const model::Parameters<double> truth = random_parameters(random);
  const auto tests = blank_tests(Programme::rich, truth, random);
  const datasets::OedometerTest& test = tests.front();
  const auto base = exact_log_stress(test, truth, {});
  ASSERT_TRUE(base.has_value()) << base.error();
  for (const OutsideInfo& info : outside_effects()) {
    const auto none = exact_log_stress(test, truth, {{}, Outside{info.kind, 0.0}});
    const auto some = exact_log_stress(test, truth, {{}, Outside{info.kind, info.typical}});
    ASSERT_TRUE(none.has_value()) << none.error();
    ASSERT_TRUE(some.has_value()) << some.error();
    double apart = 0.0;
    double shown = 0.0;
    for (std::size_t i = 0; i < base->size(); ++i) {
      apart = std::max(apart, std::abs((*none)[i] - (*base)[i]));
      shown = std::max(shown, std::abs((*some)[i] - (*base)[i]));
    }
    // two integrations written apart, each at 1e-10 a step of the solver
    EXPECT_LT(apart, 1e-6) << info.name;
    EXPECT_GT(shown, 1e-3) << info.name;
  }
}

TEST(Plan, ItsFirstStudiesAreSpreadAsTheWhole) {
  const auto plan = full_plan();
  std::map<Kind, double> whole;
  std::map<const effects::Effect*, int> of_effect;
  for (std::size_t i = 0; i < plan.size(); ++i) {
    EXPECT_EQ(plan[i].number, i);
    whole[plan[i].kind] += 1.0;
    if (plan[i].kind == Kind::effect) ++of_effect[plan[i].effects.front()];
  }
  for (const auto& [effect, count] : of_effect) EXPECT_GE(count, 60) << effect->name;
  EXPECT_EQ(of_effect.size(), 12U);
  EXPECT_GE(whole[Kind::null], 200.0);
  for (const std::size_t first : {50U, 200U, 800U}) {
    std::map<Kind, double> part;
    for (std::size_t i = 0; i < first; ++i) part[plan[i].kind] += 1.0;
    for (const auto& [kind, count] : whole) {
      const double share = count * static_cast<double>(first) / static_cast<double>(plan.size());
      EXPECT_NEAR(part[kind], share, 1.5) << name_of(kind) << " of the first " << first;
    }
  }
}

class JournalTest : public testing::Test {
 protected:
  void SetUp() override { std::filesystem::remove(file_); }
  void TearDown() override { std::filesystem::remove(file_); }
  static Record record(std::size_t number) {
    Record one;
    one.number = number;
    one.seed = 4;
    one.kind = "effect";
    one.state = "done";
    one.hidden = {"gas"};
    one.verdict = "named";
    one.named = {"gas"};
    one.held_out_after = std::nan("");
    one.place = true;
    return one;
  }
  std::filesystem::path file_ = std::filesystem::path(testing::TempDir()) / "discovery_journal.jsonl";
};

TEST_F(JournalTest, GoesOnWhereARunWasKilled) {
  {
    Journal journal(file_);
    journal.add(record(3));
    journal.add(record(8));
  }
  std::ofstream(file_, std::ios::app) << R"({"number": 9, "seed")";
  {
    Journal journal(file_);
    EXPECT_EQ(journal.records().size(), 2U);
    EXPECT_TRUE(journal.has(3, 4) && journal.has(8, 4));
    EXPECT_FALSE(journal.has(9, 4)) << "it was not written whole";
    EXPECT_FALSE(journal.has(3, 5)) << "another seed";
    journal.add(record(9));
  }
  const Journal journal(file_);
  ASSERT_EQ(journal.records().size(), 3U);
  EXPECT_EQ(json_of(journal.records()[2]), json_of(record(9)));
  EXPECT_TRUE(std::isnan(journal.records()[2].held_out_after));
}

TEST_F(JournalTest, NamesTheLineThatIsNoRecord) {
  std::ofstream(file_) << json_of(record(1)).dump() << "\n{\"number\": 2}\n";
  try {
    const Journal journal(file_);
    FAIL() << "taken for a record";
  } catch (const std::runtime_error& error) {
    EXPECT_NE(std::string(error.what()).find(file_.string() + ":2:"), std::string::npos) << error.what();
  }
}

Record outcome(const char* kind, const char* programme, double wanted, const char* hidden,
               const char* verdict, std::vector<std::string> named) {
  Record one;
  one.kind = kind;
  one.programme = programme;
  one.wanted = wanted;
  if (*hidden != '\0') one.hidden = {hidden};
  one.state = "done";
  one.verdict = verdict;
  one.named = std::move(named);
  return one;
}

std::map<std::string, Rate> by_name(const std::vector<Rate>& rates) {
  std::map<std::string, Rate> all;
  for (const Rate& rate : rates) all[rate.what] = rate;
  return all;
}

TEST(Rates, CountWhatTheySay) {
  std::vector<Record> records{outcome("null", "rich", 0.0, "", "adequate", {}),
                              outcome("null", "poor", 0.0, "", "named", {"gas"}),
                              outcome("effect", "rich", 30.0, "gas", "named", {"gas"}),
                              outcome("effect", "rich", 30.0, "gas", "unknown", {}),
                              outcome("effect", "poor", 5.0, "gas", "named", {"seating"}),
                              outcome("outside", "rich", 5.0, "frame_slack", "unknown", {})};
  records[2].true_amplitudes = {0.02};
  records[2].amplitude = 0.022;
  records[2].lower = 0.021;
  records[2].upper = 0.023;
  records[2].held_out_before = 3.0;
  records[2].held_out_after = std::sqrt(2.0);
  records.push_back(records[2]);
  records.back().state = "out of reach";  // counts nowhere
  std::map<std::string, Rate> rates = by_name(rates_of(records));
  EXPECT_EQ(rates.at("nulls given a name").counted, "1 of 2");
  EXPECT_EQ(rates.at("wrong name, effect in catalogue").counted, "1 of 3");
  EXPECT_EQ(rates.at("right name, rich protocol, signal to noise 30").counted, "1 of 2");
  EXPECT_EQ(rates.at("right name, rich protocol, signal to noise 30").interval, "9.5 to 90.5 %");
  EXPECT_EQ(rates.at("outside the catalogue called unknown, rich protocol").counted, "1 of 1");
  EXPECT_EQ(rates.at("held-out gap closed when named, median").found, "87.5 %") << "(9 - 2)/(9 - 1)";
  EXPECT_EQ(rates.at("its 90 % interval covers the truth").counted, "0 of 1");
  EXPECT_EQ(rates.at("nulls given a name").met, false);
  EXPECT_EQ(rates.at("outside the catalogue called unknown, rich protocol").met, true);
  EXPECT_EQ(rates.at("its 90 % interval covers the truth").met, false);
  EXPECT_EQ(rates.at("its 90 % interval covers the truth").asked, "84 to 96 %");
  EXPECT_EQ(rates.at("two effects at once: both named").met, std::nullopt);
  EXPECT_EQ(rates.at("error of the named amplitude, signal to noise 10 and more, median").found, "10.0 %");
}

TEST(SlumpRates, CountWhatTheySay) {
  std::vector<Record> records{outcome("null", "slump", 0.0, "", "unknown", {}),
                              outcome("effect", "slump", 30.0, "bleeding", "named", {"bleeding"}),
                              outcome("effect", "slump", 5.0, "bleeding", "ambiguous", {}),
                              outcome("effect", "slump", 5.0, "lift_delay", "named", {"bleeding"})};
  records[1].true_amplitudes = {8.0};
  records[1].amplitude = 6.0;
  records[1].place = true;
  records[1].seconds = 700.0;
  records[2].equivalent = {{"lift_delay"}, {"bleeding"}};
  records[2].place = false;
  const auto rates = by_name(slump_rates_of(records));
  EXPECT_EQ(rates.at("nulls given a name").counted, "0 of 1");
  EXPECT_EQ(rates.at("nulls rejected").counted, "1 of 1");
  EXPECT_EQ(rates.at("wrong name").counted, "1 of 3");
  EXPECT_EQ(rates.at("right name").counted, "1 of 3");
  EXPECT_EQ(rates.at("right name, or an ambiguous set that holds it").counted, "2 of 3");
  EXPECT_EQ(rates.at("right name, signal to noise 5").counted, "0 of 2");
  EXPECT_EQ(rates.at("error of the named amplitude, signal to noise 10 and more, median").found, "25.0 %");
  EXPECT_EQ(rates.at("zone ranked first, where the base is rejected").counted, "1 of 2");
  EXPECT_EQ(rates.at("within 10 minutes").counted, "3 of 4");
}

}  // namespace
}  // namespace isotach::bench
