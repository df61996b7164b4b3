#!/usr/bin/env python3
"""Runs CGAL's Mesh_3 and Sinew as whole processes on the same tissues at the same number of tets.

    compare.py INPUT TISSUE... [--tets N...] [--runs N] [--build DIR | --sinew FILE --cgal FILE]

For each tissue and target, first the size parameter of each program is searched until the number of tets is
within 5 % of the target; then the programs run in turn (A B C A B C ...) and the medians are printed as a
Markdown table. CPU seconds are user + system of the whole process on one thread, reading and writing
included; memory is the largest resident set. Quality is measured by `sinew quality` for all alike.
"""

import argparse
import datetime
import json
import math
import os
import pathlib
import statistics
import subprocess
import sys
import tempfile

TOLERANCE = 0.05  # of the number of tets
MAX_TRIALS = 12  # of the size search
AFTER_FAILURE = 0.99  # times the size, where a program fails
SOURCE = pathlib.Path(__file__).resolve().parents[2]


class Usage:
    """What a finished process took."""

    def __init__(self, rusage):
        self.seconds = rusage.ru_utime + rusage.ru_stime
        self.megabytes = rusage.ru_maxrss / 1024


def run(command):
    """Runs a command to its end. Returns what it took; raises on failure, with its messages."""
    with tempfile.TemporaryFile() as messages:
        process = subprocess.Popen([str(word) for word in command], stdout=subprocess.DEVNULL, stderr=messages)
        _, status, rusage = os.wait4(process.pid, 0)
        process.returncode = os.waitstatus_to_exitcode(status)
        if process.returncode != 0:
            messages.seek(0)
            raise RuntimeError(f"{command[0]}: {messages.read().decode().strip()}")
    return Usage(rusage)


class Mesher:
    """A program that meshes one tissue with one size parameter, mm."""

    def __init__(self, name, command, mesh):
        self.name = name
        self.command = command  # size -> command line
        self.mesh = mesh  # the file it writes


