"""A live session: images and poses are pushed, and each is assessed at once."""

import csv
import json
import subprocess
import sys
import threading
import time

import cv2
import numpy as np
import pytest

import handeye
from handeye import Pose

BOARD = {"kind": "checkerboard", "columns": 9, "rows": 6, "square_mm": 30.0}
SIZE = {"width": 640, "height": 400}
K = np.array([[600.0, 0.0, 319.5], [0.0, 600.0, 199.5], [0.0, 0.0, 1.0]])
DECLARED = {"setup": "eye-in-hand", "target": BOARD, "intrinsics": K, "tolerance_mm": 2.0}


@pytest.fixture(scope="module")
def shots(tmp_path_factory):
    """Images (paths) and poses of a simulated cell."""
    folder = tmp_path_factory.mktemp("cell")
    handeye.simulate(folder, captures=10, target=BOARD, scans=True, **SIZE)
    with open(folder / "robot.csv", encoding="utf-8") as table:
        rows = [[float(x) for x in row[1:]] for row in list(csv.reader(table))[1:]]
    poses = handeye.poses_from(rows, "quaternion-xyzw", length_unit="m")
    images = sorted((folder / "images").iterdir())
    scans = sorted((folder / "scans").iterdir())
    truth = json.loads((folder / "truth.json").read_text("utf-8"))["mount_from_camera"]
    return images, poses, scans, Pose.from_dict({**truth, "to": "flange"})


def array_of(path):
    return cv2.imread(str(path), cv2.IMREAD_GRAYSCALE)


def points_of(path):
    """The points of a simulated scan, 400 x 640 x 3 (m)."""
    content = path.read_bytes()
    points = content[content.index(b"end_header") + len(b"end_header\n") :]
    return np.frombuffer(points, "<f4").reshape(400, 640, 3)


def ids(state):
    return [capture["id"] for capture in state.captures]


def test_a_whole_calibration_is_pushed(shots, tmp_path):
    images, poses, _, truth = shots
    folder = tmp_path / "cell"
    with handeye.Session(folder, notation="kuka", **DECLARED) as session:
        assert session.state.verdict == "undetermined" and session.state.error_mm is None
        assert "take the first capture" in session.state.sentence and session.state.next_pose is None
        for number, (image, pose) in enumerate(zip(images, poses), 1):
            # as an array, a path, a matrix and the numbers of the robot
            given = image if number % 2 else array_of(image)
            there = [pose, pose.matrix, handeye.poses_to([pose], "kuka")[0]][number % 3]
            state = session.push(given, there)
            assert (state.capture, state.refused) == (f"{number:03}", None)
            if state.enough:
                break
        assert state.enough and 0.0 < state.error_mm <= state.tolerance_mm == 2.0
        assert state.sentence.startswith("Enough") and state.problem is None and state.verdict == "accepted"
        assert state.mount_from_camera.name == "flange_from_camera"
        assert np.linalg.norm(state.mount_from_camera.translation - truth.translation) < 2e-3
        assert [c["used"] for c in session.captures] == [True] * number
        assert all(set(finding) >= {"code", "severity", "message"} for finding in state.findings)
        assert "95 %" in repr(state)
        found = session.finish()
    assert isinstance(found, handeye.Calibration) and found.accepted and len(found.captures) == number
    written = (folder / "result" / "calibration.json").read_bytes()
    assert handeye.Calibration.load(folder / "result" / "calibration.json") == found
    assert "data:image" in found.report(tmp_path / "page.html").read_text("utf-8")

    # the folder is an ordinary dataset
    again = handeye.calibrate(folder, out=tmp_path / "again")
    assert again.to_json() == found.to_json()
    command = [sys.executable, "-m", "handeye", "calibrate", str(folder), "--out", str(tmp_path / "by_command"), "--quiet"]
    subprocess.run(command, check=True, capture_output=True)
    for name in ("calibration.json", "report.html"):
        assert (tmp_path / "by_command" / name).read_bytes() == (folder / "result" / name).read_bytes()
    assert (tmp_path / "by_command" / "calibration.json").read_bytes() == written
    assert (folder / "images" / "001.png").read_bytes() == images[0].read_bytes()


