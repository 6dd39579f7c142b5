"""OpenCV's ``calibrateHandEye`` and ``calibrateRobotWorldHandEye``, with a look at their answers.

Signatures, shapes, flags and results are those of OpenCV 4, and every other name is looked up in ``cv2`` itself, so that
``from handeye import cv2_compat as cv2`` is all that a script needs. Where OpenCV returns NaN, throws without a reason or
answers wrongly without a word, an error says why:

* :class:`handeye.NotDetermined`: the poses leave part of the answer free (one axis of rotation, too few).
* :class:`handeye.Rejected`: poses contradict each other, or the method fails on them.
* :class:`handeye.InputError`: an array is no rotation, has another shape, or lists differ in length.

All three are a ``ValueError``, and where OpenCV is installed a ``cv2.error`` as well: scripts that catch that go on.
What is only worth knowing comes as a :class:`HandEyeWarning`. Lengths may be metres or millimetres, the same for all. Translations of the shape 1 x 3 are
read as they are meant, where OpenCV goes wrong.
"""

import functools as _functools
import warnings as _warnings
from typing import Any, Callable, Dict, Optional, Sequence, Tuple, Type, TypeVar, cast

from . import _core
from ._core import HandEyeError, InputError
from ._types import Array

__all__ = [
    "CALIB_HAND_EYE_ANDREFF",
    "CALIB_HAND_EYE_DANIILIDIS",
    "CALIB_HAND_EYE_HORAUD",
    "CALIB_HAND_EYE_PARK",
    "CALIB_HAND_EYE_TSAI",
    "CALIB_ROBOT_WORLD_HAND_EYE_LI",
    "CALIB_ROBOT_WORLD_HAND_EYE_SHAH",
    "HandEyeWarning",
    "calibrateHandEye",
    "calibrateRobotWorldHandEye",
]

CALIB_HAND_EYE_TSAI = 0
"""R. Tsai, R. Lenz, 1989."""
CALIB_HAND_EYE_PARK = 1
"""F. Park, B. Martin, 1994."""
CALIB_HAND_EYE_HORAUD = 2
"""R. Horaud, F. Dornaika, 1995."""
CALIB_HAND_EYE_ANDREFF = 3
"""N. Andreff, R. Horaud, B. Espiau, 1999."""
CALIB_HAND_EYE_DANIILIDIS = 4
"""K. Daniilidis, 1998."""
CALIB_ROBOT_WORLD_HAND_EYE_SHAH = 0
"""M. Shah, 2013."""
CALIB_ROBOT_WORLD_HAND_EYE_LI = 1
"""A. Li, L. Wang, D. Wu, 2010."""


class HandEyeWarning(UserWarning):
    """Something to know about an answer that still stands."""


_Function = TypeVar("_Function", bound=Callable[..., Any])


def _raising(function: _Function) -> _Function:
    """Its errors are errors of OpenCV as well, where that is installed."""

    @_functools.wraps(function)
    def call(*args: Any, **keywords: Any) -> Any:
        try:
            return function(*args, **keywords)
        except HandEyeError as error:
            raise _of_opencv(type(error), error.args) from None

    return cast(_Function, call)


_known: Dict[Type[HandEyeError], Type[HandEyeError]] = {}


def _of_opencv(kind: Type[HandEyeError], args: Tuple[Any, ...]) -> HandEyeError:
    """An error that both ``except`` clauses catch; it is pickled as what it is here, for other processes."""
    try:
        from cv2 import error as opencv
    except ImportError:
        return kind(*args)
    if kind not in _known:
        about = {
            "__doc__": kind.__doc__,
            "__module__": kind.__module__,
            "__reduce__": lambda self: (_of_opencv, (kind, self.args)),
        }
        _known[kind] = cast("Type[HandEyeError]", type(kind.__name__, (kind, opencv), about))
    return _known[kind](*args)


