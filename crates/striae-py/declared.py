"""Writes the classes of declared laws, ``python/striae/_laws.py`` of friction and ``_materials.py``
of bulk laws, those of declared textures, ``_textures.py``, the methods of declared dependences,
``_dependences.py``, and the functions of declared generators, ``_generators.py``:
``python crates/striae-py/declared.py``, with the package installed."""

from __future__ import annotations

import keyword
import re
from collections import Counter
from collections.abc import Iterator
from dataclasses import dataclass
from pathlib import Path
from textwrap import dedent, fill

from striae import _striae as native

HERE = Path(__file__).parent / "python" / "striae"

#: Classes written by hand that laws derive from.
BASES = {"tabulated": "SampledFriction"}

#: Arguments that state a list of tables of vectors by an array a key, by the key.
COLUMNS = {"at": "places", "direction": "directions"}

#: Order of what a texture has at all nodes.
ORDER = " Nodes are in the order of :meth:`Mesh.surface_nodes`."

#: Types of forms that have no parts.
PLAIN = {
    "several": "Vector",
    "direction": "Vector",
    "vectors": "npt.ArrayLike",
    "whole": "int",
    "counts": "Union[Sequence[int], Ints]",
}

Law = tuple[str, str, bool, list[native.Parameter]]

IMPORTS = """
from __future__ import annotations

from collections.abc import Sequence
from typing import {typing}

from . import _check as check
from ._check import {check}
"""

LAWS = '''"""Friction laws as the library declares them, written by ``declared.py``."""
''' + IMPORTS.format(typing="Literal, Optional, Union", check="Floats, Values") + """from ._friction import {bases}
"""

MATERIALS = '''"""Bulk laws as the library declares them, written by ``declared.py``."""
''' + IMPORTS.format(typing="Literal, Optional", check="Values") + """from ._material import {bases}
"""

GENERATORS = '''"""Generators of meshes as the library declares them, written by ``declared.py``."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import Literal, Optional, Union

from . import _check as check
from ._check import Floats, Ints, Values, Vector
from ._mesh import Mesh
'''

TEXTURES = '''"""Textures as the library declares them, written by ``declared.py``."""

from __future__ import annotations

from typing import Optional

import numpy.typing as npt

from . import _check as check
from ._check import Values, Vector
from ._texture import Texture
'''

DEPENDENCES = '''"""Dependences of friction as the library declares them, written by ``declared.py``."""
''' + IMPORTS.format(typing="TYPE_CHECKING, Optional, Union", check="Floats, Values") + '''from ._made import Made

if TYPE_CHECKING:
    from ._friction import Friction


class Dependences(Made):
    """Dependences of coefficients of friction."""

    def _with(self, key: str, form: str, method: str, values: Values) -> Friction:
        raise NotImplementedError
'''


@dataclass
class Argument:
    """A parameter as an argument."""

    parameter: native.Parameter
    #: Membership of a set that laws share, the members of which go by keyword.
    is_shared: bool = False
    #: Membership of one of several sets, of which exactly one is given.
    is_chosen: bool = False
    #: Other parameters of which it takes the place.
    instead: str = ""
    #: Name, if it is not that of decks.
    called: str = ""
    #: Membership of several arrays that state one list.
    is_column: bool = False
    #: Need of a check that it is positive, which the library makes only later.
    is_to_be_positive: bool = False

    @property
    def name(self) -> str:
        """Name, that of decks if there is no reason for another one."""
        return self.called or self.parameter.name

    @property
    def is_required(self) -> bool:
        """Returns whether it is always given."""
        return self.parameter.is_required and not self.is_chosen

    @property
    def may_be_none(self) -> bool:
        """Returns whether it is ``None`` where it is not given."""
        told = self.parameter
        return not self.is_required and (
            self.is_chosen or (told.value is None and told.form not in ("pairs", "tables"))
        )


def class_name(law: str) -> str:
    """Name of the class of a law."""
    return "".join(word.capitalize() for word in law.split("-"))


def function_name(generator: str) -> str:
    """Name of the function of a generator."""
    return generator.replace("-", "_")


