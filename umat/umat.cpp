// Copyright Isotach contributors. SPDX-License-Identifier: BSD-3-Clause
// Translates between Abaqus' arguments and a material point.
#include "umat/umat.hpp"

#include <fmt/format.h>

#include <cmath>
#include <exception>
#include <span>
#include <string>

#include "umat/material_point.hpp"
#include "umat/properties.hpp"

// Abaqus' routine for messages; with -3 it ends the analysis. Weak: absent from other codes, and then null.
extern "C" __attribute__((weak)) void stdb_abqerr_(const int* kind, const char* text, const int* integers,
                                                   const double* reals, const char* words,
                                                   std::size_t text_length, std::size_t words_length);

namespace isotach::umat {

namespace {

using Components = Eigen::Matrix<double, 6, 1>;

/// Places in STATEV, counted from 0.
enum StatePlace { kVoidRatio = 0, kOmega = 1, kOcr = 7, kAccepted = 8, kRejected = 9, kEvaluations = 10 };

/// A call refused, in words: no increment, however short, could be answered.
struct Refusal {
  std::string text;
};

tl::unexpected<Refusal> refuse(std::string text) {
  return tl::unexpected(Refusal{std::move(text)});
}

/// The arguments that are used.
struct Call {
  std::span<double> stress;
  std::span<double> statev;
  std::span<double> ddsdde;
  std::span<const double> dstran;
  std::span<const double> props;
  double dtime;
  Eigen::Matrix3d drot;
};

/// The first components of a tensor, the others zero.
Components padded(std::span<const double> values) {
  Components result = Components::Zero();
  for (std::size_t i = 0; i < values.size(); ++i) result[static_cast<Eigen::Index>(i)] = values[i];
  return result;
}

/// Omega as it stands in STATEV, turned with the material.
tl::expected<Components, Refusal> turned_omega(const Call& call) {
  constexpr double kRoundOff = 1e-8;
  const Components omega = padded(call.statev.subspan(kOmega, 6));
  if (!(std::abs(omega.head<3>().sum()) <= kRoundOff)) {
    return refuse(
        fmt::format("STATEV(2:4), the diagonal of Omega, sum to {}; accepted: 0", omega.head<3>().sum()));
  }
  const Components turned = rotated(omega, call.drot);
  if (call.stress.size() == 4 && !(std::abs(turned[4]) <= kRoundOff && std::abs(turned[5]) <= kRoundOff)) {
    return refuse(fmt::format("Omega has 13 and 23 components {} and {}; accepted with NTENS = 4: 0",
                              turned[4], turned[5]));
  }
  return turned;
}

/// e as it stands in STATEV, or where that is zero, from PROPS.
tl::expected<double, Refusal> void_ratio(const Call& call, const Properties& properties,
                                         const model::Law<double>& law, model::State<double> state) {
  const double stored = call.statev[kVoidRatio];
  if (stored > 0.0 && std::isfinite(stored)) return stored;
  if (stored != 0.0) {
    return refuse(
        fmt::format("STATEV(1), the void ratio, is {}; accepted: above 0, or 0 to start from PROPS", stored));
  }
  if (properties.initial_void_ratio > 0.0) return properties.initial_void_ratio;
  if (properties.initial_ocr > 0.0) {
    state.void_ratio = 1.0;  // p_B+ does not depend on it
    if (law.in_domain(state)) {
      const double pressure = properties.initial_ocr * law.measures(state).equivalent_pressure;
      const double e = law.void_ratio_at(pressure);
      if (e > 0.0) return e;
      return refuse(
          fmt::format("the initial OCR of {} asks for a void ratio of {} at p_B = {} kPa; accepted: above 0",
                      properties.initial_ocr, e, pressure / 1e3));
    }
    return 1.0;  // the caller refuses the stress
  }
  return refuse(
      "STATEV(1), the void ratio, is 0, and neither PROPS(16), the initial void ratio, nor PROPS(17), "
      "the initial OCR, is given; accepted: one of them above 0");
}

tl::expected<model::State<double>, Refusal> start_state(const Call& call, const Properties& properties,
                                                        const model::Law<double>& law,
                                                        const Components& omega) {
  model::State<double> state;
  state.stress = model::mandel_from_voigt_stress<double>(padded(call.stress)) * properties.stress_unit;
  state.omega = model::mandel_from_components<double>(omega);
  const auto e = void_ratio(call, properties, law, state);
  if (!e) return tl::unexpected(e.error());
  state.void_ratio = *e;
  if (!law.in_domain(state)) {
    const double p = 0.0 - model::trace<double, 6>(state.stress) / 3.0;  // no stress is 0, not -0
    const double q = std::sqrt(1.5) * model::deviator<double, 6>(state.stress).norm();
    return refuse(
        fmt::format("STRESS has p = {} kPa and q = {} kPa, STATEV(2:7) has (3/2) Omega:Omega = {}; accepted: "
                    "p > 0, q < 3p, "
                    "(3/2) Omega:Omega < M^2, all finite",
                    p / 1e3, q / 1e3, 1.5 * state.omega.squaredNorm()));
  }
  return state;
}

/// Writes what the increment changed. What it left as it was keeps its bits: the way to SI and back would
/// round.
void write(const Call& call, const Properties& properties, const model::State<double>& start,
           const Components& start_omega, const PointUpdate& update, double ocr) {
  const model::State<double>& end = update.state;
  const Components stress = end.stress == start.stress ? padded(call.stress)
                                                       : model::voigt_stress_from_mandel<double>(end.stress) /
                                                             properties.stress_unit;
  const Components omega =
      end.omega == start.omega ? start_omega : model::components_from_mandel<double>(end.omega);
  const Eigen::Matrix<double, 6, 6> tangent = voigt_tangent(update.tangent) / properties.stress_unit;
  const std::size_t n = call.stress.size();
  for (std::size_t i = 0; i < n; ++i) {
    call.stress[i] = stress[static_cast<Eigen::Index>(i)];
    for (std::size_t j = 0; j < n; ++j) {
      call.ddsdde[i + n * j] = tangent(static_cast<Eigen::Index>(i), static_cast<Eigen::Index>(j));
    }
  }
  call.statev[kVoidRatio] = end.void_ratio;
  for (std::size_t i = 0; i < 6; ++i) call.statev[kOmega + i] = omega[static_cast<Eigen::Index>(i)];
  call.statev[kOcr] = ocr;
  call.statev[kAccepted] = static_cast<double>(update.statistics.accepted);
  call.statev[kRejected] = static_cast<double>(update.statistics.rejected);
  call.statev[kEvaluations] = static_cast<double>(update.statistics.evaluations);
}

/// Answers the call and returns what PNEWDT is to be at most; 1 or more: as it was.
tl::expected<double, Refusal> answer(const Call& call) {
  constexpr double kOrthogonal = 1e-6;
  const auto properties = read_properties(call.props);
  if (!properties) return refuse(properties.error());
  if (!(call.dtime >= 0.0 && std::isfinite(call.dtime))) {
    return refuse(fmt::format("DTIME is {}; accepted: 0 or above, finite", call.dtime));
  }
  if (!((call.drot * call.drot.transpose() - Eigen::Matrix3d::Identity()).cwiseAbs().maxCoeff() <
        kOrthogonal)) {
    return refuse("DROT is no rotation; accepted: DROT DROT^T = 1");
  }
  const model::Law<double> law(properties->parameters);
  const auto omega = turned_omega(call);
  if (!omega) return tl::unexpected(omega.error());
  const auto start = start_state(call, *properties, law, *omega);
  if (!start) return tl::unexpected(start.error());

  const PointIncrement increment{model::mandel_from_voigt_strain<double>(padded(call.dstran)),
                                 call.dtime * properties->time_unit};
  const auto update = advance(law, *start, increment, properties->tolerance);
  if (!update) return kShorterIncrement;
  write(call, *properties, *start, *omega, *update, law.overconsolidation_ratio(update->state));
  return 1.0;
}

/// Says why the analysis cannot go on, where the code that called has a way to be told.
void report(const std::string& text, int element, int point) {
  if (stdb_abqerr_ == nullptr) return;
  constexpr int kEnd = -3;
  const std::string full =
      fmt::format("Isotach UMAT, element {}, integration point {}: {}", element, point, text);
  const int integer = 0;
  const double real = 0.0;
  const std::string word(8, ' ');
  stdb_abqerr_(&kEnd, full.c_str(), &integer, &real, word.c_str(), full.size(), word.size());
}

/// The same, where the arguments themselves may be wrong.
tl::expected<double, Refusal> answer(const int ndi, const int nshr, const int ntens, const int nstatv,
                                     const int nprops, double* stress, double* statev, double* ddsdde,
                                     const double* dstran, double dtime, const double* props,
                                     const double* drot) {
  if (ndi != 3 || (nshr != 3 && nshr != 1) || ntens != ndi + nshr) {
    return refuse(
        fmt::format("(NDI, NSHR, NTENS) is ({}, {}, {}); accepted: (3, 3, 6), and (3, 1, 4) for plane "
                    "strain and axisymmetry",
                    ndi, nshr, ntens));
  }
  if (nstatv < kStateCount) {
    return refuse(fmt::format("NSTATV is {}; accepted: {} or more", nstatv, kStateCount));
  }
  if (nprops < 0) return refuse(fmt::format("NPROPS is {}; accepted: {}", nprops, kPropertyCount));
  const auto n = static_cast<std::size_t>(ntens);
  return answer({{stress, n},
                 {statev, static_cast<std::size_t>(kStateCount)},
                 {ddsdde, n * n},
                 {dstran, n},
                 {props, static_cast<std::size_t>(nprops)},
                 dtime,
                 Eigen::Map<const Eigen::Matrix3d>(drot)});
}

}  // namespace
}  // namespace isotach::umat

