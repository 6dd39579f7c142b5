"""ROS bags that another writer wrote: whole, cut, without an index, with noise in them."""

import json
import shutil
import signal
import struct
import subprocess
import sys
import time

import numpy as np
import pytest
from bags import CAMERA, START, WORLD_FROM_BASE, Bag, Cell, off, quaternion, record_moving, record_still, smooth

import handeye

FRAMES = {"base": "base_link", "flange": "tool0"}
BOARD = {"kind": "checkerboard", "columns": 9, "rows": 6, "square_mm": 30.0}
KINDS = ["mcap", "sqlite", "ros1"]
COUNT = 9
SMALL = {"width": 480, "height": 300}


@pytest.fixture(scope="module")
def cell(tmp_path_factory):
    folder = tmp_path_factory.mktemp("still") / "cell"
    handeye.simulate(folder, captures=COUNT, scans=True, **SMALL)
    return Cell(folder)


@pytest.fixture(scope="module")
def bags(cell, tmp_path_factory):
    """One bag of each kind: pictures packed or not, depth images or clouds beside them or none."""
    folder = tmp_path_factory.mktemp("bags")
    paths = {kind: folder / (f"{kind}.bag" if kind == "ros1" else kind) for kind in KINDS}
    record_still(cell, paths["mcap"], "mcap", depth="depth")
    record_still(cell, paths["sqlite"], "sqlite", depth="cloud")
    record_still(cell, paths["ros1"], "ros1", packed=True)
    return paths


def file_of(bag):
    return bag if bag.is_file() else next(p for p in bag.iterdir() if p.suffix in (".mcap", ".db3"))


def extract(bag, out, **options):
    return handeye.extract_bag(bag, out, setup="eye-in-hand", target=BOARD, **{**FRAMES, **options})


def error_of(calibration, cell):
    assert calibration.accepted, calibration.reasons
    return off(json.loads(calibration.to_json()), cell.truth)


@pytest.mark.parametrize("kind", KINDS)
def test_a_robot_that_stops_for_its_pictures(kind, bags, cell, tmp_path):
    contents = handeye.bag_contents(bags[kind])
    assert contents.broken == []
    pictures = [t for t in contents.topics.values() if t.type.endswith("Image") and t.frame]
    assert pictures and all(p.messages > COUNT for p in pictures)
    assert [line.strip() for line in contents.frames][:1] == ["world"]
    done = extract(bags[kind], tmp_path / "out")
    assert (done.captures, done.moving, done.questions) == (COUNT, False, [])
    mm, degrees = error_of(handeye.calibrate(tmp_path / "out"), cell)
    assert mm < 1.0 and degrees < 0.1
    has_scans = kind != "ros1"
    assert (tmp_path / "out" / "scans").is_dir() == has_scans


def test_poses_are_interpolated_to_the_time_of_the_picture(bags, cell, tmp_path):
    """Where the robot stands still, its pose is that of the cell."""
    extract(bags["mcap"], tmp_path / "out")
    rows = np.genfromtxt(tmp_path / "out" / "robot.csv", delimiter=",", skip_header=1)[:, 1:]
    for row, pose in zip(rows, cell.poses):
        found = handeye.Pose("base", "flange", rotation=row[3:], translation=row[:3]).matrix
        assert np.abs(found - pose).max() < 1e-6


@pytest.mark.parametrize("kind", KINDS)
def test_a_bag_that_ends_too_early_is_read_as_far_as_it_goes(kind, bags, cell, tmp_path):
    whole = file_of(bags[kind])
    cut = tmp_path / f"cut{whole.suffix}"
    cut.write_bytes(whole.read_bytes()[: int(0.7 * whole.stat().st_size)])
    assert len(handeye.bag_contents(cut).broken) == 1
    done = extract(cut, tmp_path / "out", motion="still")
    assert COUNT // 2 <= done.captures < COUNT
    assert any("cut" in note for note in done.notes), done.notes
    rows = np.genfromtxt(tmp_path / "out" / "robot.csv", delimiter=",", skip_header=1)[:, 1:]
    assert np.abs(rows[:, :3] - [p[:3, 3] for p in cell.poses[: len(rows)]]).max() < 1e-6


