"""handeye's drop-in beside OpenCV itself: answers, times, and what each says of corrupted input.

    maturin build --release -m crates/handeye-py/Cargo.toml && pip install target/wheels/*.whl
    pip install -r bench/opencv/requirements.txt
    python bench/opencv/run.py [DATA]                  writes its section of BENCHMARK.md

DATA holds measured pose sets, for which the manifests lie in crates/handeye-cli/tests/real.
"""

import argparse
import pathlib
import statistics
import sys
import time
import warnings

import cv2
import numpy as np

import handeye
from handeye import cv2_compat

HERE = pathlib.Path(__file__).resolve().parent
ROOT = HERE.parent.parent
BENCHMARK = ROOT / "BENCHMARK.md"
BEGIN, END = "<!-- opencv:begin -->", "<!-- opencv:end -->"
MANIFESTS = ROOT / "crates/handeye-cli/tests/real"
sys.path.insert(0, str(ROOT / "crates/handeye-py/tests"))
from cell import HALF_TURN, X, about_one_axis, cell, parts, pose  # noqa: E402

COUNTS = (15, 50, 200, 1000)
# gigabytes of stacked equations over half a million motions
TOO_LARGE = {("ANDREFF", 1000), ("DANIILIDIS", 1000)}
# seconds of a call that is not repeated, and of all calls of the others
LONG, ENOUGH = 0.5, 0.3
HAND_EYE = ("TSAI", "PARK", "HORAUD", "ANDREFF", "DANIILIDIS")
METHODS = (*HAND_EYE, "SHAH", "LI")
SETTING = """The same arrays, as lists of one array each, go to `cv2` and to `handeye.cv2_compat`, in one run on one
thread. Times are the process's own processor time, medians, with all that is done to read the arrays."""


def call(module, name, robot, camera):
    """R_cam2gripper and t_cam2gripper (or R_gripper2cam and t_gripper2cam)."""
    if name in HAND_EYE:
        method = getattr(module, f"CALIB_HAND_EYE_{name}")
        return module.calibrateHandEye(*parts(robot), *parts(camera), method=method)
    method = getattr(module, f"CALIB_ROBOT_WORLD_HAND_EYE_{name}")
    given = (*parts(camera), *parts(np.linalg.inv(robot)))
    return module.calibrateRobotWorldHandEye(*given, method=method)[2:]


def milliseconds(module, name, robot, camera):
    if name in HAND_EYE:
        function, flag = module.calibrateHandEye, getattr(module, f"CALIB_HAND_EYE_{name}")
        given = (*parts(robot), *parts(camera))
    else:
        function = module.calibrateRobotWorldHandEye
        flag = getattr(module, f"CALIB_ROBOT_WORLD_HAND_EYE_{name}")
        given = (*parts(camera), *parts(np.linalg.inv(robot)))
    took = []
    while sum(took) < ENOUGH and len(took) < 200:
        begun = time.process_time()
        function(*given, method=flag)
        took.append(time.process_time() - begun)
        if took[0] > LONG:
            break
    return 1e3 * statistics.median(took)


def apart(ours, theirs):
    """Degrees and mm between two answers."""
    turn = cv2.Rodrigues(ours[0].T @ theirs[0])[0]
    return np.degrees(np.linalg.norm(turn)), 1e3 * np.linalg.norm(ours[1] - theirs[1])


def times():
    table = {}
    for count in COUNTS:
        robot, camera = cell(count, seed=count)
        for name in METHODS:
            ours = milliseconds(cv2_compat, name, robot, camera)
            theirs = None
            if (name, count) not in TOO_LARGE:
                theirs = milliseconds(cv2, name, robot, camera)
            table[name, count] = ours, theirs
    lines = [f"| method | {' | '.join(f'N = {count}' for count in COUNTS)} |", "|---" * 5 + "|"]
    for name in METHODS:
        cells = []
        for count in COUNTS:
            ours, theirs = table[name, count]
            told = "not run" if theirs is None else f"{theirs:.3g}, {theirs / ours:.0f}x"
            cells.append(f"{ours:.3f} ({told})")
        lines.append(f"| {name} | {' | '.join(cells)} |")
    best = [min(t for (n, c), (_, t) in table.items() if c == count and t) for count in COUNTS]
    shares = [max(table[n, c][0] for n in METHODS) / b for c, b in zip(COUNTS, best)]
    told = ", ".join(f"{s:.2f}" for s in shares)
    return lines, f"The slowest of handeye's over the fastest of OpenCV's: {told} (goal: 0.33)."


