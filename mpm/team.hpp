// Copyright Isotach contributors. SPDX-License-Identifier: BSD-3-Clause
// Threads that stay, for work that is handed out many thousand times a second.
#pragma once

#include <atomic>
#include <functional>
#include <thread>
#include <vector>

namespace isotach::mpm {

/// A fixed number of threads, the caller's among them. One thread makes a team of none: work is then a call.
class Team {
 public:
  explicit Team(int threads);
  ~Team();
  Team(const Team&) = delete;
  Team& operator=(const Team&) = delete;

  [[nodiscard]] int size() const { return static_cast<int>(helpers_.size()) + 1; }

  /// Calls work(k) for k = 0 .. size() - 1, each on a thread of its own, and returns when all have. The work
  /// must not throw.
  template <class Work>
  void run(Work&& work) {
    if (helpers_.empty()) {
      work(0);
      return;
    }
    const std::function<void(int)> call = [&work](int k) { work(k); };
    run_on_all(call);
  }

 private:
  void run_on_all(const std::function<void(int)>& work);
  void help(int index);

  std::vector<std::thread> helpers_;
  const std::function<void(int)>* work_ = nullptr;
  std::atomic<unsigned> round_ = 0;
  std::atomic<int> busy_ = 0;
  std::atomic<bool> ending_ = false;
};

}  // namespace isotach::mpm
