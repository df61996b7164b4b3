"""Opens the scene as 3D Slicer would: every file that it names is there after Slicer's own URL decoding, VTK reads every
mesh, marks in the files and the scene agree, names are the tissues'."""
import xml.etree.ElementTree

from exchange import check, expected, folder, need

need("vtkmodules")
from vtkmodules.vtkIOXML import vtkXMLUnstructuredGridReader

# vtkMRMLNode::URLDecodeString, in its order
CODES = [("%22", '"'), ("%3C", "<"), ("%3E", ">"), ("%27", "'"), ("%20", " "), ("%25", "%")]


def decoded(name):
    for code, character in CODES:
        name = name.replace(code, character)
    return name


root = xml.etree.ElementTree.parse(folder() / "scene" / "scene.mrml").getroot()
nodes = {node.get("id"): node for node in root}
check(len(nodes) == len(root), "ids are unique")
check(int(root.get("version").split()[2]) > 0, "the version has a revision")
for node in root:
    if node.get("fileName"):
        check((folder() / "scene" / decoded(node.get("fileName"))).is_file(), f"{node.get('fileName')} is there")

names = []
for model in root.findall("Model"):
    storage, display = nodes[model.get("storageNodeRef")], nodes[model.get("displayNodeRef")]
    reader = vtkXMLUnstructuredGridReader()
    reader.SetFileName(str(folder() / "scene" / decoded(storage.get("fileName"))))
    reader.Update()
    grid = reader.GetOutput()
    check(grid.GetNumberOfCells() > 0, f"{model.get('name')} has cells")
    space = grid.GetFieldData().GetAbstractArray("SPACE").GetValue(0)
    check(space == storage.get("coordinateSystem") == "LPS", f"{model.get('name')}: {space}")
    shown = [round(255 * float(part)) for part in display.get("color").split()]
    check(list(grid.GetCellData().GetArray("RGB").GetTuple(0)) == shown, f"{model.get('name')}: colours agree")
    names.append(model.get("name"))
wanted = [tissue["name"] for tissue in expected()["files"]["combined"]]
check(names == wanted, f"{names}")
print(f"{len(names)} models")
