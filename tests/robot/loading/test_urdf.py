import numpy as np
import pytest

from rrnn_opt.errors import RobotError
from rrnn_opt.robot.loading.urdf import LARGEST, read_urdf

TWO = '<link name="a"/><link name="b"/>'
THREE = f'{TWO}<link name="c"/>'
BOMB = '<!DOCTYPE x [<!ENTITY a "aaaa"><!ENTITY b "&a;&a;&a;&a;">]>'


def _joint(name, kind, parent, child, inside=""):
    return (
        f'<joint name="{name}" type="{kind}"><parent link="{parent}"/>'
        f'<child link="{child}"/><axis xyz="0 0 1"/>'
        f'<limit lower="-1" upper="1" velocity="1" effort="1"/>{inside}</joint>'
    )


TURN = _joint("j", "revolute", "a", "b")


def _robot(*parts):
    return f"<robot>{''.join(parts)}</robot>"


def _shape(inside, origin=""):
    shape = f"<collision>{origin}<geometry>{inside}</geometry></collision>"
    return _robot(f'<link name="a">{shape}</link><link name="b"/>', TURN)


REFUSED = {
    "not well-formed XML": "<robot",
    "its root is <sdf>": "<sdf/>",
    "DOCTYPE or ENTITY": f"{BOMB}<robot>&b;{TWO}</robot>",
    "has no links": "<robot/>",
    "xacro": '<robot xmlns:xacro="http://www.ros.org/wiki/xacro"><xacro:a/></robot>',
    "several roots: a, b": _robot(TWO),
    "form a cycle": _robot(TWO, TURN, _joint("k", "fixed", "b", "a")),
    "two links are called 'a'": _robot(TWO, '<link name="a"/>', TURN),
    "two joints are called 'j'": _robot(THREE, TURN, _joint("j", "fixed", "b", "c")),
    "'b' has two parents": _robot(THREE, TURN, _joint("k", "fixed", "c", "b")),
    "a link that is not there": _robot(TWO, _joint("j", "fixed", "a", "z")),
    "is floating; only revolute": _robot(TWO, _joint("j", "floating", "a", "b")),
    "mimics 'm', not there": _robot(
        TWO, _joint("j", "revolute", "a", "b", '<mimic joint="m"/>')
    ),
    "missing or malformed: 'type'": _robot(TWO, '<joint name="j"/>'),
    "missing or malformed: not enough": _robot(
        TWO, '<joint name="j" type="fixed"><parent link="a"/></joint>'
    ),
    "is revolute but has no <limit>": _robot(TWO, TURN.replace("limit", "unlimited")),
    "'nan 0 0' must be 3 finite": _robot(
        TWO, _joint("j", "revolute", "a", "b", '<origin xyz="nan 0 0"/>')
    ),
    "'0 0 oo' must be|could not convert": _robot(TWO, TURN.replace("0 0 1", "0 0 oo")),
    "must be 1 finite": _shape('<sphere radius="inf"/>'),
    "must be 3 finite": _shape('<box size="1 2"/>'),
    "positive sizes": _shape('<box size="1 2 0"/>'),
}


@pytest.mark.parametrize("message", REFUSED)
def test_each_fault_has_its_sentence(message, tmp_path):
    path = tmp_path / "x.urdf"
    path.write_text(REFUSED[message])
    with pytest.raises(RobotError, match=message) as caught:
        read_urdf(path)
    assert str(path) in str(caught.value)
    assert "\n" not in str(caught.value)


def test_files_that_are_no_text_are_refused(tmp_path):
    with pytest.raises(RobotError, match="No such file"):
        read_urdf(tmp_path / "absent.urdf")
    with pytest.raises(RobotError, match="directory"):
        read_urdf(tmp_path)
    path = tmp_path / "wide.urdf"
    path.write_text(f"{BOMB}<robot/>", encoding="utf-16")
    with pytest.raises(RobotError, match="UTF-8"):
        read_urdf(path)
    with path.open("wb") as file:
        file.truncate(LARGEST + 1)
    with pytest.raises(RobotError, match="larger than"):
        read_urdf(path)


def test_a_cycle_beside_the_root_is_found(tmp_path):
    path = tmp_path / "x.urdf"
    loop = (_joint("k", "fixed", "b", "c"), _joint("l", "fixed", "c", "b"))
    path.write_text(_robot(THREE, *loop))
    with pytest.raises(RobotError, match="cycle"):
        read_urdf(path)


def test_structure_and_shapes_are_read(tmp_path):
    path = tmp_path / "x.urdf"
    origin = '<origin xyz="1 2 3" rpy="0 0 0.5"/>'
    path.write_text(_shape('<cylinder length="0.4" radius="0.1"/>', origin))
    urdf = read_urdf(path)
    assert urdf.name == "x"
    assert urdf.links == ("a", "b")
    assert urdf.joints == (("j", "a", "b"),)
    assert urdf.leaves == ["b"]
    (shape,) = urdf.collisions["a"]
    assert (shape.kind, shape.size) == ("cylinder", (0.1, 0.4))
    assert np.allclose([*shape.xyz, *shape.rpy], [1, 2, 3, 0, 0, 0.5])
