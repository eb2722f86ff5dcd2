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

/// A failed integration. The caller's state is unchanged.
struct Failure {
  FailureKind kind;
  double time;                      ///< s from the start of the increment
  model::State<double> last_state;  ///< last accepted state
  int solver_flag = 0;              ///< CVODE's return flag, where kind is solver

  [[nodiscard]] std::string message() const;
};

/// Plain values of a state.
template <class S, int N>
[[nodiscard]] model::State<double, N> plain(const model::State<S, N>& state) {
  model::State<double, N> result;
  for (int i = 0; i < N; ++i) result.stress[i] = model::value_of(state.stress[i]);
  result.void_ratio = model::value_of(state.void_ratio);
  return result;
}

struct Statistics {
  long accepted = 0;     ///< substeps
  long rejected = 0;     ///< substeps
  long evaluations = 0;  ///< of the rate
};

/// Result of an increment.
template <class S>
struct Integrated {
  model::State<S> state;    ///< at the end
  model::Mandel<S> strain;  ///< strain increment (-), time integral of the strain rate
  double next_substep =
      0.0;  ///< s, a good first substep for an increment that goes on likewise; 0: not known
  Statistics statistics;
};

}  // namespace isotach::integrators
