"""The functions of the package."""

from __future__ import annotations

import json
from operator import index
from os import PathLike, fspath
from typing import TYPE_CHECKING, Any, Callable, Dict, List, Mapping, NamedTuple, Optional, Sequence, Tuple, Union

from . import _core
from ._calibration import Calibration
from ._core import InputError
from ._pose import Pose

if TYPE_CHECKING:
    import numpy as np
    import numpy.typing as npt

    Array = npt.NDArray[np.float64]
    Path = Union[str, PathLike[str]]


class Corners(NamedTuple):
    """A target's corners in a picture."""

    ids: npt.NDArray[np.uint32]
    """N: ``row * columns + column`` of a checkerboard, OpenCV's ids of a ChArUco board."""
    pixels: Array
    """N x 2: right and down from the centre of the top left pixel."""
    covariances: Array
    """N x 2 x 2, px²."""
    reason: Optional[str]
    """Why the picture shows no target, where it shows none."""

    @property
    def found(self) -> bool:
        """Whether there is a target."""
        return self.reason is None


class Registration(NamedTuple):
    """Where one scan lies in another."""

    verdict: str
    """``accepted``, ``rejected`` or ``undetermined``."""
    reasons: List[str]
    target_from_source: Pose
    covariance: Optional[Array]
    """6 x 6, rotation (rad) first, then translation (m), in the source frame; None where something is free."""
    undetermined: List[str]
    """Motions that the common surface leaves free."""
    iterations: int
    stop: str
    """``converged``, ``fitness``, ``no-matches`` or ``max-iterations``."""
    inlier_fraction: float
    """Share of the source that lies on the target."""
    agreement: float
    """Of the places where both scans show something, the share at which it is the same."""
    rms_mm: Optional[float]
    """RMS residual of the matches that count, where anything could be compared."""
    residual_sigma: Optional[float]
    size_ratio: Optional[float]
    """Size of what the target shows over that of what the source shows."""
    size_sigma: Optional[float]
    explained: Optional[float]
    """Of a part that was searched for: the share of the scan within the part's box that lies on the part."""
    places: List[Pose]
    """Where several places explain the scan equally well: all of them, the answer first; else none."""

    @property
    def accepted(self) -> bool:
        """Whether to use it."""
        return self.verdict == "accepted"


class BagTopic(NamedTuple):
    """A topic of a bag."""

    type: str
    """As ``sensor_msgs/Image``."""
    messages: int
    frame: Optional[str]
    """That of the first message."""
    shape: Optional[str]
    """Size and encoding of the first picture or cloud."""


class BagContents(NamedTuple):
    """What a ROS bag holds."""

    topics: Dict[str, BagTopic]
    frames: List[str]
    """The tree of the transforms, a line each, indented."""
    joints: Dict[str, List[str]]
    """Names of the joints, by topic."""
    has_robot_description: bool
    broken: List[str]
    """Where it ends too early or is broken."""


class Extracted(NamedTuple):
    """What became of a ROS bag."""

    captures: int
    moving: bool
    """Whether the robot moved in them."""
    notes: List[str]
    """What was done, and what is worth knowing."""
    questions: List[str]
    """What must be added to ``handeye.toml`` before the folder can be calibrated."""


def bag_contents(bag: Path) -> BagContents:
    """Topics, frames and joints of a ROS bag: MCAP or SQLite of ROS 2, or a bag of ROS 1.

    :param bag: the file, or the folder of a bag of ROS 2.
    :raises InputError: what is no bag.
    """
    found = json.loads(_core.bag_contents(fspath(bag)))
    found["topics"] = {name: BagTopic(**about) for name, about in found["topics"].items()}
    return BagContents(**found)


