// Copyright Isotach contributors. SPDX-License-Identifier: BSD-3-Clause
// From nodes to points.
#include <cmath>

#include "mpm/transfer_block.hpp"

namespace isotach::mpm {

namespace {

constexpr double kInside = 1.0 - 1e-12;  // of the grid: round-off of a new place must not reach the next cell

/// First point of a block that would leave the grid or is not finite.
std::optional<std::size_t> find_leaving(const Particles& q, std::size_t begin, std::size_t count,
                                        const Grid& grid, double dt) {
  for (std::size_t i = begin; i < begin + count; ++i) {
    const double r = q.r[i] + dt * q.grid_velocity_r[i];
    const double z = q.z[i] + dt * q.grid_velocity_z[i];
    if (!(r > 0.0 && r < kInside * grid.width() && z > 0.0 && z < kInside * grid.height() &&
          std::isfinite(q.velocity_r[i] + q.velocity_z[i]))) {
      return i;
    }
  }
  return std::nullopt;
}

}  // namespace

template <Symmetry S>
PullResult pull_from_nodes(Particles& q, std::size_t begin, std::size_t end, const Grid& grid,
                           const PullSettings& settings, RowSums<double>* rates) {
  const double inverse_h = 1.0 / grid.cell_size();
  const double gradient = 4.0 * inverse_h;
  const std::size_t stride = grid.stride();
  const NodeVelocity* velocities = grid.velocities();
  const double width = kInside * grid.width();
  const double height = kInside * grid.height();
  PullResult result;
  double fastest2 = 0.0;
  BlockCells cells;
  CornerParts parts;
  // weights along r, and times the offset of the node; along z likewise
  alignas(64) double wr[3][kBlock];
  alignas(64) double or_[3][kBlock];
  alignas(64) double wz[3][kBlock];
  alignas(64) double oz[3][kBlock];
  // velocity (r, z, before r, before z) and, behind it, its moment along r; then its moment along z
  alignas(64) Octet values[kBlock];
  alignas(64) Octet moments[kBlock];

  for (std::size_t start = begin; start < end; start += kBlock) {
    const std::size_t count = std::min(kBlock, end - start);
    const std::size_t packed = padded_to_octets(count);
    for (std::size_t p = 0; p < packed; p += kOctet) {
      const CellPlace place =
          cell_place(load_octet(&q.r[start + p]), load_octet(&q.z[start + p]), inverse_h, stride);
      cells.store(p, place);
      const SplineOctets along_r(place.x);
      const SplineOctets along_z(place.y);
      for (std::size_t a = 0; a < 3; ++a) {
        const double node = static_cast<double>(a) - 0.5;
        store_octet(wr[a] + p, along_r.weight[a]);
        store_octet(or_[a] + p, along_r.weight[a] * (node - place.x));
        store_octet(wz[a] + p, along_z.weight[a]);
        store_octet(oz[a] + p, along_z.weight[a] * (node - place.y));
      }
    }

    Octet node[3][3];  // each velocity twice
    for_cells(
        cells, count,
        [&](std::size_t cell) {
          for (std::size_t b = 0; b < 3; ++b) {
            const NodeVelocity* row = velocities + cell + b * stride;
            for (std::size_t a = 0; a < 3; ++a) {
              node[b][a] = __builtin_shufflevector(row[a], row[a], 0, 1, 2, 3, 4, 5, 6, 7);
            }
          }
        },
        [&](std::size_t p) {
          Octet along_r[3];
          for (std::size_t a = 0; a < 3; ++a) {
            const double w = wr[a][p];
            const double o = or_[a][p];
            along_r[a] = Octet{w, w, w, w, o, o, o, o};
          }
          Octet value{};
          Octet moment{};
          for (std::size_t b = 0; b < 3; ++b) {
            const Octet row = node[b][0] * along_r[0] + node[b][1] * along_r[1] + node[b][2] * along_r[2];
            value += row * wz[b][p];
            moment += row * oz[b][p];
          }
          values[p] = value;
          moments[p] = moment;
        },
        [](std::size_t, std::size_t) {});
    for (std::size_t p = count; p < packed; ++p) values[p] = moments[p] = Octet{};

    Octet fastest{};
    IntegerOctet outside{};
    for (std::size_t p = 0; p < packed; p += kOctet) {
      const std::size_t i = start + p;
      Octet v[kOctet];
      Octet m[kOctet];
      for (std::size_t lane = 0; lane < kOctet; ++lane) {
        v[lane] = values[p + lane];
        m[lane] = moments[p + lane];
      }
      transpose(v);  // v_r, v_z, before r, before z; then their moments along r
      transpose(m);
      const double scale = settings.velocity_scale;
      const Octet keep = all(settings.keep_velocity);
      const Octet keep_gradient = all(settings.keep_gradient);
      const auto store_gradient = [&](PointArray& l, PointArray& c, const Octet& after, const Octet& before) {
        const Octet now = after * gradient;
        store_octet(&l[i], now);
        store_octet(&c[i], now + keep_gradient * (scale * load_octet(&c[i]) - before * gradient));
        return now;
      };
      const Octet l_rr = store_gradient(q.l_rr, q.c_rr, v[4], v[6]);
      store_gradient(q.l_zr, q.c_zr, v[5], v[7]);
      store_gradient(q.l_rz, q.c_rz, m[0], m[2]);
      const Octet l_zz = store_gradient(q.l_zz, q.c_zz, m[1], m[3]);
      const Octet kept_r = keep * (scale * load_octet(&q.velocity_r[i]) - v[2]);
      const Octet kept_z = keep * (scale * load_octet(&q.velocity_z[i]) - v[3]);
      store_octet(&q.velocity_r[i], v[0] + kept_r);
      store_octet(&q.velocity_z[i], v[1] + kept_z);
      // what is kept moves with the grid's velocity and not with its own: the moment of momentum that this
      // takes away goes into the spin of the affine part
      const Octet spin = (v[0] * kept_z - v[1] * kept_r) * (0.5 * settings.dt * gradient * inverse_h);
      store_octet(&q.c_zr[i], load_octet(&q.c_zr[i]) - spin);
      store_octet(&q.c_rz[i], load_octet(&q.c_rz[i]) + spin);
      store_octet(&q.grid_velocity_r[i], v[0]);
      store_octet(&q.grid_velocity_z[i], v[1]);

      const Octet r = load_octet(&q.r[i]);
      const Octet z = load_octet(&q.z[i]);
      if (rates != nullptr) {
        const Octet volume = load_octet(&q.solid_volume[i]) * (1.0 + load_octet(&q.void_ratio[i]));
        const Octet divergence = l_rr + l_zz + hoop_rate<S>(v[0], r);
        parts.store(p, CornerOctets(cell_place(r, z, inverse_h, stride)), volume * divergence);
      }
      const Octet r_new = r + settings.dt * v[0];
      const Octet z_new = z + settings.dt * v[1];
      outside |= ~((r_new > 0.0) & (r_new < width) & (z_new > 0.0) & (z_new < height));
      const Octet speed2 = v[0] * v[0] + v[1] * v[1];
      fastest = speed2 > fastest ? speed2 : fastest;
    }
    bool any_outside = false;
    for (std::size_t lane = 0; lane < kOctet; ++lane) {
      any_outside |= outside[lane] != 0;
      fastest2 = std::max(fastest2, fastest[lane]);
    }
    if (any_outside && !result.leaving) {
      result.leaving = find_leaving(q, start, count, grid, settings.dt);
    }

    if (rates != nullptr) {
      Extent extent(*rates, 2);
      double s00 = 0.0;
      double s10 = 0.0;
      double s01 = 0.0;
      double s11 = 0.0;
      for_cells(
          cells, count, [&](std::size_t) { s00 = s10 = s01 = s11 = 0.0; },
          [&](std::size_t p) {
            s00 += parts.c00[p];
            s10 += parts.c10[p];
            s01 += parts.c01[p];
            s11 += parts.c11[p];
          },
          [&](std::size_t cell, std::size_t row) {
            extent.touch(cell, row);
            double* corner = rates->data() + cell;
            corner[0] += s00;
            corner[1] += s10;
            corner[stride] += s01;
            corner[stride + 1] += s11;
          });
    }
  }
  result.fastest = std::sqrt(fastest2);
  return result;
}

template PullResult pull_from_nodes<Symmetry::axisymmetric>(Particles&, std::size_t, std::size_t, const Grid&,
                                                            const PullSettings&, RowSums<double>*);
template PullResult pull_from_nodes<Symmetry::plane>(Particles&, std::size_t, std::size_t, const Grid&,
                                                     const PullSettings&, RowSums<double>*);
}  // namespace isotach::mpm
