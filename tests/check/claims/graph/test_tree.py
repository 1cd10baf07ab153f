"""Trees of cuts that are cut, altered or leave boxes open prove nothing."""

from __future__ import annotations

import base64
import hashlib
import zlib
from fractions import Fraction
from types import SimpleNamespace

import numpy as np
import pytest

from rrnn_opt.check.claims.graph.tree import MEAN_VALUE, NATURAL, leaves, read_tree
from rrnn_opt.errors import DocumentError, UndecidedError


def payload(codes, **more):
    data = bytes(codes)
    packed = base64.b64encode(zlib.compress(data)).decode()
    digest = hashlib.sha256(data).hexdigest()
    return {"tree": packed, "nodes": len(data), "sha256": digest, **more}


def graph(low=Fraction(0), high=Fraction(1)):
    """A claim of one variable of two elements."""
    ports = [SimpleNamespace(name="x", size=2)]
    domain = {(0, 0): (low, high), (0, 1): (low, high)}
    return SimpleNamespace(inputs=ports, domain=domain)


def test_the_leaves_fill_the_domain():
    found = leaves(graph(), read_tree(payload([0, NATURAL, 1, MEAN_VALUE, NATURAL])))
    volume = np.prod(found.upper - found.lower, axis=0)
    assert np.sum(volume) == pytest.approx(1.0)
    assert found.plain.tolist() == [True, False, True]


@pytest.mark.parametrize(
    "change",
    [
        {"tree": "no base 64 !"},
        {"tree": base64.b64encode(b"no zlib").decode()},
        {"tree": None},
        {"nodes": "many"},
        {"nodes": None},
    ],
)
def test_what_is_no_tree_is_not_readable(change):
    with pytest.raises(DocumentError, match="tree not readable"):
        read_tree(payload([NATURAL], **change))


@pytest.mark.parametrize("change", [{"nodes": 2}, {"sha256": "0" * 64}])
def test_another_tree_than_the_digest_names_is_refused(change):
    with pytest.raises(UndecidedError, match="digest"):
        read_tree(payload([NATURAL], **change))


@pytest.mark.parametrize(
    ("codes", "said"),
    [
        ([], "not whole"),
        ([0, NATURAL], "not whole"),
        ([2, NATURAL, NATURAL], "not whole"),
        ([251], "leaves boxes open"),
        ([NATURAL, NATURAL], "more nodes than boxes"),
    ],
)
def test_a_tree_that_does_not_fit_proves_nothing(codes, said):
    with pytest.raises(UndecidedError, match=said):
        leaves(graph(), np.array(codes, np.uint8))


@pytest.mark.parametrize("side", ["low", "high"])
def test_a_variable_without_bounds_has_no_tree(side):
    with pytest.raises(UndecidedError, match="'x' has no bounds"):
        leaves(graph(**{side: None}), np.array([NATURAL], np.uint8))


def test_a_box_too_large_to_be_halved_proves_nothing():
    wide = graph(Fraction(-(10**308)), Fraction(10**308))
    with (
        np.errstate(over="ignore", invalid="ignore"),
        pytest.raises(UndecidedError, match="to be halved"),
    ):
        leaves(wide, np.array([0, NATURAL, NATURAL], np.uint8))
