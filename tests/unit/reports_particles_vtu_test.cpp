// Copyright Isotach contributors. SPDX-License-Identifier: BSD-3-Clause
// Tests of the files for ParaView, read back with a decoder of their own.
#include <gtest/gtest.h>

#include <cmath>
#include <cstdint>
#include <cstring>
#include <numbers>
#include <pugixml.hpp>

#include "reports/particles_vtu.hpp"
#include "reports_base64.hpp"
#include "reports_results.hpp"

namespace isotach::reports {
namespace {

template <class T>
std::vector<T> array_of(const pugi::xml_node& parent, const char* name) {
  const pugi::xml_node array = parent.find_child_by_attribute("DataArray", "Name", name);
  EXPECT_TRUE(array) << name;
  const std::vector<unsigned char> bytes = from_base64(array.text().get());
  std::uint64_t size = 0;
  std::memcpy(&size, bytes.data(), sizeof size);
  EXPECT_EQ(size + sizeof size, bytes.size()) << name;
  std::vector<T> values(size / sizeof(T));
  std::memcpy(values.data(), bytes.data() + sizeof size, size);
  return values;
}

class ParticlesVtu : public ResultFolder {};

/// Two points with numbers that can be followed by hand.
mpm::Snapshot two_points() {
  mpm::Snapshot snapshot;
  snapshot.time = 2.5;
  mpm::Particles& points = snapshot.particles;
  points.for_each_array([](mpm::PointArray& array) { array.assign(8, 0.0); });  // padded
  points.count = 2;
  points.r = {0.01, 0.02};
  points.z = {0.03, 0.04};
  points.velocity_r = {1.0, 2.0};
  points.velocity_z = {-3.0, -4.0};
  points.stress[0] = {-30.0, -10.0};
  points.stress[1] = {-90.0, -10.0};
  points.stress[2] = {-30.0, -10.0};
  points.stress[3] = {std::numbers::sqrt2 * 7.0, 0.0};
  points.void_ratio = {3.5, 3.6};
  snapshot.pore_pressure = {100.0, -5.0};
  snapshot.overconsolidation_ratio = {1.5, 1.25};
  snapshot.strain_rate_norm = {5.0, 0.0};
  return snapshot;
}

TEST_F(ParticlesVtu, HoldsEveryQuantityOfEveryPoint) {
  OutputDirectory output(root_ / "out");
  write_particles(output, {two_points()});
  output.commit();
  pugi::xml_document document;
  ASSERT_TRUE(document.load_file((root_ / "out/particles/frame_001.vtu").c_str()));
  const pugi::xml_node root = document.child("VTKFile");
  EXPECT_STREQ(root.attribute("type").value(), "UnstructuredGrid");
  EXPECT_STREQ(root.attribute("byte_order").value(), "LittleEndian");
  EXPECT_STREQ(root.attribute("header_type").value(), "UInt64");
  const pugi::xml_node grid = root.child("UnstructuredGrid");
  EXPECT_EQ(array_of<double>(grid.child("FieldData"), "TimeValue"), (std::vector<double>{2.5}));
  const pugi::xml_node piece = grid.child("Piece");
  EXPECT_EQ(piece.attribute("NumberOfPoints").as_int(), 2);
  EXPECT_EQ(piece.attribute("NumberOfCells").as_int(), 2);
  EXPECT_EQ(array_of<double>(piece.child("Points"), "Points"),
            (std::vector<double>{0.01, 0.03, 0.0, 0.02, 0.04, 0.0}));
  const pugi::xml_node cells = piece.child("Cells");
  EXPECT_EQ(array_of<std::int64_t>(cells, "connectivity"), (std::vector<std::int64_t>{0, 1}));
  EXPECT_EQ(array_of<std::int64_t>(cells, "offsets"), (std::vector<std::int64_t>{1, 2}));
  EXPECT_EQ(array_of<std::uint8_t>(cells, "types"), (std::vector<std::uint8_t>{1, 1}));

  const pugi::xml_node data = piece.child("PointData");
  EXPECT_EQ(array_of<double>(data, "velocity_m_per_s"),
            (std::vector<double>{1.0, -3.0, 0.0, 2.0, -4.0, 0.0}));
  const auto stress = array_of<double>(data, "effective_stress_Pa");
  ASSERT_EQ(stress.size(), 8U);
  EXPECT_EQ(stress[0], 30.0);  // compression positive
  EXPECT_EQ(stress[1], 90.0);
  EXPECT_NEAR(stress[3], -7.0, 1e-12);  // the tensor component
  EXPECT_EQ(array_of<double>(data, "mean_effective_pressure_Pa"), (std::vector<double>{50.0, 10.0}));
  // q^2 = 60^2 + 3 7^2 for axial and lateral stress 60 apart and a shear stress of 7
  const auto q = array_of<double>(data, "deviatoric_stress_q_Pa");
  EXPECT_NEAR(q.at(0), std::sqrt(3747.0), 1e-10);
  EXPECT_EQ(q.at(1), 0.0);
  EXPECT_EQ(array_of<double>(data, "pore_pressure_Pa"), (std::vector<double>{100.0, -5.0}));
  EXPECT_EQ(array_of<double>(data, "void_ratio"), (std::vector<double>{3.5, 3.6}));
  EXPECT_EQ(array_of<double>(data, "overconsolidation_ratio"), (std::vector<double>{1.5, 1.25}));
  EXPECT_EQ(array_of<double>(data, "strain_rate_norm_per_s"), (std::vector<double>{5.0, 0.0}));
}

TEST_F(ParticlesVtu, CollectsTheFramesOfARun) {
  OutputDirectory output(root_ / "out");
  write_particles(output, short_slump().snapshots);
  output.commit();
  pugi::xml_document document;
  ASSERT_TRUE(document.load_file((root_ / "out/particles.pvd").c_str()));
  std::vector<double> times;
  for (const pugi::xml_node frame : document.child("VTKFile").child("Collection")) {
    times.push_back(frame.attribute("timestep").as_double());
    pugi::xml_document vtu;
    ASSERT_TRUE(vtu.load_file((root_ / "out" / frame.attribute("file").value()).c_str()));
    const pugi::xml_node piece = vtu.child("VTKFile").child("UnstructuredGrid").child("Piece");
    EXPECT_EQ(array_of<double>(piece.child("Points"), "Points").size(), 3 * short_slump().points);
  }
  EXPECT_EQ(times, (std::vector<double>{0.25, 0.5}));
}

}  // namespace
}  // namespace isotach::reports
