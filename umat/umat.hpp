// Copyright Isotach contributors. SPDX-License-Identifier: BSD-3-Clause
// The visco-hypoplastic law as an Abaqus user material: the one function of libisotach_umat.so.
#pragma once

#include <cstddef>

namespace isotach::umat {

/// STATEV, counted from 0: e, Omega (components 11 22 33 12 13 23), OCR, and what the increment cost:
/// substeps accepted, substeps rejected, evaluations of the law.
inline constexpr int kStateCount = 11;

/// PNEWDT where the increment failed and a shorter one may not.
inline constexpr double kShorterIncrement = 0.25;
/// PNEWDT where the call is refused and no increment would do: below any least increment, so that the
/// analysis ends. Not zero, nor negative, which CalculiX takes for success.
inline constexpr double kNoIncrement = 1e-9;

}  // namespace isotach::umat

/// Abaqus' UMAT, argument list of Abaqus/Standard; arrays column-major, the length of `cmname` passed last by
/// value as Fortran compilers do. docs/umat.md describes PROPS, STATEV and units.
///
/// Stress and strain in Voigt order 11 22 33 12 (13 23), tension positive, shear strain engineering; (ndi,
/// nshr) is (3, 3), or (3, 1) for plane strain and axisymmetry. Read: stress, statev, dstran, dtime, ndi,
/// nshr, ntens, nstatv, props, nprops, drot, pnewdt, noel, npt. Written: stress, statev(1:11) and ddsdde on
/// success; on failure pnewdt alone. Never touched: the rest, energies included. Safe to call from several
/// threads at once.
extern "C" __attribute__((visibility("default"))) void umat_(
    double* stress, double* statev, double* ddsdde, double* sse, double* spd, double* scd, double* rpl,
    double* ddsddt, double* drplde, double* drpldt, const double* stran, const double* dstran,
    const double* time, const double* dtime, const double* temp, const double* dtemp, const double* predef,
    const double* dpred, const char* cmname, const int* ndi, const int* nshr, const int* ntens,
    const int* nstatv, const double* props, const int* nprops, const double* coords, const double* drot,
    double* pnewdt, const double* celent, const double* dfgrd0, const double* dfgrd1, const int* noel,
    const int* npt, const int* layer, const int* kspt, const int* kstep, const int* kinc,
    std::size_t cmname_length);
