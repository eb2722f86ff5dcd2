// Copyright Isotach contributors. SPDX-License-Identifier: BSD-3-Clause
// Stages of an element test: components by name, and the control that each is under.
#include "datasets/element_stages.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <optional>
#include <string>
#include <utility>

namespace isotach::datasets {
namespace {

using integrators::Stage;

constexpr std::array<std::string_view, 6> kComponents{"11", "22", "33", "12", "13", "23"};
constexpr Range kDuration = Range::positive(1e12);  // 30 000 years
constexpr Range kRows{1.0, 100'000.0};
constexpr int kDefaultRows = 100;
constexpr Range kRepeat{1.0, 100'000.0};

/// From a tensor component to that of the Mandel vector.
double mandel_factor(std::size_t component) {
  return component < 3 ? 1.0 : std::numbers::sqrt2;
}

/// Which key each component of a stage was named by; twice is an error.
class Claims {
 public:
  void claim(const TomlTable& table, std::string_view key, std::size_t component, std::string_view by) {
    std::string_view& owner = owners_[component];
    if (!owner.empty()) {
      throw table.error(key, fmt::format("component {} has its {} already", kComponents[component], owner),
                        "each component under one control");
    }
    owner = by;
  }

 private:
  std::array<std::string_view, 6> owners_{};
};

/// Reads the table `key` of components into `take(component, value)`.
template <class Take>
void read_components(TomlTable& stage, std::string_view key, Claims& claims, const Take& take) {
  auto table = stage.table_if(key);
  if (!table) return;
  for (std::size_t i = 0; i < kComponents.size(); ++i) {
    const auto value = table->number_if(kComponents[i], Range{});
    if (!value) continue;
    claims.claim(*table, kComponents[i], i, key);
    take(i, *value);
  }
  table->reject_unknown_keys();
}

/// The normal components that mean_stress names.
std::vector<std::size_t> mean_stress_components(TomlTable& table) {
  constexpr std::string_view kAccepted = "a list of one to three of \"11\", \"22\", \"33\"";
  const auto names = table.texts_if("components", kAccepted);
  if (!names) throw table.error("components", "it is missing", kAccepted);
  if (names->empty()) throw table.error("components", "an empty list", kAccepted);
  std::vector<std::size_t> components;
  for (const std::string& name : *names) {
    const auto found = std::find(kComponents.begin(), kComponents.begin() + 3, name);
    if (found == kComponents.begin() + 3) {
      throw table.error("components", fmt::format("\"{}\" is not one of them", name), kAccepted);
    }
    components.push_back(static_cast<std::size_t>(found - kComponents.begin()));
  }
  return components;
}

/// The components named keep equal stress rates, and with them the mean stress goes its way: with c_1 ... c_k
/// the components, dT_c1/dt - dT_ci/dt = 0 for i > 1, and (dT_11 + dT_22 + dT_33)/dt/3 is prescribed.
void read_mean_stress(TomlTable& stage_table, Claims& claims, Stage& stage) {
  auto table = stage_table.table_if("mean_stress");
  if (!table) return;
  constexpr std::string_view kOne = "either rate_kPa_per_s or kPa";
  const auto rate = table->number_if("rate_kPa_per_s", Range{});
  const auto target = table->number_if("kPa", Range{});
  if (rate.has_value() == target.has_value()) {
    throw table->error(rate ? "kPa" : "rate_kPa_per_s",
                       rate ? "given together with rate_kPa_per_s" : "it is missing", kOne);
  }
  const auto components = mean_stress_components(*table);
  table->reject_unknown_keys();
  for (const std::size_t component : components) claims.claim(*table, "components", component, "mean_stress");

  integrators::Increment<double>& increment = stage.increment;
  const std::size_t first = components.front();
  for (const std::size_t component : components) {
    const auto row = static_cast<Eigen::Index>(component);
    increment.stress_controlled[component] = true;
    increment.condition.row(row).setZero();
    if (component == first) {
      increment.condition.row(row).head<3>().setConstant(1.0 / 3.0);
    } else {
      increment.condition(row, static_cast<Eigen::Index>(first)) = 1.0;
      increment.condition(row, row) = -1.0;
    }
  }
  if (rate) increment.stress_rate[static_cast<Eigen::Index>(first)] = -1e3 * *rate;
  if (target) stage.target[first] = -1e3 * *target;
}

void read_control(TomlTable& table, Stage& stage) {
  constexpr double kPascal = 1e3;  // in a kPa
  Claims claims;
  integrators::Increment<double>& increment = stage.increment;
  const auto index = [](std::size_t component) { return static_cast<Eigen::Index>(component); };
  read_components(table, "strain_rate_per_s", claims, [&](std::size_t i, double value) {
    increment.strain_rate[index(i)] = -mandel_factor(i) * value;
  });
  read_components(table, "strain", claims,
                  [&](std::size_t i, double value) { stage.target[i] = -mandel_factor(i) * value; });
  read_components(table, "stress_rate_kPa_per_s", claims, [&](std::size_t i, double value) {
    increment.stress_controlled[i] = true;
    increment.stress_rate[index(i)] = -kPascal * mandel_factor(i) * value;
  });
  read_components(table, "stress_kPa", claims, [&](std::size_t i, double value) {
    increment.stress_controlled[i] = true;
    stage.target[i] = -kPascal * mandel_factor(i) * value;
  });
  read_mean_stress(table, claims, stage);
  if (auto spin = table.table_if("spin_per_s")) {
    for (std::size_t i = 3; i < 6; ++i) {
      increment.spin[index(i) - 3] = spin->number_if(kComponents[i], Range{}).value_or(0.0);
    }
    spin->reject_unknown_keys();
  }
}

Stage read_stage(TomlTable& table, std::string name) {
  Stage stage;
  stage.name = std::move(name);
  stage.increment.duration = table.number("duration_s", kDuration);
  stage.rows = table.integer_if("rows", kRows).value_or(kDefaultRows);
  if (const auto first = table.number_if("first_row_s", Range{0.0, stage.increment.duration, true, true})) {
    if (stage.rows < 2) {
      throw table.error("first_row_s", fmt::format("given with rows = {}", stage.rows), "at least two rows");
    }
    stage.first_row = *first;
  }
  read_control(table, stage);
  table.reject_unknown_keys();
  return stage;
}

std::string name_of(TomlTable& table, std::size_t number) {
  return table.has("name") ? table.text("name") : fmt::format("stage {}", number);
}

std::vector<Stage> read_level(TomlTable& parent, bool may_repeat) {
  std::vector<Stage> stages;
  std::size_t number = 0;
  for (TomlTable& table : parent.tables("stage")) {
    ++number;
    std::string name = name_of(table, number);
    if (!(may_repeat && (table.has("repeat") || table.has("stage")))) {
      stages.push_back(read_stage(table, std::move(name)));
      continue;
    }
    const int repeat = table.integer_if("repeat", kRepeat).value_or(1);
    const std::vector<Stage> cycle = read_level(table, false);
    if (cycle.empty())
      throw table.error("stage", "it is missing", "[[stage.stage]], once for each part of a cycle");
    table.reject_unknown_keys();
    if (static_cast<long>(cycle.size()) * repeat > kMaxElementStages) {
      throw table.error("repeat", fmt::format("{} times {} stages", repeat, cycle.size()),
                        fmt::format("at most {} stages", kMaxElementStages));
    }
    for (int k = 1; k <= repeat; ++k) {
      for (Stage stage : cycle) {
        stage.name = fmt::format("{} {}: {}", name, k, stage.name);
        stages.push_back(std::move(stage));
      }
    }
  }
  return stages;
}

}  // namespace

std::vector<Stage> read_element_stages(TomlTable& root) {
  std::vector<Stage> stages = read_level(root, true);
  if (stages.empty()) throw root.error("stage", "it is missing", "[[stage]], once for each stage");
  long rows = 0;
  for (const Stage& stage : stages) rows += stage.rows;
  if (rows > kMaxElementRows) {
    throw root.error("stage", fmt::format("{} rows in all", rows),
                     fmt::format("at most {} rows", kMaxElementRows));
  }
  if (static_cast<long>(stages.size()) > kMaxElementStages) {
    throw root.error("stage", fmt::format("{} stages in all", stages.size()),
                     fmt::format("at most {} stages", kMaxElementStages));
  }
  return stages;
}

}  // namespace isotach::datasets
