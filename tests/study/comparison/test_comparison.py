"""The comparison: judged by us, kept, summed up, drawn."""

import json
import math

import numpy as np
import pytest

from rrnn_opt.solving import ActiveSet, Duals, Instance, Qpsolvers, Solution, Status
from rrnn_opt.solving.backends import SolverReport, solution
from rrnn_opt.solving.conic import PLUGINS, CasadiConic
from rrnn_opt.solving.parts import Dense, handed
from rrnn_opt.solving.proximal import PiqpSession, ProxqpSession
from rrnn_opt.solving.residual import relative_residual
from rrnn_opt.study import Results, environment, wilson
from rrnn_opt.study.cases import Row
from rrnn_opt.study.comparison import Comparison, chosen, summaries, write_report
from rrnn_opt.study.comparison.advice import advice
from rrnn_opt.study.comparison.drawn import drawn_set
from rrnn_opt.study.comparison.entrants import Entrant
from rrnn_opt.study.comparison.measure import measured_set
from rrnn_opt.study.comparison.motions import motion_set
from rrnn_opt.study.comparison.problem_set import ProblemSet
from rrnn_opt.study.comparison.profiles import time_table


def first_of(name, count):
    whole = drawn_set(name)
    return ProblemSet(
        name, whole.instances[:count], whole.truth[:count], False, whole.about
    )


SOUND = sorted({*PLUGINS} - {"highs", "qpoases"})
"""HiGHS clashes with other builds of itself in one process; qpOASES calls one of
these QPs infeasible that is not."""


@pytest.fixture(scope="module")
def stream():
    """A short stretch with and without solutions: three arms' worth is for the page."""
    whole = motion_set("infeasible", "pa10")
    kept = slice(16, 24)
    return ProblemSet(
        "short", whole.instances[kept], whole.truth[kept], True, "short", whole.scheme
    )


def answers(solver, problems):
    found = []
    for k, instance in enumerate(problems.instances):
        (solver.setup if k == 0 else solver.update)(instance)
        found.append(solver.solve())
    return found


@pytest.mark.parametrize(
    "solver",
    [
        *(ActiveSet(mode) for mode in ("cold", "stream")),
        PiqpSession(),
        ProxqpSession(),
        *(CasadiConic(name, mode) for name in SOUND for mode in ("cold", "stream")),
        *(Qpsolvers(name, mode="warm") for name in ("daqp", "osqp", "proxqp")),
    ],
    ids=lambda s: f"{s.name}-{s.mode}",
)
def test_every_way_of_asking_gives_the_optimum_of_an_independent_solver(solver, stream):
    truth = answers(Qpsolvers("quadprog"), stream)
    for mine, theirs, word in zip(
        answers(solver, stream), truth, stream.truth, strict=True
    ):
        if word == "infeasible":
            assert mine.status is Status.PRIMAL_INFEASIBLE
            assert mine.x is None
            assert not mine.claims
        else:
            assert mine.status is Status.SOLVED
            np.testing.assert_allclose(mine.x, theirs.x, atol=1e-6)


def test_relative_residuals_do_not_depend_on_the_units_of_the_cost():
    problem = Dense.of(drawn_set("convex").instances[0].problem)
    big = Dense(1e6 * problem.P, 1e6 * problem.q, *_rest(problem))
    x = np.zeros(problem.q.size)
    zero = Duals(np.zeros(len(problem.b)), np.zeros(len(problem.h)), x)
    small = relative_residual(problem, x, zero).dual
    assert relative_residual(big, x, zero).dual == pytest.approx(small, rel=0.6)
    assert math.isinf(relative_residual(problem, None, None).primal)


def _rest(p):
    return p.G, p.h, p.A, p.b, p.lb, p.ub


def test_what_is_handed_out():
    assert handed(None) == "none"
    assert handed([0.0, 0.0]) == "zeros"
    assert handed([1.0, math.nan]) == "NaN"
    assert handed([2143289344.0, 1.0]) == "junk"
    assert handed([1.0, 0.0]) == "numbers"


class Liar:
    """Says that it solved everything and hands out ones."""

    name, mode = "liar", "cold"

    def setup(self, instance):
        self.problem = Dense.of(instance.problem)

    update = setup

    def solve(self) -> Solution:
        qp = self.problem
        duals = Duals(np.zeros(len(qp.b)), np.zeros(len(qp.h)), np.zeros(len(qp.q)))
        return solution(
            qp,
            np.ones(len(qp.q)),
            duals,
            tolerance=1e-6,
            time_s=1e-6,
            report=SolverReport(claims=True),
        )


def test_nobody_is_believed(monkeypatch):
    """A solver that claims all is counted as solving nothing."""
    liar = Entrant("liar", "", "", "", ("cold",))
    monkeypatch.setattr(Entrant, "make", lambda *_: Liar())
    own = {
        "convex": first_of("convex", 3),
        "contradictory": first_of("contradictory", 2),
    }
    rows = [
        Row(
            f"{name}/liar/cold", {"stream": name, "solver": "liar", "mode": "cold", **m}
        )
        for name, problems in own.items()
        for m in [measured_set(liar, "cold", problems, passes=1)]
    ]
    good, bad = summaries(rows)
    assert (good["n"], good["solved"], good["claims_wrongly"]) == (3, 0, 3)
    assert good["primal"] is None
    assert (bad["n"], bad["wilson"]) == (0, [0.0, 1.0])
    assert bad["infeasible"]["claims"] == 2
    assert bad["infeasible"]["handed"] == {"numbers": 2}
    assert "called solved by liar (2 of 2)" in " ".join(advice(rows, tuple(own)))


