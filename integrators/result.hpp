// Copyright Isotach contributors. SPDX-License-Identifier: BSD-3-Clause
// What an integration over an increment returns: the end state and what it cost, or why and when it failed.
#pragma once

#include <string>

#include "model/law.hpp"

namespace isotach::integrators {

enum class FailureKind {
  outside_domain,     ///< the start state is outside the law's domain, or rates cannot be computed from it
  substep_underflow,  ///< substeps became too small to advance time
  too_many_substeps,  ///< the limit of substeps was reached
  solver              ///< the reference solver gave up
};

/// What an integration cost.
struct Statistics {
  long accepted = 0;     ///< substeps
  long rejected = 0;     ///< substeps
  long evaluations = 0;  ///< of the rate
  long jacobians = 0;    ///< of the rate, where the method needs them

  Statistics& operator+=(const Statistics& other) {
    accepted += other.accepted;
    rejected += other.rejected;
    evaluations += other.evaluations;
    jacobians += other.jacobians;
    return *this;
  }
};

/// A failed integration. The caller's state is unchanged.
struct Failure {
  FailureKind kind;
  double time;                      ///< s from the start of the increment
  model::State<double> last_state;  ///< last accepted state
  Statistics statistics{};          ///< up to the failure
  int solver_flag = 0;              ///< CVODES' return flag, where kind is solver

  [[nodiscard]] std::string message() const;
};

/// Result of an increment.
template <class S, model::Fabric K = model::Fabric::omega>
struct Integrated {
  model::State<S, model::kGeneral, K> state;  ///< at the end
  model::Mandel<S> strain;                    ///< strain increment (-), time integral of the strain rate
  double next_substep =
      0.0;  ///< s, a good first substep for an increment that goes on likewise; 0: not known
  Statistics statistics;
};

}  // namespace isotach::integrators
