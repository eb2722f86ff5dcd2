// Copyright Isotach contributors. SPDX-License-Identifier: BSD-3-Clause
// Why a picture gives no outline.
#pragma once

#include <string>

namespace isotach::images {

struct Refusal {
  enum class Kind {
    no_silhouette,        ///< nothing stands out from the background
    cut_by_border,        ///< the mud, or what touches it, reaches a side of the picture
    several_silhouettes,  ///< two or more bodies
    no_base_line,         ///< nothing shows where the base is
    not_on_base,          ///< the body does not stand on the base line
    unclear_edge,         ///< too much of the edge is hidden or blurred
    volume,               ///< the body of revolution has not the volume that was filled in
  };
  Kind kind;
  std::string message;  ///< one line with the numbers, and what to do
};

/// "cut-by-border", as result.json has it.
[[nodiscard]] const char* name_of(Refusal::Kind kind);

}  // namespace isotach::images
