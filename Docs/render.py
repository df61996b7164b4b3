"""Draws tetrahedral meshes: tissues in their colours, cut between tets, every edge shown.

Needs Debian's python3-vtk9 and a display (xvfb-run will do).
"""

import numpy as np
import vtk
from vtk.util.numpy_support import numpy_to_vtk, vtk_to_numpy

SUPERSAMPLING = 3  # rendered larger by this, then averaged: fine lines and no stairs
EDGE_WIDTH = 0.45  # pixels
COLOUR_STEP = 8  # of 256: what the eye misses and the file size feels


def read_mesh(file):
    reader = vtk.vtkXMLUnstructuredGridReader()
    reader.SetFileName(str(file))
    reader.Update()
    return reader.GetOutput()


def boundary_nodes(mesh):
    """True for the nodes on the mesh's surface."""
    surface = vtk.vtkDataSetSurfaceFilter()
    surface.SetInputData(mesh)
    surface.PassThroughPointIdsOn()
    surface.Update()
    flags = np.zeros(mesh.GetNumberOfPoints(), bool)
    flags[vtk_to_numpy(surface.GetOutput().GetPointData().GetArray("vtkOriginalPointIds"))] = True
    return flags


def cut(mesh, planes):
    """The tets with their centre on the positive side of every plane (point, normal)."""
    corners = vtk_to_numpy(mesh.GetCells().GetConnectivityArray()).reshape(-1, 4)
    centres = vtk_to_numpy(mesh.GetPoints().GetData())[corners].mean(axis=1)
    keep = np.ones(len(corners), bool)
    for point, normal in planes:
        keep &= (centres - np.asarray(point)) @ np.asarray(normal) > 0
    ids = vtk.vtkIdTypeArray()
    ids.DeepCopy(numpy_to_vtk(np.flatnonzero(keep), array_type=vtk.VTK_ID_TYPE))
    node = vtk.vtkSelectionNode()
    node.SetFieldType(vtk.vtkSelectionNode.CELL)
    node.SetContentType(vtk.vtkSelectionNode.INDICES)
    node.SetSelectionList(ids)
    selection = vtk.vtkSelection()
    selection.AddNode(node)
    extract = vtk.vtkExtractSelection()
    extract.SetInputData(0, mesh)
    extract.SetInputData(1, selection)
    extract.Update()
    return extract.GetOutput()


def surface_of(mesh, planes, colour):
    """Surface of the cut mesh; the faces that the cut laid open are lighter than the tissue's own surface."""
    on_boundary = numpy_to_vtk(boundary_nodes(mesh).astype(np.uint8))
    on_boundary.SetName("boundary")
    mesh.GetPointData().AddArray(on_boundary)
    surface = vtk.vtkDataSetSurfaceFilter()
    surface.SetInputData(cut(mesh, planes) if planes else mesh)
    surface.Update()
    faces = surface.GetOutput()
    if faces.GetNumberOfCells() == 0:
        return faces
    triangles = vtk_to_numpy(faces.GetPolys().GetConnectivityArray()).reshape(-1, 3)
    # No inner face of a Sinew mesh has three nodes on the surface (condition T3): such a face is surface.
    own = vtk_to_numpy(faces.GetPointData().GetArray("boundary"))[triangles].all(axis=1)
    colours = np.where(own[:, None], colour, 1 - 0.6 * (1 - np.asarray(colour)))
    array = numpy_to_vtk((255 * colours).astype(np.uint8), deep=True)
    array.SetName("colours")
    faces.GetCellData().SetScalars(array)
    return faces


def actor(faces, colour):
    mapper = vtk.vtkPolyDataMapper()
    mapper.SetInputData(faces)
    mapper.SetResolveCoincidentTopologyToPolygonOffset()
    result = vtk.vtkActor()
    result.SetMapper(mapper)
    look = result.GetProperty()
    look.SetInterpolationToFlat()
    look.SetAmbient(0.3)
    look.SetDiffuse(0.78)
    look.SetSpecular(0.06)
    look.EdgeVisibilityOn()
    look.SetEdgeColor(*(0.32 * np.asarray(colour)))
    look.SetLineWidth(EDGE_WIDTH * SUPERSAMPLING)
    return result