class Comparison:
    """One tissue of one segmentation; all files in one temporary folder."""

    def __init__(self, programs, source, tissue, folder):
        self.programs, self.source, self.tissue, self.folder = programs, source, tissue, folder
        info = self.json_of("info", source)
        wanted = [t for t in info["tissues"] if tissue in (t["name"], str(t["label"]))]
        if len(wanted) != 1:
            raise RuntimeError(f"{source}: {len(wanted)} tissues fit '{tissue}'")
        self.name, self.voxels, self.volume = (wanted[0][key] for key in ("name", "voxels", "volume_mm3"))

    def json_of(self, *arguments):
        """The machine-readable result of a command of sinew."""
        document = self.folder / "result.json"
        run([self.programs.sinew, *arguments, "--json", document, "--force"])
        return json.loads(document.read_text())

    def sinew(self, name, *size_options):
        folder = self.folder / f"sinew{''.join(size_options)}"
        mesh = folder / "mesh.vtu"

        def command(size):
            sizes = [word for option in ("--edge-length", *size_options) for word in (option, f"{size:.6g}mm")]
            return [self.programs.sinew, "mesh", self.source, "--tissue", self.tissue, "-o", folder, "--force",
                    "--quiet", "--threads", 1, *sizes]

        return Mesher(name, command, mesh)

    def cgal(self, name, *flags):
        mesh = self.folder / f"cgal{''.join(flags)}.vtu"

        def command(size):
            return [self.programs.cgal, self.source, self.tissue, f"{size:.6g}", mesh, *flags]

        return Mesher(name, command, mesh)

    def mesh_of(self, mesher):
        """The file with the mesh: Sinew names it after the tissue."""
        if mesher.mesh.exists():
            return mesher.mesh
        report = json.loads((mesher.mesh.parent / "report.json").read_text())
        return mesher.mesh.parent / report["tissues"][0]["file"]

    def quality(self, mesher):
        return self.json_of("quality", self.mesh_of(mesher), "--reference", self.source, "--tissue",
                            self.tissue)["meshes"][0]

    def tets(self, mesher, size):
        run(mesher.command(size))
        return self.json_of("quality", self.mesh_of(mesher))["meshes"][0]["tets"]

    def size_for(self, mesher, target):
        """Searches the size that gives the target, by secants of log tets over log size between brackets."""
        trials = []
        size = (6 * math.sqrt(2) * self.volume / target) ** (1 / 3)
        for _ in range(MAX_TRIALS):
            try:
                tets = self.tets(mesher, size)
            except RuntimeError as error:
                print(f"  {mesher.name}: size {size:.6g} mm FAILED: {error}", file=sys.stderr)
                size *= AFTER_FAILURE
                continue
            print(f"  {mesher.name}: size {size:.4g} mm gives {tets} tets", file=sys.stderr)
            if abs(tets - target) <= TOLERANCE * target:
                return size
            trials.append((math.log(size), math.log(max(tets, 1) / target)))
            size = math.exp(next_log_size(trials))
        raise RuntimeError(f"{mesher.name}: no size within {MAX_TRIALS} trials gives {target} tets of "
                           f"'{self.name}'")

    def reading_seconds(self, runs):
        command = [self.programs.cgal, self.source, self.tissue, 1, self.folder / "none.vtu", "--read-only"]
        return statistics.median(run(command).seconds for _ in range(runs))

    def rows(self, target, runs):
        """Meshers with their usages and qualities: Sinew as by default, with cubes of one size, CGAL, and
        CGAL without its sliver removal."""
        sinew, cgal = self.sinew("Sinew"), self.cgal("CGAL")
        uniform = self.sinew("Sinew, one size", "--max-edge-length", "--min-edge-length")
        plain = self.cgal("CGAL, no exude, no perturb", "--no-exude", "--no-perturb")
        unexuded = self.cgal("CGAL, no exude", "--no-exude")
        sizes = {mesher: self.size_for(mesher, target) for mesher in (sinew, uniform, cgal)}
        sizes[unexuded] = sizes[plain] = sizes[cgal]
        usages = {mesher: [] for mesher in sizes}
        for _ in range(runs):
            for mesher, size in sizes.items():
                usages[mesher].append(run(mesher.command(size)))
        reading = self.reading_seconds(runs)
        return [Row(mesher, sizes[mesher], usages[mesher], self.quality(mesher), reading) for mesher in sizes]


def next_log_size(trials):
    """The next log size to try, from pairs (log size, log of tets over target) so far."""
    above = max((t for t in trials if t[1] > 0), default=None)  # too many tets: the largest such size
    below = min((t for t in trials if t[1] <= 0), default=None)
    if above and below and above[0] < below[0]:
        weight = above[1] / (above[1] - below[1])
        return above[0] + min(max(weight, 0.1), 0.9) * (below[0] - above[0])
    last = trials[-1]
    return last[0] + last[1] / 2.5  # between the powers of a surface and of a volume


class Row:
    """One mesher's medians."""

    def __init__(self, mesher, size, usages, quality, reading):
        self.name, self.size = mesher.name, size
        self.seconds = statistics.median(usage.seconds for usage in usages)
        self.megabytes = statistics.median(usage.megabytes for usage in usages)
        self.inner_seconds = self.seconds - reading
        self.tets = quality["tets"]
        self.shape, self.conditions, self.fidelity = (quality[key] for key in ("quality", "conditions",
                                                                               "fidelity"))

    def rate(self):
        return self.tets / self.seconds

    def inner_rate(self):
        return self.tets / self.inner_seconds

    def cells(self):
        shape, conditions, fidelity = self.shape, self.conditions, self.fidelity
        volume_error = 100 * (fidelity["volume_mm3"] / fidelity["label_volume_mm3"] - 1)
        return [self.name, f"{self.tets:,}", f"{self.seconds:.2f}", f"{self.inner_seconds:.2f}",
                f"{self.rate() / 1000:.1f} K", f"{self.inner_rate() / 1000:.1f} K", f"{self.megabytes:.0f}",
                f"{shape['max_aspect_ratio']:.2f}", f"{shape['mean_aspect_ratio']:.2f}",
                f"{shape['min_dihedral_deg']:.1f} - {shape['max_dihedral_deg']:.1f}",
                str(conditions["nonmanifold_edges"] + conditions["nonmanifold_nodes"]),
                f"{conditions['tets_with_four_boundary_nodes']:,}",
                f"{conditions['interior_edges_between_boundary_nodes']:,}", f"{volume_error:+.2f}"]


