"""Poses, calibrations and the other functions of the package."""

import json
import pathlib
import pickle
import subprocess
import sys
import threading
import time

import numpy as np
import pytest

import handeye
from handeye import Pose

from cell import X, Y, about_one_axis, cell, pose, rotation, seen


def test_poses_multiply_where_their_inner_frames_agree():
    a = Pose("base", "flange", rotation=[0.1, 0.2, 0.3], translation=[1, 2, 3])
    b = Pose("flange", "camera", rotation=[0.0, 0.0, 0.0, 1.0], translation=[0, 0, 0.1])
    chained = a @ b
    assert (chained.to, chained.from_frame, chained.name) == ("base", "camera", "base_from_camera")
    assert np.allclose(chained.matrix, a.matrix @ b.matrix)
    assert np.allclose((a @ a.inverse()).matrix, np.eye(4))
    points = np.array([[0.0, 0.0, 0.0], [1.0, 0.0, 0.0]])
    assert np.allclose(chained @ points, (chained.matrix[:3, :3] @ points.T).T + chained.translation)
    with pytest.raises(handeye.InputError, match="base_from_flange @ base_from_flange: flange is not base"):
        a @ a


def test_rotations_are_the_same_in_every_notation():
    random = np.random.default_rng(1)
    for _ in range(200):
        axis = random.normal(size=3)
        vector = axis / np.linalg.norm(axis) * random.choice([1e-9, 0.3, 2.0, np.pi - 1e-9, np.pi])
        pose = Pose("a", "b", rotation=vector)
        angle = np.linalg.norm(vector)
        assert np.isclose(pose.rotation.trace(), 1 + 2 * np.cos(angle))
        assert np.allclose(pose.rotation @ vector, vector)
        again = Pose("a", "b", rotation=pose.quaternion_xyzw)
        assert np.allclose(again.rotation, pose.rotation, atol=1e-12)
        assert pose.quaternion_xyzw[3] >= 0
        back = pose.rotation_vector
        assert np.allclose(back, vector, atol=1e-7) or np.isclose(angle, np.pi, atol=1e-8)


def test_what_is_no_pose_is_refused():
    for matrix in [np.eye(3), np.diag([1.0, 1.0, -1.0, 1.0]), 2 * np.eye(4), np.full((4, 4), np.nan)]:
        with pytest.raises(handeye.InputError):
            Pose("a", "b", matrix)
    with pytest.raises(handeye.InputError, match="length 1"):
        Pose("a", "b", rotation=[1.0, 1.0, 0.0, 0.0])
    with pytest.raises(ValueError):
        Pose("a", "b").matrix[0, 3] = 1.0


def test_poses_go_through_pickle_and_dict():
    pose = Pose("base", "camera", rotation=[0.1, 0.2, 0.3], translation=[1, 2, 3])
    assert pickle.loads(pickle.dumps(pose)) == pose
    again = Pose.from_dict(json.loads(json.dumps(pose.to_dict())))
    assert np.allclose(again.matrix, pose.matrix) and again.name == pose.name
    assert hash(pickle.loads(pickle.dumps(pose))) == hash(pose)


def off_by_place(count, size, first=0):
    """What a robot reports that stands off by up to ``size`` (m), smoothly from place to place, and what is seen."""
    reported, seen_there = [], []
    for k in range(first, first + count):
        wave = lambda n: np.sin(k * n + 0.3 * n * n)
        turn = [3.0 + 0.5 * wave(1.1), 0.1 + 0.5 * wave(2.3), 0.2 + 0.6 * wave(3.7)]
        really = pose(turn, [0.5 + 0.2 * wave(1.7), 0.2 * wave(2.9), 0.5 + 0.15 * wave(4.3)])
        p = really[:3, 3]
        off = np.array([np.sin(9 * p[1]), np.sin(8 * p[2]), np.cos(10 * p[0])]) * size
        reported.append(pose([0, 0, 0], off) @ really)
        noise = np.random.default_rng(k)
        error = pose(1e-4 * noise.normal(size=3), 3e-5 * noise.normal(size=3))
        seen_there.append(seen(really) @ error)
    return np.array(reported), np.array(seen_there)


