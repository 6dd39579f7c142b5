"""Calibrations of a folder, of images, of poses; and poses as robots write them."""

from __future__ import annotations

from os import PathLike, fspath
from typing import Any, Callable, List, Mapping, Optional, Sequence, Tuple, Union, overload

from . import _core
from ._calibration import Calibration
from ._core import InputError
from ._inputs import json_of, names_of, poses_of, poses_of_parts
from ._pose import Pose
from ._types import Array, Path

_Progress = Callable[[int, int], object]
_Target = Union[Mapping[str, Any], Path]


@overload
def calibrate(
    dataset: Path,
    *,
    root: Optional[Path] = None,
    out: Optional[Path] = None,
    method: Optional[str] = None,
    progress: Optional[_Progress] = None,
) -> Calibration: ...
@overload
def calibrate(
    dataset: Sequence[Any],
    poses: Any,
    *,
    setup: str,
    target: _Target,
    intrinsics: Any = None,
    distortion: Optional[Sequence[float]] = None,
    scans: Optional[Sequence[Any]] = None,
    ids: Optional[Sequence[str]] = None,
    robot_rotation_deg: Optional[float] = None,
    robot_position_mm: Optional[float] = None,
    max_error_mm: Optional[float] = None,
    out: Optional[Path] = None,
    method: Optional[str] = None,
    progress: Optional[_Progress] = None,
) -> Calibration: ...
def calibrate(
    dataset: Any,
    poses: Any = None,
    *,
    setup: Optional[str] = None,
    target: Optional[_Target] = None,
    intrinsics: Any = None,
    distortion: Optional[Sequence[float]] = None,
    scans: Optional[Sequence[Any]] = None,
    ids: Optional[Sequence[str]] = None,
    robot_rotation_deg: Optional[float] = None,
    robot_position_mm: Optional[float] = None,
    max_error_mm: Optional[float] = None,
    root: Optional[Path] = None,
    out: Optional[Path] = None,
    method: Optional[str] = None,
    progress: Optional[_Progress] = None,
) -> Calibration:
    """Calibrates a folder of captures, or images with the robot's poses.

    ``calibrate("cell")`` takes all from the folder's manifest. ``calibrate(images, poses, setup=, target=)`` needs no
    file at all:

    :param dataset: the folder, or its manifest ``handeye.toml``; or a list of images, each an array as for
        :func:`detect` or the path of a file.
    :param poses: ``base_from_flange`` of every image: N x 4 x 4 (m), or a list of :class:`Pose`; see :func:`poses_from`.
    :param setup: ``"eye-in-hand"``: the camera is on the flange; ``"eye-to-hand"``: beside the robot.
    :param target: what the camera sees, as for :func:`detect`.
    :param intrinsics: the camera's matrix, 3 x 3 as OpenCV has it; or the keys of ``[camera]`` of a manifest
        (``fx``, ``fy``, ``cx``, ``cy``, ``distortion`` ...); or a file that such a section may name. Without it, they are
        calibrated from the images.
    :param distortion: OpenCV's coefficients (4, 5, 8 or 12) of that matrix; none where it is not given.
    :param scans: a scan for each image, or None where there is none: H x W x 3 (m) with one point for each pixel, N x 3,
        or the path of a file.
    :param ids: names of the captures. Else ``0``, ``1`` ...
    :param robot_rotation_deg: standard deviation of the robot's rotation, per axis, where it is known.
    :param robot_position_mm: of its position.
    :param max_error_mm: an answer that is predicted to be worse is not accepted.
    :param root: where the captures of a folder's manifest lie, if not beside it.
    :param out: where ``calibration.json`` and ``report.html`` are written, if anywhere.
    :param method: a published method to run as published; see ``METHODS``.
    :param progress: called with the number of captures that are read, and of all.
    :returns: the answer with its covariance, and a verdict: look at that first.
    :raises InputError: what cannot be used; ``file``, ``line`` and ``capture`` say where.

    Bad data, and too few, end in a verdict, not in an exception.
    """
    only_images = {
        "poses": poses, "setup": setup, "target": target, "intrinsics": intrinsics, "distortion": distortion,
        "scans": scans, "ids": ids, "robot_rotation_deg": robot_rotation_deg,
        "robot_position_mm": robot_position_mm, "max_error_mm": max_error_mm,
    }  # fmt: skip
    if isinstance(dataset, (str, PathLike)):
        given = [name for name, value in only_images.items() if value is not None]
        if given:
            what = f"{', '.join(given)} go with a list of images; of a folder, handeye.toml says it"
            raise InputError(what)
        calibrated = _core.calibrate(
            fspath(dataset),
            root=None if root is None else fspath(root),
            method_name=method,
            progress=progress,
        )
    else:
        if poses is None or setup is None or target is None:
            raise InputError("of a list of images, give poses, setup and target as well")
        if root is not None:
            raise InputError("root goes with a folder, not with a list of images")
        images = list(dataset)
        file = fspath(target) if isinstance(target, (str, PathLike)) else None
        camera = _camera(intrinsics, distortion)
        calibrated = _core.calibrate_captures(
            setup,
            poses_of(poses, "base", "flange"),
            images,
            ids=names_of(ids, len(images)),
            scans=None if scans is None else list(scans),
            target_json=None if isinstance(target, (str, PathLike)) else json_of(target),
            target_file=file,
            camera_json=None if camera is None else json_of(camera),
            method_name=method,
            robot_rotation_deg=robot_rotation_deg,
            robot_position_mm=robot_position_mm,
            max_error_mm=max_error_mm,
            progress=progress,
        )
    calibration = Calibration(calibrated)
    if out is not None:
        calibration.save(out)
    return calibration


