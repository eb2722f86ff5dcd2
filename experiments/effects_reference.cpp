// Copyright Isotach contributors. SPDX-License-Identifier: BSD-3-Clause
#include "experiments/effects_reference.hpp"

#include <algorithm>
#include <memory>
#include <type_traits>

#include "integrators/cvode_solver.hpp"

namespace isotach::experiments::detail {

namespace {

template <class T, class Free>
std::unique_ptr<std::remove_pointer_t<T>, Free> owned(T pointer, Free free, const char* call) {
  integrators::require_cvode(pointer != nullptr, call);
  return {pointer, free};
}

// A positive return value tells CVODES to try again with a smaller step.
int right_hand_side(double time, N_Vector y, N_Vector dy, void* system) {
  const auto& rate = static_cast<const PlainSystem*>(system)->rate;
  return rate(time, N_VGetArrayPointer(y), N_VGetArrayPointer(dy)) ? 0 : 1;
}

}  // namespace

bool solve_plain_system(const PlainSystem& system, double duration, std::vector<double>& y) {
  using integrators::require_cvode;
  constexpr double kRelative = 1e-10;
  constexpr long kMostSteps = 1'000'000;
  const auto size = static_cast<sunindextype>(y.size());
  SUNContext raw = nullptr;
  require_cvode(SUNContext_Create(nullptr, &raw) == 0, "SUNContext_Create");
  const auto context = owned(
      raw, [](SUNContext c) { SUNContext_Free(&c); }, "SUNContext_Create");
  const auto unknowns = owned(N_VNew_Serial(size, raw), &N_VDestroy, "N_VNew_Serial");
  const auto absolute = owned(N_VNew_Serial(size, raw), &N_VDestroy, "N_VNew_Serial");
  std::copy(y.begin(), y.end(), N_VGetArrayPointer(unknowns.get()));
  std::transform(system.scale.begin(), system.scale.end(), N_VGetArrayPointer(absolute.get()),
                 [](double scale) { return kRelative * scale; });
  const auto matrix = owned(SUNDenseMatrix(size, size, raw), &SUNMatDestroy, "SUNDenseMatrix");
  const auto linear = owned(
      SUNLinSol_Dense(unknowns.get(), matrix.get(), raw),
      [](SUNLinearSolver solver) { SUNLinSolFree(solver); }, "SUNLinSol_Dense");
  const auto memory = owned(
      CVodeCreate(CV_BDF, raw), [](void* m) { CVodeFree(&m); }, "CVodeCreate");
  const auto set = [](int flag, const char* call) { require_cvode(flag == CV_SUCCESS, call); };
  set(CVodeInit(memory.get(), right_hand_side, 0.0, unknowns.get()), "CVodeInit");
  set(CVodeSVtolerances(memory.get(), kRelative, absolute.get()), "CVodeSVtolerances");
  set(CVodeSetUserData(memory.get(), const_cast<PlainSystem*>(&system)), "CVodeSetUserData");
  set(CVodeSetLinearSolver(memory.get(), linear.get(), matrix.get()), "CVodeSetLinearSolver");
  set(CVodeSetStopTime(memory.get(), duration), "CVodeSetStopTime");
  set(CVodeSetErrFile(memory.get(), nullptr), "CVodeSetErrFile");
  double time = 0.0;
  const double* const now = N_VGetArrayPointer(unknowns.get());
  int flag = CV_SUCCESS;
  for (long step = 0; flag >= 0 && time < duration; ++step) {
    flag = step < kMostSteps ? CVode(memory.get(), duration, unknowns.get(), &time, CV_ONE_STEP)
                             : CV_TOO_MUCH_WORK;
    if (flag >= 0) system.stepped(time, now);
  }
  std::copy(now, now + y.size(), y.begin());
  return flag >= 0;
}

}  // namespace isotach::experiments::detail