def test_poses_of_a_robot_that_errs_by_place_are_corrected():
    found = handeye.solve(*off_by_place(40, 1e-3), setup="eye-in-hand")
    reported, camera = off_by_place(40, 1e-3, first=100)
    corrected = found.compensate(reported, reported=True)
    spread = lambda flanges: np.std(
        [(f @ found.pose.matrix @ c)[:3, 3] for f, c in zip(flanges, camera)], axis=0
    )
    flanges = [one.base_from_flange.matrix for one in corrected]
    assert np.linalg.norm(spread(flanges)) < 0.4 * np.linalg.norm(spread(reported))
    assert sum(one.inside for one in corrected) > 30
    covariance = corrected[0].covariance
    assert covariance.shape == (6, 6) and np.all(np.linalg.eigvalsh(covariance) > 0)
    sent = found.compensate([one.base_from_flange for one in corrected[:3]])
    assert all(one.base_from_flange.name == "base_from_flange" for one in sent)
    again = handeye.Calibration.from_dict(found.to_dict()).compensate(reported[:2], reported=True)
    assert np.array_equal(again[1].base_from_flange.matrix, flanges[1])
    with pytest.raises(handeye.NotDetermined, match="nothing to correct|does not pay"):
        handeye.solve(*off_by_place(40, 0.0), setup="eye-in-hand").compensate(reported)


@pytest.mark.parametrize("setup", ["eye-in-hand", "eye-to-hand"])
def test_poses_are_calibrated_with_their_uncertainty(setup):
    errors = []
    for seed in range(10):
        robot, camera = cell(15, seed=seed)
        if setup == "eye-to-hand":
            robot = np.linalg.inv(robot)
        found = handeye.solve(robot, camera, setup=setup)
        assert found.accepted and found.verdict == "accepted" and found.setup == setup
        mount = "flange" if setup == "eye-in-hand" else "base"
        assert found.pose.name == f"{mount}_from_camera"
        off = np.linalg.inv(X) @ found.pose.matrix
        error = np.append(Pose("a", "b", off).rotation_vector, off[:3, 3])
        errors.append(error @ np.linalg.solve(found.covariance, error) / 6)
        assert np.allclose(found.anchor_from_target.matrix, Y, atol=3e-3)
        assert np.allclose(found.sigma[1], 1e3 * np.sqrt(np.diag(found.covariance))[3:])
    assert 0.3 < np.mean(errors) < 2.0


def test_frames_of_given_poses_are_checked():
    robot, camera = cell()
    flange = [Pose("base", "flange", m) for m in robot]
    target = [Pose("camera", "target", m) for m in camera]
    found = handeye.solve(flange, target, setup="eye-in-hand")
    assert found == handeye.solve(robot, camera, setup="eye-in-hand")
    with pytest.raises(handeye.InputError, match="pose 0 is flange_from_base"):
        handeye.solve([p.inverse() for p in flange], target, setup="eye-in-hand")


def test_what_is_not_determined_is_none_and_named():
    found = handeye.solve(*about_one_axis(), setup="eye-in-hand")
    assert found.verdict == "undetermined" and not found.accepted
    assert found.mount_from_camera is None and found.covariance is None and found.undetermined
    with pytest.raises(handeye.NotDetermined, match="axis"):
        found.pose
    assert "undetermined" in repr(found)


def test_a_wrong_capture_is_left_out_by_name():
    robot, camera = cell()
    camera[4] = camera[4] @ np.diag([-1.0, -1.0, 1.0, 1.0])
    names = [f"shot_{k}" for k in range(len(robot))]
    found = handeye.solve(robot, camera, setup="eye-in-hand", ids=names)
    assert found.accepted and found.rejected == ["shot_4"]


