// Copyright Isotach contributors. SPDX-License-Identifier: BSD-3-Clause
#include "calibration/clusters.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>

namespace isotach::calibration {

namespace {

void require(bool condition, const char* what) {
  if (!condition) throw std::invalid_argument(what);
}

}  // namespace

std::vector<Cluster> cluster_answers(std::vector<Answer> answers, const Eigen::MatrixXd& information,
                                     double radius) {
  require(radius > 0.0 && std::isfinite(radius), "the radius of a cluster is not positive and finite");
  if (answers.empty()) return {};
  const Eigen::Index size = answers.front().x.size();
  for (const Answer& answer : answers) {
    require(answer.x.size() == size && answer.x.allFinite() && std::isfinite(answer.cost),
            "answers to cluster are not finite, or of different sizes");
  }
  require(information.rows() == size && information.cols() == size,
          "the information has another size than the answers");
  const bool informed = information.allFinite() && information.diagonal().maxCoeff() > 0.0;
  const auto together = [&](const Answer& a, const Answer& b) {
    if (!informed) return std::abs(a.cost - b.cost) <= 0.5 * radius * radius;
    const Eigen::VectorXd way = a.x - b.x;
    return way.dot(information * way) <= radius * radius;
  };

  std::sort(answers.begin(), answers.end(), [](const Answer& a, const Answer& b) { return a.cost < b.cost; });
  constexpr std::size_t kNone = std::numeric_limits<std::size_t>::max();
  std::vector<std::size_t> cluster_of(answers.size(), kNone);
  std::vector<Cluster> clusters;
  std::vector<std::size_t> reached;
  for (std::size_t best = 0; best < answers.size(); ++best) {
    if (cluster_of[best] != kNone) continue;
    // the cheapest answer that is in no cluster yet opens one; all it can reach belong to it
    cluster_of[best] = clusters.size();
    clusters.push_back({answers[best].x, answers[best].cost, 0});
    reached.assign(1, best);
    while (!reached.empty()) {
      const std::size_t from = reached.back();
      reached.pop_back();
      ++clusters.back().count;
      for (std::size_t to = best + 1; to < answers.size(); ++to) {
        if (cluster_of[to] == kNone && together(answers[from], answers[to])) {
          cluster_of[to] = clusters.size() - 1;
          reached.push_back(to);
        }
      }
    }
  }
  return clusters;
}

}  // namespace isotach::calibration
