"""What the three paths share: the program as a user calls it, a line for all that holds, and the truth of a simulation."""

import json
import os
import pathlib
import subprocess
import sys
import tempfile

import numpy as np

import handeye

# results say when they were made: in tests always at the same time
os.environ.setdefault("SOURCE_DATE_EPOCH", "1773480413")


def program():
    """The program: $HANDEYE, or what `pip install` put beside this Python."""
    beside = pathlib.Path(sys.executable).with_name("handeye")
    return os.environ.get("HANDEYE") or str(beside)


def work():
    """A folder to work in, as long as the returned object lives."""
    folder = tempfile.TemporaryDirectory(prefix="handeye-")
    os.chdir(folder.name)
    return folder


def run(*words, expected=0):
    """Runs `handeye WORDS`; what it printed. Another exit code than the expected one ends the path."""
    line = "handeye " + " ".join(map(str, words))
    print(f"$ {line}", flush=True)
    done = subprocess.run([program(), *map(str, words)], capture_output=True, text=True, stdin=subprocess.DEVNULL)
    if done.returncode != expected:
        print(done.stdout + done.stderr)
        sys.exit(f"FAILED: exit code {done.returncode}, expected {expected}: {line}")
    return done.stdout, done.stderr


def holds(condition, what, shown=""):
    """One line of the log; ends the path where it does not hold."""
    if not condition:
        print(shown)
        sys.exit(f"FAILED: {what}")
    print(f"  ok: {what}", flush=True)


def skipped(what, why):
    print(f"  SKIPPED: {what}: {why}", flush=True)


class Truth:
    """A simulated cell, eye-in-hand: its poses, its images, and the true pose of the camera."""

    def __init__(self, folder):
        folder = pathlib.Path(folder)
        truth = json.loads((folder / "truth.json").read_text())
        self.flange_from_camera = pose("flange", "camera", truth["mount_from_camera"])
        self.base_from_target = pose("base", "target", truth["anchor_from_target"])
        rows = np.genfromtxt(folder / "robot.csv", delimiter=",", skip_header=1)[:, 1:]
        self.base_from_flange = [handeye.Pose("base", "flange", translation=r[:3], rotation=r[3:]) for r in rows]
        self.images = sorted(folder.glob("images/*.png"))

    def off(self, flange_from_camera):
        """By how much a pose of the camera is off: mm and degrees."""
        error = self.flange_from_camera.inverse() @ flange_from_camera
        return 1e3 * np.linalg.norm(error.translation), np.degrees(np.linalg.norm(error.rotation_vector))

    def off_at_board_mm(self, flange_from_camera, columns=9, rows=6, square_m=0.030):
        """By how much the corners of the board that the camera saw are off in the flange, mm: one number a corner."""
        grid = np.mgrid[0:columns, 0:rows].reshape(2, -1) * square_m
        in_target = np.vstack([grid, np.zeros(grid.shape[1]), np.ones(grid.shape[1])])
        errors = []
        for robot in self.base_from_flange:
            camera_from_target = (robot @ self.flange_from_camera).inverse() @ self.base_from_target
            in_camera = camera_from_target.matrix @ in_target
            apart = (flange_from_camera.matrix - self.flange_from_camera.matrix) @ in_camera
            errors.extend(1e3 * np.linalg.norm(apart[:3], axis=0))
        return np.array(errors)


def pose(to, from_frame, table):
    return handeye.Pose(to, from_frame, translation=table["translation_m"], rotation=table["rotation_xyzw"])


def found_in(result):
    """A calibration.json, and the pose of the camera in it."""
    result = json.loads((pathlib.Path(result) / "calibration.json").read_text())
    return result, pose("flange", "camera", result["hand_eye"]["mount_from_camera"])


def distance_in_sigmas(result, truth):
    """The Mahalanobis distance of the truth from the result, by the covariance that the result states."""
    found = pose("flange", "camera", result["hand_eye"]["mount_from_camera"])
    error = found.inverse() @ truth.flange_from_camera
    vector = np.hstack([error.rotation_vector, error.translation])
    covariance = np.array(result["hand_eye"]["covariance"]["mount_from_camera"])
    return float(np.sqrt(vector @ np.linalg.solve(covariance, vector)))
