"""Compiled functions of handeye; users take those of the package, which know their types."""

from os import PathLike
from pathlib import Path
from typing import Any, Callable, List, Optional, Sequence, Tuple, TypedDict, Union, final

import numpy as np
import numpy.typing as npt

_Array = npt.NDArray[np.float64]
_Path = Union[str, PathLike[str]]

__all__ = [
    "METHODS",
    "Calibrated",
    "HandEyeError",
    "InputError",
    "NotDetermined",
    "PushedSession",
    "Rejected",
    "__version__",
    "bag_contents",
    "calibrate",
    "calibrate_captures",
    "closed_form",
    "command",
    "detect",
    "extract_bag",
    "hand_eye",
    "main",
    "poses_from",
    "poses_to",
    "register",
    "robot_world_hand_eye",
    "simulate",
    "solve",
    "solve_streams",
    "target_toml",
]

__version__: str
METHODS: dict[str, str]

class HandEyeError(ValueError):
    code: Optional[str]
    file: Optional[Path]
    line: Optional[int]
    capture: Optional[str]

class InputError(HandEyeError): ...
class NotDetermined(HandEyeError): ...
class Rejected(HandEyeError): ...

class _Corners(TypedDict):
    reason: Optional[str]
    ids: npt.NDArray[np.uint32]
    pixels: _Array
    covariances: _Array

@final
class Calibrated:
    @staticmethod
    def from_json(text: str) -> Calibrated: ...
    def json(self) -> str: ...
    def report(self, title: str) -> str: ...
    def write(self, out: _Path, title: str) -> Path: ...
    def compensate(
        self, base_from_flange: object, reported: bool
    ) -> List[Tuple[List[float], List[float], bool]]: ...
    def export(self, format: str, child: Optional[str]) -> Tuple[str, bytes]: ...

@final
class PushedSession:
    def __new__(
        cls,
        folder: _Path,
        *,
        setup_name: Optional[str] = None,
        target_json: Optional[str] = None,
        target_file: Optional[_Path] = None,
        camera_json: Optional[str] = None,
        tolerance_mm: Optional[float] = None,
        notation: Optional[str] = None,
        tip_mm: Optional[Sequence[float]] = None,
    ) -> PushedSession: ...
    def push(
        self, image: Any, *, matrix: Any = None, numbers: Optional[str] = None, scan: Any = None
    ) -> Tuple[Optional[str], Optional[str], str]: ...
    def touch(
        self, *, matrix: Any = None, numbers: Optional[str] = None, corner: Optional[int] = None
    ) -> Tuple[str, str]: ...
    def place(
        self, image: Any, *, matrix: Any = None, numbers: Optional[str] = None
    ) -> Tuple[Optional[str], Optional[str], str]: ...
    def state(self) -> str: ...
    def delete(self, id: str) -> str: ...
    def retake(self, id: str) -> str: ...
    def untouch(self, id: str) -> str: ...
    def restore(self, id: str) -> str: ...
    def undo(self) -> str: ...
    def skip(self) -> str: ...
    def finish(self) -> Calibrated: ...
    def close(self) -> None: ...

def command(words: Sequence[str]) -> Tuple[int, str, str]: ...
def main(words: Sequence[str]) -> int: ...
def target_toml(json: str) -> str: ...
def bag_contents(bag: _Path) -> str: ...
def extract_bag(
    bag: _Path,
    out: _Path,
    *,
    base: Optional[str] = None,
    flange: Optional[str] = None,
    pose: Optional[str] = None,
    joints: Union[bool, str, None] = None,
    urdf: Optional[_Path] = None,
    setup_name: Optional[str] = None,
    target_json: Optional[str] = None,
    target_file: Optional[_Path] = None,
    image: Optional[str] = None,
    depth: Optional[str] = None,
    camera_info: Optional[str] = None,
    motion: str = "auto",
    most: int = 150,
    stamps: str = "header",
) -> str: ...
def calibrate(
    dataset: _Path,
    *,
    root: Optional[_Path] = None,
    method_name: Optional[str] = None,
    progress: Optional[Callable[[int, int], object]] = None,
) -> Calibrated: ...
def calibrate_captures(
    setup_name: str,
    base_from_flange: Any,
    images: Sequence[Any],
    *,
    ids: Sequence[str],
    scans: Optional[Sequence[Any]] = None,
    target_json: Optional[str] = None,
    target_file: Optional[_Path] = None,
    camera_json: Optional[str] = None,
    method_name: Optional[str] = None,
    robot_rotation_deg: Optional[float] = None,
    robot_position_mm: Optional[float] = None,
    max_error_mm: Optional[float] = None,
    progress: Optional[Callable[[int, int], object]] = None,
) -> Calibrated: ...
def poses_from(
    rows: Sequence[Sequence[float]],
    name: str,
    *,
    length_unit: Optional[str] = None,
    angle_unit: Optional[str] = None,
    inverse: bool = False,
) -> List[List[float]]: ...
def poses_to(
    matrices: Any, name: str, *, length_unit: Optional[str] = None, angle_unit: Optional[str] = None
) -> _Array: ...
def solve(
    setup_name: str,
    base_from_flange: Any,
    camera_from_target: Any,
    *,
    ids: Sequence[str],
    method_name: Optional[str] = None,
    robot_rotation_deg: Optional[float] = None,
    robot_position_mm: Optional[float] = None,
    unknown_scale: bool = False,
    known: Optional[Tuple[Sequence[float], float, float]] = None,
    motions_m: Optional[float] = None,
) -> Calibrated: ...
def solve_streams(
    setup_name: str,
    robot_times: Sequence[float],
    base_from_flange: Any,
    camera_times: Sequence[float],
    camera_from_target: Any,
    *,
    unknown_scale: bool = False,
) -> Calibrated: ...
def closed_form(
    setup: str, base_from_flange: Any, camera_from_target: Any, method: str
) -> Tuple[_Array, _Array]: ...
def detect(
    image: Any, *, target_json: Optional[str] = None, target_file: Optional[_Path] = None
) -> _Corners: ...
def register(
    source: Any,
    target: Any,
    *,
    initial: Any = None,
    method: str = "symmetric",
    max_distance_m: float = 0.05,
    max_iterations: int = 60,
    is_global: bool = False,
    threads: int = 1,
) -> str: ...
def simulate(
    out: _Path,
    setup_name: str,
    *,
    seed: int = 1,
    captures: int = 15,
    width: int = 1920,
    height: int = 1200,
    target_json: Optional[str] = None,
    images: bool = True,
    scans: bool = False,
    arm: bool = False,
    exact: bool = False,
    force: bool = False,
) -> list[str]: ...
def hand_eye(
    r_gripper2base: Any, t_gripper2base: Any, r_target2cam: Any, t_target2cam: Any, method: int
) -> Tuple[_Array, _Array, list[str]]: ...
def robot_world_hand_eye(
    r_world2cam: Any, t_world2cam: Any, r_base2gripper: Any, t_base2gripper: Any, method: int
) -> Tuple[_Array, _Array, _Array, _Array, list[str]]: ...