def test_the_next_pose_is_that_of_the_notation(shots, tmp_path):
    images, poses, _, _ = shots
    with handeye.Session(tmp_path / "cell", **{**DECLARED, "tolerance_mm": 0.05}, notation="abb") as session:
        states = [session.push(image, pose) for image, pose in zip(images[:6], poses[:6])]
        state = states[-1]
        assert not state.enough and state.next_pose.name == "base_from_flange" and state.next_reason
        assert list(state.next_numbers)[:3] == ["x", "y", "z"] and len(state.next_numbers) == 7
        row = list(state.next_numbers.values())
        assert np.allclose(handeye.poses_from([row], "abb")[0].matrix, state.next_pose.matrix, atol=1e-9)
        skipped = session.skip()
        assert not np.allclose(skipped.next_pose.matrix, state.next_pose.matrix, atol=1e-3)


def test_a_session_goes_on_after_it_was_closed(shots, tmp_path):
    images, poses, _, _ = shots
    session = handeye.Session(tmp_path / "cell", **DECLARED)
    for image, pose in zip(images[:5], poses[:5]):
        state = session.push(image, pose)
    with pytest.raises(handeye.InputError, match="in use by another session"):
        handeye.Session(tmp_path / "cell")
    with pytest.raises(handeye.InputError, match="in use by another session"):
        handeye.Session(tmp_path / "cell", **DECLARED)
    session.close()
    session.close()
    for closed in (lambda: session.push(images[5], poses[5]), lambda: session.state, session.finish, session.undo):
        with pytest.raises(handeye.InputError, match="closed: open its folder again"):
            closed()

    with handeye.Session(tmp_path / "cell") as session:
        assert session.state.error_mm == state.error_mm and ids(session.state) == ids(state)
        assert session.push(images[5], poses[5]).capture == "006"
        deleted = session.delete("002")
        assert deleted.deleted == ["002"] and ids(deleted) == ["001", "003", "004", "005", "006"]
        assert not (tmp_path / "cell" / "images" / "002.png").exists()
        assert ids(session.restore("002")) == ["001", "002", "003", "004", "005", "006"]
        assert ids(session.undo()) == ids(deleted)
        for wrong, said in [
            (lambda: session.delete("002"), "no capture 002"),
            (lambda: session.restore("001"), "no deleted capture 001"),
        ]:
            with pytest.raises(handeye.InputError, match=said):
                wrong()
    with pytest.raises(handeye.InputError, match="new folder"):
        handeye.Session(tmp_path / "cell", setup="eye-to-hand")
    # what is said again may be said
    with handeye.Session(tmp_path / "cell", **{**DECLARED, "tolerance_mm": 1.0}) as session:
        assert session.state.tolerance_mm == 1.0 and len(session.captures) == 5


def test_an_image_without_the_board_is_a_state_and_nothing_is_lost(shots, tmp_path):
    images, poses, _, _ = shots
    dark = np.full((400, 640), 20, np.uint8)
    with handeye.Session(tmp_path / "cell", **DECLARED) as session:
        first = session.push(dark, poses[0])
        assert first.capture is None and "not found" in first.refused and first.captures == []
        assert session.push(images[0], poses[0]).capture == "001"
        state = session.push(dark, poses[1])
        assert state.capture is None and "not found" in state.refused and ids(state) == ["001"]
        assert "no capture was taken" in state.problem
        state = session.push(images[1], poses[1])
        assert state.capture == "002" and state.refused is None and state.problem is None


