// Copyright Isotach contributors. SPDX-License-Identifier: BSD-3-Clause
// What a laboratory's file says of the specimen: choosing the test.
#include "datasets/specimen.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>

namespace isotach::datasets {
namespace {

constexpr std::size_t kListed = 20;  // tests that a message names

std::optional<double> number_of(std::string_view text) {
  double value = 0.0;
  const char* const end = text.data() + text.size();
  const auto [stop, error] = std::from_chars(text.data(), end, value);
  if (stop != end || error != std::errc{}) return std::nullopt;
  return value;
}

bool fits(const Selection& test, const Selection& wanted) {
  return std::all_of(wanted.begin(), wanted.end(), [&](const auto& want) {
    const auto found =
        std::find_if(test.begin(), test.end(), [&](const auto& have) { return have.first == want.first; });
    return found != test.end() && same_value(found->second, want.second);
  });
}

std::string list_of(const std::vector<Selection>& tests) {
  std::string list;
  for (std::size_t i = 0; i < std::min(tests.size(), kListed); ++i) {
    list += (i == 0 ? "" : ", ") + words_of(tests[i]);
  }
  if (tests.size() > kListed) list += fmt::format(" and {} more", tests.size() - kListed);
  return list;
}

}  // namespace

bool same_value(std::string_view cell, std::string_view wanted) {
  if (cell == wanted) return true;
  const auto have = number_of(cell);
  const auto want = number_of(wanted);
  return have && want && *have == *want;
}

std::string words_of(const Selection& selection) {
  std::string words;
  for (const auto& [heading, value] : selection) {
    const std::string_view quote = number_of(value) ? "" : "\"";
    words += fmt::format("{}{} = {}{}{}", words.empty() ? "" : ", ", heading, quote, value, quote);
  }
  return "{ " + words + " }";
}

SelectedTest select_test(const std::vector<Selection>& tests, const Selection& wanted) {
  std::vector<std::size_t> found;
  for (std::size_t i = 0; i < tests.size(); ++i) {
    if (fits(tests[i], wanted)) found.push_back(i);
  }
  if (found.size() == 1) return {found.front(), ""};
  const std::string there_are = fmt::format("the file holds {}", list_of(tests));
  if (wanted.empty())
    return {std::nullopt, fmt::format("{} tests and none is selected; {}", tests.size(), there_are)};
  if (found.empty()) return {std::nullopt, fmt::format("{} fits no test; {}", words_of(wanted), there_are)};
  return {std::nullopt, fmt::format("{} fits {} tests; {}", words_of(wanted), found.size(), there_are)};
}

}  // namespace isotach::datasets
