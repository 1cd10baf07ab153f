"""Packages that are not defined to the bit keep the error that they state."""

from __future__ import annotations

import platform
import subprocess
from pathlib import Path

import pytest

from rrnn_opt.embedding import generate

FUSE = ["-O2", "-ffp-contract=fast"]


def fuses():
    """Flags that make this machine round a*b + c once; None where it cannot."""
    if platform.machine() == "aarch64":
        return FUSE
    info = Path("/proc/cpuinfo")
    return [*FUSE, "-mfma"] if info.exists() and " fma " in info.read_text() else None


def own_test(folder, out, *flags):
    sources = [*sorted(folder.glob("src/*.c")), folder / "test/test_host.c"]
    places = [f"-I{folder / part}" for part in ("include", "test")]
    call = ["gcc", "-std=c99", *flags, *places, *map(str, sources), "-lm", "-o", out]
    subprocess.run(call, check=True, capture_output=True)
    return subprocess.run([out], capture_output=True, text=True, check=False)


@pytest.mark.parametrize(
    "real", ["float", pytest.param("double", marks=pytest.mark.slow)]
)
def test_fused_and_library_builds_are_within_what_is_stated(networks, tmp_path, real):
    flags = fuses()
    if flags is None:
        pytest.skip("needs a processor with fused multiply-add")
    made = {
        kind: generate(networks["rows"], real=real, prefix=kind, **options)
        for kind, options in (
            ("exact", {}),
            ("fused", {"fused": True}),
            ("libm", {"trig": "libm"}),
        )
    }
    for kind in ("fused", "libm"):
        stated = made[kind].manifest["rounding"]["stated_error"]
        assert 0.0 < stated < 1e-3
        done = own_test(made[kind].write(tmp_path), tmp_path / f"{kind}.out", *flags)
        assert done.returncode == 0, done.stdout
    folder = made["exact"].write(tmp_path)
    plain = own_test(folder, tmp_path / "plain.out", "-O2", "-ffp-contract=off")
    assert plain.returncode == 0, plain.stdout
    # a build that was meant to be exact and is not is found by its own test
    assert own_test(folder, tmp_path / "other.out", *flags).returncode == 1
