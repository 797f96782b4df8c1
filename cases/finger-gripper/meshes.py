"""Writes the decks of this folder, with the bodies that no generator of the program makes."""

from math import cos, pi, sin, sqrt, tan

# mm: distance of the inner faces of the fingers from the axis.
AWAY = 15.0
# Lines of the mesh over the width, and from the outer to the inner face.
WIDTH = [-5.0, -3.0, 0.0, 3.0, 5.0]
DEPTH = [0.0, 1.5, 4.0, 6.5, 8.25, 10.0]
# Length of an element from the top to the tip.
DOWN = 2.5
# Walls around the cavity, in divisions.
WALLS = (1, 1), (1, 2), (1, 1)
# Radius of the ball, and half the edge of the cube inside it over that.
BALL, CORE = 12.0, 0.5


def finger(turn, length):
    """Positions and cells of a finger that hangs down to z = 0, turned about the axis."""
    counts = [len(WIDTH) - 1, len(DEPTH) - 1, round(length / DOWN)]
    numbers, nodes, cells = {}, [], []
    c, s = cos(turn), sin(turn)

    def node(i, j, k):
        if (i, j, k) not in numbers:
            numbers[i, j, k] = len(nodes)
            # Outwards by the thickness that is left, and along the width.
            r, w = AWAY + DEPTH[-1] - DEPTH[j], WIDTH[i]
            nodes.append((c * r - s * w, s * r + c * w, length - DOWN * k))
        return numbers[i, j, k]

    for k in range(counts[2]):
        for j in range(counts[1]):
            for i in range(counts[0]):
                place = zip((i, j, k), counts, WALLS)
                if all(walls[0] <= at < count - walls[1] for at, count, walls in place):
                    continue
                lower = [node(i, j, k), node(i + 1, j, k), node(i + 1, j + 1, k), node(i, j + 1, k)]
                upper = [node(i, j, k + 1), node(i + 1, j, k + 1), node(i + 1, j + 1, k + 1), node(i, j + 1, k + 1)]
                cells.append(upper + lower)
    return nodes, cells


def ball(n, layers, radius, centre):
    """Positions and cells of a ball: a cube of cells inside layers on its six faces."""
    numbers, nodes, cells = {}, [], []

    def node(place):
        key = tuple(round(1e6 * x) for x in place)
        if key not in numbers:
            numbers[key] = len(nodes)
            nodes.append(tuple(radius * x + c for x, c in zip(place, centre)))
        return numbers[key]

    def rounded(u):
        """A point of the inner cube, whose faces bulge a little."""
        largest = max(map(abs, u))
        length = sqrt(sum(x * x for x in u)) or 1.0
        return [CORE * (0.6 + 0.4 * largest / length) * x for x in u]

    grid = [spaced(2.0 * i / n - 1.0) for i in range(n + 1)]

    def add(corner):
        cells.append([node(corner(*b)) for b in BRICK])

    for i in range(n):
        for j in range(n):
            for k in range(n):
                add(lambda a, b, c: rounded([grid[i + a], grid[j + b], grid[k + c]]))
    for axis in range(3):
        for sign in (-1.0, 1.0):
            for i in range(n):
                for j in range(n):
                    for layer in range(layers):

                        def corner(a, b, c):
                            u, v = (grid[i + a], grid[j + b]) if sign > 0 else (grid[i + b], grid[j + a])
                            cube = [u, v]
                            cube.insert(axis, sign)
                            if axis == 1:
                                cube = [v, sign, u]
                            inner = rounded(cube)
                            length = sqrt(sum(x * x for x in cube))
                            share = (layer + c) / layers
                            return [(1 - share) * x + share * y / length for x, y in zip(inner, cube)]

                        add(corner)
    return nodes, cells


def spaced(x):
    """Equal angles seen from the centre."""
    return tan(pi / 4 * x)


BRICK = [(0, 0, 0), (1, 0, 0), (1, 1, 0), (0, 1, 0), (0, 0, 1), (1, 0, 1), (1, 1, 1), (0, 1, 1)]


def lists(name, rows, form):
    """Lists of numbers, some in a line."""
    texts = ["[" + ", ".join(map(form, row)) + "]" for row in rows]
    lines = [", ".join(texts[i : i + 6]) for i in range(0, len(texts), 6)]
    return f"{name} = [\n    " + ",\n    ".join(lines) + ",\n]\n"


