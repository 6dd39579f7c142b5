#!/usr/bin/env python3
"""Rewrites the robot poses of a simulated cell in a maker's notation, by the maker's own formula.

    book/notation.py kuka CELL

The formulas are written out here once more, so that the pages about robots check the program's. Standard
library only.
"""

import csv
import math
import re
import sys
from pathlib import Path

deg = math.degrees


def matrix(x, y, z, w):
    return [
        [1 - 2 * (y * y + z * z), 2 * (x * y - z * w), 2 * (x * z + y * w)],
        [2 * (x * y + z * w), 1 - 2 * (x * x + z * z), 2 * (y * z - x * w)],
        [2 * (x * z - y * w), 2 * (y * z + x * w), 1 - 2 * (x * x + y * y)],
    ]


def zyx(r):
    """Angles about z, y, x with R = Rz Ry Rx."""
    about_y = math.asin(max(-1.0, min(1.0, -r[2][0])))
    return [deg(math.atan2(r[1][0], r[0][0])), deg(about_y), deg(math.atan2(r[2][1], r[2][2]))]


def xyz(r):
    """Angles about x, y, z with R = Rx Ry Rz."""
    about_y = math.asin(max(-1.0, min(1.0, r[0][2])))
    return [deg(math.atan2(-r[1][2], r[2][2])), deg(about_y), deg(math.atan2(-r[0][1], r[0][0]))]


def zyz(r):
    """Angles with R = Rz Ry Rz."""
    about_y = math.acos(max(-1.0, min(1.0, r[2][2])))
    return [deg(math.atan2(r[1][2], r[0][2])), deg(about_y), deg(math.atan2(r[2][1], -r[2][0]))]


def rotation_vector(x, y, z, w):
    sine = math.sqrt(x * x + y * y + z * z)
    factor = 2 * math.atan2(sine, w) / sine if sine else 2.0
    return [factor * v for v in (x, y, z)]


# names of the columns, metres or mm, and the numbers of a rotation
MAKERS = {
    "kuka": ("X Y Z A B C", 1e3, lambda q: zyx(matrix(*q))),
    "fanuc": ("X Y Z W P R", 1e3, lambda q: zyx(matrix(*q))[::-1]),
    "yaskawa": ("X Y Z Rx Ry Rz", 1e3, lambda q: zyx(matrix(*q))[::-1]),
    "denso": ("X Y Z RX RY RZ", 1e3, lambda q: zyx(matrix(*q))[::-1]),
    "euler-xyz-extrinsic": ("X Y Z A B C", 1e3, lambda q: zyx(matrix(*q))[::-1]),
    "staubli": ("x y z rx ry rz", 1e3, lambda q: xyz(matrix(*q))),
    "kawasaki": ("X Y Z O A T", 1e3, lambda q: zyz(matrix(*q))),
    "doosan": ("X Y Z A B C", 1e3, lambda q: zyz(matrix(*q))),
    "abb": ("x y z q1 q2 q3 q4", 1e3, lambda q: [q[3], q[0], q[1], q[2]]),
    "ur": ("x y z rx ry rz", 1.0, lambda q: rotation_vector(*q)),
    "ur-rpy": ("x y z roll pitch yaw", 1.0, lambda q: [math.radians(a) for a in zyx(matrix(*q))[::-1]]),
}


def main(notation, cell):
    names, unit, rotation = MAKERS[notation]
    poses = Path(cell, "robot.csv")
    with poses.open(newline="") as file:
        rows = list(csv.DictReader(file))
    lines = ["capture," + ",".join(names.split())]
    for row in rows:
        q = [float(row[name]) for name in ("qx", "qy", "qz", "qw")]
        numbers = [unit * float(row[name]) for name in "xyz"] + rotation(q)
        lines.append(",".join([row["capture"]] + [f"{n:.7f}" for n in numbers]))
    poses.write_text("\n".join(lines) + "\n")
    manifest = Path(cell, "handeye.toml")
    text = re.sub(r'notation = .*\n(length_unit = .*\n)?', f'notation = "{notation}"\n', manifest.read_text(), count=1)
    if notation.startswith("euler"):
        text = text.replace(f'notation = "{notation}"\n', f'notation = "{notation}"\nlength_unit = "mm"\n')
    manifest.write_text(text)


if __name__ == "__main__":
    main(*sys.argv[1:])
