// Copyright Isotach contributors. SPDX-License-Identifier: BSD-3-Clause
#include "calibration/distributions.hpp"

#include <boost/math/distributions/chi_squared.hpp>
#include <boost/math/distributions/complement.hpp>
#include <boost/math/distributions/normal.hpp>
#include <boost/math/distributions/students_t.hpp>
#include <cmath>
#include <stdexcept>
#include <string>

namespace isotach::calibration {

namespace {

void require_open_unit(double p) {
  if (!(p > 0.0 && p < 1.0)) {
    throw std::domain_error("probability " + std::to_string(p) + " is not admissible; accepted: in (0, 1)");
  }
}

}  // namespace

double normal_quantile(double p) {
  require_open_unit(p);
  return boost::math::quantile(boost::math::normal(), p);
}

double normal_cdf(double x) {
  if (std::isnan(x)) throw std::domain_error("normal_cdf of NaN");
  return 0.5 * std::erfc(-x / std::sqrt(2.0));
}

double student_t_quantile(double p, double degrees) {
  require_open_unit(p);
  return boost::math::quantile(boost::math::students_t(degrees), p);
}

double chi_squared_quantile(double p, double degrees) {
  return boost::math::quantile(boost::math::chi_squared(degrees), p);
}

double chi_squared_survival(double x, double degrees) {
  return boost::math::cdf(boost::math::complement(boost::math::chi_squared(degrees), x));
}

}  // namespace isotach::calibration
