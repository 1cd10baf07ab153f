"""Cortex-M boards: cross compile a package, weigh it, run it in an emulator.

``measure`` is imported from its module: packages are made with files of this room.
"""

from __future__ import annotations

from rrnn_opt.embedding.target.board import BOARDS, Board, missing

__all__ = ["BOARDS", "Board", "missing"]