def _camera(intrinsics: Any, distortion: Optional[Sequence[float]]) -> Optional[Mapping[str, Any]]:
    """The keys of ``[camera]``."""
    import numpy as np

    if intrinsics is None or isinstance(intrinsics, (str, PathLike, Mapping)):
        if distortion is not None:
            raise InputError("distortion goes with a camera matrix; of a mapping, it is one of the keys")
        if intrinsics is None or isinstance(intrinsics, Mapping):
            return intrinsics
        return {"file": fspath(intrinsics)}
    try:
        matrix = np.asarray(intrinsics, dtype=np.float64)
    except (TypeError, ValueError):
        matrix = np.zeros(0)
    if matrix.shape != (3, 3):
        raise InputError("intrinsics are a camera matrix of 3 x 3, a mapping or a file")
    skew = [matrix[0, 1], matrix[1, 0], *(matrix[2] - (0.0, 0.0, 1.0))]
    if any(abs(x) > 1e-9 for x in skew):
        raise InputError("the camera matrix is (fx 0 cx; 0 fy cy; 0 0 1); a skew is not modelled")
    camera = {"fx": matrix[0, 0], "fy": matrix[1, 1], "cx": matrix[0, 2], "cy": matrix[1, 2]}
    if distortion is None:
        return {**camera, "distortion_model": "none"}
    coefficients = np.asarray(distortion, dtype=np.float64).reshape(-1).tolist()
    return {**camera, "distortion_model": "plumb_bob", "distortion": coefficients}


