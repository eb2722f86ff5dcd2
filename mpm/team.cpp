// Copyright Isotach contributors. SPDX-License-Identifier: BSD-3-Clause
#include "mpm/team.hpp"

namespace isotach::mpm {

namespace {

// Rounds follow each other within microseconds; sleeping and being woken would cost as much.
constexpr int kSpins = 2000;

template <class Ready>
bool spin_until(Ready&& ready) {
  for (int n = 0; n < kSpins; ++n) {
    if (ready()) return true;
#if defined(__x86_64__)
    __builtin_ia32_pause();
#endif
  }
  return ready();
}

}  // namespace

Team::Team(int threads) {
  for (int k = 1; k < threads; ++k) helpers_.emplace_back([this, k] { help(k); });
}

Team::~Team() {
  ending_.store(true);
  round_.fetch_add(1);
  round_.notify_all();
  for (std::thread& helper : helpers_) helper.join();
}

void Team::run_on_all(const std::function<void(int)>& work) {
  work_ = &work;
  busy_.store(static_cast<int>(helpers_.size()), std::memory_order_relaxed);
  round_.fetch_add(1, std::memory_order_release);
  round_.notify_all();
  work(0);
  while (!spin_until([this] { return busy_.load(std::memory_order_acquire) == 0; })) {
    if (const int left = busy_.load(std::memory_order_acquire); left != 0) busy_.wait(left);
  }
}

void Team::help(int index) {
  unsigned seen = 0;
  while (true) {
    while (!spin_until([&] { return round_.load(std::memory_order_acquire) != seen; })) round_.wait(seen);
    seen = round_.load(std::memory_order_acquire);
    if (ending_.load()) return;
    (*work_)(index);
    if (busy_.fetch_sub(1, std::memory_order_acq_rel) == 1) busy_.notify_one();
  }
}

}  // namespace isotach::mpm
