import casadi as ca
import numpy as np
import pinocchio as pin
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from rrnn_opt.errors import RobotError, RrnnError, ShapeError
from rrnn_opt.robot import Frame, JointTree, Kinematics, Limits, Robot
from rrnn_opt.robot.builtin import BUILTIN

TOLERANCE = 1e-12


@pytest.mark.parametrize("name", BUILTIN)
def test_built_in_robots_agree_with_pinocchio(name, oracle):
    robot = Robot.builtin(name)
    model = pin.buildModelFromXML(oracle.urdf_text(robot))
    kin = Kinematics(robot)
    for frame in robot.frames:
        both = [kin.pose(frame.name), kin.jacobian(frame.name, kind="pose")]
        evaluate = ca.Function("both", [kin.q], both)
        for q in oracle.postures(robot, 5):
            pose, jacobian = (np.array(v) for v in evaluate(q))
            want, columns = oracle.pin_pose_jacobian(
                model, oracle.values_by_name(robot, q), f"frame_{frame.name}"
            )
            assert np.abs(pose - want).max() <= TOLERANCE
            stacked = np.stack([columns[n] for n in robot.joint_names], axis=1)
            assert np.abs(jacobian - stacked).max() <= TOLERANCE


@st.composite
def trees(draw, largest=6):
    """A random tree, coupled at random, with one frame on every joint."""
    nj = draw(st.integers(1, largest))
    nv = draw(st.integers(1, nj))
    rng = np.random.default_rng(draw(st.integers(0, 2**32 - 1)))
    kinds = ("revolute", "prismatic", "continuous")
    types = tuple(draw(st.sampled_from(kinds)) for _ in range(nj))
    axes = rng.normal(size=(nj, 3))
    axes /= np.linalg.norm(axes, axis=1, keepdims=True)
    for k in range(0, nj, 2):
        axes[k] = np.eye(3)[rng.integers(3)] * rng.choice([-1.0, 1.0])
    poses = np.tile(np.eye(4), (nj + 1, 1, 1))
    poses[:, :3, :3] = [pin.rpy.rpyToMatrix(rng.uniform(-3, 3, 3)) for _ in poses]
    poses[:, :3, 3] = rng.uniform(-1, 1, (nj + 1, 3))
    tree = JointTree(
        parents=np.array([rng.integers(-1, k) if k else -1 for k in range(nj)]),
        types=types,
        placements=poses[:nj],
        axes=axes,
        source=np.r_[np.arange(nv), rng.integers(0, nv, nj - nv)],
        multiplier=np.r_[np.ones(nv), rng.uniform(-2, 2, nj - nv)],
        offset=np.r_[np.zeros(nv), rng.uniform(-1, 1, nj - nv)],
    )
    box = Limits(np.full(nv, -1.5), np.full(nv, 1.2), np.ones(nv), np.ones(nv))
    frames = tuple(Frame(f"f{k}", k, poses[nj]) for k in range(-1, nj))
    names = tuple(f"j{k}" for k in range(nv))
    return Robot("tree", names, tree, box, frames, f"f{nj - 1}")


def uncoupled(robot):
    """The same tree with one coordinate a joint, for the oracle."""
    nj = robot.tree.nj
    own = JointTree(
        robot.tree.parents,
        robot.tree.types,
        robot.tree.placements,
        robot.tree.axes,
        np.arange(nj),
        np.ones(nj),
        np.zeros(nj),
    )
    box = Limits(np.full(nj, -9.0), np.full(nj, 9.0), np.ones(nj), np.ones(nj))
    names = tuple(f"k{k}" for k in range(nj))
    return Robot("tree", names, own, box, robot.frames, robot.tip)


@settings(max_examples=60)
@given(robot=trees(), seed=st.integers(0, 2**16))
def test_random_coupled_trees_agree_with_pinocchio(robot, seed, oracle):
    free = uncoupled(robot)
    model = pin.buildModelFromXML(oracle.urdf_text(free))
    kin = Kinematics(robot)
    evaluate = ca.Function("f", [kin.q], [kin.pose(), kin.jacobian(kind="pose")])
    q = np.random.default_rng(seed).uniform(-1.5, 1.2, robot.nv)
    tree = robot.tree
    joint_values = tree.multiplier * q[tree.source] + tree.offset
    want, columns = oracle.pin_pose_jacobian(
        model, oracle.values_by_name(free, joint_values), f"frame_{robot.tip}"
    )
    expected = np.zeros((6, robot.nv))
    for k in range(tree.nj):
        expected[:, tree.source[k]] += tree.multiplier[k] * columns[f"k{k}"]
    pose, jacobian = (np.array(v) for v in evaluate(q))
    assert np.abs(pose - want).max() <= TOLERANCE
    assert np.abs(jacobian - expected).max() <= 4 * TOLERANCE


