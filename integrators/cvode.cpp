// Copyright Isotach contributors. SPDX-License-Identifier: BSD-3-Clause
// One increment posed to CVODE: unknowns, right-hand side, Jacobian, tolerances.
#include "integrators/cvode.hpp"

#include <cvode/cvode.h>
#include <nvector/nvector_serial.h>
#include <sundials/sundials_context.h>
#include <sunlinsol/sunlinsol_dense.h>
#include <sunmatrix/sunmatrix_dense.h>

#include <memory>
#include <stdexcept>
#include <string>
#include <type_traits>

namespace isotach::integrators {

namespace {

// Unknowns: stress in units of `scale`, void ratio, strain.
constexpr int kStressAndVoidRatio = 7;
constexpr int kUnknowns = kStressAndVoidRatio + 6;
using Jet = ceres::Jet<double, kStressAndVoidRatio>;

struct ContextDeleter {
  void operator()(SUNContext context) const { SUNContext_Free(&context); }
};
struct SolverDeleter {
  void operator()(void* solver) const { CVodeFree(&solver); }
};
using Context = std::unique_ptr<std::remove_pointer_t<SUNContext>, ContextDeleter>;
using Vector = std::unique_ptr<std::remove_pointer_t<N_Vector>, decltype(&N_VDestroy)>;
using Matrix = std::unique_ptr<std::remove_pointer_t<SUNMatrix>, decltype(&SUNMatDestroy)>;
using LinearSolver = std::unique_ptr<std::remove_pointer_t<SUNLinearSolver>, decltype(&SUNLinSolFree)>;
using Solver = std::unique_ptr<void, SolverDeleter>;

Increment<Jet> convert(const Increment<double>& increment) {
  Increment<Jet> result;
  result.duration = increment.duration;
  result.strain_rate = increment.strain_rate.cast<Jet>();
  result.stress_rate = increment.stress_rate.cast<Jet>();
  result.stress_controlled = increment.stress_controlled;
  result.spin = increment.spin.cast<Jet>();
  return result;
}

/// What CVODE's callbacks need.
class Problem {
 public:
  Problem(const model::Law<double>& law, const Increment<double>& increment, double scale)
      : scale_(scale),
        jet_law_(law.parameters().cast<Jet>()),
        jet_increment_(convert(increment)),
        rate_(law, increment),
        jet_rate_(jet_law_, jet_increment_) {}

  [[nodiscard]] model::State<double> state(const double* y) const {
    model::State<double> s;
    for (int i = 0; i < 6; ++i) s.stress[i] = y[i] * scale_;
    s.void_ratio = y[6];
    return s;
  }

  // A positive return value tells CVODE to try again with a smaller step.
  int right_hand_side(const double* y, double* dy) {
    ++evaluations;
    model::StateRate<double> rate;
    if (!rate_(state(y), rate)) return 1;
    for (int i = 0; i < 6; ++i) {
      dy[i] = rate.stress[i] / scale_;
      dy[kStressAndVoidRatio + i] = rate_.strain_rate()[i];
    }
    dy[6] = rate.void_ratio;
    return 0;
  }

  int jacobian(const double* y, SUNMatrix matrix) {
    model::State<Jet> s;
    for (int i = 0; i < 6; ++i) s.stress[i] = Jet(y[i], i) * scale_;
    s.void_ratio = Jet(y[6], 6);
    model::StateRate<Jet> rate;
    if (!jet_rate_(s, rate)) return 1;
    for (int j = 0; j < kStressAndVoidRatio; ++j) {
      double* column = SUNDenseMatrix_Column(matrix, j);
      for (int i = 0; i < 6; ++i) {
        column[i] = rate.stress[i].v[j] / scale_;
        column[kStressAndVoidRatio + i] = jet_rate_.strain_rate()[i].v[j];
      }
      column[6] = rate.void_ratio.v[j];
    }
    return 0;  // nothing depends on strain: those columns stay zero
  }

  long evaluations = 0;

