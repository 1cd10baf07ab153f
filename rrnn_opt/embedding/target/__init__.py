"""Cortex-M boards: cross compile a package, weigh it, run it in an emulator."""

from __future__ import annotations

from rrnn_opt.embedding.target.board import BOARDS, Board, missing

__all__ = ["BOARDS", "Board", "missing"]
