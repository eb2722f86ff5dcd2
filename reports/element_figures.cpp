// Copyright Isotach contributors. SPDX-License-Identifier: BSD-3-Clause
// Stress-strain curves, paths and histories of an element test.
#include "reports/element_figures.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "reports/element_holds.hpp"
#include "reports/stress_plane.hpp"
#include "reports/time_axis.hpp"

namespace isotach::reports {
namespace {

using Column = ElementCurve::Column;

constexpr double kPercent = 100.0;
constexpr double kShape = 0.85;  // height to width of a frame
constexpr double kNoStrain = 1e-9;
constexpr double kNoStress = 1e-6;         // kPa
constexpr std::size_t kStagesMarked = 10;  // more marks than this hide the curve
const Rgb kReference{90, 101, 112};

Column scaled(Column column, double factor) {
  for (double& value : column) value *= factor;
  return column;
}

Series line(std::string label, Column x, Column y) {
  Series series;
  series.label = std::move(label);
  series.x = std::move(x);
  series.y = std::move(y);
  return series;
}

Series reference(std::string label, SeriesStyle style, Column x, Column y) {
  Series series = line(std::move(label), std::move(x), std::move(y));
  series.style = style;
  series.colour = kReference;
  return series;
}

Figure empty_figure(std::string caption, Axis x, Axis y) {
  Figure figure;
  figure.caption = std::move(caption);
  figure.x = std::move(x);
  figure.y = std::move(y);
  figure.height_to_width = kShape;
  return figure;
}

/// The strain that drives the test as an abscissa: percent, engineering shear.
struct Abscissa {
  std::string label;
  std::string key;
  Column values;
};

Abscissa driven_strain(const ElementCurve& curve) {
  const std::string_view name = kComponentNames[curve.driven];
  if (curve.driven < 3) {
    return {fmt::format("strain ε{} (%)", name), fmt::format("strain_{}_percent", name),
            scaled(curve.strain[curve.driven], kPercent)};
  }
  return {fmt::format("shear strain γ{} (%)", name), fmt::format("gamma_{}_percent", name),
          scaled(curve.strain[curve.driven], 2.0 * kPercent)};
}

std::string stress_name(std::size_t component) {
  return fmt::format("{}{}", component < 3 ? "σ" : "τ", kComponentNames[component]);
}

/// Whether two components are one line.
bool coincide(const Column& a, const Column& b) {
  double largest = 0.0;
  double difference = 0.0;
  for (std::size_t i = 0; i < a.size(); ++i) {
    largest = std::max(largest, std::abs(a[i]));
    difference = std::max(difference, std::abs(a[i] - b[i]));
  }
  return difference <= 1e-6 * largest;
}

/// The components of a tensor that are drawn, those that coincide as one line.
template <class Name, class Wanted>
std::vector<Series> tensor_series(const std::array<Column, 6>& tensor, const Column& x, double factor,
                                  const Name& name, const Wanted& wanted) {
  std::vector<Series> series;
  std::array<bool, 6> drawn{};
  for (std::size_t i = 0; i < 6; ++i) {
    if (drawn[i] || !wanted(i)) continue;
    std::string label = name(i);
    for (std::size_t j = i + 1; j < 6; ++j) {
      if (drawn[j] || !wanted(j) || !coincide(tensor[i], tensor[j])) continue;
      drawn[j] = true;
      label += " = " + name(j);
    }
    series.push_back(line(std::move(label), x, scaled(tensor[i], factor)));
  }
  return series;
}

/// The normal stresses, and the shear stresses that are not zero all along.
std::vector<Series> stress_series(const ElementCurve& curve, const Column& x) {
  return tensor_series(curve.stress, x, 1.0, stress_name, [&](std::size_t i) {
    return i < 3 || std::abs(curve.stress[i].front()) > kNoStress || changes(curve.stress[i], kNoStress);
  });
}

ElementFigure stress_strain(const ElementCurve& curve) {
  const Abscissa strain = driven_strain(curve);
  ElementFigure drawn{"stress_strain", strain.key, "stress_kPa", {}};
  if (curve.driven < 3 && !curve.oedometric) {
    drawn.figure = empty_figure("Deviatoric and mean stress against strain.", {.label = strain.label},
                                {.label = "stress (kPa)"});
    drawn.figure.series = {line("q", strain.values, curve.q), line("p", strain.values, curve.p)};
  } else {
    drawn.figure = empty_figure("Stress against strain.", {.label = strain.label}, {.label = "stress (kPa)"});
    drawn.figure.series = stress_series(curve, strain.values);
  }
  return drawn;
}

ElementFigure lateral_stress_ratio(const ElementCurve& curve) {
  const Abscissa strain = driven_strain(curve);
  Column ratio;
  const std::size_t lateral = (curve.driven + 1) % 3;
  for (std::size_t i = 0; i < curve.size(); ++i) {
    ratio.push_back(curve.stress[lateral][i] / curve.stress[curve.driven][i]);
  }
  ElementFigure drawn{
      "lateral_stress_ratio", strain.key, "K0",
      empty_figure("Ratio of lateral to axial stress.", {.label = strain.label},
                   {.label = fmt::format("K0 = {}/{}", stress_name(lateral), stress_name(curve.driven))})};
  drawn.figure.series = {line("", strain.values, std::move(ratio))};
  return drawn;
}

ElementFigure volume_strain(const ElementCurve& curve) {
  const Abscissa strain = driven_strain(curve);
  ElementFigure drawn{
      "volumetric_strain", strain.key, "volumetric_strain_percent",
      empty_figure("Volumetric strain, compression positive, against strain.", {.label = strain.label},
                   {.label = "volumetric strain (%)", .reversed = true})};
  drawn.figure.series = {line("", strain.values, scaled(curve.volumetric_strain, kPercent))};
  return drawn;
}

ElementFigure stress_ratio(const ElementCurve& curve, const StressPlane& plane) {
  const Abscissa strain = driven_strain(curve);
  Column ratio;
  for (std::size_t i = 0; i < curve.size(); ++i) ratio.push_back(curve.q[i] / curve.p[i]);
  ElementFigure drawn{"stress_ratio", strain.key, "q_over_p",
                      empty_figure("Stress ratio against strain, and that of the critical state.",
                                   {.label = strain.label}, {.label = "q/p"})};
  drawn.figure.series = {line("", strain.values, std::move(ratio))};
  const bool extends = std::any_of(curve.q.begin(), curve.q.end(), [](double q) { return q < 0.0; });
  drawn.figure.markers.push_back(
      {MarkerLine::Direction::horizontal, plane.compression_ratio(), "M in triaxial compression"});
  if (extends) {
    drawn.figure.markers.push_back(
        {MarkerLine::Direction::horizontal, -plane.extension_ratio(), "in triaxial extension"});
  }
  return drawn;
}

ElementFigure stress_path(const datasets::ElementFile& test, const ElementCurve& curve,
                          const StressPlane& plane) {
  const bool extends = std::any_of(curve.q.begin(), curve.q.end(), [](double q) { return q < 0.0; });
  const auto omega = test.start.omega;
  const PlaneCurve ellipse =
      plane.ellipse(curve.p_B.front(), omega, curve.axis.value_or(0), curve.axis && extends);
  double p_max = *std::max_element(ellipse.p.begin(), ellipse.p.end());
  for (const double p : curve.p) p_max = std::max(p_max, p);
  std::string caption = fmt::format(
      "Path of effective stress{}, critical state (M = {:.3f} in triaxial compression, {:.3f} in extension), "
      "and "
      "the ellipse of the initial preconsolidation pressure p_B = {:.4g} kPa.",
      curve.axis ? "" : " (q = √(3/2) |T*|, without sign)", plane.compression_ratio(),
      plane.extension_ratio(), curve.p_B.front());
  ElementFigure drawn{
      "stress_path", "p_kPa", "q_kPa",
      empty_figure(std::move(caption), {.label = "p (kPa)", .min = 0.0}, {.label = "q (kPa)"})};
  Figure& figure = drawn.figure;
  figure.equal_aspect = true;
  figure.series.push_back(line("path", curve.p, curve.q));
  figure.series.push_back(reference("critical state", SeriesStyle::dashed, {0.0, p_max},
                                    {0.0, plane.compression_ratio() * p_max}));
  const double extension = (curve.axis ? -1.0 : 1.0) * plane.extension_ratio();
  if (extends || !curve.axis) {
    Series lower =
        reference("critical state in extension", SeriesStyle::dashed, {0.0, p_max}, {0.0, extension * p_max});
    lower.in_legend = false;
    figure.series.push_back(std::move(lower));
  }
  figure.series.push_back(reference("initial ellipse", SeriesStyle::dotted, ellipse.p, ellipse.q));
  figure.series.push_back({.label = "start",
                           .style = SeriesStyle::points,
                           .x = {curve.p.front()},
                           .y = {curve.q.front()},
                           .colour = palette_colour(0)});
  return drawn;
}

ElementFigure compression_path(const datasets::ElementFile& test, const ElementCurve& curve) {
  ElementFigure drawn{
      "compression_path", "stress_kPa", "void_ratio",
      empty_figure("Void ratio against stress, and p_B, to which p comes at OCR = 1 under isotropic "
                   "stress.",
                   {.label = "stress (kPa)", .logarithmic = true}, {.label = "void ratio e"})};
  Figure& figure = drawn.figure;
  figure.series.push_back(line("p", curve.p, curve.void_ratio));
  double least = *std::min_element(curve.p.begin(), curve.p.end());
  double greatest = *std::max_element(curve.p.begin(), curve.p.end());
  if (curve.oedometric) {
    const Column& axial = curve.stress[curve.driven];
    figure.series.push_back(line(stress_name(curve.driven), axial, curve.void_ratio));
    greatest = std::max(greatest, *std::max_element(axial.begin(), axial.end()));
  }
  // no further than the void ratios of the path ask for
  const model::Law<double> law(test.material);
  const auto [densest, loosest] = std::minmax_element(curve.void_ratio.begin(), curve.void_ratio.end());
  least = std::min(least, 1e-3 * law.preconsolidation_pressure(*loosest));
  greatest = std::max(greatest, 1e-3 * law.preconsolidation_pressure(*densest));
  Column pressure;
  Column void_ratio;
  constexpr int kPoints = 40;
  for (int i = 0; i <= kPoints; ++i) {
    const double p = least * std::pow(greatest / least, static_cast<double>(i) / kPoints);
    const double e = law.void_ratio_at(1e3 * p);
    if (!(e > 0.0)) break;
    pressure.push_back(p);
    void_ratio.push_back(e);
  }
  figure.series.push_back(reference("p_B", SeriesStyle::dashed, std::move(pressure), std::move(void_ratio)));
  return drawn;
}

/// Where stages begin, as marks; none where they are too many.
void mark_stages(Figure& figure, const datasets::ElementFile& test, double unit) {
  if (test.stages.size() < 2 || test.stages.size() > kStagesMarked) return;
  double begin = 0.0;
  for (std::size_t i = 0; i + 1 < test.stages.size(); ++i) {
    begin += test.stages[i].increment.duration;
    figure.markers.push_back({MarkerLine::Direction::vertical, begin / unit, ""});
  }
}

std::vector<ElementFigure> histories(const datasets::ElementFile& test, const ElementCurve& curve) {
  const TimeUnit unit = time_unit_for(curve.time.back());
  const Axis time_axis{.label = fmt::format("time ({})", unit.name)};
  const std::string key = fmt::format("time_{}", unit.name);
  const Column time = scaled(curve.time, 1.0 / unit.seconds);
  std::vector<ElementFigure> figures;
  const auto add = [&](const char* name, const char* y_key, const char* caption, const char* label,
                       std::vector<Series> series) {
    ElementFigure drawn{name, key, y_key, empty_figure(caption, time_axis, {.label = label})};
    drawn.figure.series = std::move(series);
    mark_stages(drawn.figure, test, unit.seconds);
    figures.push_back(std::move(drawn));
  };
  add("stress_history", "stress_kPa",
      test.stages.size() > 1 && test.stages.size() <= kStagesMarked
          ? "Stresses in time; dotted: a stage begins."
          : "Stresses in time.",
      "stress (kPa)", stress_series(curve, time));
  std::vector<Series> strains = tensor_series(
      curve.strain, time, kPercent, [](std::size_t i) { return fmt::format("ε{}", kComponentNames[i]); },
      [&](std::size_t i) { return changes(curve.strain[i], kNoStrain); });
  if (!strains.empty()) {
    add("strain_history", "strain_percent", "Strains in time (shear as tensor components).", "strain (%)",
        std::move(strains));
  }
  if (changes(curve.void_ratio, kNoStrain)) {
    add("void_ratio_history", "void_ratio", "Void ratio in time.", "void ratio e",
        {line("", time, curve.void_ratio)});
  }
  add("ocr_history", "ocr",
      "Overconsolidation ratio p_B/p_B+ in time: below 1 the soil creeps faster than D_r.", "OCR",
      {line("", time, curve.ocr)});
  std::vector<Series> omegas = tensor_series(
      curve.omega, time, 1.0, [](std::size_t i) { return fmt::format("Ω{}", kComponentNames[i]); },
      [&](std::size_t i) { return curve.omega[i].front() != 0.0 || changes(curve.omega[i], 0.0); });
  if (!omegas.empty()) {
    add("fabric_history", "omega", "Anisotropy tensor in time, with the sign of σ*/p.", "Ω",
        std::move(omegas));
  }
  return figures;
}

}  // namespace

std::vector<ElementFigures> element_figures(const datasets::ElementFile& test, const ElementCurve& curve) {
  const StressPlane plane(test.material);
  std::vector<ElementFigures> groups;
  if (changes(curve.strain[curve.driven], kNoStrain)) {
    ElementFigures group{"Stress and strain", {stress_strain(curve)}};
    if (curve.oedometric) {
      group.figures.push_back(lateral_stress_ratio(curve));
    } else if (changes(curve.volumetric_strain, kNoStrain)) {
      group.figures.push_back(volume_strain(curve));
    } else {
      group.figures.push_back(stress_ratio(curve, plane));
    }
    groups.push_back(std::move(group));
  }
  groups.push_back({"Paths", {stress_path(test, curve, plane), compression_path(test, curve)}});
  if (auto holds = hold_figures(test, curve); !holds.empty()) {
    groups.push_back({"Holds, in the logarithm of their time", std::move(holds)});
  }
  groups.push_back({"In time", histories(test, curve)});
  return groups;
}

}  // namespace isotach::reports
