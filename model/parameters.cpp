// Copyright Isotach contributors. SPDX-License-Identifier: BSD-3-Clause
// Lookup of parameters by name, and the checks a set of values has to pass.
#include "model/parameters.hpp"

#include <fmt/format.h>

namespace isotach::model {

std::optional<ParameterId> find_parameter(std::string_view name) {
  for (const ParameterInfo& parameter : kParameterTable) {
    if (parameter.name == name) return parameter.id;
  }
  return std::nullopt;
}

std::string ParameterError::message() const {
  // ten digits: enough to recognise the number given, few enough to hide the round-off of degrees and radians
  return fmt::format("{} = {:.10g} is not admissible; accepted: {}", info(id).key, value, accepted);
}

namespace {

/// The range of one parameter in words, in the unit of its key.
std::string accepted_range(const ParameterInfo& parameter) {
  const std::string unit = parameter.unit == "-" ? "" : fmt::format(" {}", parameter.unit);
  const std::string upper =
      parameter.upper < kInfinity ? fmt::format("< {}{}", parameter.upper, unit) : "finite";
  return fmt::format("{} {}{} and {}", parameter.lower_open ? ">" : ">=", parameter.lower, unit, upper);
}

}  // namespace

std::optional<ParameterError> check(const ParameterValues<double>& values) {
  for (const ParameterInfo& parameter : kParameterTable) {
    const double value = values[parameter.id] / parameter.to_si;
    const bool above = parameter.lower_open ? value > parameter.lower : value >= parameter.lower;
    // written so that NaN fails
    if (!(above && value < parameter.upper)) {
      return ParameterError{parameter.id, value, accepted_range(parameter)};
    }
  }
  const double lambda = values[ParameterId::lambda];
  const double kappa = values[ParameterId::kappa];
  const double C_1 = values[ParameterId::C_1];
  if (!(kappa < lambda)) {
    return ParameterError{ParameterId::kappa, kappa, fmt::format("> 0 and < lambda = {}", lambda)};
  }
  // Beyond this the steady compression p/p_B = [r (1 - C_1 - kappa/lambda)/r0]^I_v does not exist.
  if (!(C_1 < 1.0 - kappa / lambda)) {
    return ParameterError{ParameterId::C_1, C_1,
                          fmt::format(">= 0 and < 1 - kappa/lambda = {}", 1.0 - kappa / lambda)};
  }
  return std::nullopt;
}

}  // namespace isotach::model
