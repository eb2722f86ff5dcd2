// Copyright Isotach contributors. SPDX-License-Identifier: BSD-3-Clause
// Series and ranges of compression curves.
#include "reports/compression_figures.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "reports/fit_sections.hpp"
#include "reports/number.hpp"

namespace isotach::reports {
namespace {

constexpr Rgb kGrey{150, 150, 150};
constexpr double kRoom = 0.17;    // of the width (in ln stress), right of the data, for the isotachs' rates
constexpr double kLabel = 0.09;   // of the same, what a rate takes of it
constexpr double kMargin = 0.05;  // of the height
constexpr double kLabelHeight = 0.045;
constexpr int kIsotachPoints = 40;

/// What is shown of the plane of stress and void ratio.
struct Window {
  double least_stress;     // kPa
  double greatest_stress;  // kPa
  double least_void_ratio;
  double greatest_void_ratio;
};

Window window_of(const CompressionCurve& measured, const CompressionCurve& model) {
  Window window{HUGE_VAL, 0.0, HUGE_VAL, -HUGE_VAL};
  for (const CompressionCurve* curve : {&measured, &model}) {
    for (std::size_t i = 0; i < curve->stress.size(); ++i) {
      window.least_stress = std::min(window.least_stress, curve->stress[i]);
      window.greatest_stress = std::max(window.greatest_stress, curve->stress[i]);
      window.least_void_ratio = std::min(window.least_void_ratio, curve->void_ratio[i]);
      window.greatest_void_ratio = std::max(window.greatest_void_ratio, curve->void_ratio[i]);
    }
  }
  const double width = std::max(0.1, std::log(window.greatest_stress / window.least_stress));
  window.least_stress *= std::exp(-kMargin * width);
  window.greatest_stress *= std::exp(kRoom * width);
  const double height = std::max(1e-3, window.greatest_void_ratio - window.least_void_ratio);
  window.least_void_ratio -= kMargin * height;
  window.greatest_void_ratio += kMargin * height;
  return window;
}

std::string rate_text(double rate) {
  std::string text = format_number(rate, 1);
  if (text.starts_with("1×")) text.erase(0, std::string("1×").size());
  return text + " /s";
}

/// Isotachs as far as the window shows them, with their rates at their ends on the right.
void add_isotachs(Figure& figure, const TestView& view, Window& window) {
  constexpr double kPascals = 1e3;  // in a kPa
  const double last_stress =
      window.greatest_stress * std::pow(window.least_stress / window.greatest_stress, kLabel);
  // the lines go on to the right, so the window has to go down with them
  for (const integrators::Isotach& isotach : view.isotachs) {
    const double end = view.void_ratio_on(isotach, kPascals * last_stress);
    const double height = window.greatest_void_ratio - window.least_void_ratio;
    window.least_void_ratio = std::min(window.least_void_ratio, end - 0.3 * kMargin * height);
  }
  const double height = window.greatest_void_ratio - window.least_void_ratio;
  double last_label = HUGE_VAL;
  bool first = true;
  // from the fastest, which lies highest
  for (auto isotach = view.isotachs.rbegin(); isotach != view.isotachs.rend(); ++isotach) {
    Series series{.label = first ? "isotachs of the model" : "",
                  .style = SeriesStyle::thin_dashed,
                  .colour = kGrey,
                  .in_legend = first};
    first = false;
    for (int i = 0; i <= kIsotachPoints; ++i) {
      const double stress = window.least_stress * std::pow(last_stress / window.least_stress,
                                                           static_cast<double>(i) / kIsotachPoints);
      const double void_ratio = view.void_ratio_on(*isotach, kPascals * stress);
      if (void_ratio > window.greatest_void_ratio) continue;
      series.x.push_back(stress);
      series.y.push_back(void_ratio);
    }
    if (series.x.empty()) continue;
    if (last_label - series.y.back() > kLabelHeight * height) {
      last_label = series.y.back();
      figure.annotations.push_back({.x = series.x.back(),
                                    .y = series.y.back(),
                                    .text = fmt::format(" {}", rate_text(isotach->axial_strain_rate()))});
    }
    figure.series.push_back(std::move(series));
  }
}

std::string caption_of(const TestView& view) {
  std::string caption =
      fmt::format("{}: {}. {}; line: {}. Root mean square of the residuals: {} times the noise.",
                  title_of(view.summary), view.stepwise() ? "ends of the load steps" : "compression curve",
                  view.stepwise() ? "Discs: measured" : "Dots: measured",
                  view.summary.held_out ? "predicted, not fitted" : "model, fitted",
                  format_number(view.summary.rms_over_noise, 3));
  if (!view.isotachs.empty()) {
    caption +=
        " Dashed: isotachs, lines of steady oedometric compression at strain rates a decade apart, as said "
        "at their right ends.";
  }
  if (std::abs(view.drawn_over_law - 1.0) > 1e-9 && !view.isotachs.empty()) {
    caption += fmt::format(
        " The void ratio that the law works with follows from the overconsolidation ratio of the start; the "
        "isotachs are drawn at {} times its 1 + e, to lie right beside the measured void ratios.",
        format_number(view.drawn_over_law, 5));
  }
  return caption;
}

/// The figure in void ratio.
Figure compression_figure(const TestView& view) {
  Figure figure;
  figure.title = title_of(view.summary);
  figure.caption = caption_of(view);
  figure.x = {.label = "axial effective stress (kPa)", .logarithmic = true};
  figure.y = {.label = "void ratio"};
  figure.height_to_width = 0.46;
  CompressionCurve measured = measured_curve(view);
  CompressionCurve model = model_curve(view);
  Window window = window_of(measured, model);
  add_isotachs(figure, view, window);
  figure.series.push_back({.label = view.summary.held_out ? "model, predicted" : "model, fitted",
                           .x = std::move(model.stress),
                           .y = std::move(model.void_ratio),
                           .colour = palette_colour(1)});
  figure.series.push_back({.label = "measured",
                           .style = view.stepwise() ? SeriesStyle::discs : SeriesStyle::dots,
                           .x = std::move(measured.stress),
                           .y = std::move(measured.void_ratio),
                           .colour = palette_colour(0)});
  figure.x.min = window.least_stress;
  figure.x.max = window.greatest_stress;
  figure.y.min = window.least_void_ratio;
  figure.y.max = window.greatest_void_ratio;
  return figure;
}

}  // namespace

Figure void_ratio_figure(const TestView& view) {
  return compression_figure(view);
}

Figure strain_figure(const TestView& view) {
  constexpr double kPercent = 100.0;
  Figure figure = compression_figure(view);
  figure.caption = fmt::format("{}: the same as axial strain, (H0 − H)/H0.", title_of(view.summary));
  const auto strain = [&](double void_ratio) { return kPercent * view.strain_of_void_ratio(void_ratio); };
  for (Series& series : figure.series) {
    for (double& y : series.y) y = strain(y);
  }
  for (Annotation& annotation : figure.annotations) annotation.y = strain(annotation.y);
  const Axis void_ratio = figure.y;
  figure.y = {.label = "axial strain (%)",
              .reversed = true,
              .min = strain(*void_ratio.max),
              .max = strain(*void_ratio.min)};
  return figure;
}

Figure overview_figure(std::span<const TestView> views) {
  Figure figure;
  figure.caption = "Compression curves of all tests. Dots: measured; lines: model.";
  figure.x = {.label = "axial effective stress (kPa)", .logarithmic = true};
  figure.y = {.label = "void ratio"};
  figure.height_to_width = 0.2;
  constexpr Rgb kBlack{0, 0, 0};
  for (std::size_t i = 0; i < views.size(); ++i) {
    CompressionCurve model = model_curve(views[i]);
    figure.series.push_back({.label = "model",
                             .x = std::move(model.stress),
                             .y = std::move(model.void_ratio),
                             .colour = kBlack,
                             .in_legend = i == 0});
  }
  for (std::size_t i = 0; i < views.size(); ++i) {
    CompressionCurve measured = measured_curve(views[i]);
    figure.series.push_back({.label = title_of(views[i].summary),
                             .style = views[i].stepwise() ? SeriesStyle::discs : SeriesStyle::dots,
                             .x = std::move(measured.stress),
                             .y = std::move(measured.void_ratio),
                             .colour = palette_colour(i)});
  }
  return figure;
}

}  // namespace isotach::reports
