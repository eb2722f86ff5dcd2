// Copyright Isotach contributors. SPDX-License-Identifier: BSD-3-Clause
#include "mpm/transfer.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "mpm/cell_place.hpp"

namespace isotach::mpm {

namespace {

using Column = double[kBlock];

constexpr double kInside = 1.0 - 1e-12;  // of the grid: round-off of a new place must not reach the next cell

/// Cells of a block's points.
struct BlockCells {
  alignas(64) long long cell[kBlock];
  alignas(64) long long row[kBlock];

  [[gnu::always_inline]] void store(std::size_t p, const CellPlace& place) {
    std::memcpy(cell + p, &place.cell, sizeof place.cell);
    std::memcpy(row + p, &place.row, sizeof place.row);
  }
};

/// Stretches of points in the same cell: open(cell), each(point) for its points, close(cell, row). Points
/// that are sorted by cells make few stretches; what is shared by a cell is then fetched and stored once for
/// all of them.
template <class Open, class Each, class Close>
[[gnu::always_inline]] inline void for_cells(const BlockCells& cells, std::size_t count, Open&& open,
                                             Each&& each, Close&& close) {
  std::size_t p = 0;
  while (p < count) {
    const long long cell = cells.cell[p];
    const long long row = cells.row[p];
    open(static_cast<std::size_t>(cell));
    do {
      each(p);
      ++p;
    } while (p < count && cells.cell[p] == cell);
    close(static_cast<std::size_t>(cell), static_cast<std::size_t>(row));
  }
}

/// Values of a corner field at the four corners of each point's cell.
struct CornerValues {
  alignas(64) Column c00, c10, c01, c11;

  void fetch(const BlockCells& cells, std::size_t count, const double* values, std::size_t stride) {
    for (std::size_t p = 0; p < count; ++p) {
      const double* v = values + cells.cell[p];
      c00[p] = v[0];
      c10[p] = v[1];
      c01[p] = v[stride];
      c11[p] = v[stride + 1];
    }
  }
  [[nodiscard, gnu::always_inline]] Octet at(std::size_t p, const CornerOctets& w) const {
    return w.w00 * load_octet(c00 + p) + w.w10 * load_octet(c10 + p) + w.w01 * load_octet(c01 + p) +
           w.w11 * load_octet(c11 + p);
  }
};

/// Parts of an amount for the four corners of each point's cell.
struct CornerParts {
  alignas(64) Column c00, c10, c01, c11;

  [[gnu::always_inline]] void store(std::size_t p, const CornerOctets& w, const Octet& amount) {
    store_octet(c00 + p, w.w00 * amount);
    store_octet(c10 + p, w.w10 * amount);
    store_octet(c01 + p, w.w01 * amount);
    store_octet(c11 + p, w.w11 * amount);
  }
};

std::size_t padded_to_octets(std::size_t count) {
  return (count + kOctet - 1) / kOctet * kOctet;
}

/// Notes the nodes (or corners) that cells touch, `size` by `size` each. Neighbours follow each other, so
/// rows are widened once for a stretch of cells.
template <class T>
class Extent {
 public:
  Extent(RowSums<T>& sums, std::size_t size) : sums_(sums), size_(size) {}
  ~Extent() { flush(); }
  Extent(const Extent&) = delete;
  Extent& operator=(const Extent&) = delete;

  [[gnu::always_inline]] void touch(std::size_t cell, std::size_t row) {
    const std::size_t end = cell - row * sums_.stride() + size_;
    if (row != row_) {
      flush();
      row_ = row;
      end_ = 0;
    }
    end_ = std::max(end_, end);
  }

 private:
  void flush() {
    for (std::size_t j = 0; j < size_ && end_ > 0; ++j) sums_.touch(row_ + j, end_);
  }

