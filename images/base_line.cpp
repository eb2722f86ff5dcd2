// Copyright Isotach contributors. SPDX-License-Identifier: BSD-3-Clause
#include "images/base_line.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <opencv2/imgproc.hpp>
#include <vector>

namespace isotach::images {
namespace {

constexpr double kMargin = 0.08;     // of the width on each side, where no mud is expected
constexpr double kLeastStep = 0.05;  // of the background's light
constexpr double kStepsOverNoise = 6.0;
constexpr double kShareOfHighest = 0.5;
constexpr double kAgreement = 2.0;  // pixels off the line
constexpr double kQuartiles =
    1.349;  // between the quartiles of a normal distribution, in standard deviations

double median_of(std::vector<double> values) {
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

/// A step of the light down a group of columns.
struct Step {
  Eigen::Vector2d at;
  double blur;
};

/// Rows of a group's mean light, and steps in them.
class Column {
 public:
  Column(const cv::Mat3f& relative, int first, int width) : middle_(first + 0.5 * (width - 1)) {
    cv::Mat3f mean;
    cv::reduce(relative.colRange(first, first + width), mean, 1, cv::REDUCE_AVG);
    for (int row = 0; row < mean.rows; ++row) {
      rows_.emplace_back(mean(row, 0)[0], mean(row, 0)[1], mean(row, 0)[2]);
    }
    reach_ = std::max(4, mean.rows / 120);
  }

  [[nodiscard]] std::optional<Step> first_step() const {
    const int count = static_cast<int>(rows_.size());
    std::vector<double> heights;
    for (int row = reach_ + kGap; row < count - reach_ - kGap; ++row) heights.push_back(step(row).norm());
    if (heights.empty()) return {};
    const double highest = *std::max_element(heights.begin(), heights.end());
    if (highest < std::max(kLeastStep, kStepsOverNoise * median_of(heights))) return {};
    for (std::size_t i = 0; i < heights.size(); ++i) {
      if (heights[i] < kShareOfHighest * highest) continue;
      while (i + 1 < heights.size() && heights[i + 1] > heights[i]) ++i;
      return crossing(static_cast<int>(i) + reach_ + kGap);
    }
    return {};
  }

 private:
  static constexpr int kGap = 2;  // rows about an edge that belong to neither side

  [[nodiscard]] Eigen::Vector3d mean(int first, int last) const {
    Eigen::Vector3d sum = Eigen::Vector3d::Zero();
    for (int row = first; row <= last; ++row) sum += rows_[static_cast<std::size_t>(row)];
    return sum / (last - first + 1);
  }
  [[nodiscard]] Eigen::Vector3d above(int row) const { return mean(row - kGap - reach_, row - kGap); }
  [[nodiscard]] Eigen::Vector3d below(int row) const { return mean(row + kGap, row + kGap + reach_); }
  [[nodiscard]] Eigen::Vector3d step(int row) const { return below(row) - above(row); }

  /// Where, near `row`, the light passes a share of the step.
  [[nodiscard]] std::optional<double> row_at(double share, int row) const {
    const Eigen::Vector3d along = step(row);
    const Eigen::Vector3d start = above(row);
    const auto passed = [&](int at) {
      return (rows_[static_cast<std::size_t>(at)] - start).dot(along) / along.squaredNorm();
    };
    for (int at = row - kGap - reach_; at < row + kGap + reach_; ++at) {
      const double a = passed(at);
      const double b = passed(at + 1);
      if (a < share && b >= share) return at + (share - a) / (b - a);
    }
    return {};
  }
  [[nodiscard]] std::optional<Step> crossing(int row) const {
    const auto middle = row_at(0.5, row);
    const auto first = row_at(0.25, row);
    const auto last = row_at(0.75, row);
    if (!middle || !first || !last) return {};
    return Step{{middle_, *middle}, std::max(0.0, *last - *first) / kQuartiles};
  }

  double middle_;
  int reach_ = 0;  // rows that make a side of a step
  std::vector<Eigen::Vector3d> rows_;
};

/// Least squares through the steps that agree with `line`; how many do, on the left and on the right half.
struct Agreement {
  LevelLine line;
  double scatter = 0.0;
  std::vector<double> blurs;
  std::size_t left = 0;
  std::size_t right = 0;
};

Agreement agreement(const std::vector<Step>& steps, const LevelLine& line, double width) {
  Agreement result{line, 0.0, {}, 0, 0};
  double n = 0.0;
  double x = 0.0;
  double y = 0.0;
  double xx = 0.0;
  double xy = 0.0;
  double yy = 0.0;
  for (const Step& step : steps) {
    const double off = step.at.y() - line.row(step.at.x());
    if (std::abs(off) > kAgreement) continue;
    n += 1.0;
    x += step.at.x();
    y += off;
    xx += step.at.x() * step.at.x();
    xy += step.at.x() * off;
    yy += off * off;
    result.blurs.push_back(step.blur);
    ++(step.at.x() < 0.5 * width ? result.left : result.right);
  }
  const double spread = xx - x * x / n;
  if (n < 3.0 || !(spread > 0.0)) return result;
  const double slope = (xy - x * y / n) / spread;
  const double offset = (y - slope * x) / n;
  result.line.left.y() += offset + slope * line.left.x();
  result.line.right.y() += offset + slope * line.right.x();
  result.scatter = std::sqrt(std::max(0.0, yy - offset * y - slope * xy) / n);
  return result;
}

std::optional<GroundLine> refined(const std::vector<Step>& steps, LevelLine line, double width,
                                  std::size_t least_a_side) {
  Agreement found;
  for (int pass = 0; pass < 4; ++pass) {
    found = agreement(steps, line, width);
    line = found.line;
  }
  if (std::min(found.left, found.right) < least_a_side) return {};
  return GroundLine{line, found.scatter, median_of(found.blurs)};
}

}  // namespace

std::optional<GroundLine> ground_line(const cv::Mat3f& relative) {
  const int group = std::max(8, relative.cols / 100);
  const double width = relative.cols;
  std::vector<Step> steps;
  std::vector<double> left_rows;
  std::vector<double> right_rows;
  std::size_t in_a_margin = 0;
  for (int first = 0; first + group <= relative.cols; first += group) {
    const bool left = first + group <= kMargin * width;
    const bool right = first >= (1.0 - kMargin) * width;
    in_a_margin += left ? 1U : 0U;
    const std::optional<Step> step = Column(relative, first, group).first_step();
    if (!step) continue;
    steps.push_back(*step);
    if (left) left_rows.push_back(step->at.y());
    if (right) right_rows.push_back(step->at.y());
  }
  const std::size_t least = std::max<std::size_t>(2, in_a_margin / 2);
  if (std::min(left_rows.size(), right_rows.size()) < least) return {};
  // through the margins' medians, which lie half a margin from the sides
  const double left_row = median_of(left_rows);
  const double slope = (median_of(right_rows) - left_row) / ((1.0 - kMargin) * width);
  const double left = left_row - slope * 0.5 * kMargin * width;
  return refined(steps, {{0.0, left}, {width - 1.0, left + slope * (width - 1.0)}}, width, least);
}

std::optional<GroundLine> line_through(const Polyline& points, double width) {
  constexpr std::size_t kLeast = 10;
  if (points.size() < kLeast) return {};
  Polyline sorted = points;
  std::sort(sorted.begin(), sorted.end(), [](const auto& a, const auto& b) { return a.x() < b.x(); });
  const auto middle_of = [&](std::size_t first, std::size_t last) {
    std::vector<double> columns;
    std::vector<double> rows;
    for (std::size_t i = first; i < last; ++i) {
      columns.push_back(sorted[i].x());
      rows.push_back(sorted[i].y());
    }
    return Eigen::Vector2d(median_of(columns), median_of(rows));
  };
  const Eigen::Vector2d left = middle_of(0, sorted.size() / 2);
  const Eigen::Vector2d right = middle_of(sorted.size() / 2, sorted.size());
  if (!(right.x() > left.x())) return {};
  const LevelLine through{left, right};
  std::vector<Step> steps;
  for (const Eigen::Vector2d& point : sorted) steps.push_back({point, 0.0});
  const LevelLine whole{{0.0, through.row(0.0)}, {width - 1.0, through.row(width - 1.0)}};
  return refined(steps, whole, left.x() + right.x(), sorted.size() / 5);
}

}  // namespace isotach::images
