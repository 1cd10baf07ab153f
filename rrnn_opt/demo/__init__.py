"""The main job in one command: one expression in, everything else out."""

from rrnn_opt.demo.demo import DemoReport, run
from rrnn_opt.demo.outcome import Check

__all__ = ["Check", "DemoReport", "run"]