def method_name(key: str, form: str, count: int) -> str:
    """Name of the method of a dependence, with its key if others have the same form."""
    name = "with_" + form.replace("-", "_")
    return name if count == 1 else f"{name}_{key}"


def arguments(parameters: list[native.Parameter], outer: Argument | None = None) -> Iterator[Argument]:
    """Parameters and those of sets, without sets whose names Python reserves."""
    for one in parameters:
        is_shared = outer is not None and outer.is_shared
        is_chosen = outer is not None and outer.is_chosen
        if one.form != "one_of":
            yield Argument(one, is_shared, is_chosen)
            continue
        sets = [of for _, of in one.sets if not any(keyword.iskeyword(each.name) for each in of)]
        several = len(sets) > 1
        for own in sets:
            inner = Argument(one, is_shared or len(one.sets) == 1, is_chosen or several)
            found = list(arguments(own, inner))
            if several:
                first = next(each for each in found if each.parameter.is_required)
                first.instead = " or ".join(needed(of) for of in sets if of is not own)
            yield from found


def needed(parameters: list[native.Parameter]) -> str:
    """Parameters that a set requires."""
    return " and ".join(f"`{one.name}`" for one in parameters if one.is_required)


def row(parameter: native.Parameter) -> list[native.Parameter]:
    """Parameters of a table."""
    return parameter.sets[0][1]


def is_row(parameter: native.Parameter) -> bool:
    """Returns whether a table is stated by a tuple of numbers, not by its keys."""
    return all(one.form == "number" and one.is_required for one in row(parameter))


def union(types: list[str]) -> str:
    """Any of several types."""
    inner = [re.sub(r"^Union\[(.*)\]$", r"\1", one) for one in types]
    each = list(dict.fromkeys(inner))
    return types[0] if len(each) == 1 else f"Union[{', '.join(each)}]"


def types_of_members(parameters: list[native.Parameter]) -> list[str]:
    """Types of the values of a table."""
    types = []
    for one in parameters:
        sets = [of for _, of in one.sets] if one.form == "one_of" else []
        types += [each for of in sets for each in types_of_members(of)] or [type_of(one)]
    return types


def type_of(parameter: native.Parameter) -> str:
    """Type of an argument."""
    form = parameter.form
    if form in PLAIN:
        return PLAIN[form]
    if form == "table" and not is_row(parameter):
        return f"Mapping[str, {union(types_of_members(row(parameter)))}]"
    if form == "word":
        return "Literal[" + ", ".join(f'"{word}"' for word, _ in parameter.words) + "]"
    if form in ("number", "numbers"):
        return "float" if form == "number" else "Union[Sequence[float], Floats]"
    count = 2 if form == "pairs" else len(row(parameter))
    told = "tuple[" + ", ".join(["float"] * count) + "]"
    return told if form == "table" else f"Sequence[{told}]"


def stated(of: Argument) -> str:
    """An argument in a signature."""
    told = "npt.ArrayLike" if of.is_column else type_of(of.parameter)
    if of.is_required:
        return f"{of.name}: {told}"
    if of.may_be_none:
        return f"{of.name}: Optional[{told}] = None"
    value = of.parameter.value
    if isinstance(value, list):
        value = tuple(value)
    default = "()" if value is None else f'"{value}"' if of.parameter.form == "word" else repr(value)
    return f"{of.name}: {told} = {default}"


def checked(of: Argument) -> str:
    """An argument in the dictionary of values."""
    return f'"{of.name}": {check_of(of)}'


