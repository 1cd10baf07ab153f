"""Every scheme, network and robot that goes together makes a package that passes."""

from __future__ import annotations

import subprocess

import pytest

from rrnn_opt.embedding import generate
from rrnn_opt.emit import find_compiler
from rrnn_opt.networks import LviPdnn, Znn
from tests.catalogue import (
    ROBOTS,
    Scheme,
    dynamics,
    kinematics,
    label,
    rules,
    schemes,
)


def pairs():
    """A covering sample: every scheme and every network at least once a robot.

    Networks take turns; where one refuses a scheme the next is tried.
    """
    found, turn = [], 0
    for robot in ROBOTS:
        for scheme in schemes():
            for ahead in range(len(rules())):
                rule = rules()[(turn + ahead) % len(rules())]
                if dynamics(robot, scheme, rule) is not None:
                    found.append((robot, scheme, rule))
                    turn += ahead + 1
                    break
    used = {(robot, label(rule)) for robot, _, rule in found}
    for robot in ROBOTS:
        for rule in rules():
            if (robot, label(rule)) not in used:
                fits = (s for s in schemes() if dynamics(robot, s, rule) is not None)
                found += [(robot, scheme, rule) for scheme in list(fits)[:1]]
    return found


def host_test(folder, name):
    """What a package's own test says; every warning is an error."""
    sources = [*sorted(folder.glob("src/*.c")), folder / "test/test_host.c"]
    flags = ["-std=c99", "-O1", "-ffp-contract=off", "-Wall", "-Wextra", "-Wpedantic"]
    flags += ["-Wconversion", "-Wshadow", "-Wdouble-promotion", "-Wmissing-prototypes"]
    flags += ["-Werror", *(f"-I{folder / part}" for part in ("include", "test"))]
    program = folder / name
    command = [*find_compiler().command, *flags, *map(str, sources), "-lm"]
    built = subprocess.run(
        [*command, "-o", program], capture_output=True, text=True, check=False
    )
    assert built.returncode == 0, built.stderr
    return subprocess.run([program], capture_output=True, text=True, check=False)


def passes(folder, robot, scheme, rule, real):
    law = dynamics(robot, scheme, rule)
    package = generate(
        law, network=rule, kinematics=kinematics(robot), real=real, prefix="arm"
    )
    done = host_test(package.write(folder), "test_host")
    assert done.returncode == 0, f"{robot} {scheme} {label(rule)}: {done.stdout}"


@pytest.mark.parametrize(
    ("robot", "name", "rule"),
    [("planar3", "method1", LviPdnn(whiten=True)), ("pa10", "method3", Znn())],
)
def test_two_pass_their_own_test(tmp_path, robot, name, rule):
    passes(tmp_path, robot, Scheme(name), rule, "float")


@pytest.mark.slow
@pytest.mark.parametrize("robot", ROBOTS)
def test_a_covering_sample_passes_its_own_test(tmp_path, robot):
    chosen = [case for case in pairs() if case[0] == robot]
    assert {str(s) for _, s, _ in chosen} == {str(s) for s in schemes()}
    assert {label(r) for _, _, r in chosen} == {label(r) for r in rules()}
    for k, (_, scheme, rule) in enumerate(chosen):
        real = ("float", "double")[k % 2]
        passes(tmp_path / str(k), robot, scheme, rule, real)
