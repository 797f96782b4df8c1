"""Deformable bodies and their sets."""

from __future__ import annotations

import math
from collections.abc import Sequence
from typing import Any, Literal, Optional, Union

from . import _check as check
from . import _striae as native
from ._axes import Axes, vectors_of
from ._check import Curve, Members, Motion, Varying, VaryingVector, Vector
from ._errors import refuse
from ._made import Strict
from ._material import Material
from ._mesh import Mesh, listed
from ._section import FORMULATIONS, Formulation, Section
from ._step import Condition
from ._texture import Texture, texture

Extent = Literal["whole", "exposed"]


class BodySet:
    """A set of nodes, of facets, or both, of a body, by its name: ``body["top"]``."""

    def __init__(self, body: Body, name: str, texture: Optional[Texture] = None) -> None:
        """Use ``body["top"]`` to get a set."""
        self.body = body
        """The body."""
        self.name = name
        """Name of the set."""
        self.texture = texture
        """Texture of the surface, if it has one."""

    def textured(self, along: Union[Texture, Vector]) -> BodySet:
        """The surface with a texture, as a side of a pair.

        along: a texture, or one direction of any length.
        """
        return BodySet(self.body, self.name, texture(along))

    def displace(
        self,
        *,
        x: Optional[Motion] = None,
        y: Optional[Motion] = None,
        z: Optional[Motion] = None,
        curve: Optional[Curve] = None,
        axes: Optional[Axes] = None,
    ) -> Condition:
        """Moves the nodes to a displacement from their positions at rest.

        x, y, z: targets (length): numbers, or functions of ``x``, ``y``, ``z``, the positions at
            rest, and ``t``, the time of the run, as texts such as ``"0.1*x*sin(2*pi*t)"``, with
            angles in radians. Or Python's functions from the fraction of the step, 0 to 1, to the
            displacement (length), which begin where the nodes are and are called at 1001
            fractions when the condition is made. A component that is left out stays as it is.
        curve: how the targets are approached: ``ramp`` where nothing is said, but texts with
            ``t`` are followed. It has no effect on Python's functions.
        axes: axes of ``x``, ``y`` and ``z``: the first one and a vector that determines the second
            one, a :class:`NormalAxis` or :class:`CylindricalAxes`; those of the model by default.
            They stay as they are at rest, and Python's functions have none but those of the model.
        """
        given = [(axis, value) for axis, value in enumerate((x, y, z)) if value is not None]
        if not given:
            raise refuse(str(self), "a displacement needs at least one of x, y and z")
        targets: list[Optional[Varying]] = [None, None, None]
        motions = []
        for axis, value in given:
            if callable(value) and axes is not None:
                raise refuse("xyz"[axis], "in axes of its own a text is needed as a function")
            if callable(value):
                motions.append((axis, *check.motion(value, "xyz"[axis])))
            else:
                targets[axis] = check.varying(value, "xyz"[axis])
        along = check.curve_of(curve, "curve", *targets)
        if along != "ramp" and all(target is None for target in targets):
            raise refuse("curve", "components given as functions take no curve")
        body, name, within = self.body.name, self.name, vectors_of(axes, "axes")

        def apply(step: native.Step) -> None:
            if any(target is not None for target in targets):
                step.displace(body, name, within, targets, along)
            for axis, ends, points in motions:
                step.lead(body, name, axis, ends, points)

        return Condition(f"displacement of {self}", apply)

    def hold(self) -> Condition:
        """Holds the nodes at their positions at rest."""
        return self.displace(x=0.0, y=0.0, z=0.0)

    def release(self, *components: Literal["x", "y", "z"]) -> Condition:
        """Ends prescribed displacements of the nodes.

        components: components that become free, in whatever axes they were stated; all prescribed
            ones by default.
        """
        axes = ["x", "y", "z"]
        chosen = [axes.index(check.word(one, axes, "components")) for one in components]
        body, name = self.body.name, self.name
        return Condition(f"release of {self}", lambda step: step.release(body, name, chosen))

    def pressure(
        self, value: Varying, *, extent: Extent = "whole", curve: Optional[Curve] = None
    ) -> Condition:
        """Presses on the facets, against their current normals.

        value: target, positive inwards (force per current area), or a function of position and
            time as a text, as of :meth:`displace`.
        extent: ``whole``, or ``exposed``: only what no other contact surface covers.
        curve: how the target is approached: ``ramp`` where nothing is said, but texts with ``t``
            are followed.
        """
        target = check.varying(value, "value")
        along = check.curve_of(curve, "curve", target)
        exposed = check.word(extent, ("whole", "exposed"), "extent") == "exposed"
        body, name = self.body.name, self.name
        return Condition(
            f"pressure on {self}",
            lambda step: step.pressure(body, name, target, exposed, along),
        )

    def traction(
        self,
        value: VaryingVector,
        *,
        direction: Literal["dead", "follower"] = "dead",
        extent: Extent = "whole",
        curve: Optional[Curve] = None,
    ) -> Condition:
        """Pulls on the facets.

        value: target (force per reference area, per current area of a follower); components may
            be functions of position and time as texts, as of :meth:`displace`.
        direction: ``dead``: it stays; ``follower``: it turns with the facet.
        extent: ``whole``, or ``exposed``: only what no other contact surface covers.
        curve: how the target is approached: ``ramp`` where nothing is said, but texts with ``t``
            are followed.
        """
        target = check.varying_vector(value, "value")
        along = check.curve_of(curve, "curve", *target)
        follower = check.word(direction, ("dead", "follower"), "direction") == "follower"
        exposed = check.word(extent, ("whole", "exposed"), "extent") == "exposed"
        body, name = self.body.name, self.name
        return Condition(
            f"traction on {self}",
            lambda step: step.traction(body, name, target, follower, exposed, along),
        )

    def force(
        self,
        total: Optional[VaryingVector] = None,
        *,
        each: Optional[VaryingVector] = None,
        curve: Optional[Curve] = None,
    ) -> Condition:
        """Pulls on the nodes with a force of fixed direction.

        total: target (force), taken by all nodes in equal parts; components may be functions of
            position and time as texts, as of :meth:`displace`.
        each: target at each node (force), in place of ``total``.
        curve: how the target is approached: ``ramp`` where nothing is said, but texts with ``t``
            are followed.
        """
        if (total is None) == (each is None):
            raise refuse(str(self), "a force is stated as either total or each")
        path = "total" if each is None else "each"
        target = check.varying_vector(total if each is None else each, path)
        along = check.curve_of(curve, "curve", *target)
        body, name, at_each = self.body.name, self.name, each is not None
        return Condition(
            f"force at {self}", lambda step: step.force(body, name, target, at_each, along)
        )

    def __repr__(self) -> str:
        return f"{self.body.name}[{self.name!r}]"


