"""The commands of the program as functions: the same words, units and answers as on a terminal."""

from __future__ import annotations

import json
import os
import sys
from os import PathLike, fspath
from pathlib import Path
from tempfile import TemporaryDirectory
from typing import Any, Dict, List, Mapping, Optional, Sequence, Tuple, Union

from . import _core
from ._calibration import Calibration
from ._core import InputError
from ._files import Files, document, flag, option
from ._inputs import json_of, poses_of
from ._pose import Pose
from ._types import Path as _Path

_Result = Union[Calibration, _Path]


def check(dataset: _Path, *, root: Optional[_Path] = None, apply: Union[bool, int] = False) -> Dict[str, Any]:
    """Finds mistakes in a dataset: notation, units, direction, order, size of the target, outliers.

    :param dataset: the folder, or its manifest ``handeye.toml``.
    :param root: where the captures lie, if not beside the manifest.
    :param apply: write the manifest that explains the captures best, and keep the old one as ``handeye.toml.bak``; a
        number (from 1) chooses one of several that fit equally well.
    :returns: what ``handeye check --json`` prints; ``ok`` says whether nothing is wrong.
    :raises InputError: files that cannot be used.
    """
    words = ["check", fspath(dataset), *option("root", root)]
    if apply is True:
        words.append("--apply")
    elif apply:
        words.append(f"--apply={int(apply)}")
    return document(words)


def init(
    folder: _Path,
    *,
    setup: Optional[str] = None,
    robot: Optional[str] = None,
    target: Union[Mapping[str, Any], _Path, None] = None,
    force: bool = False,
) -> Dict[str, Any]:
    """Writes a first ``handeye.toml`` for a folder, with the questions that its files leave open.

    :param folder: with pictures, scans and robot poses.
    :param setup: ``"eye-in-hand"`` or ``"eye-to-hand"``.
    :param robot: its maker, or the notation of its poses: ``kuka``, ``ur``, ``quaternion-xyzw`` ...
    :param target: as for :func:`detect`.
    :param force: write over a manifest that is there.
    :returns: ``manifest``, its path, and ``questions``, each with its ``line`` and ``question``.
    :raises InputError: a folder without captures, or with a manifest.
    """
    words = ["init", fspath(folder), *option("setup", setup), *option("robot", robot), *flag("force", force)]
    with Files() as files:
        if isinstance(target, Mapping):
            target = files.text("target.toml", _core.target_toml(json_of(target)))
        return document(words + option("target", target))


def import_dataset(
    source: _Path,
    camera: Optional[_Path] = None,
    *,
    setup: Optional[str] = None,
    direction: Union[str, Sequence[str], None] = None,
    sequence: Optional[str] = None,
    length_unit: Optional[str] = None,
    out: Optional[_Path] = None,
    force: bool = False,
) -> Dict[str, Any]:
    """Takes what other programs recorded or found: easy_handeye2, MoveIt, Zivid, HALCON, KinHEC and others.

    :param source: file or folder; of two trajectories, that of the robot.
    :param camera: the camera's trajectory.
    :param setup: ``"eye-in-hand"`` or ``"eye-to-hand"``, where the files do not say it.
    :param direction: as ``"base_from_flange"`` and ``"camera_from_target"``, where the files do not say it.
    :param sequence: which one of a KinHEC folder.
    :param length_unit: ``"m"``, ``"mm"``, ``"cm"`` or ``"inch"``, where neither the file nor its program says it.
    :param out: where to write, if not beside the source.
    :param force: write over what is there.
    :returns: what ``handeye import --json`` prints: ``layout``, what was written, ``questions``, ``notes``.
    :raises InputError: what is of no program that is known, or lacks something.
    """
    directions = [direction] if isinstance(direction, str) else direction or []
    words = ["import", fspath(source)]
    words += [] if camera is None else [fspath(camera)]
    words += option("setup", setup) + option("direction", ",".join(directions) or None)
    words += option("sequence", sequence) + option("length-unit", length_unit) + option("out", out)
    return document(words + flag("force", force))


def compare(*results: _Result, out: Optional[_Path] = None, root: Optional[_Path] = None) -> Dict[str, Any]:
    """Do several calibrations of one cell agree?

    :param results: two and more calibrations: each a :class:`Calibration`, a ``calibration.json``, or the folder of a
        result. Or one dataset: its captures are calibrated in halves.
    :param out: where the combined transform is written, with its covariance.
    :param root: of a dataset: where its captures lie, if not beside the manifest.
    :returns: what ``handeye compare --json`` prints.
    :raises InputError: results that cannot be compared.
    """
    with Files() as files:
        words = ["compare", *(files.result(r) for r in results)]
        return document(words + option("out", out) + option("root", root))


