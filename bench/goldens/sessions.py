"""Simulated folders, and the mistakes that are made in them on purpose."""

import csv
import random
import shutil
import subprocess

import poses

SETUPS = ["eye-in-hand", "eye-to-hand"]


def simulated(program, folder, options):
    done = subprocess.run([program, "simulate", str(folder), "-q", *options], capture_output=True, text=True)
    if done.returncode:
        raise SystemExit(f"simulate {' '.join(options)}: {done.stderr}")


class Table:
    """A CSV file that is changed in place."""

    def __init__(self, path):
        self.path = path
        with open(path, newline="") as file:
            self.head, *self.rows = csv.reader(file)

    def poses(self):
        return [([float(x) for x in row[-4:]], [float(x) for x in row[-7:-4]]) for row in self.rows]

    def put(self, some):
        self.rows = [row[:-7] + [repr(x) for x in (*pose[1], *pose[0])] for row, pose in zip(self.rows, some)]

    def write(self):
        with open(self.path, "w", newline="") as file:
            csv.writer(file, lineterminator="\n").writerows([self.head, *self.rows])


def of_robot(change):
    """A mistake in the robot's poses; `change(poses, random)` gives the new ones."""

    def made(folder, chance):
        table = Table(folder / "robot.csv")
        table.put(change(table.poses(), chance))
        table.write()

    return made


def of_manifest(*changes):
    def made(folder, _):
        path = folder / "handeye.toml"
        text = path.read_text()
        for old, new in changes:
            if old not in text:
                raise SystemExit(f"{path} has no {old}")
            text = text.replace(old, new)
        path.write_text(text)

    return made


def of_corners(change, share):
    """A mistake in the corner lists of some captures."""

    def made(folder, chance):
        files = sorted((folder / "corners").glob("[0-9]*.csv"))
        for path in chance.sample(files, max(1, int(share * len(files)))):
            table = Table(path)
            table.rows = change(table.rows, chance)
            table.write()

    return made


def both(one, other):
    def made(folder, chance):
        one(folder, chance)
        other(folder, chance)

    return made


def exchanged(some, chance):
    i, j = chance.sample(range(len(some)), 2)
    some[i], some[j] = some[j], some[i]
    return some


def stale(some, chance):
    k = chance.randrange(1, len(some))
    some[k] = some[k - 1]
    return some


def moved_from_the_middle(metres):
    def change(some, _):
        by = poses.from_vector([0.002, 0.0, 0.001], [metres, 0.0, 0.0])
        half = len(some) // 2
        return some[:half] + [poses.times(by, pose) for pose in some[half:]]

    return change


def slipping(metres):
    def change(some, _):
        last = len(some) - 1
        return [poses.times(pose, poses.from_vector([0.0] * 3, [0.0, metres * k / last, 0.0])) for k, pose in enumerate(some)]

    return change


def each(change):
    return lambda some, chance: [change(pose, chance) for pose in some]


def in_reverse_ids(rows, _):
    return [[row[0], *other[1:]] for row, other in zip(rows, reversed(rows))]


def scattered(rows, chance):
    return [[row[0], *(repr(float(x) + chance.gauss(0.0, 3.0)) for x in row[1:3])] for row in rows]


def shifted(rows, _):
    return [[row[0], repr(float(row[1]) + 6.0), repr(float(row[2]) - 4.0)] for row in rows]


def some_missing(rows, chance):
    return [row for row in rows if chance.random() < 0.7]


# of captures, within a file that is read rightly
SPOILT = {
    "none": lambda folder, chance: None,
    "exchanged": of_robot(exchanged),
    "stale": of_robot(stale),
    "one-late": of_robot(lambda some, _: some[:4] + some[3:-1]),
    "moved": of_robot(moved_from_the_middle(0.004)),
    "slipping": of_robot(slipping(0.002)),
    "scaled": of_robot(each(lambda pose, _: (pose[0], [1.004 * x for x in pose[1]]))),
    "noisy": of_robot(each(lambda pose, chance: poses.times(
        pose, poses.from_vector(poses.normal(chance, 0.001), poses.normal(chance, 0.002))))),
    "reversed-ids": of_corners(in_reverse_ids, 0.2),
    "scattered": of_corners(scattered, 0.2),
    "shifted": of_corners(shifted, 0.15),
    "missing": of_corners(some_missing, 0.6),
    "size": of_manifest(("square_mm = 30.0", "square_mm = 30.3")),
    "lens": of_manifest(("fx = 1800.0", "fx = 1809.0"), ("fy = 1800.0", "fy = 1809.0")),
    "centre": of_manifest(("cx = 959.5", "cx = 969.5")),
}
# of a whole file
MISREAD = {
    "none": lambda folder, chance: None,
    "inverted": of_robot(each(lambda pose, _: poses.inverse(pose))),
    "conjugate": of_robot(each(lambda pose, _: ([-x for x in pose[0][:3]] + pose[0][3:], pose[1]))),
    "wxyz": of_robot(each(lambda pose, _: (pose[0][3:] + pose[0][:3], pose[1]))),
    "millimetres": of_robot(each(lambda pose, _: (pose[0], [1e3 * x for x in pose[1]]))),
    "inches": of_robot(each(lambda pose, _: (pose[0], [x / 0.0254 for x in pose[1]]))),
    "backwards": of_robot(lambda some, _: some[::-1]),
    "one-off": of_robot(lambda some, _: some[1:] + some[:1]),
    "axes-exchanged": of_robot(each(lambda pose, _: (pose[0], [pose[1][1], pose[1][0], pose[1][2]]))),
    "frozen-rotation": of_robot(lambda some, _: [(some[0][0], pose[1]) for pose in some]),
    "centimetres-of-squares": of_manifest(("square_mm = 30.0", "square_mm = 3.0")),
    "doubled-squares": of_manifest(("square_mm = 30.0", "square_mm = 60.0")),
    "inches-of-squares": of_manifest(("square_mm = 30.0", "square_mm = 1.1811")),
    "board-turned": of_manifest(("columns = 9", "columns = 6"), ("rows = 6", "rows = 9")),
    "squares-for-corners": of_manifest(("columns = 9", "columns = 10"), ("rows = 6", "rows = 7")),
    "other-setup": lambda folder, chance: flipped(folder),
}


