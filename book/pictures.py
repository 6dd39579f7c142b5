#!/usr/bin/env python3
"""Makes the book's pictures: figures measured on simulated cells, and drawings.

    book/pictures.py            measure again (some minutes) and draw
    book/pictures.py --draw     draw from book/measured.json

Standard library only. The program is target/release/handeye, or $HANDEYE.
"""

import argparse
import json
import math
import os
import shutil
import statistics
import subprocess
import sys
import tempfile
import zlib
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path

BOOK = Path(__file__).resolve().parent
PICTURES = BOOK / "src" / "pictures"
MEASURED = BOOK / "measured.json"
PROGRAM = os.environ.get("HANDEYE", str(BOOK.parent / "target" / "release" / "handeye"))

# --- measuring ---------------------------------------------------------------------------------------

# where errors are judged: a box of 400 x 300 x 200 mm, 0.9 m before the camera (m)
BOX = [
    (x, y, z)
    for x in (-0.2, -0.1, 0.0, 0.1, 0.2)
    for y in (-0.15, 0.0, 0.15)
    for z in (0.8, 0.9, 1.0)
]


def matrix(q):
    x, y, z, w = q
    return [
        [1 - 2 * (y * y + z * z), 2 * (x * y - z * w), 2 * (x * z + y * w)],
        [2 * (x * y + z * w), 1 - 2 * (x * x + z * z), 2 * (y * z - x * w)],
        [2 * (x * z - y * w), 2 * (y * z + x * w), 1 - 2 * (x * x + y * y)],
    ]


def apply(pose, p):
    r, t = matrix(pose["rotation_xyzw"]), pose["translation_m"]
    return [sum(r[i][j] * p[j] for j in range(3)) + t[i] for i in range(3)]


def true_error(found, truth):
    """Root mean square (mm) over the box."""
    squares = [math.dist(apply(found, p), apply(truth, p)) ** 2 for p in BOX]
    return 1e3 * math.sqrt(statistics.fmean(squares))


def predicted_error(c):
    """The same from the covariance: trace of J C J^T with J = [-[p]x, I]."""
    total = 0.0
    for x, y, z in BOX:
        cross = [[0, -z, y], [z, 0, -x], [-y, x, 0]]
        j = [[-cross[i][k] for k in range(3)] + [float(i == k) for k in range(3)] for i in range(3)]
        total += sum(j[i][a] * c[a][b] * j[i][b] for i in range(3) for a in range(6) for b in range(6))
    return 1e3 * math.sqrt(total / len(BOX))


def one(options, seed):
    """A cell, calibrated: true and predicted error (mm), or None where it is not determined."""
    with tempfile.TemporaryDirectory() as folder:
        cell = Path(folder, "cell")
        command = [PROGRAM, "simulate", cell, "--no-images", "--quiet", "--seed", str(seed)]
        subprocess.run(command + [str(o) for o in options], check=True)
        run = subprocess.run(
            [PROGRAM, "calibrate", cell, "--json", "--quiet"], capture_output=True, encoding="utf-8"
        )
        found, truth = json.loads(run.stdout), json.loads((cell / "truth.json").read_text())
    answer = (found.get("hand_eye") or {}).get("mount_from_camera")
    if answer is None or found["hand_eye"]["covariance"]["mount_from_camera"] is None:
        return None
    shah = next((c for c in found["candidates"] if c["name"] == "closed-form-shah"), None)
    return {
        "verdict": found["verdict"],
        "true": true_error(answer, truth["mount_from_camera"]),
        "predicted": predicted_error(found["hand_eye"]["covariance"]["mount_from_camera"]),
        "shah": shah
        and true_error(shah["hand_eye"]["mount_from_camera"], truth["mount_from_camera"]),
    }


