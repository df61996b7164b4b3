#!/usr/bin/env python3
"""Which mesh serves a simulation best: the same tissue meshed by several methods, through the same trials.

    compare_methods.py OUT [FILE:TISSUE[=NAME] ...] --sinew PROGRAM [--cgal PROGRAM] [--flip PROGRAM]

Meshes every tissue (by default the biceps of the phantom upper-arm) by `sinew mesh --method ...`; with CGAL's Mesh_3 of
the same labels, with about as many tets; and takes T2 and T3 from the mesh by optimization. Puts all of them to
`sinew simulate --compare`. In OUT: results.csv, results.md, and <tissue>-<trial>.svg. What is there already is not made again.
"""
import argparse
import csv
import json
import pathlib
import subprocess
import sys

METHODS = ["optimization", "springs", "fem", "hybrid"]
TRIALS = ["contract", "compress", "indent"]
CGAL, FLIPPED = "cgal", "flipped"

# column: title, digits, value from a mesh's part of report.json
COLUMNS = {
    "mesh": ("mesh", None, lambda m: pathlib.Path(m["name"]).stem),
    "tets": ("tets", 0, lambda m: m["tets"]),
    "ar_at_rest": ("max AR at rest", 2, lambda m: m["aspect_ratio_at_rest"]),
    "ar_worst": ("at its worst", 2, lambda m: m["aspect_ratio_at_rest"] * (1 + m["aspect_ratio_growth"])),
    "growth_percent": ("growth, %", 0, lambda m: 100 * m["aspect_ratio_growth"]),
    "min_volume_ratio": ("least J", 2, lambda m: m["min_volume_ratio"]),
    "min_dihedral_deg": ("smallest dihedral, deg", 1, lambda m: m["min_dihedral_deg"]),
    "completed": ("completed", None, lambda m: "yes" if m["completed"] else f"until {100 * m['stopped_at']:.0f} %"),
}


def run(*command, may_fail=False):
    """Standard output. A trial that stops early exits with 1, and has written all the same."""
    done = subprocess.run([str(word) for word in command], capture_output=True, text=True)
    if done.returncode not in ((0, 1) if may_fail else (0,)):
        sys.exit(f"compare_methods: {' '.join(map(str, command))} failed:\n{done.stderr}")
    return done.stdout


def folder_name(name):
    return "-".join(name.split())


def sinew_mesh(options, case, method, target):
    """The tissue meshed by a method of Sinew."""
    if target.exists():
        return
    folder = target.parent / f"{method}-files"
    run(options.sinew, "mesh", case.file, "-o", folder, "--tissue", case.tissue, "--method", method,
        "--target-tets", options.tets, "--quiet", "--force")
    mesh, = folder.glob("*.vtu")
    mesh.rename(target)


def cgal_mesh(options, case, tets, target):
    """The tissue meshed by CGAL, its cell size chosen for as many tets within a tenth: their number goes with its cube."""
    if target.exists():
        return
    size = options.cell_size
    for _ in range(8):
        made = json.loads(run(options.cgal, case.file, case.tissue, size, target))["tets"]
        if abs(made / tets - 1) < 0.1:
            return
        size *= (made / tets) ** (1 / 3)
    print(f"compare_methods: CGAL's mesh of {case.name} has {made} tets, not {tets}", file=sys.stderr)


def meshes_of(options, case, folder):
    meshes = [folder / f"{method}.vtu" for method in options.methods]
    for method, mesh in zip(options.methods, meshes):
        sinew_mesh(options, case, method, mesh)
    if options.cgal:
        meshes.append(folder / f"{CGAL}.vtu")
        cgal_mesh(options, case, options.tets, meshes[-1])
    if options.flip:
        meshes.append(folder / f"{FLIPPED}.vtu")
        if not meshes[-1].exists():
            print(f"{case.name}, flipped: {run(options.flip, meshes[0], meshes[-1]).strip()}")
    return meshes


def trial_rows(options, case, trial, meshes, folder):
    out = folder / trial
    report = out / "report.json"
    if not report.exists():
        run(options.sinew, "simulate", "--compare", *meshes, f"--{trial}", "--frames", options.frames, "--no-series",
            "-o", out, "--quiet", "--force", may_fail=True)
    (options.out / f"{folder.name}-{trial}.svg").write_bytes((out / f"{trial}.svg").read_bytes())
    for mesh in json.loads(report.read_text())["meshes"]:
        yield {"tissue": case.name, "trial": trial} | {key: value(mesh) for key, (_, _, value) in COLUMNS.items()}


def text(value, digits):
    return str(value) if digits is None else f"{value:,.{digits}f}"


def write_table(rows, file):
    """One Markdown table for each tissue and trial."""
    with file.open("w") as out:
        for tissue, trial in dict.fromkeys((row["tissue"], row["trial"]) for row in rows):
            print(f"\n**{tissue}, {trial}**\n", file=out)
            print("| " + " | ".join(title for title, _, _ in COLUMNS.values()) + " |", file=out)
            print("| " + " | ".join("---" if digits is None else "---:" for _, digits, _ in COLUMNS.values()) + " |", file=out)
            for row in rows:
                if (row["tissue"], row["trial"]) == (tissue, trial):
                    print("| " + " | ".join(text(row[key], digits) for key, (_, digits, _) in COLUMNS.items()) + " |", file=out)


class Case:
    """A tissue of a segmentation, by its name or label there, and its name in the tables."""

    def __init__(self, text):
        self.file, _, tissue = text.rpartition(":")
        self.tissue, _, name = tissue.partition("=")
        self.name = name or self.tissue
        if not self.file or not self.tissue:
            raise argparse.ArgumentTypeError(f"'{text}' is not FILE:TISSUE[=NAME]")


def options_of(arguments):
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("out", type=pathlib.Path)
    parser.add_argument("cases", nargs="*", type=Case, metavar="FILE:TISSUE[=NAME]")
    parser.add_argument("--sinew", required=True)
    parser.add_argument("--cgal", help="cgalMesh3, built with SINEW_BUILD_COMPARISON")
    parser.add_argument("--flip", help="flipConditions, built with SINEW_BUILD_TESTING")
    parser.add_argument("--methods", nargs="+", default=METHODS, choices=METHODS)
    parser.add_argument("--trials", nargs="+", default=TRIALS)
    parser.add_argument("--tets", type=int, default=20000)
    parser.add_argument("--frames", type=int, default=20)
    parser.add_argument("--cell-size", type=float, default=3, help="to begin CGAL's search with, mm")
    return parser.parse_args(arguments)


def main():
    options = options_of(sys.argv[1:])
    options.out.mkdir(parents=True, exist_ok=True)
    if not options.cases:
        phantom = options.out / "upper-arm.seg.nrrd"
        run(options.sinew, "phantom", "upper-arm", "-o", phantom, "--force")
        options.cases = [Case(f"{phantom}:biceps")]
    rows = []
    for case in options.cases:
        folder = options.out / folder_name(case.name)
        folder.mkdir(exist_ok=True)
        meshes = meshes_of(options, case, folder)
        for trial in options.trials:
            rows += trial_rows(options, case, trial, meshes, folder)
    with (options.out / "results.csv").open("w", newline="") as out:
        table = csv.DictWriter(out, rows[0])
        table.writeheader()
        table.writerows(rows)
    write_table(rows, options.out / "results.md")
    print((options.out / "results.md").read_text())


if __name__ == "__main__":
    main()