def verify(
    calibration: _Result,
    touches: _Path,
    *,
    tolerance_mm: Optional[float] = None,
    touch_noise_mm: float = 0.2,
    camera_noise_mm: float = 0.2,
    out: Optional[_Path] = None,
) -> Dict[str, Any]:
    """Verifies a calibration with touched points that it has not seen.

    :param touches: a CSV or JSON file of points seen and touched, or a dataset with new touches.
    :param tolerance_mm: largest distance between tip and prediction that the job allows.
    :param touch_noise_mm: standard deviation of touching a point, per axis.
    :param camera_noise_mm: that of the camera's points in the file, per axis.
    :param out: folder for ``verify.html``.
    :returns: what ``handeye verify --json`` prints; ``verdict`` is ``accepted`` where it passed.
    :raises InputError: files that cannot be used.
    """
    with Files() as files:
        words = ["verify", files.result(calibration), fspath(touches)]
        words += option("tolerance-mm", tolerance_mm) + option("touch-noise-mm", touch_noise_mm)
        return document(words + option("camera-noise-mm", camera_noise_mm) + option("out", out))


def export(
    calibration: _Result,
    format: Union[str, Sequence[str]],
    out: _Path,
    *,
    parent: Optional[str] = None,
    child: Optional[str] = None,
    urdf: Optional[_Path] = None,
    optical: Optional[str] = None,
    force: bool = False,
) -> List[Path]:
    """Writes the transform in other programs' formats.

    :param format: one or several: ``urdf``, ``ros2-launch``, ``kuka``, ``zivid-yaml``, ``halcon`` ...
    :param out: the folder, or a file for a single format.
    :param parent: name of the parent frame, else that of the result, or ``base`` or ``flange``.
    :param child: name of the camera's optical frame, or of a frame fixed to the camera that the result knows.
    :param urdf: a file with the camera's links: where ``child``, a link of its body, lies to the optical frame.
    :param optical: the link of ``urdf`` that is the optical frame, else the frame that the result names.
    :param force: a result that was not accepted, too.
    :returns: the files.
    :raises InputError: a format that is not there, a result that was not accepted.
    """
    formats = format if isinstance(format, str) else ",".join(format)
    with Files() as files:
        words = ["export", files.result(calibration), "--format", formats, "--out", fspath(out)]
        words += option("parent", parent) + option("child", child) + flag("force", force)
        words += option("urdf", urdf) + option("optical", optical)
        return [Path(file) for file in document(words)["files"]]


def plan(
    dataset: _Path,
    *,
    count: int = 10,
    tolerance_mm: Optional[float] = None,
    touches: bool = False,
    urdf: Optional[_Path] = None,
    base_link: str = "base_link",
    flange_link: str = "tool0",
    joints: Optional[Sequence[float]] = None,
    avoid: Optional[_Path] = None,
    distances_mm: Optional[Tuple[float, float]] = None,
    program: Optional[str] = None,
    out: Optional[_Path] = None,
    root: Optional[_Path] = None,
) -> Dict[str, Any]:
    """Plans the views to take next: poses of the flange, what each brings, and corners to touch.

    :param dataset: the folder, or its manifest; with at least one capture that shows the board.
    :param count: largest number of views.
    :param tolerance_mm: views are added until the expected error (95 %) is below this, else what the manifest says.
    :param touches: plan corners to touch as well.
    :param urdf: the robot's: joint values within limits, and no collisions of its links.
    :param base_link: its link that is the robot's base.
    :param flange_link: its link that is the robot's flange.
    :param joints: joint values now (degrees, mm), else those of the last capture.
    :param avoid: a TOML file of boxes in the cell and on the flange.
    :param distances_mm: least and largest distance of the board from the camera.
    :param program: write a program of the robot to ``out``: ``ur``, ``kuka``, ``fanuc`` or ``abb``.
    :param out: a file for the poses, or for the program.
    :param root: where the captures lie, if not beside the manifest.
    :returns: what ``handeye plan --json`` prints: ``poses`` (``base_from_flange``, ``joints_rad``, ``reason``,
        ``predicted_p95_mm``), ``touches``, ``enough``, ``undetermined``.
    :raises InputError: files that cannot be used; no view that is left.
    """
    words = ["plan", fspath(dataset), "--count", str(count), *option("root", root), *flag("touches", touches)]
    words += option("tolerance-mm", tolerance_mm) + option("avoid", avoid)
    words += option("program", program) + option("out", out)
    if urdf is not None:
        words += ["--urdf", fspath(urdf), "--base-link", base_link, "--flange-link", flange_link]
    if joints is not None:
        words.append("--joints=" + ",".join(str(float(value)) for value in joints))
    if distances_mm is not None:
        nearest, farthest = distances_mm
        words += ["--nearest-mm", str(float(nearest)), "--farthest-mm", str(float(farthest))]
    return document(words)