def test_an_index_is_not_needed(bags, tmp_path):
    """As `rosbag record` leaves a bag that it could not close: no index, and its place is 0."""
    data = bytearray(bags["ros1"].read_bytes())
    place = data.index(b"index_pos=") + 10
    (end,) = struct.unpack("<Q", data[place : place + 8])
    data[place : place + 8] = bytes(8)
    (tmp_path / "unindexed.bag").write_bytes(data[:end])
    assert extract(tmp_path / "unindexed.bag", tmp_path / "a").captures == COUNT
    extract(bags["ros1"], tmp_path / "b")
    same = [(tmp_path / f / "robot.csv").read_text() for f in "ab"]
    assert same[0] == same[1]
    # MCAP: the summary behind the data is where its index is
    whole = file_of(bags["mcap"]).read_bytes()
    (summary,) = struct.unpack("<Q", whole[-28:-20])
    (tmp_path / "unindexed.mcap").write_bytes(whole[:summary])
    assert extract(tmp_path / "unindexed.mcap", tmp_path / "c").captures == COUNT


@pytest.mark.parametrize("kind", KINDS)
def test_noise_in_a_bag_is_an_error_or_a_note(kind, bags, tmp_path):
    whole = file_of(bags[kind])
    random = np.random.default_rng(1)
    for k in range(6):
        data = bytearray(whole.read_bytes())
        at = int(random.integers(100, len(data) - 4000))
        data[at : at + 4000] = random.bytes(4000)
        noisy = tmp_path / f"noisy{k}{whole.suffix}"
        noisy.write_bytes(data)
        try:
            done = extract(noisy, tmp_path / f"out{k}", motion="still")
        except handeye.InputError as error:
            assert "noisy" in str(error)
            continue
        assert done.captures <= COUNT
        noisy.unlink()


@pytest.mark.parametrize("mode", ["message", "file"])
def test_what_the_recorder_packed(mode, cell, tmp_path):
    record_still(cell, tmp_path / "bag", "sqlite", packing=mode)
    assert extract(tmp_path / "bag", tmp_path / "out").captures == COUNT


def test_nothing_is_interpolated_over_a_gap(cell, tmp_path):
    record_still(cell, tmp_path / "bag", "mcap", gap=(3, 4))
    done = extract(tmp_path / "bag", tmp_path / "out")
    assert done.captures == COUNT - 2
    assert any("gap" in note or "pause" in note for note in done.notes), done.notes


@pytest.fixture(scope="module")
def arm(tmp_path_factory):
    folder = tmp_path_factory.mktemp("arm") / "cell"
    handeye.simulate(folder, captures=14, arm=True, **SMALL)
    return folder


def test_joint_values_and_a_model_are_as_good_as_the_arm_of_the_manifest(arm, tmp_path):
    record_still(Cell(arm), tmp_path / "bag", "mcap")
    done = extract(tmp_path / "bag", tmp_path / "out", joints=True)
    assert done.captures == 14
    manifest = (arm / "handeye.toml").read_text().split("[touches]")[0]
    (arm / "untouched.toml").write_text(manifest)
    found, direct = (handeye.calibrate(p) for p in (tmp_path / "out", arm / "untouched.toml"))
    apart = found.pose.inverse() @ direct.pose
    assert np.abs(apart.matrix - np.eye(4)).max() < 1e-6
    with pytest.raises(handeye.InputError, match="link_9"):
        extract(tmp_path / "bag", tmp_path / "wrong", joints=True, flange="link_9")


@pytest.fixture(scope="module")
def many(tmp_path_factory):
    folder = tmp_path_factory.mktemp("many") / "cell"
    handeye.simulate(folder, captures=60, **SMALL)
    return Cell(folder)


@pytest.mark.parametrize("offset_s", [0.0, 0.08])
def test_a_robot_that_never_stops(offset_s, many, tmp_path):
    record_moving(many, tmp_path / "bag", "mcap", offset_s=offset_s)
    done = extract(tmp_path / "bag", tmp_path / "out")
    assert done.moving and done.captures > 50
    calibration = handeye.calibrate(tmp_path / "out")
    mm, degrees = error_of(calibration, many)
    assert mm < 1.5 and degrees < 0.15
    assert abs(calibration.to_dict()["time_offset_s"] - offset_s) < 1e-3


