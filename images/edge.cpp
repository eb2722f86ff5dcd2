// Copyright Isotach contributors. SPDX-License-Identifier: BSD-3-Clause
#include "images/edge.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <vector>

namespace isotach::images {
namespace {

constexpr double kReach = 8.0;            // pixels, half the length of a normal's profile
constexpr double kLevelFrom = 4.0;        // pixels off the edge from which levels are read
constexpr double kStep = 0.25;            // pixels
constexpr int kBeside = 2;                // pixels along the rim, to each side
constexpr double kLeastContrast = 0.35;   // of the contrast of mud and background
constexpr std::size_t kLeastSamples = 5;  // of a level
constexpr double kNormalsReach = 2.5;     // pixels, smoothing before normals are taken
constexpr double kFinalReach = 1.5;       // pixels
constexpr int kNeighbours = 7;            // points on each side that vouch for one
constexpr double kQuartiles =
    1.349;  // between the quartiles of a normal distribution, in standard deviations

double median_of(std::vector<double>& values) {
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

/// The signal between pixels.
class Field {
 public:
  Field(const cv::Mat1f& signal, const std::optional<LevelLine>& cut) : signal_(signal), cut_(cut) {}
  /// Empty outside of the picture and below the cut.
  [[nodiscard]] std::optional<double> at(const Eigen::Vector2d& place) const {
    const double column = std::floor(place.x());
    const double row = std::floor(place.y());
    if (column < 0.0 || row < 0.0 || column + 1.0 >= signal_.cols || row + 1.0 >= signal_.rows) return {};
    if (cut_ && place.y() > cut_->row(place.x())) return {};
    const double u = place.x() - column;
    const double v = place.y() - row;
    const float* upper = signal_[static_cast<int>(row)] + static_cast<int>(column);
    const float* lower = signal_[static_cast<int>(row) + 1] + static_cast<int>(column);
    return static_cast<double>(upper[0]) * (1.0 - u) * (1.0 - v) +
           static_cast<double>(upper[1]) * u * (1.0 - v) + static_cast<double>(lower[0]) * (1.0 - u) * v +
           static_cast<double>(lower[1]) * u * v;
  }

 private:
  const cv::Mat1f& signal_;
  const std::optional<LevelLine>& cut_;
};

/// The signal along a normal, outwards, and the levels that it runs between.
struct Profile {
  std::vector<double> places;  // pixels outwards
  std::vector<double> values;
  std::optional<double> inside{};
  std::optional<double> outside{};
};

Profile profile_at(const Field& field, const Eigen::Vector2d& point, const Eigen::Vector2d& along) {
  const Eigen::Vector2d outwards(along.y(), -along.x());
  Profile profile;
  std::vector<double> inner;
  std::vector<double> outer;
  const int steps = static_cast<int>(std::lround(kReach / kStep));
  for (int k = -steps; k <= steps; ++k) {
    const double u = kStep * k;
    double sum = 0.0;
    int count = 0;
    for (int side = -kBeside; side <= kBeside; ++side) {
      const auto value = field.at(point + u * outwards + side * along);
      if (!value) continue;
      sum += *value;
      ++count;
    }
    if (count == 0) continue;
    const double mean = sum / count;
    profile.places.push_back(u);
    profile.values.push_back(mean);
    if (u <= -kLevelFrom) inner.push_back(mean);
    if (u >= kLevelFrom) outer.push_back(mean);
  }
  if (inner.size() >= kLeastSamples) profile.inside = median_of(inner);
  if (outer.size() >= kLeastSamples) profile.outside = median_of(outer);
  return profile;
}

/// Place, nearest to the rim, where the profile falls through `level`.
std::optional<double> fall_through(const Profile& profile, double level) {
  std::optional<double> nearest;
  for (std::size_t i = 0; i + 1 < profile.values.size(); ++i) {
    const double a = profile.values[i];
    const double b = profile.values[i + 1];
    if (!(a >= level && b < level)) continue;
    const double at = profile.places[i] + (profile.places[i + 1] - profile.places[i]) * (a - level) / (a - b);
    if (!nearest || std::abs(at) < std::abs(*nearest)) nearest = at;
  }
  return nearest;
}

/// Levels that could not be read, as at the foot of a flat slope, are those of the nearest neighbour.
void fill_levels(std::vector<Profile>& profiles, std::optional<double> Profile::*level) {
  const auto fill = [level](Profile& profile, std::optional<double>& last) {
    if (profile.*level) {
      last = profile.*level;
    } else {
      profile.*level = last;
    }
  };
  std::optional<double> last;
  for (auto i = profiles.begin(); i != profiles.end(); ++i) fill(*i, last);
  for (auto i = profiles.rbegin(); i != profiles.rend(); ++i) fill(*i, last);
}

/// Leaves out the offsets that their neighbours contradict.
void drop_strays(std::vector<std::optional<double>>& offsets) {
  const std::vector<std::optional<double>> read = offsets;
  const int n = static_cast<int>(read.size());
  for (int i = 0; i < n; ++i) {
    auto& offset = offsets[static_cast<std::size_t>(i)];
    if (!offset) continue;
    std::vector<double> near;
    for (int k = std::max(0, i - kNeighbours); k <= std::min(n - 1, i + kNeighbours); ++k) {
      if (read[static_cast<std::size_t>(k)]) near.push_back(*read[static_cast<std::size_t>(k)]);
    }
    const double middle = median_of(near);
    for (double& value : near) value = std::abs(value - middle);
    if (std::abs(*offset - middle) > std::max(1.0, 4.0 * median_of(near))) offset.reset();
  }
}

Edge located_once(const Field& field, const Polyline& rim) {
  const double length = lengths_along(rim).back();
  const Polyline even = resampled(smoothed(rim, kNormalsReach), std::max(3, static_cast<int>(length)));
  const Polyline along = directions_along(even);
  std::vector<Profile> profiles;
  for (std::size_t i = 0; i < even.size(); ++i) profiles.push_back(profile_at(field, even[i], along[i]));
  fill_levels(profiles, &Profile::inside);
  fill_levels(profiles, &Profile::outside);

  std::vector<std::optional<double>> offsets(even.size());
  std::vector<double> blurs;
  for (std::size_t i = 0; i < even.size(); ++i) {
    const Profile& profile = profiles[i];
    if (!profile.inside || !profile.outside) continue;
    const double contrast = *profile.inside - *profile.outside;
    if (contrast < kLeastContrast) continue;
    offsets[i] = fall_through(profile, *profile.outside + 0.5 * contrast);
    const auto first = fall_through(profile, *profile.outside + 0.75 * contrast);
    const auto last = fall_through(profile, *profile.outside + 0.25 * contrast);
    if (offsets[i] && first && last) blurs.push_back(std::max(0.0, *last - *first) / kQuartiles);
  }
  drop_strays(offsets);
  Edge edge{{}, blurs.empty() ? 0.0 : median_of(blurs), 0.0};
  for (std::size_t i = 0; i < even.size(); ++i) {
    if (!offsets[i]) continue;
    edge.points.push_back(even[i] + *offsets[i] * Eigen::Vector2d(along[i].y(), -along[i].x()));
  }
  edge.unclear = 1.0 - static_cast<double>(edge.points.size()) / static_cast<double>(even.size());
  return edge;
}

}  // namespace

Edge locate_edge(const cv::Mat1f& signal, const Polyline& rim, const std::optional<LevelLine>& cut) {
  const Field field(signal, cut);
  const Edge first = located_once(field, rim);
  if (first.points.size() < 3) return first;
  Edge second = located_once(field, first.points);
  if (second.points.size() < 3) return second;
  second.unclear = std::max(first.unclear, second.unclear);
  second.points = smoothed(second.points, kFinalReach);
  return second;
}

}  // namespace isotach::images
