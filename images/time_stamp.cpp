// Copyright Isotach contributors. SPDX-License-Identifier: BSD-3-Clause
#include "images/time_stamp.hpp"

#include <fmt/format.h>

#include <charconv>
#include <cmath>
#include <cstddef>
#include <regex>

#include "datasets/input_error.hpp"

namespace isotach::images {
namespace {

using datasets::FilePlace;
using datasets::InputError;

constexpr const char* kSeconds = R"((?:^|[^0-9.])([0-9]+(?:\.[0-9]+)?) ?s(?![A-Za-z]))";
constexpr const char* kLastNumber = R"(([0-9]+)[^0-9]*$)";

std::string pattern_of(const TimeRule& rule) {
  return rule.pattern.value_or(rule.frames_per_second ? kLastNumber : kSeconds);
}

std::regex expression_of(const std::string& pattern, const std::filesystem::path& file) {
  constexpr const char* kAccepted = "a regular expression (ECMAScript) with a group, as \"t([0-9.]+)\"";
  try {
    std::regex expression(pattern);
    if (expression.mark_count() > 0) return expression;
  } catch (const std::regex_error& error) {
    throw InputError(FilePlace{file}, "--time-pattern", fmt::format("\"{}\": {}", pattern, error.what()),
                     kAccepted);
  }
  throw InputError(FilePlace{file}, "--time-pattern", fmt::format("\"{}\" has no group", pattern), kAccepted);
}

double number_in_name(const std::filesystem::path& file, const std::string& pattern,
                      const std::regex& expression) {
  const std::string name = file.stem().string();
  std::smatch match;
  if (!std::regex_search(name, match, expression)) {
    throw InputError(
        FilePlace{file}, "time in the file's name", fmt::format("\"{}\"", name),
        fmt::format("a name that holds \"{}\" (see --time-pattern and --frames-per-second)", pattern));
  }
  const std::string text = match[1].str();
  double number = 0.0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), number);
  if (error != std::errc() || end != text.data() + text.size() || !std::isfinite(number)) {
    throw InputError(FilePlace{file}, "time in the file's name", fmt::format("\"{}\"", text), "a number");
  }
  return number;
}

}  // namespace

std::vector<double> time_stamps(const std::vector<std::filesystem::path>& files, const TimeRule& rule) {
  if (files.empty()) return {};
  const std::string pattern = pattern_of(rule);
  const std::regex expression = expression_of(pattern, files.front());
  std::vector<double> times;
  for (std::size_t i = 0; i < files.size(); ++i) {
    const double number = number_in_name(files[i], pattern, expression);
    const double time = (number - rule.start) / rule.frames_per_second.value_or(1.0);
    if (!(time > 0.0)) {
      throw InputError(FilePlace{files[i]}, "time",
                       fmt::format("{} s after the start at {}{}", time,
                                   rule.frames_per_second ? "frame " : "", rule.start),
                       "> 0, after the mould began to rise");
    }
    for (std::size_t k = 0; k < i; ++k) {
      if (times[k] == time) {
        throw InputError(FilePlace{files[i]}, "time",
                         fmt::format("{} s, as of {}", time, files[k].filename().string()),
                         "another time for each picture");
      }
    }
    times.push_back(time);
  }
  return times;
}

}  // namespace isotach::images
