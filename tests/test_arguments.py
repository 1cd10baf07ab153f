"""Arguments of another kind than the signature says get one sentence."""

from __future__ import annotations

import math
from collections.abc import Iterable

import casadi as ca
import numpy as np
import pytest

import rrnn_opt as rr
from rrnn_opt.arguments import checked
from rrnn_opt.errors import ArgumentError, NotFiniteError, RrnnError, ShapeError
from rrnn_opt.motion import Path, Trajectory
from rrnn_opt.networks import LviPdnn, PrimalDual
from rrnn_opt.planning import RandomRnn
from rrnn_opt.robot import Limits
from rrnn_opt.scene.library import scenario
from rrnn_opt.study import wilson


@pytest.mark.parametrize(
    "value", [None, "0.01", 1j, [0.1], np.ones(2), True, object(), b"1", 10**400]
)
def test_what_is_no_number_is_named_with_its_argument(value):
    with pytest.raises(ArgumentError, match="PrimalDual: epsilon: expected a number"):
        PrimalDual(epsilon=value)


@pytest.mark.parametrize("value", [0.5, 1, np.float32(0.5), np.int64(1)])
def test_numbers_of_every_kind_are_numbers(value):
    assert LviPdnn(gamma=value).gamma == value


@pytest.mark.parametrize("kind", [np.float64, np.float32, np.int8])
def test_an_array_without_axes_is_its_number_and_kept_as_one(kind):
    made = LviPdnn(gamma=np.array(2, kind))
    assert type(made.gamma) is type(np.array(2, kind).item())
    assert made == LviPdnn(gamma=2.0)
    assert hash(made) == hash(LviPdnn(gamma=2.0))


@pytest.mark.parametrize("value", [np.array("a"), np.array(True), np.array(1j)])
def test_an_array_without_axes_that_is_no_number_is_refused(value):
    with pytest.raises(
        ArgumentError, match="LviPdnn: gamma: expected a number, got an"
    ):
        LviPdnn(gamma=value)


@checked()
def total(parts: Iterable[float]) -> float:
    return sum(parts)


def test_what_can_be_read_but_once_is_not_read_before_its_time():
    assert total(x for x in (1.0, 2.0)) == 3.0
    assert total({1.0: "a"}.keys()) == 1.0
    for value in ("12", b"12", {1.0: 2.0}, 3.0, np.array(3.0)):
        with pytest.raises(ArgumentError, match="total: parts: expected a sequence"):
            total(value)
    with pytest.raises(ArgumentError, match=r"total: parts\[1\]: expected a number"):
        total([1.0, "2"])


@pytest.mark.parametrize("value", [math.nan, math.inf])
def test_no_setting_is_kept_that_is_not_finite(value):
    with pytest.raises(NotFiniteError, match=r"RandomRnn\.max_step"):
        RandomRnn(max_step=value)


def test_limits_may_be_infinite_but_not_speeds():
    ends, ones = np.full(2, np.inf), np.ones(2)
    assert Limits(-ends, ends, ones, ones).upper[0] == np.inf
    with pytest.raises(NotFiniteError, match=r"Limits\.velocity"):
        Limits(-ends, ends, ends, ones)


@pytest.mark.parametrize("value", ["abc", [[1j]], [[None]], {"a": 1}, print, [[1], []]])
def test_rows_hold_numbers(value):
    with pytest.raises(ArgumentError, match="Path: waypoints"):
        Path(value)


def test_the_entry_that_is_wrong_is_named():
    with pytest.raises(
        ArgumentError, match=r"plan_many: problems\[0\]: expected a Pro"
    ):
        rr.plan_many([1])
    with pytest.raises(ArgumentError, match="plan_many: problems: expected a sequence"):
        rr.plan_many(1)


def test_values_that_libraries_would_stumble_over_get_a_sentence():
    problem = rr.Problem.from_dict(scenario("window").problem(0))
    with pytest.raises(RrnnError, match="seed: must be zero or more, not -3"):
        rr.plan(problem, seed=-3)
    with pytest.raises(RrnnError, match="obstacles: expected shapes"):
        rr.Scene(np.array(0))
    with pytest.raises(RrnnError, match="confidence must lie between 0 and 1"):
        wilson(1, 2, confidence=-3.0)


def test_verbs_say_what_they_want():
    with pytest.raises(ArgumentError, match="plan: problem: expected a Problem"):
        rr.plan({"robot": "planar3"})
    with pytest.raises(ArgumentError, match="missing a required argument: 'problem'"):
        rr.plan()
    with pytest.raises(RrnnError, match="kin: expected a Kinematics, got 'planar3'"):
        rr.formulations.minimum_velocity("planar3")


def test_what_compiled_code_is_given_is_no_number_that_it_would_cut():
    """A complex array would lose its imaginary part, a ragged list its shape."""
    q = ca.SX.sym("q", 3)
    batch = rr.emit.compile_batch(ca.Function("odd", [q], [ca.sin(q)]))
    for value in (np.ones((3, 2), complex), [[1.0], [2.0, 3.0]], "abc", {1, 2}):
        with pytest.raises(ArgumentError, match="odd: array 0: expected numbers"):
            batch(value)
    with pytest.raises(ShapeError, match="odd: out"):
        batch(np.ones((3, 8)), out=np.array(0.0))


@pytest.mark.parametrize(
    ("call", "said"),
    [
        (lambda: LviPdnn()([1.0]), "ProjectionNetwork: form: expected a Formulation"),
        (lambda: rr.Kinematics("pa10"), "Kinematics: robot: expected a Robot"),
        (lambda: rr.emit.compile_batch(3), "compile_batch: fn: expected a Function"),
        (
            lambda: rr.LyapunovFunction(ca.SX(0), "x"),
            "LyapunovFunction: state: expected a Symbol",
        ),
        (lambda: Trajectory.from_dict({"t": [0]}), "from_dict: there is no 'q'"),
        (lambda: Trajectory.from_dict([1]), "Trajectory.from_dict: data: expected"),
    ],
)
def test_declarations_and_methods_name_what_they_want(call, said):
    with pytest.raises(ArgumentError, match=said):
        call()
