"""The drop-in beside OpenCV itself."""

import pickle
import subprocess
import sys
import warnings

import cv2
import numpy as np
import pytest

import handeye
from handeye import cv2_compat

from cell import HALF_TURN, X, Y, about_one_axis, cell, parts

HAND_EYE = ["TSAI", "PARK", "HORAUD", "ANDREFF", "DANIILIDIS"]
ROBOT_WORLD = ["SHAH", "LI"]
has_opencv = pytest.mark.skipif(
    not hasattr(cv2, "calibrateHandEye"), reason="this OpenCV has no calibrateHandEye"
)


def flag(name, kind="HAND_EYE"):
    return getattr(cv2_compat, f"CALIB_{kind}_{name}")


def apart(ours, theirs):
    """The largest difference of any number."""
    return max(float(np.abs(a - b).max()) for a, b in zip(ours, theirs))


@has_opencv
@pytest.mark.parametrize("name", HAND_EYE)
def test_every_method_gives_opencvs_numbers(name):
    assert flag(name) == getattr(cv2, f"CALIB_HAND_EYE_{name}")
    for seed, count in [(0, 12), (1, 15), (2, 30)]:
        robot, camera = cell(count, seed=seed)
        given = (*parts(robot), *parts(camera))
        ours = cv2_compat.calibrateHandEye(*given, method=flag(name))
        theirs = cv2.calibrateHandEye(*given, method=flag(name))
        assert [a.shape for a in ours] == [a.shape for a in theirs] == [(3, 3), (3, 1)]
        assert [a.dtype for a in ours] == [a.dtype for a in theirs]
        assert apart(ours, theirs) < 1e-6


@has_opencv
@pytest.mark.parametrize("name", ROBOT_WORLD)
def test_both_methods_of_the_robot_in_the_world_give_opencvs_numbers(name):
    for seed in range(3):
        robot, camera = cell(20, seed=seed)
        given = (*parts(camera), *parts(np.linalg.inv(robot)))
        ours = cv2_compat.calibrateRobotWorldHandEye(*given, method=flag(name, "ROBOT_WORLD_HAND_EYE"))
        theirs = cv2.calibrateRobotWorldHandEye(*given, method=flag(name, "ROBOT_WORLD_HAND_EYE"))
        assert [a.shape for a in ours] == [a.shape for a in theirs]
        assert apart(ours, theirs) < 1e-6


def test_the_answer_is_the_camera_on_the_gripper():
    robot, camera = cell(noise=0.0)
    for name in HAND_EYE:
        r, t = cv2_compat.calibrateHandEye(*parts(robot), *parts(camera), method=flag(name))
        assert apart((r, t), (X[:3, :3], X[:3, 3:])) < 1e-9
    robot_inverted = np.linalg.inv(robot)
    found = cv2_compat.calibrateRobotWorldHandEye(*parts(camera), *parts(robot_inverted))
    base2world, gripper2cam = np.linalg.inv(Y), np.linalg.inv(X)
    assert apart(found[:2], (base2world[:3, :3], base2world[:3, 3:])) < 1e-9
    assert apart(found[2:], (gripper2cam[:3, :3], gripper2cam[:3, 3:])) < 1e-9


def test_arrays_may_have_any_shape_and_type_that_opencv_takes():
    robot, camera = cell(noise=0.0)
    vectors = [handeye.Pose("a", "b", m).rotation_vector for m in robot]
    for rotations, translations in [
        (robot[:, :3, :3], robot[:, :3, 3]),
        (list(robot[:, :3, :3]), [t.reshape(1, 3) for t in robot[:, :3, 3]]),
        ([v.reshape(3, 1) for v in vectors], [t.tolist() for t in robot[:, :3, 3]]),
        (tuple(robot[:, :3, :3].astype(np.float32)), tuple(robot[:, :3, 3].astype(np.float32))),
        ([np.asfortranarray(r) for r in robot[:, :3, :3]], robot[:, :3, 3:]),
    ]:
        r, t = cv2_compat.calibrateHandEye(rotations, translations, *parts(camera))
        assert apart((r, t), (X[:3, :3], X[:3, 3:])) < 1e-6


def test_output_arrays_are_filled():
    robot, camera = cell()
    r, t = np.zeros((3, 3)), np.zeros((3, 1))
    found = cv2_compat.calibrateHandEye(*parts(robot), *parts(camera), r, t, cv2_compat.CALIB_HAND_EYE_PARK)
    assert (found[0] == r).all() and (found[1] == t).all()


def test_lengths_may_be_millimetres():
    robot, camera = cell()
    metres = cv2_compat.calibrateHandEye(*parts(robot), *parts(camera))
    for matrices in (robot, camera):
        matrices[:, :3, 3] *= 1e3
    r, t = cv2_compat.calibrateHandEye(*parts(robot), *parts(camera))
    assert apart((r, t / 1e3), metres) < 1e-12
    camera[4] = camera[4] @ np.diag([-1.0, -1.0, 1.0, 1.0])
    with pytest.raises(handeye.Rejected, match="poses 4"):
        cv2_compat.calibrateHandEye(*parts(robot), *parts(camera))


