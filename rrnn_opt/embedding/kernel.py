"""The functions that a package is made of, and the fields of its structs."""

from __future__ import annotations

from dataclasses import dataclass

import casadi as ca

from rrnn_opt.dynamics import DiscreteDynamics, Dynamics, Euler
from rrnn_opt.embedding.words import member
from rrnn_opt.emit.c99 import parameter_names
from rrnn_opt.lyapunov import merit
from rrnn_opt.robot import Kinematics
from rrnn_opt.symbolic import Symbol, Tape, shape_of

STEP = Symbol.scalar("step_size", "s", "Euler step of the network")


@dataclass(frozen=True)
class Field:
    """One array of a C struct.

    Attributes:
        name: C name.
        shape: (rows, columns); column-major in C.
        unit: SI unit.
        meaning: half a sentence.
    """

    name: str
    shape: tuple[int, int]
    unit: str
    meaning: str

    @property
    def size(self) -> int:
        """Number of elements."""
        return self.shape[0] * self.shape[1]


@dataclass(frozen=True, eq=False)
class Kernel:
    """One Euler step of a network, as functions and as named fields.

    Attributes:
        dynamics: the network.
        function: (state, parameters.., step_size) -> "next" state, "output"
            there, "merit" V and largest "residual" of the old state, "extent"
            (sum of squares of the parameters), "size" (``tally`` of states and
            output)
            and, where there are bounds, "room" (least upper - lower).
        tape: of the function.
        monitor: (state, parameters.., step_size) -> "merit", its "change" in
            one step, "residual", "extent", "size" and, of a formulation, what
            lies between output and bounds, "below" and "above", "room", and
            "slack" of the inequality rows.
        state: field of the state.
        inputs: fields of the parameters.
        output: field of the output.
        bounds: number of bounds, 0 without.
        rows: number of inequality rows.
    """

    dynamics: Dynamics
    function: ca.Function
    tape: Tape
    monitor: Tape
    state: Field
    inputs: tuple[Field, ...]
    output: Field
    bounds: int
    rows: int

    @property
    def watched(self) -> tuple[int, int]:
        """Bounds and rows that the monitor watches."""
        names = {port.name for port in self.monitor.outputs}
        return self.bounds * ("below" in names), self.rows * ("slack" in names)


def kernel(dynamics: Dynamics) -> Kernel:
    """One Euler step, and what the monitor says of a state.

    Args:
        dynamics: any network.

    Raises:
        RrnnError: a parameter is called "step_size".
        UnsupportedOperationError: the graph holds an unknown operation.
    """
    step = dynamics.step(Euler(STEP))
    form = dynamics.formulation
    bounds = form.decision.size if form is not None and form.qp.bounded else 0
    rows = int(form.inequalities.size1()) if form is not None else 0
    function = _function("kernel", step, _step_outputs(step, bounds))
    tape = Tape.of(function)
    names = [member(name) for name in parameter_names(tape)]
    symbols = (step.state, *step.parameters)
    fields = [
        Field(name, s.shape, s.unit, s.meaning)
        for name, s in zip(names, symbols, strict=False)
    ]
    monitor = Tape.of(_function("monitor", step, _monitor_outputs(step, bounds, rows)))
    output = _output_field(dynamics, shape_of(step.output))
    return Kernel(
        dynamics=dynamics,
        function=function,
        tape=tape,
        monitor=monitor,
        state=fields[0],
        inputs=tuple(fields[1:-1]),
        output=output,
        bounds=bounds,
        rows=rows,
    )


def largest(values: ca.SX) -> ca.SX:
    """Largest magnitude of a column."""
    return ca.densify(ca.norm_inf(values)) if values.numel() else ca.SX(0)


def tally(*columns: ca.SX) -> ca.SX:
    """Magnitude of the sum: finite unless an entry is not, or is close to it."""
    entries = {e.element_hash(): e for column in columns for e in ca.vertsplit(column)}
    return ca.fabs(ca.sum1(ca.vertcat(*entries.values())))


def room(lower: ca.SX, upper: ca.SX) -> ca.SX:
    """Least ``upper - lower``; negative when some bounds exclude everything."""
    found = ca.SX(1)
    for low, high in zip(ca.vertsplit(lower), ca.vertsplit(upper), strict=True):
        gap = high - low
        if not (gap.is_constant() and float(gap) > 1.0):
            found = ca.fmin(found, gap)
    return found


def _function(
    name: str, step: DiscreteDynamics, outputs: dict[str, ca.SX]
) -> ca.Function:
    symbols = (step.state, *step.parameters)
    values = [ca.densify(value) for value in outputs.values()]
    names = [s.name for s in symbols]
    may = {"allow_duplicate_io_names": True}
    inputs = [s.sx for s in symbols]
    return ca.Function(name, inputs, values, names, list(outputs), may)


def _step_outputs(step: DiscreteDynamics, bounds: int) -> dict[str, ca.SX]:
    output = ca.substitute(step.output, step.state.sx, step.next)
    given = ca.vertcat(*(ca.vec(p.sx) for p in step.parameters[:-1]))
    outputs = {
        "next": step.next,
        "output": output,
        "merit": merit(step).value,
        "residual": largest(step.residual),
        "extent": ca.sumsqr(given) if given.numel() else ca.SX(0),
        "size": tally(step.state.sx, step.next, output),
    }
    form = step.formulation
    if bounds and form is not None:
        outputs["room"] = room(form.lower, form.upper)
    return outputs


def _monitor_outputs(
    step: DiscreteDynamics, bounds: int, rows: int
) -> dict[str, ca.SX]:
    value = merit(step)
    given = ca.vertcat(*(ca.vec(p.sx) for p in step.parameters[:-1]))
    outputs = {
        "merit": value.value,
        "change": value.change(step),
        "residual": largest(step.residual),
        "extent": ca.sumsqr(given) if given.numel() else ca.SX(0),
        "size": tally(step.state.sx, step.next),
    }
    form = step.formulation
    if form is None or form.decision.shape != shape_of(step.output):
        return outputs
    if bounds:
        outputs |= {
            "below": step.output - form.lower,
            "above": form.upper - step.output,
            "room": room(form.lower, form.upper),
        }
    if rows:
        slack = ca.substitute(-form.inequalities, form.decision.sx, step.output)
        outputs["slack"] = slack
    return outputs


def _output_field(dynamics: Dynamics, shape: tuple[int, int]) -> Field:
    form = dynamics.formulation
    if form is None or form.decision.shape != shape:
        return Field("output", shape, "1", "output of the network")
    return Field("output", shape, form.decision.unit, form.decision.meaning)


def pose(kin: Kinematics) -> Tape:
    """Forward kinematics of the tip: q to "position", "rotation", "jacobian".

    The Jacobian has six rows, linear then angular, in base axes.

    Args:
        kin: kinematics of the robot.
    """
    frame = kin.pose()
    outputs = {
        "position": frame[:3, 3],
        "rotation": frame[:3, :3],
        "jacobian": kin.jacobian(kind="pose"),
    }
    values = [ca.densify(value) for value in outputs.values()]
    return Tape.of(ca.Function("pose", [kin.q], values, ["q"], list(outputs)))
