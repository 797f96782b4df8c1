"""Mesh files of other programs: ``python crates/striae-meshfile/trial.py [STRIAE]``.

Gmsh's and meshio's Python packages (``pip install gmsh meshio``) write ten meshes - linear and
ten-node tetrahedra, hexahedra of 8, 20 and 27 nodes, wedges of 6 and 15, tetrahedra with pyramids,
two volumes, and one without groups - in every format that they and striae have in common. Each file
is shown by ``striae mesh`` and moved for one increment by ``striae run``. STRIAE is the program,
``target/release/striae`` by default.

Prints a line for each file that cannot be made or read, then how many each program wrote and how
many of these are read and run; ends with 1 if one fails. Files are kept in ``target/trial``.

Gmsh's lists of bounding entities are not given to meshio: it writes them to Abaqus files as sets
of elements with numbers that no element has, zero and negative ones among them, and such a file
is refused.
"""

import subprocess
import sys
from collections.abc import Iterator
from pathlib import Path

import gmsh
import meshio

ROOT = Path(__file__).parents[2]
STRIAE = Path(sys.argv[1] if len(sys.argv) > 1 else ROOT / "target/release/striae").resolve()
FOLDER = ROOT / "target/trial"
KINDS = "tet4 tet10 hex8 hex20 hex27 wedge wedge15 mixed two-volumes no-groups".split()
SECOND_ORDER = {"tet10", "hex20", "hex27", "wedge15"}

#: Endings, formats and options of meshio.
FORMATS = [
    ("a.vtu", "vtu", {"binary": False}),
    ("b.vtu", "vtu", {"binary": True, "compression": None}),
    ("z.vtu", "vtu", {"binary": True, "compression": "zlib"}),
    ("a42.vtk", "vtk42", {"binary": False}),
    ("b42.vtk", "vtk42", {"binary": True}),
    ("a51.vtk", "vtk51", {"binary": False}),
    ("b51.vtk", "vtk51", {"binary": True}),
    ("22.msh", "gmsh22", {"binary": True}),
    ("41.msh", "gmsh", {"binary": True}),
    ("m.inp", "abaqus", {}),
]

DECK = """title = "trial"
[[material]]
name = "solid"
law = "neo-hookean"
youngs_modulus = 1
poissons_ratio = 0.3
[[body]]
name = "body"
material = "solid"
mesh = {{ file = "{file}" }}
[[step]]
name = "move"
increments = 1
displacement = [{{ body = "body", nodes = "all", x = 0, y = 0, z = 0.01 }}]
"""


def shape(kind: str) -> None:
    """Makes the solids of a mesh, as its kinds of cells need them."""
    occ, mesh = gmsh.model.occ, gmsh.model.mesh
    if kind == "two-volumes":
        boxes = [(3, occ.addBox(0, 0, z, 1, 1, 1)) for z in (0, 1)]
        occ.fragment(boxes[:1], boxes[1:])
    elif kind in ("tet4", "tet10", "no-groups", "mixed"):
        occ.addBox(0, 0, 0, 1, 1, 1)
    else:
        base = occ.addRectangle(0, 0, 0, 1, 1)
        occ.extrude([(2, base)], 0, 0, 1, numElements=[2], recombine=True)
    occ.synchronize()
    if kind.startswith("hex"):
        for _, curve in gmsh.model.getEntities(1):
            mesh.setTransfiniteCurve(curve, 3)
        for _, surface in gmsh.model.getEntities(2):
            mesh.setTransfiniteSurface(surface)
            mesh.setRecombine(2, surface)
        for _, volume in gmsh.model.getEntities(3):
            mesh.setTransfiniteVolume(volume)
    if kind == "mixed":
        # Quadrilaterals on one side carry pyramids below the tetrahedra.
        side = gmsh.model.getEntities(2)[0][1]
        mesh.setTransfiniteSurface(side)
        mesh.setRecombine(2, side)