class Body(Strict):
    """A deformable body."""

    name: str
    """Unique name."""
    mesh: Mesh
    """Mesh of the body at rest."""
    material: Optional[Material]
    """Bulk material outside of sections; ``None`` for a body from a deck."""
    sections: tuple[Section, ...]
    """Parts of other materials; empty for a body from a deck."""
    density: Optional[float]
    """Mass per volume at rest."""

    def __init__(
        self,
        name: str,
        mesh: Any,
        material: Optional[Material] = None,
        *,
        sections: Sequence[Section] = (),
        density: Optional[float] = None,
        contact_mass: Literal["consistent", "redistributed"] = "consistent",
        formulation: Optional[Formulation] = None,
    ) -> None:
        """Makes a body.

        name: unique name.
        mesh: a :class:`Mesh`, a path, or a mesh of meshio or pyvista; see :meth:`Mesh.of`.
        material: bulk material; optional if every element is in a section.
        sections: parts of other materials.
        density: mass per volume at rest, for inertia and gravity.
        contact_mass: mass of the nodes of contact surfaces in dynamic steps: ``consistent``,
            or ``redistributed`` to the nodes behind, against oscillations of contact.
        formulation: of its elements, except in sections with one of their own: ``standard``,
            ``mean-dilatation``, which avoids volumetric locking, or ``assumed-strain``, which
            avoids shear locking of hexahedra in bending; by default ``mean-dilatation`` if Poisson's
            ratio at rest is above 0.45, else ``standard``.
        """
        self.name = check.name(name, "name")
        self.mesh = Mesh.of(mesh)
        check.several(sections, "sections", "a list of sections")
        self.sections = tuple(check.kind(one, Section, "sections") for one in sections)
        self.material = None
        if material is not None or not self.sections:
            self.material = check.kind(material, Material, "material")
        self.density = None if density is None else check.positive(density, "density")
        known = ("consistent", "redistributed")
        self._redistributed = check.word(contact_mass, known, "contact_mass") == "redistributed"
        self._formulation = (
            None
            if formulation is None
            else check.word(formulation, FORMULATIONS, "formulation")
        )

    @classmethod
    def _known(cls, name: str, mesh: Mesh) -> Body:
        body = object.__new__(cls)
        body.name, body.mesh = name, mesh
        body.material, body.density, body._redistributed = None, None, False
        body._formulation, body.sections = None, ()
        body._is_finished = True
        return body

    def __getitem__(self, name: str) -> BodySet:
        """A set of the body; name: of a node set or facet set of the mesh."""
        nodes, facets = self.mesh.node_sets, self.mesh.facet_sets
        if name not in nodes and name not in facets:
            have = listed({**nodes, **facets})
            raise refuse(f"body `{self.name}`", f"there is no set `{name}`{have}")
        return BodySet(self, name)

    def add_set(self, name: str, members: Members) -> BodySet:
        """Adds a set of nodes, and of the boundary facets with all corners among them, and returns
        it.

        name: of the set; one of the same name is replaced.
        members: numbers of the nodes, a boolean mask over all nodes, or a function that takes
            their positions (length), of shape (n, 3), and returns a mask.
        """
        with_nodes = self.mesh.with_sets(nodes={check.name(name, "name"): members})
        chosen = with_nodes.node_sets[name]
        if not len(chosen):
            raise refuse(f"body `{self.name}`", f"no node is in set `{name}`")
        self._replace("mesh", with_nodes.with_sets(facets={name: chosen}))
        return BodySet(self, name)

    def add_elements(self, name: str, members: Members) -> None:
        """Adds a set of elements, for a section.

        name: of the set; one of the same name is replaced.
        members: numbers of the elements in the order of :attr:`Mesh.cells`, a boolean mask over all
            elements, or a function that takes their centres (length), of shape (m, 3), and returns
            a mask.
        """
        with_elements = self.mesh.with_sets(elements={check.name(name, "name"): members})
        if not len(with_elements.element_sets[name]):
            raise refuse(f"body `{self.name}`", f"no element is in set `{name}`")
        self._replace("mesh", with_elements)

    def velocity(
        self,
        value: Vector = (0.0, 0.0, 0.0),
        *,
        spin: Vector = (0.0, 0.0, 0.0),
        about: Vector = (0.0, 0.0, 0.0),
    ) -> Condition:
        """Gives the body the velocity ``value + spin x (x - about)`` at the start of a dynamic
        step.

        value: velocity (length per time).
        spin: angular velocity (radians per time).
        about: a point of the axis of the spin (length).
        """
        v, w = check.vector(value, "value"), check.vector(spin, "spin")
        point, name = check.vector(about, "about"), self.name
        return Condition(f"velocity of {name}", lambda step: step.velocity(name, v, w, point))

    def stretch(
        self,
        strain: float,
        *,
        along: Union[Literal["fibres"], Vector, None] = None,
        section: Optional[str] = None,
        curve: Curve = "ramp",
    ) -> Condition:
        """Lets lines of the body grow without stress, until a later step restates it.

        strain: target ``s`` above -1: lengths at rest grow by the factor ``1 + s`` (no unit).
        along: lines that grow: a direction at rest of any length, or ``fibres`` of the
            material; all in all directions by default.
        section: element set of the section that grows; all of the body by default.
        curve: how the target is approached.
        """
        s, told = check.number(strain, "strain"), f"stretch of {self.name}"
        name, at, by = self.name, self._section(section), check.curve(curve, "curve")
        if along is None:
            return self._strained(told, [s, s, s, 0.0, 0.0, 0.0], None, at, by)
        line = self._line(along)
        if line is None:
            return Condition(told, lambda step: step.fibre_strain(name, at, s, by))
        x, y, z = line
        components = [x * x, y * y, z * z, x * y, y * z, z * x]
        return self._strained(told, [s * one for one in components], None, at, by)

    def strain(
        self,
        components: Vector,
        *,
        axes: Optional[Sequence[Vector]] = None,
        section: Optional[str] = None,
        curve: Curve = "ramp",
    ) -> Condition:
        """Imposes a stress-free strain on the body, until a later step states it or :meth:`stretch`
        again.

        components: target of ``xx``, ``yy``, ``zz``, ``xy``, ``yz``, ``zx``, with principal
            values above -1 (no unit).
        axes: first axis of the components, and a vector that determines the second one; those of
            the model by default.
        section: element set of the section; all of the body by default.
        curve: how the target is approached.
        """
        target = check.vector(components, "components", 6)
        along, at = check.curve(curve, "curve"), self._section(section)
        return self._strained(f"strain of {self.name}", target, axes, at, along)

    def warm(
        self,
        temperature: float,
        thermal_expansion: float,
        *,
        section: Optional[str] = None,
        curve: Curve = "ramp",
    ) -> Condition:
        """Changes the temperature of the body, which expands, until a later step restates it.

        temperature: target of the change since the start (temperature).
        thermal_expansion: strain per change of temperature (one over temperature).
        section: element set of the section; all of the body by default.
        curve: how the target is approached.
        """
        change = check.number(temperature, "temperature")
        alpha = check.number(thermal_expansion, "thermal_expansion")
        name, at, along = self.name, self._section(section), check.curve(curve, "curve")
        told = f"temperature of {name}"
        return Condition(told, lambda step: step.warm(name, at, alpha, change, along))

    def pull(
        self,
        tension: float,
        along: Union[Literal["fibres"], Vector],
        *,
        section: Optional[str] = None,
        curve: Curve = "ramp",
    ) -> Condition:
        """Lets lines of the body pull, as muscles do, until a later step restates it.

        tension: target of the force per area at rest (force per area).
        along: lines that pull: a direction at rest of any length, or ``fibres`` of the
            material.
        section: element set of the section; all of the body by default.
        curve: how the target is approached.
        """
        target, line = check.number(tension, "tension"), self._line(along)
        name, at, by = self.name, self._section(section), check.curve(curve, "curve")
        return Condition(
            f"tension of {name}", lambda step: step.pull(name, at, target, line, by)
        )

    def _section(self, name: Optional[str]) -> Optional[str]:
        return None if name is None else check.name(name, "section")

    def _line(self, along: Union[str, Vector]) -> Optional[list[float]]:
        """A unit vector, or ``None`` for fibres."""
        if isinstance(along, str):
            check.word(along, ("fibres",), "along")
            return None
        line = check.vector(along, "along")
        length = math.hypot(*line)
        if not length > 0.0:
            raise refuse("along", "it must not be the zero vector")
        return [one / length for one in line]

    def _strained(
        self,
        told: str,
        components: list[float],
        axes: Optional[Sequence[Vector]],
        section: Optional[str],
        along: check.Along,
    ) -> Condition:
        name, vectors = self.name, [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0]]
        if axes is not None:
            vectors = check.spanning(axes, "axes")
        return Condition(
            told, lambda step: step.strain(name, section, components, vectors, along)
        )

    def _part(
        self,
    ) -> tuple[
        str,
        native.Mesh,
        Optional[native.Material],
        Optional[float],
        bool,
        Optional[str],
        list[tuple[str, native.Material, Optional[float], Optional[str]]],
    ]:
        material = None if self.material is None else self.material._native
        mesh, mass = self.mesh._native, self._redistributed
        sections = [section._part() for section in self.sections]
        return self.name, mesh, material, self.density, mass, self._formulation, sections

    def __repr__(self) -> str:
        return f"Body({self.name!r}, {self.mesh!r}, {self.material!r})"