def test_what_cannot_be_is_refused(shots, tmp_path):
    images, poses, _, _ = shots
    image, pose = array_of(images[0]), poses[0]
    in_mm = pose.matrix.copy()
    in_mm[:3, 3] *= 1000
    mirrored = pose.matrix @ np.diag([1.0, 1.0, -1.0, 1.0])
    numbers = handeye.poses_to([pose], "kuka")[0]
    turned = np.full((400, 640, 5), 20, np.uint8)
    with handeye.Session(tmp_path / "cell", notation="kuka", **DECLARED) as session:
        for wrong_image, wrong_pose, said in [
            (image, in_mm, "are its lengths in another unit"),
            (image, numbers / 1000, "are its lengths in another unit"),
            (image, numbers[:5], "5 numbers"),
            (image, [*numbers[:5], np.nan], "finite"),
            (image, pose.matrix[:3], "4 x 4"),
            (image, np.zeros((2, 4, 4)), "4 x 4"),
            (image, mirrored, "mirror|determinant"),
            (image, pose.inverse(), "flange_from_base: base_from_flange is needed"),
            (image, "X up Y down", "something else than numbers"),
            (image, ["x", "y"], "list of the notation's numbers"),
            (image, None, "4 x 4|finite"),
            (turned, pose, r"H x W"),
            (image.astype(np.int32), pose, "uint8"),
            (image / 255.0, pose, "multiply it by 255"),
            (image[:200], pose, "images have 640 x 200 pixels, the intrinsics are for 640 x 400"),
            ("nowhere.png", pose, "does not exist"),
            (None, pose, "array"),
            (tmp_path / "cell" / "handeye.toml", pose, "handeye.toml"),
        ]:
            if said == "images have 640 x 200 pixels, the intrinsics are for 640 x 400":
                # a matrix does not say the size of its images: the first one does
                assert session.push(image, pose).capture == "001"
            with pytest.raises(handeye.InputError, match=said):
                session.push(wrong_image, wrong_pose)
        with pytest.raises(handeye.InputError, match="the pose was not read anew"):
            session.push(images[3], pose)
        assert ids(session.state) == ["001"]
        # as the pendant shows it
        numbers = handeye.poses_to([poses[1]], "kuka")[0]
        text = "; ".join(f"{name} = {x:.6f}" for name, x in zip("XYZABC", numbers))
        state = session.push(images[1], text)
        assert state.capture == "002"
        at = Pose.from_dict(state.captures[1]["base_from_flange"])
        assert np.allclose(at.matrix, poses[1].matrix, atol=1e-6)


def test_what_is_declared_wrongly_is_refused(tmp_path):
    (tmp_path / "mine").mkdir()
    (tmp_path / "mine" / "notes.txt").write_text("mine")
    for folder, other, said in [
        ("a", {"target": None}, "setup and target"),
        ("a", {"setup": None}, "setup and target"),
        ("a", {"setup": "eye on hand"}, "eye-in-hand"),
        ("a", {"target": {"kind": "chess"}}, "chess"),
        ("a", {"target": "nowhere.toml"}, "nowhere.toml"),
        ("a", {"intrinsics": np.eye(4)}, "3 x 3"),
        ("a", {"intrinsics": {"fx": 600, "focal_sigma_px": 1.0}}, "standard deviations"),
        ("a", {"intrinsics": "nowhere.yaml"}, "nowhere.yaml"),
        ("a", {"tolerance_mm": -1.0}, "positive"),
        ("a", {"notation": "robo"}, "notation 'robo'|notation \"robo\""),
        ("mine", {}, "empty or a new folder"),
    ]:
        with pytest.raises(handeye.InputError, match=said):
            handeye.Session(tmp_path / folder, **{**DECLARED, **other})
    assert not (tmp_path / "a").exists()
    assert [file.name for file in (tmp_path / "mine").iterdir() if not file.name.startswith(".")] == ["notes.txt"]


def test_scans_go_along(shots, tmp_path):
    images, poses, scans, _ = shots
    cloud = np.full((400, 640, 3), np.nan, np.float32)
    with handeye.Session(tmp_path / "cell", **DECLARED) as session:
        for image, pose, scan in zip(images[:4], poses[:4], scans[:4]):
            state = session.push(image, pose, scan=scan)
        assert all(capture["corners_3d"] > 30 for capture in state.captures)
        with pytest.raises(handeye.InputError, match="the scan has the shape"):
            session.push(images[4], poses[4], scan=cloud[:, :, :2])
        with pytest.raises(handeye.InputError, match="a scan each"):
            session.push(images[4], poses[4])
        points = points_of(scans[4])
        assert session.push(images[4], poses[4], scan=points).capture == "005"
    again = handeye.calibrate(tmp_path / "cell")
    assert [capture["corners_3d"] > 30 for capture in again.captures] == [True] * 5
    with handeye.Session(tmp_path / "other", **DECLARED) as session:
        session.push(images[0], poses[0])
        with pytest.raises(handeye.InputError, match="have no scans"):
            session.push(images[1], poses[1], scan=points)