def flipped(folder):
    path = folder / "handeye.toml"
    text = path.read_text()
    one, other = (f'setup = "{setup}"' for setup in SETUPS)
    path.write_text(text.replace(one, other) if one in text else text.replace(other, one))


def spoilt(program, folder, seed):
    """A session of the usual board with corner lists; kind, setup, robot and touches follow from the seed."""
    chance = random.Random(seed)
    name = list(SPOILT)[seed % len(SPOILT)]
    setup = SETUPS[(seed // len(SPOILT)) % 2]
    robot = chance.choice([0.1, 0.3, 0.5, 1.5])
    touches = chance.choice([0, 0, 4])
    if setup == "eye-in-hand":
        touches *= 3
    captures = chance.randint(8, 22)
    simulated(program, folder, ["--setup", setup, "--seed", str(seed), "--captures", str(captures), "--no-images", "--touches",
                                str(touches), "--robot-mm", str(robot), "--robot-deg", str(round(0.06 * robot, 4))])
    SPOILT[name](folder, chance)
    return name


def misread(program, folder, seed):
    chance = random.Random(1000 + seed)
    name = list(MISREAD)[seed % len(MISREAD)]
    simulated(program, folder, ["--setup", SETUPS[(seed // len(MISREAD)) % 2], "--seed", str(seed), "--captures",
                                str(chance.randint(7, 15)), "--no-images", "--touches", str(chance.choice([0, 4]))])
    MISREAD[name](folder, chance)
    return name


SMALL = ["--width", "640", "--height", "400"]
# what else a cell can be: (name, options of `simulate`)
CELLS = {
    "usual": ["--no-images"],
    "exact": ["--no-images", "--exact"],
    "arm": ["--no-images", "--arm", "--captures", "25"],
    "arm-touched": ["--no-images", "--arm", "--captures", "30", "--touches", "12"],
    "systematic": ["--no-images", "--robot-systematic-mm", "0.8", "--robot-systematic-deg", "0.05", "--robot-mm", "0.1",
                   "--captures", "24"],
    "tip-off": ["--no-images", "--tip-mm", "2"],
    "print-long": ["--no-images", "--print-y-percent", "0.6", "--captures", "20"],
    "bent": ["--no-images", "--bow-mm", "1.5"],
    "few": ["--no-images", "--captures", "4", "--touches", "0"],
    "two": ["--no-images", "--captures", "2", "--touches", "0"],
    "flat": ["--no-images", "--tilt-deg", "1", "--spin-deg", "1"],
    "upright": ["--no-images", "--tilt-deg", "1", "--spin-deg", "90"],
    "charuco": ["--no-images", "--charuco", "12x9", "--square-mm", "25", "--marker-mm", "18"],
    "tag": ["--no-images", "--tag", "3", "--square-mm", "80", "--touches", "0"],
    "images": [*SMALL, "--captures", "9"],
    "charuco-images": ["--charuco", "8x6", "--square-mm", "30", "--width", "960", "--height", "600", "--captures", "8"],
    "scans": [*SMALL, "--scans", "--captures", "9"],
    "scans-ply": [*SMALL, "--scans", "--scan-format", "ply", "--captures", "8", "--touches", "0"],
    "scans-shifted": [*SMALL, "--scans", "--scan-shift-mm", "2", "--captures", "9"],
    "scans-tilted": [*SMALL, "--scans", "--scan-tilt-deg", "0.3", "--captures", "9"],
    "scans-scaled": [*SMALL, "--scans", "--scan-scale-percent", "0.5", "--captures", "9"],
    "black-step": [*SMALL, "--scans", "--black-step-mm", "0.8", "--captures", "9"],
    "ball": ["--sphere", "40", *SMALL, "--captures", "12"],
}


def cell(program, folder, seed):
    name = list(CELLS)[seed % len(CELLS)]
    setup = SETUPS[(seed // len(CELLS)) % 2]
    options = ["--setup", setup, "--seed", str(200 + seed), *CELLS[name]]
    if setup == "eye-to-hand" and "--touches" in options and "12" in options:
        options[options.index("--touches") + 1] = "4"
    shutil.rmtree(folder, ignore_errors=True)
    simulated(program, folder, options)
    return name
