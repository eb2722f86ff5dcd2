// Copyright Isotach contributors. SPDX-License-Identifier: BSD-3-Clause
#include "images/overlay.hpp"

#include <algorithm>
#include <cmath>
#include <opencv2/imgcodecs.hpp>
#include <opencv2/imgproc.hpp>
#include <stdexcept>

namespace isotach::images {
namespace {

constexpr int kFractionBits = 4;  // of the places that OpenCV draws at
constexpr int kJpegQuality = 85;
constexpr int kColumnsPerPixelOfLine = 1200;
const cv::Scalar kOrange(0, 94, 213);  // blue, green, red
const cv::Scalar kBlue(178, 114, 0);
const cv::Scalar kGreen(115, 158, 0);
const cv::Scalar kMagenta(167, 121, 204);
const cv::Scalar kWhite(255, 255, 255);

/// A line between places in the whole picture, drawn into it made smaller by `factor`.
class Pen {
 public:
  Pen(cv::Mat3b& canvas, double factor)
      : canvas_(canvas), factor_(factor), thickness_(1 + canvas.cols / kColumnsPerPixelOfLine) {}
  void line(const Eigen::Vector2d& from, const Eigen::Vector2d& to, const cv::Scalar& colour) const {
    cv::line(canvas_, place(from), place(to), colour, thickness_, cv::LINE_AA, kFractionBits);
  }
  void line(const LevelLine& level, const cv::Scalar& colour) const { line(level.left, level.right, colour); }

 private:
  [[nodiscard]] cv::Point place(const Eigen::Vector2d& at) const {
    // the middle of the first pixel is at 0 in both sizes
    const Eigen::Vector2d scaled = ((at.array() + 0.5) * factor_ - 0.5) * (1 << kFractionBits);
    return {static_cast<int>(std::lround(scaled.x())), static_cast<int>(std::lround(scaled.y()))};
  }

  cv::Mat3b& canvas_;
  double factor_;
  int thickness_;
};

cv::Mat3b drawn(const Picture& picture, const Marks& marks, double factor) {
  cv::Mat3b canvas;
  if (factor < 1.0) {
    cv::resize(picture.codes, canvas, cv::Size(), factor, factor, cv::INTER_AREA);
  } else {
    canvas = picture.codes.clone();
  }
  const Pen pen(canvas, factor);
  if (marks.cut && marks.base &&
      std::max(marks.base->left.y() - marks.cut->left.y(), marks.base->right.y() - marks.cut->right.y()) >
          1.0) {
    pen.line(*marks.cut, kMagenta);
  }
  if (marks.base) pen.line(*marks.base, kGreen);
  if (marks.axis) pen.line(marks.axis->first, marks.axis->second, kWhite);
  double middle = 0.5 * picture.codes.cols;
  if (marks.axis) middle = marks.axis->second.x();
  for (std::size_t i = 1; i < marks.edge.size(); ++i) {
    pen.line(marks.edge[i - 1], marks.edge[i], marks.edge[i].x() < middle ? kOrange : kBlue);
  }
  return canvas;
}

EncodedPicture encoded(const cv::Mat3b& canvas, const char* suffix, const std::vector<int>& options) {
  EncodedPicture result{{}, canvas.cols, canvas.rows};
  if (!cv::imencode(suffix, canvas, result.bytes, options)) {
    throw std::runtime_error("OpenCV cannot write a picture");
  }
  return result;
}

}  // namespace

EncodedPicture overlay_png(const Picture& picture, const Marks& marks) {
  return encoded(drawn(picture, marks, 1.0), ".png", {});
}

EncodedPicture overlay_jpeg(const Picture& picture, const Marks& marks, int most_columns) {
  const double factor = std::min(1.0, static_cast<double>(most_columns) / picture.codes.cols);
  return encoded(drawn(picture, marks, factor), ".jpg", {cv::IMWRITE_JPEG_QUALITY, kJpegQuality});
}

}  // namespace isotach::images