 private:
  double scale_;
  model::Law<Jet> jet_law_;
  Increment<Jet> jet_increment_;
  LoadingRate<double> rate_;
  LoadingRate<Jet> jet_rate_;
};

int right_hand_side(double, N_Vector y, N_Vector dy, void* problem) {
  return static_cast<Problem*>(problem)->right_hand_side(N_VGetArrayPointer(y), N_VGetArrayPointer(dy));
}

int jacobian(double, N_Vector y, N_Vector, SUNMatrix matrix, void* problem, N_Vector, N_Vector, N_Vector) {
  return static_cast<Problem*>(problem)->jacobian(N_VGetArrayPointer(y), matrix);
}

FailureKind failure_kind(int flag) {
  switch (flag) {
    case CV_FIRST_RHSFUNC_ERR:
      return FailureKind::outside_domain;
    case CV_TOO_MUCH_WORK:
      return FailureKind::too_many_substeps;
    default:
      return FailureKind::solver;
  }
}

void require(bool ok, const char* call) {
  if (!ok) throw std::runtime_error(std::string("CVODE could not be set up: ") + call);
}

}  // namespace

tl::expected<Integrated<double>, Failure> integrate_cvode(const model::Law<double>& law,
                                                          const model::State<double>& start,
                                                          const Increment<double>& increment,
                                                          const CvodeTolerance& tolerance) {
  Integrated<double> result{start, model::Mandel<double>::Zero(), 0.0, {}};
  if (!(increment.duration > 0.0)) return result;
  if (!model::Law<double>::in_domain(start)) {
    return tl::unexpected(Failure{FailureKind::outside_domain, 0.0, start});
  }

  const double scale = start.stress.norm();
  Problem problem(law, increment, scale);
  SUNContext raw_context = nullptr;
  require(SUNContext_Create(nullptr, &raw_context) == 0, "SUNContext_Create");
  const Context context(raw_context);
  const Vector y(N_VNew_Serial(kUnknowns, context.get()), &N_VDestroy);
  const Vector absolute(N_VNew_Serial(kUnknowns, context.get()), &N_VDestroy);
  const Matrix matrix(SUNDenseMatrix(kUnknowns, kUnknowns, context.get()), &SUNMatDestroy);
  require(y && absolute && matrix, "allocation");
  const LinearSolver linear(SUNLinSol_Dense(y.get(), matrix.get(), context.get()), &SUNLinSolFree);
  const Solver solver(CVodeCreate(CV_BDF, context.get()));
  require(linear && solver, "CVodeCreate");

  double* unknowns = N_VGetArrayPointer(y.get());
  double* absolute_tolerance = N_VGetArrayPointer(absolute.get());
  for (int i = 0; i < 6; ++i) {
    unknowns[i] = start.stress[i] / scale;
    unknowns[kStressAndVoidRatio + i] = 0.0;
    absolute_tolerance[i] = tolerance.absolute_stress / scale;
    absolute_tolerance[kStressAndVoidRatio + i] = tolerance.relative;
  }
  unknowns[6] = start.void_ratio;
  absolute_tolerance[6] = 1e-3 * tolerance.relative;

  require(CVodeInit(solver.get(), right_hand_side, 0.0, y.get()) == CV_SUCCESS, "CVodeInit");
  require(CVodeSVtolerances(solver.get(), tolerance.relative, absolute.get()) == CV_SUCCESS,
          "CVodeSVtolerances");
  require(CVodeSetUserData(solver.get(), &problem) == CV_SUCCESS, "CVodeSetUserData");
  require(CVodeSetLinearSolver(solver.get(), linear.get(), matrix.get()) == CV_SUCCESS,
          "CVodeSetLinearSolver");
  require(CVodeSetJacFn(solver.get(), jacobian) == CV_SUCCESS, "CVodeSetJacFn");
  require(CVodeSetMaxNumSteps(solver.get(), tolerance.max_steps) == CV_SUCCESS, "CVodeSetMaxNumSteps");
  require(CVodeSetStopTime(solver.get(), increment.duration) == CV_SUCCESS, "CVodeSetStopTime");
  // failures come back as a Failure; CVODE's own lines on stderr would only repeat them
  require(CVodeSetErrFile(solver.get(), nullptr) == CV_SUCCESS, "CVodeSetErrFile");

  double time = 0.0;
  const int flag = CVode(solver.get(), increment.duration, y.get(), &time, CV_NORMAL);
  if (flag < 0) return tl::unexpected(Failure{failure_kind(flag), time, problem.state(unknowns), flag});
  result.state = problem.state(unknowns);
  for (int i = 0; i < 6; ++i) result.strain[i] = unknowns[kStressAndVoidRatio + i];
  CVodeGetNumSteps(solver.get(), &result.statistics.accepted);
  CVodeGetNumErrTestFails(solver.get(), &result.statistics.rejected);
  result.statistics.evaluations = problem.evaluations;
  return result;
}

}  // namespace isotach::integrators
