"""CalculiX compresses, from Sinew's .inp files, a bar, a muscle, and a bar under pressure from all sides.

solve_with_calculix.py FOLDER bar|muscle|pressure
"""
import pathlib
import re
import shutil
import subprocess
import sys
import tempfile

from abaqus import Mesh, Section
from exchange import SKIPPED, check, check_near, folder, numpy

E, NU = 2.0, 0.3  # N/mm^2; small displacements are in proportion to 1/E


def solve(mesh_file, sets, loads):
    """Runs one linear step. @return displacements, mm, and the whole force on the set HIGH where there is one."""
    mesh = Mesh(mesh_file)
    cards = [f"*INCLUDE, INPUT={mesh_file.name}"]
    for name, nodes in sets.items():
        cards += [f"*NSET, NSET={name}"] + [str(node + 1) for node in nodes]
    cards += ["*MATERIAL, NAME=elastic", "*ELASTIC", f"{E},{NU}"]
    cards += [f"*SOLID SECTION, ELSET={name}, MATERIAL=elastic" for name in mesh.elsets]
    cards += loads + ["*NODE PRINT, NSET=Nall, GLOBAL=YES", "U"]
    if "HIGH" in sets:
        cards += ["*NODE PRINT, NSET=HIGH, TOTALS=ONLY", "RF"]
    with tempfile.TemporaryDirectory() as scratch:
        scratch = pathlib.Path(scratch)
        shutil.copy(mesh_file, scratch)
        (scratch / "job.inp").write_text("\n".join(cards + ["*END STEP", ""]), encoding="utf-8")
        done = subprocess.run(["ccx", "-i", "job"], cwd=scratch, capture_output=True, text=True, timeout=300)
        check("Job finished" in done.stdout, f"ccx: {done.stdout[-2000:]}")
        check("*WARNING" not in done.stdout, f"ccx warns: {done.stdout[-2000:]}")
        return mesh, *results((scratch / "job.dat").read_text(encoding="utf-8"), len(mesh.points))


def results(text, nodes):
    displacements = numpy.full((nodes, 3), numpy.nan)
    for row in re.finditer(r"^ +(\d+)" + r" +(-?[\d.]+E[+-]\d+)" * 3 + r" *$", text, re.MULTILINE):
        displacements[int(row[1]) - 1] = [float(row[k]) for k in (2, 3, 4)]
    check(not numpy.isnan(displacements).any(), "ccx has printed no displacement for some nodes")
    total = re.search(r"total force.*\n\s*\n\s*(\S+)\s+(\S+)\s+(\S+)", text)
    return displacements, numpy.array([float(total[k]) for k in (1, 2, 3)]) if total else None


CORNER, END, SIDE = 0, 40 * 5 * 5, 4  # nodes at three corners of the bar, as SolverFiles numbers them


def bar_axes(mesh):
    """The long axis of the bar, and one square to it."""
    along, across = mesh.points[END] - mesh.points[CORNER], mesh.points[SIDE] - mesh.points[CORNER]
    return along / numpy.linalg.norm(along), across / numpy.linalg.norm(across)


def principal_axes(mesh):
    """The long axis of a muscle, and one square to it."""
    corners = mesh.points[mesh.corners]
    volumes = numpy.linalg.det(corners[:, 1:] - corners[:, :1]) / 6
    centre = volumes @ corners.mean(axis=1) / volumes.sum()
    off = corners.mean(axis=1) - centre
    _, vectors = numpy.linalg.eigh((off.T * volumes) @ off)
    return vectors[:, 2], vectors[:, 1]