def corrupted():
    """Name, and pose sets that are wrong in some way, with the truth where there is one."""
    def changed(change, **how):
        robot, camera = cell(15, seed=1, **how)
        return change(robot, camera)

    def flipped(robot, camera):
        camera[4] = camera[4] @ np.diag([-1.0, -1.0, 1.0, 1.0])
        return robot, camera

    def a_nan(robot, camera):
        robot[3, 0, 3] = np.nan
        return robot, camera

    def mirrored(robot, camera):
        camera[:, :3, 2] *= -1
        return robot, camera

    def millimetres(robot, camera):
        camera[:, :3, 3] *= 1e3
        return robot, camera

    def euler(robot, camera):
        """Rotations about z, y, x read as about x, y, z."""
        for matrix in robot:
            r = matrix[:3, :3]
            b = -np.arcsin(np.clip(r[2, 0], -1, 1))
            c, a = np.arctan2(r[2, 1], r[2, 2]), np.arctan2(r[1, 0], r[0, 0])
            turns = [pose(w, [0, 0, 0]) for w in ([c, 0, 0], [0, b, 0], [0, 0, a])]
            matrix[:3, :3] = (turns[0] @ turns[1] @ turns[2])[:3, :3]
        return robot, camera

    def wild(robot, camera):
        random = np.random.default_rng(2)
        camera[7] = pose(random.normal(size=3), random.normal(size=3))
        return robot, camera

    return [
        ("one board of 15 flipped", *changed(flipped)),
        ("one pose of 15 wild", *changed(wild)),
        ("rotations about one axis", *about_one_axis()),
        ("translations only", *changed(lambda r, c: (_only_moved(r), _seen(_only_moved(r))))),
        ("camera turned by half a turn, no noise", *cell(15, noise=0.0, x=HALF_TURN, seed=1)),
        ("three poses", *cell(3, seed=4)),
        ("two poses", *cell(2, seed=4)),
        ("robot poses inverted", *changed(lambda r, c: (np.linalg.inv(r), c))),
        ("pictures one place late", *changed(lambda r, c: (r, np.roll(c, 1, axis=0)))),
        ("Euler angles in the wrong order", *changed(euler)),
        ("target in mm, robot in m", *changed(millimetres)),
        ("mirrored rotations", *changed(mirrored)),
        ("a NaN", *changed(a_nan)),
    ]


def _only_moved(robot):
    moved = robot.copy()
    moved[:, :3, :3] = robot[0, :3, :3]
    return moved


def _seen(robot):
    from cell import Y

    return np.linalg.inv(X) @ np.linalg.inv(robot) @ Y


def said(module, name, robot, camera, truth):
    """In a few words."""
    try:
        with warnings.catch_warnings(record=True) as told:
            warnings.simplefilter("always")
            r, t = call(module, name, robot, camera)
    except handeye.HandEyeError as error:  # which is a cv2.error as well
        return f"`{type(error).__name__}`: {str(error).split(';')[0].split(': read so')[0]}"
    except cv2.error as error:
        return "error: " + str(error).split("error: ")[-1].split("\n")[0][:60]
    if not (np.isfinite(r).all() and np.isfinite(t).all()):
        return "NaN"
    degrees, mm = apart((r, t), (truth[:3, :3], truth[:3, 3:]))
    warned = f", warns: {told[0].message}" if told else ""
    return f"{mm:.3g} mm, {degrees:.2g}° off{warned}"


