"""VTK, on which 3D Slicer and ParaView stand, reads every file. Each tissue lies where its voxels are: barycentres agree
within a tenth of a voxel, in LPS and RAS; tets are positive and surfaces outward in both."""
from exchange import check, check_near, expected, folder, need, numpy, surface_measures, tet_measures

need("vtkmodules")
from vtkmodules.util.numpy_support import vtk_to_numpy
from vtkmodules.vtkIOGeometry import vtkOBJReader, vtkSTLReader
from vtkmodules.vtkIOLegacy import vtkUnstructuredGridReader
from vtkmodules.vtkIOPLY import vtkPLYReader
from vtkmodules.vtkIOXML import vtkXMLPolyDataReader, vtkXMLUnstructuredGridReader

VOLUMES = {".vtu": vtkXMLUnstructuredGridReader, ".vtk": vtkUnstructuredGridReader}
SURFACES = {".stl": vtkSTLReader, ".ply": vtkPLYReader, ".obj": vtkOBJReader, ".vtp": vtkXMLPolyDataReader}
WITHOUT_LABELS = {".stl", ".ply", ".obj"}
farthest = 0  # of a tissue from its voxels, in voxels
TURNS = {"lps": (1, 1, 1), "ras": (-1, -1, 1), "untagged": (1, 1, 1)}


def read(reader, file):
    if hasattr(reader, "ReadAllFieldsOn"):
        reader.ReadAllFieldsOn()
    reader.SetFileName(str(file))
    reader.Update()
    return reader.GetOutput()


def check_place(file, measures, tissues, voxel, turn):
    """@param tissues  those that the measures are of, together"""
    volume, centre = measures[:2]
    volumes = numpy.array([tissue["volume_mm3"] for tissue in tissues])
    centres = numpy.array([tissue["barycentre_mm"] for tissue in tissues])
    # float coordinates are off by 3e-5 mm at 500 mm
    check_near(volume, volumes.sum(), 1e-5 * volume, f"{file}: volume")
    distance = numpy.linalg.norm(centre * turn - volumes @ centres / volumes.sum()) / voxel
    check(distance < 0.1, f"{file}: the barycentre is off by {distance} voxels")
    global farthest
    farthest = max(farthest, distance)


def check_volume(file, tissues, voxel, turn):
    grid = read(VOLUMES[file.suffix](), file)
    points = vtk_to_numpy(grid.GetPoints().GetData())
    tets = vtk_to_numpy(grid.GetCells().GetConnectivityArray()).reshape(-1, 4)
    labels = vtk_to_numpy(grid.GetCellData().GetScalars())
    check(grid.GetCellData().GetScalars().GetName() == "labels", f"{file}: active scalars")
    colors = grid.GetCellData().GetArray("RGB")
    check(colors.GetNumberOfComponents() == 3 and vtk_to_numpy(colors).dtype == numpy.uint8, f"{file}: RGB")
    for tissue in tissues:
        own = tets[labels == tissue["label"]]
        check(len(own) == tissue["tets"], f"{file}: {len(own)} tets")
        measures = tet_measures(points, own)
        check(measures[2] > 0, f"{file}: a tet is turned")
        check_place(file, measures, [tissue], voxel, turn)


def check_surface(file, tissues, voxel, turn):
    data = read(SURFACES[file.suffix](), file)
    points = vtk_to_numpy(data.GetPoints().GetData())
    triangles = vtk_to_numpy(data.GetPolys().GetConnectivityArray()).reshape(-1, 3)
    check_place(file, surface_measures(points, triangles), tissues, voxel, turn)
    if file.suffix == ".ply":
        colors = data.GetPointData().GetArray("RGB")
        check(colors is not None and colors.GetDataTypeAsString() == "unsigned char", f"{file}: RGB of the nodes")
    if file.suffix in WITHOUT_LABELS:
        return
    labels = vtk_to_numpy(data.GetCellData().GetScalars())
    for tissue in tissues:
        own = triangles[labels == tissue["label"]]
        check_place(file, surface_measures(points, own), [tissue], voxel, turn)


facts = expected()
count = 0
for stem, tissues in facts["files"].items():
    for space, turn in TURNS.items():
        for extension in [*VOLUMES, *SURFACES]:
            file = folder() / space / (stem + extension)
            check_one = check_volume if extension in VOLUMES else check_surface
            check_one(file, tissues, facts["voxel_mm"], numpy.array(turn))
            count += 1
print(f"{count} files, barycentres off by {farthest:.3f} voxels at most")
