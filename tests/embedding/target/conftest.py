"""What runs on a board needs a cross compiler and an emulator, and says which."""

import pytest

from rrnn_opt.embedding.target.board import missing


@pytest.fixture(autouse=True)
def _tools(request):
    if missing() and request.node.get_closest_marker("slow"):
        pytest.skip(f"needs apt install {' '.join(missing())}")
