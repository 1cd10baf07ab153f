"""Controllers for other machines: a folder of C99 that stands alone."""

from __future__ import annotations

from rrnn_opt.embedding.generate import generate
from rrnn_opt.embedding.package import Package

__all__ = ["Package", "generate"]
