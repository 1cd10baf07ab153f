"""What a package is asked to be."""

from __future__ import annotations

import math
from dataclasses import dataclass, replace
from typing import Final, Literal, get_args

from rrnn_opt.arguments import checked
from rrnn_opt.embedding.words import require_prefix
from rrnn_opt.emit.prologue import Real, Trig, require_real, require_trig
from rrnn_opt.errors import RrnnError

Target = Literal["host", "cortex-m4f", "cortex-m7"]
MAX_STEPS: Final = 100_000


@checked()
@dataclass(frozen=True)
class Options:
    """Settings of a package.

    Attributes:
        prefix: of every exported C name; a C identifier.
        real: C type of all numbers.
        steps: Euler steps of one call.
        step_size: h, s, offered as a constant and tested with; None leaves it
            to the user of the package.
        tolerance: KKT residual that is offered as a constant.
        fallback: whether the exact solver is in the package.
        fused: whether a*b + c may be rounded once; results are then those of
            the model within a bound, not bit for bit.
        trig: "own" sine and cosine, or those of the C library ("libm").
        target: machine that the build files are for.
        test_step: h, s, that the package is tested with where no step size is
            given; half of the longest safe one where that is shorter.

    Raises:
        RrnnError: one of them cannot be used.
    """

    prefix: str = "arm"
    real: Real = "float"
    steps: int = 1
    step_size: float | None = None
    tolerance: float = 0.01
    fallback: bool = True
    fused: bool = False
    trig: Trig = "own"
    target: Target = "host"
    test_step: float = 0.001

    def __post_init__(self) -> None:
        require_real(self.real)
        require_trig(self.trig)
        require_prefix(self.prefix)
        if self.target not in get_args(Target):
            known = ", ".join(get_args(Target))
            raise RrnnError(f"target '{self.target}': use one of {known}")
        _require_steps(self.steps)
        if self.step_size is not None:
            _require_number("step size", self.step_size, self.real)
        _require_number("tolerance", self.tolerance, self.real)

    @property
    def single(self) -> bool:
        """Whether the package computes in single precision."""
        return self.real == "float"

    def below(self, longest: float | None) -> Options:
        """These options with no step size that the package itself would refuse.

        Args:
            longest: Euler step, s, up to which a bound is known; None without.

        Raises:
            RrnnError: it is too long.
        """
        if longest is not None and (self.step_size or 0.0) > longest:
            raise RrnnError(
                f"step size {self.step_size}: no step beyond {longest:.6g} s is known"
                " to be safe; choose a shorter one"
            )
        if longest is None:
            return self
        return replace(self, test_step=min(self.test_step, longest / 2.0))

    @property
    def exact(self) -> bool:
        """Whether results are defined to the bit."""
        return self.trig == "own" and not self.fused


def _require_steps(steps: int) -> None:
    if isinstance(steps, bool) or not isinstance(steps, int):
        raise RrnnError(f"steps {steps!r}: it must be a whole number")
    if not 1 <= steps <= MAX_STEPS:
        raise RrnnError(f"steps {steps}: it must lie between 1 and {MAX_STEPS}")


def _require_number(what: str, value: float, real: Real) -> None:
    if not math.isfinite(value) or value <= 0.0:
        raise RrnnError(f"{what} {value}: it must be positive and finite")
    if real == "float" and not 1e-30 < value < 1e30:
        raise RrnnError(f"{what} {value}: it does not fit into a C float")
