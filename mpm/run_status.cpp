// Copyright Isotach contributors. SPDX-License-Identifier: BSD-3-Clause
#include "mpm/run_status.hpp"

namespace isotach::mpm {

std::string_view name_of(RunStatus status) {
  switch (status) {
    case RunStatus::ok:
      return "ok";
    case RunStatus::not_settled:
      return "not settled";
    case RunStatus::crashed:
      return "crashed";
    case RunStatus::timed_out:
      return "timed out";
    case RunStatus::outside_domain:
      return "outside the domain";
    case RunStatus::interrupted:
      return "interrupted";
  }
  return "";
}

double kinetic_share(const SlumpResult& result) {
  const HistoryRow& end = result.history.back();
  return end.kinetic / end.inertia_scaling / result.history.front().potential;
}

RunStatus status_of(const SlumpResult& result) {
  return kinetic_share(result) > kSettledShare ? RunStatus::not_settled : RunStatus::ok;
}

RunStatus status_of(const SlumpFailure& failure) {
  switch (failure.kind) {
    case SlumpFailure::Kind::left_grid:
    case SlumpFailure::Kind::left_slab:
      return RunStatus::outside_domain;
    case SlumpFailure::Kind::interrupted:
      return RunStatus::interrupted;
    case SlumpFailure::Kind::timed_out:
      return RunStatus::timed_out;
    case SlumpFailure::Kind::bad_setup:
    case SlumpFailure::Kind::not_finite:
    case SlumpFailure::Kind::no_outline:
    case SlumpFailure::Kind::energy:
      break;
  }
  return RunStatus::crashed;
}

}  // namespace isotach::mpm