def series(values, options, seeds):
    """For every value, the results of all seeds."""
    jobs = [(v, s) for v in values for s in range(1, seeds + 1)]
    with ThreadPoolExecutor(max_workers=min(2, os.cpu_count() or 1)) as pool:
        results = list(pool.map(lambda job: one(options(job[0]), job[1]), jobs))
    return [
        {"value": v, "results": [r for (w, _), r in zip(jobs, results) if w == v]} for v in values
    ]


def measure():
    still = ["--touches", 0]
    many = lambda n: ["--captures", n]
    return {
        "captures": series([3, 4, 5, 6, 8, 10, 15, 20, 30, 45], lambda n: many(n) + still, 24),
        "tilt": series(
            [1, 2, 4, 7, 10, 15, 20, 30, 45], lambda d: many(15) + ["--tilt-deg", d] + still, 24
        ),
        "spin": series([0, 5, 15, 30, 60, 90, 180], lambda d: many(15) + ["--spin-deg", d] + still, 24),
        "robot": series(
            [0.05, 0.1, 0.2, 0.5, 1.0, 2.0],
            lambda mm: many(15) + ["--robot-mm", mm, "--robot-deg", round(mm * 0.06, 4)] + still,
            24,
        ),
        "touches": series(
            [0, 3, 4, 6, 9, 12, 24],
            lambda k: many(15) + ["--touches", k, "--setup", "eye-to-hand", "--placements", 3],
            24,
        ),
        "pixel": series(
            [0.02, 0.05, 0.1, 0.2, 0.5, 1.0], lambda px: many(15) + ["--corner-px", px] + still, 24
        ),
        "size": series(
            [5, 8, 12, 20, 30],
            lambda mm: many(15)
            + ["--square-mm", mm, "--robot-mm", 0.05, "--robot-deg", 0.003]
            + still,
            24,
        ),
        "scatter": series(
            [6, 8, 10, 15, 20, 30],
            lambda n: many(n)
            + ["--setup", "eye-to-hand" if n % 4 == 0 else "eye-in-hand"]
            + ["--robot-mm", {6: 0.1, 8: 1.0, 10: 0.2, 15: 1.5, 20: 0.05, 30: 0.5}[n]],
            40,
        ),
    }


# --- drawing -----------------------------------------------------------------------------------------

INK, PALE, GRID, PAPER = "#222831", "#5c6672", "#d9d6cc", "#fbfaf6"
BLUE, RED, GREEN, AMBER = "#1f6fb4", "#c0392b", "#2e8b57", "#b7791f"
FONT = "font-family='Helvetica, Arial, sans-serif'"