extern "C" void umat_(double* stress, double* statev, double* ddsdde, double* /*sse*/, double* /*spd*/,
                      double* /*scd*/, double* /*rpl*/, double* /*ddsddt*/, double* /*drplde*/,
                      double* /*drpldt*/, const double* /*stran*/, const double* dstran,
                      const double* /*time*/, const double* dtime, const double* /*temp*/,
                      const double* /*dtemp*/, const double* /*predef*/, const double* /*dpred*/,
                      const char* /*cmname*/, const int* ndi, const int* nshr, const int* ntens,
                      const int* nstatv, const double* props, const int* nprops, const double* /*coords*/,
                      const double* drot, double* pnewdt, const double* /*celent*/, const double* /*dfgrd0*/,
                      const double* /*dfgrd1*/, const int* noel, const int* npt, const int* /*layer*/,
                      const int* /*kspt*/, const int* /*kstep*/, const int* /*kinc*/,
                      std::size_t /*cmname_length*/) {
  using namespace isotach::umat;
  double at_most = kNoIncrement;
  try {
    const auto answered =
        answer(*ndi, *nshr, *ntens, *nstatv, *nprops, stress, statev, ddsdde, dstran, *dtime, props, drot);
    if (answered) {
      at_most = *answered;
    } else {
      report(answered.error().text, *noel, *npt);
    }
  } catch (const std::exception& error) {  // none may reach Fortran
    report(error.what(), *noel, *npt);
  }
  // CalculiX comes with -1 and takes what is not above zero for success
  if (at_most < 1.0 && (!(*pnewdt > 0.0) || *pnewdt > at_most)) *pnewdt = at_most;
}
