// Copyright Isotach contributors. SPDX-License-Identifier: BSD-3-Clause
#include "mpm/point_array.hpp"

#include <sys/mman.h>

#include <cstdint>
#include <cstdlib>
#include <new>

namespace isotach::mpm {

namespace {

constexpr std::size_t kLine = 64;
constexpr std::size_t kLargePage = std::size_t{1} << 21U;

std::size_t round_up(std::size_t bytes, std::size_t unit) {
  return (bytes + unit - 1) / unit * unit;
}

/// Pages of their own, whose start is that of a large page.
void* map_pages(std::size_t bytes) {
  const std::size_t room = bytes + kLargePage;
  void* const mapped = mmap(nullptr, room, PROT_READ | PROT_WRITE, MAP_PRIVATE | MAP_ANONYMOUS, -1, 0);
  if (mapped == MAP_FAILED) throw std::bad_alloc();
  const auto from = reinterpret_cast<std::uintptr_t>(mapped);
  const std::size_t before = round_up(from, kLargePage) - from;
  auto* const start = static_cast<std::byte*>(mapped) + before;
  if (before > 0) munmap(mapped, before);
  if (before < kLargePage) munmap(start + bytes, kLargePage - before);
  // Whole large pages only: the rest of a last one would be room that nothing uses. A system that has none
  // refuses, and nothing is lost.
  madvise(start, bytes / kLargePage * kLargePage, MADV_HUGEPAGE);
  return start;
}

std::size_t mapped_size(std::size_t bytes) {
  return round_up(bytes, std::size_t{1} << 16U);
}

}  // namespace

void* allocate_points(std::size_t bytes) {
  if (bytes >= kLargePage) return map_pages(mapped_size(bytes));
  void* const memory = std::aligned_alloc(kLine, round_up(bytes, kLine));
  if (memory == nullptr) throw std::bad_alloc();
  return memory;
}

void free_points(void* memory, std::size_t bytes) noexcept {
  if (bytes >= kLargePage) {
    munmap(memory, mapped_size(bytes));
  } else {
    std::free(memory);
  }
}

}  // namespace isotach::mpm
