// Copyright Isotach contributors. SPDX-License-Identifier: BSD-3-Clause
// The material parameters of a simulation as a table.
#pragma once

#include "model/parameters.hpp"
#include "reports/page.hpp"

namespace isotach::reports {

/// Name, value in the unit of its key, unit and meaning of every parameter.
[[nodiscard]] Table material_table(const model::Parameters<double>& material);

}  // namespace isotach::reports
