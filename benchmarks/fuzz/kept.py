"""What a run left behind: journals, parts, test sets, packages, links in folders."""

from __future__ import annotations

import functools
import json
import random
from pathlib import Path
from typing import Any

import numpy as np

from benchmarks.fuzz import mutation
from benchmarks.fuzz.judging import ACCEPTED, Entry, require


def _entries() -> list[dict[str, Any]]:
    from rrnn_opt.study.journal import sealed

    return [
        sealed(
            {
                "identity": f"{k:064x}",
                "study": "s",
                "key": f"case/{k}",
                "seed": 0,
                "error": "",
                "time_s": 0.5,
                "metrics": {"error_m": 0.1 * k, "name": "x"},
            }
        )
        for k in range(5)
    ]


def _journal(rng: random.Random) -> bytes:
    lines = [json.dumps(entry) for entry in _entries()]
    at = rng.randrange(len(lines))
    if rng.random() < 0.5:
        changed = mutation.document(rng, json.loads(lines[at]))
        lines[at] = mutation.json_text(changed)
    else:
        lines[at] = mutation.characters(rng, lines[at])
    data = ("\n".join(lines) + "\n").encode("utf-8", "surrogatepass")
    return mutation.raw(rng, data) if rng.random() < 0.3 else data


@functools.cache
def _part() -> bytes:
    import tempfile

    from rrnn_opt.study.parts import write_part

    with tempfile.TemporaryDirectory() as folder:
        path = write_part(Path(folder) / "part-000001.parquet", _entries())
        return path.read_bytes()


def store(rng: random.Random, folder: Path) -> str:
    """Kept rows with a damaged journal or part: the others come, unaltered."""
    from rrnn_opt.study import Store

    rows = folder / "rows"
    rows.mkdir()
    if rng.random() < 0.7:
        (rows / "journal.jsonl").write_bytes(_journal(rng))
    if rng.random() < 0.5:
        name = rng.choice(("part-000001.parquet", "part-x.parquet", "part-.parquet"))
        (rows / name).write_bytes(mutation.raw(rng, _part()))
    whole = {entry["identity"]: entry for entry in _entries()}
    with Store(rows) as kept:
        for entry in kept:
            good = whole.get(entry["identity"])
            require(entry == good, f"an altered row was believed: {entry}"[:600])
        kept.append({**_entries()[0]})
    return ACCEPTED


def links(rng: random.Random, folder: Path) -> str:
    """Output folders in which names are links to another folder's files."""
    elsewhere = folder.parent / "elsewhere"
    what = rng.randrange(4)
    if what == 0:
        from rrnn_opt.study import Store

        rows = folder / "rows"
        rows.mkdir()
        (rows / "journal.jsonl").symlink_to(elsewhere / "journal.jsonl")
        with Store(rows) as kept:
            kept.append(_entries()[0])
    elif what == 1:
        from rrnn_opt.report import write_text

        (folder / "plan.json").symlink_to(elsewhere / "plan.json")
        write_text(folder / "plan.json", "{}")
    elif what == 2:
        _package_link(rng, folder, elsewhere)
    else:
        from rrnn_opt.study import Results

        (folder / "rows").symlink_to(elsewhere, target_is_directory=True)
        (folder / "rows.before").symlink_to(elsewhere, target_is_directory=True)
        with Results(folder / "rows", resume=False):
            pass
    return ACCEPTED


def _package_link(rng: random.Random, folder: Path, elsewhere: Path) -> None:
    from rrnn_opt.embedding.package import with_manifest

    first = with_manifest("arm", {"a.c": "1", "inner/kept.c": "2"}, {})
    first.write(folder)
    second = with_manifest("arm", {"a.c": "3", "b.c": "4"}, {})
    inner = folder / "arm" / "inner"
    (inner / "kept.c").unlink()
    inner.rmdir()
    inner.symlink_to(elsewhere / "inner", target_is_directory=True)
    rng.choice((first, second)).write(folder)


def package(rng: random.Random, folder: Path) -> str:
    """A package of odd names, or over a folder whose manifest was altered."""
    from rrnn_opt.embedding import Package
    from rrnn_opt.embedding.package import with_manifest

    if rng.random() < 0.5:
        name = rng.choice((*mutation.NAMES, "arm", "../elsewhere"))
        file = rng.choice((*mutation.NAMES, "a.c", "../elsewhere/precious.txt"))
        where = Package(name, {file: "x", "MANIFEST.json": "{}"}).write(folder)
        inside = where.resolve().is_relative_to(folder.resolve())
        require(inside, "a package outside of the folder")
        return ACCEPTED
    good = with_manifest("arm", {"a.c": "1", "inner/b.c": "2"}, {"robot": "r"})
    good.write(folder)
    (folder / "arm" / "own.txt").write_text("mine", encoding="utf-8")
    manifest = {**good.manifest, "files": {"a.c": "", "../../elsewhere/plan.json": ""}}
    manifest["files"][rng.choice(mutation.NAMES)] = ""
    place = folder / "arm" / "MANIFEST.json"
    place.write_bytes(mutation.json_bytes(rng, manifest))
    good.write(folder)
    require((folder / "arm" / "own.txt").exists(), "a file of others was removed")
    return ACCEPTED


ROW: dict[str, Any] = {
    "P": [1.0, 0.0, 0.0, 1.0],
    "q": [1.0, -1.0],
    "G": [1.0, 1.0],
    "h": [1.0],
    "A": None,
    "b": None,
    "lb": [-1.0, -1.0],
    "ub": [1.0, 1.0],
    "name": "a",
}
"""A quadratic programme, matrices row by row."""


def _damage(rng: random.Random, columns: dict[str, list[Any]]) -> None:
    """Take a column away, or fill it with nothing, bad numbers or other lengths."""
    key = rng.choice(sorted(columns))
    what = rng.randrange(4)
    if what == 0:
        del columns[key]
    elif what == 1:
        columns[key] = [None, None]
    elif what == 2:
        columns[key] = [[rng.choice((np.nan, np.inf, 1e300, 2.0))] * 2] * 2
    else:
        columns[key] = [[1.0] * rng.randrange(6)] * 2


def test_set(rng: random.Random, folder: Path) -> str:
    """A Parquet test set of quadratic programmes, its cells or bytes damaged."""
    import pyarrow as pa
    import pyarrow.parquet as pq

    from rrnn_opt.study.comparison import own_sets

    columns: dict[str, list[Any]] = {key: [value] * 2 for key, value in ROW.items()}
    for _ in range(rng.choice((1, 1, 2))):
        _damage(rng, columns)
    path = folder / "set.parquet"
    pq.write_table(pa.table(columns), path)
    if rng.random() < 0.4:
        path.write_bytes(mutation.raw(rng, path.read_bytes()))
    for problems in own_sets(str(path)).values():
        for instance in problems.instances:
            n = len(instance.problem.q)
            require(instance.problem.P.shape == (n, n), "P is not square")
            require(np.all(np.isfinite(instance.problem.P)), "P is not finite")
            require(np.all(np.isfinite(instance.problem.q)), "q is not finite")
    return ACCEPTED


ENTRIES = (
    Entry("kept rows", store, 3),
    Entry("links in folders", links, 1),
    Entry("package folder", package, 2),
    Entry("Parquet test set", test_set, 2),
)
