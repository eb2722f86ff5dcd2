// Copyright Isotach contributors. SPDX-License-Identifier: BSD-3-Clause
// A CVODES solver set up for one increment, for the functions that integrate with it.
#pragma once

#include <cvodes/cvodes.h>
#include <nvector/nvector_serial.h>
#include <sundials/sundials_context.h>
#include <sunlinsol/sunlinsol_dense.h>
#include <sunmatrix/sunmatrix_dense.h>

#include <algorithm>
#include <memory>
#include <stdexcept>
#include <string>
#include <type_traits>

#include "integrators/cvode.hpp"
#include "integrators/increment_system.hpp"

namespace isotach::integrators {

/// A vector of CVODES, freed with its last owner.
using CvodeVector = std::unique_ptr<std::remove_pointer_t<N_Vector>, decltype(&N_VDestroy)>;

/// Throws std::runtime_error where CVODES could not be set up: no memory left, or a defect here.
inline void require_cvode(bool ok, const char* call) {
  if (!ok) throw std::runtime_error(std::string("CVODES could not be set up: ") + call);
}

template <model::Fabric K>
class VariationalSystem;

/// BDF over one increment, Newton's method with the exact Jacobian, dense output. Refers to the system.
template <model::Fabric K>
class CvodeSolver {
 public:
  using System = IncrementSystem<K>;

  CvodeSolver(System& system, const typename System::State& start, double duration,
              const CvodeTolerance& tolerance)
      : system_(system), duration_(duration), max_steps_(tolerance.max_steps) {
    SUNContext raw_context = nullptr;
    require_cvode(SUNContext_Create(nullptr, &raw_context) == 0, "SUNContext_Create");
    context_.reset(raw_context);
    y_ = vector();
    const CvodeVector absolute = absolute_tolerances(tolerance);
    matrix_.reset(SUNDenseMatrix(System::kUnknowns, System::kUnknowns, context_.get()));
    require_cvode(matrix_ != nullptr, "SUNDenseMatrix");
    linear_.reset(SUNLinSol_Dense(y_.get(), matrix_.get(), context_.get()));
    require_cvode(linear_ != nullptr, "SUNLinSol_Dense");
    memory_.reset(CVodeCreate(CV_BDF, context_.get()));
    require_cvode(memory_ != nullptr, "CVodeCreate");

    double* y = N_VGetArrayPointer(y_.get());
    system.start(start, y);
    set("CVodeInit", CVodeInit(memory(), right_hand_side, 0.0, y_.get()));
    set("CVodeSVtolerances", CVodeSVtolerances(memory(), tolerance.relative, absolute.get()));
    set("CVodeSetUserData", CVodeSetUserData(memory(), this));
    set("CVodeSetLinearSolver", CVodeSetLinearSolver(memory(), linear_.get(), matrix_.get()));
    set("CVodeSetJacFn", CVodeSetJacFn(memory(), jacobian));
    set("CVodeSetStopTime", CVodeSetStopTime(memory(), duration));
    // failures come back as a Failure; CVODES' own lines on stderr would only repeat them
    set("CVodeSetErrFile", CVodeSetErrFile(memory(), nullptr));
  }

  CvodeSolver(const CvodeSolver&) = delete;  // CVODES keeps its address
  CvodeSolver& operator=(const CvodeSolver&) = delete;

  /// Goes on to that time (s), at most the duration, interpolating where a step leads beyond it; CVODES'
  /// flag, negative where it failed. Step by step with the duration as the aim, since CVODES chooses its
  /// first step by that: intermediate times then change no step.
  [[nodiscard]] int advance(double time) {
    int flag = CV_SUCCESS;
    while (flag >= 0 && stepped_ < time) {
      flag = steps_++ < max_steps_ ? CVode(memory(), duration_, y_.get(), &stepped_, CV_ONE_STEP)
                                   : CV_TOO_MUCH_WORK;
    }
    time_ = flag < 0 ? stepped_ : time;
    const int interpolated = CVodeGetDky(memory(), time_, 0, y_.get());
    return flag < 0 ? flag : interpolated;
  }

