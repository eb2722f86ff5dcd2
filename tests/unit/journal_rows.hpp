// Copyright Isotach contributors. SPDX-License-Identifier: BSD-3-Clause
// Small evaluations for the tests of the journal.
#pragma once

#include <string>

#include "journal/evaluation.hpp"
#include "mpm/archive.hpp"
#include "tests/seed_mud.hpp"

namespace isotach::journal {

/// A slump of a low fill of wet mud on coarse cells: a tenth of a second.
inline mpm::SlumpSetup small_setup() {
  mpm::SlumpSetup setup;
  setup.mould.fill_height = 0.04;
  setup.mud.void_ratio = 5.0;
  setup.numerics.cell_size = 0.013;
  setup.times = {0.1, 0.2};
  return setup;
}

/// A row of the small setup with another I_v, and so another key, for each number.
inline Evaluation row_number(int number, mpm::RunStatus status = mpm::RunStatus::ok) {
  Evaluation evaluation;
  evaluation.inputs =
      Inputs(tests::seed_mud_with(model::ParameterId::I_v, 0.02 + 1e-6 * number), small_setup(), "test 1");
  evaluation.test = "slump-1";
  evaluation.status = status;
  evaluation.seconds = 0.1 * number;
  evaluation.time_limit = 10.0;
  if (status == mpm::RunStatus::ok || status == mpm::RunStatus::not_settled) {
    mpm::SlumpResult result;
    result.outlines = {{0.1, {{0.05, 0.0}, {0.04, 0.01 * number}, {0.0, 0.03}}}};
    result.history = {{0.0, 0.04, 0.039, 0.0, 1.0, 0.0, 0.0, 1e-4, 1.0}};
    evaluation.result = result;
  } else {
    evaluation.message = "no luck";
  }
  return evaluation;
}

/// All that a fit gets of a result, as bytes.
inline std::string bytes_of(mpm::SlumpResult result) {
  mpm::Archive archive;
  archive(result);
  archive(result.initial);
  archive(result.cell_size);
  archive(result.points);
  archive(result.steps);
  archive(result.particle_steps);
  archive(result.substepped);
  archive(result.floored);
  return archive.bytes();
}

}  // namespace isotach::journal
