// Copyright Isotach contributors. SPDX-License-Identifier: BSD-3-Clause
#include "bench/discovery/outside.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "experiments/effects_reference.hpp"
#include "model/law.hpp"

namespace isotach::bench {

namespace {

constexpr std::array kAll{
    OutsideInfo{OutsideKind::leaking_drainage, "leaking_drainage", 1e9, 3e10, false},
    OutsideInfo{OutsideKind::lambda_of_void_ratio, "lambda_of_void_ratio", 0.5, 2.5, true},
    OutsideInfo{OutsideKind::frame_slack, "frame_slack", 5e-5, 1e-3, false},
    OutsideInfo{OutsideKind::load_cell_zero, "load_cell_zero", 300.0, 5000.0, true},
    OutsideInfo{OutsideKind::height_error, "height_error", 0.02, 0.2, true},
    OutsideInfo{OutsideKind::load_cell_curvature, "load_cell_curvature", 0.05, 0.8, true},
    OutsideInfo{OutsideKind::load_cell_swing, "load_cell_swing", 200.0, 3000.0, false},
};
constexpr double kLeakTime = 1e4;
constexpr double kDay = 86400.0;

/// The specimen's state: stresses (Pa, tension positive), void ratio, pressure of water (Pa, compression
/// positive).
struct Specimen {
  double axial;
  double radial;
  double void_ratio;
  double water = 0.0;
};

/// The law of `truth` with one fault.
class Faulty {
 public:
  Faulty(const datasets::OedometerTest& test, const model::Parameters<double>& truth, const Outside& outside)
      : test_(test), law_(truth), outside_(outside) {}

  [[nodiscard]] Specimen start() const {
    const double axial = *test_.initial_axial_stress;
    return {-axial, -test_.initial_K0 * axial, test_.void_ratio, 0.0};
  }

  /// Compresses by d ln(1 - eps) = -`strain` at a constant rate; false where the law ends.
  [[nodiscard]] bool compress(double strain, double duration, Specimen& at) const {
    const double scale = std::hypot(at.axial, at.radial);
    const double rate = strain / duration;
    experiments::detail::PlainSystem system;
    system.rate = [&](double, const double* y, double* dy) {
      model::State<double> state{model::Mandel<double>::Zero(), y[2]};
      state.stress.head<3>() << y[0] * scale, y[1] * scale, y[1] * scale;
      if (!law_.in_domain(state)) return false;
      model::Mandel<double> stretching = model::Mandel<double>::Zero();
      stretching[0] = -rate;
      const auto f = law_.rate(state, stretching, std::abs(rate), log_p_B(y[2]));
      dy[0] = f.stress[0] / scale;
      dy[1] = f.stress[1] / scale;
      dy[2] = f.void_ratio;
      dy[3] = (resistance() * rate / scale - y[3]) / kLeakTime;
      return true;
    };
    system.stepped = [](double, const double*) {};
    system.scale = {1.0, 1.0, 1.0, 1.0};
    std::vector<double> y{at.axial / scale, at.radial / scale, at.void_ratio, at.water / scale};
    const bool done = experiments::detail::solve_plain_system(system, duration, y);
    at = {y[0] * scale, y[1] * scale, y[2], y[3] * scale};
    return done;
  }

  /// The load cell's reading (Pa).
  [[nodiscard]] double reading(const Specimen& at, double time) const {
    const double stress = -at.axial;
    const double a = outside_.amplitude;
    switch (outside_.kind) {
      case OutsideKind::leaking_drainage:
        return stress + 2.0 / 3.0 * at.water;
      case OutsideKind::load_cell_zero:
        return stress + a;
      case OutsideKind::load_cell_curvature:
        return stress * (1.0 + a * stress / 100e3);
      case OutsideKind::load_cell_swing:
        return stress + a * std::sin(2.0 * std::numbers::pi * time / kDay + 1.0);
      case OutsideKind::lambda_of_void_ratio:
      case OutsideKind::frame_slack:
      case OutsideKind::height_error:
        break;
    }
    return stress;
  }

  /// Engineering strain of the specimen once the apparatus has gone to `measured`, from `specimen`.
  [[nodiscard]] double follow(double measured, double specimen) const {
    const double a = outside_.amplitude;
    if (outside_.kind == OutsideKind::height_error) return (1.0 + a) * measured;
    if (outside_.kind != OutsideKind::frame_slack) return measured;
    return std::clamp(specimen, measured, measured + a / test_.height);
  }
  /// Of an interval in which the apparatus moved and the specimen followed late.
  [[nodiscard]] double share_standing(double moved, double followed) const {
    if (outside_.kind != OutsideKind::frame_slack || moved == 0.0) return 0.0;
    return std::clamp(1.0 - followed / moved, 0.0, 1.0);
  }

 private:
  [[nodiscard]] double log_p_B(double void_ratio) const {
    const double ordinary = law_.log_preconsolidation_pressure(void_ratio);
    if (outside_.kind != OutsideKind::lambda_of_void_ratio) return ordinary;
    const double compressed = std::log((1.0 + test_.void_ratio) / (1.0 + void_ratio));
    return ordinary + 0.5 * outside_.amplitude * compressed * compressed / law_.parameters().lambda();
  }
  [[nodiscard]] double resistance() const {
    if (outside_.kind != OutsideKind::leaking_drainage) return 0.0;
    return outside_.amplitude * std::pow(test_.height / 0.02, 2);
  }

  const datasets::OedometerTest& test_;
  model::Law<double> law_;
  Outside outside_;
};

}  // namespace

std::span<const OutsideInfo> outside_effects() {
  return kAll;
}

const OutsideInfo& info_of(OutsideKind kind) {
  return *std::find_if(kAll.begin(), kAll.end(), [&](const OutsideInfo& one) { return one.kind == kind; });
}

tl::expected<std::vector<double>, std::string> log_stress_with(const datasets::OedometerTest& test,
                                                               const model::Parameters<double>& truth,
                                                               const Outside& outside) {
  const Faulty faulty(test, truth, outside);
  Specimen at = faulty.start();
  double time = 0.0;
  double measured = 0.0;
  double strain = 0.0;
  std::vector<double> readings;
  for (const datasets::OedometerRow& row : test.record.rows) {
    const double next = faulty.follow(row.axial_strain, strain);
    const double duration = row.time - time;
    const double standing = faulty.share_standing(row.axial_strain - measured, next - strain);
    const double amount = std::log((1.0 - strain) / (1.0 - next));
    bool done = true;
    if (standing > 0.0) done = faulty.compress(0.0, standing * duration, at);
    if (done && standing < 1.0) done = faulty.compress(amount, (1.0 - standing) * duration, at);
    const double stress = faulty.reading(at, row.time);
    if (!done || !(stress > 0.0)) {
      return tl::unexpected(test.name + ": " + std::string(info_of(outside.kind).name) +
                            " cannot be followed beyond " + std::to_string(time) + " s");
    }
    readings.push_back(std::log(stress));
    time = row.time;
    measured = row.axial_strain;
    strain = next;
  }
  return readings;
}

}  // namespace isotach::bench
