// Copyright Isotach contributors. SPDX-License-Identifier: BSD-3-Clause
#include "bench/discovery/record.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <limits>
#include <stdexcept>

namespace isotach::bench {

namespace {

using nlohmann::ordered_json;

ordered_json or_null(double value) {
  return std::isfinite(value) ? ordered_json(value) : ordered_json(nullptr);
}

double or_nan(const ordered_json& value) {
  return value.is_null() ? std::numeric_limits<double>::quiet_NaN() : value.get<double>();
}

/// Cuts off what follows the last end of a line.
void cut_partial_line(const std::filesystem::path& file) {
  std::ifstream stream(file, std::ios::binary);
  const std::string text{std::istreambuf_iterator<char>(stream), {}};
  const std::size_t end = text.rfind('\n');
  const std::size_t whole = end == std::string::npos ? 0 : end + 1;
  if (whole < text.size()) std::filesystem::resize_file(file, whole);
}

}  // namespace

ordered_json json_of(const Record& r) {
  ordered_json json{{"number", r.number},
                    {"seed", r.seed},
                    {"kind", r.kind},
                    {"hidden", r.hidden},
                    {"programme", r.programme},
                    {"noise", r.noise},
                    {"wanted", r.wanted},
                    {"visibility", or_null(r.visibility)},
                    {"beside", or_null(r.beside)},
                    {"state", r.state},
                    {"why", r.why},
                    {"verdict", r.verdict},
                    {"named", r.named},
                    {"first", r.first},
                    {"equivalent", r.equivalent},
                    {"refused", r.refused},
                    {"p_value", or_null(r.p_value)},
                    {"gap_before", or_null(r.gap_before)},
                    {"gap_after", or_null(r.gap_after)},
                    {"held_out_before", or_null(r.held_out_before)},
                    {"held_out_after", or_null(r.held_out_after)},
                    {"true_amplitudes", r.true_amplitudes},
                    {"amplitude", or_null(r.amplitude)},
                    {"lower", or_null(r.lower)},
                    {"upper", or_null(r.upper)},
                    {"place", nullptr},
                    {"seconds", or_null(r.seconds)}};
  if (r.place) json["place"] = *r.place;
  return json;
}

Record record_of(const ordered_json& json) {
  Record r;
  json.at("number").get_to(r.number);
  json.at("seed").get_to(r.seed);
  json.at("kind").get_to(r.kind);
  json.at("hidden").get_to(r.hidden);
  json.at("programme").get_to(r.programme);
  json.at("noise").get_to(r.noise);
  json.at("wanted").get_to(r.wanted);
  r.visibility = or_nan(json.at("visibility"));
  r.beside = or_nan(json.at("beside"));
  json.at("state").get_to(r.state);
  json.at("why").get_to(r.why);
  json.at("verdict").get_to(r.verdict);
  json.at("named").get_to(r.named);
  json.at("first").get_to(r.first);
  json.at("equivalent").get_to(r.equivalent);
  json.at("refused").get_to(r.refused);
  r.p_value = or_nan(json.at("p_value"));
  r.gap_before = or_nan(json.at("gap_before"));
  r.gap_after = or_nan(json.at("gap_after"));
  r.held_out_before = or_nan(json.at("held_out_before"));
  r.held_out_after = or_nan(json.at("held_out_after"));
  json.at("true_amplitudes").get_to(r.true_amplitudes);
  r.amplitude = or_nan(json.at("amplitude"));
  r.lower = or_nan(json.at("lower"));
  r.upper = or_nan(json.at("upper"));
  if (!json.at("place").is_null()) r.place = json.at("place").get<bool>();
  r.seconds = or_nan(json.at("seconds"));
  return r;
}

Journal::Journal(const std::filesystem::path& file) {
  if (std::filesystem::exists(file)) {
    cut_partial_line(file);
    std::ifstream stream(file);
    std::string line;
    for (std::size_t number = 1; std::getline(stream, line); ++number) {
      try {
        records_.push_back(record_of(ordered_json::parse(line)));
      } catch (const ordered_json::exception& error) {
        throw std::runtime_error(fmt::format("{}:{}: {}", file.string(), number, error.what()));
      }
    }
  }
  stream_.open(file, std::ios::app);
  if (!stream_) throw std::runtime_error("cannot write " + file.string());
}

std::vector<Record> Journal::of(std::uint64_t seed) const {
  std::vector<Record> found;
  for (const Record& record : records_) {
    if (record.seed == seed) found.push_back(record);
  }
  std::sort(found.begin(), found.end(), [](const Record& a, const Record& b) { return a.number < b.number; });
  return found;
}

bool Journal::has(std::size_t number, std::uint64_t seed) const {
  const std::lock_guard lock(mutex_);
  return std::any_of(records_.begin(), records_.end(),
                     [&](const Record& one) { return one.number == number && one.seed == seed; });
}

void Journal::add(const Record& record) {
  const std::lock_guard lock(mutex_);
  stream_ << json_of(record).dump() << std::endl;
  if (!stream_) throw std::runtime_error("the journal cannot be written");
  records_.push_back(record);
}

}  // namespace isotach::bench