  /// State (with Omega), strain since the start and cost, where advance() ended.
  [[nodiscard]] Integrated<double> reached() const {
    const double* y = N_VGetArrayPointer(y_.get());
    return {model::with_omega(system_.template state<double>(y)), system_.strain(y), 0.0, statistics()};
  }

  [[nodiscard]] Failure failure(int flag) const {
    const Integrated<double> last = reached();
    return {kind(flag), time_, last.state, last.statistics, flag};
  }

  /// CVODES' own memory, to set up more.
  [[nodiscard]] void* memory() const { return memory_.get(); }
  [[nodiscard]] System& system() const { return system_; }

  /// A vector of the unknowns' size.
  [[nodiscard]] CvodeVector vector() const {
    CvodeVector result(N_VNew_Serial(System::kUnknowns, context_.get()), &N_VDestroy);
    require_cvode(result != nullptr, "N_VNew_Serial");
    return result;
  }

  [[nodiscard]] CvodeVector absolute_tolerances(const CvodeTolerance& tolerance) const {
    CvodeVector result = vector();
    double* absolute = N_VGetArrayPointer(result.get());
    for (int i = 0; i < System::kUnknowns; ++i) {
      absolute[i] = i < 6 ? tolerance.absolute_stress / system_.stress_scale() : tolerance.relative;
    }
    absolute[6] = 1e-3 * tolerance.relative;
    return result;
  }

  VariationalSystem<K>* variational = nullptr;  ///< for the callback of sensitivities, where there are any

 private:
  struct ContextDeleter {
    void operator()(SUNContext context) const { SUNContext_Free(&context); }
  };
  struct MemoryDeleter {
    void operator()(void* memory) const { CVodeFree(&memory); }
  };
  struct MatrixDeleter {
    void operator()(SUNMatrix matrix) const { SUNMatDestroy(matrix); }
  };
  struct LinearDeleter {
    void operator()(SUNLinearSolver linear) const { SUNLinSolFree(linear); }
  };

  static void set(const char* call, int flag) { require_cvode(flag == CV_SUCCESS, call); }

  // A positive return value tells CVODES to try again with a smaller step.
  static int right_hand_side(double, N_Vector y, N_Vector dy, void* self) {
    double* rates = N_VGetArrayPointer(dy);
    return static_cast<CvodeSolver*>(self)->system_.rate(N_VGetArrayPointer(y), rates) ? 0 : 1;
  }

  static int jacobian(double, N_Vector y, N_Vector, SUNMatrix matrix, void* self, N_Vector, N_Vector,
                      N_Vector) {
    typename System::Unknowns rate;
    typename System::Jacobian columns;
    auto& system = static_cast<CvodeSolver*>(self)->system_;
    if (!system.rate_and_jacobian(N_VGetArrayPointer(y), rate, columns)) return 1;
    // the columns of the strain stay zero
    std::copy_n(columns.data(), columns.size(), SUNDenseMatrix_Data(matrix));
    return 0;
  }

  static FailureKind kind(int flag) {
    switch (flag) {
      case CV_FIRST_RHSFUNC_ERR:
        return FailureKind::outside_domain;
      case CV_TOO_MUCH_WORK:
        return FailureKind::too_many_substeps;
      default:
        return FailureKind::solver;
    }
  }

  [[nodiscard]] Statistics statistics() const {
    Statistics result;
    CVodeGetNumSteps(memory(), &result.accepted);
    CVodeGetNumErrTestFails(memory(), &result.rejected);
    result.evaluations = system_.evaluations();
    result.jacobians = system_.jacobians();
    return result;
  }

  System& system_;
  double duration_;
  long max_steps_;
  long steps_ = 0;
  double stepped_ = 0.0;  // s, where the last step ended
  double time_ = 0.0;     // s, where y is
  // freed in reverse: the context last
  std::unique_ptr<std::remove_pointer_t<SUNContext>, ContextDeleter> context_;
  CvodeVector y_{nullptr, &N_VDestroy};
  std::unique_ptr<std::remove_pointer_t<SUNMatrix>, MatrixDeleter> matrix_;
  std::unique_ptr<std::remove_pointer_t<SUNLinearSolver>, LinearDeleter> linear_;
  std::unique_ptr<void, MemoryDeleter> memory_;
};

}  // namespace isotach::integrators
