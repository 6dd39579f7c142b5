"""Four arms as URDFs: rods along their published dimensions, with the limits of their joints.

    python bench/plan/arms.py FOLDER
"""

import pathlib
import sys

import numpy as np

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parent.parent))
from rigid import origin, shifted, turned  # noqa: E402

PI = np.pi


def rod(start, end, radius):
    """A cylinder along the middle of a way: joints, where links meet, stay free."""
    start, end = np.array(start, float), np.array(end, float)
    along = end - start
    length = np.linalg.norm(along)
    if length < 1e-6:
        return ""
    z = along / length
    x = np.cross(z, [0, 0, 1.0]) if abs(z[2]) < 0.9 else np.cross(z, [0, 1.0, 0])
    x /= np.linalg.norm(x)
    m = np.eye(4)
    m[:3, :3] = np.column_stack([x, np.cross(z, x), z])
    m[:3, 3] = (start + end) / 2
    shape = f'<geometry><cylinder radius="{radius}" length="{0.5 * length:.12g}"/></geometry>'
    return f"<collision>{origin(m)}{shape}</collision>"


def arm(name, joints, end, base):
    """Joints: (where it stands behind the one before, kind, axis, limits); links get a rod to the next joint."""
    text = [f'<robot name="{name}">', f'<link name="base_link">{base}</link>']
    after = [j[0] for j in joints[1:]] + [end]
    for k, (place, kind, axis, (low, high), radius) in enumerate(joints):
        parent = "base_link" if k == 0 else f"link{k}"
        shape = rod((0, 0, 0), after[k][:3, 3], radius) if radius else ""
        text.append(f'<link name="link{k + 1}">{shape}</link>')
        text.append(
            f'<joint name="joint{k + 1}" type="{kind}"><parent link="{parent}"/><child link="link{k + 1}"/>{origin(place)}'
            f'<axis xyz="{axis}"/><limit lower="{low}" upper="{high}" effort="100" velocity="1"/></joint>'
        )
    text.append('<link name="tool0"/>')
    text.append(
        f'<joint name="end" type="fixed"><parent link="link{len(joints)}"/><child link="tool0"/>{origin(end)}</joint></robot>'
    )
    return "\n".join(text)


def standard(rows):
    """Denavit and Hartenberg's a, alpha, d, offset, limits and thickness: each joint turns about its z."""
    before, joints = np.eye(4), []
    for a, alpha, d, offset, limits, radius in rows:
        joints.append((before @ turned(2, offset), "revolute", "0 0 1", limits, radius))
        before = shifted(0, 0, d) @ shifted(a, 0, 0) @ turned(0, alpha)
    return joints, before


def modified(rows, flange):
    joints = []
    for a, alpha, d, limits, radius in rows:
        joints.append((shifted(a, 0, 0) @ turned(0, alpha) @ shifted(0, 0, d), "revolute", "0 0 1", limits, radius))
    return joints, flange


def arms():
    full, half = (-2 * PI, 2 * PI), PI / 2
    ur5e = standard(
        [
            (0, half, 0.1625, 0, full, 0.03),
            (-0.425, 0, 0, 0, full, 0.055),
            (-0.3922, 0, 0, 0, (-PI, PI), 0.05),
            (0, half, 0.1333, 0, full, 0.045),
            (0, -half, 0.0997, 0, full, 0.045),
            (0, 0, 0.0996, 0, full, 0.04),
        ]
    )
    fr3 = modified(
        [
            (0, 0, 0.333, (-2.7437, 2.7437), 0.0),
            (0, -half, 0, (-1.7837, 1.7837), 0.06),
            (0, half, 0.316, (-2.9007, 2.9007), 0.06),
            (0.0825, half, 0, (-3.0421, -0.1518), 0.055),
            (-0.0825, -half, 0.384, (-2.8065, 2.8065), 0.0),
            (0, half, 0, (0.5445, 4.5169), 0.05),
            (0.088, half, 0, (-3.0159, 3.0159), 0.045),
        ],
        shifted(0, 0, 0.107),
    )
    kr10 = standard(
        [
            (0.025, -half, 0.4, 0, (-2.96, 2.96), 0.08),
            (0.56, 0, 0, -half, (-1.74, 2.5), 0.07),
            (0.035, -half, 0, 0, (-2.6, 2.0), 0.06),
            (0, half, 0.515, 0, (-3.2, 3.2), 0.055),
            (0, -half, 0, 0, (-2.09, 2.09), 0.045),
            (0, 0, 0.08, 0, (-6.1, 6.1), 0.04),
        ]
    )
    down = turned(0, PI)
    scara = (
        [
            (shifted(0, 0, 0.77), "revolute", "0 0 1", (-2.3, 2.3), 0.06),
            (shifted(0.35, 0, 0), "revolute", "0 0 1", (-2.5, 2.5), 0.05),
            # the quill's end is below the arm, however far it is drawn in
            (shifted(0.3, 0, -0.12), "prismatic", "0 0 -1", (0.0, 0.2), 0.0),
            (np.eye(4), "revolute", "0 0 1", full, 0.03),
        ],
        shifted(0, 0, -0.05) @ down,
    )
    stand = {"ur5e": 0.08, "fr3": 0.24, "kr10": 0.25, "scara": 0.67}
    every = {"ur5e": ur5e, "fr3": fr3, "kr10": kr10, "scara": scara}
    return {
        name: arm(name, joints, end, rod((0, 0, 0.0), (0, 0, stand[name]), 0.07))
        for name, (joints, end) in every.items()
    }


if __name__ == "__main__":
    folder = pathlib.Path(sys.argv[1])
    folder.mkdir(parents=True, exist_ok=True)
    for name, text in arms().items():
        (folder / f"{name}.urdf").write_text(text)
