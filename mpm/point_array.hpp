// Copyright Isotach contributors. SPDX-License-Identifier: BSD-3-Clause
// The storage of one quantity of all material points.
#pragma once

#include <cstddef>
#include <vector>

namespace isotach::mpm {

/// Memory aligned to a line of the cache and, where there is much of it, in large pages if the system has
/// them: a step streams through some thirty arrays at a time.
/// @throws std::bad_alloc
[[nodiscard]] void* allocate_points(std::size_t bytes);
void free_points(void* memory, std::size_t bytes) noexcept;

/// The allocator of a PointArray.
template <class T>
struct PointAllocator {
  using value_type = T;
  PointAllocator() = default;
  template <class U>
  PointAllocator(const PointAllocator<U>& /*other*/) noexcept {}  // NOLINT(*-explicit-*): as allocators are
  [[nodiscard]] T* allocate(std::size_t n) { return static_cast<T*>(allocate_points(n * sizeof(T))); }
  void deallocate(T* memory, std::size_t n) noexcept { free_points(memory, n * sizeof(T)); }
  friend bool operator==(const PointAllocator& /*a*/, const PointAllocator& /*b*/) { return true; }
};

/// One quantity of all points. Aligned, so that a pack of points never lies across two lines of the cache.
using PointArray = std::vector<double, PointAllocator<double>>;

}  // namespace isotach::mpm
