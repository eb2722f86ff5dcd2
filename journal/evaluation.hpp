// Copyright Isotach contributors. SPDX-License-Identifier: BSD-3-Clause
// One slump simulation as the journal keeps it, and the key it is found under.
#pragma once

#include <string>

#include "journal/simulation.hpp"
#include "model/parameters.hpp"
#include "mpm/slump_setup.hpp"

namespace isotach::journal {

/// What a simulation is made of, as text that gives every number back to the last bit, and its keys.
struct Inputs {
  std::string parameters;  ///< JSON: material parameters by name, SI, and "lode_dependence"
  std::string setup;       ///< JSON: mpm::visit_fields by name, SI; not the threads, on which nothing depends
  std::string version;     ///< mpm::code_version()
  std::string setup_key;   ///< version-5 UUID (RFC 4122, SHA-1) of version and setup
  std::string key;         ///< the same of version, parameters and setup, a line each

  Inputs(const model::Parameters<double>& material, const mpm::SlumpSetup& slump, std::string code_version);
  /// As read from a file.
  Inputs() = default;
};

/// One row: a simulation and what it was of.
struct Evaluation : Simulation {
  Inputs inputs;
  std::string test;          ///< its name in the study; no part of the key
  double time_limit = 0.0;   ///< s of wall time that it was given
  std::string created = {};  ///< UTC, "2026-01-31T12:00:00Z"; Journal::put sets it
};

}  // namespace isotach::journal
