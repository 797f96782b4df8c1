"""Writes the meshes of this folder that no generator of the program makes, as Abaqus files."""

from math import cos, pi, sin, sqrt


def write(name, nodes, cells, kind="C3D8", sets=()):
    """Writes nodes, cells, and sets that are lines of keywords."""
    with open(name, "w") as file:
        print("*NODE", file=file)
        for number, position in enumerate(nodes, 1):
            print(number, *(f"{x:.6g}" for x in position), sep=",", file=file)
        print(f"*ELEMENT, TYPE={kind}, ELSET=all-cells", file=file)
        for number, cell in enumerate(cells, 1):
            print(number, *(node + 1 for node in cell), sep=",", file=file)
        for line in sets:
            print(line, file=file)


def lines(numbers):
    """Numbers counted from 1, eight in a line."""
    numbers = [number + 1 for number in numbers]
    return [",".join(map(str, numbers[i : i + 8])) for i in range(0, len(numbers), 8)]


def strip(name, path, thickness, layers, width, across):
    """A strip along a path of points and directions in the plane y = 0.

    The path is on side `inner`; `outer` lies to the right of it as seen along -y. Element sets
    `half-1` and `half-2` are the layers next to the two sides.
    """
    nodes, cells = [], []
    index = lambda i, j, k: (i * (layers + 1) + j) * (across + 1) + k
    for (x, z), (tx, tz) in path:
        for j in range(layers + 1):
            h = thickness * j / layers
            for k in range(across + 1):
                nodes.append((x + h * tz, width * k / across, z - h * tx))
    halves = [[], []]
    sides = [[], []]
    for i in range(len(path) - 1):
        for j in range(layers):
            for k in range(across):
                if j == 0:
                    sides[0].append(f"{len(cells) + 1}, S3")
                if j == layers - 1:
                    sides[1].append(f"{len(cells) + 1}, S5")
                halves[2 * j // layers].append(len(cells))
                square = [(i, j), (i + 1, j), (i + 1, j + 1), (i, j + 1)]
                cells.append([index(*corner, k) for corner in square] + [index(*corner, k + 1) for corner in square])
    end = lambda i: lines([index(i, j, k) for j in range(layers + 1) for k in range(across + 1)])
    sets = ["*NSET, NSET=first", *end(0), "*NSET, NSET=last", *end(len(path) - 1)]
    for number, half in enumerate(halves, 1):
        if half:
            sets += [f"*ELSET, ELSET=half-{number}", *lines(half)]
    for label, side in zip(["inner", "outer"], sides):
        sets += [f"*SURFACE, TYPE=ELEMENT, NAME={label}", *side]
    write(name, nodes, cells, sets=sets)


def straight(start, end, count):
    """A straight part of a path, without its end."""
    (x0, z0), (x1, z1) = start, end
    length = sqrt((x1 - x0) ** 2 + (z1 - z0) ** 2)
    t = ((x1 - x0) / length, (z1 - z0) / length)
    return [((x0 + (x1 - x0) * i / count, z0 + (z1 - z0) * i / count), t) for i in range(count)]


def arc(centre, radius, start, turn, count):
    """A part of a circle, angles in degrees from x towards z, without its end."""
    points = []
    for i in range(count):
        angle = (start + turn * i / count) * pi / 180
        sign = 1 if turn > 0 else -1
        points.append(
            ((centre[0] + radius * cos(angle), centre[1] + radius * sin(angle)), (-sign * sin(angle), sign * cos(angle)))
        )
    return points


def belts():
    """Belts over half a drum and over a quarter of a pulley, and the rigid drum."""
    half = straight((0.5, -0.2), (0.5, 0), 4) + arc((0, 0), 0.5, 0, 180, 60)
    half += straight((-0.5, 0), (-0.5, -0.2), 4) + [((-0.5, -0.2), (0, -1))]
    strip("belt-half.inp", half, 0.005, 1, 0.1, 1)
    quarter = straight((0.55, -0.3), (0.55, 0), 6) + arc((0, 0), 0.55, 0, 90, 20)
    quarter += straight((0, 0.55), (-0.3, 0.55), 6) + [((-0.3, 0.55), (-1, 0))]
    strip("belt-quarter.inp", quarter, 0.05, 2, 0.2, 1)
    count = 240
    nodes = [(0.5 * cos(2 * pi * i / count), y, 0.5 * sin(2 * pi * i / count)) for i in range(count) for y in (-0.05, 0.15)]
    facets = []
    for i in range(count):
        j = (i + 1) % count
        facets.append([2 * i, 2 * i + 1, 2 * j + 1, 2 * j])
    write("drum.inp", nodes, facets, kind="R3D4")


def arch():
    """Half a ring that hangs down from its ends."""
    path = arc((0, 0), 0.085, 180, 180, 48) + [((0.085, 0), (0, 1))]
    strip("arch.inp", path, 0.01, 4, 0.01, 1)


def s_shape():
    """A strip in the shape of an S."""
    path = straight((-5, 0), (5, 0), 10) + arc((5, 2), 2, -90, 180, 10)
    path += straight((5, 4), (-5, 4), 10) + arc((-5, 6), 2, 270, -180, 10)
    path += straight((-5, 8), (5, 8), 10) + [((5, 8), (1, 0))]
    strip("s-shape.inp", path, 0.5, 2, 1, 1)


def punch():
    """A quarter of a punch of radius 50 and height 100 whose lower edge is rounded by 10."""
    m = 3
    core = [(i, j) for i in range(m + 1) for j in range(m + 1)]
    disc = [(20 * i / m * (1 - 0.08 * j / m), 20 * j / m * (1 - 0.08 * i / m)) for i, j in core]
    cells = [[core.index(c) for c in [(i, j), (i + 1, j), (i + 1, j + 1), (i, j + 1)]] for i in range(m) for j in range(m)]
    border = [core.index((m, j)) for j in range(m + 1)] + [core.index((i, m)) for i in reversed(range(m))]
    radii = [27, 33.5, 40, *(40 + 10 * sin(pi / 8 * i) for i in (1, 2, 3, 4))]
    before, fraction = border, 0
    for ring, radius in enumerate(radii):
        now = []
        for place, corner in enumerate(border):
            angle = pi / 4 * place / m
            x, y = radius * cos(angle), radius * sin(angle)
            if ring < 2:
                fraction = (radius - 20) / 20
                x0, y0 = disc[corner]
                x, y = x0 + (40 * cos(angle) - x0) * fraction, y0 + (40 * sin(angle) - y0) * fraction
            now.append(len(disc))
            disc.append((x, y))
        for place in range(2 * m):
            cells.append([before[place], now[place], now[place + 1], before[place + 1]])
        before = now
    heights = [0, 0.06, 0.15, 0.28, 0.46, 0.7, 1]
    nodes = []
    for height in heights:
        for x, y in disc:
            r = sqrt(x * x + y * y)
            bottom = 10 - sqrt(max(0, 100 - max(0, r - 40) ** 2))
            nodes.append((x, y, bottom + (100 - bottom) * height))
    count = len(disc)
    hexahedra = [[c + count * k for c in cell] + [c + count * (k + 1) for c in cell] for k in range(len(heights) - 1) for cell in cells]
    sole = ["*SURFACE, TYPE=ELEMENT, NAME=sole", *(f"{i + 1}, S1" for i in range(len(cells)))]
    head = ["*SURFACE, TYPE=ELEMENT, NAME=head", *(f"{len(hexahedra) - i}, S2" for i in range(len(cells)))]
    write("punch.inp", nodes, hexahedra, sets=sole + head)


if __name__ == "__main__":
    belts()
    arch()
    s_shape()
    punch()
