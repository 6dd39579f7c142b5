"""Inputs of `handeye register`: terrains seen twice, surfaces that leave motions free, a bracket and its scan."""

import math
import random
import struct

import poses

METHODS = ["auto", "point-to-plane", "gicp", "point-to-point"]
NOISE = 1e-4


def terrain(x, y):
    return 0.8 + 0.03 * math.sin(14 * x + 1) * math.cos(11 * y) + 0.02 * math.sin(31 * x * y + 9 * y) + (0.025 if 0.02 < x < 0.07 and -0.04 < y < 0.03 else 0.0)


def plane(_x, _y):
    return 0.8


def ridge(x, _y):
    return 0.8 + 0.03 * math.sin(25 * x)


def bowl(x, y):
    return 0.6 + math.sqrt(0.09 - x * x - y * y)


def grid(surface, chance, rows=90, columns=120, pose=None):
    """Points in rows and columns, moved by a pose."""
    points = []
    dx, dy = chance.uniform(-1, 1) * 1e-3, chance.uniform(-1, 1) * 1e-3
    for row in range(rows):
        for column in range(columns):
            x, y = 2e-3 * (column - columns / 2) + dx, 2e-3 * (row - rows / 2) + dy
            point = [x, y, surface(x, y) + chance.gauss(0.0, NOISE)]
            points.append(poses.moved(pose, point) if pose else point)
    return points


def write_npy(path, points, shape):
    head = str({"descr": "<f4", "fortran_order": False, "shape": (*shape, 3)}).encode()
    head += b" " * (63 - (len(head) + 10) % 64) + b"\n"
    with open(path, "wb") as file:
        file.write(b"\x93NUMPY\x01\x00" + struct.pack("<H", len(head)) + head)
        file.write(struct.pack(f"<{3 * len(points)}f", *(x for p in points for x in p)))


def write_xyz(path, points):
    path.write_text("".join(f"{p[0]:.7f} {p[1]:.7f} {p[2]:.7f}\n" for p in points))


def two_scans(surface, folder, seed):
    chance = random.Random(f"{surface.__name__}-{seed}")
    far = 0.5 if seed % 3 else 2.0
    by = poses.from_vector(poses.normal(chance, 0.02 * far), poses.normal(chance, 0.006 * far))
    files = []
    for number, pose in enumerate([by, None]):
        points = grid(surface, chance, pose=pose)
        if seed % 2:
            files.append(folder / f"{number}.xyz")
            write_xyz(files[-1], points)
        else:
            files.append(folder / f"{number}.npy")
            write_npy(files[-1], points, (90, 120))
    return [*files, "--length-unit", "m", "--method", METHODS[seed % len(METHODS)]]


def bracket(chance):
    """Boxes (low, high), m, that make an angle with a block on it."""
    a, b, h, t = (chance.uniform(*r) for r in ((0.06, 0.1), (0.03, 0.05), (0.03, 0.06), (0.006, 0.012)))
    return [([0.0, 0.0, 0.0], [a, b, t]), ([0.0, 0.0, t], [t, b, h]), ([0.5 * a, 0.1 * b, t], [0.75 * a, 0.5 * b, t + 0.3 * h])]


def sides(box):
    """Corner, two edges, and normal of each side."""
    low, high = box
    for axis in range(3):
        u, v = (axis + 1) % 3, (axis + 2) % 3
        eu, ev = ([high[k] - low[k] if k == w else 0.0 for k in range(3)] for w in (u, v))
        for end, sign in ((low, -1.0), (high, 1.0)):
            corner = [end[k] if k == axis else low[k] for k in range(3)]
            yield corner, eu, ev, [sign if k == axis else 0.0 for k in range(3)]


def write_stl(path, boxes):
    lines = ["solid part"]
    for corner, eu, ev, n in (side for box in boxes for side in sides(box)):
        at = [[1e3 * (c + i * p + j * q) for c, p, q in zip(corner, eu, ev)] for i, j in ((0, 0), (1, 0), (1, 1), (0, 1))]
        for three in ((0, 1, 2), (0, 2, 3)) if sum(n) > 0 else ((0, 2, 1), (0, 3, 2)):
            lines += ["facet normal {} {} {}".format(*n), "outer loop", *("vertex {:.6f} {:.6f} {:.6f}".format(*at[k]) for k in three),
                      "endloop", "endfacet"]
    path.write_text("\n".join([*lines, "endsolid part", ""]))


def hides(box, point, way):
    """Whether a box lies in a direction from a point."""
    near, far = 1e-6, math.inf
    for low, high, p, d in zip(*box, point, way):
        if abs(d) < 1e-12:
            if not low < p < high:
                return False
            continue
        one, other = sorted(((low - p) / d, (high - p) / d))
        near, far = max(near, one), min(far, other)
    return near < far


def scan_of(boxes, chance):
    """Points that a camera half a metre away sees, in its frame."""
    middle = [0.04, 0.02, 0.015]
    turn = poses.from_vector([math.pi + chance.uniform(-0.5, 0.5), chance.uniform(-0.6, 0.6), chance.uniform(-2, 2)], [0.0] * 3)
    scan_from_part = turn[0], [x - y for x, y in zip([0.0, 0.0, 0.5], poses.rotated(turn[0], middle))]
    camera = poses.inverse(scan_from_part)[1]
    points = []
    for corner, eu, ev, n in (side for box in boxes for side in sides(box)):
        counts = [max(2, int(math.dist(e, [0.0] * 3) / 6e-4)) for e in (eu, ev)]
        for i in range(counts[0]):
            for j in range(counts[1]):
                u, v = (i + chance.random()) / counts[0], (j + chance.random()) / counts[1]
                p = [c + u * x + v * y for c, x, y in zip(corner, eu, ev)]
                way = [c - x for c, x in zip(camera, p)]
                length = math.dist(way, [0.0] * 3)
                if sum(x * y for x, y in zip(way, n)) < 0.15 * length or any(hides(box, p, way) for box in boxes):
                    continue
                off = chance.gauss(0.0, NOISE) / length
                points.append(poses.moved(scan_from_part, [x + off * w for x, w in zip(p, way)]))
    return points


def part(folder, seed):
    chance = random.Random(f"part-{seed}")
    boxes = bracket(chance)
    write_stl(folder / "part.stl", boxes)
    write_xyz(folder / "scan.xyz", scan_of(boxes, chance))
    files = [folder / "scan.xyz", folder / "part.stl"]
    return [*(files if seed % 2 else files[::-1]), "--global"]


KINDS = [(24, terrain), (3, plane), (4, ridge), (3, bowl)]
PARTS = 16


def cases():
    for count, surface in KINDS:
        for seed in range(count):
            yield f"{surface.__name__}-{seed}", lambda folder, s=surface, k=seed: two_scans(s, folder, k)
    for seed in range(PARTS):
        yield f"part-{seed}", lambda folder, k=seed: part(folder, k)
