"""Flags of the planner's build: every loop over lanes shall become vectors."""

from __future__ import annotations

FLAGS = ("-O3", "-ffp-contract=fast")
"""Loops over lanes vectorise at this level; products and sums may be fused, which
rounds once where two roundings are allowed for.  No fast-math."""
GCC_FLAGS = ("--param=max-completely-peel-times=7",)
"""Without it gcc unrolls a short loop over eight lanes before it could vectorise it."""
UNMASKED_FLAGS = ("-fno-trapping-math",)
"""Comparisons in a lane count as free of side effects (no trap is ever set): without
masks, which AVX-512 has, gcc vectorises no distance otherwise."""


def build_flags(kind: str, cpu: str) -> tuple[str, ...]:
    """Flags of the planner's build.

    Args:
        kind: of the compiler, as in :class:`rrnn_opt.emit.Compiler`.
        cpu: its name and features.
    """
    if kind != "gcc":
        return FLAGS
    return FLAGS + GCC_FLAGS + (() if "avx512" in cpu else UNMASKED_FLAGS)
