"""Every network's package passes its own test on a board.

The number of instructions is constant but for a network that takes signs: the
three-way choice becomes branches.
"""

import pytest

from rrnn_opt.embedding import generate
from rrnn_opt.embedding.kernel import kernel
from rrnn_opt.embedding.target.board import BOARDS
from rrnn_opt.embedding.target.measure import measure
from tests.catalogue import accepted, label, rules, schemes


@pytest.mark.slow
@pytest.mark.parametrize("rule", rules(), ids=label)
def test_its_package_runs_on_a_board(rule):
    place = rules().index(rule)
    laws = accepted("planar3", rule, schemes()[place % 4 : place % 4 + 12])
    law = laws[place % len(laws)][1]
    package = generate(law, prefix="arm")
    least, most = measure(package, BOARDS["cortex-m4f"]).network
    if "sign" not in kernel(law).tape.operations:
        assert most - least <= 1