class Drawing:
    """Marks on a sheet of paper, readable on light and dark pages alike."""

    def __init__(self, width, height):
        self.width, self.height, self.marks = width, height, []

    def line(self, x1, y1, x2, y2, colour=INK, width=1.5, dash=None, arrow=False):
        extra = f" stroke-dasharray='{dash}'" if dash else ""
        self.marks.append(
            f"<line x1='{x1:.1f}' y1='{y1:.1f}' x2='{x2:.1f}' y2='{y2:.1f}' stroke='{colour}' "
            f"stroke-width='{width}' stroke-linecap='round'{extra}/>"
        )
        if arrow:
            a = math.atan2(y2 - y1, x2 - x1)
            tip = [(x2, y2)] + [
                (x2 - 9 * math.cos(a + s), y2 - 9 * math.sin(a + s)) for s in (0.4, -0.4)
            ]
            self.polygon(tip, colour, "none")

    def polygon(self, points, fill, stroke=INK, width=1.5, opacity=1):
        text = " ".join(f"{x:.1f},{y:.1f}" for x, y in points)
        self.marks.append(
            f"<polygon points='{text}' fill='{fill}' stroke='{stroke}' stroke-width='{width}' "
            f"stroke-linejoin='round' fill-opacity='{opacity}'/>"
        )

    def polyline(self, points, colour, width=2.2, dash=None):
        text = " ".join(f"{x:.1f},{y:.1f}" for x, y in points)
        extra = f" stroke-dasharray='{dash}'" if dash else ""
        self.marks.append(
            f"<polyline points='{text}' fill='none' stroke='{colour}' stroke-width='{width}' "
            f"stroke-linejoin='round'{extra}/>"
        )

    def dot(self, x, y, colour, r=3.5, opacity=1):
        self.marks.append(
            f"<circle cx='{x:.1f}' cy='{y:.1f}' r='{r}' fill='{colour}' fill-opacity='{opacity}'/>"
        )

    def text(self, x, y, text, size=14, colour=INK, anchor="start", weight="normal", turn=None):
        where = f" transform='rotate({turn} {x:.1f} {y:.1f})'" if turn is not None else ""
        text = text.replace("&", "&amp;").replace("<", "&lt;")
        self.marks.append(
            f"<text x='{x:.1f}' y='{y:.1f}' font-size='{size}' fill='{colour}' "
            f"text-anchor='{anchor}' font-weight='{weight}'{where}>{text}</text>"
        )

    def rectangle(self, x, y, w, h, fill, stroke=INK, width=1.5, r=0, turn=None):
        where = f" transform='rotate({turn[0]} {turn[1]} {turn[2]})'" if turn else ""
        self.marks.append(
            f"<rect x='{x:.1f}' y='{y:.1f}' width='{w:.1f}' height='{h:.1f}' rx='{r}' fill='{fill}' "
            f"stroke='{stroke}' stroke-width='{width}'{where}/>"
        )

    def save(self, name):
        text = (
            f"<svg xmlns='http://www.w3.org/2000/svg' viewBox='0 0 {self.width} {self.height}' "
            f"width='{self.width}' height='{self.height}' {FONT}>\n"
            f"<rect width='{self.width}' height='{self.height}' rx='8' fill='{PAPER}'/>\n"
            + "\n".join(self.marks)
            + "\n</svg>\n"
        )
        (PICTURES / f"{name}.svg").write_text(text, encoding="utf-8")


class Chart(Drawing):
    """Two axes; logarithmic ones have ticks where they are named."""

    def __init__(self, x, y, x_label, y_label, log=(True, True), width=640, height=400):
        super().__init__(width, height)
        self.log, self.frame = log, (70, 26, width - 24, height - 56)
        self.x, self.y = x, y
        left, top, right, bottom = self.frame
        for v in x:
            self.line(self.px(v), top, self.px(v), bottom, GRID, 1)
            self.text(self.px(v), bottom + 18, f"{v:g}", 13, PALE, "middle")
        for v in y:
            self.line(left, self.py(v), right, self.py(v), GRID, 1)
            self.text(left - 8, self.py(v) + 4.5, f"{v:g}", 13, PALE, "end")
        self.line(left, bottom, right, bottom, PALE)
        self.line(left, top, left, bottom, PALE)
        self.text((left + right) / 2, height - 14, x_label, 14, INK, "middle")
        self.text(20, (top + bottom) / 2, y_label, 14, INK, "middle", turn=-90)

    @staticmethod
    def along(v, ticks, log):
        f = math.log if log else float
        return (f(v) - f(ticks[0])) / (f(ticks[-1]) - f(ticks[0]))

    def px(self, v):
        return self.frame[0] + self.along(v, self.x, self.log[0]) * (self.frame[2] - self.frame[0])

    def py(self, v):
        return self.frame[3] - self.along(v, self.y, self.log[1]) * (self.frame[3] - self.frame[1])

    def band(self, points, colour):
        up = [(self.px(x), self.py(h)) for x, _, h in points]
        down = [(self.px(x), self.py(low)) for x, low, _ in reversed(points)]
        self.polygon(up + down, colour, "none", opacity=0.16)

    def curve(self, points, colour, dash=None, dots=True):
        at = [(self.px(x), self.py(y)) for x, y in points]
        self.polyline(at, colour, dash=dash)
        if dots:
            for x, y in at:
                self.dot(x, y, colour)

    def key(self, entries, x=None, y=None):
        x, y = x or self.frame[2] - 205, y or self.frame[1] + 16
        self.rectangle(x - 10, y - 14, 215, 22 * len(entries) + 6, PAPER, GRID, 1, 4)
        for k, (name, colour, dash) in enumerate(entries):
            self.line(x, y + 22 * k, x + 26, y + 22 * k, colour, 2.4, dash)
            self.text(x + 34, y + 22 * k + 4.5, name, 13)


