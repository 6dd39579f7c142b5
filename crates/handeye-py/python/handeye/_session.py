"""A live session: images and poses are handed over one by one, and each is assessed at once."""

from __future__ import annotations

import copy
import json
from operator import index
from os import PathLike, fspath
from typing import Any, Dict, List, Mapping, Optional, Sequence, Union

from . import _core
from ._calibration import Calibration
from ._core import InputError
from ._inputs import json_of
from ._pose import Pose
from ._solving import _camera
from ._types import Array, Path


class SessionState:
    """What is known of a session at a moment; it does not change any more."""

    def __init__(
        self,
        known: str,
        capture: Optional[str] = None,
        refused: Optional[str] = None,
        touch: Optional[str] = None,
        placement: Optional[str] = None,
    ) -> None:
        self._known: Dict[str, Any] = json.loads(known)
        self._capture, self._refused, self._touch, self._placement = capture, refused, touch, placement

    @property
    def capture(self) -> Optional[str]:
        """Name of the capture that this push took, such as ``003``; None where it took none."""
        return self._capture

    @property
    def refused(self) -> Optional[str]:
        """Why the image that was handed over is no capture or placement: the board was not found in it. Nothing is lost by
        that."""
        return self._refused

    @property
    def touch(self) -> Optional[str]:
        """Name of the touch that this call of :meth:`Session.touch` took, such as ``t03``."""
        return self._touch

    @property
    def placement(self) -> Optional[str]:
        """Name of the placement that this call of :meth:`Session.place` took, such as ``p01``; None where it took none."""
        return self._placement

    @property
    def sentence(self) -> str:
        """What to do next; what is wrong comes first."""
        return str(self._known["say"])

    @property
    def verdict(self) -> str:
        """``accepted``, ``rejected`` or ``undetermined``; the last as well while nothing is wrong but that the tolerance is
        not reached yet."""
        return str(self._progress.get("verdict", "undetermined"))

    @property
    def reasons(self) -> List[str]:
        """Why the verdict is what it is, most important first."""
        return list(self._progress.get("reasons", []))

    @property
    def error_mm(self) -> Optional[float]:
        """Predicted position error in the workspace (95 %); None while it is not known."""
        error: Optional[float] = self._progress.get("p95_mm")
        return error

    @property
    def tolerance_mm(self) -> float:
        """Error that is tolerated (95 %)."""
        return float(self._known["cell"]["tolerance_mm"])

    @property
    def enough(self) -> bool:
        """Whether the captures are enough for the tolerance."""
        return bool(self._progress.get("enough", False))

    @property
    def findings(self) -> List[Dict[str, Any]]:
        """What was noticed, as in ``calibration.json``: ``code``, ``severity``, ``message``, ``advice``, ``data``."""
        return copy.deepcopy(list(self._progress.get("findings", [])))

    @property
    def undetermined(self) -> List[str]:
        """Directions that the captures leave free, in words."""
        return list(self._progress.get("undetermined", []))

    @property
    def problem(self) -> Optional[str]:
        """What went wrong last, and what to do."""
        problem = self._known["problem"]
        return None if problem is None else "; ".join(filter(None, [problem["message"], problem["advice"]]))

    @property
    def next_pose(self) -> Optional[Pose]:
        """Where to drive next, ``base_from_flange`` (m; its ``matrix`` is 4 x 4); None while no view can be proposed, as
        before there are a few captures."""
        view = self._known["next"]
        return None if view is None else Pose.from_dict(view["base_from_flange"])

    @property
    def next_numbers(self) -> Optional[Dict[str, float]]:
        """The same as the numbers of the session's notation, by their names and in its order, in its units."""
        view = self._known["next"]
        return None if view is None else dict(zip(view["columns"], view["numbers"]))

    @property
    def next_reason(self) -> Optional[str]:
        """How that view looks, and what it brings."""
        view = self._known["next"]
        return None if view is None else str(view["reason"])

    @property
    def mount_from_camera(self) -> Optional[Pose]:
        """Where the camera sits, so far as the captures say; its frames are ``flange`` or ``base``, and ``camera``."""
        pose = self._progress.get("mount_from_camera")
        mount = "flange" if self._known["cell"]["setup"] == "eye-in-hand" else "base"
        return None if pose is None else Pose.from_dict({**pose, "to": mount})

    @property
    def captures(self) -> List[Dict[str, Any]]:
        """The captures that stand: ``id``, ``used``, ``reason``, ``residual_px``, ``residual_mm``, ``corners``,
        ``base_from_flange`` and more, as ``captures`` of ``/api/state`` has them."""
        return copy.deepcopy(list(self._known["captures"]))

    @property
    def next_corner(self) -> Optional[int]:
        """The corner of the board to touch next; None while there are no captures, or where the board has no
        corners that could be touched."""
        touch = self._known["touch"]
        return None if touch is None else int(touch["corner"])

    @property
    def touches(self) -> List[Dict[str, Any]]:
        """The touches that stand: ``id``, ``corner``, ``placement``, ``used``, and ``residual_mm``, how far the tip was from
        where the captures put the corner."""
        return copy.deepcopy(list((self._known["touch"] or {}).get("touches", [])))

    @property
    def deleted(self) -> List[str]:
        """Names of the captures, placements and touches that were deleted, and can be restored."""
        return [str(capture["id"]) for capture in self._known["deleted"]]

    def to_dict(self) -> Dict[str, Any]:
        """Everything, as ``/api/state`` of ``handeye session`` answers it."""
        return copy.deepcopy(self._known)

    @property
    def _progress(self) -> Dict[str, Any]:
        return self._known["progress"] or {}

    def __repr__(self) -> str:
        error = "" if self.error_mm is None else f", {self.error_mm:.2f} mm (95 %) of {self.tolerance_mm:g} mm"
        return f"<SessionState, {len(self._known['captures'])} captures, {self.verdict}{error}: {self.sentence}>"


