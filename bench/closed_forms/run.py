"""Closed forms of handeye beside OpenCV's: agreement and processor time on the same pose sets.

    pip install -r bench/closed_forms/requirements.txt
    python bench/closed_forms/run.py            writes bench/closed_forms.md

Pose sets are drawn with fixed seeds: an eye-in-hand robot that tilts by up to 35 degrees about any
horizontal axis and turns by up to 50 degrees about the vertical, with 0.05 degrees and 0.3 mm of
noise per axis on the target's pose.
"""

import pathlib
import statistics
import subprocess
import tempfile
import time

import cv2
import numpy as np

HERE = pathlib.Path(__file__).resolve().parent
ROOT = HERE.parent.parent
COUNTS = [15, 50, 200, 1000]
SETS = {15: 20, 50: 10, 200: 2, 1000: 1}

HAND_EYE = {
    "tsai-lenz": cv2.CALIB_HAND_EYE_TSAI,
    "park-martin": cv2.CALIB_HAND_EYE_PARK,
    "horaud-dornaika": cv2.CALIB_HAND_EYE_HORAUD,
    "andreff": cv2.CALIB_HAND_EYE_ANDREFF,
    "daniilidis": cv2.CALIB_HAND_EYE_DANIILIDIS,
}
ROBOT_WORLD = {
    "shah": cv2.CALIB_ROBOT_WORLD_HAND_EYE_SHAH,
    "li": cv2.CALIB_ROBOT_WORLD_HAND_EYE_LI,
}
# gigabytes of stacked equations over half a million motions
TOO_LARGE = {("andreff", 1000), ("daniilidis", 1000)}


def rotation(vector):
    return cv2.Rodrigues(np.asarray(vector, float))[0]


def draw(count, seed):
    """Rotations and translations of anchor_from_mount and camera_from_target, and the truth."""
    random = np.random.default_rng(seed)
    x = rotation(random.normal(size=3)), random.normal(size=3) * 0.1
    y = rotation(random.normal(size=3)), np.array([0.8, 0.1, 0.0])
    poses = []
    for _ in range(count):
        direction, tilt = random.uniform(0, 2 * np.pi), np.radians(35) * np.sqrt(random.uniform())
        spin = np.radians(random.uniform(-50, 50))
        tilted = rotation([tilt * np.cos(direction), tilt * np.sin(direction), 0])
        r_a = rotation([np.pi, 0, 0]) @ tilted @ rotation([0, 0, spin])
        t_a = np.array([0.6, 0.0, 0.5]) + random.uniform(-0.15, 0.15, 3)
        r, t = r_a @ x[0], r_a @ x[1] + t_a  # anchor_from_camera
        r_c, t_c = r.T @ y[0], r.T @ (y[1] - t)
        r_c = r_c @ rotation(np.radians(0.05) * random.normal(size=3))
        poses.append((r_a, t_a, r_c, t_c + 3e-4 * random.normal(size=3)))
    return poses, x


def opencv(method, poses):
    r_a, t_a, r_c, t_c = (list(part) for part in zip(*poses))
    if method in HAND_EYE:
        start = time.process_time()
        r, t = cv2.calibrateHandEye(r_a, t_a, r_c, t_c, method=HAND_EYE[method])
        return r, t.ravel(), time.process_time() - start
    # A X = Y B with A = anchor_from_mount, B = target_from_camera
    r_b = [r.T.copy() for r in r_c]
    t_b = [-r.T @ t for r, t in zip(r_c, t_c)]
    start = time.process_time()
    r, t, _, _ = cv2.calibrateRobotWorldHandEye(r_a, t_a, r_b, t_b, method=ROBOT_WORLD[method])
    return r, t.ravel(), time.process_time() - start


def opencv_time(method, poses):
    """Median milliseconds of processor time; the clock counts in nanoseconds."""
    once = opencv(method, poses)[2]
    repeats = int(np.clip(0.5 / max(once, 1e-4), 1, 300))
    return 1e3 * statistics.median(opencv(method, poses)[2] for _ in range(repeats))


def handeye(files):
    """Per file and method: (rotation, translation, milliseconds), or None where refused."""
    command = ["cargo", "run", "--release", "-q", "-p", "handeye", "--example", "closed_forms", "--"]
    output = subprocess.run(command + files, cwd=ROOT, check=True, capture_output=True, text=True)
    answers = {}
    for line in output.stdout.splitlines():
        file, method, cost, rest = line.split("\t")
        if cost == "refused":
            answers[file, method] = None
            continue
        numbers = np.array(rest.split(), float)
        answers[file, method] = numbers[:9].reshape(3, 3), numbers[9:], float(cost) / 1e3
    return answers


