"""Newton's method for elements of another program with striae's contact, used by the examples.

Unknowns are positions of all nodes and tractions of the kept nodes. Needs ``pip install scipy``.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping
from typing import Any, Optional, TypeAlias

import numpy as np
import numpy.typing as npt
import striae as st
from scipy.sparse import block_diag, coo_array, csr_array
from scipy.sparse.linalg import spsolve

Floats: TypeAlias = npt.NDArray[np.float64]
#: From positions to internal forces, both of shape (n, 3), and their derivative, (3 n, 3 n).
Elements: TypeAlias = Callable[[Floats], tuple[Floats, Any]]


def increment(
    contact: st.contact.Contact,
    state: st.contact.State,
    elements: Elements,
    held: npt.NDArray[np.bool_],
    end: Floats,
    rigid: Optional[Mapping[str, npt.ArrayLike]] = None,
    tolerance: float = 1e-12,
) -> tuple[st.contact.State, st.contact.Evaluation]:
    """The state that an increment leads to, and contact there.

    held: true for prescribed components, of shape (n, 3), which go to those of ``end``.
    """
    begun = contact.begin(state, prescribed=held, end=end, rigid=rigid)
    x, tractions, free = state.positions, begun.tractions, ~held.ravel()
    found = begun.evaluate(x, tractions)
    internal, stiffness = elements(x)
    for _ in range(40):
        size, kept = begun.unknowns, begun.unknowns - x.size
        tangent = coo_array((found.values, (found.rows, found.cols)), shape=(size, size)).tocsr()
        tangent += block_diag([csr_array(stiffness), coo_array((kept, kept))], format="csr")
        residual = found.residual + np.pad(internal.ravel(), (0, kept))

        # Prescribed components go to their ends, and all others follow.
        change = np.pad(np.where(held, end - x, 0.0).ravel(), (0, kept))
        moves = np.pad(free, (0, kept), constant_values=True)
        residual += tangent @ change
        change[moves] = spsolve(tangent[moves][:, moves].tocsc(), -residual[moves])
        x, tractions = x + change[: x.size].reshape(-1, 3), tractions + change[x.size :]

        found = begun.evaluate(x, tractions, after=found)
        internal, stiffness = elements(x)
        left = found.residual[: x.size] + internal.ravel()
        rest = float(np.linalg.norm(left[free])) / max(float(np.linalg.norm(internal)), 1e-300)
        converged = max(found.norm, rest) <= tolerance
        if (converged or found.number == 1) and len(begun.missed(found)):
            # Nodes that carry no traction yet have met the other side.
            begun = begun.reselected(found)
            tractions = begun.tractions
            found = begun.evaluate(x, tractions)
        elif converged:
            return begun.accept(found), found
    raise RuntimeError("Newton's method does not converge")