@pytest.mark.parametrize("side", [0, 1])
def test_two_units_are_named(side):
    both = cell()
    both[side][:, :3, 3] *= 1e3
    with pytest.raises(handeye.Rejected, match="is one list in millimetres"):
        cv2_compat.calibrateHandEye(*parts(both[0]), *parts(both[1]))


def test_a_method_in_the_place_of_an_output_is_refused():
    robot, camera = cell()
    with pytest.raises(handeye.InputError, match="method=1"):
        cv2_compat.calibrateHandEye(*parts(robot), *parts(camera), cv2_compat.CALIB_HAND_EYE_PARK)
    given = (*parts(camera), *parts(np.linalg.inv(robot)))
    with pytest.raises(handeye.InputError, match="method=1"):
        cv2_compat.calibrateRobotWorldHandEye(*given, 1)
    for output in (np.int64(1), np.array(1), "1", [], {}, object()):
        with pytest.raises(handeye.InputError, match="an output array belongs"):
            cv2_compat.calibrateHandEye(*parts(robot), *parts(camera), output)


def test_complex_numbers_are_no_rotations():
    robot, camera = cell()
    r, t = parts(robot)
    for bad in (robot[:, :3, :3] + 0j, [x.astype(str) for x in robot[:, :3, :3]]):
        with pytest.raises(handeye.InputError, match="no array of real numbers"):
            cv2_compat.calibrateHandEye(bad, t, *parts(camera))


def test_errors_can_be_sent_to_other_processes():
    robot, camera = about_one_axis()
    with pytest.raises(handeye.NotDetermined) as caught:
        cv2_compat.calibrateHandEye(*parts(robot), *parts(camera))
    back = pickle.loads(pickle.dumps(caught.value))
    assert type(back) is type(caught.value) and isinstance(back, cv2.error) and str(back) == str(caught.value)


def test_errors_are_opencvs_in_a_script_that_has_not_imported_it():
    script = """
import sys
from handeye import cv2_compat as cv2
assert "cv2" not in sys.modules
try:
    cv2.calibrateHandEye([], [], [], [])
except cv2.error as error:
    print(type(error).__name__)
"""
    done = subprocess.run([sys.executable, "-c", script], capture_output=True, text=True, check=True)
    assert done.stdout.strip() in ("InputError", "NotDetermined")


def hand_eye(robot, camera, name):
    return cv2_compat.calibrateHandEye(*parts(robot), *parts(camera), method=flag(name))


@pytest.mark.parametrize("name", HAND_EYE)
class TestWhatOpenCvAnswersWrongly:
    """Stress cases in which OpenCV gives NaN, metres of error, or an exception without a reason."""

    def test_a_flipped_board_is_named(self, name):
        robot, camera = cell()
        camera[4] = camera[4] @ np.diag([-1.0, -1.0, 1.0, 1.0])
        with pytest.raises(handeye.Rejected, match="poses 4"):
            hand_eye(robot, camera, name)

    def test_rotations_about_one_axis_are_named(self, name):
        robot, camera = about_one_axis()
        with pytest.raises(handeye.NotDetermined, match="axis"):
            hand_eye(robot, camera, name)

    def test_a_camera_turned_by_half_a_turn_is_found(self, name):
        robot, camera = cell(noise=0.0, x=HALF_TURN)
        r, t = hand_eye(robot, camera, name)
        assert apart((r, t), (HALF_TURN[:3, :3], HALF_TURN[:3, 3:])) < 1e-6

    def test_scripts_that_catch_errors_of_opencv_go_on(self, name):
        robot, camera = about_one_axis()
        with pytest.raises(cv2.error, match="axis") as caught:
            hand_eye(robot, camera, name)
        assert isinstance(caught.value, handeye.NotDetermined)

    def test_two_poses_are_too_few(self, name):
        robot, camera = cell(2)
        with pytest.raises(handeye.NotDetermined, match="at least 3"):
            hand_eye(robot, camera, name)

    def test_three_poses_come_with_a_warning(self, name):
        robot, camera = cell(3, seed=3)
        with pytest.warns(cv2_compat.HandEyeWarning, match="too few"):
            hand_eye(robot, camera, name)

    def test_nan_is_named(self, name):
        robot, camera = cell()
        robot[3, 0, 3] = np.nan
        with pytest.raises(handeye.InputError, match=r"t_gripper2base\[3\]"):
            hand_eye(robot, camera, name)

    def test_a_mirrored_rotation_is_named(self, name):
        robot, camera = cell()
        camera[2, :3, 2] *= -1
        with pytest.raises(handeye.InputError, match=r"R_target2cam\[2\].*mirrors"):
            hand_eye(robot, camera, name)

    def test_a_matrix_that_is_no_rotation_is_named(self, name):
        robot, camera = cell()
        robot[0, :3, :3] *= 1.01
        with pytest.raises(handeye.InputError, match=r"R_gripper2base\[0\]"):
            hand_eye(robot, camera, name)

    def test_lists_of_different_lengths_are_named(self, name):
        robot, camera = cell()
        with pytest.raises(handeye.InputError, match="15 poses but R_target2cam has 14"):
            hand_eye(robot, camera[:14], name)

    def test_inverted_robot_poses_are_recognised(self, name):
        robot, camera = cell()
        with pytest.raises(handeye.Rejected, match="inverted"):
            hand_eye(np.linalg.inv(robot), camera, name)

    def test_poses_out_of_order_are_recognised(self, name):
        robot, camera = cell()
        with pytest.raises(handeye.HandEyeError, match="before their captures|same order"):
            hand_eye(robot, np.roll(camera, 1, axis=0), name)

    def test_clean_data_give_no_warning(self, name):
        with warnings.catch_warnings():
            warnings.simplefilter("error")
            for seed in range(10):
                hand_eye(*cell(12, seed=seed), name)


