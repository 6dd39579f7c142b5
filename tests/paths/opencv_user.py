"""The path of a user of OpenCV: a script with cv2.calibrateHandEye, 55 images of a checkerboard, 55 poses of a UR.

The script runs as it is, then with one import changed; the images of a folder in the order of their names as text show
what each of the two reports; then the same images and poses go into handeye.calibrate, in memory.
"""

import json
import pathlib
import shutil
import subprocess
import sys
import time

import cv2
import numpy as np
from session import Truth, distance_in_sigmas, holds, run, work

import handeye

SCRIPT = (pathlib.Path(__file__).parent / "opencv_script.py").read_text()
COUNT = 55
BOARD = {"kind": "checkerboard", "columns": 9, "rows": 6, "square_mm": 30.0}
K = [[600.0, 0.0, 319.5], [0.0, 600.0, 199.5], [0.0, 0.0, 1.0]]


def changed(text, old, new):
    assert text.count(old) == 1, old
    return text.replace(old, new)


def user_folder(cell):
    """What the user has: images with plain numbers, and the lines of the pendant."""
    images = pathlib.Path("user/images")
    images.mkdir(parents=True)
    for number, path in enumerate(cell.images, 1):
        shutil.copy(path, images / f"img_{number}.png")
    rows = handeye.poses_to(cell.base_from_flange, "ur")
    np.savetxt("user/poses.txt", rows, fmt="%.6f")


def run_script(text):
    """What the script prints, and what it complains about."""
    pathlib.Path("script.py").write_text(text)
    done = subprocess.run([sys.executable, "script.py", "user"], capture_output=True, text=True)
    return done.stdout, done.stderr


def transform(printed):
    answer = json.loads(printed)
    matrix = np.eye(4)
    matrix[:3, :3], matrix[:3, 3] = answer["R"], answer["t"]
    return answer["images"], handeye.Pose("flange", "camera", matrix)


def main():
    start = time.time()
    folder = work()
    run("simulate", "cell", "--captures", COUNT, "--width", 640, "--height", 400, "--touches", 0, "--quiet")
    cell = Truth("cell")
    user_folder(cell)

    print("1. the script as it is, by cv2")
    count, by_cv2 = transform(run_script(SCRIPT)[0])
    mm, degrees = cell.off(by_cv2)
    holds(count == COUNT, f"cv2 finds the board in {count} of {COUNT} images")
    holds(mm < 1.0, f"off the truth by {mm:.3f} mm, {degrees:.4f} degrees")

    print("2. with `from handeye import cv2_compat as cv2`")
    ours = changed(SCRIPT, "import cv2\n", "from handeye import cv2_compat as cv2\n")
    printed, complaints = run_script(ours)
    count, by_handeye = transform(printed)
    apart = np.abs(by_cv2.matrix - by_handeye.matrix).max()
    holds(apart < 1e-8, f"the same answer as by cv2: the numbers differ by {apart:.1e} at most")
    mm, degrees = cell.off(by_handeye)
    holds(mm < 1.0 and degrees < 0.1, f"off the truth by {mm:.3f} mm, {degrees:.4f} degrees")
    holds(complaints == "", "no warning for good data", complaints)

    print("3. a mistake: img_10.png is read behind img_1.png")
    printed, complaints = run_script(changed(SCRIPT, ", key=number", ""))
    mm = 1e3 * np.linalg.norm(json.loads(printed)["t"] - cell.flange_from_camera.translation)
    holds(mm > 10.0 and complaints == "", f"cv2 returns an answer, off by {mm:.0f} mm, without a word")
    printed, complaints = run_script(changed(ours, ", key=number", ""))
    error = complaints.strip().splitlines()[-1] if complaints.strip() else ""
    holds(printed == "" and "order" in error, f"cv2_compat refuses it: {error}", printed + complaints)

    print("4. handeye.calibrate with the same images and poses, in memory")
    rows = np.loadtxt("user/poses.txt")
    images = [cv2.imread(f"user/images/img_{k}.png", cv2.IMREAD_GRAYSCALE) for k in range(1, COUNT + 1)]
    poses = handeye.poses_from(rows, "ur")
    calibration = handeye.calibrate(images, poses, setup="eye-in-hand", target=BOARD, intrinsics=K)
    print(f"  {calibration.verdict}: {'; '.join(calibration.reasons)}")
    result = calibration.to_dict()
    mm, degrees = cell.off(calibration.pose)
    far = distance_in_sigmas(result, cell)
    # 99.9 % of 6 degrees of freedom
    holds(far < 4.74, f"accepted; off by {mm:.3f} mm, {degrees:.4f} degrees: {far:.1f} sigma", str(calibration))
    limit = result["predicted_tre_mm"]["p95"]
    worst = float(np.percentile(cell.off_at_board_mm(calibration.pose), 95))
    holds(worst < limit, f"95 % of the board's corners are off by less than {worst:.2f} mm; predicted {limit:.2f} mm")
    between = (by_handeye.inverse() @ calibration.pose).translation
    mm = 1e3 * np.linalg.norm(between)
    holds(calibration.accepted and mm < 1.0, f"and the closed form of step 2 is {mm:.3f} mm away")
    print(f"path of an OpenCV user: {time.time() - start:.0f} s")
    del folder


if __name__ == "__main__":
    main()