def streamlines(mesh, count):
    """Lines along the cell array `fibres`, through some tets of the middle third; thinned at random, always alike."""
    nodes = vtk.vtkCellDataToPointData()
    nodes.SetInputData(mesh)
    corners = vtk_to_numpy(mesh.GetCells().GetConnectivityArray()).reshape(-1, 4)
    centres = vtk_to_numpy(mesh.GetPoints().GetData())[corners].mean(axis=1)
    low, high = centres[:, 2].min(), centres[:, 2].max()
    middle = centres[np.abs(centres[:, 2] - (low + high) / 2) < 0.03 * (high - low)]
    points = vtk.vtkPoints()
    points.SetData(numpy_to_vtk(np.random.default_rng(1).permutation(middle)[:count], deep=True))
    seeds = vtk.vtkPolyData()
    seeds.SetPoints(points)
    tracer = vtk.vtkStreamTracer()
    tracer.SetInputConnection(nodes.GetOutputPort())
    tracer.SetSourceData(seeds)
    tracer.SetInputArrayToProcess(0, 0, 0, vtk.vtkDataObject.FIELD_ASSOCIATION_POINTS, "fibres")
    tracer.SetIntegrationDirectionToBoth()
    tracer.SetIntegratorTypeToRungeKutta4()
    tracer.SetMaximumPropagation(2 * (high - low))
    return tracer


def fibre_actor(mesh, count, colours):
    """Fibres as tubes, muscle in the first colour and tendon in the second."""
    tubes = vtk.vtkTubeFilter()
    lines = streamlines(mesh, count)
    tubes.SetInputConnection(lines.GetOutputPort())
    tubes.SetRadius(0.35)
    tubes.SetNumberOfSides(10)
    table = vtk.vtkColorTransferFunction()
    for place, colour in enumerate(colours):
        table.AddRGBPoint(place, *colour)
    mapper = vtk.vtkPolyDataMapper()
    mapper.SetInputConnection(tubes.GetOutputPort())
    mapper.SetScalarModeToUsePointFieldData()
    mapper.SelectColorArray("tendon")
    mapper.SetLookupTable(table)
    result = vtk.vtkActor()
    result.SetMapper(mapper)
    return result


# Of viridis: blue for the least, yellow for the largest.
VIRIDIS = [(0.27, 0.00, 0.33), (0.23, 0.32, 0.55), (0.13, 0.57, 0.55), (0.37, 0.79, 0.38), (0.99, 0.91, 0.14)]


def value_actors(mesh, array, title, limits):
    """The surface of a mesh in the colours of a cell array, and the bar that tells them."""
    surface = vtk.vtkDataSetSurfaceFilter()
    surface.SetInputData(mesh)
    surface.Update()
    table = vtk.vtkColorTransferFunction()
    for place, colour in zip(np.linspace(*limits, len(VIRIDIS)), VIRIDIS):
        table.AddRGBPoint(place, *colour)
    body = actor(surface.GetOutput(), (0.3, 0.3, 0.3))
    mapper = body.GetMapper()
    mapper.SetScalarModeToUseCellFieldData()
    mapper.SelectColorArray(array)
    mapper.SetLookupTable(table)
    bar = vtk.vtkScalarBarActor()
    bar.SetLookupTable(table)
    bar.SetTitle(title)
    bar.SetNumberOfLabels(4)
    bar.SetLabelFormat("%.1f")
    bar.UnconstrainedFontSizeOn()
    for text, size in ((bar.GetLabelTextProperty(), 14), (bar.GetTitleTextProperty(), 15)):
        text.SetColor(0.15, 0.15, 0.15)
        text.SetFontSize(size * SUPERSAMPLING)
        text.ItalicOff()
        text.BoldOff()
        text.ShadowOff()
    bar.SetOrientationToHorizontal()
    bar.SetPosition(0.35, 0.31)
    bar.SetWidth(0.3)
    bar.SetHeight(0.07)
    return body, bar


def add_lights(renderer):
    """A key light over the viewer's left shoulder, a weak fill from the right, a rim from behind."""
    renderer.RemoveAllLights()
    for position, intensity in (((-0.5, 0.8, 1), 0.85), ((0.9, 0.1, 0.6), 0.35), ((0, 0.6, -1), 0.2)):
        light = vtk.vtkLight()
        light.SetLightTypeToCameraLight()
        light.SetPosition(*position)
        light.SetFocalPoint(0, 0, 0)
        light.SetIntensity(intensity)
        renderer.AddLight(light)
    renderer.AutomaticLightCreationOff()


