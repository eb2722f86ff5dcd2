// Copyright Isotach contributors. SPDX-License-Identifier: BSD-3-Clause
// Stress, places and averages over cells.
#include <numbers>

#include "mpm/transfer_block.hpp"

namespace isotach::mpm {

void CornerField::average_pressure(std::size_t first, std::size_t last) {
  for (std::size_t row = first; row < last; ++row) {
    const std::size_t start = row * pressures.stride();
    for (std::size_t k = start; k < start + pressures.end(row); ++k) {
      const CornerSum& sum = pressures.data()[k];
      mean[k] = sum.volume > 0.0 ? sum.moment / sum.volume : 0.0;
    }
  }
}

void CornerField::average_rate(std::size_t first, std::size_t last) {
  for (std::size_t row = first; row < last; ++row) {
    const std::size_t start = row * rates.stride();
    for (std::size_t k = start; k < start + rates.end(row); ++k) {
      const double volume = pressures.data()[k].volume;
      mean[k] = volume > 0.0 ? rates.data()[k] / volume : 0.0;
    }
  }
}

namespace {

/// Adds volumes and pressures of a block's points to the corners.
void scatter_pressure(const Particles& q, std::size_t start, std::size_t count, const Grid& grid,
                      const double* pressure, RowSums<CornerSum>& pressures) {
  const double inverse_h = 1.0 / grid.cell_size();
  const std::size_t stride = grid.stride();
  BlockCells cells;
  CornerParts volumes;
  CornerParts moments;
  for (std::size_t p = 0; p < count; p += kOctet) {
    const std::size_t i = start + p;
    const CellPlace place = cell_place(load_octet(&q.r[i]), load_octet(&q.z[i]), inverse_h, stride);
    const CornerOctets w(place);
    const Octet volume = load_octet(&q.solid_volume[i]) * (1.0 + load_octet(&q.void_ratio[i]));
    cells.store(p, place);
    volumes.store(p, w, volume);
    moments.store(p, w, volume * load_octet(pressure + p));
  }
  CornerSum sums[4];
  Extent extent(pressures, 2);
  for_cells(
      cells, count,
      [&](std::size_t) {
        std::fill_n(sums, 4, CornerSum{0.0, 0.0});
      },
      [&](std::size_t p) {
        sums[0] += CornerSum{volumes.c00[p], moments.c00[p]};
        sums[1] += CornerSum{volumes.c10[p], moments.c10[p]};
        sums[2] += CornerSum{volumes.c01[p], moments.c01[p]};
        sums[3] += CornerSum{volumes.c11[p], moments.c11[p]};
      },
      [&](std::size_t cell, std::size_t row) {
        extent.touch(cell, row);
        CornerSum* corner = pressures.data() + cell;
        corner[0] += sums[0];
        corner[1] += sums[1];
        corner[stride] += sums[2];
        corner[stride + 1] += sums[3];
      });
}

}  // namespace

namespace {

/// Strain rates of a block of points, as the material sees them; entries of the chunk from p on.
template <Symmetry S>
void strain_rates(const Particles& q, std::size_t start, std::size_t count, const Grid& grid,
                  const double* mean_rate, MaterialChunk& chunk, std::size_t entry) {
  const std::size_t stride = grid.stride();
  const double inverse_h = 1.0 / grid.cell_size();
  const std::size_t packed = padded_to_octets(count);
  BlockCells cells;
  CornerValues corners;
  alignas(64) Column x;
  alignas(64) Column y;
  if (mean_rate != nullptr) {
    for (std::size_t p = 0; p < packed; p += kOctet) {
      const CellPlace place =
          cell_place(load_octet(&q.r[start + p]), load_octet(&q.z[start + p]), inverse_h, stride);
      cells.store(p, place);
      store_octet(x + p, place.x);
      store_octet(y + p, place.y);
    }
    corners.fetch(cells, packed, mean_rate, stride);
  }
  for (std::size_t p = 0; p < kBlock; p += kOctet) {
    const std::size_t i = start + p;
    Octet d_rr = load_octet(&q.l_rr[i]);
    Octet d_zz = load_octet(&q.l_zz[i]);
    Octet d_tt = hoop_rate<S>(load_octet(&q.grid_velocity_r[i]), load_octet(&q.r[i]));
    if (mean_rate != nullptr && p < packed) {
      const CellPlace place{{}, {}, load_octet(x + p), load_octet(y + p)};
      const Octet change = (corners.at(p, CornerOctets(place)) - (d_rr + d_zz + d_tt)) * (1.0 / 3.0);
      d_rr += change;
      d_zz += change;
      d_tt += change;
    }
    const Octet l_rz = load_octet(&q.l_rz[i]);
    const Octet l_zr = load_octet(&q.l_zr[i]);
    store_octet(&chunk.strain_rate[0][entry + p], d_rr);
    store_octet(&chunk.strain_rate[1][entry + p], d_zz);
    store_octet(&chunk.strain_rate[2][entry + p], d_tt);
    store_octet(&chunk.strain_rate[3][entry + p], (l_rz + l_zr) * (1.0 / std::numbers::sqrt2));
    store_octet(&chunk.spin[entry + p], 0.5 * (l_rz - l_zr));
  }
}

}  // namespace

template <Symmetry S>
void update_points(Particles& q, std::size_t begin, std::size_t end, const Grid& grid, const TimeStep& step,
                   const double* mean_rate, const Material& material, RowSums<CornerSum>* pressures,
                   MaterialCount& count_met) {
  MaterialChunk chunk;
  chunk.time = step.start;
  chunk.dt = step.dt;
  for (std::size_t first = begin; first < end; first += kChunk) {
    chunk.begin = first;
    chunk.count = std::min(kChunk, end - first);
    const std::size_t last = first + chunk.count;
    for (std::size_t start = first; start < last; start += kBlock) {
      strain_rates<S>(q, start, std::min(kBlock, last - start), grid, mean_rate, chunk, start - first);
    }
    material.update(q, chunk, count_met);
    for (std::size_t start = first; start < last; start += kBlock) {
      const std::size_t count = std::min(kBlock, last - start);
      for (std::size_t p = 0; p < padded_to_octets(count); p += kOctet) {
        const std::size_t i = start + p;
        store_octet(&q.r[i], load_octet(&q.r[i]) + step.dt * load_octet(&q.grid_velocity_r[i]));
        store_octet(&q.z[i], load_octet(&q.z[i]) + step.dt * load_octet(&q.grid_velocity_z[i]));
      }
      if (pressures != nullptr) {
        scatter_pressure(q, start, count, grid, &chunk.total_pressure[start - first], *pressures);
      }
    }
  }
}

void push_pressure(const Particles& q, std::size_t begin, std::size_t end, const Grid& grid,
                   const Material& material, RowSums<CornerSum>& pressures) {
  alignas(64) Column pressure;
  for (std::size_t start = begin; start < end; start += kBlock) {
    const std::size_t count = std::min(kBlock, end - start);
    material.total_pressure(q, start, count, pressure);
    std::fill(pressure + count, pressure + kBlock, 0.0);
    scatter_pressure(q, start, count, grid, pressure, pressures);
  }
}

double at_point(const Grid& grid, const double* mean, double r, double z) {
  const CellPlace place = cell_place(all(r), all(z), 1.0 / grid.cell_size(), grid.stride());
  const CornerOctets w(place);
  const double* v = mean + place.cell[0];
  return w.w00[0] * v[0] + w.w10[0] * v[1] + w.w01[0] * v[grid.stride()] + w.w11[0] * v[grid.stride() + 1];
}

template void update_points<Symmetry::axisymmetric>(Particles&, std::size_t, std::size_t, const Grid&,
                                                    const TimeStep&, const double*, const Material&,
                                                    RowSums<CornerSum>*, MaterialCount&);
template void update_points<Symmetry::plane>(Particles&, std::size_t, std::size_t, const Grid&,
                                             const TimeStep&, const double*, const Material&,
                                             RowSums<CornerSum>*, MaterialCount&);

}  // namespace isotach::mpm
