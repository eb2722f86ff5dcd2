#!/usr/bin/env python3
# Copyright Isotach contributors. SPDX-License-Identifier: BSD-3-Clause
"""The fit that oedometer_fit_bench times, as one would write it with SciPy; prints both times and their ratio.

    bench/compare_with_scipy.py BUILD_DIR       needs Debian's python3-scipy (/usr/bin/python3)

The same test (600 rows), the same three coordinates (e100, lambda, kappa; D_r by the gauge, as in the program), the
same law. solve_ivp with LSODA goes stage by stage, not row by row, which would take some fifty times longer;
least_squares takes its derivatives by differences.
"""
import csv
import math
import subprocess
import sys
import tempfile
import time

import numpy as np
from scipy.integrate import solve_ivp
from scipy.optimize import brentq, least_squares

SQRT3 = math.sqrt(3.0)


class Law:
    """Axial and radial stress (Pa, compression positive) and void ratio in confined compression."""

    def __init__(self, e100, lam, kappa, I_v, D_r, phi, C_1):
        self.e100, self.lam, self.kappa, self.I_v, self.D_r, self.C_1 = e100, lam, kappa, I_v, D_r, C_1
        s = math.sin(phi)
        self.a2 = 0.375 * (3.0 - s) ** 2 / s**2
        self.M = 6.0 * s / (3.0 - s)

    def parts(self, sa, sr):
        """p_B+, flow direction (axial, radial; outward, tension positive), E:m and E:axial, per unit."""
        p = (sa + 2.0 * sr) / 3.0
        ta, tr = -sa + p, -sr + p  # deviator, tension positive
        q = sa - sr
        if q >= 0.0:
            F = 1.0
        else:
            F = 1.0 - abs(q) / (3.0 * p)
        M2 = (F * self.M) ** 2
        p_eq = p + q * q / (M2 * p)
        na = 3.0 * ta / M2 - (2.0 * p - p_eq) / 3.0
        nr = 3.0 * tr / M2 - (2.0 * p - p_eq) / 3.0
        norm = math.sqrt(na * na + 2.0 * nr * nr)
        ma, mr = na / norm, nr / norm
        fb = 3.0 * p / ((1.0 + self.a2 / 3.0) * self.kappa)
        ha, hr = sa / (3.0 * p), sr / (3.0 * p)

        def E(xa, xr):
            along = self.a2 * (ha * xa + 2.0 * hr * xr)
            return fb * (F * F * xa + ha * along), fb * (F * F * xr + hr * along)

        return p_eq, (ma, mr), E

    def rate(self, y, r):
        """d(sa, sr, e)/dt at the axial strain rate r (compression positive)."""
        sa, sr, e = y
        p_eq, (ma, mr), E = self.parts(sa, sr)
        p_B = 100e3 * ((1.0 + e) / (1.0 + self.e100)) ** (-1.0 / self.lam)
        viscous = self.D_r * (p_B / p_eq) ** (-1.0 / self.I_v)
        flow = viscous + self.C_1 * abs(r)
        xa, xr = -r - ma * flow, -mr * flow
        ea, er = E(xa, xr)
        return [-ea, -er, -(1.0 + e) * r]

    def steady_viscous_rate(self, rate):
        """|D_vis| of steady oedometric compression at a rate."""

        def trial(K0):
            _, (ma, mr), E = self.parts(1.0, K0)
            w = E(-1.0, -K0)[0] / -1.0
            x = 1.0 / (self.lam * w)
            y = (x - 1.0) / ma
            return y, mr * y - x * K0

        high = 1.0
        K0 = brentq(lambda k: trial(k)[1], 0.2, high - 1e-9)
        return (trial(K0)[0] - self.C_1) * rate


def read(path):
    with open(path) as f:
        head = f.readline().split()
        e0, K0, stress = float(head[2]), float(head[4]), 1e3 * float(head[6])
        rows = list(csv.DictReader(f))
    t = np.array([float(r["time_s"]) for r in rows])
    eps = np.array([float(r["axial_strain"]) for r in rows])
    sigma = np.array([1e3 * float(r["axial_stress_kPa"]) for r in rows])
    return e0, K0, stress, t, eps, sigma


def stages(t, eps):
    """Stretches of constant rate: (first, last + 1) of rows."""
    rate = np.diff(np.concatenate([[0.0], eps])) / np.diff(np.concatenate([[0.0], t]))
    cuts = [0] + [i for i in range(1, len(t)) if abs(rate[i] - rate[i - 1]) > 1e-3 * abs(rate).max()] + [len(t)]
    return list(zip(cuts[:-1], cuts[1:]))


def main():
    build = sys.argv[1]
    with tempfile.TemporaryDirectory() as folder:
        path = folder + "/test.csv"
        out = subprocess.run([build + "/bench/oedometer_fit_bench", path], check=True, capture_output=True, text=True)
        print(out.stdout.strip())
        e0, K0, stress, t, eps, sigma = read(path)
    words = out.stdout.split()
    value = lambda name: float(words[words.index(name) + 1])
    I_v, C_1, phi = value("I_v"), value("C_1"), math.radians(value("phi_c_deg"))
    reference_rate = value("reference_rate")
    parts = stages(t, eps)
    log_sigma = np.log(sigma)

    def predict(x):
        e100, lam, kappa = np.exp(x)
        law = Law(e100, lam, kappa, I_v, 1.0, phi, C_1)
        law.D_r = law.steady_viscous_rate(reference_rate)
        y = [stress, K0 * stress, e0]
        result = np.empty(len(t))
        begin, strain = 0.0, 0.0
        for first, last in parts:
            duration = t[last - 1] - begin
            total = math.log((1.0 - strain) / (1.0 - eps[last - 1]))
            # engineering strain is linear in time, so the logarithmic rate is not quite constant
            height, slope = 1.0 - strain, (eps[last - 1] - strain) / duration
            f = lambda s, z: law.rate(z, slope / (height - slope * (s - begin)) if total != 0.0 else 0.0)
            sol = solve_ivp(f, (begin, t[last - 1]), y, method="LSODA", t_eval=t[first:last], rtol=1e-6, atol=1e-3)
            result[first:last] = sol.y[0]
            y = sol.y[:, -1]
            begin, strain = t[last - 1], eps[last - 1]
        return np.log(result)

    start = np.log([1.1 * value("fit_e100"), 0.85 * value("fit_lambda"), 1.2 * value("fit_kappa")])
    begin = time.perf_counter()
    fit = least_squares(lambda x: (predict(x) - log_sigma) / 0.01, start, x_scale="jac")
    covariance = np.linalg.inv(fit.jac.T @ fit.jac)
    seconds = time.perf_counter() - begin
    ours = 1e-3 * value("median_ms")
    print(f"SciPy: {seconds:.2f} s, {fit.nfev} steps; ratio {seconds / ours:.0f}")
    for name, x, error in zip(("e100", "lambda", "kappa"), fit.x, np.sqrt(np.diag(covariance))):
        print(f"{name} {math.exp(x):.7g} +- {math.exp(x) * error:.2g}  (Isotach {value('fit_' + name):.7g})")


if __name__ == "__main__":
    main()
