import importlib
import sys

import numpy as np
import pytest

from rrnn_opt.errors import InfeasibleQpError, RrnnError
from rrnn_opt.study import Case, generator, rows, run


class Draws:
    """Each case draws; the case called "bad" fails."""

    name = "draws"

    def __init__(self, keys):
        self.keys = keys

    def __iter__(self):
        return (Case(key, {"n": 3}) for key in self.keys)

    def measure(self, case, rng):
        if case.key == "bad":
            raise InfeasibleQpError("no feasible point")
        return {"first": float(rng.random()), "n": case.parameters["n"]}


IMPORTABLE = """
from rrnn_opt.study import Case
class Draws:
    name = "draws"
    def __init__(self, keys): self.keys = keys
    def __iter__(self): return (Case(key) for key in self.keys)
    def measure(self, case, rng): return {"first": float(rng.random())}
"""


def test_a_case_draws_the_same_wherever_it_stands():
    forward = {row.key: row.metrics for row in run(Draws("abcd"))}
    backward = {row.key: row.metrics for row in run(Draws("dba"))}
    assert all(forward[key] == backward[key] for key in backward)
    assert len({row["first"] for row in forward.values()}) == 4


def test_the_seed_of_the_study_changes_every_case():
    assert run(Draws("a"), seed=1) != run(Draws("a"), seed=2)
    assert run(Draws("a"), seed=1) == run(Draws("a"), seed=1)


def test_key_and_seed_do_not_run_into_each_other():
    first = generator(Case("1x"), seed=1).random()
    assert first != generator(Case("x"), seed=11).random()


def test_two_workers_give_the_rows_of_one(tmp_path, monkeypatch):
    (tmp_path / "draws_study.py").write_text(IMPORTABLE)
    monkeypatch.syspath_prepend(tmp_path)
    study = importlib.import_module("draws_study").Draws("abcdefg")
    try:
        told = []
        here = run(study, seed=3)
        there = run(study, jobs=2, seed=3, progress=lambda *n: told.append(n))
        assert there == here
        assert [row.key for row in there] == list("abcdefg")
        assert told == [(k, 7) for k in range(1, 8)]
    finally:
        del sys.modules["draws_study"]


def test_our_own_error_is_a_row_and_the_study_goes_on():
    got = run(Draws(["a", "bad", "b"]))
    assert got[1].error == "InfeasibleQpError: no feasible point"
    assert got[1].metrics == {}
    assert got[2].metrics["n"] == 3


def test_a_bug_is_not_swallowed():
    class Broken(Draws):
        def measure(self, case, rng):
            return {"x": 1 / 0}

    with pytest.raises(ZeroDivisionError):
        run(Broken("a"))


def test_rows_come_one_by_one():
    seen = []

    class Watched(Draws):
        def measure(self, case, rng):
            seen.append(case.key)
            return {}

    stream = rows(Watched("abc"))
    next(stream)
    assert seen == ["a"]


def test_two_cases_of_one_key_are_refused():
    with pytest.raises(RrnnError, match="same key"):
        run(Draws("aa"))


def test_draws_of_many_cases_look_independent():
    first = [generator(Case(str(k))).random() for k in range(400)]
    assert abs(np.mean(first) - 0.5) < 0.06
    assert abs(np.corrcoef(first[:-1], first[1:])[0, 1]) < 0.15
