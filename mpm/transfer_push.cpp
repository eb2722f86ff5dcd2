// Copyright Isotach contributors. SPDX-License-Identifier: BSD-3-Clause
// From points to nodes.
#include <numbers>

#include "mpm/transfer_block.hpp"

namespace isotach::mpm {

namespace {

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

/// Adds a stress of the points beside their materials', plane Mandel.
void add_stress(const std::array<PointArray, 4>& added, std::size_t begin, std::size_t count,
                BlockStress& stress) {
  for (std::size_t p = 0; p < count; p += kOctet) {
    const std::size_t i = begin + p;
    store_octet(stress.rr + p, load_octet(stress.rr + p) + load_octet(&added[0][i]));
    store_octet(stress.zz + p, load_octet(stress.zz + p) + load_octet(&added[1][i]));
    store_octet(stress.tt + p, load_octet(stress.tt + p) + load_octet(&added[2][i]));
    store_octet(stress.rz + p,
                load_octet(stress.rz + p) + load_octet(&added[3][i]) * (1.0 / std::numbers::sqrt2));
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

void PointLoads::add_at(double r, double z, double force_r, double force_z) {
  const CellPlace place = cell_place(all(r), all(z), 1.0 / grid_.cell_size(), grid_.stride());
  const SplineOctets along_r(place.x);
  const SplineOctets along_z(place.y);
  const auto first = static_cast<std::size_t>(place.cell[0]);
  const auto row = static_cast<std::size_t>(place.row[0]);
  for (std::size_t b = 0; b < 3; ++b) {
    sums_.touch(row + b, first - row * grid_.stride() + 3);
    for (std::size_t a = 0; a < 3; ++a) {
      const double weight = along_r.weight[a][0] * along_z.weight[b][0];
      Octet& node = sums_.data()[first + b * grid_.stride() + a];
      node[kAppliedR] += weight * force_r;
      node[kAppliedZ] += weight * force_z;
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
  PointLoads loads(grid, sums);
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
    }
    total_stress<S>(q, start, packed, settings, cells, x, y, stride, stress);
    for (const auto* added : {&q.resistance, &q.capillary}) {
      if (!(*added)[0].empty()) add_stress(*added, start, packed, stress);
    }
    loads.clear();
    for (const auto& force : *settings.forces) {
      force->add({q, start, count, settings.time, settings.dt, stress.rr, loads});
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
                              Octet{},
                              -m * settings.gravity,
                              volume};
      if (loads.any()) {
        corner[kAppliedR] += load_octet(loads.force_r() + p);
        corner[kAppliedZ] += load_octet(loads.force_z() + p);
      }
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

template void push_to_nodes<Symmetry::axisymmetric>(const Particles&, std::size_t, std::size_t, const Grid&,
                                                    const PushSettings&, NodeSums&);
template void push_to_nodes<Symmetry::plane>(const Particles&, std::size_t, std::size_t, const Grid&,
                                             const PushSettings&, NodeSums&);
}  // namespace isotach::mpm
