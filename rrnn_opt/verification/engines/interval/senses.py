"""What an enclosure says of a relation."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
from numpy.typing import NDArray

from rrnn_opt.verification.engines.interval.kernel import Array

Mask = NDArray[np.bool_]


def keeps(lower: Array, upper: Array, senses: Sequence[str]) -> Mask:
    """Where an enclosure shows that a sense holds, (n_out, B)."""
    test = {
        ">=0": lambda a, b: a >= 0.0,
        ">0": lambda a, b: a > 0.0,
        "<=0": lambda a, b: b <= 0.0,
        "<0": lambda a, b: b < 0.0,
        "==0": lambda a, b: (a == 0.0) & (b == 0.0),
    }
    rows = zip(lower, upper, senses, strict=True)
    return np.array([test[s](a, b) for a, b, s in rows])


def breaks(lower: Array, upper: Array, senses: Sequence[str]) -> Mask:
    """Where an enclosure shows that a sense fails, (n_out, B)."""
    test = {
        ">=0": lambda a, b: b < 0.0,
        ">0": lambda a, b: b <= 0.0,
        "<=0": lambda a, b: a > 0.0,
        "<0": lambda a, b: a >= 0.0,
        "==0": lambda a, b: (a > 0.0) | (b < 0.0),
    }
    rows = zip(lower, upper, senses, strict=True)
    return np.array([test[s](a, b) for a, b, s in rows])
