"""What stands in memory: images and poses without a folder, rows of robots, parts as OpenCV has them, meshes."""

import inspect
import tomllib
import types
import typing

import cv2
import numpy as np
import pytest

import handeye
from handeye import Pose

from cell import cell, parts

BOARD = handeye.target("checkerboard", columns=9, rows=6, square_mm=25.0)


@pytest.fixture(scope="module")
def folder(tmp_path_factory):
    """A simulated dataset with images and scans, and without touches."""
    out = tmp_path_factory.mktemp("cell")
    handeye.simulate(out, captures=8, width=960, height=600, target=BOARD, scans=True)
    manifest = out / "handeye.toml"
    manifest.write_text(manifest.read_text().split("[touches]")[0])
    return out


def parts_of(folder, kind="images"):
    """The files of a simulated dataset, its robot poses and its camera."""
    manifest = tomllib.loads((folder / "handeye.toml").read_text())
    robot = manifest["robot"]
    lines = (folder / robot["poses"]).read_text().splitlines()
    rows = [[float(x) for x in line.split(",")[1:]] for line in lines[1:]]
    poses = handeye.poses_from(
        rows, robot["notation"], direction=robot["direction"], length_unit=robot["length_unit"]
    )
    return sorted((folder / kind).iterdir()), poses, manifest["camera"]


def test_images_in_memory_calibrate_like_those_of_a_folder(folder):
    names, poses, camera = parts_of(folder)
    images = [cv2.imread(str(name), cv2.IMREAD_GRAYSCALE) for name in names]
    scans = sorted((folder / "scans").iterdir())
    given = dict(setup="eye-in-hand", target=BOARD, intrinsics=camera)
    progress = []
    found = handeye.calibrate(images, poses, scans=scans, progress=lambda k, n: progress.append((k, n)), **given)
    of_folder = handeye.calibrate(folder)
    assert found.accepted and of_folder.accepted
    assert np.allclose(found.pose.matrix, of_folder.pose.matrix, atol=1e-12)
    assert np.allclose(found.covariance, of_folder.covariance, rtol=1e-9)
    assert sorted(progress) == [(k, 8) for k in range(1, 9)]
    page = found.report(folder / "page.html").read_text()
    assert "captures in memory" in page and page.count("<image") == 8
    # images alone, and paths in place of arrays
    alone = handeye.calibrate(images, poses, **given)
    assert alone.accepted and alone.pose != found.pose
    assert handeye.calibrate(names, np.array([p.matrix for p in poses]), **given).pose == alone.pose


def test_a_camera_matrix_is_that_of_opencv(folder):
    names, poses, camera = parts_of(folder)
    matrix = [[camera["fx"], 0.0, camera["cx"]], [0.0, camera["fy"], camera["cy"]], [0.0, 0.0, 1.0]]
    given = dict(setup="eye-in-hand", target=BOARD)
    by_keys = handeye.calibrate(names, poses, intrinsics=camera, **given)
    by_matrix = handeye.calibrate(names, poses, intrinsics=matrix, **given)
    assert by_keys.pose == by_matrix.pose
    bent = handeye.calibrate(names, poses, intrinsics=matrix, distortion=[0.1, 0, 0, 0, 0], **given)
    assert bent.pose != by_matrix.pose
    from_views = handeye.calibrate(names, poses, **given)
    assert np.abs(from_views.pose.matrix - by_keys.pose.matrix).max() < 0.02


def test_what_is_wrong_with_images_in_memory_is_said(folder):
    names, poses, camera = parts_of(folder)
    given = dict(setup="eye-in-hand", target=BOARD, intrinsics=camera)

    def with_third(image):
        return handeye.calibrate([*names[:3], image, *names[4:]], poses, **given)

    with pytest.raises(handeye.InputError, match="give poses, setup and target"):
        handeye.calibrate(names)
    with pytest.raises(handeye.InputError, match="7 .* 8|8 .* 7"):
        handeye.calibrate(names, poses[:7], **given)
    with pytest.raises(handeye.InputError, match="poses, setup go with a list of images"):
        handeye.calibrate(folder, poses, setup="eye-in-hand")
    with pytest.raises(handeye.InputError, match="none.png: does not exist") as refused:
        with_third(folder / "none.png")
    assert refused.value.capture == "3"
    with pytest.raises(handeye.InputError, match="capture 3: the image has the shape"):
        with_third(np.zeros(5, np.uint8))
    with pytest.raises(handeye.InputError, match="640 x 480 pixels") as refused:
        with_third(np.zeros((480, 640), np.uint8))
    assert refused.value.capture == "3"
    with pytest.raises(handeye.InputError, match="skew"):
        handeye.calibrate(names, poses, setup="eye-in-hand", target=BOARD, intrinsics=np.ones((3, 3)))
    with pytest.raises(handeye.InputError, match="unknown field"):
        handeye.calibrate(names, poses, setup="eye-in-hand", target=BOARD, intrinsics={"focal": 3.0})
    with pytest.raises(handeye.InputError, match="^captures in memory: no intrinsics given"):
        handeye.calibrate(names[:1], poses[:1], setup="eye-in-hand", target=BOARD)
    found = handeye.calibrate(names, np.array([p.inverse().matrix for p in poses]), **given)
    assert not found.accepted and "flange_from_base" in " ".join(found.reasons)


