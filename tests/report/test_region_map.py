"""Words on the picture of a region map."""

import pytest

from rrnn_opt.report.region_map import percent


@pytest.mark.parametrize(
    ("share", "told"),
    [(1.0, "100 %"), (0.999999, "99.99 %"), (0.48725, "48.72 %"), (0.0, "0 %")],
)
def test_a_share_is_never_rounded_up(share, told):
    assert percent(share) == told
