"""Commands in processes of their own, in a folder that can be looked over."""

from __future__ import annotations

import csv
import json
import os
import subprocess
import sys
from dataclasses import dataclass
from pathlib import Path
from typing import Any

HERE = Path(__file__).parents[2]
PROBLEM = {
    "robot": "planar3",
    "start": [0.0, 0.5, 0.5],
    "goal": {"joints": [1.0, 0.2, -0.4]},
    "obstacles": [
        {"name": "far", "type": "sphere", "radius": 0.1, "position": [-2, 0, 0]}
    ],
}
ARM = """<robot name="one"><link name="base"/><link name="arm"><collision><geometry>
<box size="0.1 0.1 0.4"/></geometry></collision></link>
<joint name="turn" type="revolute"><parent link="base"/><child link="arm"/>
<axis xyz="0 0 1"/><limit lower="-1" upper="1" velocity="1" effort="1"/></joint>
</robot>"""


@dataclass(frozen=True)
class Place:
    """An empty folder, commands that run in it, and what may be found there.

    Attributes:
        path: current folder of the commands; ``path/out`` is for results.
        cache: of compiled code.
    """

    path: Path
    cache: Path

    @property
    def out(self) -> Path:
        return self.path / "out"

    def start(self, *words: str, **more: str) -> subprocess.Popen[str]:
        """Start ``python -m WORDS``."""
        names = {"RRNN_CACHE_DIR": str(self.cache), "TMPDIR": str(self.path / "tmp")}
        path = os.pathsep.join([str(HERE), os.environ.get("PYTHONPATH", "")])
        (self.path / "tmp").mkdir(exist_ok=True)
        return subprocess.Popen(
            [sys.executable, "-m", *words],
            cwd=self.path,
            env=os.environ | names | {"PYTHONPATH": path} | more,
            stdout=subprocess.PIPE,
            stderr=subprocess.PIPE,
            text=True,
        )

    def run(self, *words: str, **more: str) -> subprocess.CompletedProcess[str]:
        """Run ``python -m WORDS`` to its end."""
        process = self.start(*words, **more)
        said, error = process.communicate(timeout=120)
        return subprocess.CompletedProcess(words, process.returncode, said, error)

    def rrnn(self, *words: str, **more: str) -> subprocess.CompletedProcess[str]:
        """Run a command of ``rrnn``."""
        return self.run("rrnn_opt.cli.start", *words, **more)

    def files(self) -> set[str]:
        """Names of all result files, hidden ones among them."""
        found = (p for p in self.out.rglob("*") if p.is_file())
        return {str(p.relative_to(self.out)) for p in found}

    def litter(self) -> list[Path]:
        """Files that nobody asked for."""
        found = [p for p in self.out.rglob(".*") if p.name != ".lock"]
        return found + list(self.cache.glob(".new-*"))

    def age(self) -> None:
        """Let two days pass for everything that lies about."""
        drafts = [p for p in self.out.glob(".*") if p.is_dir()]
        for path in [*self.litter(), *drafts, *(self.path / "tmp").glob("*")]:
            os.utime(path, (0, 0), follow_symlinks=False)


def furnished(folder: Path, cache: Path) -> Place:
    """A new folder with a problem and an arm in it."""
    folder.mkdir()
    (folder / "problem.json").write_text(json.dumps(PROBLEM))
    (folder / "arm.urdf").write_text(ARM)
    return Place(folder, cache)


def whole(path: Path) -> bool:
    """Whether a file is what its name says, from its first to its last byte."""
    data = path.read_bytes()
    kind = path.suffix
    if kind == ".json":
        return isinstance(json.loads(data), dict)
    if kind == ".jsonl":
        lines = data.decode().splitlines()
        return data.endswith(b"\n") and all(json.loads(line) for line in lines)
    if kind == ".png":
        return data.startswith(b"\x89PNG") and data.endswith(b"IEND\xaeB`\x82")
    if kind == ".html":
        return data.rstrip().endswith(b"</html>")
    if kind == ".csv":
        rows = list(csv.reader(data.decode().splitlines()))
        return data.endswith(b"\n") and len({len(row) for row in rows}) == 1
    if kind == ".parquet":
        return data.startswith(b"PAR1") and data.endswith(b"PAR1")
    return bool(data) and data.endswith(b"\n")


def settled(document: Any) -> Any:
    """A document without what differs from run to run."""
    if isinstance(document, dict):
        kept = {k: v for k, v in document.items() if not k.endswith("_s")}
        return {k: settled(v) for k, v in kept.items()}
    return [settled(v) for v in document] if isinstance(document, list) else document


def contents(place: Place) -> dict[str, Any]:
    """What all result files say, times set aside."""
    found = {}
    for name in place.files():
        path = place.out / name
        if path.suffix == ".json":
            found[name] = settled(json.loads(path.read_text()))
        elif path.suffix not in (".html", ".png"):
            found[name] = path.read_bytes()
        else:
            found[name] = "picture"
    return found