def quantile(values, q):
    values = sorted(values)
    at = q * (len(values) - 1)
    k = int(at)
    return values[k] + (at - k) * (values[min(k + 1, len(values) - 1)] - values[k])


def rms(values):
    return math.sqrt(statistics.fmean(v * v for v in values))


def curves(name, rows, x, y, label, log=(True, True), shah=True, key=None):
    """Truth as a band and its root mean square, what was predicted, and the best known closed form."""
    clip = lambda v: min(max(v, y[0]), y[-1])
    chart = Chart(x, y, label, "error in the workspace, mm", log)
    rows = [(r["value"], [q for q in r["results"] if q]) for r in rows]
    rows = [(v, all_) for v, all_ in rows if len(all_) > 2]
    chart.band(
        [(v, clip(quantile([q["true"] for q in a], 0.1)), clip(quantile([q["true"] for q in a], 0.9)))
         for v, a in rows],
        BLUE,
    )
    if shah:
        with_shah = [(v, [q["shah"] for q in a if q["shah"]]) for v, a in rows]
        chart.curve([(v, clip(rms(a))) for v, a in with_shah if a], AMBER, "6 5", False)
    chart.curve([(v, clip(rms([q["predicted"] for q in a]))) for v, a in rows], RED, "2 5", False)
    chart.curve([(v, clip(rms([q["true"] for q in a]))) for v, a in rows], BLUE)
    entries = [("true error (band: 10 to 90 %)", BLUE, None), ("error that was predicted", RED, "2 5")]
    chart.key(entries + ([("closed form (shah)", AMBER, "6 5")] if shah else []), *(key or (None, None)))
    chart.save(name)


def scatter(rows):
    chart = Chart(
        [0.02, 0.05, 0.1, 0.2, 0.5, 1, 2],
        [0.01, 0.02, 0.05, 0.1, 0.2, 0.5, 1, 2, 5],
        "predicted error, mm",
        "true error, mm",
    )
    chart.line(chart.px(0.02), chart.py(0.02), chart.px(2), chart.py(2), RED, 2, "2 5")
    within = total = 0
    for row in rows:
        for r in filter(None, row["results"]):
            chart.dot(chart.px(r["predicted"]), chart.py(min(max(r["true"], 0.01), 5)), BLUE, 3, 0.55)
            total += 1
            within += r["true"] <= 2 * r["predicted"]
    chart.text(chart.px(0.4), chart.py(0.028), f"{total} simulated cells, a dot each", 13, PALE)
    chart.text(
        chart.px(0.4), chart.py(0.019), f"{100 * within / total:.0f} % below twice the prediction", 13, PALE
    )
    chart.text(chart.px(1.3), chart.py(1.62), "as predicted", 13, RED, "end")
    chart.save("scatter")


def robot(d, x, y, reach):
    """An arm of two links from a base; returns its flange and the direction that it looks in."""
    d.polygon([(x - 34, y), (x + 34, y), (x + 20, y - 26), (x - 20, y - 26)], "#cdd3d9")
    joints = [(x, y - 26), reach[0], reach[1], reach[2]]
    for a, b in zip(joints, joints[1:]):
        d.line(*a, *b, "#8a949e", 15)
    for a, b in zip(joints, joints[1:]):
        d.line(*a, *b, "#e8ebee", 11)
    for j in joints[:-1]:
        d.dot(*j, "#5c6672", 7)
    a = math.atan2(reach[2][1] - reach[1][1], reach[2][0] - reach[1][0])
    return reach[2], a


