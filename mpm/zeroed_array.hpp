// Copyright Isotach contributors. SPDX-License-Identifier: BSD-3-Clause
// Large arrays of which only parts are ever used.
#pragma once

#include <cstddef>
#include <cstdlib>
#include <memory>
#include <new>
#include <type_traits>

namespace isotach::mpm {

/// An array of zeros. Memory comes from calloc, so that pages nothing writes to take no room: a grid is much
/// larger than the mud on it.
template <class T>
class ZeroedArray {
  static_assert(std::is_trivially_copyable_v<T>);

 public:
  explicit ZeroedArray(std::size_t size) : size_(size) {
    const std::size_t bytes = size * sizeof(T) + kAlignment;
    memory_.reset(std::calloc(bytes, 1));
    void* start = memory_.get();
    std::size_t room = bytes;
    if (start == nullptr || std::align(kAlignment, size * sizeof(T), start, room) == nullptr) {
      throw std::bad_alloc();
    }
    data_ = static_cast<T*>(start);
  }

  [[nodiscard]] std::size_t size() const { return size_; }
  [[nodiscard]] T* data() { return data_; }
  [[nodiscard]] const T* data() const { return data_; }
  [[nodiscard]] T& operator[](std::size_t k) { return data_[k]; }
  [[nodiscard]] const T& operator[](std::size_t k) const { return data_[k]; }

 private:
  static constexpr std::size_t kAlignment = 64;
  struct Free {
    void operator()(void* memory) const { std::free(memory); }
  };
  std::unique_ptr<void, Free> memory_;
  std::size_t size_;
  T* data_ = nullptr;
};

}  // namespace isotach::mpm
