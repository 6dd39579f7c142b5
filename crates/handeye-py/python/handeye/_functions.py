"""Targets in pictures, registration of scans, and simulated datasets."""

from __future__ import annotations

import json
from os import PathLike, fspath
from typing import Any, List, Mapping, NamedTuple, Optional, Union

from . import _core
from ._core import InputError
from ._files import Files, document, flag, is_surface, option
from ._inputs import count, json_of
from ._pose import Pose
from ._types import Array, Ids, Path


class Corners(NamedTuple):
    """A target's corners in a picture."""

    ids: Ids
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
        found = _core.detect(image, target_json=json_of(target))
    return Corners(found["ids"], found["pixels"], found["covariances"], found["reason"])


def register(
    source: Any,
    target: Any,
    *,
    initial: Union[Pose, Any, None] = None,
    method: str = "symmetric",
    max_distance_mm: Optional[float] = None,
    max_distance_m: Optional[float] = None,
    max_iterations: int = 60,
    search: bool = False,
    length_unit: Optional[str] = None,
    depth_scale: Optional[float] = None,
    camera: Optional[Path] = None,
    report: Optional[Path] = None,
    threads: int = 1,
) -> Registration:
    """Where the source lies in the target.

    :param source: points, N x 3, or H x W x 3 as the camera has them (faster, and judged better); m. Or the path of a
        scan or mesh. Or a mesh: a pair of vertices (N x 3, m) and triangles (M x 3), or an object that has both, as
        those of trimesh and Open3D have.
    :param target: likewise.
    :param initial: ``target_from_source`` to begin from, a :class:`Pose` or 4 x 4; right to some centimetres and
        10 degrees. Without it both are taken to lie as they are.
    :param method: ``symmetric``, ``point-to-point``, ``point-to-plane`` or ``gicp``.
    :param max_distance_mm: what is farther apart does not belong together [default: 50].
    :param max_distance_m: the same in metres.
    :param max_iterations: most rounds.
    :param search: look for a beginning everywhere, and take no ``initial`` (``--global`` of the program).
    :param length_unit: ``"m"``, ``"mm"``, ``"cm"`` or ``"inch"`` of files that do not say it.
    :param depth_scale: metres per unit of a depth image.
    :param camera: intrinsics of depth images, in any file that a manifest may name.
    :param report: a page with both in 3D, before and after, and their distances.
    :param threads: the answer is the same with any number; files and meshes take all there are.
    :returns: the pose with its covariance, and a verdict: look at that first.
    :raises InputError: arrays of another shape or without points, files that cannot be used, an ``initial`` that is no
        rigid transform.

    Methods: Besl and McKay 1992 (point-to-point), Chen and Medioni 1992 (point-to-plane), Segal et al. 2009 (GICP).
    """
    if isinstance(initial, Pose) and (initial.to, initial.from_frame) != ("target", "source"):
        raise InputError(f"initial is {initial.name}: target_from_source is needed")
    if max_distance_mm is not None and max_distance_m is not None:
        raise InputError("give max_distance_mm or max_distance_m, not both")
    if max_distance_m is None:
        max_distance_m = 0.05 if max_distance_mm is None else 1e-3 * max_distance_mm
    start = initial.matrix if isinstance(initial, Pose) else initial
    rounds = count("max_iterations", max_iterations)
    of_files = [length_unit, depth_scale, camera, report]
    if is_surface(source) or is_surface(target) or any(given is not None for given in of_files):
        with Files() as files:
            metres = _METRES.get(length_unit or "m", 1.0)
            words = ["register", files.surface(source, metres), files.surface(target, metres)]
            if start is not None:
                words += option("initial", files.matrix("initial.json", start))
            words += option("method", method) + option("max-distance-mm", 1e3 * max_distance_m)
            words += option("max-iterations", rounds) + flag("global", search)
            words += option("length-unit", length_unit) + option("depth-scale", depth_scale)
            found = document(words + option("camera", camera) + option("report", report))
    else:
        text = _core.register(
            source,
            target,
            initial=start,
            method=method,
            max_distance_m=max_distance_m,
            max_iterations=rounds,
            is_global=search,
            threads=count("threads", threads),
        )
        found = json.loads(text)
    return _registration(found)


_METRES = {"m": 1.0, "cm": 1e-2, "mm": 1e-3, "inch": 0.0254}


def _registration(found: Mapping[str, Any]) -> Registration:
    import numpy as np

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
        seed=count("seed", seed, least=0),
        captures=count("captures", captures),
        width=count("width", width),
        height=count("height", height),
        target_json=None if target is None else json_of(target),
        images=images,
        scans=scans,
        arm=arm,
        exact=exact,
        force=force,
    )