def camera(d, x, y, a, size=1.0):
    """A camera at x, y that looks in the direction a."""
    turn = lambda p: (
        x + size * (p[0] * math.cos(a) - p[1] * math.sin(a)),
        y + size * (p[0] * math.sin(a) + p[1] * math.cos(a)),
    )
    d.polygon([turn(p) for p in [(-16, -11), (8, -11), (8, 11), (-16, 11)]], BLUE)
    d.polygon([turn(p) for p in [(8, -6), (16, -9), (16, 9), (8, 6)]], "#7fb2dd")
    return lambda far, wide: d.polygon(
        [turn((16, 0)), turn((far, -wide)), turn((far, wide))], BLUE, "none", opacity=0.12
    )


def board(d, x, y, a, squares=6, side=13):
    """A board seen from its edge, slightly from above."""
    turn = lambda p: (
        x + p[0] * math.cos(a) - p[1] * math.sin(a),
        y + p[0] * math.sin(a) + p[1] * math.cos(a),
    )
    rows, flat = 4, 0.42
    for i in range(squares):
        for k in range(rows):
            x0, y0 = (i - squares / 2) * side, (k - rows / 2) * side * flat
            corners = [(x0, y0), (x0 + side, y0), (x0 + side, y0 + side * flat), (x0, y0 + side * flat)]
            skew = lambda p: (p[0] - 0.6 * p[1], p[1])
            d.polygon([turn(skew(c)) for c in corners], INK if (i + k) % 2 == 0 else "#ffffff", INK, 0.5)


def setups():
    d = Drawing(760, 372)
    d.text(190, 30, "eye-in-hand", 17, weight="bold", anchor="middle")
    d.text(570, 30, "eye-to-hand", 17, weight="bold", anchor="middle")
    d.line(380, 20, 380, 352, GRID, 1.5)
    for left in (20, 400):
        d.line(left, 330, left + 340, 330, PALE, 2)
    # the camera on the flange
    flange, _ = robot(d, 80, 330, [(72, 210), (165, 120), (235, 165)])
    camera(d, 262, 182, 1.3)(128, 40)
    d.line(*flange, 257, 170, INK, 4)
    board(d, 296, 314, 0.0, 7, 14)
    d.text(214, 148, "flange", 13, PALE)
    d.text(286, 176, "camera", 13, BLUE)
    d.text(286, 348, "target: lies still", 13, PALE, "middle")
    d.text(80, 348, "base", 13, PALE, "middle")
    d.text(190, 58, "mount = flange, anchor = base", 13, PALE, "middle")
    d.text(190, 77, "found: flange_from_camera", 14, RED, "middle", "bold")
    # the camera beside the robot
    flange, _ = robot(d, 470, 330, [(462, 215), (545, 140), (595, 195)])
    d.line(*flange, 606, 214, INK, 4)
    board(d, 612, 222, 0.25, 6, 12)
    d.line(705, 330, 705, 132, "#8a949e", 6)
    camera(d, 698, 122, 2.3)(150, 46)
    d.text(560, 182, "flange", 13, PALE, "end")
    d.text(690, 96, "camera: stands still", 13, BLUE, "middle")
    d.text(612, 258, "target: rides along", 13, PALE, "middle")
    d.text(470, 348, "base", 13, PALE, "middle")
    d.text(570, 58, "mount = base, anchor = flange", 13, PALE, "middle")
    d.text(540, 77, "found: base_from_camera", 14, RED, "middle", "bold")
    d.save("setups")