def test_calibrations_go_through_pickle_dict_and_files(tmp_path):
    found = handeye.solve(*cell(), setup="eye-in-hand")
    for again in [
        pickle.loads(pickle.dumps(found)),
        handeye.Calibration.from_dict(json.loads(json.dumps(found.to_dict()))),
        handeye.Calibration.from_json(found.to_json()),
    ]:
        assert again == found and again.to_json() == found.to_json()
    page = found.save(tmp_path / "out")
    assert handeye.Calibration.load(tmp_path / "out" / "calibration.json") == found
    assert "<html" in page.read_text("utf-8")
    assert "accepted" in found.report(tmp_path / "x.html", title="my cell").read_text("utf-8").lower()
    assert "my cell" in (tmp_path / "x.html").read_text("utf-8")
    with pytest.raises(handeye.InputError, match="no calibration"):
        handeye.Calibration.from_json("{}")


def test_results_go_to_other_programs(tmp_path):
    found = handeye.solve(*cell(), setup="eye-in-hand")
    r, t = found.to_opencv()
    assert r.shape == (3, 3) and t.shape == (3, 1) and np.allclose(t[:, 0], found.pose.translation)
    stamped = found.to_ros(child="camera_optical_frame")
    assert stamped["header"]["frame_id"] == "flange"
    assert list(stamped["transform"]["rotation"]) == ["x", "y", "z", "w"]
    assert np.isclose(stamped["transform"]["translation"]["x"], found.pose.translation[0])
    assert b"<joint" in found.export("urdf")
    assert np.allclose(np.load(found.export("npy", tmp_path)), found.pose.matrix)
    with pytest.raises(handeye.InputError, match="urdf"):
        found.export("nothing")


def test_a_notebook_shows_a_table_without_scripts():
    html = handeye.solve(*cell(), setup="eye-in-hand")._repr_html_()
    assert html.startswith("<table>") and "accepted" in html and "<script" not in html


def test_streams_with_clocks_of_their_own_are_aligned():
    times = np.arange(0.0, 20.0, 0.02)
    path = np.array([np.sin(0.5 * times), np.sin(0.8 * times + 1), np.sin(0.3 * times + 2)]).T

    def base_from_flange(k):
        turn = rotation([0.5 * path[k, 0], 0.6 * path[k, 1], 0.7 * path[k, 2]])
        matrix = np.eye(4)
        matrix[:3, :3], matrix[:3, 3] = turn, [0.5, 0.1, 0.4] + 0.1 * path[k]
        return matrix

    robot = np.array([base_from_flange(k) for k in range(len(times))])
    camera = np.linalg.inv(X) @ np.linalg.inv(robot) @ Y
    found = handeye.solve(
        robot,
        camera[::3],
        setup="eye-in-hand",
        robot_times_s=times,
        camera_times_s=times[::3] + 0.035,
    )
    assert abs(found.to_dict()["time_offset_s"] - 0.035) < 1e-3
    assert np.allclose(found.pose.matrix, X, atol=2e-3)


@pytest.mark.parametrize("method", handeye.METHODS)
def test_every_published_method_solves_exact_data(method):
    robot, camera = cell(noise=0.0)
    x, y = handeye.closed_form(robot, camera, setup="eye-in-hand", method=method)
    assert (x.name, y.name) == ("flange_from_camera", "base_from_target")
    assert np.allclose(x.matrix, X, atol=1e-6) and np.allclose(y.matrix, Y, atol=1e-6)