def check_of(of: Argument) -> str:
    """The call that checks an argument."""
    name, form = of.name, of.parameter.form
    if form == "word":
        known = ", ".join(f'"{word}"' for word, _ in of.parameter.words)
        call = f'check.word({name}, ({known}), "{name}")'
    elif form == "number" and of.is_to_be_positive:
        call = f'check.positive({name}, "{name}")'
    elif form == "number" and of.may_be_none:
        return f'check.optional({name}, "{name}")'
    elif form in ("number", "numbers", "direction"):
        call = f'check.{form}({name}, "{name}")'
    elif form == "vectors":
        call = f'check.columns({name}={name})'
    elif form == "whole":
        least = int(of.parameter.bounds[0][1])
        call = f'check.whole({name}, "{name}"{"" if least == 1 else f", {least}"})'
    elif form in ("several", "counts"):
        count = of.parameter.count
        kind = "vector" if form == "several" else form
        call = f'check.{kind}({name}, "{name}"{"" if count == 3 else f", {count}"})'
    elif form == "table" and not is_row(of.parameter):
        call = f'check.table({name}, "{name}")'
    elif form == "table":
        call = f'check.row({name}, "{name}", {len(row(of.parameter))})'
    else:
        count = 2 if form == "pairs" else len(row(of.parameter))
        call = f'check.rows_of({name}, "{name}", {count})'
        if not of.is_required and not of.may_be_none:
            call += " or None"
    if of.may_be_none:
        call = f"None if {name} is None else {call}"
    return call


def ticked(text: str) -> str:
    """Code of Markdown as that of docstrings."""
    return re.sub(r"`([^`]+)`", r"``\1``", text)


def lowered(doc: str) -> str:
    """A description as part of a sentence."""
    doc = doc.rstrip(".")
    is_name = re.match(r"\w+'s ", doc) is not None
    is_word = doc[1:2].islower() or doc.startswith("A ")
    return doc[0].lower() + doc[1:] if is_word and not is_name else doc


def bounded(parameter: native.Parameter) -> str:
    """A description with its bounds and its unit."""
    bounds = " and ".join(f"{told} {limit:g}" for told, limit in parameter.bounds)
    told = lowered(parameter.doc) + (f"; {bounds}" if bounds else "")
    return told + (f" ({parameter.unit})" if parameter.unit else "")


def keyed(parameters: list[native.Parameter]) -> str:
    """Keys of a table."""
    tables = [one for one in parameters if one.form == "table"]
    inner = {keyed(row(one)) for one in tables}
    is_alike = len(inner) == 1 and len(tables) == len(parameters) > 1
    told = []
    for one in parameters:
        if one.form == "one_of":
            told.append(" or ".join(keyed(of) for _, of in one.sets))
            continue
        own = f"`{one.name}`, {bounded(one)}"
        if not one.is_required_in_decks and one.form != "table":
            own += f", {defaulting(one)}"
        if one.form == "table" and not is_alike:
            own += f", with {keyed(row(one))}"
        told.append(own)
    return ", ".join(told) + (f"; each with {inner.pop()}" if is_alike else "")


def defaulting(parameter: native.Parameter) -> str:
    """Value of a parameter where it is not given."""
    value = parameter.value
    told = parameter.default or ("none" if value is None else f"`{value}`")
    return f"by default {told}" if "," in told else f"{told} by default"


def explained(of: Argument) -> str:
    """An argument in a docstring."""
    parameter = of.parameter
    is_array = of.is_column or parameter.form == "vectors"
    shape = "of shape (n, 3); " if is_array else ""
    text = f"{of.name}: {shape}{bounded(parameter)}"
    if parameter.words:
        words = parameter.words
        text += ": " + "; ".join(f"`{word}`: {what.rstrip('.')}" for word, what in words)
    if parameter.form == "table" and not is_row(parameter):
        text += f"; a mapping with {keyed(row(parameter))}"
    elif parameter.form in ("table", "tables"):
        each = ", ".join(f"`{one.name}`, {bounded(one)}" for one in row(parameter))
        text += f"; {'each ' if parameter.form == 'tables' else ''}of {each}"
    if of.instead:
        text += f"; it or {of.instead} is needed"
    elif not of.is_required and (of.is_chosen or parameter.value is None):
        text += f"; {defaulting(parameter)}"
    text = ticked(text) + "." + (ORDER if parameter.form == "vectors" else "")
    doc = parameter.sets[0][0] if parameter.form == "tables" else ""
    # The first sentence tells what an element is, which the names of its members tell too.
    _, _, more = doc.partition(". ")
    text += " " + ticked(more) if more else ""
    first, others = " " * 8, " " * 12
    return fill(
        text, 99, initial_indent=first, subsequent_indent=others, break_on_hyphens=False
    )


