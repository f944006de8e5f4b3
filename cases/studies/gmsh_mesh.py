# SPDX-License-Identifier: GPL-2.0-or-later
"""Meshes of eight-noded elements in straight rows, written as Gmsh does (version 2.2)."""

KINDS = {"line": 8, "point": 15, "quad": 16}  # of three nodes, one and eight
DIMENSIONS = {"line": 1, "point": 0, "quad": 2}


class Grid:
    """Elements between the places `x` and `y`, in m. Nodes are named by halves of an element, (0, 0) being the lower left corner."""

    def __init__(self, x, y):
        self.x, self.y = x, y
        self.across, self.down = len(x) - 1, len(y) - 1
        self.nodes = {}
        self.groups = []
        self.quads = []
        for j in range(0, 2 * self.down, 2):
            for i in range(0, 2 * self.across, 2):
                self.quads.append([self.node(*at) for at in ((i, j), (i + 2, j), (i + 2, j + 2), (i, j + 2), (i + 1, j), (i + 2, j + 1),
                                                        (i + 1, j + 2), (i, j + 1))])

    def node(self, i, j):
        return self.nodes.setdefault((i, j), len(self.nodes) + 1)

    def _edges(self, ends):
        return [[self.node(*start), self.node(*end), self.node((start[0] + end[0]) // 2, (start[1] + end[1]) // 2)] for start, end in ends]

    # The edges of the sides go around the body against the clock.

    def bottom(self):
        return self._edges(((2 * i, 0), (2 * i + 2, 0)) for i in range(self.across))

    def top(self, first=0, last=None):
        """Of the elements `first` to before `last`, counted from the left."""
        j = 2 * self.down
        return self._edges(((2 * i + 2, j), (2 * i, j)) for i in range(first, self.across if last is None else last))

    def left(self):
        return self._edges(((0, 2 * j + 2), (0, 2 * j)) for j in range(self.down))

    def right(self):
        i = 2 * self.across
        return self._edges(((i, 2 * j), (i, 2 * j + 2)) for j in range(self.down))

    def name(self, name, kind, members):
        """A physical group of lines, points or quads."""
        self.groups.append((name, kind, members))

    def write(self, file):
        def place(grid, k):
            return 0.5 * (grid[k // 2] + grid[(k + 1) // 2])

        elements = [f"{KINDS[kind]} 2 {tag} {tag} " + " ".join(map(str, member))
                    for tag, (_, kind, members) in enumerate(self.groups, start=1) for member in members]
        file.write_text(
            f"$MeshFormat\n2.2 0 8\n$EndMeshFormat\n$PhysicalNames\n{len(self.groups)}\n" +
            "".join(f'{DIMENSIONS[kind]} {tag} "{name}"\n' for tag, (name, kind, _) in enumerate(self.groups, start=1)) +
            f"$EndPhysicalNames\n$Nodes\n{len(self.nodes)}\n" +
            "".join(f"{number} {place(self.x, i):.17g} {place(self.y, j):.17g} 0\n" for (i, j), number in self.nodes.items()) +
            f"$EndNodes\n$Elements\n{len(elements)}\n" + "".join(f"{k} {text}\n" for k, text in enumerate(elements, start=1)) +
            "$EndElements\n", encoding="utf-8")