def test_corners_are_found_in_a_picture():
    square, columns, rows = 40, 7, 5
    image = np.full((480, 640), 230, np.uint8)
    for row in range(rows + 1):
        for column in range(columns + 1):
            if (row + column) % 2 == 0:
                y, x = 60 + row * square, 100 + column * square
                image[y : y + square, x : x + square] = 20
    target = {"kind": "checkerboard", "columns": columns, "rows": rows, "square_mm": 30.0}
    expected = np.array(
        [(99.5 + square * (c + 1), 59.5 + square * (r + 1)) for r in range(rows) for c in range(columns)]
    )
    transparent = np.dstack([image, image, image, np.arange(image.size).reshape(image.shape) % 256]).astype(np.uint8)
    pictures = [image, np.dstack([image] * 3), transparent, image.astype(np.uint16) << 8]
    for picture in [*pictures, image.astype(np.float32), image.astype(np.float64)]:
        found = handeye.detect(picture, target)
        assert found.found and sorted(found.ids.tolist()) == list(range(35))
        assert found.covariances.shape == (35, 2, 2)
        nearest = np.abs(found.pixels[:, None] - expected[None]).max(axis=2).min(axis=1)
        assert nearest.max() < 0.02
    empty = handeye.detect(np.full((100, 100), 128, np.uint8), target)
    assert not empty.found and empty.reason and len(empty.ids) == 0
    with pytest.raises(handeye.InputError, match="kind"):
        handeye.detect(image, {"columns": 7})
    with pytest.raises(handeye.InputError, match="shape"):
        handeye.detect(np.zeros((3, 4, 5, 6), np.uint8), target)


def surface(random, count):
    """Points on uneven ground."""
    x, y = random.uniform(-0.3, 0.3, (2, count))
    z = 0.03 * np.sin(9 * x + 1) * np.cos(7 * y) + 0.02 * np.sin(17 * y + 5 * x * x)
    return np.stack([x, y, z], axis=1) + 2e-4 * random.normal(size=(count, 3))


def test_scans_are_registered():
    random = np.random.default_rng(3)
    truth = Pose("target", "source", rotation=[0.2, -0.1, 0.4], translation=[0.3, 0.1, 0.2])
    source, target = surface(random, 30_000), truth @ surface(random, 30_000)
    start = np.array(truth.matrix)
    start[:3, 3] += 0.004
    for initial in [start, Pose("target", "source", start)]:
        found = handeye.register(source.astype(np.float32), target, initial=initial)
        assert found.accepted and found.target_from_source.name == "target_from_source"
        assert np.allclose(found.target_from_source.matrix, truth.matrix, atol=2e-4)
        assert found.covariance.shape == (6, 6) and abs(found.size_ratio - 1) < 2e-3
    assert handeye.register(source, target, search=True).accepted
    with pytest.raises(handeye.InputError, match="shape"):
        handeye.register(source[:, :2], target)


def test_other_threads_run_while_a_calibration_does():
    ticks, done = [], threading.Event()

    def tick():
        while not done.is_set():
            ticks.append(time.perf_counter())
            time.sleep(0.001)

    thread = threading.Thread(target=tick)
    thread.start()
    handeye.solve(*cell(300), setup="eye-in-hand")
    done.set()
    thread.join()
    assert len(ticks) > 5


INTERRUPTED = """
import _thread, signal, threading, sys
sys.path.insert(0, {folder!r})
import handeye
# a shell has its background jobs ignore it
signal.signal(signal.SIGINT, signal.default_int_handler)
from cell import cell
robot, camera = cell(4000)
threading.Timer(0.3, _thread.interrupt_main).start()
try:
    handeye.solve(robot, camera, setup="eye-in-hand")
    print("finished")
except KeyboardInterrupt:
    print("interrupted")
"""


def test_ctrl_c_ends_long_work():
    folder = __file__.rsplit("/", 1)[0]
    run = subprocess.run(
        [sys.executable, "-c", INTERRUPTED.format(folder=folder)], capture_output=True, text=True, timeout=300
    )
    assert run.stdout.strip() == "interrupted", run.stdout + run.stderr


