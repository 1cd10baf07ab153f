"""What is said reaches every terminal, whatever is in a name."""

import io
import json
import subprocess
import sys

import pytest

from rrnn_opt.cli.output import Output
from rrnn_opt.errors import DocumentError


@pytest.mark.parametrize("encoding", ["utf-8", "ascii", "latin-1", "cp1252"])
def test_names_with_odd_letters_are_said(monkeypatch, encoding):
    raw = {name: io.BytesIO() for name in ("stdout", "stderr")}
    for name, buffer in raw.items():
        stream = io.TextIOWrapper(buffer, encoding, errors="strict")
        monkeypatch.setattr(sys, name, stream)
    out = Output(False, 1)
    out.say("arm \ud800 机 ü")
    out.note("arm \ud800 机 ü")
    for buffer in raw.values():
        said = buffer.getvalue().decode(encoding)
        assert said.startswith("arm \\ud800 ")
        assert said.endswith("\n")


def test_a_reason_is_one_line_of_bounded_length():
    error = DocumentError("plan.json", "a\n  reason\t" + "x" * 10_000)
    assert str(error).startswith("plan.json: a reason x")
    assert len(str(error)) < 700


@pytest.mark.skipif(sys.platform == "win32", reason="needs a POSIX shell")
@pytest.mark.parametrize("closed", [">&-", "2>&-", "<&-", ">&- 2>&- <&-"])
def test_closed_streams_are_no_fault(closed):
    line = f'"{sys.executable}" -m rrnn_opt.cli.start robots --json {closed}'
    done = subprocess.run(
        ["sh", "-c", line], capture_output=True, text=True, check=False
    )
    assert done.returncode == 0, done.stderr
    assert "Traceback" not in done.stderr
    assert (">&-" in closed.split()) or json.loads(done.stdout)
