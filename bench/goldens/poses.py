"""Rigid motions by the standard library alone: a pose is (quaternion x y z w, translation)."""

import math


def normal(random, sigma):
    return [random.gauss(0.0, sigma) for _ in range(3)]


def from_vector(rotation, translation):
    """Of a rotation vector, rad, and a translation."""
    angle = math.sqrt(sum(x * x for x in rotation))
    scale = math.sin(angle / 2) / angle if angle > 0 else 0.5
    return [x * scale for x in rotation] + [math.cos(angle / 2)], list(translation)


def times(a, b):
    (ax, ay, az, aw), (bx, by, bz, bw) = a[0], b[0]
    rotation = [aw * bx + ax * bw + ay * bz - az * by, aw * by - ax * bz + ay * bw + az * bx,
                aw * bz + ax * by - ay * bx + az * bw, aw * bw - ax * bx - ay * by - az * bz]
    return rotation, [x + y for x, y in zip(a[1], rotated(a[0], b[1]))]


def inverse(a):
    back = [-a[0][0], -a[0][1], -a[0][2], a[0][3]]
    return back, [-x for x in rotated(back, a[1])]


def rotated(q, v):
    x, y, z, w = q
    t = [2 * (y * v[2] - z * v[1]), 2 * (z * v[0] - x * v[2]), 2 * (x * v[1] - y * v[0])]
    return [v[0] + w * t[0] + y * t[2] - z * t[1], v[1] + w * t[1] + z * t[0] - x * t[2],
            v[2] + w * t[2] + x * t[1] - y * t[0]]


def moved(a, point):
    return [x + y for x, y in zip(rotated(a[0], point), a[1])]


def as_json(a, scale=1.0):
    return {"translation_m": [x * scale for x in a[1]], "rotation_xyzw": a[0]}
