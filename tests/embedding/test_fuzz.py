"""Whatever the numbers are: a status, under address and undefined sanitizers."""

from __future__ import annotations

import subprocess

import pytest

import rrnn_opt as rr
from rrnn_opt.embedding import generate
from rrnn_opt.formulations.known_obstacles import row_bound, with_obstacles

FUZZ = r"""
#include <float.h>
#include <math.h>
#include <stdint.h>
#include <stdio.h>
#include <string.h>
#include "arm.h"

static uint64_t seed = 88172645463325252ULL;
static uint32_t draw(void)
{
    seed ^= seed << 13; seed ^= seed >> 7; seed ^= seed << 17;
    return (uint32_t)(seed >> 16);
}
static arm_real_t number(void)
{
    static const arm_real_t odd[] = {
        (arm_real_t)NAN, (arm_real_t)INFINITY, -(arm_real_t)INFINITY, LARGE, -LARGE,
        TINY, -TINY, SMALLEST, 0, -(arm_real_t)0.0, 1, 32768, -32769, 1073741824, 3e9F,
    };
    const arm_real_t plain = (arm_real_t)((int32_t)draw()) / (arm_real_t)1e9;
    arm_real_t any;
    uint8_t bytes[sizeof any];
    size_t i;
    switch (draw() % 8U) {
    case 0: return odd[draw() % (sizeof odd / sizeof odd[0])];
    case 1:
        for (i = 0; i < sizeof any; ++i) { bytes[i] = (uint8_t)draw(); }
        memcpy(&any, bytes, sizeof any);
        return any;
    default: return plain;
    }
}
static void fill(void *place, size_t count, int wild)
{
    arm_real_t *x = (arm_real_t *)place;
    size_t i;
    for (i = 0; i < count; ++i) {
        x[i] = wild ? number() : (arm_real_t)((int32_t)draw()) / (arm_real_t)2e9;
    }
}
#ifdef ARM_LONGEST_STEP
#define STEP (ARM_LONGEST_STEP / 2)
#else
#define STEP ((arm_real_t)0.001)
#endif
int main(void)
{
    unsigned long seen[10] = {0};
    int32_t k;
    for (k = 0; k < RUNS; ++k) {
        arm_param_t param = {STEP, (arm_real_t)0.01};
        arm_state_t state, before;
        arm_in_t in;
        arm_out_t out, told;
        arm_monitor_t monitor;
        arm_status_t status;
        size_t i;
        memset(&state, 0, sizeof state);
        memset(&out, 0, sizeof out);
        if (draw() % 4U == 0U) { fill(&param, 2, 1); }
        status = arm_init(&state, &param);
        seen[status]++;
        if (status != ARM_OK) { continue; }
        fill(&in, sizeof in / sizeof(arm_real_t), draw() % 2U == 0U);
        if (draw() % 4U == 0U) { fill(&state, ARM_N_STATE, 1); }
        before = state;
        told = out;
        seen[arm_monitor(&state, &in, &monitor)]++;
        if (memcmp(&before, &state, sizeof state) != 0) { return 2; }
        status = arm_step(&state, &in, &out);
        seen[status]++;
        if (status != ARM_OK) {
            if (memcmp(&before, &state, sizeof state) != 0) { return 3; }
            if (memcmp(&told, &out, sizeof out) != 0) { return 4; }
        } else {
            for (i = 0; i < ARM_N_OUTPUT; ++i) {
                if (!isfinite(out.output[i])) { return 5; }
            }
        }
    }
    for (k = 0; k < 10; ++k) { printf("%lu ", seen[k]); }
    printf("\n");
    return (arm_selftest() == 0U) ? 0 : 6;
}
"""
LIMITS = {
    "float": ["-DLARGE=FLT_MAX", "-DTINY=FLT_MIN", "-DSMALLEST=1e-45F"],
    "double": ["-DLARGE=DBL_MAX", "-DTINY=DBL_MIN", "-DSMALLEST=5e-324"],
}
SANITIZE = ["-g", "-fsanitize=address,undefined,float-cast-overflow"]
SANITIZE += ["-fno-sanitize-recover=all"]


def law(name):
    kin = rr.Kinematics(rr.Robot.builtin("planar3"))
    if name == "regulation":
        return rr.networks.PrimalDual()(rr.formulations.position_feedback(kin)), {}
    rule = rr.networks.LviPdnn(whiten=True)
    wanted = {"points": [3, len(kin.robot.spheres) - 1], "obstacles": 2}
    form = with_obstacles(rr.formulations.slack_task(kin), kin, **wanted)
    given = {"network": rule, "kinematics": kin}
    return rule(form), given | {"row_norm": row_bound(kin, **wanted)}


CASES = [("obstacles", "double", 3)]
CASES += [
    pytest.param(*case, marks=pytest.mark.slow)
    for case in [
        ("regulation", "float", 1),
        ("regulation", "double", 3),
        ("obstacles", "float", 1),
        ("obstacles", "float", 3),
    ]
]


@pytest.mark.parametrize(("name", "real", "steps"), CASES)
def test_any_numbers_give_a_status(tmp_path, name, real, steps):
    dynamics, given = law(name)
    folder = generate(dynamics, real=real, steps=steps, **given).write(tmp_path)
    (tmp_path / "fuzz.c").write_text(FUZZ)
    sources = [tmp_path / "fuzz.c", *sorted(folder.glob("src/*.c"))]
    call = ["gcc", "-std=c99", "-O1", "-ffp-contract=off", *SANITIZE, *LIMITS[real]]
    call += ["-DRUNS=20000", f"-I{folder / 'include'}", *map(str, sources)]
    done = subprocess.run(
        [*call, "-lm", "-o", tmp_path / "fuzz"],
        capture_output=True,
        text=True,
        check=False,
    )
    if "cannot find" in done.stderr:
        pytest.skip("needs libasan and libubsan (Debian: gcc)")
    assert done.returncode == 0, done.stderr
    run = subprocess.run(
        [tmp_path / "fuzz"], capture_output=True, text=True, check=False, timeout=60
    )
    assert run.returncode == 0, run.stdout + run.stderr
    seen = [int(word) for word in run.stdout.split()]
    assert sum(seen) > 30_000
    wanted = {0, 1, 2, 3, 4, 5, 7} | ({6} if "network" in given else set())
    assert wanted <= {k for k, count in enumerate(seen) if count}
