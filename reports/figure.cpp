// Copyright Isotach contributors. SPDX-License-Identifier: BSD-3-Clause
// Checking of figures, the palette, and the way from figures to SVG.
#include "reports/figure.hpp"

#include <fmt/format.h>

#include <array>
#include <stdexcept>
#include <string_view>

#include "reports/axis_scale.hpp"
#include "reports/figure_script.hpp"
#include "reports/gnuplot.hpp"
#include "reports/svg.hpp"

namespace isotach::reports {
namespace {

void check(const Axis& axis, const char* name) {
  for (const std::optional<double>& bound : {axis.min, axis.max}) {
    if (bound && !can_show(axis, *bound)) {
      throw std::invalid_argument(fmt::format("figure: {} is no bound for the {} axis", *bound, name));
    }
  }
  if (axis.min && axis.max && *axis.min >= *axis.max) {
    throw std::invalid_argument(
        fmt::format("figure: the {} axis cannot go from {} to {}", name, *axis.min, *axis.max));
  }
}

void check(const Figure& figure) {
  check(figure.x, "x");
  check(figure.y, "y");
  if (figure.equal_aspect && (figure.x.logarithmic || figure.y.logarithmic)) {
    throw std::invalid_argument("figure: equal aspect means nothing on a logarithmic axis");
  }
  if (!(figure.height_to_width >= 0.1 && figure.height_to_width <= 2.0)) {
    throw std::invalid_argument(
        fmt::format("figure: height_to_width is {}, not from 0.1 to 2", figure.height_to_width));
  }
  for (const Series& series : figure.series) {
    const std::size_t count = series.x.size();
    if (series.y.size() != count || (!series.y_error.empty() && series.y_error.size() != count)) {
      throw std::invalid_argument(fmt::format("figure: series '{}' has {} x, {} y and {} errors",
                                              series.label, count, series.y.size(), series.y_error.size()));
    }
  }
}

/// The SVG documents that gnuplot wrote one behind the other.
std::vector<std::string_view> split(std::string_view output) {
  constexpr std::string_view kStart = "<?xml";
  std::vector<std::string_view> documents;
  std::size_t start = output.find(kStart);
  while (start != std::string_view::npos) {
    const std::size_t next = output.find(kStart, start + kStart.size());
    documents.push_back(output.substr(start, next == std::string_view::npos ? next : next - start));
    start = next;
  }
  return documents;
}

}  // namespace

Rgb palette_colour(std::size_t index) {
  static constexpr std::array<Rgb, 7> kPalette = {{{0, 114, 178},
                                                   {213, 94, 0},
                                                   {0, 158, 115},
                                                   {204, 121, 167},
                                                   {230, 159, 0},
                                                   {86, 180, 233},
                                                   {0, 0, 0}}};
  return kPalette[index % kPalette.size()];
}

std::vector<std::string> render_svgs(std::span<const Figure> figures, int first_number) {
  if (figures.empty()) return {};
  std::string script;
  for (const Figure& figure : figures) {
    check(figure);
    script += figure_script(figure);
  }
  const std::string output = run_gnuplot(script);
  const std::vector<std::string_view> documents = split(output);
  if (documents.size() != figures.size()) {
    throw std::runtime_error(
        fmt::format("gnuplot wrote {} figures instead of {}", documents.size(), figures.size()));
  }
  std::vector<std::string> svgs;
  svgs.reserve(figures.size());
  for (std::size_t i = 0; i < figures.size(); ++i) {
    const Figure& figure = figures[i];
    const std::string prefix = fmt::format("figure-{}-", first_number + static_cast<int>(i));
    svgs.push_back(inline_svg(documents[i], prefix, figure.title.empty() ? figure.caption : figure.title));
  }
  return svgs;
}

std::string render_svg(const Figure& figure, int number) {
  return render_svgs({&figure, 1}, number).front();
}

}  // namespace isotach::reports
