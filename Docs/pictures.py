"""The pictures of the README: pictures.py MESHES, where MESHES holds a folder of meshes per scene."""

import sys
from pathlib import Path

from render import render

TENDON = (0.87, 0.85, 0.80)
ARM = {
    "humerus": (0.95, 0.84, 0.57),
    "biceps": (0.75, 0.31, 0.29),
    "triceps": (0.66, 0.25, 0.33),
    "biceps_tendons": TENDON,
    "triceps_tendons": TENDON,
    "fat": (0.93, 0.80, 0.38),
    "skin": (0.88, 0.67, 0.56),
}
TORUS = {"torus": (0.85, 0.55, 0.30)}
FROG = {
    "blood": (0.80, 0.20, 0.20),
    "brain": (0.94, 0.65, 0.67),
    "duodenum": (0.91, 0.59, 0.31),
    "eye_retina": (0.27, 0.35, 0.59),
    "eye_white": (0.92, 0.92, 0.94),
    "heart": (0.75, 0.16, 0.22),
    "ileum": (0.87, 0.49, 0.41),
    "kidney": (0.59, 0.33, 0.24),
    "large_intestine": (0.92, 0.75, 0.37),
    "liver": (0.59, 0.27, 0.22),
    "lung": (0.94, 0.59, 0.59),
    "nerve": (0.96, 0.84, 0.27),
    "skeleton": (0.95, 0.91, 0.80),
    "spleen": (0.49, 0.20, 0.35),
    "stomach": (0.86, 0.69, 0.51),
}

# phantom: place in the picture, mm; planes; tissues
REPAIRS = {
    "drilled-femur": (0, [], {"femur": (0.95, 0.84, 0.57)}),
    "gapped-muscle": (40, [], {"muscle": (0.75, 0.31, 0.29)}),
    "torn-vessel": (66, [], {"vessel": (0.84, 0.12, 0.12)}),
    "speckled-liver": (110, [((0, 0, 0), (0, 1, 0))], {"liver": (0.70, 0.40, 0.30)}),
    "overlapping-muscles": (
        160,
        [((0, 0, 0), (0, 1, 0))],
        {"vastus_medialis": (0.75, 0.31, 0.29), "rectus_femoris": (0.45, 0.25, 0.53)},
    ),
}
REPAIR_PARTS = {
    f"{phantom}-{when}/{tissue}": (colour, planes, (x, 0, 0 if when == "before" else -104))
    for phantom, (x, planes, tissues) in REPAIRS.items()
    for tissue, colour in tissues.items()
    for when in ("before", "after")
}

LEFT_HALF = [((0, 0, 0), (-1, 0, 0))]
SLICE = [((0, 0, 8), (0, 0, -1)), ((0, 0, -24), (0, 0, 1))]

# view: the camera's direction from the middle, and what is up, LPS; parts: tissue -> planes (point, normal to what stays);
# hollows: how far they shade, mm
SCENES = {
    "upper-arm": {
        "meshes": "upper-arm",
        "colours": ARM,
        "width": 900,
        "view": ((1, -0.35, 0.22), (-0.35, -1, 0)),
        "hollows": 6,
        "parts": {tissue: LEFT_HALF if tissue in ("skin", "fat") else [] for tissue in ARM},
    },
    "cross-section": {
        "meshes": "upper-arm",
        "colours": ARM,
        "width": 480,
        "view": ((-0.25, -0.45, 1), (0, -1, 0)),
        "hollows": 4,
        "parts": {tissue: SLICE for tissue in ("skin", "fat", "biceps", "triceps", "humerus")},
    },
    "graded": {
        "meshes": "torus",
        "colours": TORUS,
        "width": 640,
        "view": ((0.3, -1, 0.75), (0, 0, 1)),
        "hollows": 3,
        "parts": {"torus": [((0, 0, 0), (0, 1, 0))]},
    },
    "repair": {
        "meshes": "repair",
        "colours": {part: colour for part, (colour, _, _) in REPAIR_PARTS.items()},
        "width": 900,
        "view": ((0, -1, 0.05), (0, 0, 1)),
        "hollows": 4,
        "parts": {part: planes for part, (_, planes, _) in REPAIR_PARTS.items()},
        "places": {part: place for part, (_, _, place) in REPAIR_PARTS.items()},
    },
    "fibres": {
        "meshes": "muscle",
        "colours": ARM,
        "width": 760,
        "view": ((0.6, -1, 0.15), (1, 0.6, 0)),
        "hollows": 2.5,
        "parts": {"humerus": []},
        "fibres": {"mesh": "fibres", "count": 260, "colours": ((0.86, 0.30, 0.27), (0.95, 0.91, 0.80))},
    },
    "contracted": {
        "meshes": "muscle",
        "colours": ARM,
        "width": 760,
        "view": ((0.6, -1, 0.15), (1, 0.6, 0)),
        "hollows": 2.5,
        "parts": {"humerus": []},
        "values": {"mesh": "contracted", "array": "aspect_ratio", "title": "aspect ratio", "range": (1.2, 4.8)},
    },
    "frog": {
        "meshes": "frog",
        "colours": FROG,
        "width": 640,
        "view": ((0.2, 0.5, -1), (0, -1, 0)),
        "hollows": 20,
        "parts": {tissue: [] for tissue in FROG},
    },
}


def main(meshes):
    for name, scene in SCENES.items():
        if (meshes / scene["meshes"]).is_dir():
            render(scene, meshes / scene["meshes"], scene["colours"], Path(__file__).parent / f"{name}.png")


main(Path(sys.argv[1]))
