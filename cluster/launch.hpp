// Copyright Isotach contributors. SPDX-License-Identifier: BSD-3-Clause
// Whether a launcher of MPI started this process together with others.
#pragma once

#include <functional>

namespace isotach::cluster {

/// Value of an environment variable; null where it is not set. As std::getenv.
using Environment = std::function<const char*(const char* name)>;

/// Number of processes that were started together with this one, itself among them, as told by the first of
/// these variables that is set:
/// - OMPI_COMM_WORLD_SIZE: Open MPI's mpirun
/// - PMI_SIZE: srun --mpi=pmi2, and other MPIs' mpirun
/// - SLURM_STEP_NUM_TASKS: srun, by whatever interface (in a job script outside of srun it is not set, unlike
///   SLURM_NTASKS)
///
/// 1 where none is, so that MPI need not be asked, which takes some tenths of a second.
[[nodiscard]] int launched_together(const Environment& environment);

}  // namespace isotach::cluster
