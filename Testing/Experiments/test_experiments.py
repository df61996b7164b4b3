"""test_experiments.py SINEW FLIPCONDITIONS: the experiment with few tets and frames, from the meshes to the tables."""
import csv
import json
import pathlib
import subprocess
import sys
import tempfile

SCRIPT = pathlib.Path(__file__).with_name("compare_methods.py")
METHODS = ["optimization", "fem"]
DECENT = ["--max-aspect-ratio", "6", "--min-dihedral", "12"]  # what flips may make here: a small mesh has few good ones


def experiment(sinew, flip, out):
    subprocess.run([sys.executable, "-B", SCRIPT, out, "--sinew", sinew, "--flip", flip, "--methods", *METHODS, "--trials",
                    "contract", "--tets", "1500", "--frames", "4"], check=True)


def check_tables(out):
    rows = list(csv.DictReader((out / "results.csv").open()))
    assert sorted(row["mesh"] for row in rows) == sorted([*METHODS, "flipped"]), rows
    for row in rows:
        assert row["completed"] == "yes", row
        assert float(row["ar_worst"]) > float(row["ar_at_rest"]) > 1, row
        assert 0 < float(row["min_volume_ratio"]) < 1, row
    assert "**biceps, contract**" in (out / "results.md").read_text()
    assert (out / "biceps-contract.svg").stat().st_size > 1000


def check_flips(flip, out):
    """From a mesh without violations to one with many, and nothing else changed."""
    mesh, flipped = out / "biceps" / "optimization.vtu", out / "again.vtu"
    made = json.loads(subprocess.run([flip, mesh, flipped, *DECENT], check=True, capture_output=True, text=True).stdout)
    assert made["flips"] > 5 and made["t3"] >= made["flips"], made
    assert made["inverted"] == made["nonmanifold"] == 0 and made["min_dihedral_deg"] >= 12, made
    none = json.loads(subprocess.run([flip, mesh, out / "same.vtu", "--max-aspect-ratio", "1"], check=True, capture_output=True,
                                     text=True).stdout)
    assert none["flips"] == none["t2"] == none["t3"] == 0, none
    assert abs(none["volume_mm3"] / made["volume_mm3"] - 1) < 1e-6, (none, made)


def main():
    sinew, flip = sys.argv[1:]
    with tempfile.TemporaryDirectory() as folder:
        out = pathlib.Path(folder)
        experiment(sinew, flip, out)
        check_tables(out)
        check_flips(flip, out)


if __name__ == "__main__":
    main()
