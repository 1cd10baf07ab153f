"""C99 for a microcontroller, from a law, its network and one's own arm."""

import tempfile
from pathlib import Path

import rrnn_opt as rr

robot = rr.Robot.from_urdf(Path(__file__).with_name("planar_arm.urdf"), tip="tip")
kin = rr.Kinematics(robot)
form = rr.formulations.closed_loop(kin)
rule = rr.networks.LviPdnn(whiten=True)
package = rr.generate(
    rule(form), network=rule, kinematics=kin, prefix="arm", real="float"
)
folder = Path(package.write(tempfile.mkdtemp()))
print("written:", *sorted(p.name for p in folder.iterdir()))
print("claims:", *(c["id"] for c in package.manifest["claims"]))
