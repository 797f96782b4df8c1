"""Writes the classes of declared friction laws, ``python/striae/_laws.py``, and the methods of
declared dependences, ``_dependences.py``: ``python crates/striae-py/declared.py``, with the
package installed."""

from __future__ import annotations

import re
from collections import Counter
from pathlib import Path
from textwrap import fill

from striae import _striae as native

HERE = Path(__file__).parent / "python" / "striae"

#: Classes written by hand that laws derive from.
BASES = {"tabulated": "SampledFriction"}

IMPORTS = """
from __future__ import annotations

from collections.abc import Sequence
from typing import {typing}

from . import _check as check
from ._check import Floats, Values
"""

LAWS = '''"""Friction laws as the library declares them, written by ``declared.py``."""
''' + IMPORTS.format(typing="Literal, Optional, Union") + """from ._friction import {friction}
"""

DEPENDENCES = '''"""Dependences of friction as the library declares them, written by ``declared.py``."""
''' + IMPORTS.format(typing="TYPE_CHECKING, Optional, Union") + '''from ._made import Made

if TYPE_CHECKING:
    from ._friction import Friction


class Dependences(Made):
    """Dependences of coefficients of friction."""

    def _with(self, key: str, form: str, method: str, values: Values) -> Friction:
        raise NotImplementedError
'''


def class_name(law: str) -> str:
    """Name of the class of a law."""
    return "".join(word.capitalize() for word in law.split("-"))


def method_name(key: str, form: str, count: int) -> str:
    """Name of the method of a dependence, with its key if others have the same form."""
    name = "with_" + form.replace("-", "_")
    return name if count == 1 else f"{name}_{key}"


def type_of(form: str, words: list[tuple[str, str]]) -> str:
    """Type of an argument."""
    if form == "word":
        return "Literal[" + ", ".join(f'"{word}"' for word, _ in words) + "]"
    return "float" if form == "number" else "Union[Sequence[float], Floats]"


def argument(parameter: native._Told) -> str:
    """A parameter in a signature."""
    name, form, words, _, _, (is_optional, value, _) = parameter
    told = type_of(form, words)
    if not is_optional:
        return f"{name}: {told}"
    if value is None:
        return f"{name}: Optional[{told}] = None"
    return f"{name}: {told} = " + (f'"{value}"' if form == "word" else repr(value))


def checked(parameter: native._Told) -> str:
    """A parameter in the dictionary of values."""
    name, form, words, _, _, (is_optional, value, _) = parameter
    if form == "word":
        known = ", ".join(f'"{word}"' for word, _ in words)
        return f'"{name}": check.word({name}, ({known}), "{name}")'
    if is_optional and value is None:
        return f'"{name}": check.optional({name}, "{name}")'
    return f'"{name}": check.{form}({name}, "{name}")'


def ticked(text: str) -> str:
    """Code of Markdown as that of docstrings."""
    return re.sub(r"`([^`]+)`", r"``\1``", text)


def explained(parameter: native._Told) -> str:
    """A parameter in a docstring."""
    name, _, words, unit, doc, (is_optional, value, default) = parameter
    doc = doc.rstrip(".")
    if doc[1:2].islower():
        doc = doc[0].lower() + doc[1:]
    text = f"{name}: {doc}"
    if words:
        text += ": " + "; ".join(f"`{word}`: {what.rstrip('.')}" for word, what in words)
    else:
        text += f" ({unit})"
    if is_optional and value is None:
        text += f"; `{default}` by default" if default else "; none by default"
    text = ticked(text) + "."
    return fill(text, 99, initial_indent=" " * 8, subsequent_indent=" " * 12)


def function(head: str, result: str, doc: str, parameters: list[native._Told], call: str) -> str:
    """A method with a docstring, which calls another with the values."""
    arguments = ["self", *map(argument, parameters)]
    lines = [f"    def {head}({', '.join(arguments)}) -> {result}:"]
    if len(lines[0]) > 99:
        inner = "".join(f"        {one},\n" for one in arguments)
        lines = [f"    def {head}(\n{inner}    ) -> {result}:"]
    lines.append(fill(f'"""{ticked(doc)}', 99, initial_indent=" " * 8, subsequent_indent=" " * 8))
    if parameters:
        lines += ["", *map(explained, parameters), '        """']
    else:
        lines[-1] += '"""'
    lines.append("        values: Values = {")
    lines += [f"            {checked(one)}," for one in parameters]
    if not parameters:
        lines[-1] += "}"
    else:
        lines.append("        }")
    return "\n".join([*lines, f"        {call}"]) + "\n"


def laws(declared: list[tuple[str, str, bool, list[native._Told]]]) -> str:
    """The module of laws."""
    bases = ", ".join(sorted({"Friction", *BASES.values()}))
    parts = [LAWS.format(friction=bases)]
    names = sorted(class_name(law) for law, *_ in declared)
    parts.append("__all__ = [\n" + "".join(f'    "{name}",\n' for name in names) + "]\n")
    for law, summary, _, parameters in declared:
        base = BASES.get(law, "Friction")
        doc = fill(f'"""{ticked(summary)}"""', 99, initial_indent=" " * 4, subsequent_indent=" " * 4)
        made = function("__init__", "None", "Makes the law.", parameters, f'self._make("{law}", values)')
        parts.append(f"\nclass {class_name(law)}({base}):\n{doc}\n\n{made}")
    fitted = [(class_name(law), law) for law, _, is_fitted, _ in declared if is_fitted]
    entries = "".join(f'    {name}: "{law}",\n' for name, law in fitted)
    head = "\n#: Laws that can be fitted, with their names in decks.\n"
    parts.append(head + "FITTED: dict[type[Friction], str] = {\n" + entries + "}\n")
    return "\n".join(parts)


def dependences(declared: list[tuple[str, list[tuple[str, str, bool, list[native._Told]]]]]) -> str:
    """The module of dependences."""
    counts = Counter(form for _, forms in declared for form, *_ in forms)
    parts = [DEPENDENCES]
    for key, forms in declared:
        for form, summary, _, parameters in forms:
            name = method_name(key, form, counts[form])
            doc = f"Returns the law with a dependence `{key}`, in place of another one. {summary}"
            call = f'return self._with("{key}", "{form}", "{name}", values)'
            parts.append(function(name, "Friction", doc, parameters, call))
    return "\n".join(parts)


def written() -> dict[Path, str]:
    """Files with their texts."""
    kinds = dict(native.declared_laws())
    friction = kinds.pop("law")
    return {
        HERE / "_laws.py": laws(friction),
        HERE / "_dependences.py": dependences(list(kinds.items())),
    }


if __name__ == "__main__":
    for path, text in written().items():
        path.write_text(text, encoding="utf-8")
        print(f"wrote {path}")
