// Copyright Isotach contributors. SPDX-License-Identifier: BSD-3-Clause
#include "cluster/launch.hpp"

#include <algorithm>
#include <cstdlib>

namespace isotach::cluster {

int launched_together(const Environment& environment) {
  for (const char* name : {"OMPI_COMM_WORLD_SIZE", "PMI_SIZE", "SLURM_STEP_NUM_TASKS"}) {
    if (const char* size = environment(name)) return std::max(1, std::atoi(size));
  }
  return 1;
}

}  // namespace isotach::cluster