def tool_tip(
    base_from_flange: Any,
    *,
    notation: Optional[str] = None,
    direction: Optional[str] = None,
    length_unit: Optional[str] = None,
    angle_unit: Optional[str] = None,
    limit_mm: float = 2.0,
) -> Dict[str, Any]:
    """Where the tip of a tool sits, from flange poses with the tip on one fixed point (pivot calibration).

    :param base_from_flange: N x 4 x 4 (m), a list of :class:`Pose`, or a file of robot poses.
    :param notation: of a file: ``ur``, ``kuka``, ``matrix4x4`` and so on; likewise ``direction``, ``length_unit`` and
        ``angle_unit``.
    :param limit_mm: largest RMS distance of the tip from the point; above it the result is rejected.
    :returns: what ``handeye tcp --json`` prints: ``verdict``, ``tip_in_flange_m``, ``covariance`` and more.
    :raises InputError: poses that cannot be used.
    """
    with Files() as files:
        if isinstance(base_from_flange, (str, PathLike)):
            file = fspath(base_from_flange)
        else:
            file = files.poses(poses_of(base_from_flange, "base", "flange"))
            notation, direction, length_unit = "matrix4x4", "base_from_flange", "m"
        words = ["tcp", file, *option("notation", notation), *option("direction", direction)]
        words += option("length-unit", length_unit) + option("angle-unit", angle_unit)
        return document(words + option("limit-mm", limit_mm))


def view(
    *files: _Result,
    out: _Path = "view.html",
    length_unit: Optional[str] = None,
    depth_scale: Optional[float] = None,
    camera: Optional[_Path] = None,
) -> Path:
    """Writes a page that shows scans, meshes, calibrations and registrations in 3D.

    :param files: scans, meshes, a calibration, what ``handeye register --json`` printed.
    :param out: the page.
    :param length_unit: ``"m"``, ``"mm"``, ``"cm"`` or ``"inch"``, where files do not say it.
    :param depth_scale: metres per unit of a depth image.
    :param camera: intrinsics of depth images, in any file that a manifest may name.
    :returns: the page.
    :raises InputError: files that cannot be shown.
    """
    with Files() as kept:
        words = ["view", *(kept.result(file) for file in files), "--out", fspath(out)]
        words += option("length-unit", length_unit) + option("depth-scale", depth_scale)
        document(words + option("camera", camera))
    return Path(out)


class Target(Dict[str, Any]):
    """A calibration target, as under ``[target]`` of a manifest: ``kind`` and its dimensions."""

    def toml(self) -> str:
        """Its ``[target]``."""
        return _core.target_toml(json_of(self))

    def draw(self, out: _Path, *, paper: str = "a4") -> Path:
        """Draws it in true scale, and writes its ``[target]`` beside it.

        :param out: ``.pdf`` or ``.svg``.
        :param paper: ``a4`` to ``a0``, ``letter``, or a size in mm such as ``300x400``.
        :returns: the drawing.
        :raises InputError: a target that does not fit on the paper, or cannot be printed.
        """
        with Files() as files:
            document(["target", files.text("target.toml", self.toml()), "--out", fspath(out), "--paper", paper])
        return Path(out)


def target(kind: str, **dimensions: Any) -> Target:
    """A calibration target; its dimensions are the keys of ``[target]`` in a manifest.

    :param kind: ``checkerboard``, ``charuco``, ``aprilgrid``, ``tag-grid``, ``tag``, ``circle-grid``,
        ``asymmetric-circle-grid``, ``modified-circle-grid`` or ``sphere``.
    :param dimensions: lengths in mm.
    :raises InputError: a kind that is not there, a dimension that is missing or impossible.

    >>> import handeye
    >>> board = handeye.target("checkerboard", columns=11, rows=8, square_mm=20.0)
    >>> print(board.toml())
    [target]
    kind = "checkerboard"
    columns = 11
    rows = 8
    square_mm = 20.0
    <BLANKLINE>
    """
    made = Target(kind=kind, **dimensions)
    made.toml()  # refuses what is none
    return made


def main() -> None:
    """The program ``handeye``, as the package installs it."""
    import signal

    # a Ctrl-C ends the program at once, as it ends any other
    signal.signal(signal.SIGINT, signal.SIG_DFL)
    sys.exit(_core.main(["handeye", *sys.argv[1:]]))
