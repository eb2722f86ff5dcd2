// Copyright Isotach contributors. SPDX-License-Identifier: BSD-3-Clause
// The table of candidates for those who bring none.
#include "datasets/candidates.hpp"

namespace isotach::datasets {

std::string_view default_candidates() {
  return R"toml(# Candidates of isotach next-test where none are given. Copy, change, and give with --candidates.

[pictures]                      # s since the mould began to rise
figures = [4.05, 5.2, 13.3, 15.2, 30.0]          # those of the figures of Pippi et al.
early = [0.5, 1.0, 2.0]
late = [15.0, 30.0]
many = [0.25, 0.5, 1.0, 2.0, 4.0, 8.0, 15.0, 30.0]

# Table 1 of Pippi et al.: h/D, lift speed, and two muds known by their strength at the rate D_r
[[slump]]
name = "test 1"
programme = "Pippi et al., table 1"
pictures = ["figures", "early", "late", "many"]
mould = { diameter_mm = 78.0, fill_height_mm = 140.0, lift_speed_m_per_s = 0.06, wall = "smooth" }
mud = { undrained_strength_kPa = 0.117, specific_gravity = 2.65, ocr = 1.5 }
[[slump]]
name = "test 2"
programme = "Pippi et al., table 1"
pictures = ["figures", "early", "late", "many"]
mould = { diameter_mm = 78.0, fill_height_mm = 70.0, lift_speed_m_per_s = 0.06, wall = "smooth" }
mud = { undrained_strength_kPa = 0.117, specific_gravity = 2.65, ocr = 1.5 }
[[slump]]
name = "test 3"
programme = "Pippi et al., table 1"
pictures = ["figures", "early", "late", "many"]
mould = { diameter_mm = 78.0, fill_height_mm = 140.0, lift_speed_m_per_s = 0.01, wall = "smooth" }
mud = { undrained_strength_kPa = 0.117, specific_gravity = 2.65, ocr = 1.5 }
[[slump]]
name = "test 4"
programme = "Pippi et al., table 1"
pictures = ["figures", "early", "late", "many"]
mould = { diameter_mm = 78.0, fill_height_mm = 70.0, lift_speed_m_per_s = 0.01, wall = "smooth" }
mud = { undrained_strength_kPa = 0.117, specific_gravity = 2.65, ocr = 1.5 }
[[slump]]
name = "test 5"
programme = "Pippi et al., table 1"
pictures = ["figures"]
mould = { diameter_mm = 78.0, fill_height_mm = 140.0, lift_speed_m_per_s = 0.06, wall = "smooth" }
mud = { undrained_strength_kPa = 0.072, specific_gravity = 2.65, ocr = 1.5 }
[[slump]]
name = "test 6"
programme = "Pippi et al., table 1"
pictures = ["figures"]
mould = { diameter_mm = 78.0, fill_height_mm = 70.0, lift_speed_m_per_s = 0.06, wall = "smooth" }
mud = { undrained_strength_kPa = 0.072, specific_gravity = 2.65, ocr = 1.5 }
[[slump]]
name = "test 7"
programme = "Pippi et al., table 1"
pictures = ["figures"]
mould = { diameter_mm = 78.0, fill_height_mm = 140.0, lift_speed_m_per_s = 0.01, wall = "smooth" }
mud = { undrained_strength_kPa = 0.072, specific_gravity = 2.65, ocr = 1.5 }
[[slump]]
name = "test 8"
programme = "Pippi et al., table 1"
pictures = ["figures"]
mould = { diameter_mm = 78.0, fill_height_mm = 70.0, lift_speed_m_per_s = 0.01, wall = "smooth" }
mud = { undrained_strength_kPa = 0.072, specific_gravity = 2.65, ocr = 1.5 }

# walls that hold the mud back, and a lift ten times slower, with the study's mud
[[slump_grid]]
diameter_mm = 78.0
fill_heights_mm = [70.0, 140.0]
lift_speeds_m_per_s = [0.01, 0.06]
walls = ["rough"]
wall_adhesions_kPa = [0.02]
pictures = ["figures", "many"]
[[slump_grid]]
diameter_mm = 78.0
fill_heights_mm = [140.0]
lift_speeds_m_per_s = [0.001]
walls = ["smooth"]
times_s = [5.0, 10.0, 20.0, 40.0, 60.0, 80.0, 100.0, 120.0, 140.0]

# constant rate of strain, from the start of the study's first oedometer test
[[oedometer]]
name = "CRS, one rate"
stages = [{ to_strain = 0.3, rate_per_s = 7e-7 }]
[[oedometer]]
name = "CRS, one slow rate"
stages = [{ to_strain = 0.3, rate_per_s = 7e-8 }]
[[oedometer]]
name = "CRS, steps of 10"
stages = [{ to_strain = 0.12, rate_per_s = 7e-7 }, { to_strain = 0.16, rate_per_s = 7e-6 },
          { to_strain = 0.2, rate_per_s = 7e-7 }, { to_strain = 0.24, rate_per_s = 7e-6 },
          { to_strain = 0.3, rate_per_s = 7e-7 }]
[[oedometer]]
name = "CRS, steps of 100"
stages = [{ to_strain = 0.12, rate_per_s = 7e-8 }, { to_strain = 0.16, rate_per_s = 7e-6 },
          { to_strain = 0.2, rate_per_s = 7e-8 }, { to_strain = 0.24, rate_per_s = 7e-6 },
          { to_strain = 0.3, rate_per_s = 7e-8 }]
[[oedometer]]
name = "CRS, relaxation"
stages = [{ to_strain = 0.15, rate_per_s = 7e-6 }, { relax_s = 86400.0 }, { to_strain = 0.3, rate_per_s = 7e-6 },
          { relax_s = 86400.0 }]
[[oedometer]]
name = "CRS, unloading and reloading"
stages = [{ to_strain = 0.2, rate_per_s = 7e-7 }, { to_strain = 0.185, rate_per_s = 7e-7 },
          { to_strain = 0.25, rate_per_s = 7e-7 }, { to_strain = 0.235, rate_per_s = 7e-7 },
          { to_strain = 0.3, rate_per_s = 7e-7 }]
[[oedometer]]
name = "CRS, steps of 100, unloading, relaxation"
stages = [{ to_strain = 0.12, rate_per_s = 7e-8 }, { to_strain = 0.18, rate_per_s = 7e-6 },
          { to_strain = 0.165, rate_per_s = 7e-6 }, { to_strain = 0.22, rate_per_s = 7e-6 },
          { relax_s = 86400.0 }, { to_strain = 0.3, rate_per_s = 7e-7 }]
)toml";
}

}  // namespace isotach::datasets
