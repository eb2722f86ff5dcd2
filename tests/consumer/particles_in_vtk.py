#!/usr/bin/python3
# Copyright Isotach contributors. SPDX-License-Identifier: BSD-3-Clause
"""What VTK itself reads of the particles of a slump, against the numbers in the run's other files.

    tests/consumer/particles_in_vtk.py PROGRAM      needs Debian's python3-vtk9; ends with 77 where it is missing

Runs a small slump on an elastic base and opens particles.pvd and its frames with VTK's XML readers, as ParaView does.
"""
import csv
import json
import math
import pathlib
import subprocess
import sys
import tempfile

try:
    from vtkmodules.vtkCommonCore import vtkCommand
    from vtkmodules.vtkCommonDataModel import VTK_VERTEX
    from vtkmodules.vtkIOXML import vtkXMLUnstructuredGridReader
    from vtkmodules.vtkIOXMLParser import vtkXMLUtilities
except ImportError as missing:
    print(f"skipped: {missing}; scripts/install-dependencies --long installs python3-vtk9")
    sys.exit(77)

E100, LAMBDA, PHI_C = 1.358, 0.154, math.radians(14.2)
VOID_RATIO, SPECIFIC_GRAVITY = 3.891, 2.65
RADIUS_M, FILL_M, CELL_M = 0.039, 0.07, 0.0039  # the cell divides the radius
TIMES_S = [0.2, 0.6, 3.0]
SLUMP = f"""
[material]
e100 = {E100}
lambda = {LAMBDA}
kappa = 0.0129
I_v = 0.02
D_r_per_s = 6.8e-7
phi_c_deg = 14.2
C_1 = 0.03
lode_dependence = "none"   # so that M is a constant
[mud]
void_ratio = {VOID_RATIO}
specific_gravity = {SPECIFIC_GRAVITY}
ocr = 1.5
[mould]
diameter_mm = {2e3 * RADIUS_M}
fill_height_mm = {1e3 * FILL_M}
lift_speed_m_per_s = 0.06
wall = "smooth"
[base]
kind = "elastic"
[numerics]
cell_size_mm = {1e3 * CELL_M}
[output]
times_s = {TIMES_S}
"""
ARRAYS = {
    "velocity_m_per_s": 3,
    "effective_stress_Pa": 4,
    "mean_effective_pressure_Pa": 1,
    "deviatoric_stress_q_Pa": 1,
    "pore_pressure_Pa": 1,
    "void_ratio": 1,
    "overconsolidation_ratio": 1,
    "strain_rate_norm_per_s": 1,
}

failures = []


def check(true, what):
    if not true:
        failures.append(what)
        print("FAILED:", what)


def close(got, expected, relative, what):
    check(abs(got - expected) <= relative * abs(expected), f"{what}: {got} in place of {expected}")


def read_csv(file):
    with open(file, newline="", encoding="utf-8") as lines:
        return [{key: float(value) for key, value in row.items()} for row in csv.DictReader(lines)]


class Frame:
    """One .vtu as VTK reads it."""

    def __init__(self, file):
        complaints = []
        reader = vtkXMLUnstructuredGridReader()
        for event in (vtkCommand.ErrorEvent, vtkCommand.WarningEvent):
            reader.AddObserver(event, lambda *_: complaints.append(str(file)))
        check(reader.CanReadFile(str(file)) == 1, f"{file} is not what VTK reads")
        reader.SetFileName(str(file))
        reader.Update()
        check(not complaints, f"VTK complains of {file}")
        self.grid = reader.GetOutput()
        data = self.grid.GetPointData()
        names = {data.GetArrayName(k): data.GetArray(k).GetNumberOfComponents() for k in range(data.GetNumberOfArrays())}
        check(names == ARRAYS, f"arrays {names} in place of {ARRAYS}")
        stress = data.GetArray("effective_stress_Pa")
        self.stress_names = [stress.GetComponentName(k) for k in range(stress.GetNumberOfComponents())]
        self.count = self.grid.GetNumberOfPoints()
        self.places = [self.grid.GetPoint(i) for i in range(self.count)]
        self.time = self.grid.GetFieldData().GetArray("TimeValue").GetValue(0)

    def values(self, name):
        array = self.grid.GetPointData().GetArray(name)
        check(array.GetNumberOfTuples() == self.count, f"{name} has not a value for each point")
        tuples = [array.GetTuple(i) for i in range(self.count)]
        check(all(math.isfinite(x) for row in tuples for x in row), f"{name} is not finite")
        return [row[0] for row in tuples] if array.GetNumberOfComponents() == 1 else tuples


