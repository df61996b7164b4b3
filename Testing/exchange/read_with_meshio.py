"""meshio reads the files without a mark: the same counts, labels and volumes. Text in field data it refuses."""
from exchange import check, check_near, expected, folder, need, numpy, surface_measures, tet_measures

meshio = need("meshio")


def check_tets(file, tissues):
    mesh = meshio.read(file)
    tets = mesh.cells_dict["tetra"]
    labels = mesh.cell_data_dict["labels"]["tetra"].ravel()
    check(len(mesh.points) == sum(tissue["nodes"] for tissue in tissues), f"{file}: nodes")
    check(set(labels) == {tissue["label"] for tissue in tissues}, f"{file}: labels {set(labels)}")
    for tissue in tissues:
        own = tets[labels == tissue["label"]]
        check(len(own) == tissue["tets"], f"{file}: {len(own)} tets")
        volume, _, smallest = tet_measures(mesh.points, own)
        check(smallest > 0, f"{file}: a tet is turned")
        check_near(volume, tissue["volume_mm3"], 1e-9 * volume, f"{file}: volume")
    check(mesh.cell_data_dict["RGB"]["tetra"].shape == (len(tets), 3), f"{file}: RGB")


def check_surface(file, tissues):
    mesh = meshio.read(file)
    triangles = numpy.concatenate([cells.data for cells in mesh.cells if cells.type == "triangle"])
    volume, _ = surface_measures(mesh.points, triangles)
    # .stl has float coordinates, 3e-5 mm at 500 mm.
    check_near(volume, sum(tissue["volume_mm3"] for tissue in tissues), 1e-5 * volume, f"{file}: volume")
    if file.suffix == ".ply":
        check({"red", "green", "blue", "label"} <= set(mesh.point_data), f"{file}: {set(mesh.point_data)}")
        found = set(mesh.point_data["label"])
        check(found == {tissue["label"] for tissue in tissues}, f"{file}: labels {found}")


for stem, tissues in expected()["files"].items():
    for extension in (".vtu", ".vtk"):
        check_tets(folder() / "untagged" / (stem + extension), tissues)
    for extension in (".stl", ".ply", ".obj"):
        check_surface(folder() / "untagged" / (stem + extension), tissues)
    check_tets(folder() / "lps" / (stem + ".vtk"), tissues)

try:
    meshio.read(folder() / "lps" / "combined.vtu")
except (Exception, SystemExit):
    print("as documented, meshio refuses text in field data")
else:
    print("this meshio reads text in field data")