def test_rows_of_a_robot_are_poses_and_back():
    random = np.random.default_rng(3)
    poses = [
        Pose("base", "flange", rotation=random.normal(size=3) * 0.8, translation=random.normal(size=3) * 0.5)
        for _ in range(5)
    ]
    for notation, unit in [("ur", "m"), ("kuka", "mm"), ("abb", None), ("fanuc", None), ("quaternion-xyzw", "m"),
                           ("matrix4x4", "mm"), ("euler-zyx-intrinsic", "cm")]:
        rows = handeye.poses_to(poses, notation, length_unit=unit)
        again = handeye.poses_from(rows, notation, length_unit=unit)
        for a, b in zip(poses, again):
            assert np.allclose(a.matrix, b.matrix, atol=1e-9), notation
    [inverse] = handeye.poses_from(handeye.poses_to([poses[0].inverse()], "ur"), "ur", direction="flange_from_base")
    assert np.allclose(inverse.matrix, poses[0].matrix)
    with pytest.raises(handeye.InputError, match="row 1 has 5 numbers: kuka has 6"):
        handeye.poses_from([[0] * 6, [0] * 5], "kuka")
    with pytest.raises(handeye.InputError, match="length_unit"):
        handeye.poses_from([[0.0, 0, 0, 0, 0, 0, 1]], "quaternion-xyzw")
    with pytest.raises(handeye.InputError, match="kuka"):
        handeye.poses_from([[0] * 6], "cuca")
    with pytest.raises(handeye.InputError, match="beyond any robot"):
        handeye.poses_from([[5e12, 0, 0, 0, 0, 0]], "kuka")


def test_parts_as_opencv_has_them_are_poses():
    robot, camera = cell(12)
    whole = handeye.solve(robot, camera, setup="eye-in-hand")
    rotations, translations = parts(robot)
    vectors = [cv2.Rodrigues(m[:3, :3])[0] for m in camera]
    in_parts = handeye.solve(rotations, translations, vectors, camera[:, :3, 3], setup="eye-in-hand")
    assert np.allclose(in_parts.pose.matrix, whole.pose.matrix, atol=1e-9)
    with pytest.raises(handeye.InputError, match="12 rotations but 11 translations"):
        handeye.solve(rotations, translations[:11], vectors, camera[:, :3, 3], setup="eye-in-hand")


def test_files_and_meshes_are_registered_too(tmp_path):
    vertices = np.array([[0, 0, 0], [0.2, 0, 0], [0.2, 0.12, 0], [0, 0.12, 0.03], [0.05, 0.02, 0.09]], float)
    triangles = np.array([[0, 2, 1], [0, 3, 2], [0, 1, 4], [1, 2, 4], [2, 3, 4], [3, 0, 4]])
    random = np.random.default_rng(1)
    at = triangles[random.integers(0, len(triangles), 6000)]
    a, b = np.sort(random.random((2, 6000)), axis=0)
    points = vertices[at[:, 0]] * a[:, None] + vertices[at[:, 1]] * (b - a)[:, None] + vertices[at[:, 2]] * (1 - b)[:, None]
    move = Pose("target", "source", rotation=[0.02, -0.01, 0.03], translation=[0.004, -0.003, 0.002])
    source = move.inverse() @ points
    found = handeye.register(source, (vertices, triangles), max_distance_mm=20.0)
    assert np.abs(found.target_from_source.matrix - move.matrix).max() < 1e-4, found
    file = tmp_path / "part.xyz"
    np.savetxt(file, 1e3 * source, fmt="%.6f")
    of_file = handeye.register(file, (vertices, triangles), length_unit="mm", report=tmp_path / "page.html")
    assert np.abs(of_file.target_from_source.matrix - move.matrix).max() < 1e-4
    assert (tmp_path / "page.html").is_file()
    mesh = types.SimpleNamespace(vertices=vertices, faces=triangles)
    assert handeye.register(source, mesh).verdict == handeye.register(source, (vertices, triangles)).verdict
    with pytest.raises(handeye.InputError, match="none.ply"):
        handeye.register(tmp_path / "none.ply", (vertices, triangles))
    with pytest.raises(handeye.InputError, match="not both"):
        handeye.register(source, source, max_distance_mm=1.0, max_distance_m=0.1)


def test_type_hints_can_be_asked_for():
    for name in handeye.__all__:
        public = getattr(handeye, name)
        if inspect.isfunction(public):
            assert "return" in typing.get_type_hints(public), name
        elif inspect.isclass(public):
            typing.get_type_hints(public)
            for method in filter(inspect.isfunction, vars(public).values()):
                typing.get_type_hints(method)
