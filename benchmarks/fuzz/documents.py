"""Documents that are judged or drawn: plans, certificates, pages."""

from __future__ import annotations

import contextlib
import functools
import json
import random
import tempfile
from pathlib import Path
from typing import Any

from benchmarks.fuzz import bases, mutation
from benchmarks.fuzz.files import sound
from benchmarks.fuzz.judging import ACCEPTED, Entry, require
from rrnn_opt.errors import RrnnError

SEMANTIC = ("robot", "problem", "trajectory")
EXACTLY = 0.1
"""Share of the accepted plans that are proved again in ball arithmetic."""


def plan(rng: random.Random, folder: Path) -> str:
    """A plan to the independent checker; what it believes is proved again."""
    from rrnn_opt.check import check_plan

    base = json.loads(bases.plan_text())
    data = mutation.document(rng, base)
    found = check_plan(data)
    sound(json.loads(json.dumps(found.to_dict(), allow_nan=False)), "answer")
    changed = [key for key in SEMANTIC if data.get(key) != base[key]]
    if found.holds and changed and rng.random() < EXACTLY:
        require(check_plan(data, exact=True).holds, f"proved once only: {changed}")
    return ACCEPTED


def certificate(rng: random.Random, folder: Path) -> str:
    """A claim's certificate; half of the time sealed anew after the change."""
    from rrnn_opt.check.claims.certificate import check_certificate, digest
    from rrnn_opt.check.claims.document import read_claim

    name = rng.choice(sorted(bases.certificates()))
    base = bases.certificates()[name]
    part = rng.choice(("claim", "payload", "witness", ""))
    data = json.loads(json.dumps(base))
    if part and data.get(part):
        data[part] = mutation.document(rng, data[part])
    else:
        data = mutation.document(rng, base)
    if rng.random() < 0.7 and isinstance(data, dict):
        with contextlib.suppress(RrnnError, TypeError, KeyError):
            if data.get("claim") != base["claim"] and rng.random() < 0.7:
                data["claim"]["fingerprint"] = read_claim(data["claim"]).fingerprint
            data.pop("digest", None)
    found = check_certificate(data)
    sound(json.loads(json.dumps(found.to_dict(), allow_nan=False)), "answer")
    if "digest" in data and data["digest"] != digest(data):
        require(found.status == "UNKNOWN", "an altered document was believed")
    return ACCEPTED


def certificate_file(rng: random.Random, folder: Path) -> str:
    """A plan or a certificate in a file, to ``rrnn check``'s reader."""
    from rrnn_opt.cli.check import judged, read

    base: Any = rng.choice((*bases.certificates().values(), bases.plan_text()))
    base = json.loads(base) if isinstance(base, str) else base
    path = folder / "document.json"
    path.write_bytes(mutation.json_bytes(rng, base))
    json.dumps(judged(read(str(path))), allow_nan=False)
    return ACCEPTED


@functools.cache
def _scripts() -> int:
    """Script elements of a page whose names are harmless."""
    from rrnn_opt.report import write_page

    with tempfile.TemporaryDirectory() as folder:
        path = Path(folder) / "page.html"
        write_page(json.loads(bases.plan_text()), path)
        return path.read_text(encoding="utf-8").count("<script")


def page(rng: random.Random, folder: Path) -> str:
    """A plan drawn as an HTML page: no script but its own may be in it."""
    from rrnn_opt.report import write_page

    data = json.loads(bases.plan_text())
    if rng.random() < 0.5:
        name = rng.choice(mutation.NAMES)
        data["robot"]["name"] = data["message"] = name
        data["robot"]["joint_names"] = [f"{name}{k}" for k in range(3)]
        data["problem"]["obstacles"][0]["name"] = name
        data["status"] = rng.choice(("solved", name))
    else:
        data = mutation.document(rng, data)
    path = folder / "page.html"
    write_page(data, path)
    text = path.read_text(encoding="utf-8")
    require("<script>alert" not in text, "a name became a script")
    require(text.count("<script") <= _scripts(), "there are more scripts")
    return ACCEPTED


ENTRIES = (
    Entry("plan document", plan, 5),
    Entry("claim certificate", certificate, 6),
    Entry("document file", certificate_file, 3),
    Entry("HTML page", page, 1),
)