class Session:
    """A live calibration for a program that has camera and robot: it pushes an image and the pose of its moment; the answer is
    what that was worth and where to drive next.

    The folder is the session: a capture is stored before a push returns, ``handeye calibrate FOLDER`` gives the same
    result, byte for byte, and ``Session(FOLDER)`` goes on where it was. No other session writes to it until this one is
    closed.

    >>> import handeye, tempfile
    >>> board = {"kind": "checkerboard", "columns": 9, "rows": 6, "square_mm": 30.0}
    >>> with tempfile.TemporaryDirectory() as folder:
    ...     with handeye.Session(folder + "/cell", setup="eye-in-hand", target=board) as session:
    ...         print(session.state.sentence)
    Move the robot until the camera sees the whole board, then take the first capture.
    """

    def __init__(
        self,
        folder: Path,
        *,
        setup: Optional[str] = None,
        target: Optional[Union[Mapping[str, Any], Path]] = None,
        intrinsics: Any = None,
        distortion: Optional[Sequence[float]] = None,
        tolerance_mm: Optional[float] = None,
        notation: Optional[str] = None,
        tip_mm: Optional[Sequence[float]] = None,
    ) -> None:
        """Begins a session in a new or empty folder, or goes on with the one in it.

        :param folder: where captures, manifest, journal and result lie.
        :param setup: ``"eye-in-hand"``: the camera is on the flange; ``"eye-to-hand"``: beside the robot. A new session
            needs it, and ``target``; of one that goes on nothing need be said, and with captures setup, target and
            intrinsics cannot be others.
        :param target: what the camera sees, as for :func:`detect`.
        :param intrinsics: of the camera, as for :func:`calibrate`. Without it, they are calibrated from the images.
        :param distortion: OpenCV's coefficients (4, 5, 8 or 12) of a camera matrix; none where it is not given.
        :param tolerance_mm: error that is tolerated (95 %) [default: 0.5].
        :param notation: how the robot writes poses, such as ``"kuka"``; see :func:`poses_from` [default: ``"ur"``].
        :param tip_mm: where the tip of the tool that touches corners is in the flange, x, y and z.
        :raises InputError: what is declared wrongly or of another cell; a folder that holds other files, or that another
            session has open.
        """
        camera = _camera(intrinsics, distortion)
        file, board = (target, None) if isinstance(target, (str, PathLike)) else (None, target)
        self._session = _core.PushedSession(
            fspath(folder),
            setup_name=setup,
            target_json=None if board is None else json_of(board),
            target_file=None if file is None else fspath(file),
            camera_json=None if camera is None else json_of(camera),
            tolerance_mm=None if tolerance_mm is None else float(tolerance_mm),
            notation=notation,
            tip_mm=None if tip_mm is None else _tip(tip_mm),
        )

    def push(self, image: Any, pose: Any, *, scan: Any = None) -> SessionState:
        """Takes a capture: stores it, and assesses all captures; returns when that is done.

        The image must be taken while the robot stands at the pose: nobody else can know that.

        :param image: H x W, H x W x 3 or x 4; uint8, uint16, or floating from 0 to 255; stored as a grey PNG of 8 bits.
            Or the path of a file, which is stored as it is.
        :param pose: ``base_from_flange``: a :class:`Pose` or 4 x 4 (m); or the numbers of the session's notation in its
            units, a flat list or the text that the pendant shows.
        :param scan: of the same moment, in the camera's frame: H x W x 3 (m) with one point for each pixel, N x 3, or the
            path of a file; with every capture, or with none.
        :returns: the state with ``capture``, its name; or, where the board is not found in the image, with ``refused``.
        :raises InputError: a pose that no robot has, as one in another unit; a pose that was not read anew; arrays of
            another shape or type, images of another size; a folder that cannot be written. The session is as it was.

        While it works, other threads run. After a Ctrl-C the capture may be stored or not: ``captures`` says it.
        """
        given = _pose(pose)
        capture, refused, state = self._session.push(image, scan=scan, **given)
        return SessionState(state, capture, refused)

    def touch(self, pose: Any, *, corner: Optional[int] = None) -> SessionState:
        """Takes a touch: the tip of the tool is at a corner of the board, and the robot stands. Touches are a second instrument
        beside the camera, and the result is made with them.

        With a camera on the robot the board of the captures is touched where it lies; with one beside the robot, the board of
        the newest placement (see :meth:`place`).

        :param pose: ``base_from_flange`` with the tip at the corner, as for :meth:`push`.
        :param corner: which [default: ``next_corner`` of the state].
        :returns: the state with ``touch``, its name.
        :raises InputError: no captures yet, no ``tip_mm``, no placement where the robot carries the board; a corner that the
            board does not have; a pose that no robot has, or that was not read anew. The session is as it was.
        """
        touch, state = self._session.touch(corner=_corner(corner), **_pose(pose))
        return SessionState(state, touch=touch)

    def place(self, image: Any, *, pose: Any = None) -> SessionState:
        """Takes the image of a board that was laid into the view of a camera beside the robot, of the kind of the captures'
        board, which the robot cannot touch itself. The corners that are touched from now on are this board's.

        :param image: as for :meth:`push`; the board lies still, and the robot may be anywhere.
        :param pose: ``base_from_flange`` of that moment, as for :meth:`push`. Without it, a board in the robot's hand may be
            taken for one that lies.
        :returns: the state with ``placement``, its name; or, where the board is not found in the image, with ``refused``.
        :raises InputError: no captures yet; a camera on the robot; a board that lies as before, or that the robot carries; an image
            of another size. The session is as it was.
        """
        given = {} if pose is None else _pose(pose)
        placement, refused, state = self._session.place(image, **given)
        return SessionState(state, refused=refused, placement=placement)

    @property
    def state(self) -> SessionState:
        """What is known now."""
        return SessionState(self._session.state())

    @property
    def captures(self) -> List[Dict[str, Any]]:
        """The captures that stand, as :attr:`SessionState.captures`."""
        return self.state.captures

    def delete(self, id: str) -> SessionState:
        """Takes a capture out, or a placement with its touches; files are kept aside. Raises InputError for a name that none
        has."""
        return SessionState(self._session.delete(id))

    def retake(self, id: str) -> SessionState:
        """Takes a capture out, and has its view proposed as ``next_pose``, if the board is seen in it. Raises
        InputError for a name that no capture has."""
        return SessionState(self._session.retake(id))

    def untouch(self, id: str) -> SessionState:
        """Takes a touch out. Raises InputError for a name that no touch has."""
        return SessionState(self._session.untouch(id))

    def restore(self, id: str) -> SessionState:
        """Takes a deleted capture, placement or touch in again. Raises InputError for a name that no deleted one has."""
        return SessionState(self._session.restore(id))

    def undo(self) -> SessionState:
        """Undoes the last capture, placement, touch, deletion or restoring since the folder was opened. Raises InputError where
        there is none."""
        return SessionState(self._session.undo())

    def skip(self) -> SessionState:
        """Has another view proposed, not near ``next_pose``. Raises InputError where no view is proposed."""
        return SessionState(self._session.skip())

    def finish(self) -> Calibration:
        """Writes ``calibration.json`` and ``report.html`` into ``result/`` of the folder, and returns the calibration.

        Too few captures end in a verdict, not in an exception; captures may follow.

        :raises InputError: no captures; a newest capture that does not fit to those before it: camera or board may have
            moved, another capture shows it.
        """
        return Calibration(self._session.finish())

    def close(self) -> None:
        """Lets the folder go, for another session. Nothing else is done: all is stored already."""
        self._session.close()

    def __enter__(self) -> Session:
        return self

    def __exit__(self, *_: object) -> None:
        self.close()