def compress(mesh_file, axes, ends, shortening):
    """Holds one end, presses the other; both are free to widen. The ends are the nodes of the tissue's boundary, and
    those inside, of the first and the last part `ends` of the length; they are told by their heights along the axis."""
    mesh = Mesh(mesh_file)
    along, across = axes(mesh)
    height = mesh.points @ along
    lowest, length = height.min(), height.max() - height.min()
    low = numpy.flatnonzero(height <= lowest + ends * length + 1e-6)
    high = numpy.flatnonzero(height >= lowest + (1 - ends) * length - 1e-6)
    middle = low[numpy.argmin(numpy.linalg.norm(mesh.points[low] - mesh.points[low].mean(axis=0), axis=1))]
    side = low[numpy.argmax(mesh.points[low] @ across)]
    directions = ",".join(f"{value:.12f}" for value in (*along, *across))
    loads = ["*TRANSFORM, NSET=Nall, TYPE=R", directions, "*STEP", "*STATIC", "*BOUNDARY", "LOW,1,1",
             f"{middle + 1},2,3", f"{side + 1},3,3", f"HIGH,1,1,{-shortening * length:.12g}"]
    mesh, moved, force = solve(mesh_file, {"LOW": low, "HIGH": high}, loads)
    return mesh, height, length, moved @ along, force @ along


def bar(mesh_file):
    """A prism between smooth plates: the strain is the same everywhere, F L / (E A) the exact answer."""
    mesh, height, length, moved, force = compress(mesh_file, bar_axes, 0, 0.01)
    area = 2 * 2
    check_near(length, 20, 1e-6, "the bar's length")
    check_near(moved[height.argmax()] - moved[height.argmin()], force * length / (E * area), 1e-4 * 0.2,
               f"{mesh_file.name}: F L / (E A)")  # six digits are printed
    check_near(moved, -0.01 * (height - height.min()), 1e-6, f"{mesh_file.name}: displacements")
    print(f"{mesh_file.name}: {len(mesh.tets)} tets, force {force:.6f} N")


def muscle(mesh_file):
    """A muscle is no prism, so its bar has the sections that the mesh has: a part of it from a to b shortens by the
    integral of F / (E A(s)) ds. That holds away from the ends, where the section changes slowly: in the middle 40 %."""
    mesh, height, length, moved, force = compress(mesh_file, principal_axes, 0.15, 0.01)
    levels = height.min() + length * numpy.linspace(0.3, 0.7, 17)
    sections = [Section(mesh, height, level) for level in levels]
    bar_shortens = force / E * numpy.trapz([1 / section.area for section in sections], levels)
    shortens = sections[-1].mean(moved) - sections[0].mean(moved)
    print(f"{mesh_file.name}: {len(mesh.tets)} tets, sections {sections[0].area:.0f} to "
          f"{max(section.area for section in sections):.0f} mm^2, shortens by {-shortens:.5f} mm, "
          f"the bar by {-bar_shortens:.5f} mm: {100 * (shortens / bar_shortens - 1):+.2f} %")
    check(abs(shortens / bar_shortens - 1) < 0.02, f"{mesh_file.name}: 2 % of the bar")


def pressure(mesh_file):
    """The surface under pressure p: everywhere the strain -p (1 - 2 nu) / E, so its faces are those of the boundary."""
    mesh = Mesh(mesh_file)
    along, across = bar_axes(mesh)
    p = 0.01
    faces = [face for surface in mesh.surfaces.values() for face in surface]
    loads = ["*TRANSFORM, NSET=Nall, TYPE=R", ",".join(f"{value:.12g}" for value in (*along, *across)), "*STEP",
             "*STATIC", "*BOUNDARY", f"{CORNER + 1},1,3", f"{END + 1},2,3", f"{SIDE + 1},3,3",
             "*DLOAD"] + [f"{tet + 1},P{face},{p}" for tet, face in faces]
    mesh, moved, _ = solve(mesh_file, {}, loads)
    strain = -p * (1 - 2 * NU) / E
    check_near(moved, strain * (mesh.points - mesh.points[CORNER]), 1e-4 * abs(strain) * 20,
               f"{mesh_file.name}: displacements under pressure")
    print(f"{mesh_file.name}: {len(faces)} faces under pressure, strain {strain:.6g} everywhere")


if shutil.which("ccx") is None:
    print("skipped: there is no ccx; install Debian's packages with Scripts/install-dependencies.sh --testing")
    sys.exit(SKIPPED)
what = sys.argv[2]
for variant in ("", "-quadratic"):
    stem = "muscle" if what == "muscle" else "bar"
    {"bar": bar, "muscle": muscle, "pressure": pressure}[what](folder() / "solver" / f"{stem}{variant}.inp")
