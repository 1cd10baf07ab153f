"""The proof of the sine's error, a part of it done again, and broken variants."""

from __future__ import annotations

import pytest

from rrnn_opt.emit.prologue import support_text
from rrnn_opt.validation.studies import sincos_bound
from rrnn_opt.validation.studies.sincos_bound import BALLS, COSINE, SINE, prove


@pytest.mark.parametrize("first", [0, BALLS // 2 - 8, BALLS - 16])
def test_parts_of_the_proof_hold(first):
    found = prove(first=first, last=first + 16)
    assert found.holds
    assert found.balls == 16


def test_header_has_these_coefficients_and_this_bound():
    text = support_text("interval_sincos.h")
    for coefficient in (*SINE, *COSINE[:-1]):
        assert abs(coefficient).hex() in text
    assert "#define RRNN_SINCOS 0x1p-49" in text
    assert "#define RRNN_ANGLE 1e5" in text
    for part in sincos_bound.PARTS:
        assert part in text


@pytest.mark.parametrize("name", ["SINE", "COSINE"])
def test_a_wrong_coefficient_is_not_proved(monkeypatch, name):
    wrong = list(getattr(sincos_bound, name))
    wrong[-1] *= 1 + 1e-13
    monkeypatch.setattr(sincos_bound, name, wrong)
    assert not prove(first=BALLS - 16).holds