def extract_bag(
    bag: Path,
    out: Path,
    *,
    base: Optional[str] = None,
    flange: Optional[str] = None,
    pose: Optional[str] = None,
    joints: Union[bool, str] = False,
    urdf: Optional[Path] = None,
    setup: Optional[str] = None,
    target: Union[Mapping[str, Any], Path, None] = None,
    image: Optional[str] = None,
    depth: Optional[str] = None,
    camera_info: Optional[str] = None,
    motion: str = "auto",
    most: int = 150,
    stamps: str = "header",
) -> Extracted:
    """A folder of captures out of a ROS bag, for :func:`calibrate`.

    The robot's pose is interpolated to the time of each picture, but never over a gap. A bag that was not closed is
    read as far as it goes; ``notes`` say so.

    :param bag: the file, or the folder of a bag of ROS 2.
    :param out: a new folder.
    :param base: the frame of the robot's base, as ``base_link``.
    :param flange: the frame of its flange, as ``tool0``.
    :param pose: a topic of poses of the flange in the base, in place of ``base`` and ``flange``.
    :param joints: take joint values in place of transforms; the topic, or True where there is only one.
    :param urdf: the robot's model for ``joints``; else the bag's ``robot_description``.
    :param setup: ``"eye-in-hand"``: the camera is on the flange; ``"eye-to-hand"``: beside the robot.
    :param target: as for :func:`detect`, what the camera sees.
    :param image: topic of the pictures, where there are several; likewise ``depth`` and ``camera_info``.
    :param motion: ``"still"``: one picture of each place at which the robot stood; ``"moving"``: many of the motion, and
        the time offset of the camera is estimated; ``"auto"``: still where it stood at six places and more.
    :param most: most pictures of a moving robot.
    :param stamps: the time of a picture is that of its ``"header"``, or that at which it was ``"recorded"``.
    :raises InputError: a bag that cannot be used, or lacks what is asked for.
    """
    file = target if isinstance(target, (str, PathLike)) else None
    table = None if target is None or file is not None else _json(target)  # type: ignore[arg-type]
    text = _core.extract_bag(
        fspath(bag),
        fspath(out),
        base=base,
        flange=flange,
        pose=pose,
        joints=joints,
        urdf=None if urdf is None else fspath(urdf),
        setup_name=setup,
        target_json=table,
        target_file=None if file is None else fspath(file),
        image=image,
        depth=depth,
        camera_info=camera_info,
        motion=motion,
        most=_count("most", most),
        stamps=stamps,
    )
    return Extracted(**json.loads(text))


def calibrate(
    dataset: Path,
    *,
    out: Optional[Path] = None,
    root: Optional[Path] = None,
    method: Optional[str] = None,
    progress: Optional[Callable[[int, int], object]] = None,
) -> Calibration:
    """Calibrates a folder of captures.

    :param dataset: the folder, or its manifest ``handeye.toml``.
    :param out: where ``calibration.json`` and ``report.html`` are written, if anywhere.
    :param root: where the captures lie, if not beside the manifest.
    :param method: a published method to run as published; see ``METHODS``.
    :param progress: called with the number of captures that are read, and of all.
    :raises InputError: files that cannot be used; ``file``, ``line`` and ``capture`` say where.

    Bad data end in a verdict, not in an exception.
    """
    calibration = Calibration(
        _core.calibrate(
            fspath(dataset),
            root=None if root is None else fspath(root),
            method_name=method,
            progress=progress,
        )
    )
    if out is not None:
        calibration.save(out)
    return calibration


