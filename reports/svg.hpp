// Copyright Isotach contributors. SPDX-License-Identifier: BSD-3-Clause
// Making gnuplot's SVG documents fit to stand several in one HTML page.
#pragma once

#include <string>
#include <string_view>

namespace isotach::reports {

/// The `<svg>` element of a document written by gnuplot: without prolog, scaling to the width it is given,
/// ids and references prefixed, fonts left to one attribute on top, empty groups and unused definitions
/// dropped, and `title` (may be empty) as its name for screen readers. Throws std::runtime_error where it is
/// not such a document.
[[nodiscard]] std::string inline_svg(std::string_view document, std::string_view id_prefix,
                                     std::string_view title);

}  // namespace isotach::reports