def loop():
    d = Drawing(760, 236)
    box = lambda x, y, t, c: (
        d.rectangle(x - 56, y - 20, 112, 40, "#ffffff", c, 2, 6),
        d.text(x, y + 5, t, 15, c, "middle", "bold"),
    )
    box(110, 190, "anchor", INK)
    box(110, 50, "mount", INK)
    box(650, 50, "camera", BLUE)
    box(650, 190, "target", INK)
    d.line(110, 168, 110, 74, GREEN, 2.5, arrow=True)
    d.text(124, 118, "A = anchor_from_mount", 14, GREEN)
    d.text(124, 136, "robot, measured", 12, PALE)
    d.line(168, 50, 590, 50, RED, 2.5, arrow=True)
    d.text(380, 38, "X = mount_from_camera", 14, RED, "middle", "bold")
    d.text(380, 68, "wanted, always the same", 12, PALE, "middle")
    d.line(168, 190, 590, 190, AMBER, 2.5, arrow=True)
    d.text(380, 178, "Y = anchor_from_target", 14, AMBER, "middle", "bold")
    d.text(380, 208, "unknown, always the same", 12, PALE, "middle")
    d.line(650, 168, 650, 74, GREEN, 2.5, arrow=True)
    d.text(636, 118, "B = target_from_camera", 14, GREEN, "end")
    d.text(636, 136, "picture, measured", 12, PALE, "end")
    d.text(380, 128, "A X = Y B", 22, INK, "middle", "bold")
    d.save("loop")


def poses():
    d = Drawing(760, 300)
    titles = [("tilt one way", 26), ("tilt the other way", 152), ("spin", 276), ("near and far", 400), ("to the sides", 522)]
    angles = [(-0.55, 0, 1.0, 0), (0.55, 0, 1.0, 0), (0, 1, 1.0, 0), (0, 0, 0.55, 0), (0, 0, 1.0, 1)]
    for (title, left), (tilt, spin, size, side) in zip(titles, angles):
        x = left + 70
        d.text(x, 30, title, 14, INK, "middle", "bold")
        cx, cy = x + 128 * math.sin(tilt), 228 - 140 * math.cos(tilt)
        if spin:
            camera(d, x, 75, math.pi / 2)(140, 44)
            arc = [(x + 30 * math.cos(t / 10), 110 + 9 * math.sin(t / 10)) for t in range(-2, 52)]
            d.polyline(arc, RED, 2.4)
            d.polygon([(arc[0][0] + 6, arc[0][1] - 7), (arc[0][0] - 7, arc[0][1] - 4), (arc[0][0] + 2, arc[0][1] + 7)], RED, "none")
        elif size < 1:
            camera(d, x - 28, 150, math.pi / 2 - 0.25)(72, 30)
            camera(d, x + 28, 62, math.pi / 2 + 0.1)(158, 34)
        elif side:
            camera(d, x - 34, 82, math.pi / 2 - 0.08)(150, 26)
            camera(d, x + 38, 82, math.pi / 2 + 0.02)(150, 26)
        else:
            camera(d, cx, cy, math.pi / 2 + tilt)(130, 36)
            d.line(x, 225, x, 90, PALE, 1, "4 4")
            d.text(x + 19 * (1 if tilt > 0 else -1), 112, "30°", 13, RED, "middle")
        board(d, x, 235, 0, 6, 15)
    d.text(698, 150, "and a second", 13, PALE, "middle")
    d.text(698, 168, "tilt axis: towards", 13, PALE, "middle")
    d.text(698, 186, "you and away", 13, PALE, "middle")
    d.text(380, 284, "The robot turns about two axes at least; without tilt one direction stays unknown.", 14, PALE, "middle")
    d.save("poses")


def pivot():
    d = Drawing(560, 300)
    d.line(60, 250, 500, 250, PALE, 2)
    point = (280, 236)
    d.polygon([(270, 250), (290, 250), point], "#cdd3d9")
    for k, a in enumerate((-0.95, -0.35, 0.3, 0.9)):
        colour = BLUE if k == 1 else "#8a949e"
        x, y = point[0] + 150 * math.sin(a), point[1] - 150 * math.cos(a)
        mid = (point[0] + 42 * math.sin(a), point[1] - 42 * math.cos(a))
        d.line(x, y, *mid, colour, 6)
        d.line(*mid, *point, colour, 2.4)
        n = (math.cos(a), math.sin(a))
        d.line(x - 30 * n[0], y - 30 * n[1], x + 30 * n[0], y + 30 * n[1], colour, 7)
    d.text(196, 66, "flange", 13, BLUE, "middle")
    d.text(300, 268, "one fixed point", 13, PALE)
    d.text(392, 50, "30° and more", 14, RED)
    d.text(392, 68, "between neighbours,", 13, PALE)
    d.text(392, 86, "in two planes", 13, PALE)
    d.save("pivot")


