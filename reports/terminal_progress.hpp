// Copyright Isotach contributors. SPDX-License-Identifier: BSD-3-Clause
// Progress of long work on standard error, with the time left.
#pragma once

#include <functional>
#include <mutex>
#include <ostream>
#include <string>
#include <string_view>

namespace isotach::reports {

/// Where progress is shown. The defaults of Progress(label, quiet) are standard error and the steady clock.
struct ProgressOutput {
  std::ostream* stream;  ///< null: nothing is shown
  bool terminal;         ///< one line rewritten, at most five times a second; else one line every 10 s
  int columns;           ///< width of the terminal, to which the line is cut
  std::function<double()> clock;  ///< seconds since any fixed moment, never going back
};

/// Shows "label  42 %  text  (12 s, about 17 s left)" while work is under way. All members may be called from
/// several threads at once; updates in between are dropped, so they may come as often as one likes.
class Progress {
 public:
  Progress(std::string label, bool quiet);
  Progress(std::string label, ProgressOutput output);
  /// Ends the line without a word where finish() was not called, as on an exception.
  ~Progress();
  Progress(const Progress&) = delete;
  Progress& operator=(const Progress&) = delete;

  /// Work done, 0 to 1 (clamped; not finite where unknown, which shows neither percentage nor time left), and
  /// what is being done now (may be empty).
  void update(double fraction, std::string_view text = {});
  /// Says that the work is done, and how long it took; on anything but a terminal only if a line came before.
  void finish();

 private:
  void show(const std::string& line);

  std::mutex mutex_;
  std::string label_;
  ProgressOutput output_;
  double start_ = 0.0;   // s
  double latest_ = 0.0;  // s, of the latest line
  bool shown_ = false;
  bool finished_ = false;
};

}  // namespace isotach::reports
