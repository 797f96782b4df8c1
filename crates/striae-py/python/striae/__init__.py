"""Finite-element contact with anisotropic friction.

A block is pressed onto a grooved floor and dragged across:

>>> import striae as st
>>> rubber = st.NeoHookean(youngs_modulus=1e6, poissons_ratio=0.3)
>>> pad = st.Body("pad", st.block(divisions=(2, 2, 2)), rubber)
>>> floor = st.Plane("floor", texture=(1, 0, 0))
>>> law = st.Orthotropic(mu_along=0.1, mu_across=0.4)
>>> model = st.Model([pad], [floor], [st.Pair(pad["zmin"], floor, law)])
>>> _ = model.step("press", pad["zmax"].displace(x=0, y=0, z=-0.02), increments=2)
>>> _ = model.step("drag", pad["zmax"].displace(y=0.3), increments=5)
>>> run = model.run()
>>> force = run[-1].pair(0).force
>>> float(round(force[1] / force[2], 3))
-0.4

Quantities are in one consistent system of units of your choice, for instance m, N, Pa, s, kg;
docstrings say what each is. Angles are in degrees. Nodes count from 0.
"""

from importlib.metadata import version as _version

from . import contact
from ._axes import CylindricalAxes, NormalAxis
from ._body import Body, BodySet
from ._cavity import Cavity
from ._course import Course
from ._errors import (
    Fault,
    ModelError,
    RunInterrupted,
    RunStopped,
    RunWarning,
    SweepError,
)
from ._fibres import ExponentialFibres, Fibres, Fibrous, LinearFibres
from ._fit import FrictionFit, Measurements, fit_friction, read_measurements
from ._factor import FactorPoints, FactorSlopes, StateSlopes
from ._friction import Friction, OwnFriction, SlipSurface
from ._generators import *
from ._generators import __all__ as _generators
from ._gradient import differentiate
from ._laws import *
from ._laws import __all__ as _laws
from ._material import Material, OwnMaterial, Rubber
from ._materials import *
from ._materials import __all__ as _materials
from ._mesh import Mesh, read_mesh
from ._model import Advice, Check, Fit, Model, Remark, Solver
from ._pair import Pair
from ._results import (
    BodyResults,
    CavityResults,
    Energies,
    Increment,
    PairResults,
    RigidResults,
    SideResults,
    SpringResults,
    Status,
    TieResults,
)
from ._rigid import Plane, Rigid, RigidBody, RigidSurface
from ._run import History, Run, resume
from ._section import Section
from ._spring import Spring
from ._step import Condition, Dynamics, Increments, Step, gravity
from ._sweep import Sweep, SweepPoint, sweep
from ._texture import Texture
from ._textures import *
from ._textures import __all__ as _textures
from ._tie import Tie

__version__ = _version("striae")

__all__ = [
    "Advice",
    "Body",
    "BodyResults",
    "BodySet",
    "Cavity",
    "CavityResults",
    "Check",
    "Condition",
    "Coulomb",
    "Course",
    "CylindricalAxes",
    "Dynamics",
    "Energies",
    "ExponentialFibres",
    "FactorPoints",
    "FactorSlopes",
    "Fault",
    "Fibres",
    "Fibrous",
    "Fit",
    "Friction",
    "FrictionFit",
    "History",
    "Increment",
    "Increments",
    "LinearFibres",
    "Material",
    "Measurements",
    "Mesh",
    "Model",
    "ModelError",
    "NormalAxis",
    "OwnFriction",
    "OwnMaterial",
    "Pair",
    "PairResults",
    "Plane",
    "Remark",
    "Rigid",
    "RigidBody",
    "RigidResults",
    "RigidSurface",
    "Rubber",
    "Run",
    "RunInterrupted",
    "RunStopped",
    "RunWarning",
    "Section",
    "SideResults",
    "SlipSurface",
    "Solver",
    "Spring",
    "SpringResults",
    "StateSlopes",
    "Status",
    "Step",
    "Sweep",
    "SweepError",
    "SweepPoint",
    "Texture",
    "Tie",
    "TieResults",
    "contact",
    "differentiate",
    "fit_friction",
    "gravity",
    "read_measurements",
    "read_mesh",
    "resume",
    "sweep",
]

__all__ += _generators
__all__ += _laws
__all__ += _materials
__all__ += _textures
