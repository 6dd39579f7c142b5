"""Does the corrected URDF move as the corrected arm does, for others who read it?

    cargo build --release -p handeye-cli
    pip install yourdfpy pin
    python bench/urdf/run.py

A simulated cell whose arm is given as a URDF is calibrated. `corrected_arm.urdf`, read by yourdfpy and by Pinocchio, and
`corrected_arm.json`, computed here, must put the flange at the same place for 1000 joint vectors.
"""

import json
import pathlib
import subprocess
import sys
import tempfile

import numpy as np
import pinocchio
import yourdfpy

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parent.parent))
from rigid import origin, shifted, turned  # noqa: E402

ROOT = pathlib.Path(__file__).resolve().parent.parent.parent
PROGRAM = ROOT / "target/release/handeye"
VECTORS = 1000
AGREE = 1e-9


def behind(joint):
    """What follows the turn of a joint, in the standard convention; `beta` turns about y last."""
    return shifted(joint["a"], 0, joint["d"]) @ turned(0, joint["alpha"]) @ turned(1, joint.get("beta", 0.0))


def flange(arm, values):
    there = np.eye(4)
    for joint, value in zip(arm["joints"], values):
        there = there @ turned(2, joint["theta_offset"] + value) @ behind(joint)
    end = arm.get("last_link_from_flange")
    return there @ pose(end) if end else there


def pose(some):
    x, y, z, w = some["rotation_xyzw"]
    m = shifted(*some["translation_m"])
    m[:3, :3] = [
        [1 - 2 * (y * y + z * z), 2 * (x * y - z * w), 2 * (x * z + y * w)],
        [2 * (x * y + z * w), 1 - 2 * (x * x + z * z), 2 * (y * z - x * w)],
        [2 * (x * z - y * w), 2 * (y * z + x * w), 1 - 2 * (x * x + y * y)],
    ]
    return m


def urdf(arm):
    """The arm as a URDF: each joint turns about the z of its own frame."""
    text, before, n = '<robot name="arm"><link name="base_link"/>', np.eye(4), len(arm["joints"])
    names = ["base_link", *(f"link_{k + 1}" for k in range(n))]
    for k, joint in enumerate(arm["joints"]):
        text += f'<link name="{names[k + 1]}"/><joint name="joint_{k + 1}" type="revolute"><parent link="{names[k]}"/>'
        text += f'<child link="{names[k + 1]}"/>{origin(before @ turned(2, joint["theta_offset"]))}'
        text += '<axis xyz="0 0 1"/><limit lower="-6.3" upper="6.3" effort="1" velocity="1"/></joint>'
        before = behind(joint)
    text += f'<link name="tool0"/><joint name="end" type="fixed"><parent link="{names[-1]}"/><child link="tool0"/>'
    return text + f"{origin(before)}</joint></robot>"


def main():
    with tempfile.TemporaryDirectory() as folder:
        cell = pathlib.Path(folder) / "cell"
        subprocess.run([PROGRAM, "simulate", cell, "--arm", "--captures", "30", "-q"], check=True, stdout=subprocess.DEVNULL)
        given = json.loads((cell / "arm.json").read_text())
        (cell / "arm.urdf").write_text(urdf(given))
        manifest = (cell / "handeye.toml").read_text()
        manifest = manifest.replace('dh = "arm.json"', 'urdf = { file = "arm.urdf", base = "base_link", flange = "tool0" }')
        (cell / "handeye.toml").write_text(manifest)
        run = subprocess.run([PROGRAM, "calibrate", cell, "--out", cell / "out", "-q"], capture_output=True, text=True)
        written = sorted(path.name for path in (cell / "out").rglob("corrected*"))
        print("written:", *written)
        if "corrected_arm.urdf" not in written:
            sys.exit(run.stdout + run.stderr)
        file = next((cell / "out").rglob("corrected_arm.urdf"))
        corrected = json.loads(next((cell / "out").rglob("corrected_arm.json")).read_text())
        by_yourdfpy = yourdfpy.URDF.load(str(file), load_meshes=False, build_scene_graph=True)
        model = pinocchio.buildModelFromUrdf(str(file))
        data, tool = model.createData(), model.getFrameId("tool0")
    random = np.random.default_rng(1)
    worst, moved = [0.0, 0.0], 0.0
    for _ in range(VECTORS):
        q = random.uniform(-3.0, 3.0, len(given["joints"]))
        ours = flange(corrected, q)
        by_yourdfpy.update_cfg(q)
        pinocchio.framesForwardKinematics(model, data, q)
        theirs = by_yourdfpy.get_transform("tool0", "base_link"), data.oMf[tool].homogeneous
        worst = [max(w, np.abs(ours - other).max()) for w, other in zip(worst, theirs)]
        moved = max(moved, np.linalg.norm((ours - flange(given, q))[:3, 3]))
    print(f"{VECTORS} joint vectors: the corrected flange is up to {moved * 1e3:.2f} mm from the given one;")
    print(f"yourdfpy differs by {worst[0]:.1e}, Pinocchio by {worst[1]:.1e} (m, and of rotation matrices)")
    return 0 if max(worst) < AGREE else 1


if __name__ == "__main__":
    sys.exit(main())
