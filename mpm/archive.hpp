// Copyright Isotach contributors. SPDX-License-Identifier: BSD-3-Clause
// The state of a run as bytes, so that it can go on from them as if it had never stopped.
#pragma once

#include <cstddef>
#include <cstdint>
#include <cstring>
#include <string>
#include <string_view>
#include <type_traits>
#include <utility>
#include <vector>

namespace isotach::mpm {

/// Saves to bytes or loads from them what is visited, in the order of the visits: one function does both, so
/// that the two cannot differ. Bytes are those of this machine and this version. Loading from too few bytes
/// leaves the rest as it is and says so.
class Archive {
 public:
  /// To save.
  Archive() = default;
  /// To load.
  explicit Archive(std::string_view bytes) : loading_(true), from_(bytes) {}

  [[nodiscard]] bool loading() const { return loading_; }
  /// What was saved.
  [[nodiscard]] const std::string& bytes() const { return saved_; }
  /// Whether all that was asked for was there, and nothing more.
  [[nodiscard]] bool complete() const { return !short_ && from_.empty(); }

  template <class T>
  void operator()(T& value) {
    if constexpr (std::is_trivially_copyable_v<T>) {
      raw(&value, sizeof value);
    } else {
      value.visit(*this);
    }
  }
  template <class T, class Allocator>
  void operator()(std::vector<T, Allocator>& values) {
    std::uint64_t size = values.size();
    (*this)(size);
    if (loading_) {
      if (short_ || size > from_.size()) {  // every element has a byte at least
        short_ = true;
        return;
      }
      values.resize(size);
    }
    if constexpr (std::is_trivially_copyable_v<T>) {
      (*this)(values.data(), values.size());
    } else {
      for (T& value : values) (*this)(value);
    }
  }
  void operator()(std::string& text) {
    std::uint64_t size = text.size();
    (*this)(size);
    if (loading_) {
      if (short_ || size > from_.size()) {
        short_ = true;
        return;
      }
      text.resize(size);
    }
    (*this)(text.data(), text.size());
  }
  /// Values whose number is known.
  template <class T>
  void operator()(T* values, std::size_t count) {
    static_assert(std::is_trivially_copyable_v<T>);
    raw(values, count * sizeof(T));
  }

 private:
  void raw(void* data, std::size_t size) {
    if (!loading_) {
      saved_.append(static_cast<const char*>(data), size);
    } else if (short_ || size > from_.size()) {
      short_ = true;
    } else if (size > 0) {
      std::memcpy(data, from_.data(), size);
      from_.remove_prefix(size);
    }
  }

  bool loading_ = false;
  bool short_ = false;
  std::string_view from_;
  std::string saved_;
};

}  // namespace isotach::mpm
