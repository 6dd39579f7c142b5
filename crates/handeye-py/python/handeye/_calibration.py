"""What a calibration found, and how sure it is."""

from __future__ import annotations

import copy
import json
from os import PathLike
from pathlib import Path
from typing import (
    Any,
    Dict,
    List,
    Mapping,
    NamedTuple,
    Optional,
    Tuple,
    Union,
    overload,
)

from . import _core
from ._core import NotDetermined
from ._inputs import poses_of
from ._pose import Pose
from ._types import Array


class Candidate(NamedTuple):
    """One way to the answer, beside the others."""

    name: str
    mount_from_camera: Optional[Pose]
    held_out_mm: Optional[float]
    """Error on what it has not seen."""
    predicted_tre_mm: Optional[float]
    """Predicted error (rms) where the answer will be used."""


class Corrected(NamedTuple):
    """A pose of the flange that was corrected."""

    base_from_flange: Pose
    covariance: Array
    """Of the flange there, 6 x 6: rotation (rad) first, then position (m), along its own axes."""
    inside: bool
    """Whether the robot was seen near there; elsewhere hardly anything is corrected."""


class Calibration:
    """A finished calibration; see ``to_dict`` for everything that is known of it.

    ``mount`` is the flange for a camera on the robot (eye-in-hand), the base for one beside it (eye-to-hand);
    ``anchor`` is the other of the two. An answer that the data do not determine is None, never invented.

    A calibration of a folder keeps what its report shows of pictures and scans; one that was loaded or went through
    ``pickle`` has the numbers only.
    """

    def __init__(self, calibrated: _core.Calibrated) -> None:
        self._calibrated = calibrated
        self._known: Dict[str, Any] = json.loads(calibrated.json())

    @classmethod
    def from_dict(cls, known: Mapping[str, Any]) -> Calibration:
        """From what ``to_dict`` gave."""
        return cls.from_json(json.dumps(known))

    @classmethod
    def from_json(cls, text: str) -> Calibration:
        """From the text of a ``calibration.json``."""
        return cls(_core.Calibrated.from_json(text))

    @classmethod
    def load(cls, path: Union[str, PathLike[str]]) -> Calibration:
        """From a ``calibration.json``."""
        return cls.from_json(Path(path).read_text(encoding="utf-8"))

    @property
    def setup(self) -> str:
        """``eye-in-hand`` or ``eye-to-hand``."""
        return str(self._known["setup"])

    @property
    def verdict(self) -> str:
        """``accepted``, ``rejected`` or ``undetermined``."""
        return str(self._known["verdict"])

    @property
    def accepted(self) -> bool:
        """Whether to use it."""
        return self.verdict == "accepted"

    @property
    def reasons(self) -> List[str]:
        """Why the verdict is what it is, most important first."""
        return list(self._known["reasons"])

    @property
    def warnings(self) -> List[str]:
        """What to know besides."""
        return [warning["message"] for warning in self._known["warnings"]]

    @property
    def method(self) -> str:
        """Name of the method whose answer was chosen."""
        return str(self._known["method"])

    @property
    def mount_from_camera(self) -> Optional[Pose]:
        """Where the camera sits; its frames are ``flange`` or ``base``, and ``camera``."""
        return self._pose("mount_from_camera", _MOUNT[self.setup], "camera")

    @property
    def anchor_from_target(self) -> Optional[Pose]:
        """Where the target sits; its frames are ``base`` or ``flange``, and ``target``."""
        return self._pose("anchor_from_target", _ANCHOR[self.setup], "target")

    @property
    def pose(self) -> Pose:
        """Where the camera sits. Raises NotDetermined where the data leave it open."""
        pose = self.mount_from_camera
        if pose is None:
            raise NotDetermined("; ".join(self.reasons))
        return pose

    @property
    def covariance(self) -> Optional[Array]:
        """Of ``mount_from_camera``: 6 x 6, rotation (rad) first, then translation (m), in the camera frame."""
        return self._covariance("mount_from_camera")

    @property
    def anchor_covariance(self) -> Optional[Array]:
        """Of ``anchor_from_target``, in the target frame."""
        return self._covariance("anchor_from_target")

    @property
    def sigma(self) -> Optional[Tuple[Array, Array]]:
        """Standard deviations about and along the camera's axes: 3 (degrees), 3 (mm)."""
        import numpy as np

        covariance = self.covariance
        if covariance is None:
            return None
        deviations = np.sqrt(np.diag(covariance))
        return np.degrees(deviations[:3]), 1e3 * deviations[3:]

    @property
    def predicted_tre_mm(self) -> Optional[Dict[str, Any]]:
        """Predicted error where the answer will be used: ``rms``, ``p95`` and ``where``; ``at_task_p95`` with what the robot errs."""
        tre = self._known["predicted_tre_mm"]
        return None if tre is None else {key: tre[key] for key in ("rms", "p95", "at_task_p95", "where") if key in tre}

    @property
    def rejected(self) -> List[str]:
        """Ids of captures that were left out."""
        return list(self._known["rejected"])

    @property
    def undetermined(self) -> List[str]:
        """Directions that the data leave free, in words."""
        return list(self._known["undetermined"])

    @property
    def captures(self) -> List[Dict[str, Any]]:
        """Every capture, with its residual, and why it was left out if it was."""
        return copy.deepcopy(list(self._known["captures"]))

    @property
    def candidates(self) -> List[Candidate]:
        """All ways to the answer that were tried."""
        return [
            Candidate(
                candidate["name"],
                _read(
                    candidate["hand_eye"]["mount_from_camera"], _MOUNT[self.setup], "camera"
                ),
                candidate["held_out_mm"],
                candidate["predicted_tre_mm"],
            )
            for candidate in self._known["candidates"]
        ]

    def to_dict(self) -> Dict[str, Any]:
        """Everything, as in ``calibration.json``."""
        known: Dict[str, Any] = json.loads(self.to_json())
        return known

    def to_json(self) -> str:
        """Everything, as text."""
        return self._calibrated.json()

    def save(self, folder: Union[str, PathLike[str]], title: str = "calibration") -> Path:
        """Writes ``calibration.json`` and ``report.html`` into a folder; returns the report's path."""
        return Path(self._calibrated.write(folder, title))

    def report(self, path: Union[str, PathLike[str]], title: str = "calibration") -> Path:
        """Writes the report, one page that holds everything it shows."""
        path = Path(path)
        path.parent.mkdir(parents=True, exist_ok=True)
        path.write_text(self._calibrated.report(title), encoding="utf-8")
        return path

    def compensate(self, base_from_flange: Any, *, reported: bool = False) -> List[Corrected]:
        """Corrects poses (N x 4 x 4, or ``Pose`` objects; m) of a robot whose error depends on its pose.

        Poses are where the flange should be, computed with the transform of this calibration: what comes back is
        where to send the robot. With ``reported``, they are what the robot reported: what comes back is where its
        flange was. Raises ``NotDetermined`` where the calibration offers no correction.
        """
        import numpy as np

        given = poses_of(base_from_flange, "base", "flange")
        return [
            Corrected(
                Pose("base", "flange", np.array(matrix).reshape(4, 4)),
                np.array(covariance).reshape(6, 6),
                inside,
            )
            for matrix, covariance, inside in self._calibrated.compensate(given, reported)
        ]

    @overload
    def export(self, format: str, folder: None = None, child: Optional[str] = None) -> bytes: ...
    @overload
    def export(self, format: str, folder: Union[str, PathLike[str]], child: Optional[str] = None) -> Path: ...
    def export(
        self, format: str, folder: Optional[Union[str, PathLike[str]]] = None, child: Optional[str] = None
    ) -> Union[bytes, Path]:
        """The transform in another program's format (``urdf``, ``ros2-launch``, ``zivid-yaml``, ``halcon`` ...).

        Into a folder, under its usual name, where one is given; else its content is returned.

        :param child: name of the camera's optical frame, or of a frame fixed to the camera that the result knows, such as
            ``camera_link``; else that of the result, or ``camera``.
        :raises InputError: the name of a camera's body that the result does not know.
        """
        name, content = self._calibrated.export(format, child)
        if folder is None:
            return content
        path = Path(folder) / name
        path.parent.mkdir(parents=True, exist_ok=True)
        path.write_bytes(content)
        return path

    def to_opencv(self) -> Tuple[Array, Array]:
        """``R_cam2gripper`` (3 x 3) and ``t_cam2gripper`` (3 x 1, m); ``R_cam2base`` for a camera beside the robot."""
        pose = self.pose
        return pose.rotation.copy(), pose.translation.reshape(3, 1).copy()

    def to_ros(self, parent: Optional[str] = None, child: Optional[str] = None) -> Dict[str, Any]:
        """As ``geometry_msgs/TransformStamped``, without a stamp: nested dicts of its fields.

        Frames are called as asked, or as the result has them from a bag or manifest, or ``base``, ``flange``, ``camera``.
        """
        pose = self.pose
        names = self._known.get("frames") or {}
        return {
            "header": {"frame_id": parent or names.get("mount") or pose.to},
            "child_frame_id": child or names.get("camera") or "camera",
            "transform": {
                "translation": dict(zip("xyz", pose.translation.tolist())),
                "rotation": dict(zip("xyzw", pose.quaternion_xyzw.tolist())),
            },
        }

    def _pose(self, key: str, to: str, from_frame: str) -> Optional[Pose]:
        return _read(self._known["hand_eye"][key], to, from_frame)

    def _covariance(self, key: str) -> Optional[Array]:
        import numpy as np

        rows = self._known["hand_eye"]["covariance"][key]
        return None if rows is None else np.array(rows, dtype=np.float64)

    def __reduce__(self) -> Any:
        return (Calibration.from_json, (self.to_json(),))

    def __eq__(self, other: object) -> bool:
        if not isinstance(other, Calibration):
            return NotImplemented
        return self._known == other._known

    __hash__ = None  # type: ignore[assignment]

    def __repr__(self) -> str:
        tre = self.predicted_tre_mm
        error = "" if tre is None else f", predicted error {tre['rms']:.2f} mm (rms)"
        return f"<Calibration {self.setup}, {self.verdict}{error}: {self.mount_from_camera}>"

    def _repr_html_(self) -> str:
        from html import escape

        rows = [("verdict", f"<b>{escape(self.verdict)}</b>")]
        rows += [("", escape(reason)) for reason in self.reasons]
        pose, sigma, tre = self.mount_from_camera, self.sigma, self.predicted_tre_mm
        if pose is not None:
            numbers = ", ".join(f"{1e3 * x:.3f}" for x in pose.translation.tolist())
            rows.append((escape(pose.name), f"({numbers}) mm"))
            numbers = ", ".join(f"{x:.6f}" for x in pose.quaternion_xyzw.tolist())
            rows.append(("", f"xyzw ({numbers})"))
        if sigma is not None:
            mm = ", ".join(f"{x:.3f}" for x in sigma[1].tolist())
            degrees = ", ".join(f"{x:.4f}" for x in sigma[0].tolist())
            rows.append(("one sigma", f"({mm}) mm, ({degrees})&deg;"))
        if tre is not None:
            text = f"{tre['rms']:.2f} mm rms, 95 % within {tre['p95']:.2f} mm: {escape(tre['where'])}"
            rows.append(("predicted error", text))
        rows += [("warning", escape(message)) for message in self.warnings]
        cells = "".join(f"<tr><th>{name}</th><td>{text}</td></tr>" for name, text in rows)
        return f"<table>{cells}</table>"


_MOUNT = {"eye-in-hand": "flange", "eye-to-hand": "base"}
_ANCHOR = {"eye-in-hand": "base", "eye-to-hand": "flange"}


def _read(pose: Optional[Mapping[str, Any]], to: str, from_frame: str) -> Optional[Pose]:
    if pose is None:
        return None
    return Pose(
        to, from_frame, rotation=pose["rotation_xyzw"], translation=pose["translation_m"]
    )
