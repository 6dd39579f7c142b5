"""Inputs of `handeye solve`: pairs, streams by two clocks, unknown scale, motions that do not determine everything."""

import json
import math
import random

import poses

METHODS = ["shah", "zhuang", "dornaika-horaud", "li", "tabb-ahmad-yousef-c1", "tabb-ahmad-yousef-c2", "park-martin", "daniilidis",
           "tsai-lenz", "shiu-ahmad", "chou-kamel", "horaud-dornaika", "horaud-dornaika-nonlinear", "andreff", "andreff-scaled",
           "lu-chou", "wu"]
CAMERA = poses.from_vector([0.1, -0.2, 1.5], [0.03, -0.06, 0.09])
TARGET = poses.from_vector([0.1, 3.0, 0.1], [0.6, 0.1, 0.02])


def robot(t, axis=None):
    """base_from_flange on a path; about one axis alone where it is given."""
    if axis is not None:
        return poses.from_vector([0.9 * math.sin(0.9 * t) * a for a in axis], [0.4 + 0.1 * math.sin(t), 0.1 * t, 0.5])
    turn = [0.2 + 0.5 * math.sin(0.9 * t), 2.9 + 0.4 * math.cos(0.63 * t), 0.6 * math.sin(0.41 * t)]
    return poses.from_vector(turn, [0.5 + 0.15 * math.sin(0.77 * t), 0.2 * math.cos(0.53 * t), 0.6 + 0.1 * math.sin(1.1 * t)])


def seen(flange, setup, chance, noise):
    """camera_from_target."""
    error = poses.from_vector(poses.normal(chance, 0.5 * noise), poses.normal(chance, noise))
    if setup == "eye-in-hand":
        return poses.times(poses.times(poses.inverse(poses.times(flange, CAMERA)), TARGET), error)
    return poses.times(poses.times(poses.inverse(poses.times(TARGET, CAMERA)), poses.times(flange, CAMERA)), error)


def pairs(some, scale=1.0):
    return [{"id": f"{k:02}", "base_from_flange": poses.as_json(a), "camera_from_target": poses.as_json(b, scale)}
            for k, (a, b) in enumerate(some)]


def taken(chance, setup, count, noise, axis=None):
    return [(flange, seen(flange, setup, chance, noise))
            for flange in (robot(0.7 * k + chance.uniform(-0.2, 0.2), axis) for k in range(count))]


def usual(chance, setup, seed):
    some = taken(chance, setup, chance.randint(3, 30), chance.choice([0.0, 1e-4, 1e-3, 5e-3]))
    method = [None, *METHODS][seed % (len(METHODS) + 1)]
    return {"pairs": pairs(some)}, ["--method", method] if method else []


def certified(chance, setup, _):
    return {"pairs": pairs(taken(chance, setup, 12, 1e-3))}, ["--certify"]


def unscaled(chance, setup, _):
    return {"unknown_scale": True, "pairs": pairs(taken(chance, setup, 15, 5e-4), chance.choice([0.2, 1.0, 1000.0]))}, []


def streams(chance, setup, _):
    offset, noise = chance.choice([0.0, 0.137, -0.4]), 2e-4
    flange = [(0.01 * k, robot(0.01 * k)) for k in range(1000)]
    camera = [(0.004 + 0.05 * k, seen(robot(0.004 + 0.05 * k), setup, chance, noise)) for k in range(190)]
    return {"robot": [{"time_s": t, "base_from_flange": poses.as_json(p)} for t, p in flange],
            "camera": [{"time_s": t + offset, "camera_from_target": poses.as_json(p)} for t, p in camera]}, []


def one_axis(chance, setup, _):
    return {"pairs": pairs(taken(chance, setup, 10, 3e-4, [0.0, 0.6, 0.8]))}, []


def two_axes(chance, setup, _):
    one, other = (taken(chance, setup, 5, 3e-4, axis) for axis in ([0.0, 0.0, 1.0], [0.0, 1.0, 0.0]))
    return {"pairs": pairs(one + other)}, []


def shifts_alone(chance, setup, _):
    flanges = [(robot(0.3)[0], robot(0.7 * k)[1]) for k in range(8)]
    return {"pairs": pairs([(flange, seen(flange, setup, chance, 3e-4)) for flange in flanges])}, []


def few(chance, setup, _):
    return {"pairs": pairs(taken(chance, setup, chance.choice([1, 2, 3]), 3e-4))}, []


def stated(chance, setup, _):
    noise = {"robot_rotation_deg": 0.05, "robot_position_mm": 0.5}
    return {"noise": noise, "pairs": pairs(taken(chance, setup, 14, 5e-4))}, []


def spoilt(chance, setup, seed):
    some = taken(chance, setup, chance.randint(8, 20), 3e-4)
    half = len(some) // 2
    match seed % 5:
        case 0:
            some = [(poses.inverse(a), b) for a, b in some]
        case 1:
            some = [(a, poses.inverse(b)) for a, b in some]
        case 2:
            by = poses.from_vector([0.0, 0.0, 0.01], [0.01, 0.0, 0.0])
            some = some[:half] + [(a, poses.times(b, by)) for a, b in some[half:]]
        case 3:
            some[2], some[5] = (some[2][0], some[5][1]), (some[5][0], some[2][1])
        case 4:
            some = [(a, poses.times(b, poses.from_vector(poses.normal(chance, 0.2), [0.0] * 3))) if k % 6 == 3 else (a, b)
                    for k, (a, b) in enumerate(some)]
    return {"pairs": pairs(some)}, []


KINDS = [(36, usual), (4, certified), (12, unscaled), (12, streams), (6, one_axis), (4, two_axes), (4, shifts_alone), (6, few),
         (4, stated), (12, spoilt)]


def cases():
    for count, kind in KINDS:
        for seed in range(count):
            yield f"{kind.__name__}-{seed}", kind, seed


def write(path, kind, seed):
    """The input, and the options that go with it."""
    setup = ["eye-in-hand", "eye-to-hand"][seed % 2]
    # a method for A X = Y B and one for A X = X B alike in both setups
    if kind is usual:
        setup = ["eye-in-hand", "eye-to-hand"][seed // 18 % 2]
    made, options = kind(random.Random(f"{kind.__name__}-{seed}"), setup, seed)
    path.write_text(json.dumps({"setup": setup, **made}))
    return options
