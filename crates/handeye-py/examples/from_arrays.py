"""From arrays of poses to a transform, with frames that are checked."""

import numpy as np

import handeye
from handeye import Pose


def main() -> None:
    random = np.random.default_rng(7)
    flange_from_camera = Pose("flange", "camera", rotation=[0.1, -0.2, 1.5], translation=[0.03, 0.05, 0.1])
    base_from_target = Pose("base", "target", rotation=[3.0, 0.1, 0.2], translation=[0.6, 0.1, 0.0])

    # what a robot would report, and a camera see: 0.05 degrees and 0.3 mm of noise
    robot, seen = [], []
    for _ in range(15):
        turn = random.uniform(-0.6, 0.6, 3)
        view = Pose("camera", "target", rotation=turn, translation=[*random.uniform(-0.08, 0.08, 2), 0.5])
        robot.append(base_from_target @ view.inverse() @ flange_from_camera.inverse())
        error = Pose(
            "target",
            "target",
            rotation=np.radians(0.05) * random.normal(size=3),
            translation=3e-4 * random.normal(size=3),
        )
        seen.append(view @ error)

    calibration = handeye.solve(robot, seen, setup="eye-in-hand")
    print(calibration)
    degrees, mm = calibration.sigma
    print("one sigma", degrees, "degrees", mm, "mm")

    # a point that the camera sees, in the robot's base: the frames must fit together
    base_from_camera = robot[0] @ calibration.pose
    print(base_from_camera.name, base_from_camera @ [0.0, 0.0, 0.5])
    try:
        calibration.pose @ robot[0]
    except handeye.InputError as error:
        print("refused:", error)

    off = flange_from_camera.inverse() @ calibration.pose
    assert np.linalg.norm(off.translation) < 1e-3
    calibration.save("result")


if __name__ == "__main__":
    main()
