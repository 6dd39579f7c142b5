"""Does anything meet anything on planned views and on the ways between them, and are joints within limits?

    pip install pin coal
    python bench/plan/arms.py ARMS && plan ARMS 50 1 out.json && python bench/plan/judge.py ARMS out.json

Pinocchio computes where the links are, Coal whether they overlap.
"""

import json
import pathlib
import sys

import coal
import numpy as np
import pinocchio as pin

BETWEEN = 20


def model_of(file):
    model = pin.buildModelFromUrdf(str(file))
    shapes = pin.buildGeomFromUrdf(model, str(file), pin.GeometryType.COLLISION)
    at = pin.SE3(np.eye(3), np.array([0.5, 0.0, -0.06]))
    table = pin.GeometryObject("table", 0, 0, at, coal.Box(1.6, 1.6, 0.1))
    number = shapes.addGeometryObject(table)
    links = [g.parentJoint for g in shapes.geometryObjects]
    for a in range(len(links)):
        for b in range(a + 1, len(links)):
            if number in (a, b):
                apart = links[a] != 0 or links[b] != 0  # the base stands on the table
            else:
                apart = abs(links[a] - links[b]) > 1
            if apart:
                shapes.addCollisionPair(pin.CollisionPair(a, b))
    # shapes that overlap whatever the joints do are no collision
    random, always = np.random.default_rng(0), {pair: 0 for pair in range(len(shapes.collisionPairs))}
    data, seen = model.createData(), shapes.createData()
    for _ in range(100):
        q = random.uniform(model.lowerPositionLimit, model.upperPositionLimit)
        pin.computeCollisions(model, data, shapes, seen, q, False)
        for pair in always:
            always[pair] += seen.collisionResults[pair].isCollision()
    for pair in [p for p, count in always.items() if count >= 95]:
        seen.deactivateCollisionPair(pair)
    return model, shapes, seen


def main():
    arms, out = pathlib.Path(sys.argv[1]), json.loads(pathlib.Path(sys.argv[2]).read_text())
    models = {}
    poses = points = colliding = beyond = 0
    for run in out:
        name = run["arm"]
        if name not in models:
            models[name] = model_of(arms / f"{name}.urdf")
        model, shapes, seen = models[name]
        data = model.createData()
        joints = [np.array(q) for q in run["joints"]]
        for k, q in enumerate(joints):
            before = joints[k - 1] if k else q
            for share in np.linspace(0, 1, BETWEEN + 1)[1:] if k else [1.0]:
                here = before + (q - before) * share
                points += 1
                if np.any(here < model.lowerPositionLimit - 1e-9) or np.any(here > model.upperPositionLimit + 1e-9):
                    beyond += 1
                if pin.computeCollisions(model, data, shapes, seen, here, True):
                    colliding += 1
            poses += 1
    print(f"{poses} poses, {points} points: {colliding} in collision, {beyond} beyond limits")
    return 1 if colliding or beyond else 0


sys.exit(main())
