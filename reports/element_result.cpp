// Copyright Isotach contributors. SPDX-License-Identifier: BSD-3-Clause
// From rows in SI, tension positive, to columns that engineers read.
#include "reports/element_result.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>

#include "reports/number.hpp"

namespace isotach::reports {
namespace {

using integrators::Stage;
using Column = ElementCurve::Column;

constexpr double kKilopascals = 1e-3;  // of a pascal
constexpr double kSameStress =
    1e-6;  // of p: what integration leaves between stresses that are equal by symmetry
constexpr double kNoStrain = 1e-9;

double range(const Column& column) {
  const auto [least, greatest] = std::minmax_element(column.begin(), column.end());
  return column.empty() ? 0.0 : *greatest - *least;
}

/// The range of strain that one thinks of: of gamma = 2 eps where it is shear.
double strain_range(const ElementCurve& curve, std::size_t component) {
  return (component < 3 ? 1.0 : 2.0) * range(curve.strain[component]);
}

bool axisymmetric(const ElementCurve& curve, std::size_t axis) {
  const std::size_t a = (axis + 1) % 3;
  const std::size_t b = (axis + 2) % 3;
  for (std::size_t i = 0; i < curve.size(); ++i) {
    const double limit = kSameStress * curve.p[i];
    if (std::abs(curve.stress[a][i] - curve.stress[b][i]) > limit) return false;
    for (std::size_t shear = 3; shear < 6; ++shear) {
      if (std::abs(curve.stress[shear][i]) > limit) return false;
    }
  }
  return true;
}

std::optional<std::size_t> find_axis(const ElementCurve& curve) {
  std::optional<std::size_t> found;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    if (!axisymmetric(curve, axis)) continue;
    // isotropic stress has every axis: then the one that strains most
    if (!found || strain_range(curve, axis) > strain_range(curve, *found)) found = axis;
  }
  return found;
}

std::array<double, 6> negated_components(const model::Mandel<double>& tensor) {
  const auto components = model::components_from_mandel<double>(tensor);
  std::array<double, 6> result{};
  // 0 - x: no negative zeros in files
  for (std::size_t i = 0; i < 6; ++i) result[i] = 0.0 - components[static_cast<Eigen::Index>(i)];
  return result;
}

/// Components that share a text, as one part: "σ22, σ33: 0 kPa/s".
class Parts {
 public:
  void add(std::string_view symbol, std::size_t component, const std::string& value) {
    const std::string name = fmt::format("{}{}", symbol, kComponentNames[component]);
    for (auto& [names, text] : parts_) {
      if (text != value) continue;
      names += ", " + name;
      return;
    }
    parts_.emplace_back(name, value);
  }
  [[nodiscard]] std::string text() const {
    std::vector<std::string> texts;
    for (const auto& [names, value] : parts_) texts.push_back(fmt::format("{}: {}", names, value));
    return fmt::format("{}", fmt::join(texts, "; "));
  }

 private:
  std::vector<std::pair<std::string, std::string>> parts_;
};

/// Whether the stress condition of the component is on the mean stress.
bool is_mean_condition(const Stage& stage, Eigen::Index i) {
  const auto row = stage.increment.condition.row(i);
  return row[0] == row[1] && row[1] == row[2] && row[0] != 0.0;
}

bool is_identity_condition(const Stage& stage, Eigen::Index i) {
  for (Eigen::Index j = 0; j < 6; ++j) {
    if (stage.increment.condition(i, j) != (i == j ? 1.0 : 0.0)) return false;
  }
  return true;
}

}  // namespace