def check_places(frame, outline):
    """Points lie within the outline's height and toe, to a cell, and reach as far."""
    check(all(r > 0.0 and z > 0.0 and third == 0.0 for r, z, third in frame.places), "a point beyond axis or base")
    toe = max(r for r, _, _ in frame.places)
    height = max(z for _, z, _ in frame.places)
    check(abs(toe - 1e-3 * outline["toe_mm"]) < CELL_M, f"farthest point {toe} m, toe {outline['toe_mm']} mm")
    check(abs(height - 1e-3 * outline["height_mm"]) < CELL_M, f"highest {height} m, {outline['height_mm']} mm")


def check_stress(frame):
    """p' and q follow from the stress, OCR from stress and void ratio: p_B/(p' + q^2/(M^2 p'))."""
    check(frame.stress_names == ["rr", "zz", "hoop", "rz"], f"stress components {frame.stress_names}")
    critical = 6.0 * math.sin(PHI_C) / (3.0 - math.sin(PHI_C))
    rows = zip(frame.values("effective_stress_Pa"), frame.values("mean_effective_pressure_Pa"),
               frame.values("deviatoric_stress_q_Pa"), frame.values("void_ratio"),
               frame.values("overconsolidation_ratio"))
    for (rr, zz, hoop, rz), p, q, e, ocr in rows:
        close(p, (rr + zz + hoop) / 3.0, 1e-12, "p'")
        squares = (rr - zz) ** 2 + (zz - hoop) ** 2 + (hoop - rr) ** 2
        check(abs(q - math.sqrt(0.5 * squares + 3.0 * rz * rz)) <= 1e-9 * p, f"q: {q}")
        preconsolidation = 1e5 * ((1.0 + e) / (1.0 + E100)) ** (-1.0 / LAMBDA)
        close(ocr, preconsolidation / (p + q * q / (critical ** 2 * p)), 1e-9, "OCR")


def check_ranges(frame, density):
    """Undrained mud keeps its volume; total mean pressure stays within what the fill can weigh, give or take the
    pressure that its fall and the strength of its skeleton add."""
    volumes = [1.0 + e for e in frame.values("void_ratio")]
    close(sum(volumes) / frame.count, 1.0 + VOID_RATIO, 0.005, "mean of 1 + e")
    check(0.95 < min(volumes) / (1.0 + VOID_RATIO) < max(volumes) / (1.0 + VOID_RATIO) < 1.05, "a point's 1 + e")
    weight = density * 9.81 * FILL_M
    totals = [u + p for u, p in zip(frame.values("pore_pressure_Pa"), frame.values("mean_effective_pressure_Pa"))]
    check(-0.5 * weight < min(totals) and max(totals) < 1.5 * weight, f"total pressures {min(totals)}, {max(totals)}")
    check(max(totals) > 0.3 * weight, f"no total pressure beyond {max(totals)} Pa")