def solve(
    base_from_flange: Any,
    camera_from_target: Any,
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
    robot = _poses(base_from_flange, "base", "flange")
    camera = _poses(camera_from_target, "camera", "target")
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
    names = [str(k) for k in range(len(robot))] if ids is None else [str(name) for name in ids]
    return Calibration(
        _core.solve(
            setup,
            robot,
            camera,
            ids=names,
            method_name=method,
            robot_rotation_deg=robot_rotation_deg,
            robot_position_mm=robot_position_mm,
            unknown_scale=unknown_scale,
            known=known_position,
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
        _poses(base_from_flange, "base", "flange"),
        _poses(camera_from_target, "camera", "target"),
        method,
    )
    mount, anchor = ("flange", "base") if setup == "eye-in-hand" else ("base", "flange")
    return Pose(mount, "camera", x), Pose(anchor, "target", y)


def detect(image: Any, target: Union[Mapping[str, Any], Path]) -> Corners:
    """The corners of a calibration target in a picture, to about a hundredth of a pixel.

    :param image: H x W, H x W x 3 or x 4 (alpha is left out); uint8, uint16, or floating from 0 to 255.
    :param target: ``{"kind": "checkerboard", "columns": 11, "rows": 8, "square_mm": 30.0}`` and the like, as under
        ``[target]`` of a manifest, or a TOML file with these keys.
    :returns: ids, pixels and their covariances; where there is no target, none of them, and ``reason`` says why.
    :raises InputError: an array that is no picture, floating numbers up to 1 only, or a target that is none.
    """
    if isinstance(target, (str, PathLike)):
        found = _core.detect(image, target_file=fspath(target))
    else:
        found = _core.detect(image, target_json=_json(target))
    return Corners(found["ids"], found["pixels"], found["covariances"], found["reason"])


def register(
    source: Any,
    target: Any,
    *,
    initial: Union[Pose, Any, None] = None,
    method: str = "symmetric",
    max_distance_m: float = 0.05,
    max_iterations: int = 60,
    search: bool = False,
    threads: int = 1,
) -> Registration:
    """Where the source lies in the target.

    :param source: points, N x 3, or H x W x 3 as the camera has them (faster, and judged better); m.
    :param target: likewise.
    :param initial: ``target_from_source`` to begin from, a :class:`Pose` or 4 x 4; right to some centimetres and
        10 degrees. Without it both are taken to lie as they are.
    :param method: ``symmetric``, ``point-to-point``, ``point-to-plane`` or ``gicp``.
    :param max_distance_m: what is farther apart does not belong together.
    :param max_iterations: most rounds.
    :param search: look for a beginning everywhere, and take no ``initial``.
    :param threads: the answer is the same with any number.
    :returns: the pose with its covariance, and a verdict: look at that first.
    :raises InputError: arrays of another shape or without points, an ``initial`` that is no rigid transform.

    Methods: Besl and McKay 1992 (point-to-point), Chen and Medioni 1992 (point-to-plane), Segal et al. 2009 (GICP).
    """
    if isinstance(initial, Pose) and (initial.to, initial.from_frame) != ("target", "source"):
        raise InputError(f"initial is {initial.name}: target_from_source is needed")
    text = _core.register(
        source,
        target,
        initial=initial.matrix if isinstance(initial, Pose) else initial,
        method=method,
        max_distance_m=max_distance_m,
        max_iterations=_count("max_iterations", max_iterations),
        is_global=search,
        threads=_count("threads", threads),
    )
    import numpy as np

    found = json.loads(text)
    covariance = found["covariance"]

    def pose(place: Any) -> Pose:
        at = place["target_from_source"]
        return Pose("target", "source", rotation=at["rotation_xyzw"], translation=at["translation_m"])

    return Registration(
        found["verdict"],
        found["reasons"],
        pose(found),
        None if covariance is None else np.array(covariance),
        found["undetermined"],
        found["iterations"],
        found["stop"],
        found["inlier_fraction"],
        found["agreement"],
        found["rms_mm"],
        found["residual_sigma"],
        found["size_ratio"],
        found["size_sigma"],
        found["explained"],
        [pose(place) for place in found["places"]],
    )


def simulate(
    out: Path,
    *,
    setup: str = "eye-in-hand",
    seed: int = 1,
    captures: int = 15,
    width: int = 1920,
    height: int = 1200,
    target: Optional[Mapping[str, Any]] = None,
    images: bool = True,
    scans: bool = False,
    arm: bool = False,
    exact: bool = False,
    force: bool = False,
) -> List[str]:
    """Writes a dataset whose truth is known, for :func:`calibrate`; ``truth.json`` holds the answer.

    :param out: the folder; it is made if need be, and written over only if it holds an earlier simulation.
    :param target: as for :func:`detect`; a checkerboard of 9 x 6 corners where it is left out.
    :param images: pictures; else lists of corners.
    :param scans: organised clouds (PLY, m) as well.
    :param arm: the robot gives joint values, and is not built quite as its model ``arm.json`` says.
    :param exact: no noise at all, of nothing.
    :param force: write into a folder that holds other files.
    :returns: names of the files. The same arguments give the same bytes.
    """
    return _core.simulate(
        fspath(out),
        setup,
        seed=_count("seed", seed, least=0),
        captures=_count("captures", captures),
        width=_count("width", width),
        height=_count("height", height),
        target_json=None if target is None else _json(target),
        images=images,
        scans=scans,
        arm=arm,
        exact=exact,
        force=force,
    )


def _json(target: Mapping[str, Any]) -> str:
    """With numbers of NumPy as numbers."""
    return json.dumps(dict(target), default=lambda value: value.tolist())


def _count(name: str, value: int, least: int = 1) -> int:
    number = index(value)
    if not least <= number < 2**63:
        raise InputError(f"{name} is {number}: a number from {least} on is needed")
    return number


def _poses(poses: Any, to: str, from_frame: str) -> Any:
    """As N x 4 x 4; frames of poses are checked."""
    import numpy as np

    if isinstance(poses, np.ndarray):
        return poses
    name = f"{to}_from_{from_frame}"
    try:
        listed = list(poses)
    except TypeError:
        raise InputError(f"{name} is no list of poses, and no array of N x 4 x 4") from None
    matrices = []
    for k, pose in enumerate(listed):
        if isinstance(pose, Pose):
            if (pose.to, pose.from_frame) != (to, from_frame):
                raise InputError(f"pose {k} is {pose.name}: {to}_from_{from_frame} is needed")
            pose = pose.matrix
        try:
            matrix = np.asarray(pose, dtype=np.float64)
        except (TypeError, ValueError):
            matrix = np.zeros(0)
        if matrix.shape != (4, 4):
            raise InputError(f"{name}[{k}] is no matrix of 4 x 4")
        matrices.append(matrix)
    return np.array(matrices) if matrices else np.zeros((0, 4, 4))
