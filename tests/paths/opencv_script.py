"""What many have lying around: images of a checkerboard, poses of a UR, cv2.calibrateHandEye.

opencv_script.py FOLDER: images/img_1.png ... and poses.txt there, a line per image: x y z (m), rx ry rz (rotation
vector, rad). Prints the camera on the gripper as JSON. opencv_user.py runs it as it is, and with another import.
"""

import json
import pathlib
import sys

import cv2
import numpy as np

COLUMNS, ROWS, SQUARE = 9, 6, 0.030  # inner corners, m
K = np.array([[600.0, 0.0, 319.5], [0.0, 600.0, 199.5], [0.0, 0.0, 1.0]])
DIST = np.zeros(5)


def number(path):
    return int(path.stem.split("_")[1])


folder = pathlib.Path(sys.argv[1])
poses = np.loadtxt(folder / "poses.txt")
images = sorted(folder.glob("images/img_*.png"), key=number)
board = np.zeros((COLUMNS * ROWS, 3), np.float32)
board[:, :2] = np.mgrid[0:COLUMNS, 0:ROWS].T.reshape(-1, 2) * SQUARE

R_gripper2base, t_gripper2base, R_target2cam, t_target2cam = [], [], [], []
for path, (x, y, z, *rotvec) in zip(images, poses):
    gray = cv2.imread(str(path), cv2.IMREAD_GRAYSCALE)
    found, corners = cv2.findChessboardCorners(gray, (COLUMNS, ROWS))
    if not found:
        continue
    criteria = (cv2.TERM_CRITERIA_EPS + cv2.TERM_CRITERIA_MAX_ITER, 30, 0.001)
    corners = cv2.cornerSubPix(gray, corners, (5, 5), (-1, -1), criteria)
    _, rvec, tvec = cv2.solvePnP(board, corners, K, DIST)
    R_gripper2base.append(cv2.Rodrigues(np.array(rotvec))[0])
    t_gripper2base.append(np.array([x, y, z]))
    R_target2cam.append(cv2.Rodrigues(rvec)[0])
    t_target2cam.append(tvec)

R, t = cv2.calibrateHandEye(
    R_gripper2base, t_gripper2base, R_target2cam, t_target2cam, method=cv2.CALIB_HAND_EYE_PARK
)
print(json.dumps({"images": len(t_target2cam), "R": R.tolist(), "t": t.ravel().tolist()}))
