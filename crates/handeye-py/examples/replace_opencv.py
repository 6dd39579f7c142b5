"""A script that was written for OpenCV: one line of it changes."""

import numpy as np

# import cv2
from handeye import cv2_compat as cv2


def rotation(vector: "np.ndarray") -> "np.ndarray":
    angle = np.linalg.norm(vector)
    x, y, z = vector / angle
    k = np.array([[0, -z, y], [z, 0, -x], [-y, x, 0]])
    return np.eye(3) + np.sin(angle) * k + (1 - np.cos(angle)) * k @ k


def main() -> None:
    random = np.random.default_rng(3)
    r_x, t_x = rotation(np.array([0.1, -0.2, 1.5])), np.array([0.03, 0.05, 0.1])
    r_y, t_y = rotation(np.array([3.0, 0.1, 0.2])), np.array([0.6, 0.1, 0.0])
    R_gripper2base, t_gripper2base, R_target2cam, t_target2cam = [], [], [], []
    for _ in range(12):
        r, t = rotation(random.normal(size=3) * 0.5), np.array([*random.uniform(-0.1, 0.1, 2), 0.5])
        R_target2cam.append(r)
        t_target2cam.append(t.reshape(3, 1))
        R_gripper2base.append(r_y @ r.T @ r_x.T)
        t_gripper2base.append((t_y - r_y @ r.T @ (t + r_x.T @ t_x)).reshape(3, 1))

    R_cam2gripper, t_cam2gripper = cv2.calibrateHandEye(
        R_gripper2base, t_gripper2base, R_target2cam, t_target2cam, method=cv2.CALIB_HAND_EYE_PARK
    )
    print(R_cam2gripper, t_cam2gripper.T)
    assert np.allclose(R_cam2gripper, r_x) and np.allclose(t_cam2gripper[:, 0], t_x)

    # OpenCV would answer this with a transform that is decimetres off
    R_target2cam[4] = R_target2cam[4] @ np.diag([-1.0, -1.0, 1.0])
    try:
        cv2.calibrateHandEye(R_gripper2base, t_gripper2base, R_target2cam, t_target2cam)
    except ValueError as error:
        print("refused:", error)


if __name__ == "__main__":
    main()