def _tip(tip_mm: Sequence[float]) -> Sequence[float]:
    """As the compiled half takes it."""
    import numpy as np

    try:
        numbers: Array = np.asarray(tip_mm, dtype=np.float64)
    except (TypeError, ValueError):
        numbers = np.empty(0)
    if numbers.shape != (3,):
        raise InputError(f"the tip is three numbers of millimetres in the flange, not {tip_mm!r}")
    return [float(x) for x in numbers]


def _corner(corner: Any) -> Optional[int]:
    """As the compiled half takes it."""
    if corner is None:
        return None
    try:
        number = None if isinstance(corner, bool) else index(corner)
    except TypeError:
        number = None
    if number is None or not 0 <= number < 2**32:
        raise InputError(f"the board has no corner {corner!r}")
    return number


def _pose(pose: Any) -> Dict[str, Any]:
    """As the compiled half takes it."""
    import numpy as np

    if isinstance(pose, str):
        return {"numbers": pose}
    if isinstance(pose, Pose):
        if (pose.to, pose.from_frame) != ("base", "flange"):
            raise InputError(f"the pose is {pose.name}: base_from_flange is needed")
        return {"matrix": pose.matrix}
    try:
        numbers: Array = np.asarray(pose, dtype=np.float64)
    except (TypeError, ValueError) as error:
        raise InputError(f"the pose is 4 x 4 (m), or a list of the notation's numbers: {error}") from None
    if numbers.ndim == 2:
        return {"matrix": numbers}
    if numbers.ndim != 1 or not np.isfinite(numbers).all():
        raise InputError(f"the pose is 4 x 4 (m), or a flat list of the notation's numbers, finite ones, not {pose!r}")
    return {"numbers": " ".join(repr(x) for x in numbers.tolist())}