def solve(
    base_from_flange: Any,
    camera_from_target: Any,
    r_target2cam: Any = None,
    t_target2cam: Any = None,
    *,
    setup: str,
    ids: Optional[Sequence[str]] = None,
    method: Optional[str] = None,
    robot_rotation_deg: Optional[float] = None,
    robot_position_mm: Optional[float] = None,
    unknown_scale: bool = False,
    known_position: Optional[Tuple[Sequence[float], float, float]] = None,
    robot_times_s: Optional[Sequence[float]] = None,
    camera_times_s: Optional[Sequence[float]] = None,
) -> Calibration:
    """Calibrates from poses of the robot and of the target.

    ``solve(base_from_flange, camera_from_target, setup=)``, or rotations and translations as OpenCV has them:
    ``solve(R_gripper2base, t_gripper2base, R_target2cam, t_target2cam, setup=)``, where rotations are 3 x 3 or
    rotation vectors. They are not inverted for a camera beside the robot: ``setup`` says where it is.

    :param base_from_flange: what the robot reported: N x 4 x 4 (m), or a list of :class:`Pose`.
    :param camera_from_target: where the camera saw the target: N x 4 x 4 (m), or a list of :class:`Pose`.
    :param setup: ``"eye-in-hand"``: the camera is on the flange; ``"eye-to-hand"``: beside the robot.
    :param ids: names of the captures; their order is the order in which they were taken. Else ``0``, ``1`` ...
    :param method: a published method to run as published; see ``METHODS``.
    :param robot_rotation_deg: standard deviation of the robot's rotation, per axis, where it is known.
    :param robot_position_mm: of its position.
    :param unknown_scale: the target's distances are known up to one factor.
    :param known_position: where the camera sits along one direction that the poses leave open, as those of a robot of
        one axis do: the direction in the body that carries the camera, the position (mm) and its standard deviation.
    :param robot_times_s: stamps of the robot's poses (s), where both lists have clocks of their own.
    :param camera_times_s: stamps of the target's poses; both lists may then differ in length.
    :returns: the answer with its covariance, and a verdict: look at that first. Where ``method`` is not given, the
        maximum-likelihood estimate of both poses and of the noise, or a closed form where that predicts less error.
    :raises InputError: arrays of another shape or length, numbers that are not finite, rotations that are none.

    Bad data, and too few, end in a verdict and not in an exception.
    """
    if (r_target2cam is None) != (t_target2cam is None):
        raise InputError("give poses of robot and target, or rotation and translation of both")
    if r_target2cam is None:
        robot = poses_of(base_from_flange, "base", "flange")
        camera = poses_of(camera_from_target, "camera", "target")
    else:
        robot = poses_of_parts(base_from_flange, camera_from_target, "base", "flange")
        camera = poses_of_parts(r_target2cam, t_target2cam, "camera", "target")
    if (robot_times_s is None) != (camera_times_s is None):
        raise InputError("give the times of both streams, or of none")
    if robot_times_s is not None and camera_times_s is not None:
        if any(given is not None for given in (ids, method, robot_rotation_deg, robot_position_mm, known_position)):
            raise InputError("streams take neither ids nor a method nor the robot's noise nor a known position")
        robot_times = [float(time) for time in robot_times_s]
        camera_times = [float(time) for time in camera_times_s]
        return Calibration(
            _core.solve_streams(
                setup, robot_times, robot, camera_times, camera, unknown_scale=unknown_scale
            )
        )
    return Calibration(
        _core.solve(
            setup,
            robot,
            camera,
            ids=names_of(ids, len(robot)),
            method_name=method,
            robot_rotation_deg=robot_rotation_deg,
            robot_position_mm=robot_position_mm,
            unknown_scale=unknown_scale,
            known=known_position,
        )
    )


def solve_motions(
    a: Any,
    b: Any,
    *,
    setup: str,
    distance_m: float = 0.5,
    ids: Optional[Sequence[str]] = None,
    method: Optional[str] = None,
    robot_rotation_deg: Optional[float] = None,
    robot_position_mm: Optional[float] = None,
) -> Calibration:
    """Hand-eye calibration from relative motions, ``A X = X B``.

    :param a: the motions of what carries the camera, N x 4 x 4 (m): eye-in-hand ``flange1_from_flange2``, eye-to-hand
        ``base_from_flange1 @ flange2_from_base``.
    :param b: the camera's, between the same moments: ``camera_from_target1 @ target_from_camera2``.
    :param setup: ``"eye-in-hand"`` or ``"eye-to-hand"``.
    :param distance_m: the answer is judged so far in front of the camera; motions do not tell where it works.
    :param ids: names of the motions. Else ``0``, ``1`` ...
    :param method: a published method to run as published; see ``METHODS``.
    :param robot_rotation_deg: standard deviation of the rotations in ``a``, per axis, where it is known.
    :param robot_position_mm: of its positions.
    :returns: ``mount_from_camera`` is X. All motions are taken to begin at one start, the capture ``start``.
    :raises InputError: arrays of another shape or length, numbers that are not finite, rotations that are none.
    """
    if not 0.0 < distance_m < float("inf"):
        raise InputError(f"distance_m is {distance_m}: how far in front of the camera the work is, in metres")
    mount = "base" if setup == "eye-to-hand" else "flange"
    mounts = poses_of(a, mount, mount)
    names = names_of(ids, len(mounts))
    if "start" in names:
        raise InputError('the id "start" is that of the pose from which all motions begin')
    return Calibration(
        _core.solve(
            setup,
            mounts,
            poses_of(b, "camera", "camera"),
            ids=names,
            method_name=method,
            robot_rotation_deg=robot_rotation_deg,
            robot_position_mm=robot_position_mm,
            motions_m=distance_m,
        )
    )


