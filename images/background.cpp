// Copyright Isotach contributors. SPDX-License-Identifier: BSD-3-Clause
#include "images/background.hpp"

#include <Eigen/Dense>
#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <opencv2/imgproc.hpp>
#include <vector>

namespace isotach::images {
namespace {

constexpr int kCellsAcross = 200;        // of the coarse picture to which the surface is fitted
constexpr double kDarkest = 1e-4;        // light below which no logarithm is taken
constexpr double kTopMargin = 0.12;      // of the picture's height
constexpr double kSideMargin = 0.08;     // of its width, each
constexpr double kSideMarginTo = 0.5;    // of its height, from the top: the base is below
constexpr double kLeastScatter = 0.004;  // of ln light: of the order of a code of 8 bits
constexpr double kAlike = 3.0;           // scatters within which a cell is background
constexpr double kTukey = 4.685;         // scatters at which the biweight vanishes
constexpr int kReweightings = 16;
constexpr int kAbsolute = 10;  // of them, at first, for the least sum of absolute residuals

int terms_of(int degree) {
  return (degree + 1) * (degree + 2) / 2;
}

/// Monomials of x and y in [-1, 1] up to the degree.
Eigen::VectorXd monomials(double x, double y, int degree) {
  Eigen::VectorXd row(terms_of(degree));
  int k = 0;
  for (int i = 0; i <= degree; ++i) {
    for (int j = 0; i + j <= degree; ++j) row(k++) = std::pow(x, i) * std::pow(y, j);
  }
  return row;
}

double median_of(std::vector<double> values) {
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

/// The surface of one channel.
struct Surface {
  Eigen::VectorXd coefficients;
  double scatter = 0.0;  // of the cells that it was fitted to
};

/// Cells of the coarse picture, their places in [-1, 1].
class Cells {
 public:
  Cells(const cv::Mat3f& light, const cv::Mat1b& ignored) {
    const int columns = std::min(kCellsAcross, light.cols);
    const int rows = std::max(2, light.rows * columns / light.cols);
    cv::resize(light, light_, cv::Size(columns, rows), 0.0, 0.0, cv::INTER_AREA);
    cv::resize(ignored, ignored_, cv::Size(columns, rows), 0.0, 0.0, cv::INTER_AREA);
  }
  [[nodiscard]] int columns() const { return light_.cols; }
  [[nodiscard]] int count() const { return light_.cols * light_.rows; }
  [[nodiscard]] Eigen::Vector2d place(int cell) const {
    return {2.0 * (cell % light_.cols) / (light_.cols - 1.0) - 1.0,
            2.0 * (cell / light_.cols) / (light_.rows - 1.0) - 1.0};
  }
  [[nodiscard]] bool counts(int cell) const { return ignored_(cell / light_.cols, cell % light_.cols) == 0; }
  [[nodiscard]] bool in_margin(int cell) const {
    const double x = (cell % light_.cols + 0.5) / light_.cols;
    const double y = (cell / light_.cols + 0.5) / light_.rows;
    return y < kTopMargin || (y < kSideMarginTo && (x < kSideMargin || x > 1.0 - kSideMargin));
  }
  [[nodiscard]] double log_light(int cell, int channel) const {
    const double value = light_(cell / light_.cols, cell % light_.cols)[channel];
    return std::log(std::max(value, kDarkest));
  }
  [[nodiscard]] cv::Size size() const { return light_.size(); }

 private:
  cv::Mat3f light_;
  cv::Mat1b ignored_;
};

Surface fit(const Cells& cells, const std::vector<int>& chosen, int channel, int degree) {
  const auto n = static_cast<Eigen::Index>(chosen.size());
  Eigen::MatrixXd matrix(n, terms_of(degree));
  Eigen::VectorXd values(n);
  for (Eigen::Index i = 0; i < n; ++i) {
    const int cell = chosen[static_cast<std::size_t>(i)];
    const Eigen::Vector2d at = cells.place(cell);
    matrix.row(i) = monomials(at.x(), at.y(), degree).transpose();
    values(i) = cells.log_light(cell, channel);
  }
  Surface surface;
  Eigen::VectorXd weights = Eigen::VectorXd::Ones(n);
  for (int pass = 0; pass < kReweightings; ++pass) {
    const Eigen::MatrixXd weighted = weights.asDiagonal() * matrix;
    surface.coefficients = (matrix.transpose() * weighted).ldlt().solve(weighted.transpose() * values);
    const Eigen::VectorXd residual = (values - matrix * surface.coefficients).cwiseAbs();
    surface.scatter = std::max(kLeastScatter,
                               1.4826 * median_of(std::vector<double>(residual.data(), residual.data() + n)));
    for (Eigen::Index i = 0; i < n; ++i) {
      const double u = residual(i) / (kTukey * surface.scatter);
      if (pass < kAbsolute) {
        weights(i) =
            1.0 / std::max(residual(i), kLeastScatter);  // swayed by less than half that is not background
      } else {
        weights(i) = u < 1.0 ? (1.0 - u * u) * (1.0 - u * u) : 0.0;
      }
    }
  }
  return surface;
}

using Surfaces = std::array<Surface, 3>;

Surfaces fit_all(const Cells& cells, const std::vector<int>& chosen, int degree) {
  return {fit(cells, chosen, 0, degree), fit(cells, chosen, 1, degree), fit(cells, chosen, 2, degree)};
}

/// Cells that look like the background in every channel.
std::vector<int> alike(const Cells& cells, const Surfaces& surfaces, int degree) {
  std::vector<int> chosen;
  for (int cell = 0; cell < cells.count(); ++cell) {
    if (!cells.counts(cell)) continue;
    const Eigen::Vector2d at = cells.place(cell);
    const Eigen::VectorXd row = monomials(at.x(), at.y(), degree);
    bool background = true;
    for (int channel = 0; channel < 3; ++channel) {
      const Surface& surface = surfaces[static_cast<std::size_t>(channel)];
      const double residual = cells.log_light(cell, channel) - row.dot(surface.coefficients);
      background = background && std::abs(residual) < kAlike * std::max(surface.scatter, 0.01);
    }
    if (background) chosen.push_back(cell);
  }
  return chosen;
}

}  // namespace

cv::Mat3f relative_light(const cv::Mat3f& light, const cv::Mat1b& ignored) {
  const Cells cells(light, ignored);
  std::vector<int> chosen;
  for (int cell = 0; cell < cells.count(); ++cell) {
    if (cells.counts(cell) && cells.in_margin(cell)) chosen.push_back(cell);
  }
  if (chosen.empty()) return {light.size(), cv::Vec3f()};  // all margins are ignored: nothing to compare with
  const std::size_t least = chosen.size() / 2;
  int degree = 1;  // margins alone do not hold the curvature
  Surfaces surfaces = fit_all(cells, chosen, degree);
  for (const int next : {2, 2, 3, 3}) {
    std::vector<int> found = alike(cells, surfaces, degree);
    if (found.size() < std::max<std::size_t>(least, 50)) break;
    chosen = std::move(found);
    degree = next;
    surfaces = fit_all(cells, chosen, degree);
  }

  cv::Mat3f coarse(cells.size());
  for (int cell = 0; cell < cells.count(); ++cell) {
    const Eigen::Vector2d at = cells.place(cell);
    const Eigen::VectorXd row = monomials(at.x(), at.y(), degree);
    for (int channel = 0; channel < 3; ++channel) {
      const double value = row.dot(surfaces[static_cast<std::size_t>(channel)].coefficients);
      // no brighter than light can be: the cubic may run away where only the base is
      coarse(cell / cells.columns(), cell % cells.columns())[channel] =
          static_cast<float>(std::exp(std::clamp(value, std::log(kDarkest), 0.7)));
    }
  }
  cv::Mat3f background;
  cv::resize(coarse, background, light.size(), 0.0, 0.0, cv::INTER_CUBIC);
  cv::Mat3f relative;
  cv::divide(light, background, relative);
  relative -= cv::Scalar::all(1.0);
  relative.setTo(cv::Scalar::all(0.0), ignored);
  return relative;
}

}  // namespace isotach::images
