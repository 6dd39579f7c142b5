"""Relative motions, A X = X B."""

import handeye
import numpy as np
import pytest


def any_pose(random, to, frm, turn, reach):
    return handeye.Pose(to, frm, rotation=turn * random.normal(size=3), translation=reach * random.normal(size=3))


@pytest.mark.parametrize("setup, mount", [("eye-in-hand", "flange"), ("eye-to-hand", "base")])
def test_x_is_found_from_motions(setup, mount):
    random = np.random.default_rng(4)
    x = any_pose(random, mount, "camera", 0.5, 0.1)
    a = [any_pose(random, mount, mount, 0.5, 0.2) for _ in range(15)]
    noise = [any_pose(random, "camera", "camera", 2e-4, 1e-4) for _ in a]
    b = [x.inverse() @ motion @ x @ off for motion, off in zip(a, noise)]
    found = handeye.solve_motions(a, b, setup=setup)
    assert found.verdict == "accepted", found.reasons
    off = np.linalg.norm(found.mount_from_camera.translation - x.translation)
    assert off < 3e-4
    assert found.captures[-1]["id"] == "start"
    published = handeye.solve_motions(np.array([m.matrix for m in a]), b, setup=setup, method="park-martin")
    assert np.linalg.norm(published.mount_from_camera.translation - x.translation) < 1e-3


def test_motions_that_cannot_be_used_are_refused():
    one = [np.eye(4)]
    with pytest.raises(handeye.InputError, match="in front of the camera"):
        handeye.solve_motions(one, one, setup="eye-in-hand", distance_m=0.0)
    with pytest.raises(handeye.InputError, match="from which all motions begin"):
        handeye.solve_motions(one, one, setup="eye-in-hand", ids=["start"])
    with pytest.raises(handeye.InputError):
        handeye.solve_motions(one, one * 2, setup="eye-in-hand")


def test_a_mirrored_matrix_is_named():
    with pytest.raises(handeye.InputError, match="mirrors"):
        handeye.Pose("base", "camera", np.diag([1.0, 1.0, -1.0, 1.0]))
