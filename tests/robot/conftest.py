"""Oracles of the robot room: URDF texts written out, and pinocchio beside."""

import importlib.metadata
import xml.etree.ElementTree as ET
from pathlib import Path
from types import SimpleNamespace

import casadi as ca
import numpy as np
import pinocchio as pin
import pytest

from rrnn_opt.robot import Kinematics

KIND_LIMIT = '<limit lower="{}" upper="{}" velocity="{}" effort="1"/>'


def _floats(values):
    return " ".join(repr(float(value)) for value in values)


def _origin(pose):
    rpy = pin.rpy.matrixToRpy(np.array(pose[:3, :3]))
    return f'<origin xyz="{_floats(pose[:3, 3])}" rpy="{_floats(rpy)}"/>'


def _joint_xml(name, kind, ends, pose, inside=""):
    parent, child = ends
    return (
        f'<joint name="{name}" type="{kind}"><parent link="{parent}"/>'
        f'<child link="{child}"/>{_origin(pose)}{inside}</joint>'
    )


def urdf_text(robot):
    """A URDF of a robot whose every joint is a coordinate; frames are links."""
    tree, limits = robot.tree, robot.limits
    links, joints = ["root", *(f"body{k}" for k in range(tree.nj))], []
    for k, name in enumerate(robot.joint_names):
        ends = (links[int(tree.parents[k]) + 1], links[k + 1])
        limit = (limits.lower[k], limits.upper[k], limits.velocity[k])
        inside = f'<axis xyz="{_floats(tree.axes[k])}"/>'
        if tree.types[k] != "continuous":
            inside += KIND_LIMIT.format(*(repr(float(v)) for v in limit))
        joints.append(_joint_xml(name, tree.types[k], ends, tree.placements[k], inside))
    for frame in robot.frames:
        ends = (links[frame.joint + 1], f"frame_{frame.name}")
        joints.append(_joint_xml(f"to_{frame.name}", "fixed", ends, frame.placement))
        links.append(ends[1])
    bodies = "".join(f'<link name="{link}"/>' for link in links)
    return f'<robot name="{robot.name}">{bodies}{"".join(joints)}</robot>'


def values_by_name(robot, q):
    """Value of every coordinate by joint name."""
    return dict(zip(robot.joint_names, np.asarray(q), strict=True))


def _joints(model):
    return zip(list(model.names)[1:], list(model.joints)[1:], strict=True)


def pin_configuration(model, values):
    """Pinocchio's q (cos and sin for continuous joints) from values by name."""
    q = pin.neutral(model)
    for name, joint in _joints(model):
        value = values.get(name, 0.0)
        entry = [value] if joint.nq == 1 else [np.cos(value), np.sin(value)]
        q[joint.idx_q : joint.idx_q + joint.nq] = entry
    return q


def pin_pose_jacobian(model, values, frame):
    """Pose (4, 4) of a frame, and its Jacobian's column of every joint by name."""
    data = model.createData()
    q = pin_configuration(model, values)
    pin.framesForwardKinematics(model, data, q)
    index = model.getFrameId(frame, pin.FrameType.BODY)
    full = pin.computeFrameJacobian(
        model, data, q, index, pin.ReferenceFrame.LOCAL_WORLD_ALIGNED
    )
    full = full.reshape(6, model.nv)  # a model with nv = 1 gives a flat array
    columns = {
        name: full[:, joint.idx_v]
        for name, joint in zip(
            list(model.names)[1:], list(model.joints)[1:], strict=True
        )
    }
    return data.oMf[index].homogeneous, columns


def mimic_couplings(path):
    """(source, multiplier, offset) of the mimic joints of a URDF."""
    couplings = {}
    for joint in ET.parse(path).getroot().findall("joint"):
        mimic = joint.find("mimic")
        if mimic is not None:
            numbers = (
                float(mimic.get(k, d)) for k, d in (("multiplier", 1), ("offset", 0))
            )
            couplings[joint.get("name")] = (mimic.get("joint"), *numbers)
    return couplings


def postures(robot, count, seed=0):
    """Random postures in the joint box, pi beyond zero where it is open."""
    rng = np.random.default_rng(seed)
    lower = np.where(np.isfinite(robot.limits.lower), robot.limits.lower, -np.pi)
    upper = np.where(np.isfinite(robot.limits.upper), robot.limits.upper, np.pi)
    return rng.uniform(lower, upper, (count, robot.nv))


