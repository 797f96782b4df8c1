"""Writes ``docs/book/reference/python.md`` from signatures and docstrings of the package:
``python crates/striae-py/reference.py``, with the package installed."""

import enum
import inspect
from itertools import takewhile
from pathlib import Path

import striae as st

PAGE = Path(__file__).parents[2] / "docs" / "book" / "reference" / "python.md"

HEAD = """# Names of the Python package

Every public name of `striae`, from its docstring. [Use Python](../how-to/python.md) tells how \
they go together. Quantities are in one consistent system of units; docstrings name them.
"""


def quoted(thing: object) -> str:
    """Docstring as a block that keeps its lines."""
    words = inspect.getdoc(thing) or ""
    return f"```text\n{words}\n```\n" if words else ""


def members(of: type) -> list[tuple[str, object]]:
    """Public members of a class that it defines itself, or that a base that is not public does."""
    hidden = takewhile(lambda one: one.__name__ not in st.__all__, of.__mro__[1:])
    sources = [of, *(one for one in hidden if one.__module__.startswith("striae."))]
    own = {name: member for one in reversed(sources) for name, member in vars(one).items()}
    listed = [(name, member) for name, member in own.items() if not name.startswith("_")]
    return [(name, member) for name, member in listed if says_more(member)]


def made(name: str, of: type) -> list[str]:
    """Arguments of a class that users make objects of, with their defaults and explanations."""
    words = inspect.getdoc(of.__init__) or ""
    apart = issubclass(of, (tuple, BaseException, enum.Enum)) or of in (st.Condition, st.FrictionFit)
    if apart or not inspect.isfunction(of.__init__) or words.startswith("Use "):
        return []
    listed = list(inspect.signature(of.__init__).parameters.values())[1:]
    bare = [one.replace(annotation=inspect.Parameter.empty) for one in listed]
    return [f"**`{name}{inspect.Signature(bare)}`**\n", quoted(of.__init__)]


def says_more(member: object) -> bool:
    """Returns whether the docstring is one of the package's own."""
    words = inspect.getdoc(member) or ""
    plain = isinstance(member, (type, int, float, str, tuple))
    return bool(words) and not plain and not words.startswith("Alias for field number")


def written() -> str:
    """The whole page."""
    parts = [HEAD]
    named = [(name, getattr(st, name)) for name in st.__all__]
    named += [(f"contact.{name}", getattr(st.contact, name)) for name in st.contact.__all__]
    for name, thing in sorted(named, key=lambda one: one[0].lower()):
        if not (inspect.isclass(thing) or callable(thing) or inspect.ismodule(thing)):
            continue
        parts.append(f"## {name}\n")
        parts.append(quoted(thing))
        if inspect.isclass(thing):
            parts += made(name, thing)
            for member, value in members(thing):
                parts.append(f"**`{name}.{member}`**\n")
                parts.append(quoted(value))
    return "\n".join(part for part in parts if part)


if __name__ == "__main__":
    PAGE.write_text(written(), encoding="utf-8")
    print(f"wrote {PAGE}")