def method(head: str, result: str, doc: str, parameters: list[native.Parameter], call: str) -> str:
    """A method with a docstring, which calls another with the values."""
    found = list(arguments(parameters))
    plain = [stated(one) for one in found if not one.is_shared]
    shared = [stated(one) for one in found if one.is_shared]
    all_of = ["self", *plain, *(["*", *shared] if shared else [])]
    values = [checked(one) for one in found]
    return function(head, result, doc, found, all_of, values, call)


def texture(name: str, doc: str, parameters: list[native.Parameter]) -> str:
    """The class of a texture; what decks need not state goes by keyword."""
    found, values = [], []
    for one in parameters:
        own, value = of_texture(name, one)
        found += own
        values.append(value)
    found.sort(key=lambda one: not one.is_required)
    plain = [stated(one) for one in found if one.is_required]
    named = [stated(one) for one in found if not one.is_required]
    all_of = ["self", *plain, *(["*", *named] if named else [])]
    call = f'self._make("{name}", values)'
    init = function("__init__", "None", "Makes the texture.", found, all_of, values, call)
    return f"\nclass {class_name(name)}(Texture):\n{summary(doc)}\n\n{init}"


def of_texture(name: str, parameter: native.Parameter) -> tuple[list[Argument], str]:
    """Arguments of a parameter of a texture, and its entry in the dictionary of values. The name of
    the class takes the place of the key that has the name of the texture in decks."""
    key, form = parameter.name, parameter.form
    members = row(parameter) if form in ("table", "tables") else []
    if form == "table" and [one.name for one in members] == ["point", "direction"]:
        point, direction = (Argument(one) for one in members)
        direction.called = "axis" if key == name else key
        point.called = "point" if key == name else f"{key}_point"
        inner = f'"point": {check_of(point)}, "direction": {check_of(direction)}'
        return [direction, point], f'"{key}": {{{inner}}}'
    if form == "tables" and all(one.name in COLUMNS for one in members):
        columns = [Argument(one, called=COLUMNS[one.name], is_column=True) for one in members]
        inner = ", ".join(f"{one.name}={one.name}" for one in columns)
        return columns, f'"{key}": check.columns({inner})'
    own = Argument(parameter, called="direction" if key == name and form == "direction" else "")
    own.is_to_be_positive = parameter.bounds == [("greater than", 0.0)]
    return [own], f'"{key}": {check_of(own)}'


def generator(name: str, doc: str, parameters: list[native.Parameter]) -> str:
    """The function of a generator; what decks need not state goes by keyword."""
    found = list(arguments(parameters))
    found.sort(key=lambda one: not one.parameter.is_required_in_decks)
    plain = [stated(one) for one in found if one.parameter.is_required_in_decks]
    named = [stated(one) for one in found if not one.parameter.is_required_in_decks]
    all_of = [*plain, *(["*", *named] if named else [])]
    call = f'return Mesh._generated("{name}", values)'
    values = [checked(one) for one in found]
    return dedent(function(function_name(name), "Mesh", doc, found, all_of, values, call))


def function(
    head: str,
    result: str,
    doc: str,
    found: list[Argument],
    all_of: list[str],
    values: list[str],
    call: str,
) -> str:
    """A function with a docstring, which calls another with the values."""
    lines = [f"    def {head}({', '.join(all_of)}) -> {result}:"]
    if len(lines[0]) > 99:
        inner = "".join(f"        {one},\n" for one in all_of)
        lines = [f"    def {head}(\n{inner}    ) -> {result}:"]
    lines.append(fill(f'"""{ticked(doc)}', 99, initial_indent=" " * 8, subsequent_indent=" " * 8))
    if found:
        lines += ["", *map(explained, found), '        """']
    else:
        lines[-1] += '"""'
    lines.append("        values: Values = {")
    lines += [f"            {value}," for value in values]
    if not found:
        lines[-1] += "}"
    else:
        lines.append("        }")
    return "\n".join([*lines, f"        {call}"]) + "\n"


