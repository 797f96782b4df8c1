"""Writes the decks of this folder, with the bellows that no generator of the program makes."""

from math import cos, pi, radians, sin

# mm: radius of the collars, of the folds, length of the walls and of the collars, thickness.
INNER, FOLD, WALL, COLLAR, THICK = 12.0, 2.0, 4.0, 2.0, 1.0
CROWNS = 3


def outline(crowns, wall, arc):
    """Places and normals along the middle of the wall, from the lower collar to the upper one.

    `wall` elements over a wall, `arc` over a quarter of a turn.
    """
    points = []

    def line(start, end, count, normal):
        for i in range(count):
            share = i / count
            points.append(([a + share * (b - a) for a, b in zip(start, end)], normal))

    def bow(centre, start, turn, count):
        """A bow from an angle by a turn; the normal points to the side that is outside of the boot."""
        for i in range(count):
            angle = radians(start + turn * i / count)
            out = [cos(angle), sin(angle)]
            sign = 1.0 if turn > 0 else -1.0
            points.append(([c + FOLD * o for c, o in zip(centre, out)], [sign * o for o in out]))

    z = COLLAR
    line([INNER, 0.0], [INNER, z], max(1, wall // 2), [1.0, 0.0])
    root, crown = INNER + FOLD, INNER + FOLD + WALL
    for _ in range(crowns):
        bow([root, z], 180, -90, arc)
        line([root, z + FOLD], [crown, z + FOLD], wall, [0.0, -1.0])
        bow([crown, z + 2 * FOLD], -90, 180, 2 * arc)
        line([crown, z + 3 * FOLD], [root, z + 3 * FOLD], wall, [0.0, 1.0])
        bow([root, z + 4 * FOLD], 270, -90, arc)
        z += 4 * FOLD
    line([INNER, z], [INNER, z + COLLAR], max(1, wall // 2), [1.0, 0.0])
    points.append(([INNER, z + COLLAR], [1.0, 0.0]))
    return points


def boot(crowns, wall, arc, through, around, first, last):
    """Positions and cells of the wall, turned about z from the first to the last angle."""
    profile = outline(crowns, wall, arc)
    nodes, cells = [], []
    for k in range(around + 1):
        angle = radians(first + (last - first) * k / around)
        for (r, z), (nr, nz) in profile:
            for layer in range(through + 1):
                off = THICK * (layer / through - 0.5)
                rr, zz = r + off * nr, z + off * nz
                nodes.append((rr * cos(angle), rr * sin(angle), zz))
    row, slab = through + 1, (through + 1) * len(profile)
    for k in range(around):
        for i in range(len(profile) - 1):
            for layer in range(through):
                at = k * slab + i * row + layer
                face = [at, at + 1, at + 1 + row, at + row]
                # Radially outwards, about the axis, then along the wall.
                cells.append([at, at + 1, at + 1 + slab, at + slab, at + row, at + row + 1, at + row + 1 + slab, at + row + slab])
    return nodes, cells


def lists(name, rows, form):
    """Lists of numbers, some in a line."""
    texts = ["[" + ", ".join(map(form, row)) + "]" for row in rows]
    lines = [", ".join(texts[i : i + 6]) for i in range(0, len(texts), 6)]
    return f"{name} = [\n    " + ",\n    ".join(lines) + ",\n]\n"


HEIGHT = 2 * COLLAR + CROWNS * 4 * FOLD

CONTACT = """
[contact]
all = true
friction = { law = "coulomb", mu = 0.3 }
"""

RUBBER = """
[[material]]
name = "rubber"
law = "neo-hookean"
youngs_modulus = 8
poissons_ratio = 0.45

[[body]]
name = "boot"
material = "rubber"
formulation = "assumed-strain"
"""


def slice_deck(name, wall, arc, through):
    """A slice of 4 degrees."""
    half = 2.0
    nodes, cells = boot(CROWNS, wall, arc, through, 1, -half, half)
    text = f"""# A slice of 4 degrees of a bellows with three convolutions, compressed until these touch.
# Written by meshes.py. Units: mm, N, MPa.

title = "A slice of a boot, compressed along its axis"
{RUBBER}node_sets = [
    {{ name = "lower", from = [0, -5, -0.01], to = [30, 5, 0.01] }},
    {{ name = "upper", from = [0, -5, {HEIGHT - 0.01}], to = [30, 5, {HEIGHT + 0.01}] }},
    {{ name = "everything", from = [0, -5, -1], to = [30, 5, {HEIGHT + 1}] }},
]

[body.mesh]
"""
    text += lists("positions", nodes, lambda x: f"{x + 0.0:.6g}") + lists("cells", cells, str)
    axes = "axes = { point = [0, 0, 0], axis = [0, 0, 1] }"
    text += f"""{CONTACT}
# All nodes stay in the planes through the axis.
[[step]]
name = "compress"
increments = 48
displacement = [
    {{ body = "boot", nodes = "everything", {axes}, y = 0 }},
    {{ body = "boot", nodes = "lower", {axes}, x = 0, z = 0 }},
    {{ body = "boot", nodes = "upper", {axes}, x = 0, z = -12 }},
]
"""
    with open(name + ".toml", "w") as file:
        file.write(text)


def half_deck(name, wall, arc, through, around):
    """Half a boot."""
    nodes, cells = boot(CROWNS, wall, arc, through, around, 0.0, 180.0)
    text = f"""# Half of a bellows with three convolutions, compressed until these touch and pushed sideways.
# Written by meshes.py. The plane y = 0 is that of symmetry. Units: mm, N, MPa.

title = "Half of a boot, compressed and pushed sideways"
{RUBBER}node_sets = [
    {{ name = "lower", from = [-30, -1, -0.01], to = [30, 30, 0.01] }},
    {{ name = "upper", from = [-30, -1, {HEIGHT - 0.01}], to = [30, 30, {HEIGHT + 0.01}] }},
    {{ name = "symmetry", from = [-30, -0.01, -1], to = [30, 0.01, {HEIGHT + 1}] }},
]

[body.mesh]
"""
    text += lists("positions", nodes, lambda x: f"{x + 0.0:.6g}") + lists("cells", cells, str)
    text += CONTACT + """
[[step]]
name = "compress"
increments = 16
displacement = [
    { body = "boot", nodes = "symmetry", y = 0 },
    { body = "boot", nodes = "lower", x = 0, y = 0, z = 0 },
    { body = "boot", nodes = "upper", x = 0, y = 0, z = -11.2 },
]

[[step]]
name = "shear"
increments = 12
displacement = [{ body = "boot", nodes = "upper", x = 4 }]

[output]
fields_every = 2
"""
    with open(name + ".toml", "w") as file:
        file.write(text)


slice_deck("slice", 6, 6, 2)
slice_deck("slice-fine", 12, 12, 4)
half_deck("half", 4, 4, 1, 12)
