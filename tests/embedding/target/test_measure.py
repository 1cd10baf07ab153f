"""Costs on boards: the call graph's stack, constant counts, the manifest."""

import json

import pytest

import rrnn_opt as rr
from rrnn_opt.embedding import generate
from rrnn_opt.embedding.target.board import BOARDS
from rrnn_opt.embedding.target.measure import measure, measured
from rrnn_opt.embedding.target.stack import stack_bound
from rrnn_opt.errors import RrnnError
from tests.embedding.target.scenarios import arm

NODE = 'node: {{ title: "{0}" label: "{0}\\nx.c:1:1\\n{1} bytes ({2})" }}\n'
EDGE = 'edge: {{ sourcename: "{0}" targetname: "{1}" label: "x.c:2:2" }}\n'


def graph(frames, calls, kind="static"):
    nodes = [NODE.format(name, size, kind) for name, size in frames.items()]
    return "".join([*nodes, *(EDGE.format(*call) for call in calls)])


def test_the_stack_is_that_of_the_deepest_path():
    first = graph({"step": 100, "near": 10}, [("step", "near"), ("step", "far")])
    second = graph({"far": 20, "end": 7}, [("far", "end"), ("near", "memcpy")])
    found = stack_bound([first, second], "step")
    assert (found.bytes, found.library) == (127, {"memcpy"})
    assert stack_bound([second], "end").bytes == 7


@pytest.mark.parametrize(
    ("text", "says"),
    [
        (graph({"step": 1}, [("step", "step")]), "calls itself"),
        (graph({"step": 1, "a": 2}, [("step", "a"), ("a", "step")]), "calls itself"),
        (graph({"step": 1}, [], "dynamic"), "dynamic"),
        (graph({"other": 1}, []), "no function 'step'"),
    ],
)
def test_a_stack_without_a_bound_is_refused(text, says):
    with pytest.raises(RrnnError, match=says):
        stack_bound([text], "step")


@pytest.fixture(scope="module")
def package():
    form = rr.formulations.minimum_velocity(arm())
    return generate(rr.networks.LviPdnn(whiten=True)(form), prefix="arm")


@pytest.mark.slow
@pytest.mark.parametrize("name", BOARDS)
def test_the_shipped_default_stays_within_its_budget(package, name):
    """Whitened, monitor, input checks, fallback ready: 2000 instructions a step."""
    found = measure(package, BOARDS[name])
    least, most = found.network
    assert most - least <= 1
    assert most <= 2000
    assert found.exact is not None
    assert most < found.exact[0] <= found.exact[1] < 30_000
    assert found.image.flash <= 12_000
    assert found.image.ram <= 160
    assert found.stack.bytes <= 1_400
    assert found.stack.library <= {"memcpy", "memset"}


@pytest.mark.slow
def test_the_manifest_says_it_and_says_it_twice_alike(package, tmp_path):
    one, two = (measured(package, BOARDS["cortex-m4f"]) for _ in "ab")
    assert dict(one.files) == dict(two.files)
    said = json.loads(one.files["MANIFEST.json"])
    assert said["footprint"]["board"] == "cortex-m4f"
    assert said["footprint"]["instructions"]["max"] <= 2000
    assert said["files"] == package.manifest["files"]
    assert one.write(tmp_path).joinpath("MANIFEST.json").exists()