  RowSums<T>& sums_;
  std::size_t size_;
  std::size_t row_ = 0;
  std::size_t end_ = 0;
};

template <Symmetry S>
[[gnu::always_inline]] inline Octet hoop_rate(const Octet& velocity_r, const Octet& r) {
  return S == Symmetry::axisymmetric ? velocity_r / r : Octet{};
}

/// Total stress of a block's points.
struct BlockStress {
  alignas(64) Column rr, zz, tt, rz;
};

template <Symmetry S>
void total_stress(const Particles& q, std::size_t begin, std::size_t count, const PushSettings& settings,
                  const BlockCells& cells, const Column& x, const Column& y, std::size_t stride,
                  BlockStress& stress) {
  CornerValues corners;
  alignas(64) Column own;
  if (settings.mean != nullptr) {
    corners.fetch(cells, count, settings.mean, stride);
  } else {
    settings.material->total_pressure(q, begin, count, own);
  }
  const double half_eta = settings.two_eta * 0.5;
  for (std::size_t p = 0; p < count; p += kOctet) {
    const std::size_t i = begin + p;
    const CellPlace place{{}, {}, load_octet(x + p), load_octet(y + p)};
    const Octet pressure =
        settings.mean != nullptr ? corners.at(p, CornerOctets(place)) : load_octet(own + p);
    const Octet s_rr = load_octet(&q.stress[0][i]);
    const Octet s_zz = load_octet(&q.stress[1][i]);
    const Octet s_tt = load_octet(&q.stress[2][i]);
    const Octet d_rr = load_octet(&q.l_rr[i]);
    const Octet d_zz = load_octet(&q.l_zz[i]);
    const Octet d_tt = hoop_rate<S>(load_octet(&q.grid_velocity_r[i]), load_octet(&q.r[i]));
    const Octet mean_rate = (d_rr + d_zz + d_tt) * (1.0 / 3.0);
    // what takes the place of the points' own mean stress and, for the viscosity, of their tr D
    const Octet shift = (s_rr + s_zz + s_tt) * (1.0 / 3.0) + pressure + settings.two_eta * mean_rate;
    store_octet(stress.rr + p, s_rr - shift + settings.two_eta * d_rr);
    store_octet(stress.zz + p, s_zz - shift + settings.two_eta * d_zz);
    store_octet(stress.tt + p, s_tt - shift + settings.two_eta * d_tt);
    store_octet(stress.rz + p, load_octet(&q.stress[3][i]) * (1.0 / std::numbers::sqrt2) +
                                   half_eta * (load_octet(&q.l_rz[i]) + load_octet(&q.l_zr[i])));
  }
}

/// What a point gives to a node: linear in the node's place, in cells.
struct PointGift {
  Octet corner;  ///< at the first of the nine nodes
  Octet slopes;  ///< of its first four entries, along r and along z
};

/// Four doubles of which one goes to each of the first places.
[[nodiscard, gnu::always_inline]] inline Octet first_four(const double* from) {
  NodeVelocity x;
  std::memcpy(&x, from, sizeof x);
  return __builtin_shufflevector(x, NodeVelocity{}, 0, 1, 2, 3, 4, 5, 6, 7);
}

}  // namespace

void CornerField::average_pressure() {
  for (std::size_t row = 0; row < pressures.rows(); ++row) {
    const std::size_t start = row * pressures.stride();
    for (std::size_t k = start; k < start + pressures.end(row); ++k) {
      const CornerSum& sum = pressures.data()[k];
      mean[k] = sum.volume > 0.0 ? sum.moment / sum.volume : 0.0;
    }
  }
}

void CornerField::average_rate() {
  for (std::size_t row = 0; row < rates.rows(); ++row) {
    const std::size_t start = row * rates.stride();
    for (std::size_t k = start; k < start + rates.end(row); ++k) {
      const double volume = pressures.data()[k].volume;
      mean[k] = volume > 0.0 ? rates.data()[k] / volume : 0.0;
    }
  }
}

template <Symmetry S>
void push_to_nodes(const Particles& q, std::size_t begin, std::size_t end, const Grid& grid,
                   const PushSettings& settings, NodeSums& sums) {
  const double h = grid.cell_size();
  const double inverse_h = 1.0 / h;
  const std::size_t stride = grid.stride();
  BlockCells cells;
  BlockStress stress;
  alignas(64) Column x;
  alignas(64) Column y;
  alignas(64) Column force_r;
  alignas(64) Column force_z;
  alignas(64) double weights[3][3][kBlock];
  alignas(64) PointGift gifts[kBlock];

  for (std::size_t start = begin; start < end; start += kBlock) {
    const std::size_t count = std::min(kBlock, end - start);
    const std::size_t packed = padded_to_octets(count);
    for (std::size_t p = 0; p < packed; p += kOctet) {
      const CellPlace place =
          cell_place(load_octet(&q.r[start + p]), load_octet(&q.z[start + p]), inverse_h, stride);
      cells.store(p, place);
      store_octet(x + p, place.x);
      store_octet(y + p, place.y);
      const SplineOctets along_r(place.x);
      const SplineOctets along_z(place.y);
      for (std::size_t b = 0; b < 3; ++b) {
        for (std::size_t a = 0; a < 3; ++a) {
          store_octet(weights[b][a] + p, along_r.weight[a] * along_z.weight[b]);
        }
      }
      store_octet(force_r + p, Octet{});
      store_octet(force_z + p, Octet{});
    }
    total_stress<S>(q, start, packed, settings, cells, x, y, stride, stress);
    for (const auto& force : *settings.forces) {
      force->add({q, start, count, settings.time, settings.dt, stress.rr, force_r, force_z});
    }

    for (std::size_t p = 0; p < packed; p += kOctet) {
      const std::size_t i = start + p;
      const Octet m = load_octet(&q.mass[i]);
      const Octet volume = load_octet(&q.solid_volume[i]) * (1.0 + load_octet(&q.void_ratio[i]));
      const Octet ms = m * settings.velocity_scale;
      const Octet mh = ms * h;
      // the spline's second moment is h^2/4
      const Octet k = volume * (-4.0 * inverse_h);
      const Octet t_rz = load_octet(stress.rz + p);
      const Octet momentum_r_r = mh * load_octet(&q.c_rr[i]);
      const Octet momentum_r_z = mh * load_octet(&q.c_rz[i]);
      const Octet momentum_z_r = mh * load_octet(&q.c_zr[i]);
      const Octet momentum_z_z = mh * load_octet(&q.c_zz[i]);
      const Octet internal_r_r = k * load_octet(stress.rr + p);
      const Octet internal_shear = k * t_rz;
      const Octet internal_z_z = k * load_octet(stress.zz + p);
      const Octet hoop =
          S == Symmetry::axisymmetric ? -volume * load_octet(stress.tt + p) / load_octet(&q.r[i]) : Octet{};
      // from the point to the first node
      const Octet dx = -0.5 - load_octet(x + p);
      const Octet dy = -0.5 - load_octet(y + p);
      Octet corner[kOctet] = {ms * load_octet(&q.velocity_r[i]) + momentum_r_r * dx + momentum_r_z * dy,
                              ms * load_octet(&q.velocity_z[i]) + momentum_z_r * dx + momentum_z_z * dy,
                              hoop + internal_r_r * dx + internal_shear * dy,
                              internal_shear * dx + internal_z_z * dy,
                              m,
                              load_octet(force_r + p),
                              load_octet(force_z + p) - m * settings.gravity,
                              volume};
      Octet slopes[kOctet] = {momentum_r_r, momentum_z_r, internal_r_r,   internal_shear,
                              momentum_r_z, momentum_z_z, internal_shear, internal_z_z};
      transpose(corner);
      transpose(slopes);
      for (std::size_t lane = 0; lane < kOctet; ++lane)
        gifts[p + lane] = PointGift{corner[lane], slopes[lane]};
    }

    Octet node[3][3];
    Extent extent(sums, 3);
    for_cells(
        cells, count,
        [&](std::size_t) {
          for (auto& row : node) {
            for (Octet& sum : row) sum = Octet{};
          }
        },
        [&](std::size_t p) {
          Octet line = gifts[p].corner;
          const double* slopes = reinterpret_cast<const double*>(&gifts[p].slopes);
          const Octet slope_r = first_four(slopes);
          const Octet slope_z = first_four(slopes + 4);
          for (std::size_t b = 0; b < 3; ++b) {
            Octet value = line;
            for (std::size_t a = 0; a < 3; ++a) {
              node[b][a] += value * weights[b][a][p];
              value += slope_r;
            }
            line += slope_z;
          }
        },
        [&](std::size_t cell, std::size_t row_of_cell) {
          extent.touch(cell, row_of_cell);
          for (std::size_t b = 0; b < 3; ++b) {
            Octet* row = sums.data() + cell + b * stride;
            for (std::size_t a = 0; a < 3; ++a) row[a] += node[b][a];
          }
        });
  }
}

namespace {

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
      const auto store_gradient = [&](std::vector<double>& l, std::vector<double>& c, const Octet& after,
                                      const Octet& before) {
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
void update_points(Particles& q, std::size_t begin, std::size_t end, const Grid& grid, double dt,
                   const double* mean_rate, const Material& material, RowSums<CornerSum>* pressures,
                   MaterialCount& count_met) {
  MaterialChunk chunk;
  chunk.dt = dt;
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
        store_octet(&q.r[i], load_octet(&q.r[i]) + dt * load_octet(&q.grid_velocity_r[i]));
        store_octet(&q.z[i], load_octet(&q.z[i]) + dt * load_octet(&q.grid_velocity_z[i]));
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

double at_point(const Grid& grid, const std::vector<double>& mean, double r, double z) {
  const CellPlace place = cell_place(all(r), all(z), 1.0 / grid.cell_size(), grid.stride());
  const CornerOctets w(place);
  const double* v = mean.data() + place.cell[0];
  return w.w00[0] * v[0] + w.w10[0] * v[1] + w.w01[0] * v[grid.stride()] + w.w11[0] * v[grid.stride() + 1];
}

template void push_to_nodes<Symmetry::axisymmetric>(const Particles&, std::size_t, std::size_t, const Grid&,
                                                    const PushSettings&, NodeSums&);
template void push_to_nodes<Symmetry::plane>(const Particles&, std::size_t, std::size_t, const Grid&,
                                             const PushSettings&, NodeSums&);
template PullResult pull_from_nodes<Symmetry::axisymmetric>(Particles&, std::size_t, std::size_t, const Grid&,
                                                            const PullSettings&, RowSums<double>*);
template PullResult pull_from_nodes<Symmetry::plane>(Particles&, std::size_t, std::size_t, const Grid&,
                                                     const PullSettings&, RowSums<double>*);
template void update_points<Symmetry::axisymmetric>(Particles&, std::size_t, std::size_t, const Grid&, double,
                                                    const double*, const Material&, RowSums<CornerSum>*,
                                                    MaterialCount&);
template void update_points<Symmetry::plane>(Particles&, std::size_t, std::size_t, const Grid&, double,
                                             const double*, const Material&, RowSums<CornerSum>*,
                                             MaterialCount&);

}  // namespace isotach::mpm
