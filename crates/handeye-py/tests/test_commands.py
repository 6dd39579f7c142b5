"""Commands of the program as functions, and the program that the package installs."""

import json
import subprocess
import sys
from pathlib import Path

import numpy as np
import pytest

import handeye
from handeye import Pose

PROGRAM = Path(sys.executable).with_name("handeye")


@pytest.fixture(scope="module")
def cell(tmp_path_factory):
    folder = tmp_path_factory.mktemp("commands") / "cell"
    handeye.simulate(folder, captures=10, images=False)
    return folder


def program(*words, **more):
    return subprocess.run([str(PROGRAM), *map(str, words)], capture_output=True, text=True, **more)


def test_the_package_installs_the_program(cell):
    for command in ([str(PROGRAM)], [sys.executable, "-m", "handeye"]):
        version = subprocess.run([*command, "--version"], capture_output=True, text=True)
        assert (version.returncode, version.stdout) == (0, f"handeye {handeye.__version__}\n")
    found = program("calibrate", cell, "--json", "--quiet")
    assert found.returncode == 0
    ours = handeye.calibrate(cell).to_dict()
    theirs = json.loads(found.stdout)
    for either in (ours, theirs):
        either.pop("created")
    assert ours == theirs
    refused = program("calibrate", cell / "nothing")
    assert refused.returncode == 1 and refused.stderr.startswith("error: ")
    assert program("no-such-command").returncode == 2
    assert "Usage: handeye" in program("--help").stdout


def test_check_says_what_is_wrong(cell, tmp_path):
    assert handeye.check(cell)["ok"] is True
    manifest = (cell / "handeye.toml").read_text().replace("square_mm = 30.0", "square_mm = 3.0")
    (tmp_path / "wrong.toml").write_text(manifest)
    found = handeye.check(tmp_path / "wrong.toml", root=cell)
    assert found["ok"] is False
    with pytest.raises(handeye.InputError) as refused:
        handeye.check(tmp_path / "nothing.toml")
    assert refused.value.file == tmp_path / "nothing.toml"
    assert refused.value.code is not None


def test_init_writes_a_manifest_with_questions(tmp_path):
    handeye.simulate(tmp_path / "cell", captures=4, width=640, height=480)
    (tmp_path / "cell" / "handeye.toml").unlink()
    found = handeye.init(tmp_path / "cell")
    assert Path(found["manifest"]).is_file() and found["questions"]
    with pytest.raises(handeye.InputError):
        handeye.init(tmp_path / "cell")
    assert handeye.init(tmp_path / "cell", force=True) == found
    board = handeye.target("checkerboard", columns=9, rows=6, square_mm=30.0)
    less = handeye.init(tmp_path / "cell", setup="eye-in-hand", robot="quaternion-xyzw", target=board, force=True)
    assert len(less["questions"]) < len(found["questions"])
    assert 'kind = "checkerboard"\ncolumns = 9' in (tmp_path / "cell" / "handeye.toml").read_text()


def test_results_in_memory_and_in_folders_are_compared(cell, tmp_path):
    calibration = handeye.calibrate(cell, out=tmp_path / "result")
    other = handeye.calibrate(cell, method="shah")
    found = handeye.compare(tmp_path / "result", other, out=tmp_path / "both.json")
    assert found["spread"]["camera_origin_mm"]["max"] < 5.0
    assert (tmp_path / "both.json").is_file()
    files = handeye.export(calibration, ["urdf", "kuka"], tmp_path / "exports")
    assert len(files) == 2 and all(file.is_file() for file in files)
    assert files[0].read_bytes() == calibration.export("urdf")
    page = handeye.view(calibration, out=tmp_path / "page.html")
    assert page.read_text().startswith("<!DOCTYPE html>") or page.stat().st_size > 1000


def test_the_tip_of_a_tool_is_found_from_poses_in_memory():
    random = np.random.default_rng(5)
    tip, point = np.array([0.01, -0.02, 0.15]), np.array([0.6, 0.1, 0.2])
    poses = []
    for _ in range(8):
        turn = Pose("base", "flange", rotation=0.8 * random.normal(size=3), translation=[0, 0, 0])
        at = point - turn.rotation @ tip + 1e-5 * random.normal(size=3)
        poses.append(Pose("base", "flange", rotation=turn.rotation, translation=at))
    found = handeye.tool_tip(poses)
    assert found["verdict"] == "accepted"
    assert np.allclose(found["tip_in_flange_m"], tip, atol=1e-4)
    stacked = np.array([pose.matrix for pose in poses])
    assert handeye.tool_tip(stacked) == found
    with pytest.raises(handeye.InputError, match="base_from_flange"):
        handeye.tool_tip([poses[0].inverse()])