def test_a_simulated_folder_is_calibrated(tmp_path):
    told = []
    names = handeye.simulate(tmp_path / "cell", captures=8, width=640, height=400)
    assert "truth.json" in names and (tmp_path / "cell" / "handeye.toml").exists()
    found = handeye.calibrate(
        tmp_path / "cell", out=tmp_path / "out", progress=lambda done, count: told.append((done, count))
    )
    assert found.accepted and told[-1][0] == told[-1][1] >= 8
    assert len(found.captures) == 8 and len(found.candidates) > 2
    page = (tmp_path / "out" / "report.html").read_text("utf-8")
    assert "data:image" in page
    assert found.report(tmp_path / "again.html").read_text("utf-8") == page
    with pytest.raises(handeye.InputError, match="does not exist") as caught:
        handeye.calibrate(tmp_path / "nowhere")
    assert caught.value.code == "cannot-read" and caught.value.file
    with pytest.raises(handeye.InputError, match="captures"):
        handeye.simulate(tmp_path / "none", captures=0)
    (tmp_path / "cell" / "poses.csv").write_text("mine")
    with pytest.raises(handeye.InputError, match="force"):
        handeye.simulate(tmp_path / "cell", captures=8, width=640, height=400)


def test_an_error_in_a_progress_callback_ends_the_work(tmp_path):
    handeye.simulate(tmp_path / "cell", captures=8, width=640, height=400)

    def fails(done, count):
        raise RuntimeError("stop here")

    with pytest.raises(RuntimeError, match="stop here"):
        handeye.calibrate(tmp_path / "cell", progress=fails)


EXAMPLES = sorted((pathlib.Path(__file__).resolve().parent.parent / "examples").glob("*.py"))


@pytest.mark.parametrize("example", EXAMPLES, ids=lambda path: path.stem)
def test_examples_run(example, tmp_path):
    run = subprocess.run(
        [sys.executable, str(example)], capture_output=True, text=True, timeout=600, cwd=tmp_path
    )
    assert run.returncode == 0, run.stdout + run.stderr


def test_poses_of_few_digits_are_made_rotations():
    exact = Pose("a", "b", rotation=[0.3, -0.4, 0.5], translation=[1, 2, 3])
    rounded = Pose("a", "b", exact.matrix.round(3))
    assert np.abs((rounded @ rounded.inverse()).matrix - np.eye(4)).max() < 1e-12
    assert np.abs(Pose.from_dict(rounded.to_dict()).matrix - rounded.matrix).max() < 1e-12
    assert np.abs(rounded.matrix - exact.matrix).max() < 2e-3
    assert np.allclose(Pose("a", "b", rotation=np.array([[0.3], [-0.4], [0.5]])).rotation, exact.rotation)


def test_poses_do_not_change_and_keep_their_frames():
    pose = Pose("a", "b", translation=[0.0, 1.0, 2.0])
    with pytest.raises(ValueError):
        pose.matrix.setflags(write=True)
    assert hash(pose) == hash(Pose("a", "b", translation=[-0.0, 1.0, 2.0]))
    with pytest.raises(TypeError):
        np.eye(4) @ pose
    with pytest.raises(handeye.InputError, match="numbers"):
        Pose("a", "b", translation=[1, 2, 3, 4])
    with pytest.raises(handeye.InputError, match="3 x 3|numbers|shape"):
        Pose("a", "b", rotation=[[1, 2], [3]])


def test_a_start_has_its_frames_and_its_shape():
    cloud = surface(np.random.default_rng(1), 5000)
    with pytest.raises(handeye.InputError, match="source_from_target"):
        handeye.register(cloud, cloud, initial=Pose("source", "target"))
    for initial in [np.zeros((0, 4, 4)), np.zeros((2, 4, 4)), np.eye(3)]:
        with pytest.raises(handeye.InputError, match="4 x 4"):
            handeye.register(cloud, cloud, initial=initial)
    assert handeye.register(cloud, cloud, initial=np.eye(4).tolist()).accepted


def test_what_is_no_list_of_poses_is_named():
    robot, camera = cell()
    for wrong, said in [(None, "no list"), ([[1, 2], [3]], r"\[0\]"), (robot[:, :3], "N x 4 x 4")]:
        with pytest.raises(handeye.InputError, match=said):
            handeye.solve(wrong, camera, setup="eye-in-hand")
    with pytest.raises(handeye.InputError) as caught:
        handeye.solve(robot, camera, setup="eye in hand")
    assert caught.value.file is None
    with pytest.raises(handeye.InputError, match="noise"):
        handeye.solve(
            robot, camera, setup="eye-in-hand", robot_times_s=[0], camera_times_s=[0], robot_position_mm=1
        )


