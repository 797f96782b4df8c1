"""Every public name has types and a docstring, with units where it has numbers."""

from __future__ import annotations

import doctest
import inspect
import re
import runpy
import typing
from collections.abc import Iterator
from pathlib import Path

import pytest
import striae as st

ROOT = Path(__file__).parents[3]

#: Words that say the unit of a number, or what stands for one.
UNIT = re.compile(
    r"\((?:[^)]*\b(?:length|force|mass|degrees|radians|time|seconds|no unit|fraction|per|unit)\b)"
    r"|counts? from 0|unit|number|coordinates|name|index|increments"
)


def named() -> Iterator[tuple[str, object]]:
    """All public names, and those of the module of contact."""
    for name in st.__all__:
        yield name, getattr(st, name)
    for name in st.contact.__all__:
        yield f"contact.{name}", getattr(st.contact, name)


def public() -> Iterator[tuple[str, object]]:
    """All public names, and those in classes."""
    for name, thing in named():
        yield name, thing
        if inspect.isclass(thing):
            for part, member in vars(thing).items():
                special = part == "__init__" and not issubclass(thing, tuple)
                if special or not part.startswith("_"):
                    yield f"{name}.{part}", member


def function_of(thing: object) -> object:
    if isinstance(thing, property):
        return thing.fget
    if isinstance(thing, (classmethod, staticmethod)):
        return thing.__func__
    return getattr(thing, "func", thing)


ALL = list(public())


def test_everything_is_listed() -> None:
    names = {name for name in vars(st) if not name.startswith("_")}
    assert names == set(st.__all__)
    assert (Path(st.__file__).parent / "py.typed").exists()


def test_the_version_is_that_of_the_package() -> None:
    manifest = (Path(__file__).parents[3] / "Cargo.toml").read_text()
    assert f'version = "{st.__version__}"' in manifest


@pytest.mark.parametrize("name, thing", ALL, ids=[name for name, _ in ALL])
def test_it_has_a_docstring(name: str, thing: object) -> None:
    if isinstance(thing, (int, st.Status)):
        return
    assert inspect.getdoc(function_of(thing)), name


@pytest.mark.parametrize("name, thing", ALL, ids=[name for name, _ in ALL])
def test_it_has_types(name: str, thing: object) -> None:
    function = function_of(thing)
    if not inspect.isfunction(function):
        return
    parameters = list(inspect.signature(function).parameters.values())
    parameters = [one for one in parameters if one.name not in ("self", "cls")]
    for parameter in parameters:
        assert parameter.annotation is not inspect.Parameter.empty, f"{name}: {parameter}"
    assert "return" in function.__annotations__, name


@pytest.mark.parametrize("name, thing", ALL, ids=[name for name, _ in ALL])
def test_numbers_have_units(name: str, thing: object) -> None:
    """Each argument is explained; arrays and numbers that come out have a unit."""
    function = function_of(thing)
    if not inspect.isfunction(function):
        return
    text = inspect.getdoc(function) or ""
    names = [one for one in inspect.signature(function).parameters if one not in ("self", "cls")]
    internal = text.startswith("Use ") or "made by" in text
    for parameter in names if not internal else []:
        assert re.search(rf"\b{parameter}\b", text), f"{name} does not explain {parameter}"
    returned = str(function.__annotations__.get("return"))
    if returned in ("Floats", "float"):
        assert UNIT.search(text), f"{name} has no unit"


def test_fields_of_named_tuples_say_what_they_are() -> None:
    for name, thing in named():
        fields = getattr(thing, "_fields", ()) if inspect.isclass(thing) else ()
        for field in fields:
            words = inspect.getdoc(getattr(thing, field)) or ""
            assert words and not words.startswith("Alias for"), f"{name}.{field}"
            hint = thing.__annotations__[field]
            if getattr(hint, "__forward_arg__", hint) in ("Floats", "float"):
                assert UNIT.search(words), f"{name}.{field} has no unit"


def test_the_example_of_the_docstring_holds() -> None:
    assert doctest.testmod(st).failed == 0


def test_hints_resolve() -> None:
    classes = [st.Body, st.Model, st.Pair, st.Step, st.contact.Contact, st.contact.Pair]
    for init in (one.__init__ for one in classes):
        module = inspect.getmodule(init)
        assert module is not None
        typing.get_type_hints(init, vars(module))


def test_the_page_of_names_is_what_the_docstrings_say() -> None:
    page = ROOT / "docs" / "book" / "reference" / "python.md"
    written = runpy.run_path(str(ROOT / "crates" / "striae-py" / "reference.py"))["written"]()
    assert page.read_text(encoding="utf-8") == written, "run crates/striae-py/reference.py"