def test_targets_are_built_checked_and_drawn(tmp_path):
    board = handeye.target("checkerboard", columns=11, rows=8, square_mm=np.float64(20.0))
    assert board == {"kind": "checkerboard", "columns": 11, "rows": 8, "square_mm": 20.0}
    assert board.draw(tmp_path / "board.pdf").read_bytes().startswith(b"%PDF")
    assert (tmp_path / "board.toml").read_text() == board.toml()
    image = np.full((200, 300), 128, np.uint8)
    assert not handeye.detect(image, board).found
    with pytest.raises(handeye.InputError, match="rows"):
        handeye.target("checkerboard", columns=11, square_mm=20.0)
    with pytest.raises(handeye.InputError):
        handeye.target("chessboard", columns=11, rows=8, square_mm=20.0)
    with pytest.raises(handeye.InputError):
        handeye.target("checkerboard", columns=90, rows=80, square_mm=20.0).draw(tmp_path / "large.pdf")


def test_touches_verify_a_calibration(tmp_path):
    handeye.simulate(tmp_path / "cell", captures=10, images=False, setup="eye-to-hand")
    calibration = handeye.calibrate(tmp_path / "cell")
    base_from_camera = calibration.pose
    lines = ["id,camera_x_mm,camera_y_mm,camera_z_mm,touched_x_mm,touched_y_mm,touched_z_mm"]
    random = np.random.default_rng(2)
    for k in range(6):
        seen = np.array([0.2, 0.15, 0.9]) * random.uniform(-1, 1, 3) * [1, 1, 0.1] + [0, 0, 0.8]
        touched = base_from_camera @ seen[None]
        lines.append(",".join([str(k), *(f"{1e3 * v:.3f}" for v in [*seen, *touched[0]])]))
    (tmp_path / "touches.csv").write_text("\n".join(lines))
    found = handeye.verify(calibration, tmp_path / "touches.csv", tolerance_mm=2.0)
    assert found["verdict"] == "accepted"


def test_what_a_command_prints_does_not_reach_the_terminal(cell):
    code = f"import handeye; handeye.check({str(cell)!r}); print('only this')"
    done = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True)
    assert (done.stdout, done.stderr) == ("only this\n", "")


def test_a_reader_that_goes_away_is_no_error(cell):
    done = subprocess.run(f"'{PROGRAM}' --help 2>&1 | head -n 1; echo ${{PIPESTATUS[0]}}", shell=True,
                          capture_output=True, text=True, executable="/bin/bash")
    assert done.stdout.splitlines()[-1] == "0"


@pytest.mark.skipif(sys.platform == "win32", reason="no pseudo terminal there")
def test_init_asks_on_a_terminal_and_its_manifest_is_calibrated(tmp_path):
    import os
    import pty

    cell = tmp_path / "cell"
    handeye.simulate(cell, captures=10, width=960, height=600)
    (cell / "handeye.toml").rename(tmp_path / "written.toml")
    (cell / "truth.json").unlink()
    for file in cell.glob("touches*"):
        file.unlink()
    for folder in ("images", "."):
        for file in (cell / folder).glob("place*"):
            file.unlink()
    answers = {"setup": "1", "kind": "1", "columns": "9", "rows": "6", "square_mm": "30", "frame": "1",
               "length_unit": "m", "direction": "base_from_flange", "notation": "quaternion-xyzw"}
    ours, theirs = pty.openpty()
    process = subprocess.Popen([str(PROGRAM), "init", str(cell)], stdin=theirs, stdout=theirs, stderr=theirs)
    os.close(theirs)
    said, seen = "", 0
    while True:
        try:
            part = os.read(ours, 4096).decode()
        except OSError:  # the program has ended
            break
        if not part:
            break
        said += part
        if said.endswith("> ") and len(said) > seen:
            seen = len(said)
            key = said.rsplit("\n", 1)[-1].split(" (such as", 1)[0].strip()
            os.write(ours, (answers.get(key, "") + "\n").encode())
    os.close(ours)
    assert process.wait() == 0, said
    assert "are these the poses of the \"flange\"" in said.replace("\r\n", "\n").replace("\n     ", " "), said
    assert "next: handeye check" in said, said
    assert handeye.check(cell)["ok"] is True
    assert handeye.calibrate(cell).verdict == "accepted"


def test_a_plan_says_where_to_go_and_what_it_brings(tmp_path):
    handeye.simulate(tmp_path / "cell", captures=3, images=False)
    found = handeye.plan(tmp_path / "cell", tolerance_mm=0.6, program="ur", out=tmp_path / "views.script")
    errors = [view["predicted_p95_mm"] for view in found["poses"]]
    assert len(errors) >= 3 and errors == sorted(errors, reverse=True)
    assert found["enough"] is False and found["undetermined"] == []
    script = (tmp_path / "views.script").read_text()
    assert script.count("movel(p[") == len(errors)
    with pytest.raises(handeye.InputError):
        handeye.plan(tmp_path / "cell", distances_mm=(5000, 6000))