def test_pictures_in_a_gap_of_the_motion_are_left_out(many, tmp_path):
    record_moving(many, tmp_path / "bag", "sqlite", gap=(10, 14))
    done = extract(tmp_path / "bag", tmp_path / "out")
    assert done.moving and 45 < done.captures < 55
    assert any("gap" in note for note in done.notes), done.notes


def test_what_a_bag_lacks_is_named(bags, tmp_path):
    bag, out = bags["mcap"], tmp_path / "out"
    for options, match in [
        ({"flange": "tool1"}, "tool0"),
        ({"base": None, "flange": None}, "bag_contents"),
        ({"image": "/foo"}, "/camera/color/image_raw"),
        ({"joints": True}, "--urdf FILE"),
        ({"motion": "slow"}, "moving"),
        ({"pose": "/pose", "base": None, "flange": None}, "no poses on /pose"),
    ]:
        with pytest.raises(handeye.InputError, match=match):
            extract(bag, out, **options)
    assert not out.exists() and not list(tmp_path.iterdir())
    extract(bag, out)
    with pytest.raises(handeye.InputError, match="is there already"):
        extract(bag, out)
    for name in ["x.mcap", "x.db3", "x.bag", "x.txt"]:
        (tmp_path / name).write_bytes(b"hello")
        with pytest.raises(handeye.InputError, match=name):
            handeye.bag_contents(tmp_path / name)
    with pytest.raises(handeye.InputError, match="nothing.bag"):
        handeye.bag_contents(tmp_path / "nothing.bag")


def poses_of(folder):
    rows = np.genfromtxt(folder / "robot.csv", delimiter=",", skip_header=1)[:, 1:]
    return [handeye.Pose("base", "flange", rotation=r[3:], translation=r[:3]).matrix for r in rows]


def places_of(poses, cell):
    """Of each pose, the place of the cell that it is nearest to, and how far that is (m)."""
    away = np.array([[np.linalg.norm(p[:3, 3] - q[:3, 3]) for q in cell.poses] for p in poses])
    return away.argmin(axis=1), away.min(axis=1)


def pose_message(bag, topic, stamp, pose):
    kind = bag.type("geometry_msgs/msg/Pose")
    point, quaternion_of = bag.type("geometry_msgs/msg/Point"), bag.type("geometry_msgs/msg/Quaternion")
    x, y, z, w = (float(v) for v in quaternion(pose))
    value = kind(position=point(*(float(v) for v in pose[:3, 3])), orientation=quaternion_of(x=x, y=y, z=z, w=w))
    bag.add(topic, "geometry_msgs/msg/PoseStamped", stamp, header=bag.header(stamp, "base"), pose=value)


def test_many_pictures_of_one_place_are_one(bags, cell, tmp_path):
    """Else they would count as independent, and the answer as surer than it is."""
    done = extract(bags["mcap"], tmp_path / "out", motion="moving")
    times = np.genfromtxt(tmp_path / "out" / "times.csv", delimiter=",", skip_header=1)[:, 1]
    stream = np.genfromtxt(tmp_path / "out" / "robot.csv", delimiter=",", skip_header=1)
    at = np.array([np.interp(times, stream[:, 0], stream[:, k]) for k in (1, 2, 3)]).T
    assert done.captures == len(times) and np.linalg.norm(np.diff(at, axis=0), axis=1).min() > 5e-4