@_raising
def calibrateHandEye(
    R_gripper2base: Any,
    t_gripper2base: Any,
    R_target2cam: Any,
    t_target2cam: Any,
    R_cam2gripper: Optional[Any] = None,
    t_cam2gripper: Optional[Any] = None,
    method: Optional[int] = CALIB_HAND_EYE_TSAI,
) -> "Tuple[Array, Array]":
    """Where the camera sits on the gripper.

    For a camera beside the robot, give the inverse robot poses (``R_base2gripper``, ``t_base2gripper``): the result
    is then ``R_cam2base``, ``t_cam2base``.

    :param R_gripper2base: rotation of each robot pose: 3 x 3, or a rotation vector (rad); N of them.
    :param t_gripper2base: its translation, 3 numbers.
    :param R_target2cam: rotation of each pose of the target, as the camera saw it.
    :param t_target2cam: its translation.
    :param R_cam2gripper: an array that takes the result as well, or None.
    :param t_cam2gripper: likewise.
    :param method: one of ``CALIB_HAND_EYE_TSAI``, ``_PARK``, ``_HORAUD``, ``_ANDREFF``, ``_DANIILIDIS``.
    :returns: ``R_cam2gripper`` (3 x 3) and ``t_cam2gripper`` (3 x 1).
    """
    _refuse_method((R_cam2gripper, t_cam2gripper))
    r, t, told = _core.hand_eye(
        R_gripper2base, t_gripper2base, R_target2cam, t_target2cam, _flag(method)
    )
    _tell(told)
    return _given(R_cam2gripper, r), _given(t_cam2gripper, t)


@_raising
def calibrateRobotWorldHandEye(
    R_world2cam: Any,
    t_world2cam: Any,
    R_base2gripper: Any,
    t_base2gripper: Any,
    R_base2world: Optional[Any] = None,
    t_base2world: Optional[Any] = None,
    R_gripper2cam: Optional[Any] = None,
    t_gripper2cam: Optional[Any] = None,
    method: Optional[int] = CALIB_ROBOT_WORLD_HAND_EYE_SHAH,
) -> "Tuple[Array, Array, Array, Array]":
    """Where the base sits in the world, and the gripper in the camera.

    :param R_world2cam: rotation of the world (the target) in the camera: 3 x 3, or a vector (rad); N of them.
    :param t_world2cam: its translation, 3 numbers.
    :param R_base2gripper: rotation of the base in the gripper, the inverse of what robots report.
    :param t_base2gripper: its translation.
    :param R_base2world: an array that takes the result as well, or None; so the three after it.
    :param method: ``CALIB_ROBOT_WORLD_HAND_EYE_SHAH`` or ``_LI``.
    :returns: ``R_base2world`` (3 x 3), ``t_base2world`` (3 x 1), ``R_gripper2cam``, ``t_gripper2cam``.
    """
    _refuse_method((R_base2world, t_base2world, R_gripper2cam, t_gripper2cam))
    r, t, q, s, told = _core.robot_world_hand_eye(
        R_world2cam, t_world2cam, R_base2gripper, t_base2gripper, _flag(method)
    )
    _tell(told)
    return (
        _given(R_base2world, r),
        _given(t_base2world, t),
        _given(R_gripper2cam, q),
        _given(t_gripper2cam, s),
    )


def _refuse_method(outputs: Sequence[Any]) -> None:
    """OpenCV takes a method in these places for an array to fill, and runs its default instead."""
    import numpy as np

    for output in outputs:
        if output is None or (isinstance(output, np.ndarray) and output.ndim > 0):
            continue
        what = f"{output!r} stands where an output array belongs: "
        if isinstance(output, (bool, list, tuple, dict)):
            raise InputError(what + "leave it out, the results are returned")
        raise InputError(f"{what}write method={output!r}")


def _flag(method: Any) -> int:
    if method is None:
        return 0
    try:
        number = int(method)
    except (TypeError, ValueError):
        number = -1
    if isinstance(method, (bool, float, str)) or number < 0:
        raise InputError(f"{method!r} is no method: take one of this module's flags")
    return number


def _given(output: Optional[Any], result: "Array") -> "Array":
    """Fills an array that was given for the result; one of another shape is left alone, as by OpenCV."""
    if output is None or getattr(output, "shape", None) != result.shape:
        return result
    if output.dtype.kind != "f" or not output.flags.writeable:
        raise InputError("an output array must hold floating numbers, and be open for writing")
    output[...] = result
    return cast("Array", output)


def _tell(told: Sequence[str]) -> None:
    for message in told:
        _warnings.warn(message, HandEyeWarning, stacklevel=4)


def __getattr__(name: str) -> Any:
    if name.startswith("__"):
        raise AttributeError(name)
    try:
        import cv2
    except ImportError:
        raise AttributeError(
            f"handeye.cv2_compat has no {name!r}, and OpenCV is not installed to look it up"
        ) from None
    return getattr(cv2, name)
