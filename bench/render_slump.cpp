// Copyright Isotach contributors. SPDX-License-Identifier: BSD-3-Clause
// Writes the pictures of docs/profile: render_slump FOLDER. A mould of 78 mm with a wall of 2 mm, filled to
// 70 mm, and what became of the mud after 2 and 15 s, if it were caps of its volume; a camera 1 m away, 20 mm
// above the base.
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <numbers>
#include <opencv2/imgcodecs.hpp>

#include "bench/rendered_slump.hpp"

namespace {

using isotach::rendered::cap;
using isotach::rendered::Outline;
using isotach::rendered::Pinhole;
using isotach::rendered::render;
using isotach::rendered::Scene;

constexpr double kVolume = std::numbers::pi * 0.039 * 0.039 * 0.070;  // m3

/// The cap of that volume: of its cylinder it fills power/(power + 2).
Outline cap_of_volume(double radius, double power) {
  return cap(radius, kVolume / (std::numbers::pi * radius * radius) * (power + 2.0) / power, power);
}

void write(const std::filesystem::path& file, const Outline& outline, std::uint64_t seed) {
  constexpr int kQuality = 85;
  const Scene scene{.outline = outline,
                    .pixel = 0.4e-3,
                    .width = 640,
                    .height = 400,
                    .roll = 0.01,
                    .pinhole = Pinhole{.distance = 1.0, .height = 0.02},
                    .uneven = 0.35,
                    .shadow = 0.2,
                    .grains = 0.25,
                    .blur = 0.8,
                    .noise = 2.5,
                    .seed = seed};
  cv::imwrite(file.string(), render(scene), {cv::IMWRITE_JPEG_QUALITY, kQuality});
}

}  // namespace

int main(int argc, char** argv) {
  if (argc != 2) {
    std::fprintf(stderr, "render_slump FOLDER\n");
    return 2;
  }
  const std::filesystem::path folder = argv[1];
  std::filesystem::create_directories(folder);
  write(folder / "mould.jpg", {{0.041, 0.0}, {0.041, 0.072}, {0.0, 0.072}}, 1);
  write(folder / "slump-2s.jpg", cap_of_volume(0.066, 4.0), 2);
  write(folder / "slump-15s.jpg", cap_of_volume(0.075, 2.0), 3);
}
