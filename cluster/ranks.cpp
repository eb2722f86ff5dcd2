// Copyright Isotach contributors. SPDX-License-Identifier: BSD-3-Clause
#include "cluster/ranks.hpp"

#include <fmt/format.h>
#include <mpi.h>

#include <array>
#include <cstdint>
#include <cstdlib>
#include <functional>

#include "cluster/launch.hpp"

namespace isotach::cluster {

namespace {

/// Whether the number is the same on every rank: the least of it is, and the least of its complement.
bool same_everywhere(std::uint64_t number) {
  const std::array<std::uint64_t, 2> own{number, ~number};
  std::array<std::uint64_t, 2> least{};
  MPI_Allreduce(own.data(), least.data(), 2, MPI_UINT64_T, MPI_MIN, MPI_COMM_WORLD);
  return least[0] == ~least[1];
}

}  // namespace

Ranks::Ranks(std::string_view code) {
  const int launched = launched_together(std::getenv);
  if (launched == 1) return;
  int provided = MPI_THREAD_SINGLE;
  MPI_Init_thread(nullptr, nullptr, MPI_THREAD_SERIALIZED, &provided);
  MPI_Comm_rank(MPI_COMM_WORLD, &rank_);
  MPI_Comm_size(MPI_COMM_WORLD, &size_);
  std::string trouble;
  if (size_ != launched) {
    trouble = fmt::format(
        "{} processes were started together, but MPI finds {}: they need the mpirun, or "
        "the srun --mpi, of the MPI that isotach was built with",
        launched, size_);
  } else if (provided < MPI_THREAD_SERIALIZED) {
    trouble = "this MPI does not let threads take turns (MPI_THREAD_SERIALIZED)";
  } else if (!same_everywhere(std::hash<std::string_view>()(code))) {
    trouble = "the processes started together are of different versions of isotach";
  }
  if (trouble.empty()) return;
  MPI_Finalize();
  throw LaunchError(trouble, rank_);
}

Ranks::~Ranks() {
  if (size_ > 1) MPI_Finalize();
}

void Ranks::send(int rank, Tag tag, std::string_view bytes) const {
  MPI_Send(bytes.data(), static_cast<int>(bytes.size()), MPI_BYTE, rank, static_cast<int>(tag),
           MPI_COMM_WORLD);
}

std::optional<Message> Ranks::receive() const {
  int arrived = 0;
  MPI_Message handle = MPI_MESSAGE_NULL;
  MPI_Status status;
  MPI_Improbe(MPI_ANY_SOURCE, MPI_ANY_TAG, MPI_COMM_WORLD, &arrived, &handle, &status);
  if (arrived == 0) return std::nullopt;
  int size = 0;
  MPI_Get_count(&status, MPI_BYTE, &size);
  Message message{status.MPI_SOURCE, static_cast<Tag>(status.MPI_TAG),
                  std::string(static_cast<std::size_t>(size), '\0')};
  MPI_Mrecv(message.bytes.data(), size, MPI_BYTE, &handle, MPI_STATUS_IGNORE);
  return message;
}

}  // namespace isotach::cluster