def summary(doc: str) -> str:
    """The docstring of a class."""
    return fill(f'"""{ticked(doc)}"""', 99, initial_indent=" " * 4, subsequent_indent=" " * 4)


def base_of(law: str, parameters: list[native.Parameter], common: str) -> str:
    """Class that the class of a law derives from: of a set that laws share, if there is one."""
    sets = [one.name for one in parameters if one.form == "one_of" and len(one.sets) == 1]
    return BASES.get(law, class_name(sets[0]) if sets else common)


def classes(head: str, declared: list[Law], common: str, made: str) -> str:
    """A module of laws, without what follows the classes."""
    bases = {law: base_of(law, parameters, common) for law, _, _, parameters in declared}
    parts = [head.format(bases=", ".join(sorted({common, *bases.values()})))]
    names = sorted(class_name(law) for law, *_ in declared)
    parts.append("__all__ = [\n" + "".join(f'    "{name}",\n' for name in names) + "]\n")
    for law, told, _, parameters in declared:
        call = f'self._make("{law}", values)'
        init = method("__init__", "None", made, parameters, call)
        parts.append(f"\nclass {class_name(law)}({bases[law]}):\n{summary(told)}\n\n{init}")
    return "\n".join(parts)


def laws(declared: list[Law]) -> str:
    """The module of friction laws."""
    fitted = [(class_name(law), law) for law, _, is_fitted, _ in declared if is_fitted]
    entries = "".join(f'    {name}: "{law}",\n' for name, law in fitted)
    head = "\n#: Laws that can be fitted, with their names in decks.\n"
    text = classes(LAWS, declared, "Friction", "Makes the law.")
    return text + "\n" + head + "FITTED: dict[type[Friction], str] = {\n" + entries + "}\n"


def materials(declared: list[Law]) -> str:
    """The module of bulk laws."""
    return classes(MATERIALS, declared, "Material", "Makes the material.")


def dependences(declared: list[tuple[str, list[Law]]]) -> str:
    """The module of dependences."""
    counts = Counter(form for _, forms in declared for form, *_ in forms)
    parts = [DEPENDENCES]
    for key, forms in declared:
        for form, summary, _, parameters in forms:
            name = method_name(key, form, counts[form])
            doc = f"Returns the law with a dependence `{key}`, in place of another one. {summary}"
            call = f'return self._with("{key}", "{form}", "{name}", values)'
            parts.append(method(name, "Friction", doc, parameters, call))
    return "\n".join(parts)


def generators(declared: list[Law]) -> str:
    """The module of generators."""
    names = sorted(function_name(name) for name, *_ in declared)
    parts = [GENERATORS, "__all__ = [\n" + "".join(f'    "{name}",\n' for name in names) + "]\n"]
    parts += ["\n" + generator(name, doc, parameters) for name, doc, _, parameters in declared]
    return "\n".join(parts)


def textures(declared: list[Law]) -> str:
    """The module of textures."""
    names = sorted(class_name(name) for name, *_ in declared)
    parts = [TEXTURES, "__all__ = [\n" + "".join(f'    "{name}",\n' for name in names) + "]\n"]
    parts += [texture(name, doc, parameters) for name, doc, _, parameters in declared]
    return "\n".join(parts)


def written() -> dict[Path, str]:
    """Files with their texts."""
    kinds = dict(native.declarations())
    meshes, painted = [kinds.pop(kind) for kind in ("generator", "texture")]
    bulk, friction = [kinds.pop(kind) for kind in ("material", "law")]
    return {
        HERE / "_generators.py": generators(meshes),
        HERE / "_textures.py": textures(painted),
        HERE / "_laws.py": laws(friction),
        HERE / "_materials.py": materials(bulk),
        HERE / "_dependences.py": dependences(list(kinds.items())),
    }


if __name__ == "__main__":
    for path, text in written().items():
        path.write_text(text, encoding="utf-8")
        print(f"wrote {path}")
