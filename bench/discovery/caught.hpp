// Copyright Isotach contributors. SPDX-License-Identifier: BSD-3-Clause
// Discovery in a benchmark: an exception is a failure like others, counted, and no end of it.
#pragma once

#include <exception>
#include <string>
#include <tl/expected.hpp>

#include "calibration/fit_result.hpp"

namespace isotach::bench {

/// f(), or the failure that its exception stands for.
template <class F>
auto caught(F&& f) -> decltype(f()) {
  try {
    return f();
  } catch (const std::exception& error) {
    return tl::unexpected(calibration::FitFailure{std::string("exception: ") + error.what()});
  }
}

}  // namespace isotach::bench
