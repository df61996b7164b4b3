"""What the scripts share: the expected values, skipping, and measures of meshes."""
import json
import pathlib
import sys

SKIPPED = 77


def need(module):
    """Imports a module of another program's, or ends the test as skipped."""
    try:
        return __import__(module)
    except ImportError as error:
        print(f"skipped: {error}; install Debian's packages with Scripts/install-dependencies.sh --testing")
        sys.exit(SKIPPED)


numpy = need("numpy")


def folder():
    return pathlib.Path(sys.argv[1])


def expected():
    return json.loads((folder() / "expected.json").read_text(encoding="utf-8"))


def tet_measures(points, tets):
    """Volume and barycentre; the smallest volume of a tet is negative when one is turned inside out."""
    corners = numpy.asarray(points, float)[numpy.asarray(tets)]
    edges = corners[:, 1:] - corners[:, :1]
    volumes = numpy.linalg.det(edges) / 6
    return volumes.sum(), volumes @ corners.mean(axis=1) / volumes.sum(), volumes.min()


def surface_measures(points, triangles):
    """The same of what a closed surface encloses, as tets from a point near it."""
    points = numpy.asarray(points, float)
    near = points.mean(axis=0)
    corners = points[numpy.asarray(triangles)] - near
    volumes = numpy.linalg.det(corners) / 6
    return volumes.sum(), near + volumes @ corners.sum(axis=1) / 4 / volumes.sum()


def check(true, what):
    if not true:
        sys.exit(f"FAILED: {what}")


def check_near(value, wanted, tolerance, what):
    check(numpy.all(numpy.abs(numpy.asarray(value) - wanted) <= tolerance), f"{what}: {value}, expected {wanted}")
