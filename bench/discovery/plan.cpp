// Copyright Isotach contributors. SPDX-License-Identifier: BSD-3-Clause
#include "bench/discovery/plan.hpp"

#include <algorithm>
#include <random>

#include "bench/synthetic_oedometer.hpp"
#include "effects/catalogue.hpp"

namespace isotach::bench {

namespace {

constexpr std::array kProgrammes{Programme::poor, Programme::rich};

/// Fisher and Yates's; std::shuffle is not the same on every platform.
void shuffle(std::vector<Case>& cases, std::mt19937_64& random) {
  for (std::size_t i = cases.size(); i > 1; --i) {
    std::swap(cases[i - 1], cases[static_cast<std::size_t>(uniform(random) * static_cast<double>(i))]);
  }
}

std::vector<const effects::Effect*> oedometer_effects() {
  std::vector<const effects::Effect*> all;
  for (const effects::Effect* effect : effects::catalogue()) {
    if (effect->test == effects::TestKind::oedometer) all.push_back(effect);
  }
  return all;
}

/// `each` copies of a case in all cells.
void add_cells(std::vector<Case>& cases, const Case& model, int each, bool visible = true) {
  for (const Programme programme : kProgrammes) {
    for (const double noise : kNoiseLevels) {
      for (const double visibility : kVisibilities) {
        if (!visible && visibility != kVisibilities.front()) continue;
        for (int k = 0; k < each; ++k) {
          cases.push_back(model);
          cases.back().programme = programme;
          cases.back().noise = noise;
          cases.back().visibility = visible ? visibility : 0.0;
        }
      }
    }
  }
}

}  // namespace

std::string_view name_of(Kind kind) {
  switch (kind) {
    case Kind::null:
      return "null";
    case Kind::effect:
      return "effect";
    case Kind::outside:
      return "outside";
    case Kind::deleted:
      return "deleted";
    case Kind::pair:
      return "pair";
  }
  return "";
}

std::vector<Case> full_plan() {
  const auto catalogue = oedometer_effects();
  std::vector<std::vector<Case>> groups(5);
  const Case blank{0, Kind::null, {}, {}, Programme::poor, 0.0, 0.0};
  add_cells(groups[0], blank, 34, false);
  for (const effects::Effect* effect : catalogue) {
    Case one = blank;
    one.effects = {effect};
    one.kind = Kind::effect;
    add_cells(groups[1], one, 4);
    one.kind = Kind::deleted;
    add_cells(groups[2], one, 1);
  }
  for (const OutsideInfo& info : outside_effects()) {
    Case one = blank;
    one.kind = Kind::outside;
    one.outside = info.kind;
    add_cells(groups[3], one, 2);
  }
  std::mt19937_64 random(20);
  for (int k = 0; k < 48; ++k) {
    const auto pick = [&](std::size_t count) {
      return static_cast<std::size_t>(uniform(random) * static_cast<double>(count));
    };
    Case one = blank;
    one.kind = Kind::pair;
    one.programme = Programme::rich;
    one.noise = kNoiseLevels[static_cast<std::size_t>(k) % 3];
    one.visibility = kVisibilities[1 + static_cast<std::size_t>(k / 3) % 2];
    const std::size_t a = pick(catalogue.size());
    const std::size_t b = (a + 1 + pick(catalogue.size() - 1)) % catalogue.size();
    one.effects = {catalogue[std::min(a, b)], catalogue[std::max(a, b)]};
    groups[4].push_back(one);
  }

  struct Placed {
    double at;
    Case one;
  };
  std::vector<Placed> all;
  for (auto& group : groups) {
    shuffle(group, random);
    for (std::size_t i = 0; i < group.size(); ++i) {
      all.push_back({(static_cast<double>(i) + 0.5) / static_cast<double>(group.size()), group[i]});
    }
  }
  std::stable_sort(all.begin(), all.end(), [](const Placed& a, const Placed& b) { return a.at < b.at; });
  std::vector<Case> plan;
  for (Placed& placed : all) {
    placed.one.number = plan.size();
    plan.push_back(std::move(placed.one));
  }
  return plan;
}

}  // namespace isotach::bench