def touched_cell(folder, setup, captures):
    """Captures of a simulated cell (image, pose), and its touches (placement, corner, pose)."""
    handeye.simulate(folder, captures=captures, target=BOARD, setup=setup, **SIZE)
    rows = {}
    for name in ("robot.csv", "touches.csv"):
        with open(folder / name, encoding="utf-8") as table:
            rows[name] = list(csv.reader(table))[1:]
    poses = handeye.poses_from([[float(x) for x in row[-7:]] for row in rows["robot.csv"]], "quaternion-xyzw", length_unit="m")
    at = handeye.poses_from([[float(x) for x in row[-7:]] for row in rows["touches.csv"]], "quaternion-xyzw", length_unit="m")
    shots = [(folder / "images" / f"{number + 1:03}.png", pose) for number, pose in enumerate(poses)]
    return shots, [(row[0], int(row[1]), pose) for row, pose in zip(rows["touches.csv"], at)]


TIP_MM = (4.0, -7.0, 182.0)


def test_corners_are_touched(tmp_path):
    shots, touches = touched_cell(tmp_path / "seen", "eye-in-hand", 5)
    with handeye.Session(tmp_path / "cell", **DECLARED) as session:
        with pytest.raises(handeye.InputError, match="first captures are taken"):
            session.touch(touches[0][2])
        for shot in shots:
            before = session.push(*shot)
        assert before.touch is None and before.touches == [] and before.next_corner in range(54)
        with pytest.raises(handeye.InputError, match="where the tool's tip is"):
            session.touch(touches[0][2], corner=touches[0][1])
        with pytest.raises(handeye.InputError, match="no other one is laid down"):
            session.place(shots[0][0])
    for tip, said in [((1.0, 2.0), "three numbers"), (182.0, "three numbers"), ("123", "three numbers"), ((0.0, 0.0, 0.0), "not zero"), ((0.0, 0.0, np.inf), "not more than 2 m")]:
        with pytest.raises(handeye.InputError, match=said):
            handeye.Session(tmp_path / "cell", tip_mm=tip)
    with handeye.Session(tmp_path / "cell", tip_mm=TIP_MM) as session:
        for number, (_, corner, pose) in enumerate(touches[:5], 1):
            state = session.touch(pose, corner=corner)
            assert (state.touch, state.capture) == (f"t{number:02}", None)
        assert [touch["corner"] for touch in state.touches] == [corner for _, corner, _ in touches[:5]]
        assert all(touch["used"] and touch["residual_mm"] < 2.0 for touch in state.touches)
        assert state.next_corner not in [corner for _, corner, _ in touches[:5]]
        assert state.error_mm < before.error_mm
        with pytest.raises(handeye.InputError, match="the robot's pose is that of the touch t05"):
            session.push(shots[0][0], touches[4][2])
        in_mm = touches[5][2].matrix.copy()
        in_mm[:3, 3] *= 1000
        for pose, corner, said in [
            (touches[4][2], None, "still where it touched corner"),
            (touches[5][2], 54, "no corner 54"),
            (touches[5][2], -1, "no corner -1"),
            (touches[5][2], True, "no corner True"),
            (touches[5][2], "3", "no corner '3'"),
            (shots[4][1], 3, "the robot's pose is that of capture 005"),
            (in_mm, 3, "are its lengths in another unit"),
            (None, 3, "4 x 4|finite"),
        ]:
            with pytest.raises(handeye.InputError, match=said):
                session.touch(pose, corner=corner)
        assert session.untouch("t02").deleted == ["t02"] and len(session.state.touches) == 4
        with pytest.raises(handeye.InputError, match="no touch t02"):
            session.untouch("t02")
        assert len(session.undo().touches) == 5
        found = session.finish()
    again = handeye.calibrate(tmp_path / "cell", out=tmp_path / "again")
    assert again.to_json() == found.to_json()
    assert [touch["used"] for touch in found.to_dict()["touches"]] == [True] * 5


def test_boards_are_laid_down_for_a_camera_beside_the_robot(tmp_path):
    shots, touches = touched_cell(tmp_path / "seen", "eye-to-hand", 5)
    declared = {**DECLARED, "setup": "eye-to-hand", "tip_mm": TIP_MM}
    with handeye.Session(tmp_path / "cell", **declared) as session:
        for shot in shots:
            session.push(*shot)
        with pytest.raises(handeye.InputError, match="cannot touch the board that it carries"):
            session.touch(touches[0][2], corner=touches[0][1])
        unseen = session.place(np.full((400, 640), 20, np.uint8))
        assert unseen.placement is None and "not found" in unseen.refused
        with pytest.raises(handeye.InputError, match="the board that the robot carries"):
            session.place(shots[2][0], pose=shots[2][1])
        for number in (1, 2):
            image = tmp_path / "seen" / "images" / f"place-{number}.png"
            assert session.place(array_of(image)).placement == f"p{number:02}"
            with pytest.raises(handeye.InputError, match="still lies as in placement"):
                session.place(image)
            for _, corner, pose in [touch for touch in touches if touch[0] == f"place-{number}"]:
                state = session.touch(pose, corner=corner)
        assert [touch["placement"] for touch in state.touches] == ["p01"] * 4 + ["p02"] * 4
        assert all(touch["used"] and touch["residual_mm"] < 3.0 for touch in state.touches)
        found = session.finish()
        assert len(session.delete("p01").touches) == 4 and len(session.restore("p01").touches) == 8
    assert handeye.calibrate(tmp_path / "cell").to_json() == found.to_json()


