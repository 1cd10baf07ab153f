"""The proof tree of a branch and bound, as one byte a node.

Boxes are halved at their middle, so the axes of the cuts, level by level, say
everything: no box is written down.  A byte below 250 is a cut along that
element; the others are leaves and say what showed them.
"""

from __future__ import annotations

import base64
import hashlib
import zlib
from collections.abc import Sequence
from typing import Any

import numpy as np
from numpy.typing import NDArray

Codes = NDArray[np.uint8]
NATURAL, MEAN_VALUE, OPEN = 255, 254, 253
MOST_AXES = 250


def packed(levels: Sequence[Codes]) -> dict[str, Any]:
    """The payload of an interval certificate.

    Returns:
        ``tree``: zlib and base64 of all bytes; ``sha256``: of the bytes;
        ``nodes`` and ``leaves``: how many there are.
    """
    codes = np.concatenate(levels) if levels else np.zeros(0, np.uint8)
    text = base64.b64encode(zlib.compress(codes.tobytes(), 6)).decode()
    leaves = int(np.sum(codes >= MOST_AXES))
    digest = hashlib.sha256(codes.tobytes()).hexdigest()
    return {"tree": text, "sha256": digest, "nodes": len(codes), "leaves": leaves}
