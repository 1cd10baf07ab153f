"""The search's trees as a document, for pictures."""

from __future__ import annotations

from typing import Any

from rrnn_opt.planning.search.library import Search

MOST_NODES = 4000
"""Nodes of each tree that a document keeps; the first ones."""


def tree_document(search: Search) -> dict[str, Any]:
    """The ``trees`` of a plan document: postures, and the index of each parent.

    ``{"start": {"q": [[..]], "parents": [..]}, "goal": ..}``; a root's parent
    is -1, and a parent stands before its children.
    """
    sides = zip(("start", "goal"), search.trees(MOST_NODES), strict=True)
    return {
        side: {"q": nodes.tolist(), "parents": parents.tolist()}
        for side, (nodes, parents) in sides
    }
