"""VTK reads the Exodus files: a named block for every tissue, the same counts and volumes, straight and curved."""
import json

from exchange import check, check_near, expected, folder, need, numpy, tet_measures

need("vtk")
from vtkmodules.util.numpy_support import vtk_to_numpy
from vtkmodules.vtkIOExodus import vtkExodusIIReader


def blocks(file):
    reader = vtkExodusIIReader()
    reader.SetFileName(str(file))
    reader.Update()
    for b in range(reader.GetNumberOfElementBlockArrays()):
        name = reader.GetElementBlockArrayName(b).split(" ID: ")[0].rstrip()
        yield reader.GetObjectId(reader.ELEM_BLOCK, b), name, reader.GetOutput().GetBlock(0).GetBlock(b)


def check_file(file, tissues, nodes):
    found = {label: (name, grid) for label, name, grid in blocks(file)}
    check(set(found) == {tissue["label"] for tissue in tissues}, f"{file}: blocks {set(found)}")
    for tissue in tissues:
        name, grid = found[tissue["label"]]
        check(name == tissue["name"], f"{file}: {name}")
        tets = vtk_to_numpy(grid.GetCells().GetConnectivityArray()).reshape(-1, nodes)
        check(len(tets) == tissue["tets"], f"{file}: {len(tets)} tets")
        # The reader turns coordinates into floats.
        volume, _, _ = tet_measures(vtk_to_numpy(grid.GetPoints().GetData()), numpy.asarray(tets)[:, :4])
        check_near(volume, tissue["volume_mm3"], 1e-5 * volume, f"{file}: volume")


for stem, tissues in expected()["files"].items():
    check_file(folder() / "untagged" / (stem + ".exo"), tissues, 4)
curved = json.loads((folder() / "solver" / "expected.json").read_text(encoding="utf-8"))["curved"]
check_file(folder() / "solver" / "curved.exo", curved, 10)
