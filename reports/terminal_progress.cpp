// Copyright Isotach contributors. SPDX-License-Identifier: BSD-3-Clause
// The progress line: throttling, time left, rewriting.
#include "reports/terminal_progress.hpp"

#include <fmt/format.h>
#include <sys/ioctl.h>
#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdlib>
#include <iostream>
#include <utility>

#include "reports/number.hpp"

namespace isotach::reports {
namespace {

constexpr double kTerminalInterval = 0.2;  // s
constexpr double kPlainInterval = 10.0;    // s
// Before this the time left is a guess that would only jump about.
constexpr double kLeastElapsed = 1.0;  // s
constexpr double kLeastFraction = 0.005;

ProgressOutput standard_error(bool quiet) {
  const char* kind = std::getenv("TERM");
  const bool terminal = isatty(STDERR_FILENO) == 1 && kind != nullptr && std::string_view(kind) != "dumb";
  winsize size{};
  const bool known = terminal && ioctl(STDERR_FILENO, TIOCGWINSZ, &size) == 0 && size.ws_col > 0;
  return {quiet ? nullptr : &std::cerr, terminal, known ? size.ws_col : 80, [] {
            return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count();
          }};
}

/// Whole seconds at least: tenths of a running clock are noise.
std::string whole_seconds(double seconds) {
  return seconds < 10.0 ? fmt::format("{:.0f} s", seconds) : format_duration(seconds);
}

/// The first `count` characters of UTF-8 text: a line that wraps could not be rewritten.
std::string_view cut(std::string_view text, int count) {
  std::size_t i = 0;
  for (; i < text.size(); ++i) {
    const bool first_byte = (static_cast<unsigned char>(text[i]) & 0xC0U) != 0x80U;
    if (first_byte && count-- == 0) break;
  }
  return text.substr(0, i);
}

}  // namespace

Progress::Progress(std::string label, bool quiet) : Progress(std::move(label), standard_error(quiet)) {}

Progress::Progress(std::string label, ProgressOutput output)
    : label_(std::move(label)), output_(std::move(output)) {
  start_ = latest_ = output_.clock();
}

Progress::~Progress() {
  if (shown_ && !finished_ && output_.terminal) *output_.stream << std::endl;
}

void Progress::update(double fraction, std::string_view text) {
  if (output_.stream == nullptr) return;
  const std::lock_guard lock(mutex_);
  const double now = output_.clock();
  const bool due = now - latest_ >= (output_.terminal ? kTerminalInterval : kPlainInterval);
  // A terminal shows life at once; a log gets no line for work that takes less than an interval.
  if (finished_ || !(due || (output_.terminal && !shown_))) return;
  latest_ = now;

  const double elapsed = now - start_;
  std::string line = label_;
  std::string left;
  if (std::isfinite(fraction)) {
    fraction = std::clamp(fraction, 0.0, 1.0);
    line += fmt::format("  {:3.0f} %", std::floor(100.0 * fraction));
    if (elapsed >= kLeastElapsed && fraction >= kLeastFraction) {
      left = fmt::format(", about {} left", whole_seconds(std::ceil(elapsed * (1.0 - fraction) / fraction)));
    }
  }
  if (!text.empty()) line += fmt::format("  {}", text);
  show(line + fmt::format("  ({}{})", whole_seconds(elapsed), left));
}

void Progress::finish() {
  if (output_.stream == nullptr) return;
  const std::lock_guard lock(mutex_);
  if (finished_) return;
  finished_ = true;
  if (!shown_) return;
  show(fmt::format("{}  done in {}", label_, format_duration(output_.clock() - start_)));
  if (output_.terminal) *output_.stream << std::endl;
}

void Progress::show(const std::string& line) {
  shown_ = true;
  if (output_.terminal) {
    *output_.stream << "\r" << cut(line, output_.columns - 1) << "\x1b[K" << std::flush;
  } else {
    *output_.stream << line << std::endl;
  }
}

}  // namespace isotach::reports