def test_a_capture_is_taken_again(shots, tmp_path):
    images, poses, _, _ = shots
    with handeye.Session(tmp_path / "cell", **DECLARED) as session:
        for image, pose in zip(images[:5], poses[:5]):
            session.push(image, pose)
        state = session.retake("003")
        assert state.deleted == ["003"] and np.allclose(state.next_pose.matrix, poses[2].matrix, atol=1e-9)
        with pytest.raises(handeye.InputError, match="no capture 003"):
            session.retake("003")
        assert session.push(images[2], poses[2]).capture == "006"


def test_a_camera_without_intrinsics_is_calibrated_on_the_way(shots, tmp_path):
    images, poses, _, truth = shots
    with handeye.Session(tmp_path / "cell", setup="eye-in-hand", target=BOARD, tolerance_mm=3.0) as session:
        for image, pose in zip(images, poses):
            state = session.push(image, pose)
        with pytest.raises(handeye.InputError, match="those before it have 640 x 400"):
            session.push(np.zeros((300, 400), np.uint8), poses[0])
        found = session.finish()
    assert state.enough and found.accepted
    assert np.linalg.norm(found.pose.translation - truth.translation) < 5e-3


def test_a_result_is_written_whatever_its_verdict(shots, tmp_path):
    images, poses, _, _ = shots
    with handeye.Session(tmp_path / "cell", **DECLARED) as session:
        with pytest.raises(handeye.InputError, match="no captures yet"):
            session.finish()
        session.push(images[0], poses[0])
        found = session.finish()
        assert found.verdict == "undetermined" and (tmp_path / "cell" / "result" / "report.html").exists()
        assert session.push(images[1], poses[1]).capture == "002"


def test_other_threads_run_and_pushes_take_turns(shots, tmp_path):
    images, poses, _, _ = shots
    ticks, done = [], threading.Event()

    def tick():
        while not done.is_set():
            ticks.append(time.perf_counter())
            time.sleep(0.001)

    with handeye.Session(tmp_path / "cell", **DECLARED) as session:
        threads = [threading.Thread(target=session.push, args=shot) for shot in zip(images[:3], poses[:3])]
        ticking = threading.Thread(target=tick)
        for thread in [ticking, *threads]:
            thread.start()
        for thread in threads:
            thread.join()
        done.set()
        ticking.join()
        assert ids(session.state) == ["001", "002", "003"]
    assert len(ticks) > 20


INTERRUPTED = """
import _thread, json, signal, sys, threading
import handeye
# a shell has its background jobs ignore it
signal.signal(signal.SIGINT, signal.default_int_handler)
folder, board, images, poses = json.loads(sys.argv[1])
session = handeye.Session(folder, setup="eye-in-hand", target=board)
threading.Timer(0.4, _thread.interrupt_main).start()
try:
    for image, pose in zip(images, poses):
        session.push(image, pose)
    print("finished")
except KeyboardInterrupt:
    print("interrupted", len(session.captures))
"""


def test_ctrl_c_leaves_a_folder_that_can_be_used(shots, tmp_path):
    images, poses, _, _ = shots
    files, matrices = [str(image) for image in images] * 3, [pose.matrix.tolist() for pose in poses] * 3
    given = json.dumps([str(tmp_path / "cell"), BOARD, files, matrices])
    command = [sys.executable, "-c", INTERRUPTED, given]
    run = subprocess.run(command, capture_output=True, text=True, timeout=300)
    word, count = run.stdout.split()
    assert word == "interrupted", run.stdout + run.stderr
    with handeye.Session(tmp_path / "cell") as session:
        assert len(session.captures) == int(count)
        assert len(list((tmp_path / "cell" / "images").iterdir())) == int(count)