def closed_form(
    base_from_flange: Any, camera_from_target: Any, *, setup: str, method: str = "shah"
) -> Tuple[Pose, Pose]:
    """``mount_from_camera`` and ``anchor_from_target`` by one published method, and nothing else.

    Arguments are those of :func:`solve`. Takes microseconds, and says nothing of how sure it is.

    :param method: one of ``METHODS``, which says who published it.
    :raises NotDetermined: all rotations are about one axis, or the method has no single answer.
    :raises InputError: arrays of another shape or length, a method that is not there.
    """
    x, y = _core.closed_form(
        setup,
        poses_of(base_from_flange, "base", "flange"),
        poses_of(camera_from_target, "camera", "target"),
        method,
    )
    mount, anchor = ("flange", "base") if setup == "eye-in-hand" else ("base", "flange")
    return Pose(mount, "camera", x), Pose(anchor, "target", y)


def poses_from(
    rows: Any,
    notation: str,
    *,
    length_unit: Optional[str] = None,
    angle_unit: Optional[str] = None,
    direction: str = "base_from_flange",
) -> List[Pose]:
    """Poses out of the numbers that a robot shows or writes.

    :param rows: N rows of a notation's numbers, in its maker's order: six of ``kuka`` (X Y Z A B C), six of ``ur``
        (x y z rx ry rz), seven of ``quaternion-xyzw``, sixteen of ``matrix4x4`` and so on.
    :param notation: as in a manifest: ``ur``, ``kuka``, ``abb``, ``fanuc``, ``staubli`` ..., ``quaternion-xyzw``,
        ``quaternion-wxyz``, ``rotation-vector``, ``matrix4x4``, or Euler angles as ``euler-ZYX-intrinsic``.
    :param length_unit: ``"m"``, ``"mm"``, ``"cm"`` or ``"inch"``, where it is not the maker's, or there is none.
    :param angle_unit: ``"deg"`` or ``"rad"``, where it is not the maker's.
    :param direction: ``"base_from_flange"``, or ``"flange_from_base"`` where the rows are its inverse.
    :returns: ``base_from_flange`` of each row.
    :raises InputError: a notation or unit that is not there, a row of another length, a rotation that is none.

    >>> import handeye
    >>> handeye.poses_from([[500, 0, 300, 90, 0, 180]], "kuka")
    [<base_from_flange: (500.000, 0.000, 300.000) mm, xyzw (0.707107, 0.707107, 0.000000, 0.000000)>]
    """
    import numpy as np

    if direction not in ("base_from_flange", "flange_from_base"):
        raise InputError(f"direction is {direction!r}: base_from_flange or flange_from_base is needed")
    try:
        table = [[float(x) for x in np.asarray(row).reshape(-1)] for row in rows]
    except (TypeError, ValueError) as error:
        raise InputError(f"rows are lists of numbers, one for each pose: {error}") from None
    found = _core.poses_from(
        table, notation, length_unit=length_unit, angle_unit=angle_unit, inverse=direction == "flange_from_base"
    )
    return [Pose("base", "flange", np.array(matrix).reshape(4, 4)) for matrix in found]


def poses_to(
    poses: Any, notation: str, *, length_unit: Optional[str] = None, angle_unit: Optional[str] = None
) -> Array:
    """The numbers of a robot's notation, for poses: what :func:`poses_from` reads.

    :param poses: N x 4 x 4 (m), or a list of :class:`Pose` of any frames.
    :param notation: as for :func:`poses_from`; likewise ``length_unit`` and ``angle_unit``.
    :returns: N rows.
    :raises InputError: poses that are none, a notation or unit that is not there.

    >>> import handeye
    >>> handeye.poses_to([handeye.Pose("base", "camera", translation=[0.5, 0.0, 0.3])], "kuka").tolist()
    [[500.0, 0.0, 300.0, 0.0, 0.0, 0.0]]
    """
    import numpy as np

    listed = [np.asarray(pose, dtype=np.float64) for pose in poses]
    matrices = np.array(listed) if listed else np.zeros((0, 4, 4))
    return _core.poses_to(matrices, notation, length_unit=length_unit, angle_unit=angle_unit)
