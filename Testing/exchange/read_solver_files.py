"""meshio and Gmsh read the solvers' meshes, straight and curved: the same counts, labels, names and volumes."""
import json
import pathlib
import re
import shutil
import subprocess
import sys
import tempfile

from exchange import SKIPPED, check, check_near, expected, folder, need, numpy, tet_measures

meshio = need("meshio")


def check_tissue(file, mesh, tets, tissue):
    check(len(tets) == tissue["tets"], f"{file}: {len(tets)} tets of {tissue['name']}")
    volume, _, smallest = tet_measures(mesh.points, tets[:, :4])
    check(smallest > 0, f"{file}: a tet is turned")
    check_near(volume, tissue["volume_mm3"], 1e-6 * volume, f"{file}: volume")


def tets_of(mesh):
    return numpy.concatenate([cells.data for cells in mesh.cells if cells.type.startswith("tetra")])


def check_gmsh(file, tissues):
    """The tags, and the names of volumes and of surfaces, whose triangles enclose the same volume."""
    mesh = meshio.read(file)
    for kind, dimension in (("tetra", 3), ("triangle", 2)):
        tags = numpy.concatenate([mesh.cell_data["gmsh:physical"][i] for i, cells in enumerate(mesh.cells)
                                  if cells.type.startswith(kind)])
        second = numpy.concatenate([mesh.cell_data["gmsh:geometrical"][i] for i, cells in enumerate(mesh.cells)
                                    if cells.type.startswith(kind)])
        check((tags == second).all(), f"{file}: both tags are the label")
        check(set(tags) == {tissue["label"] for tissue in tissues}, f"{file}: labels {set(tags)}")
        named = {tag for tag, of in mesh.field_data.values() if of == dimension}
        check(named == set(tags), f"{file}: names of dimension {dimension}: {mesh.field_data}")
        for tissue in tissues:
            if kind == "tetra":
                check_tissue(file, mesh, tets_of(mesh)[tags == tissue["label"]], tissue)
                name = tissue["name"].replace('"', "_")
                check(list(mesh.field_data[name]) == [tissue["label"], 3], f"{file}: {name}")


def check_abaqus(file, tissues):
    mesh = meshio.read(file)
    sets = {name: parts for name, parts in mesh.cell_sets.items() if name != "Eall"}
    check(len(sets) == len(tissues), f"{file}: element sets {set(sets)}")
    for (name, parts), tissue in zip(sets.items(), tissues):
        own = numpy.concatenate([cells.data[part] for cells, part in zip(mesh.cells, parts) if part is not None])
        check_tissue(file, mesh, own, tissue)
        check(set(mesh.point_sets[name + "_nodes"]) == set(own.ravel()), f"{file}: nodes of {name}")
        check(set(mesh.point_sets[name + "_boundary"]) < set(own.ravel()), f"{file}: boundary of {name}")


def gmsh(*arguments):
    done = subprocess.run(["gmsh", *map(str, arguments)], capture_output=True, text=True, timeout=100)
    said = done.stdout + done.stderr
    check(done.returncode == 0 and not re.search("Error|Warning", said), f"gmsh {arguments}: {said}")
    return said


def check_with_gmsh(file, tissues):
    """Gmsh itself finds nothing wrong, and what it writes is the same mesh."""
    gmsh("-check", file)
    with tempfile.TemporaryDirectory() as scratch:
        copy = pathlib.Path(scratch) / "copy.msh"
        gmsh(file, "-save", "-format", "msh22", "-o", copy)
        check_gmsh(copy, tissues)


def files():
    for stem, tissues in expected()["files"].items():
        yield folder() / "untagged" / stem, tissues
    curved = json.loads((folder() / "solver" / "expected.json").read_text(encoding="utf-8"))["curved"]
    yield folder() / "solver" / "curved", curved


program = sys.argv[2]
if program == "gmsh" and shutil.which("gmsh") is None:
    print("skipped: there is no gmsh; install Debian's packages with Scripts/install-dependencies.sh --testing")
    sys.exit(SKIPPED)
for stem, tissues in files():
    if program == "gmsh":
        check_with_gmsh(stem.parent / (stem.name + ".msh"), tissues)
    else:
        check_gmsh(stem.parent / (stem.name + ".msh"), tissues)
        check_abaqus(stem.parent / (stem.name + ".inp"), tissues)