def mesh(nodes, cells):
    return "[body.mesh]\n" + lists("positions", nodes, lambda x: f"{x + 0.0:.6g}") + lists("cells", cells, str)


def vector(row):
    return "[" + ", ".join(f"{x + 0.0:.5g}" for x in row) + "]"


def outward(turn, distance, height):
    return vector((distance * cos(turn), distance * sin(turn), height))


def body(name, turn, length):
    """A finger with the sets of its base, its inner face and its cavity."""
    # A place next to the outer wall of the cavity, which is all of one surface.
    inside = AWAY + DEPTH[-1] - DEPTH[WALLS[1][0]] - 0.1
    return f"""[[body]]
name = "{name}"
material = "elastomer"
formulation = "assumed-strain"
node_sets = [{{ name = "base", half_space = {{ point = [0, 0, {length - 0.1}], normal = [0, 0, -1] }} }}]
facet_sets = [
    {{ name = "inside", around = {outward(turn, inside, length / 2)}, feature_angle = 180 }},
    {{ name = "pad", around = {outward(turn, AWAY, length / 2)}, feature_angle = 30 }},
]
""" + mesh(*finger(turn, length))


ELASTOMER = """# mm, N, MPa, t, s
# Written by meshes.py.

[[material]]
name = "elastomer"
law = "neo-hookean"
youngs_modulus = 1.0
poissons_ratio = 0.3
density = 1.1e-9

"""


def gripper():
    text = """title = "Three fingers that are blown up, grasp a ball and are tilted"
"""
    text += ELASTOMER + """[[material]]
name = "foam"
law = "neo-hookean"
youngs_modulus = 0.5
poissons_ratio = 0.2
density = 2e-10

"""
    names = ["1", "2", "3"]
    for number, name in enumerate(names):
        text += body(f"finger-{name}", 2 * pi / 3 * number, 50.0) + f"""
[[cavity]]
name = "chamber-{name}"
faces = [{{ body = "finger-{name}", facets = "inside" }}]

[[pair]]
name = "grip-{name}"
a = {{ body = "finger-{name}", facets = "pad" }}
b = {{ body = "ball", facets = "all" }}
friction = {{ law = "coulomb", mu = 0.5 }}

"""
    text += """[[body]]
name = "ball"
material = "foam"
node_sets = [{ name = "core", sphere = { centre = [0, 0, 8], radius = 2.5 } }]
"""
    text += mesh(*ball(6, 2, BALL, (0.0, 0.0, 8.0)))
    held = [f'    {{ body = "finger-{name}", nodes = "base", x = 0, y = 0, z = 0 }},' for name in names]
    blown = [f'    {{ cavity = "chamber-{name}", pressure = 0.1 }},' for name in names]
    newline = "\n"
    return text + f"""
[[step]]
name = "grasp"
increments = 10
displacement = [
{newline.join(held)}
    {{ body = "ball", nodes = "core", x = 0, y = 0, z = 0 }},
]
cavity = [
{newline.join(blown)}
]

[[step]]
name = "let go"
increments = 4
release = [{{ body = "ball", nodes = "core", components = ["x", "y", "z"] }}]
gravity = {{ vector = [0, 0, -9810] }}

[[step]]
name = "tilt"
increments = 4
gravity = {{ vector = [9810, 0, 0] }}
"""


def alone():
    text = """title = "A long finger that is blown up a little"
"""
    return text + ELASTOMER + body("finger", 0.0, 100.0) + f"""
[[cavity]]
name = "chamber"
faces = [{{ body = "finger", facets = "inside" }}]

[[step]]
name = "bend"
increments = 1
displacement = [{{ body = "finger", nodes = "base", x = 0, y = 0, z = 0 }}]
cavity = [{{ cavity = "chamber", pressure = 1e-5 }}]

[output]
probes = [
    {{ name = "upper", body = "finger", point = [{AWAY}, 0, 60] }},
    {{ name = "middle", body = "finger", point = [{AWAY}, 0, 50] }},
    {{ name = "lower", body = "finger", point = [{AWAY}, 0, 40] }},
]
"""


for name, text in [("gripper", gripper()), ("finger", alone())]:
    with open(f"{name}.toml", "w") as file:
        file.write(text)