def touches():
    d = Drawing(640, 340)
    d.text(320, 28, "Touch the outermost inner corners, where two black squares meet", 15, INK, "middle", "bold")
    x0, y0, s, columns, rows = 150, 50, 34, 10, 7
    for i in range(columns):
        for k in range(rows):
            d.rectangle(x0 + i * s, y0 + k * s, s, s, INK if (i + k) % 2 == 0 else "#ffffff", INK, 0.6)
    wide, high = columns - 1, rows - 1
    for c, r, name, dx, dy in [(1, 1, "0", -1, -1), (wide, 1, str(wide - 1), 1, -1), (1, high, str((high - 1) * wide), -1, 1), (wide, high, str(high * wide - 1), 1, 1)]:
        x, y = x0 + c * s, y0 + r * s
        d.dot(x, y, PAPER, 10)
        d.dot(x, y, RED, 7)
        d.text(x + dx * 78, y + dy * 2 + 5, name, 17, RED, "middle", "bold")
        d.line(x + dx * 12, y, x + dx * 60, y, RED, 1.4)
    d.text(320, 320, f"A board of {wide} x {high} inner corners: id = row * {wide} + column", 14, PALE, "middle")
    d.save("touches")


def rows_of(png):
    """Rows of bytes of an RGB picture of 8 bits."""
    at, data = 8, b""
    while at < len(png):
        length, kind = int.from_bytes(png[at : at + 4], "big"), png[at + 4 : at + 8]
        body = png[at + 8 : at + 8 + length]
        if kind == b"IHDR":
            width, height, form = int.from_bytes(body[:4], "big"), int.from_bytes(body[4:8], "big"), body[8:]
        data += body if kind == b"IDAT" else b""
        at += length + 12
    if form != bytes([8, 2, 0, 0, 0]):
        sys.exit("a picture of another kind than RGB of 8 bits")
    data, wide = zlib.decompress(data), 3 * width
    before, rows = bytearray(wide), []
    for k in range(height):
        kind = data[k * (wide + 1)]
        row = bytearray(data[k * (wide + 1) + 1 : (k + 1) * (wide + 1)])
        for i in range(wide):
            a, b, c = (row[i - 3], before[i], before[i - 3]) if i >= 3 else (0, before[i], 0)
            near = [abs(b - c), abs(a - c), abs(a + b - 2 * c)]
            paeth = (a, b, c)[near.index(min(near))]
            row[i] = (row[i] + (0, a, b, (a + b) // 2, paeth)[kind]) & 255
        rows.append(row)
        before = row
    return rows


def png_of(rows):
    part = lambda kind, body: (
        len(body).to_bytes(4, "big") + kind + body + zlib.crc32(kind + body).to_bytes(4, "big")
    )
    size = (len(rows[0]) // 3).to_bytes(4, "big") + len(rows).to_bytes(4, "big")
    data = zlib.compress(b"".join(b"\0" + bytes(row) for row in rows), 9)
    head = b"\x89PNG\r\n\x1a\n" + part(b"IHDR", size + bytes([8, 2, 0, 0, 0]))
    return head + part(b"IDAT", data) + part(b"IEND", b"")


def found():
    """A picture of the tutorial with its corners, as `detect --draw` makes it, half as large."""
    with tempfile.TemporaryDirectory() as folder:
        run = lambda words: subprocess.run(
            [PROGRAM, *words.split()], cwd=folder, check=True, stdout=subprocess.DEVNULL
        )
        run("simulate cell --captures 4 --width 640 --height 400 --touches 0 --image-noise 0.5 --quiet")
        run("detect cell/images/004.png --target cell/handeye.toml --draw found --quiet")
        rows = rows_of(next(Path(folder, "found").glob("*.png")).read_bytes())
    half = []
    for up, down in zip(rows[::2], rows[1::2]):
        sums = [a + b for a, b in zip(up, down)]
        half.append(
            [(sums[6 * i + k] + sums[6 * i + 3 + k] + 2) // 4 for i in range(len(sums) // 6) for k in range(3)]
        )
    (PICTURES / "found.png").write_bytes(png_of(half))


def report():
    """The upper part of the tutorial's report."""
    browser = shutil.which("chromium") or shutil.which("google-chrome")
    if browser is None:
        return print("no chromium: report.png stays as it is")
    with tempfile.TemporaryDirectory() as folder:
        run = lambda words: subprocess.run(words, cwd=folder, check=True, capture_output=True)
        run([PROGRAM, *"simulate cell --captures 12 --width 640 --height 400 --touches 0 --quiet".split()])
        run([PROGRAM, *"calibrate cell --out result --quiet".split()])
        options = "--headless --no-sandbox --disable-gpu --hide-scrollbars --window-size=1000,790".split()
        run([browser, *options, "--screenshot=report.png", f"file://{folder}/result/report.html"])
        (PICTURES / "report.png").write_bytes(Path(folder, "report.png").read_bytes())


def draw(measured):
    PICTURES.mkdir(parents=True, exist_ok=True)
    mm = [0.1, 0.2, 0.5, 1, 2, 5]
    curves("captures", measured["captures"], [3, 4, 5, 6, 8, 10, 15, 20, 30, 45], mm + [10], "captures")
    curves("tilt", measured["tilt"], [1, 2, 4, 7, 10, 15, 20, 30, 45], [0.1, 0.2, 0.5, 1, 2, 5, 10, 20],
           "largest tilt, degrees")
    curves("spin", measured["spin"], [0, 30, 60, 90, 180], [0, 0.2, 0.4, 0.6, 0.8, 1], "largest spin, degrees",
           (False, False), True)
    curves("robot", measured["robot"], [0.05, 0.1, 0.2, 0.5, 1, 2], [0.02, 0.05, 0.1, 0.2, 0.5, 1, 2],
           "error of the robot, mm", key=(90, 45))
    curves("touches-number", measured["touches"], [0, 3, 6, 12, 24], [0, 0.1, 0.2, 0.3, 0.4, 0.5],
           "touches on each of three placements", (False, False), False)
    curves("pixel", measured["pixel"], [0.02, 0.05, 0.1, 0.2, 0.5, 1], [0.1, 0.2, 0.5, 1, 2],
           "error of a corner, px", key=(90, 45))
    # 9 x 6 corners 0.9 m away in a picture 1920 px wide, f = 1800 px: width of 10 squares
    size = [{**r, "value": round(100 * 10 * r["value"] * 1800 / 900 / 1920, 1)} for r in measured["size"]]
    curves("size", size, [5, 8, 12, 20, 32], [0.02, 0.05, 0.1, 0.2, 0.5, 1],
           "width of the board, % of the picture")
    scatter(measured["scatter"])
    found()
    report()
    for drawing in (setups, loop, poses, pivot, touches):
        drawing()


def main():
    parser = argparse.ArgumentParser(description=__doc__.split("\n\n")[0])
    parser.add_argument("--draw", action="store_true", help="draw from what was measured before")
    if not parser.parse_args().draw:
        measured = measure()
        for row in (r for rows in measured.values() for r in rows):
            for q in filter(None, row["results"]):
                q.update({k: round(v, 4) for k, v in q.items() if isinstance(v, float)})
        MEASURED.write_text(json.dumps(measured, separators=(",", ":")) + "\n")
    draw(json.loads(MEASURED.read_text()))


if __name__ == "__main__":
    sys.exit(main())
