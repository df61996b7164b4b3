"""A reader of Sinew's .inp files, and planes through their tets."""
from exchange import numpy


class Mesh:
    """Nodes, and tets of 4 or 10 nodes; sets of node indices and surfaces of (tet, face) by their names."""

    def __init__(self, file):
        points, tets, self.sets, self.surfaces, self.elsets = [], [], {}, {}, []
        with open(file, encoding="utf-8") as lines:
            for line in lines:
                if line.startswith("**"):
                    continue
                words = [word.strip() for word in line.split(",")]
                if line.startswith("*"):
                    card = words[0]
                    options = dict(word.split("=") for word in words[1:])
                    into = self._begin(card, options)
                elif card == "*NODE":
                    points.append([float(word) for word in words[1:]])
                elif card == "*ELEMENT":
                    tets.append([int(word) - 1 for word in words[1:]])
                elif card == "*SURFACE":
                    into.append((int(words[0]) - 1, int(words[1].removeprefix("S"))))
                elif card == "*NSET":
                    into += [int(word) - 1 for word in words]
        self.points = numpy.array(points)
        self.tets = numpy.array(tets)
        self.corners = self.tets[:, :4]

    def _begin(self, card, options):
        if card == "*ELEMENT":
            self.elsets.append(options["ELSET"])
        if card == "*NSET":
            return self.sets.setdefault(options["NSET"], [])
        if card == "*SURFACE":
            return self.surfaces.setdefault(options["NAME"], [])
        return None


class Section:
    """A plane through a mesh: its triangles, as areas and corners interpolated between two nodes."""

    def __init__(self, mesh, heights, level):
        above = heights[mesh.corners] - level
        self.area, self.pieces = 0.0, []
        for tet in numpy.flatnonzero((above.min(axis=1) < 0) & (above.max(axis=1) > 0)):
            self._add(mesh, mesh.corners[tet], above[tet])

    def _add(self, mesh, nodes, above):
        upper, lower = numpy.flatnonzero(above > 0), numpy.flatnonzero(above <= 0)
        corners = [(nodes[i], nodes[j], above[i] / (above[i] - above[j])) for i in upper for j in lower]
        if len(corners) == 4:
            corners = [corners[0], corners[1], corners[3], corners[2]]
        places = numpy.array([self._between(mesh.points, corner) for corner in corners])
        for k in range(1, len(corners) - 1):
            area = numpy.linalg.norm(numpy.cross(places[k] - places[0], places[k + 1] - places[0])) / 2
            self.area += area
            self.pieces.append((area, (corners[0], corners[k], corners[k + 1])))

    @staticmethod
    def _between(values, corner):
        i, j, part = corner
        return values[i] * (1 - part) + values[j] * part

    def mean(self, values):
        """The mean over the area of what is given at the nodes."""
        return sum(area * numpy.mean([self._between(values, corner) for corner in corners])
                   for area, corners in self.pieces) / self.area
