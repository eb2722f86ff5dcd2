// Copyright Isotach contributors. SPDX-License-Identifier: BSD-3-Clause
// How sure a rate is that was counted.
#pragma once

#include <cstddef>

namespace isotach::bench {

struct Interval {
  double lower;
  double upper;
};

/// Wilson's 95 % score interval of a proportion of which `hits` of `count` > 0 were seen, without correction
/// for continuity (Wilson, J. Am. Stat. Assoc. 22 (1927) 209-212).
[[nodiscard]] Interval wilson(std::size_t hits, std::size_t count);

}  // namespace isotach::bench
