"""The exact solver of ``support/active_set.h`` in given sizes."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Final

import numpy as np
from numpy.typing import NDArray

from rrnn_opt.emit.prologue import Real, require_real, support_text

PROXIMAL: Final = 1e-4
"""Added to the Hessian, relative to its largest entry, when it is singular."""

FIELDS: Final = ("q", "A", "b", "G", "h", "lb", "ub")
"""Members of ``rrnn_qp_t``, in order; matrices column-major."""

_NUMBERS: Final[dict[str, dict[str, float]]] = {
    "double": {
        "DEPENDENT": 1e-20,
        "REDUNDANT": 1e-9,
        "FEASIBLE": 1e-12,
        "STILL": 1e-9,
    },
    "float": {
        "DEPENDENT": 1e-10,
        "REDUNDANT": 1e-4,
        "FEASIBLE": 1e-6,
        "STILL": 1e-5,
    },
}
"""Square of the sine below which a normal counts as dependent; lack of a
redundant row, and violation that counts as none, relative to one and the
right-hand side; movement that ends the proximal rounds."""


@dataclass(frozen=True, eq=False)
class Factor:
    """What the solver knows of the Hessian.

    Attributes:
        inverse: J, upper triangular, with J J' = (P + proximal I)^-1, (n, n).
        proximal: 0 for a definite Hessian.
    """

    inverse: NDArray[np.float64]
    proximal: float

    @staticmethod
    def of(hessian: NDArray[np.float64]) -> Factor:
        """Factor a Hessian, made definite where it is singular.

        Args:
            hessian: P, symmetric positive semidefinite.
        """
        scale = max(float(np.abs(hessian).max(initial=0.0)), 1e-3)
        least = float(np.linalg.eigvalsh(hessian)[0])
        proximal = 0.0 if least > PROXIMAL * scale else PROXIMAL * scale
        lower = np.linalg.cholesky(hessian + proximal * np.eye(len(hessian)))
        return Factor(np.ascontiguousarray(np.linalg.inv(lower).T), proximal)


def active_set_source(
    sizes: tuple[int, int, int], proximal: float, real: Real = "double"
) -> str:
    """C text that follows a prologue: ``rrnn_qp_solve`` and its types.

    Args:
        sizes: unknowns, equality rows, inequality rows.
        proximal: of ``Factor``; when positive, ``rrnn_qp_solve_proximal`` too.
        real: C type of all numbers.
    """
    numbers = _NUMBERS[require_real(real)]
    lines = [
        f"#define RRNN_QP_{name} {size}U"
        for name, size in zip("NPM", sizes, strict=True)
    ]
    lines += [f"#define RRNN_QP_{key} RRNN_C({x!r})" for key, x in numbers.items()]
    names = ["active_rows.h", "active_set.h"]
    if proximal > 0.0:
        lines.append(f"#define RRNN_QP_PROXIMAL RRNN_C({proximal!r})")
        names.append("proximal.h")
    return "\n".join([*lines, "", *(support_text(name) for name in names)])