COLUMNS = ["", "tets", "CPU s", "without reading", "tets per CPU s", "without reading", "peak MB", "max AR",
           "mean AR", "dihedral, deg", "T1", "T2", "T3", "volume, %"]


def print_table(comparison, target, rows):
    print(f"\n**{comparison.name}** ({comparison.voxels:,} voxels), {target:,} tets asked for\n")
    print("| " + " | ".join(COLUMNS) + " |")
    print("|---|" + "---:|" * (len(COLUMNS) - 1))
    for row in rows:
        print("| " + " | ".join(row.cells()) + " |")
    print("\nTets per CPU second, whole process (without reading), as multiples of CGAL's:\n")
    ours, theirs = (([row for row in rows if row.name.startswith(name)]) for name in ("Sinew", "CGAL"))
    print("| | " + " | ".join(peer.name for peer in theirs) + " |")
    print("|---|" + "---:|" * len(theirs))
    for row in ours:
        ratios = (f"{row.rate() / peer.rate():.1f} ({row.inner_rate() / peer.inner_rate():.1f})"
                  for peer in theirs)
        print(f"| {row.name} | " + " | ".join(ratios) + " |", flush=True)


def print_circumstances(options):
    model = next((line.split(":", 1)[1].strip() for line in open("/proc/cpuinfo") if "model name" in line), "?")
    commit = subprocess.run(["git", "-C", SOURCE, "describe", "--always", "--dirty"], capture_output=True,
                            text=True).stdout.strip()
    print(f"- machine: {model}, {os.cpu_count()} cores; load {os.getloadavg()[0]:.1f} at the start")
    print(f"- date: {datetime.date.today()}, commit: {commit or 'unknown'}")
    print(f"- command: `compare.py {' '.join([options.input.name, *options.tissues])} "
          f"--tets {' '.join(map(str, options.tets))} --runs {options.runs}`", flush=True)


def parse():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("input", type=pathlib.Path, help="segmentation")
    parser.add_argument("tissues", nargs="+", metavar="TISSUE", help="name or label")
    parser.add_argument("--tets", type=int, nargs="+", default=[50_000, 200_000], help="targets (%(default)s)")
    parser.add_argument("--runs", type=int, default=3, help="measured runs of each program (%(default)s)")
    parser.add_argument("--build", type=pathlib.Path, default=SOURCE / "build" / "benchmark", help="build folder")
    parser.add_argument("--sinew", type=pathlib.Path, help="the program; default in the build folder")
    parser.add_argument("--cgal", type=pathlib.Path, help="cgalMesh3; default in the build folder")
    options = parser.parse_args()
    options.sinew = (options.sinew or options.build / "Applications" / "sinew" / "sinew").absolute()
    options.cgal = (options.cgal or options.build / "Testing" / "benchmark" / "cgalMesh3").absolute()
    return options


def main():
    options = parse()
    print_circumstances(options)
    for tissue in options.tissues:
        for target in options.tets:
            with tempfile.TemporaryDirectory(prefix="sinew-comparison-") as folder:
                comparison = Comparison(options, options.input, tissue, pathlib.Path(folder))
                print_table(comparison, target, comparison.rows(target, options.runs))


if __name__ == "__main__":
    try:
        main()
    except (OSError, RuntimeError) as error:
        sys.exit(f"compare.py: {error}")
