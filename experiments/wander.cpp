// Copyright Isotach contributors. SPDX-License-Identifier: BSD-3-Clause
#include "experiments/wander.hpp"

#include <cstddef>

namespace isotach::experiments {

namespace {

// In the order of Slot. Sizes: p_B and readings of stress to a tenth; slopes by a third; rates by an e-fold.
constexpr std::array kInfo{
    SlotInfo{"preconsolidation_pressure", "ln of the preconsolidation pressure", true, 0.1},
    SlotInfo{"lambda", "ln of lambda", true, 0.3},
    SlotInfo{"kappa", "ln of kappa", true, 0.3},
    SlotInfo{"I_v", "ln of I_v", true, 0.3},
    SlotInfo{"D_r", "ln of D_r", true, 1.0},
    SlotInfo{"stress_reading", "ln of the stress read over the stress there is", true, 0.1},
    SlotInfo{"strain_reading", "the strain read less the specimen's", false, 0.005},
};
static_assert(kInfo.size() == kSlots.size());

}  // namespace

const SlotInfo& info_of(Slot slot) {
  return kInfo[static_cast<std::size_t>(slot)];
}

}  // namespace isotach::experiments
