"""Rigid transforms as 4 x 4 matrices (m, rad), and how a URDF writes them."""

import numpy as np


def turned(axis, angle):
    """About x, y or z: 0, 1, 2."""
    c, s = np.cos(angle), np.sin(angle)
    i, j = [(1, 2), (2, 0), (0, 1)][axis]
    m = np.eye(4)
    m[i, i], m[i, j], m[j, i], m[j, j] = c, -s, s, c
    return m


def shifted(*by):
    m = np.eye(4)
    m[:3, 3] = by
    return m


def origin(m):
    """`<origin xyz rpy>`: about the fixed axes x, y, z."""
    roll = np.arctan2(m[2, 1], m[2, 2])
    pitch = np.arctan2(-m[2, 0], np.hypot(m[0, 0], m[1, 0]))
    yaw = np.arctan2(m[1, 0], m[0, 0])
    numbers = [" ".join(f"{float(x):.17g}" for x in part) for part in (m[:3, 3], (roll, pitch, yaw))]
    return f'<origin xyz="{numbers[0]}" rpy="{numbers[1]}"/>'
