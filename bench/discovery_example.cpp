// Copyright Isotach contributors. SPDX-License-Identifier: BSD-3-Clause
// Makes the worked example of docs/discovery.md: discovery_example FOLDER. Two tests in which a frame that
// gives is hidden; what discovery makes of them; the test that it asks for, made of the same mud; and what it
// makes of all three. FOLDER has first.toml, which lists two tests, and second.toml, which lists three.
#include <fmt/format.h>

#include "bench/example_test.hpp"
#include "discovery/discover.hpp"
#include "effects/apparatus_compliance.hpp"

namespace {

using namespace isotach;

constexpr double kCompliance = 1.5e-9;  // m/Pa

datasets::OedometerTest test_of(const std::string& name, double rate) {
  bench::ExampleTest test(name, 0.02);
  test.ramp(0.10, rate, 40);
  test.ramp(0.20, 5.0 * rate, 40);
  return test.test();
}

discovery::Discovery discover(const std::filesystem::path& file) {
  auto found = discovery::discover_oedometer(datasets::read_study(file), {});
  if (!found) throw std::runtime_error(found.error().message);
  fmt::print("{}: {}", file.filename().string(), name_of(found->verdict));
  for (const auto& trial : found->trials) {
    fmt::print("; {} BIC {:.1f}", name_of(trial.candidate), trial.candidate.bic);
  }
  fmt::print("\n");
  return std::move(*found);
}

}  // namespace

int main(int count, char** arguments) {
  if (count != 2) {
    fmt::print(stderr, "usage: discovery_example FOLDER\n");
    return 2;
  }
  const std::filesystem::path folder(arguments[1]);
  const auto effects = *effects::Values<double>::create(
      {effects::with_amplitude(effects::apparatus_compliance::kEffect, kCompliance)});
  const std::string comment = "synthetic: a frame that gives by 1.5e-6 m/kPa, noise of 0.5 % of stress";
  std::mt19937_64 random(1);
  try {
    const std::vector<datasets::OedometerTest> tests{test_of("slow", 1e-6), test_of("fast", 5e-6)};
    for (const auto& test : tests) {
      bench::write_readings(folder / (test.name + ".csv"), comment, test, effects, random);
    }
    const discovery::Discovery first = discover(folder / "first.toml");
    if (!first.next) throw std::runtime_error("no next test");
    fmt::print("next test: {} {}: {:.1f}, repeated {:.1f}\n", first.next->test, first.next->change,
               first.next->separation, first.next->now);
    for (const auto& test : tests) {
      if (test.name != first.next->test) continue;
      bench::write_readings(folder / "next.csv", comment, *discovery::varied(test, first.next->change),
                            effects, random);
    }
    discover(folder / "second.toml");
  } catch (const std::exception& error) {
    fmt::print(stderr, "{}\n", error.what());
    return 1;
  }
  return 0;
}
