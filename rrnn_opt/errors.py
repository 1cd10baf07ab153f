"""Every error of the package: one root, each carrying its data.

A message says what is wrong and what to do; the data of the error stay
available as attributes, so that callers never parse a sentence.
"""

from __future__ import annotations

import copyreg
from typing import Any

_LONGEST = 600
"""Characters of a name or a reason in a message."""


class RrnnError(Exception):
    """Root of every error that this package raises on purpose."""

    def __reduce__(self) -> tuple[Any, ...]:
        """Come through a process pool as it is: its arguments are not its text."""
        return copyreg.__newobj__, (type(self), *self.args), self.__dict__  # type: ignore[attr-defined]


class ShapeError(RrnnError):
    """An expression or array has the wrong shape.

    Attributes:
        name: what was given.
        want: required shape.
        got: shape that was given.
    """

    def __init__(self, name: str, want: tuple[int, ...], got: tuple[int, ...]) -> None:
        self.name, self.want, self.got = name, want, got
        super().__init__(f"{name}: expected shape {want}, got {got}")


class ArgumentError(RrnnError):
    """An argument is of another kind than the signature says.

    Attributes:
        name: function and argument.
        message: what was expected and what was given.
    """

    def __init__(self, name: str, message: str) -> None:
        self.name, self.message = name, message
        super().__init__(f"{name}: {message}")


class NotFiniteError(RrnnError):
    """A number that must be finite is NaN or infinite.

    Attributes:
        name: what was given.
    """

    def __init__(self, name: str) -> None:
        self.name = name
        super().__init__(f"{name}: every number must be finite")


class NotAQpError(RrnnError):
    """A declaration is not a convex quadratic programme.

    Attributes:
        where: part of the formulation ("cost", "equalities", ...).
        operation: offending operation or property.
        expression: the subexpression it stands in, when there is one.
    """

    def __init__(
        self, where: str, operation: str, advice: str, *, expression: str = ""
    ) -> None:
        self.where, self.operation, self.expression = where, operation, expression
        place = f" in '{expression}'" if expression else ""
        super().__init__(f"{where}: {operation}{place}; {advice}")


class UnsupportedOperationError(RrnnError):
    """The instruction tape holds an operation that a reader does not know.

    Attributes:
        operation: its name.
        reader: who met it ("C99 emitter", "rational polynomials", ...).
    """

    def __init__(self, operation: str, reader: str) -> None:
        self.operation, self.reader = operation, reader
        super().__init__(f"{reader}: operation '{operation}' is not supported")


class RobotError(RrnnError):
    """A robot description cannot be read or used.

    Attributes:
        source: file or name of the robot.
    """

    def __init__(self, source: str, message: str) -> None:
        self.source = source
        named = source if len(source) <= _LONGEST else source[:_LONGEST] + "..."
        told = " ".join(message[:_LONGEST].split())
        super().__init__(f"robot '{named}': {told}")


class ProblemError(RrnnError):
    """A planning problem (or task) is not valid.

    Attributes:
        field: offending field, e.g. "obstacles[2].size".
        message: what is wrong with it.
    """

    def __init__(self, field: str, message: str) -> None:
        self.field, self.message = field, message
        super().__init__(f"{field}: {message}")


class CompilerError(RrnnError):
    """No C compiler, or the compiler failed.

    Attributes:
        command: what was run, or None when no compiler was found.
        output: first lines of what it printed.
    """

    def __init__(
        self, message: str, command: list[str] | None = None, output: str = ""
    ) -> None:
        self.command, self.output = command, output
        super().__init__(message)


class InfeasibleQpError(RrnnError):
    """A QP has no feasible point, or a solver found no usable answer.

    Attributes:
        residual: KKT residual of what the solver returned, or None.
    """

    def __init__(self, message: str, residual: float | None = None) -> None:
        self.residual = residual
        super().__init__(message)


class RetimeError(RrnnError):
    """A path could not be timed within its limits.

    Attributes:
        reason: the retimer's own word.
    """

    def __init__(self, message: str, reason: str = "") -> None:
        self.reason = reason
        super().__init__(message)


class DocumentError(RrnnError):
    """A file is not a document of the expected kind.

    Attributes:
        path: the file.
    """

    def __init__(self, path: str, message: str) -> None:
        self.path = path
        super().__init__(f"{path}: {' '.join(message[:_LONGEST].split())}")


class UndecidedError(RrnnError):
    """A method cannot settle a claim; the claim stays unknown.

    Attributes:
        reason: why, in half a sentence.
    """

    def __init__(self, reason: str) -> None:
        self.reason = reason
        super().__init__(reason)


class LayoutError(ShapeError):
    """An array has the right shape but the wrong type or memory order.

    Attributes:
        advice: what to pass instead.
    """

    def __init__(self, name: str, shape: tuple[int, ...], advice: str) -> None:
        super().__init__(name, shape, shape)
        self.advice = advice
        self.args = (f"{name}: {advice}",)