def test_modes_are_for_sequences_and_networks_for_schemes(stream):
    drawn = first_of("convex", 2)
    by_name = {e.name: e for e in chosen(["daqp", "PrimalDual", "clarabel"])}
    assert by_name["daqp"].modes_for(stream) == ("cold", "warm", "stream")
    assert by_name["daqp"].modes_for(drawn) == ("cold",)
    assert by_name["PrimalDual"].modes_for(drawn) == ()
    assert by_name["PrimalDual"].modes_for(stream) == ("cold", "stream")
    assert by_name["clarabel"].modes_for(stream) == ("cold",)


@pytest.mark.slow
def test_our_exact_solver_enters_and_is_judged_like_the_others(stream):
    ours, daqp = chosen(["active_set", "daqp"])
    assert (ours.method, ours.modes_for(stream)) == ("active set", ("cold", "stream"))
    assert ours.modes_for(first_of("dense", 1)) == ()
    for mode in ours.modes:
        found, other = (
            measured_set(who, mode, stream, passes=2) for who in (ours, daqp)
        )
        assert found["status"] == other["status"]
        assert set(found["status"]) == {"solved", "primal_infeasible"}
        assert found["claims"] == [word == "solvable" for word in stream.truth]
        solved = [k for k, word in enumerate(stream.truth) if word == "solvable"]
        assert all(found["primal"][k] <= 1e-9 for k in solved)
        assert all(found["dual"][k] <= 1e-9 for k in solved)
    drawn = measured_set(ours, "cold", first_of("degenerate", 2), passes=1)
    assert drawn["status"] == ["solved", "solved"]


@pytest.mark.slow
def test_a_study_is_kept_summed_up_and_reported(tmp_path, stream):
    own = {"short": stream, "convex": first_of("convex", 3)}
    solvers = chosen(["daqp", "osqp", "PrimalDual"])
    study = Comparison(tuple(own), solvers, own, passes=2)
    with Results(tmp_path / "rows") as results:
        rows = results.finish(study)
    with Results(tmp_path / "rows") as results:
        assert sum(1 for _ in results.run(study)) == 0
    found = summaries(rows)
    assert len(found) == 3 + 3 + 2 + 2
    for row in found:
        assert row["solved"] == row["n"]
        assert row["wilson"] == list(wilson(row["n"], row["n"]))
        assert row["time_us"]["p50"] <= row["time_us"]["p999"] <= row["time_us"]["max"]
        assert max(row["primal"], row["dual"], row["gap"]) <= 1e-6
    table = time_table(rows, study.sets)
    assert set(table.names) >= {"daqp, cold", "osqp, cold"}
    assert "PrimalDual, cold" not in table.names
    looked_at(tmp_path, study, rows, len(found))


def looked_at(folder, study, rows, count):
    """The report of a study, one of whose rows was lost, says what it must."""
    lost = Row("short/quadprog/cold", {}, "WorkerError: it died", lost=True)
    paths = write_report(
        folder,
        study,
        [*rows, lost],
        environment=environment(),
        command="rrnn compare x",
        digest="0123",
        notes=["ur5: not here"],
    )
    assert [p.name for p in paths] == [
        f"compare.{k}" for k in ("png", "md", "json", "html")
    ]
    text = (folder / "compare.md").read_text()
    for wanted in ("rrnn compare x", "rows 0123", "it died", "ur5: not here", "Farkas"):
        assert wanted in text
    assert (folder / "compare.png").read_bytes()[1:4] == b"PNG"
    page = (folder / "compare.html").read_text()
    assert "data:image/png;base64," in page
    assert "http" not in page
    data = json.loads((folder / "compare.json").read_text())
    assert len(data["rows"]) == count + 1


def test_a_gain_is_that_of_the_stream():
    """Times of one's own making: the stream is ten times as fast."""
    from rrnn_opt.study.comparison.page_tables import gains_table

    rows = [
        {"stream": "s", "solver": "a", "mode": "cold", "mean_us": 50.0},
        {"stream": "s", "solver": "a", "mode": "stream", "mean_us": 5.0},
    ]
    assert "| a | - | 10.00 |" in gains_table(rows)


def test_an_instance_of_another_shape_is_set_up_anew():
    small, large = first_of("convex", 2).instances
    assert small.problem.q.size != large.problem.q.size
    both = ProblemSet("x", (small, large), ("solvable",) * 2, False, "two")
    (daqp,) = chosen(["daqp"])
    found = measured_set(daqp, "cold", both, passes=1)
    assert found["status"] == ["solved", "solved"]
    assert isinstance(small, Instance)