@pytest.mark.parametrize("later_ms", [1, 30])
def test_a_pose_and_a_picture_at_each_stop(later_ms, cell, tmp_path):
    """Five seconds apart nothing can be interpolated, and nobody sees that the robot stood still but who was there."""
    bag = Bag(tmp_path / "bag", "mcap")
    bag.camera("/camera_info", START, CAMERA, cell.size, cell.k, [0.0] * 5)
    for k, pose in enumerate(cell.poses):
        pose_message(bag, "/pose", START + 5 * k * 10**9, pose)
        bag.picture("/image", START + 5 * k * 10**9 + later_ms * 10**6, CAMERA, cell.images[k])
    bag.close()
    poses = {"base": None, "flange": None, "pose": "/pose"}
    with pytest.raises(handeye.InputError, match="--motion still"):
        extract(tmp_path / "bag", tmp_path / "out", **poses)
    done = extract(tmp_path / "bag", tmp_path / "out", motion="still", **poses)
    assert done.captures == COUNT and any("nearest pose" in note for note in done.notes)
    assert np.abs(np.array(poses_of(tmp_path / "out")) - cell.poses).max() < 1e-9


def test_a_scan_taken_on_the_way_belongs_to_no_picture(cell, tmp_path):
    bag = Bag(tmp_path / "bag", "mcap")
    bag.camera("/camera/camera_info", START, CAMERA, cell.size, cell.k, [0.0] * 5)
    now = START
    for k in range(COUNT):
        for tick in range(100 if k + 1 < COUNT else 60):
            pose = cell.poses[k] if tick < 60 else cell.step(k, smooth((tick - 60) / 40))[0]
            bag.transforms("/tf", now, [bag.transform(now, "base_link", "tool0", pose)])
            if tick in (20, 40):
                bag.picture("/camera/image_raw", now, CAMERA, cell.images[k])
            if tick == 80 or k < 3 and tick == 50:
                bag.cloud("/camera/points", now, CAMERA, cell.clouds[k])
            now += 20_000_000
    bag.close()
    done = extract(tmp_path / "bag", tmp_path / "out")
    assert done.captures == COUNT and any("only 3 of 9" in note for note in done.notes), done.notes
    assert not (tmp_path / "out" / "scans").exists()
    assert extract(tmp_path / "bag", tmp_path / "asked", depth="/camera/points").captures == 3


def test_frames_between_which_nothing_moves_are_refused(bags, tmp_path):
    for frames in [{"flange": "world"}, {"base": "wrist"}]:
        with pytest.raises(handeye.InputError, match="never moves"):
            extract(bags["mcap"], tmp_path / "out", **frames)


def test_what_is_wrong_with_one_sender_does_not_spoil_the_rest(cell, tmp_path):
    bag = Bag(tmp_path / "bag", "mcap")
    bag.camera("/camera_info", START, "another_camera", cell.size, [[800, 0, 1], [0, 800, 1], [0, 0, 1]], [0.0] * 5)
    bag.camera("/calibrated", START, CAMERA, cell.size, cell.k, [0.0] * 5)
    now = START
    for k in range(COUNT):
        for tick in range(60 if k + 1 == COUNT else 100):
            pose = cell.poses[k] if tick < 60 else cell.step(k, smooth((tick - 60) / 40))[0]
            lost = bag.transform(now, "base_link", "lost", pose)
            lost.transform.rotation.w = lost.transform.rotation.x = 0.0
            bag.transforms("/tf", now, [lost, bag.transform(now, "base_link", "tool0", pose)])
            for above in ["map", "world"]:
                bag.transforms("/tf", now, [bag.transform(now, above, "base_link", WORLD_FROM_BASE)])
            if tick == 30:
                bag.picture("/camera/image_raw", now, CAMERA, cell.images[k])
            now += 20_000_000
    bag.close()
    done = extract(tmp_path / "bag", tmp_path / "out")
    assert done.captures == COUNT
    assert any("cannot be read" in note and "lost" in note for note in done.notes), done.notes
    assert any("--camera-info" in note and "/calibrated" in note for note in done.notes), done.notes
    named = extract(tmp_path / "bag", tmp_path / "named", camera_info="/calibrated")
    assert named.questions == []
    mm, degrees = error_of(handeye.calibrate(tmp_path / "named"), cell)
    assert mm < 1.0 and degrees < 0.1