def pin_values(robot, q, couplings, locked):
    """Value of every joint of the file, mimic joints resolved one by one."""
    values = {**locked, **dict(zip(robot.joint_names, q, strict=True))}
    for _ in couplings:
        for name, (source, multiplier, offset) in couplings.items():
            if name not in locked:
                values[name] = multiplier * values.get(source, 0.0) + offset
    return values


def agrees(robot, path, *, locked=None, count=3):
    model = pin.buildModelFromUrdf(str(path))
    couplings = mimic_couplings(path)
    kin = Kinematics(robot)
    both = [kin.pose(), kin.jacobian(kind="pose")]
    evaluate = ca.Function("both", [kin.q], both)
    for q in postures(robot, count):
        values = pin_values(robot, q, couplings, locked or {})
        want, columns = pin_pose_jacobian(model, values, robot.tip)
        pose, jacobian = (np.array(value) for value in evaluate(q))
        assert np.abs(pose - want).max() <= 1e-12
        expected = np.stack([columns[name] for name in robot.joint_names], axis=1)
        for name, (source, multiplier, _) in couplings.items():
            if source in robot.joint_names and name not in robot.joint_names:
                i = robot.joint_names.index(source)
                expected[:, i] += multiplier * columns[name]
        assert np.abs(jacobian - expected).max() <= 1e-12


@pytest.fixture(scope="session")
def oracle():
    return SimpleNamespace(
        urdf_text=urdf_text,
        values_by_name=values_by_name,
        pin_pose_jacobian=pin_pose_jacobian,
        mimic_couplings=mimic_couplings,
        postures=postures,
        agrees=agrees,
        pin_values=pin_values,
        branched_text=BRANCHED,
    )


BRANCHED = """<robot name="branched">
<link name="base"><collision><geometry><box size="0.2 0.2 0.1"/></geometry></collision>
</link>
<link name="arm"><collision><origin xyz="0 0 0.25" rpy="0 0.3 0"/>
<geometry><cylinder radius="0.05" length="0.5"/></geometry></collision></link>
<link name="hand"><collision><geometry><sphere radius="0.06"/></geometry></collision>
</link>
<link name="finger"><collision><geometry><mesh filename="a.stl"/></geometry></collision>
</link>
<link name="thumb"/><link name="camera"/>
<joint name="turn" type="revolute"><parent link="base"/><child link="arm"/>
<origin xyz="0 0 0.1" rpy="0 0.2 0"/><axis xyz="0 1 1"/>
<limit lower="-2" upper="2" velocity="0" effort="1"/></joint>
<joint name="lift" type="prismatic"><parent link="arm"/><child link="hand"/>
<origin xyz="0.1 0 0.5" rpy="0.1 0 0"/><axis xyz="0 0 1"/>
<limit lower="0" upper="0.3" velocity="0.2" effort="1"/></joint>
<joint name="grip" type="revolute"><parent link="hand"/><child link="finger"/>
<origin xyz="0.02 0 0.1"/><axis xyz="1 0 0"/>
<limit lower="0" upper="1" velocity="1" effort="1"/></joint>
<joint name="oppose" type="revolute"><parent link="finger"/><child link="thumb"/>
<origin xyz="0 0 0.05"/><axis xyz="1 0 0"/>
<limit lower="-1" upper="1" velocity="1" effort="1"/>
<mimic joint="turn" multiplier="-0.5" offset="0.1"/></joint>
<joint name="pan" type="continuous"><parent link="base"/><child link="camera"/>
<origin xyz="0 0.1 0.2"/><axis xyz="0 0 1"/><limit velocity="20000" effort="1"/>
<mimic joint="grip" multiplier="2" offset="0.3"/></joint>
</robot>"""


@pytest.fixture
def branched(tmp_path):
    path = tmp_path / "branched.urdf"
    path.write_text(BRANCHED)
    return path


@pytest.fixture(scope="session")
def robots_folder():
    files = importlib.metadata.files("example-robot-data")
    panda = next(file for file in files if file.name == "panda.urdf")
    return Path(panda.locate()).resolve().parents[2]