@settings(max_examples=10)
@given(robot=trees(), seed=st.integers(0, 2**16))
def test_jacobian_and_its_rate_are_derivatives(robot, seed):
    kin, qd = Kinematics(robot), ca.SX.sym("qd", robot.nv)
    position = ca.Function("p", [kin.q], [kin.position()])
    jacobian = ca.Function("J", [kin.q], [kin.jacobian(kind="pose")])
    rate = ca.Function("Jd", [kin.q, qd], [kin.jacobian_dot(None, qd, kind="pose")])
    rng = np.random.default_rng(seed)
    q, v, h = rng.uniform(-1, 1, robot.nv), rng.uniform(-1, 1, robot.nv), 1e-6
    columns = [
        (np.array(position(q + h * e)) - np.array(position(q - h * e))) / (2 * h)
        for e in np.eye(robot.nv)
    ]
    assert np.abs(np.hstack(columns) - np.array(jacobian(q))[:3]).max() < 1e-8
    forward, backward = np.array(jacobian(q + h * v)), np.array(jacobian(q - h * v))
    assert np.abs((forward - backward) / (2 * h) - np.array(rate(q, v))).max() < 1e-7


@pytest.mark.parametrize("name", BUILTIN)
def test_functions_agree_with_each_other(name, oracle):
    robot = Robot.builtin(name)
    kin = Kinematics(robot)
    functions = kin.functions()
    frames = ca.Function("frames", [kin.q], kin.joint_frames())
    for q in oracle.postures(robot, 3):
        value = {
            key: np.array(fn(q)) for key, fn in functions.items() if fn.n_in() == 1
        }
        poses = [np.array(pose) for pose in frames(q)]
        origins = np.stack([pose[:3, 3] for pose in poses], axis=1)
        assert np.array_equal(value["joint_origins"], origins)
        assert np.array_equal(value["pose"][:3, 3:], value["position"])
        assert np.array_equal(value["pose_jacobian"][:3], value["jacobian"])
        for i, sphere in enumerate(robot.spheres):
            carrier = np.eye(4) if sphere.joint == -1 else poses[sphere.joint]
            centre = carrier[:3, :3] @ sphere.center + carrier[:3, 3]
            assert np.abs(value["sphere_centres"][:, i] - centre).max() < 1e-14


def test_pa10_jacobian_is_the_derivative_exactly():
    kin = Kinematics(Robot.builtin("pa10"))
    automatic = ca.jacobian(kin.position(), kin.q)
    difference = ca.Function("d", [kin.q], [automatic - kin.jacobian()])
    rng = np.random.default_rng(1)
    for q in rng.uniform(-3, 3, (20, 7)):
        assert np.abs(np.array(difference(q))).max() < 1e-15 * 4


def test_graph_of_the_pa10_is_lean():
    functions = Kinematics(Robot.builtin("pa10")).functions()
    assert functions["position"].n_instructions() <= 100
    assert functions["jacobian"].n_instructions() <= 200


def test_manipulability_leaves_out_rows_that_cannot_move():
    planar, pa10 = (Kinematics(Robot.builtin(n)) for n in ("planar3", "pa10"))
    for kin, rows in ((planar, 2), (pa10, 3)):
        both = ca.Function("m", [kin.q], [kin.manipulability(), kin.jacobian()])
        q = np.linspace(0.3, 1.0, kin.robot.nv)
        measure, jacobian = (np.array(v) for v in both(q))
        singular = np.linalg.svd(jacobian[:rows], compute_uv=False)
        assert measure[0, 0] == pytest.approx(np.prod(singular), rel=1e-12)


def test_wrong_arguments_are_named():
    kin = Kinematics(Robot.builtin("planar3"))
    with pytest.raises(RobotError, match="no frame 'nowhere'"):
        kin.position("nowhere")
    with pytest.raises(RrnnError, match="kind"):
        kin.jacobian(kind="poses")
    with pytest.raises(ShapeError, match="qd"):
        kin.jacobian_dot(None, ca.SX.sym("qd", 2))


def test_a_robot_without_spheres_has_no_centres(oracle):
    model = pin.buildModelFromXML(oracle.urdf_text(Robot.builtin("planar3")))
    assert Kinematics(Robot.from_pinocchio(model)).sphere_centres().shape == (3, 0)
