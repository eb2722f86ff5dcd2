// Copyright Isotach contributors. SPDX-License-Identifier: BSD-3-Clause
// The processes that were started together, and messages between them: all that is used of MPI.
#pragma once

#include <optional>
#include <stdexcept>
#include <string>
#include <string_view>

namespace isotach::cluster {

/// What a message is.
enum class Tag : int {
  simulate,  ///< to a serving rank: a simulation asked for
  done,      ///< from it: how it ended
  stop,      ///< to it: end what is being simulated, as interrupted
  leave      ///< to it: end, with this exit code
};

struct Message {
  int from;  ///< rank
  Tag tag;
  std::string bytes;
};

/// Processes that cannot work together. Thrown on every rank; for rank 0 to tell.
class LaunchError : public std::runtime_error {
 public:
  LaunchError(const std::string& what, int rank) : std::runtime_error(what), rank_(rank) {}
  [[nodiscard]] int rank() const { return rank_; }

 private:
  int rank_;
};

/// This process among those started together. Where it was started alone MPI is neither asked nor begun. At
/// most one in a program. An error of MPI, as the death of a process, ends all of them: MPI's default.
class Ranks {
 public:
  /// Begins MPI, if there is more than one process, and waits for all. `code` tells versions of the program
  /// apart: LaunchError where it is not the same on every rank, or where the launcher started processes that
  /// this MPI does not find.
  explicit Ranks(std::string_view code);
  /// Ends MPI, once all are here.
  ~Ranks();
  Ranks(const Ranks&) = delete;
  Ranks& operator=(const Ranks&) = delete;

  [[nodiscard]] int rank() const { return rank_; }
  [[nodiscard]] int size() const { return size_; }

  /// Messages between two ranks arrive in the order in which they were sent. No two threads may call send()
  /// and receive() at once.
  void send(int rank, Tag tag, std::string_view bytes) const;
  /// A message that has arrived, from any rank; does not wait.
  [[nodiscard]] std::optional<Message> receive() const;

 private:
  int rank_ = 0;
  int size_ = 1;
};

}  // namespace isotach::cluster
