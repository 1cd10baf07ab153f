"""A finished report as a page of the documentation, its pictures in few colours.

    rrnn reproduce all --out DIR
    python -m rrnn_opt.validation.reproduce.publish DIR --docs docs

Numbers and words are those of the report; only links and pictures are changed.
"""

from __future__ import annotations

import argparse
import io
import re
import sys
from collections.abc import Sequence
from pathlib import Path

from rrnn_opt.report import write_bytes, write_text
from rrnn_opt.validation.ending import ended

PAGE, PREFIX = "reproduction", "reproduction_"
COLOURS, WIDTH = 160, 1300
"""Of a picture: colours, and pixels across at most."""
_PICTURE = re.compile(r"\((\w+\.png)\)")
_ROWS = re.compile(r"\[(\w+\.jsonl)\]\(\1\)")
_BESIDE = "beside this page as JSON lines and in `rows/`"
_THERE = "beside the report of a run as JSON lines and in its `rows/`"


def published(text: str, *, note: str = "") -> str:
    """The report with links that hold in the documentation.

    Args:
        text: of ``reproduce.md``.
        note: a paragraph below the title.
    """
    text = _PICTURE.sub(rf"(../images/{PREFIX}\1)", text)
    text = _ROWS.sub(r"`\1`", text).replace(_BESIDE, _THERE)
    title, rest = text.split("\n", 1)
    return f"{title}\n\n{note}\n{rest}" if note else text


def small(picture: bytes) -> bytes:
    """A PNG with few colours and no more pixels than a page shows.

    Args:
        picture: PNG.
    """
    from PIL import Image

    image = Image.open(io.BytesIO(picture)).convert("RGB")
    if image.width > WIDTH:
        size = (WIDTH, round(image.height * WIDTH / image.width))
        image = image.resize(size, Image.Resampling.LANCZOS)
    out = io.BytesIO()
    image.quantize(COLOURS).save(out, format="png", optimize=True)
    return out.getvalue()


def publish(folder: Path, docs: Path, *, note: str = "") -> tuple[Path, ...]:
    """Write ``results/reproduction.md`` and its pictures.

    Args:
        folder: that ``rrnn reproduce`` wrote.
        docs: with ``results`` and ``images``.
        note: see ``published``.
    """
    text = (folder / "reproduce.md").read_text("utf-8")
    pictures = []
    for name in _PICTURE.findall(text):
        target = docs / "images" / f"{PREFIX}{name}"
        pictures.append(write_bytes(target, small((folder / name).read_bytes())))
    page = write_text(docs / "results" / f"{PAGE}.md", published(text, note=note))
    return (page, *pictures)


def main(argv: Sequence[str] | None = None) -> int:
    """Publish a report and say what was written."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("folder", type=Path, help="of rrnn reproduce --out")
    parser.add_argument("--docs", type=Path, default=Path("docs"))
    parser.add_argument("--note", default="", help="a paragraph below the title")
    given = parser.parse_args(argv)
    for path in publish(given.folder, given.docs, note=given.note):
        print(path)
    return 0


if __name__ == "__main__":
    sys.exit(ended(main))
