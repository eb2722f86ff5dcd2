// Copyright Isotach contributors. SPDX-License-Identifier: BSD-3-Clause
#include "images/silhouette.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <opencv2/imgproc.hpp>
#include <string>
#include <vector>

namespace isotach::images {
namespace {

constexpr double kMaskBlur = 1.5;            // pixels, standard deviation: the mask need not be sharp
constexpr double kGreatestDifference = 2.0;  // of the background's light that Otsu's histogram holds
constexpr double kLeastContrast = 0.05;
constexpr double kContrastOverNoise = 5.0;
constexpr double kLeastArea = 0.002;  // of what is looked at
constexpr double kSecondBody = 0.03;  // of the first one's area
constexpr double kEndsLeftOut = 0.1;  // of a lower edge, on each side

/// 1 where a pixel is looked at.
cv::Mat1b looked_at(cv::Size size, const std::optional<LevelLine>& cut, double margin) {
  cv::Mat1b mask(size, 1);
  if (!cut) return mask;
  for (int column = 0; column < size.width; ++column) {
    const int first = std::clamp(static_cast<int>(std::ceil(cut->row(column) - margin)), 0, size.height);
    if (first < size.height) mask.col(column).rowRange(first, size.height) = 0;
  }
  return mask;
}

/// Otsu's threshold of the values where `mask` is set, of values from `least` to `greatest`.
double otsu(const cv::Mat1f& values, const cv::Mat1b& mask, double least, double greatest) {
  std::vector<unsigned char> chosen;
  const double factor = 255.0 / (greatest - least);
  for (int row = 0; row < values.rows; ++row) {
    for (int column = 0; column < values.cols; ++column) {
      if (mask(row, column) == 0) continue;
      chosen.push_back(cv::saturate_cast<unsigned char>(factor * (values(row, column) - least)));
    }
  }
  if (chosen.empty()) return greatest;  // nothing is looked at, and nothing will stand out
  cv::Mat ignored;
  return least +
         (cv::threshold(chosen, ignored, 0.0, 1.0, cv::THRESH_BINARY | cv::THRESH_OTSU) + 0.5) / factor;
}

/// Where `mask` is set, whether the value is above the threshold, or else below.
cv::Mat1b parted(const cv::Mat1f& values, double threshold, const cv::Mat1b& mask, bool above) {
  cv::Mat1b part(values.size());
  std::transform(values.begin(), values.end(), mask.begin(), part.begin(),
                 [=](float value, unsigned char looked) {
                   return static_cast<unsigned char>(looked != 0 && (value > threshold) == above ? 255 : 0);
                 });
  return part;
}

/// How much the light differs, whatever the colour.
cv::Mat1f size_of(const cv::Mat3f& relative) {
  cv::Mat1f size(relative.size());
  std::transform(relative.begin(), relative.end(), size.begin(), [](const cv::Vec3f& pixel) {
    return static_cast<float>(std::min(cv::norm(pixel) / std::sqrt(3.0), kGreatestDifference));
  });
  return size;
}

/// `relative` along the direction in which the two classes lie furthest apart for their scatter (Fisher's,
/// with a diagonal covariance), 0 in the mean of one class and 1 in that of the other.
struct Contrast {
  cv::Mat1f signal;
  double difference = 0.0;  // of the background's light
  double noise = 0.0;       // standard deviation of the background in `signal`
};

Contrast contrast_of(const cv::Mat3f& relative, const cv::Mat1b& mud, const cv::Mat1b& background) {
  cv::Scalar mud_mean;
  cv::Scalar mud_deviation;
  cv::Scalar mean;
  cv::Scalar deviation;
  cv::meanStdDev(relative, mud_mean, mud_deviation, mud);
  cv::meanStdDev(relative, mean, deviation, background);
  cv::Vec3d weights;
  cv::Vec3d offset;
  double scale = 0.0;
  double square = 0.0;
  for (int c = 0; c < 3; ++c) {
    const double difference = mud_mean[c] - mean[c];
    // of the order of a code of 8 bits at least, so that a channel without noise does not rule
    const double variance = std::pow(mud_deviation[c], 2) + std::pow(deviation[c], 2) + 1e-5;
    weights[c] = difference / variance;
    offset[c] = mean[c];
    scale += weights[c] * difference;
    square += difference * difference;
  }
  Contrast contrast{cv::Mat1f(relative.size()), std::sqrt(square / 3.0), 0.0};
  weights = scale > 0.0 ? weights * (1.0 / scale) : cv::Vec3d();
  std::transform(relative.begin(), relative.end(), contrast.signal.begin(), [&](const cv::Vec3f& pixel) {
    return static_cast<float>(weights.dot(cv::Vec3d(pixel) - offset));
  });
  cv::Scalar ignored;
  cv::Scalar noise;
  cv::meanStdDev(contrast.signal, ignored, noise, background);
  contrast.noise = noise[0];
  return contrast;
}

tl::unexpected<Refusal> refused(Refusal::Kind kind, std::string message) {
  return tl::unexpected(Refusal{kind, std::move(message)});
}

/// The largest connected part of the mask, holes filled, as its outer contour.
tl::expected<std::vector<cv::Point>, Refusal> one_body(const cv::Mat1b& mask) {
  std::vector<std::vector<cv::Point>> contours;
  cv::findContours(mask, contours, cv::RETR_EXTERNAL, cv::CHAIN_APPROX_NONE);
  std::vector<std::pair<double, std::size_t>> areas;
  for (std::size_t i = 0; i < contours.size(); ++i) areas.emplace_back(cv::contourArea(contours[i]), i);
  std::sort(areas.rbegin(), areas.rend());
  const double least = kLeastArea * static_cast<double>(mask.total());
  if (areas.empty() || areas.front().first < least) {
    return refused(Refusal::Kind::no_silhouette,
                   fmt::format("nothing larger than {:.0f} pixels stands out from the background", least));
  }
  if (areas.size() > 1 && areas[1].first > kSecondBody * areas[0].first) {
    const cv::Rect second = cv::boundingRect(contours[areas[1].second]);
    return refused(
        Refusal::Kind::several_silhouettes,
        fmt::format("two bodies, the second of {:.0f} % of the first at column {}, row {}; leave it "
                    "out with --region or --ignore",
                    100.0 * areas[1].first / areas[0].first, second.x + second.width / 2,
                    second.y + second.height / 2));
  }
  return contours[areas.front().second];
}

/// The sides of the picture that the body reaches, between commas.
std::string sides_reached(const std::vector<cv::Point>& contour, cv::Size size, bool lower_too) {
  const cv::Rect box = cv::boundingRect(contour);
  std::vector<std::string> sides;
  if (box.x <= 1) sides.emplace_back("left");
  if (box.x + box.width >= size.width - 1) sides.emplace_back("right");
  if (box.y <= 1) sides.emplace_back("upper");
  if (lower_too && box.y + box.height >= size.height - 1) sides.emplace_back("lower");
  return fmt::format("{}", fmt::join(sides, ", "));
}

/// The longest stretch of the closed contour above the line by more than `margin`, from left to right.
Polyline rim_above(const std::vector<cv::Point>& contour, const LevelLine& line, double margin) {
  const auto above = [&](const cv::Point& point) { return point.y < line.row(point.x) - margin; };
  const std::size_t n = contour.size();
  std::size_t start = 0;
  while (start < n && above(contour[start])) ++start;
  std::size_t best = 0;
  std::size_t longest = 0;
  std::size_t length = 0;
  for (std::size_t k = 0; k < n; ++k) {
    const std::size_t i = (start + k) % n;
    length = above(contour[i]) ? length + 1 : 0;
    if (length > longest) {
      longest = length;
      best = i;
    }
  }
  Polyline rim;
  for (std::size_t k = 0; k < longest; ++k) {
    const cv::Point& point = contour[(best + n - k) % n];
    rim.emplace_back(point.x, point.y);
  }
  if (!rim.empty() && rim.front().x() > rim.back().x()) std::reverse(rim.begin(), rim.end());
  return rim;
}

Polyline lower_edge_of(const std::vector<cv::Point>& contour) {
  const cv::Rect box = cv::boundingRect(contour);
  std::vector<int> lowest(static_cast<std::size_t>(box.width), -1);
  for (const cv::Point& point : contour) {
    int& row = lowest[static_cast<std::size_t>(point.x - box.x)];
    row = std::max(row, point.y);
  }
  Polyline edge;
  const auto left_out = static_cast<int>(kEndsLeftOut * box.width);
  for (int column = left_out; column < box.width - left_out; ++column) {
    edge.emplace_back(box.x + column, lowest[static_cast<std::size_t>(column)]);
  }
  return edge;
}

}  // namespace

const char* name_of(Refusal::Kind kind) {
  switch (kind) {
    case Refusal::Kind::no_silhouette:
      return "no-silhouette";
    case Refusal::Kind::cut_by_border:
      return "cut-by-border";
    case Refusal::Kind::several_silhouettes:
      return "several-silhouettes";
    case Refusal::Kind::no_base_line:
      return "no-base-line";
    case Refusal::Kind::not_on_base:
      return "not-on-base";
    case Refusal::Kind::unclear_edge:
      return "unclear-edge";
    case Refusal::Kind::volume:
      return "volume";
  }
  return "";
}

tl::expected<Silhouette, Refusal> find_silhouette(const cv::Mat3f& relative,
                                                  const std::optional<LevelLine>& cut, double margin) {
  const cv::Mat1b looked = looked_at(relative.size(), cut, margin);
  cv::Mat3f soft;
  cv::GaussianBlur(relative, soft, cv::Size(), kMaskBlur);

  const cv::Mat1f difference = size_of(soft);
  const double first_threshold = otsu(difference, looked, 0.0, kGreatestDifference);
  const cv::Mat1b first_mud = parted(difference, first_threshold, looked, true);
  const cv::Mat1b first_background = parted(difference, first_threshold, looked, false);
  const Contrast soft_contrast = contrast_of(soft, first_mud, first_background);
  if (!(soft_contrast.difference >= kLeastContrast) || !(soft_contrast.noise * kContrastOverNoise <= 1.0)) {
    const double scatters = soft_contrast.noise > 0.0 ? 1.0 / soft_contrast.noise : 0.0;
    return refused(
        Refusal::Kind::no_silhouette,
        fmt::format("what differs from the background does so by {:.1f} % of its light, {:.1f} times "
                    "the background's scatter; needed are {:.0f} % and {:.0f} times",
                    100.0 * soft_contrast.difference, scatters, 100.0 * kLeastContrast, kContrastOverNoise));
  }
  constexpr double kOutside = 1.0;  // of the signal below 0 and above 1 that the histogram holds
  const double threshold = otsu(soft_contrast.signal, looked, -kOutside, 1.0 + kOutside);
  cv::Mat1b mask = parted(soft_contrast.signal, threshold, looked, true);
  cv::morphologyEx(mask, mask, cv::MORPH_OPEN, cv::Mat1b::ones(3, 3));

  auto contour = one_body(mask);
  if (!contour) return tl::unexpected(contour.error());
  if (const std::string sides = sides_reached(*contour, relative.size(), !cut.has_value()); !sides.empty()) {
    return refused(
        Refusal::Kind::cut_by_border,
        fmt::format("what stands out from the background reaches a side of what is looked at ({}){}", sides,
                    cut ? "" : "; no base line was seen on both sides of it"));
  }

  const Contrast sharp = contrast_of(relative, first_mud, first_background);
  Silhouette silhouette{sharp.signal, {}, {}, sharp.difference};
  if (!cut) {
    silhouette.lower_edge = lower_edge_of(*contour);
    return silhouette;
  }
  silhouette.rim = rim_above(*contour, *cut, margin + 1.0);
  const bool stands = silhouette.rim.size() < contour->size() && silhouette.rim.size() > 2;
  if (!stands) {
    return refused(Refusal::Kind::not_on_base, "the body does not reach down to the base line");
  }
  return silhouette;
}

}  // namespace isotach::images