def write_picture(window, width, file):
    """Crops to what was drawn, averages down to `width` pixels, and rounds the colours, for small files."""
    grab = vtk.vtkWindowToImageFilter()
    grab.SetInput(window)
    grab.ReadFrontBufferOff()
    grab.Update()
    image = grab.GetOutput()
    columns, rows, _ = image.GetDimensions()
    pixels = vtk_to_numpy(image.GetPointData().GetScalars()).reshape(rows, columns, 3)
    drawn = (pixels < 250).any(axis=2)
    box = []
    for axis in (0, 1):
        used = np.flatnonzero(drawn.any(axis=axis))
        margin = 12 * SUPERSAMPLING
        box += [max(used[0] - margin, 0), min(used[-1] + margin, drawn.shape[1 - axis] - 1)]
    crop = vtk.vtkExtractVOI()
    crop.SetInputData(image)
    crop.SetVOI(*box, 0, 0)
    resize = vtk.vtkImageResize()
    resize.SetInputConnection(crop.GetOutputPort())
    resize.SetOutputDimensions(width, round(width * (box[3] - box[2]) / (box[1] - box[0])), 1)
    kernel = vtk.vtkImageSincInterpolator()
    kernel.SetWindowFunctionToLanczos()
    kernel.AntialiasingOn()
    resize.SetInterpolator(kernel)
    resize.Update()
    small = resize.GetOutput()
    values = vtk_to_numpy(small.GetPointData().GetScalars())
    values[:] = np.minimum((values.astype(int) + COLOUR_STEP // 2) // COLOUR_STEP * COLOUR_STEP, 255)
    writer = vtk.vtkPNGWriter()
    writer.SetInputData(small)
    writer.SetFileName(str(file))
    writer.SetCompressionLevel(9)
    writer.Write()


def darken_hollows(renderer, radius):
    """Ambient occlusion within `radius`, mm."""
    effect = vtk.vtkSSAOPass()
    effect.SetRadius(radius)
    effect.SetBias(0.05 * radius)
    effect.SetKernelSize(128)
    effect.BlurOn()
    steps = vtk.vtkRenderStepsPass()
    effect.SetDelegatePass(steps)
    renderer.SetPass(effect)


def render(scene, meshes, colours, file):
    """Draws a scene: {width, view: (from, up), parts: {tissue: planes}}; the tissue's mesh is `meshes`/tissue.vtu.

    With `places` {tissue: offset} parts are shown elsewhere, mm; with `fibres` the fibres of a mesh too, with `values` a
    mesh in the colours of a cell array.
    """
    renderer = vtk.vtkRenderer()
    renderer.SetBackground(1, 1, 1)
    for tissue, planes in scene["parts"].items():
        mesh = read_mesh(meshes / f"{tissue}.vtu")
        part = actor(surface_of(mesh, planes, colours[tissue]), colours[tissue])
        part.SetPosition(*scene.get("places", {}).get(tissue, (0, 0, 0)))
        renderer.AddActor(part)
    if fibres := scene.get("fibres"):
        renderer.AddActor(fibre_actor(read_mesh(meshes / f"{fibres['mesh']}.vtu"), fibres["count"], fibres["colours"]))
    if values := scene.get("values"):
        mesh = read_mesh(meshes / f"{values['mesh']}.vtu")
        for part in value_actors(mesh, values["array"], values["title"], values["range"]):
            renderer.AddViewProp(part)
    add_lights(renderer)
    darken_hollows(renderer, scene["hollows"])
    window = vtk.vtkRenderWindow()
    window.SetOffScreenRendering(1)
    window.SetMultiSamples(0)
    side = round(1.2 * SUPERSAMPLING * scene["width"])
    window.SetSize(side, side)
    window.AddRenderer(renderer)
    camera = renderer.GetActiveCamera()
    camera.SetFocalPoint(0, 0, 0)
    camera.SetPosition(*scene["view"][0])
    camera.SetViewUp(*scene["view"][1])
    camera.SetViewAngle(18)
    renderer.ResetCamera()
    window.Render()
    write_picture(window, scene["width"], file)
