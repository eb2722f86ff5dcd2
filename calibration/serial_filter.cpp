// Copyright Isotach contributors. SPDX-License-Identifier: BSD-3-Clause
#include "calibration/serial_filter.hpp"

#include <cmath>

namespace isotach::calibration {

namespace {

constexpr double kSteady = 1e-16;

}  // namespace

SerialFilter::SerialFilter(double rho, double share, Eigen::Index count,
                           const std::vector<std::size_t>& chain_starts)
    : weight_(count), kept_(count), gain_(count) {
  const double white = 1.0 - share;
  for (std::size_t chain = 0; chain < chain_starts.size(); ++chain) {
    const auto begin = static_cast<Eigen::Index>(chain_starts[chain]);
    const Eigen::Index end =
        chain + 1 < chain_starts.size() ? static_cast<Eigen::Index>(chain_starts[chain + 1]) : count;
    double predicted = share;
    for (Eigen::Index i = begin; i < end; ++i) {
      const double innovation = predicted + white;
      weight_[i] = 1.0 / std::sqrt(innovation);
      log_determinant_ += std::log(innovation);
      gain_[i] = rho * (predicted / innovation);
      kept_[i] = rho * (white / innovation);
      const double next = rho * rho * predicted * (white / innovation) + share * (1.0 - rho * rho);
      if (std::abs(next - predicted) <=
          kSteady) {  // of order one where the variance is: nothing changes more
        const Eigen::Index rest = end - i - 1;
        weight_.segment(i + 1, rest).setConstant(weight_[i]);
        gain_.segment(i + 1, rest).setConstant(gain_[i]);
        kept_.segment(i + 1, rest).setConstant(kept_[i]);
        log_determinant_ += static_cast<double>(rest) * std::log(innovation);
        break;
      }
      predicted = next;
    }
    kept_[end - 1] = gain_[end - 1] = 0.0;
  }
}

void SerialFilter::apply(Eigen::Ref<Eigen::MatrixXd> values) const {
  for (Eigen::Index column = 0; column < values.cols(); ++column) {
    double* const value = values.col(column).data();
    double prediction = 0.0;
    for (Eigen::Index i = 0; i < values.rows(); ++i) {
      const double read = value[i];
      value[i] = (read - prediction) * weight_[i];
      prediction = kept_[i] * prediction + gain_[i] * read;
    }
  }
}

}  // namespace isotach::calibration