@pytest.mark.parametrize("name", [*HAND_EYE, *ROBOT_WORLD])
def test_good_data_are_not_refused(name):
    for seed in range(12):
        for count, noise in [(7, 2.0), (12, 5.0), (30, 1.0)]:
            robot, camera = cell(count, noise=noise, seed=seed)
            with warnings.catch_warnings():
                warnings.simplefilter("ignore")
                if name in HAND_EYE:
                    hand_eye(robot, camera, name)
                else:
                    given = (*parts(camera), *parts(np.linalg.inv(robot)))
                    method = flag(name, "ROBOT_WORLD_HAND_EYE")
                    cv2_compat.calibrateRobotWorldHandEye(*given, method=method)


def told_or_refused(robot, camera, name="PARK"):
    with warnings.catch_warnings(record=True) as told:
        warnings.simplefilter("always")
        try:
            hand_eye(robot, camera, name)
        except handeye.HandEyeError:
            return True
    return len(told) > 0


class TestSmallErrors:
    """Too small for an exception, and nothing to be silent about."""

    def count(self, change):
        return sum(told_or_refused(*change(*cell(15, seed=seed))) for seed in range(20))

    def test_a_board_that_is_two_percent_larger_is_noticed(self):
        def larger(robot, camera):
            camera[:, :3, 3] *= 1.02
            return robot, camera

        assert self.count(larger) == 20

    def test_a_pose_that_is_off_by_five_millimetres_is_noticed(self):
        def off(robot, camera):
            robot[6, :3, 3] += [0.003, -0.003, 0.003]
            return robot, camera

        assert self.count(off) >= 19

    def test_a_camera_that_looks_backwards_is_noticed(self):
        def inverted(robot, camera):
            return np.linalg.inv(robot), np.linalg.inv(camera)

        assert self.count(inverted) == 20

    def test_nothing_is_said_of_clean_data(self):
        assert self.count(lambda robot, camera: (robot, camera)) <= 1


def test_rotations_that_were_printed_with_three_digits_are_taken():
    robot, camera = cell(noise=0.0)
    robot[:, :3, :3], camera[:, :3, :3] = robot[:, :3, :3].round(3), camera[:, :3, :3].round(3)
    with warnings.catch_warnings():
        warnings.simplefilter("ignore")
        found = cv2_compat.calibrateHandEye(*parts(robot), *parts(camera))
    assert apart(found, (X[:3, :3], X[:3, 3:])) < 2e-3


def test_methods_and_outputs_that_are_none_are_refused():
    given = (*parts(cell()[0]), *parts(cell()[1]))
    for method in [-1, 5, True, "PARK", 1.0]:
        with pytest.raises(handeye.InputError, match="method"):
            cv2_compat.calibrateHandEye(*given, method=method)
    default = cv2_compat.calibrateHandEye(*given)
    assert apart(cv2_compat.calibrateHandEye(*given, method=None), default) == 0.0
    with pytest.raises(handeye.InputError, match="floating"):
        cv2_compat.calibrateHandEye(*given, np.zeros((3, 3), int))
    r = np.zeros((3, 3))
    assert cv2_compat.calibrateHandEye(*given, r)[0] is r and r.any()


def test_other_names_are_those_of_opencv():
    assert cv2_compat.Rodrigues is cv2.Rodrigues
    with pytest.raises(AttributeError):
        cv2_compat.no_such_name


def test_a_length_that_overflows_is_refused():
    robot, camera = cell()
    robot[0, 0, 3] = 1e300
    with pytest.raises(handeye.InputError, match=r"t_gripper2base\[0\]"):
        cv2_compat.calibrateHandEye(*parts(robot), *parts(camera))