def check_velocity(frame, row, density):
    """The root mean square of history.csv's kinetic energy lies between the points' least and largest speed."""
    check(all(v[2] == 0.0 for v in frame.values("velocity_m_per_s")), "a velocity out of the meridian plane")
    speeds = [math.hypot(v[0], v[1]) for v in frame.values("velocity_m_per_s")]
    mass = density * math.pi * RADIUS_M ** 2 * FILL_M
    mean = math.sqrt(2.0 * row["kinetic_J"] / row["inertia_scaling"] / mass)
    check(min(speeds) <= mean <= max(speeds), f"speeds {min(speeds)} to {max(speeds)}, root mean square {mean}")
    plain = math.sqrt(sum(v * v for v in speeds) / frame.count)  # points near the axis have less mass
    check(0.5 < plain / mean < 2.0, f"root mean square {plain} of the points, {mean} of the energy")


def check_fields(frame, rows):
    """Averages over cells lie between the least and the largest of the points."""
    check(len(rows) > 20, f"{len(rows)} cells in fields.csv")
    for name, column, unit in (("strain_rate_norm_per_s", "strain_rate_per_s", 1.0),
                               ("overconsolidation_ratio", "ocr", 1.0),
                               ("pore_pressure_Pa", "pore_pressure_kPa", 1e3)):
        values = frame.values(name)
        slack = 1e-6 * max(abs(value) for value in values)  # cells are in single precision
        cells = [unit * row[column] for row in rows]
        check(min(values) - slack <= min(cells) and max(cells) <= max(values) + slack,
              f"{name}: {min(values)} to {max(values)}, in cells {min(cells)} to {max(cells)}")
    check(min(frame.values("strain_rate_norm_per_s")) >= 0.0, "a negative norm")


def main():
    with tempfile.TemporaryDirectory() as folder:
        out = pathlib.Path(folder) / "out"
        test = pathlib.Path(folder) / "slump.toml"
        test.write_text(SLUMP, encoding="utf-8")
        subprocess.run([sys.argv[1], "slump", test, "--out", out, "--quiet"], check=True)
        result = json.loads((out / "result.json").read_text(encoding="utf-8"))
        history = {row["time_s"]: row for row in read_csv(out / "history.csv")}
        fields = read_csv(out / "fields.csv")
        close(result["numerics"]["cell_size_mm"], 1e3 * CELL_M, 1e-9, "cell size")
        density = 1e3 * (SPECIFIC_GRAVITY + VOID_RATIO) / (1.0 + VOID_RATIO)
        close(result["initial"]["density_kg_per_m3"], density, 1e-12, "density")

        root = vtkXMLUtilities.ReadElementFromFile(str(out / "particles.pvd"))
        check(root is not None and root.GetAttribute("type") == "Collection", "particles.pvd is no collection")
        collection = root.FindNestedElementWithName("Collection")
        sets = [collection.GetNestedElement(k) for k in range(collection.GetNumberOfNestedElements())]
        times = [float(entry.GetAttribute("timestep")) for entry in sets]
        check(times == TIMES_S == [outline["time_s"] for outline in result["outlines"]], f"time steps {times}")

        largest = []
        for entry, outline, time in zip(sets, result["outlines"], times):
            frame = Frame(out / entry.GetAttribute("file"))
            check(frame.time == time, f"TimeValue {frame.time} of the step {time}")
            check(frame.count == result["points"] == frame.grid.GetNumberOfCells(), f"{frame.count} points")
            check(all(frame.grid.GetCellType(i) == VTK_VERTEX for i in range(frame.count)), "a cell is no vertex")
            check_places(frame, outline)
            check_stress(frame)
            check_ranges(frame, density)
            check_velocity(frame, history[time], density)
            check_fields(frame, [row for row in fields if row["time_s"] == time])
            largest.append(max(frame.values("strain_rate_norm_per_s")))
        check(largest[0] > 10.0 * largest[-1], f"the flow does not slow down: |D| up to {largest}")
        print(f"{len(sets)} frames of {result['points']} points, {len(failures)} failures")
    return 1 if failures else 0


if __name__ == "__main__":
    sys.exit(main())