def test_what_a_calibration_tells_does_not_change_it():
    found = handeye.solve(*cell(), setup="eye-in-hand")
    found.captures[0]["id"] = "other"
    found.to_dict()["verdict"] = "other"
    assert found.accepted and found.captures[0]["id"] == "0"


def test_numbers_of_numpy_are_numbers_of_a_target():
    target = {"kind": "checkerboard", "columns": np.int64(9), "rows": np.int32(6), "square_mm": np.float32(30)}
    found = handeye.detect(np.zeros((200, 300), np.uint8), target)
    assert not found.found and found.reason


def test_pictures_from_0_to_1_are_refused():
    target = {"kind": "checkerboard", "columns": 9, "rows": 6, "square_mm": 30.0}
    picture = np.random.default_rng(1).uniform(size=(200, 300))
    with pytest.raises(handeye.InputError, match="multiply it by 255"):
        handeye.detect(picture, target)
    assert not handeye.detect(255 * picture, target).found


def test_counts_out_of_range_are_named(tmp_path):
    for name in ("captures", "width", "height", "seed"):
        with pytest.raises(handeye.InputError, match=f"{name} is -1"):
            handeye.simulate(tmp_path / "cell", **{name: -1})
    points = np.random.default_rng(1).uniform(size=(100, 3))
    for name in ("max_iterations", "threads"):
        with pytest.raises(handeye.InputError, match=f"{name} is 0"):
            handeye.register(points, points, **{name: 0})


def test_methods_name_their_papers():
    assert handeye.METHODS["park-martin"] == "F. Park, B. Martin, 1994"
    assert all(who.endswith(tuple("0123456789")) for who in handeye.METHODS.values())


@pytest.mark.parametrize("seed", range(8))
def test_a_calibration_that_was_pickled_is_the_same(seed):
    found = handeye.solve(*cell(12, seed=seed), setup="eye-in-hand")
    again = pickle.loads(pickle.dumps(found))
    assert again == found and again.to_json() == found.to_json()
    assert handeye.Calibration.from_dict(found.to_dict()) == found


def test_repeated_poses_count_once():
    robot, camera = cell(10)
    once = handeye.solve(robot, camera, setup="eye-in-hand")
    found = handeye.solve(np.repeat(robot, 5, 0), np.repeat(camera, 5, 0), setup="eye-in-hand")
    assert np.allclose(found.covariance, once.covariance) and np.allclose(found.pose.matrix, once.pose.matrix)
    assert any("repeat others" in warning for warning in found.warnings)


def test_another_unit_of_one_side_is_named():
    robot, camera = cell(12)
    camera[:, :3, 3] *= 1000
    found = handeye.solve(robot, camera, setup="eye-in-hand")
    assert found.verdict == "rejected" and "were millimetres read as metres?" in found.reasons[0]


def test_a_known_position_makes_up_for_a_robot_of_one_axis():
    robot, camera = about_one_axis()
    open_one = handeye.solve(robot, camera, setup="eye-in-hand")
    assert open_one.verdict == "undetermined" and "`known_position`" in open_one.reasons[0]
    height = 1e3 * X[2, 3]
    found = handeye.solve(robot, camera, setup="eye-in-hand", known_position=([0, 0, 1], height, 0.5))
    assert found.pose is not None and abs(1e3 * found.pose.translation[2] - height) < 0.1
    assert 0.4 < 1e3 * np.sqrt(found.covariance[3:, 3:].diagonal().sum()) < 2
    for bad in (([0, 0, 0], 1, 1), ([0, 0, 1], 1, 0), ([0, 0, 1], float("nan"), 1)):
        with pytest.raises(handeye.InputError, match="known_position"):
            handeye.solve(robot, camera, setup="eye-in-hand", known_position=bad)