def name_groups() -> None:
    """Names volumes, the lower side, and the interface of two volumes."""
    for at, (_, volume) in enumerate(gmsh.model.getEntities(3)):
        gmsh.model.addPhysicalGroup(3, [volume], name=f"part{at}")
    heights = {
        surface: gmsh.model.occ.getCenterOfMass(2, surface)[2]
        for _, surface in gmsh.model.getEntities(2)
    }
    for name, height in (("bottom", 0.0), ("inner", 1.0)):
        for surface, at in heights.items():
            if abs(at - height) < 1e-9:
                gmsh.model.addPhysicalGroup(2, [surface], name=f"{name}{surface}")


def by_gmsh(kind: str) -> Iterator[Path]:
    """Files of Gmsh."""
    gmsh.initialize(interruptible=False)
    gmsh.option.setNumber("General.Terminal", 0)
    gmsh.option.setNumber("Mesh.MeshSizeMax", 0.6)
    gmsh.option.setNumber("Mesh.SecondOrderIncomplete", kind in ("hex20", "wedge15"))
    shape(kind)
    if kind != "no-groups":
        name_groups()
    gmsh.model.mesh.generate(3)
    if kind in SECOND_ORDER:
        gmsh.model.mesh.setOrder(2)
    for binary in (1, 0):
        gmsh.option.setNumber("Mesh.Binary", binary)
        for version in (2.2, 4.1):
            gmsh.option.setNumber("Mesh.MshFileVersion", version)
            file = FOLDER / f"{kind}-gmsh-{version}-{binary}.msh"
            gmsh.write(str(file))
            yield file
        file = FOLDER / f"{kind}-gmsh-{binary}.vtk"
        gmsh.write(str(file))
        yield file
    file = FOLDER / f"{kind}-gmsh.inp"
    gmsh.write(str(file))
    yield file
    gmsh.finalize()


def by_meshio(kind: str) -> Iterator[Path]:
    """Files of meshio, made from one of Gmsh."""
    for ending, name, options in FORMATS:
        file = FOLDER / f"{kind}-meshio-{ending}"
        try:
            # Read anew for each, as writing changes it.
            mesh = meshio.read(FOLDER / f"{kind}-gmsh-4.1-0.msh")
            mesh.cell_sets.pop("gmsh:bounding_entities", None)
            meshio.write(file, mesh, file_format=name, **options)
        except Exception as error:
            print(f"meshio cannot write {file.name}: {error!r}")
            continue
        yield file


def said(*arguments: str) -> tuple[int, str]:
    """Exit code and output of striae."""
    command = [str(STRIAE), *arguments]
    found = subprocess.run(command, cwd=FOLDER, capture_output=True, text=True)
    return found.returncode, (found.stdout + found.stderr).strip()


def outcome(file: Path) -> str:
    """Fault of a file; empty if there is none."""
    code, words = said("mesh", file.name)
    if code == 0 and "nodes" not in words:
        return f"`striae mesh` says {words!r}"
    (FOLDER / "deck.toml").write_text(DECK.format(file=file.name))
    ran, told = said("run", "deck.toml", "--out", "results", "--overwrite")
    if code == 0 and ran == 0:
        return ""
    if (code == 0) != (ran == 0):
        return f"`striae mesh` ends with {code}, `striae run` with {ran}: {told[-300:]}"
    return words[-300:]


def main() -> int:
    """Makes and reads all files; returns 1 if one failed."""
    FOLDER.mkdir(parents=True, exist_ok=True)
    counts: dict[str, list[int]] = {}
    for kind in KINDS:
        for program, files in (("Gmsh", by_gmsh(kind)), ("meshio", by_meshio(kind))):
            for file in files:
                wrong = outcome(file)
                count = counts.setdefault(program, [0, 0])
                count[0] += 1
                count[1] += not wrong
                if wrong:
                    print(f"FAILED {file.name}: {wrong}")
    versions = {"Gmsh": gmsh.__version__, "meshio": meshio.__version__}
    for program, (files, read) in counts.items():
        print(f"{program} {versions[program]}: {read} of {files} files are read and run")
    return int(any(files != read for files, read in counts.values()))


if __name__ == "__main__":
    sys.exit(main())
