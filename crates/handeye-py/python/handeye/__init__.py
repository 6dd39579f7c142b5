"""Hand-eye calibration: where the camera sits on the robot, and how sure that is.

Lengths are metres and angles radians, but where a name ends in ``_mm`` or ``_deg``. Every transform is called
``a_from_b`` and takes points of ``b`` into ``a``; as an array it is a homogeneous 4 x 4 matrix.

>>> import handeye
>>> handeye.METHODS["tsai-lenz"]  # who published it; the keys are all methods there are
'R. Tsai, R. Lenz, 1989'
"""

from ._bags import BagContents, BagTopic, Extracted, bag_contents, extract_bag
from ._calibration import Calibration, Candidate, Corrected
from ._commands import Target, check, compare, export, import_dataset, init, plan, target, tool_tip, verify, view
from ._core import (
    METHODS,
    HandEyeError,
    InputError,
    NotDetermined,
    Rejected,
    __version__,
)
from ._functions import Corners, Registration, detect, register, simulate
from ._pose import Pose
from ._session import Session, SessionState
from ._solving import calibrate, closed_form, poses_from, poses_to, solve, solve_motions

# what only errors in files have
for _name in ("code", "file", "line", "capture"):
    setattr(HandEyeError, _name, None)
del _name

__all__ = [
    "BagContents",
    "BagTopic",
    "Calibration",
    "Candidate",
    "Corners",
    "Corrected",
    "Extracted",
    "HandEyeError",
    "InputError",
    "METHODS",
    "NotDetermined",
    "Pose",
    "Registration",
    "Rejected",
    "Session",
    "SessionState",
    "Target",
    "__version__",
    "bag_contents",
    "calibrate",
    "check",
    "closed_form",
    "compare",
    "detect",
    "export",
    "extract_bag",
    "import_dataset",
    "init",
    "plan",
    "poses_from",
    "poses_to",
    "register",
    "simulate",
    "solve",
    "solve_motions",
    "target",
    "tool_tip",
    "verify",
    "view",
]
