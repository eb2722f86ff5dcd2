// Copyright Isotach contributors. SPDX-License-Identifier: BSD-3-Clause
// VTK's XML formats, written with pugixml.
#include "reports/particles_vtu.hpp"

#include <fmt/format.h>

#include <bit>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <numbers>
#include <pugixml.hpp>
#include <span>
#include <vector>

#include "reports/base64.hpp"

namespace isotach::reports {
namespace {

static_assert(std::endian::native == std::endian::little, "the files say LittleEndian");

/// VTK's inline binary form: the number of bytes as UInt64, then the bytes, base64 over both.
template <class T>
std::string encoded(const std::vector<T>& values) {
  const std::uint64_t size = values.size() * sizeof(T);
  std::vector<unsigned char> bytes(sizeof size + size);
  std::memcpy(bytes.data(), &size, sizeof size);
  if (size > 0) std::memcpy(bytes.data() + sizeof size, values.data(), size);
  return base64(bytes);
}

template <class T>
pugi::xml_node add_array(pugi::xml_node parent, const char* type, const char* name,
                         const std::vector<T>& values) {
  pugi::xml_node array = parent.append_child("DataArray");
  array.append_attribute("type") = type;
  array.append_attribute("Name") = name;
  array.append_attribute("format") = "binary";
  array.text().set(encoded(values).c_str());
  return array;
}

void name_components(pugi::xml_node array, std::span<const char* const> names) {
  array.append_attribute("NumberOfComponents") = static_cast<unsigned>(names.size());
  for (std::size_t k = 0; k < names.size(); ++k) {
    array.append_attribute(fmt::format("ComponentName{}", k).c_str()) = names[k];
  }
}

/// f(i) of every point.
template <class F>
std::vector<double> each(std::size_t count, F&& f) {
  std::vector<double> values;
  values.reserve(count);
  for (std::size_t i = 0; i < count; ++i) values.push_back(f(i));
  return values;
}

void add_point_data(pugi::xml_node piece, const mpm::Snapshot& snapshot) {
  const mpm::Particles& points = snapshot.particles;
  const std::size_t n = points.count;
  const auto& T = points.stress;
  const auto pressure = [&](std::size_t i) { return -(T[0][i] + T[1][i] + T[2][i]) / 3.0; };

  pugi::xml_node point_data = piece.append_child("PointData");
  point_data.append_attribute("Scalars") = "mean_effective_pressure_Pa";
  point_data.append_attribute("Vectors") = "velocity_m_per_s";
  std::vector<double> velocity;
  std::vector<double> stress;
  for (std::size_t i = 0; i < n; ++i) {
    velocity.insert(velocity.end(), {points.velocity_r[i], points.velocity_z[i], 0.0});
    stress.insert(stress.end(), {-T[0][i], -T[1][i], -T[2][i], -T[3][i] / std::numbers::sqrt2});
  }
  add_array(point_data, "Float64", "velocity_m_per_s", velocity).append_attribute("NumberOfComponents") = 3;
  constexpr const char* kStress[] = {"rr", "zz", "hoop", "rz"};
  name_components(add_array(point_data, "Float64", "effective_stress_Pa", stress), kStress);
  add_array(point_data, "Float64", "mean_effective_pressure_Pa", each(n, pressure));
  add_array(point_data, "Float64", "deviatoric_stress_q_Pa", each(n, [&](std::size_t i) {
              const double p = pressure(i);
              const double squares = (T[0][i] + p) * (T[0][i] + p) + (T[1][i] + p) * (T[1][i] + p) +
                                     (T[2][i] + p) * (T[2][i] + p) + T[3][i] * T[3][i];
              return std::sqrt(1.5 * squares);
            }));
  add_array(point_data, "Float64", "pore_pressure_Pa",
            each(n, [&](std::size_t i) { return snapshot.pore_pressure[i]; }));
  add_array(point_data, "Float64", "void_ratio",
            each(n, [&](std::size_t i) { return points.void_ratio[i]; }));
  add_array(point_data, "Float64", "overconsolidation_ratio",
            each(n, [&](std::size_t i) { return snapshot.overconsolidation_ratio[i]; }));
  add_array(point_data, "Float64", "strain_rate_norm_per_s", snapshot.strain_rate_norm);
}

/// The root of a VTK file.
pugi::xml_node add_root(pugi::xml_document& document, const char* type, const char* comment) {
  pugi::xml_node declaration = document.append_child(pugi::node_declaration);
  declaration.append_attribute("version") = "1.0";
  document.append_child(pugi::node_comment).set_value(comment);
  pugi::xml_node root = document.append_child("VTKFile");
  root.append_attribute("type") = type;
  root.append_attribute("version") = "1.0";
  root.append_attribute("byte_order") = "LittleEndian";
  root.append_attribute("header_type") = "UInt64";
  return root;
}

void save(const pugi::xml_document& document, const std::filesystem::path& file) {
  if (!document.save_file(file.c_str(), " ")) {
    throw OutputError(file.string() + ": cannot be written");
  }
}

void write_frame(const std::filesystem::path& file, const mpm::Snapshot& snapshot) {
  pugi::xml_document document;
  pugi::xml_node grid =
      add_root(document, "UnstructuredGrid",
               " Material points of a slump in the meridian plane: x = r, y = z. Unit at the end "
               "of each name; stresses and pressures compression positive. ")
          .append_child("UnstructuredGrid");
  const mpm::Particles& points = snapshot.particles;

  pugi::xml_node time = grid.append_child("FieldData");
  pugi::xml_node time_value = add_array(time, "Float64", "TimeValue", std::vector<double>{snapshot.time});
  time_value.append_attribute("NumberOfTuples") = 1;

  pugi::xml_node piece = grid.append_child("Piece");
  piece.append_attribute("NumberOfPoints") = points.count;
  piece.append_attribute("NumberOfCells") = points.count;
  add_point_data(piece, snapshot);

  std::vector<double> positions;
  std::vector<std::int64_t> connectivity;
  std::vector<std::int64_t> offsets;
  for (std::size_t i = 0; i < points.count; ++i) {
    positions.insert(positions.end(), {points.r[i], points.z[i], 0.0});
    connectivity.push_back(static_cast<std::int64_t>(i));
    offsets.push_back(static_cast<std::int64_t>(i) + 1);
  }
  constexpr std::uint8_t kVertex = 1;  // VTK_VERTEX
  add_array(piece.append_child("Points"), "Float64", "Points", positions)
      .append_attribute("NumberOfComponents") = 3;
  pugi::xml_node cells = piece.append_child("Cells");
  add_array(cells, "Int64", "connectivity", connectivity);
  add_array(cells, "Int64", "offsets", offsets);
  add_array(cells, "UInt8", "types", std::vector<std::uint8_t>(points.count, kVertex));
  save(document, file);
}

}  // namespace

void write_particles(OutputDirectory& output, const std::vector<mpm::Snapshot>& snapshots) {
  pugi::xml_document document;
  pugi::xml_node collection =
      add_root(document, "Collection", " Frames of a slump; times in s. ").append_child("Collection");
  for (std::size_t k = 0; k < snapshots.size(); ++k) {
    const std::string name = fmt::format("particles/frame_{:03}.vtu", k + 1);
    write_frame(output.staging_path(name), snapshots[k]);
    pugi::xml_node frame = collection.append_child("DataSet");
    frame.append_attribute("timestep") = fmt::format("{}", snapshots[k].time).c_str();
    frame.append_attribute("group") = "";
    frame.append_attribute("part") = "0";
    frame.append_attribute("file") = name.c_str();
  }
  save(document, output.staging_path("particles.pvd"));
}

}  // namespace isotach::reports