ElementCurve::ElementCurve(const datasets::ElementFile& test,
                           const std::vector<integrators::ElementRow>& rows) {
  const model::Law<double> law(test.material);
  for (const integrators::ElementRow& row : rows) {
    const auto strains = negated_components(row.strain);
    const auto stresses = negated_components(row.state.stress);
    const auto omegas = negated_components(row.state.omega);
    for (std::size_t i = 0; i < 6; ++i) {
      strain[i].push_back(strains[i]);
      stress[i].push_back(kKilopascals * stresses[i]);
      omega[i].push_back(omegas[i]);
    }
    time.push_back(row.time);
    stage.push_back(row.stage);
    void_ratio.push_back(row.state.void_ratio);
    ocr.push_back(row.overconsolidation_ratio);
    volumetric_strain.push_back(strains[0] + strains[1] + strains[2]);
    p.push_back(kKilopascals * (stresses[0] + stresses[1] + stresses[2]) / 3.0);
    q.push_back(kKilopascals * std::sqrt(1.5) * model::deviator<double, 6>(row.state.stress).norm());
    p_B.push_back(kKilopascals * law.preconsolidation_pressure(row.state.void_ratio));
  }
  for (std::size_t i = 1; i < 6; ++i) {
    if (strain_range(*this, i) > strain_range(*this, driven)) driven = i;
  }
  axis = find_axis(*this);
  if (axis) {
    const std::size_t lateral = (*axis + 1) % 3;
    for (std::size_t i = 0; i < size(); ++i)
      q[i] = std::copysign(q[i], stress[*axis][i] - stress[lateral][i]);
  }
  oedometric = driven < 3 && strain_range(*this, driven) > kNoStrain;
  for (std::size_t i = 0; i < 6; ++i) {
    if (i != driven && strain_range(*this, i) > kNoStrain) oedometric = false;
  }
}

bool changes(const std::vector<double>& column, double tolerance) {
  return std::any_of(column.begin(), column.end(),
                     [&](double value) { return std::abs(value - column.front()) > tolerance; });
}

double shown_q(const ElementCurve& curve, std::size_t row) {
  return std::abs(curve.q[row]) <= kSameStress * curve.p[row] ? 0.0 : curve.q[row];
}

std::string control_text(const integrators::Stage& stage) {
  Parts parts;
  const auto& increment = stage.increment;
  for (std::size_t i = 0; i < 6; ++i) {
    const auto index = static_cast<Eigen::Index>(i);
    const double unit = i < 3 ? 1.0 : std::sqrt(0.5);  // from Mandel to tensor components
    const std::optional<double>& target = stage.target[i];
    if (!increment.stress_controlled[i]) {
      const double rate = 0.0 - unit * increment.strain_rate[index];
      if (target) {
        parts.add("ε", i, fmt::format("to {}", format_number(0.0 - unit * *target)));
      } else if (rate != 0.0) {
        parts.add("ε", i, fmt::format("{} 1/s", format_number(rate)));
      }
      continue;
    }
    const bool mean = is_mean_condition(stage, index);
    if (!mean && !is_identity_condition(stage, index)) {
      parts.add("σ", i, "at the same rate");
      continue;
    }
    const double rate = 0.0 - kKilopascals * unit * increment.stress_rate[index];
    const std::string value =
        target        ? fmt::format("to {} kPa", format_number(0.0 - kKilopascals * unit * *target))
        : rate == 0.0 ? std::string("held")
                      : fmt::format("{} kPa/s", format_number(rate));
    parts.add(mean ? "p through σ" : "σ", i, value);
  }
  std::string text = parts.text();
  for (std::size_t i = 0; i < 3; ++i) {
    const double spin = increment.spin[static_cast<Eigen::Index>(i)];
    if (spin == 0.0) continue;
    text +=
        fmt::format("{}W{}: {} 1/s", text.empty() ? "" : "; ", kComponentNames[i + 3], format_number(spin));
  }
  return text.empty() ? "all strains held" : text;
}

bool is_hold(const integrators::Stage& stage) {
  for (std::size_t i = 0; i < 6; ++i) {
    const auto index = static_cast<Eigen::Index>(i);
    if (stage.target[i]) return false;
    const auto& increment = stage.increment;
    if ((increment.stress_controlled[i] ? increment.stress_rate[index] : increment.strain_rate[index]) !=
        0.0) {
      return false;
    }
  }
  return stage.increment.spin.isZero(0.0);
}

}  // namespace isotach::reports