def answers_to_corrupted():
    lines = ["| input | OpenCV, PARK | OpenCV, DANIILIDIS | handeye, PARK |", "|---|---|---|---|"]
    for name, robot, camera in corrupted():
        truth = HALF_TURN if "half a turn" in name else X
        cells = [
            said(module, method, robot, camera, truth)
            for module, method in [(cv2, "PARK"), (cv2, "DANIILIDIS"), (cv2_compat, "PARK")]
        ]
        lines.append(f"| {name} | {' | '.join(cells)} |")
    return lines


def real(data):
    """The poses of measured sets, those that handeye keeps, by both."""
    lines = ["| set | poses | largest difference, degrees / mm | handeye of all poses, PARK |", "|---|---|---|---|"]
    for manifest in sorted(MANIFESTS.glob("*.toml")):
        try:
            found = handeye.calibrate(manifest, root=data)
        except handeye.InputError as error:
            print(f"{manifest.stem}: {error}")
            continue
        captures = [c for c in found.captures if c["camera_from_target"] is not None]
        used = [c for c in captures if c["used"]]
        if len(used) < 3:
            continue
        robot, camera = matrices(used, found.setup)
        largest = [0.0, 0.0]
        for name in METHODS:
            theirs = call(cv2, name, robot, camera)
            try:
                with warnings.catch_warnings():
                    warnings.simplefilter("ignore")
                    ours = call(cv2_compat, name, robot, camera)
            except handeye.HandEyeError:
                continue
            largest = np.maximum(largest, apart(ours, theirs))
        told = first_words(cv2_compat, *matrices(captures, found.setup))
        lines.append(
            f"| {manifest.stem} | {len(used)} of {len(captures)} | {largest[0]:.0e} / {largest[1]:.0e} | {told} |"
        )
    return lines


def matrices(captures, setup):
    def of(key):
        return np.array([handeye.Pose.from_dict(c[key]).matrix for c in captures])

    robot = of("base_from_flange")
    return robot if setup == "eye-in-hand" else np.linalg.inv(robot), of("camera_from_target")


def first_words(module, robot, camera):
    try:
        with warnings.catch_warnings(record=True) as told:
            warnings.simplefilter("always")
            call(module, "PARK", robot, camera)
    except handeye.HandEyeError as error:
        return f"`{type(error).__name__}`: {str(error).split(';')[0]}"
    return f"answers, and warns: {str(told[0].message).split(';')[0]}" if told else "answers"


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("data", nargs="?", type=pathlib.Path, help="folder of measured pose sets")
    parser.add_argument("--dry", action="store_true", help="print only")
    args = parser.parse_args()
    table, shares = times()
    begun = time.process_time()
    text = ["## In place of OpenCV", "", SETTING, ""]
    text += [f"Written by `bench/opencv/run.py` with OpenCV {cv2.__version__}.", ""]
    text += ["handeye's milliseconds, and in brackets OpenCV's and how many times ours that is.", ""]
    text += [*table, "", shares, "", "### What each says of corrupted input", ""]
    text += ["15 poses with 0.05 degrees and 0.3 mm of noise, unless it says otherwise.", ""]
    text += answers_to_corrupted()
    if args.data:
        text += ["", "### Measured pose sets", ""]
        text += ["Differences are those of all seven methods, over the poses that `handeye calibrate` keeps;"]
        text += ["methods that handeye refuses there are not counted. The last column is the drop-in on all poses.", ""]
        text += real(args.data)
    whole = f"{BEGIN}\n" + "\n".join(text) + f"\n\n{END}"
    print(whole, f"\n{time.process_time() - begun:.0f} s", file=sys.stderr)
    if args.dry:
        return
    old = BENCHMARK.read_text()
    if BEGIN in old:
        old = old[: old.index(BEGIN)] + whole + old[old.index(END) + len(END) :]
    else:
        old = old.rstrip("\n") + "\n\n" + whole + "\n"
    BENCHMARK.write_text(old)


if __name__ == "__main__":
    main()