def test_a_robot_on_two_topics_is_not_mixed(cell, tmp_path):
    bag = Bag(tmp_path / "bag", "mcap")
    for tick in range(100):
        now = START + tick * 20_000_000
        for robot in (1, 2):
            pose = cell.poses[robot] + 0.0
            pose[0, 3] += 1e-3 * tick
            bag.transforms(f"/robot{robot}/tf", now, [bag.transform(now, "base_link", "tool0", pose)])
        bag.picture("/image", now, CAMERA, cell.images[0])
    bag.close()
    with pytest.raises(handeye.InputError, match="/robot1/tf and /robot2/tf"):
        extract(tmp_path / "bag", tmp_path / "out")


def test_a_bag_that_is_still_open(bags, tmp_path):
    (tmp_path / "session.bag.active").write_bytes(bags["ros1"].read_bytes()[:-5000])
    assert extract(tmp_path / "session.bag.active", tmp_path / "out", motion="still").captures > 5


def test_joint_values_that_are_no_numbers_are_left_out(arm, tmp_path):
    def broken(bag):
        for recorded, _, topic, _, fields in bag.messages:
            if topic == "/joint_states" and recorded < START + 10**8:
                fields["position"][:] = np.nan

    record_still(Cell(arm), tmp_path / "bag", "mcap", before=broken)
    done = extract(tmp_path / "bag", tmp_path / "out", joints=True)
    assert done.captures == 14 and any("not finite" in note for note in done.notes)


def test_joint_values_in_degrees_are_noticed(arm, tmp_path):
    def in_degrees(bag):
        for _, _, topic, _, fields in bag.messages:
            if topic == "/joint_states":
                fields["position"][:] = np.degrees(fields["position"])

    record_still(Cell(arm), tmp_path / "bag", "mcap", before=in_degrees)
    done = extract(tmp_path / "bag", tmp_path / "out", joints=True)
    assert any("are they degrees?" in note for note in done.notes), done.notes


def test_joint_values_of_a_robot_in_motion(arm, tmp_path):
    """The arm's own errors are found from them, as of one that stands still."""
    folder = tmp_path / "cell"
    handeye.simulate(folder, captures=50, arm=True, **SMALL)
    cell = Cell(folder)
    record_moving(cell, tmp_path / "bag", "mcap", offset_s=0.04)
    done = extract(tmp_path / "bag", tmp_path / "out", joints=True)
    assert done.moving and done.captures > 40
    calibration = handeye.calibrate(tmp_path / "out")
    assert calibration.to_dict()["arm"] is not None
    mm, degrees = error_of(calibration, cell)
    assert mm < 1.5 and degrees < 0.15
    assert abs(calibration.to_dict()["time_offset_s"] - 0.04) < 2e-3


def names_in(folder):
    return sorted(str(path.relative_to(folder)) for path in folder.rglob("*"))


def test_ctrl_c_leaves_nothing_half_done(bags, tmp_path):
    """Nothing at all, or the whole folder where it came after the last file had been written."""
    extract(bags["sqlite"], tmp_path / "whole", base="base_link", flange="tool0")
    whole = names_in(tmp_path / "whole")
    shutil.rmtree(tmp_path / "whole")
    code = f"import handeye; handeye.extract_bag({str(bags['sqlite'])!r}, {str(tmp_path / 'out')!r}, base='base_link', flange='tool0')"
    for after_s in (0.3, 0.5, 0.8):
        process = subprocess.Popen([sys.executable, "-c", code], stderr=subprocess.DEVNULL)
        time.sleep(after_s)
        process.send_signal(signal.SIGINT)
        process.wait(timeout=20)
        left = list(tmp_path.iterdir())
        if left or process.returncode == 0:
            assert left == [tmp_path / "out"]
            assert names_in(tmp_path / "out") == whole
        shutil.rmtree(tmp_path / "out", ignore_errors=True)


def test_an_empty_folder_is_filled_and_may_be_the_one_we_are_in(bags, tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    done = extract(bags["ros1"], ".")
    names = sorted(path.name for path in tmp_path.iterdir())
    assert done.captures == COUNT and names == ["camera.yaml", "handeye.toml", "images", "robot.csv"]
    with pytest.raises(handeye.InputError, match="is there already"):
        extract(bags["ros1"], ".")
