"""A robot cell with known truth."""

import numpy as np

import handeye


def rotation(vector):
    return handeye.Pose("a", "b", rotation=np.asarray(vector, dtype=float)).rotation


def pose(vector, translation):
    matrix = np.eye(4)
    matrix[:3, :3] = rotation(vector)
    matrix[:3, 3] = translation
    return matrix


# flange_from_camera and base_from_target
X = pose([0.1, -0.2, 1.5], [0.03, 0.05, 0.1])
Y = pose([3.0, 0.1, 0.2], [0.6, 0.1, 0.0])
HALF_TURN = pose([np.pi, 0.0, 0.0], [0.03, 0.05, 0.1])


def seen(robot, x=X, y=Y):
    """Where the camera sees the target from each robot pose."""
    return np.linalg.inv(x) @ np.linalg.inv(robot) @ y


def cell(count=15, noise=1.0, seed=0, x=X):
    """base_from_flange and camera_from_target, with 0.05 degrees and 0.3 mm of noise."""
    random = np.random.default_rng(seed)
    robot, camera = [], []
    for _ in range(count):
        turn = [*random.uniform(-0.6, 0.6, 2), random.uniform(-0.9, 0.9)]
        view = pose(turn, [*random.uniform(-0.08, 0.08, 2), random.uniform(0.4, 0.6)])
        robot.append(Y @ np.linalg.inv(view) @ np.linalg.inv(x))
        error = pose(
            noise * np.radians(0.05) * random.normal(size=3), noise * 3e-4 * random.normal(size=3)
        )
        camera.append(view @ error)
    return np.array(robot), np.array(camera)


def about_one_axis(count=15, noise=1e-4):
    random = np.random.default_rng(5)
    robot = np.array([pose([0, 0, a], [0.1 * a, 0.2, 0.3]) for a in np.linspace(-1, 1, count)])
    errors = [pose(noise * random.normal(size=3), noise * random.normal(size=3)) for _ in robot]
    return robot, seen(robot) @ np.array(errors)


def parts(matrices):
    """Rotations and translations, as OpenCV takes them."""
    return list(matrices[:, :3, :3]), list(matrices[:, :3, 3].reshape(-1, 3, 1))