def degrees(r, s):
    return np.degrees(2 * np.arcsin(min(1.0, np.linalg.norm(r - s) / np.sqrt(8))))


def worst(pairs):
    """Largest rotation (deg) and translation (mm) between answers."""
    turn = max(degrees(r, s) for (r, _), (s, _) in pairs)
    return turn, max(1e3 * np.linalg.norm(t - u) for (_, t), (_, u) in pairs)


def main():
    cv2.setNumThreads(1)
    with tempfile.TemporaryDirectory() as folder:
        sets = {}
        for count in COUNTS:
            for seed in range(SETS[count]):
                poses, truth = draw(count, 1000 * count + seed)
                file = str(pathlib.Path(folder) / f"{count}-{seed}.txt")
                np.savetxt(file, [np.concatenate([np.ravel(p) for p in pose]) for pose in poses],
                           fmt="%.17e")
                sets[file] = count, poses, truth
        ours = handeye(list(sets))
    report(sets, ours)


def write_oracle(path):
    """Fifteen pairs and OpenCV's answers, for the tests of the crate."""
    poses, _ = draw(15, 1)
    numbers = lambda parts: " ".join(f"{x:.17e}" for part in parts for x in np.ravel(part))
    lines = [f"# OpenCV {cv2.__version__}; rotations by rows and translations (m): per pair",
             "# anchor_from_mount and camera_from_target, per method mount_from_camera"]
    lines += [f"pair {numbers(pose)}" for pose in poses]
    lines += [f"{m} {numbers(opencv(m, poses)[:2])}" for m in [*HAND_EYE, *ROBOT_WORLD]]
    pathlib.Path(path).write_text("\n".join(lines) + "\n")


def report(sets, ours):
    methods = list(dict.fromkeys(method for _, method in ours))
    lines = ["# Closed forms beside OpenCV " + cv2.__version__, "", (__doc__ or "").split("\n\n")[2].strip(), "",
             "Written by `bench/closed_forms/run.py`.", "",
             "## Largest difference between the answers (degrees / mm)", "",
             "| method | " + " | ".join(f"N = {n}" for n in COUNTS) + " |",
             "|---" * (len(COUNTS) + 1) + "|"]
    theirs = {}
    for method in [*HAND_EYE, *ROBOT_WORLD]:
        cells = []
        for count in COUNTS:
            if (method, count) in TOO_LARGE:
                cells.append("not run")
                continue
            pairs = []
            for file, (n, poses, _) in sets.items():
                if n == count:
                    theirs[file, method] = opencv(method, poses)
                    pairs.append((ours[file, method][:2], theirs[file, method][:2]))
            cells.append("{:.1e} / {:.1e}".format(*worst(pairs)))
        lines.append(f"| {method} | " + " | ".join(cells) + " |")
    lines += ["", "OpenCV's `andreff` and `daniilidis` stack gigabytes of equations at N = 1000.", "",
              "## Processor time of a call, one thread, median (ms): handeye / OpenCV", "",
              "| method | " + " | ".join(f"N = {n}" for n in COUNTS) + " |",
              "|---" * (len(COUNTS) + 1) + "|"]
    for method in methods:
        cells = []
        for count in COUNTS:
            files = [file for file, (n, _, _) in sets.items() if n == count]
            cell = f"{statistics.median(ours[file, method][2] for file in files):.4f}"
            if (method in HAND_EYE or method in ROBOT_WORLD) and (method, count) not in TOO_LARGE:
                slow = theirs[files[0], method][2] > 1.0
                other = 1e3 * theirs[files[0], method][2] if slow else opencv_time(method, sets[files[0]][1])
                cell += f" / {other:.3g}"
            cells.append(cell)
        lines.append(f"| {method} | " + " | ".join(cells) + " |")
    lines += ["", "## Median error against the truth (degrees / mm)", "",
              "| method | " + " | ".join(f"N = {n}" for n in COUNTS) + " |",
              "|---" * (len(COUNTS) + 1) + "|"]
    for method in methods:
        cells = []
        for count in COUNTS:
            errors = [worst([(ours[file, method][:2], truth)])
                      for file, (n, _, truth) in sets.items() if n == count]
            cells.append("{:.4f} / {:.3f}".format(*np.median(errors, axis=0)))
        lines.append(f"| {method} | " + " | ".join(cells) + " |")
    (ROOT / "bench" / "closed_forms.md").write_text("\n".join(lines) + "\n")
    print("\n".join(lines))


if __name__ == "__main__":
    main()
