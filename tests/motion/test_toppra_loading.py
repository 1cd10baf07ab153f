"""In processes of their own: what is loaded is seen by everybody in one."""

import subprocess
import sys

import pytest

RETIMED = """
import sys
from types import SimpleNamespace
import numpy as np
from rrnn_opt.motion import retime
one = np.ones(1)
limits = SimpleNamespace(lower=-3 * one, upper=3 * one, velocity=one, acceleration=one)
retime([[0.0], [1.0]], limits)
"""


def run(code):
    done = subprocess.run(
        [sys.executable, "-c", code], capture_output=True, text=True, check=False
    )
    assert done.returncode == 0, done.stderr
    return done.stdout


def test_retiming_loads_no_plotting_library_and_plots_are_as_usual_afterwards():
    code = """
print([m for m in sys.modules if m.startswith("matplotlib")])
import toppra.algorithm.algorithm as theirs
import matplotlib.pyplot as plt
assert theirs.plt.subplots is plt.subplots
import matplotlib
assert matplotlib.pyplot is plt and matplotlib.__version__
"""
    assert run(RETIMED + code).strip() == "[]"


@pytest.mark.slow
def test_toppra_may_be_the_first_to_plot():
    run(RETIMED + "import toppra.algorithm.algorithm as t; t.plt.figure; t.plt.close()")


@pytest.mark.slow
def test_what_is_loaded_already_is_left_alone():
    before = "import matplotlib.pyplot as plt\n"
    code = "import toppra.algorithm.algorithm as theirs; assert theirs.plt is plt"
    run(before + RETIMED + code)
