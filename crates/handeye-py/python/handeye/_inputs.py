"""Arguments as the compiled half wants them."""

from __future__ import annotations

import json
from operator import index
from typing import Any, List, Mapping, Sequence

from ._core import InputError
from ._pose import Pose


def json_of(mapping: Mapping[str, Any]) -> str:
    """With numbers of NumPy as numbers."""
    return json.dumps(dict(mapping), default=lambda value: value.tolist())


def count(name: str, value: int, least: int = 1) -> int:
    """A whole number that is large enough."""
    number = index(value)
    if not least <= number < 2**63:
        raise InputError(f"{name} is {number}: a number from {least} on is needed")
    return number


def names_of(ids: Any, how_many: int) -> List[str]:
    """Names of captures; their numbers from 0 where none are given."""
    return [str(k) for k in range(how_many)] if ids is None else [str(name) for name in ids]


def poses_of(poses: Any, to: str, from_frame: str) -> Any:
    """As N x 4 x 4; frames of poses are checked."""
    import numpy as np

    if isinstance(poses, np.ndarray):
        return poses
    name = f"{to}_from_{from_frame}"
    matrices = []
    for k, pose in enumerate(_listed(poses, f"{name} is no list of poses, and no array of N x 4 x 4")):
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


def poses_of_parts(rotations: Any, translations: Any, to: str, from_frame: str) -> Any:
    """Rotations and translations as OpenCV has them, as N x 4 x 4."""
    import numpy as np

    name = f"{to}_from_{from_frame}"
    turns = _listed(rotations, f"the rotations of {name} are no list, and no array of N x 3 x 3")
    ways = _listed(translations, f"the translations of {name} are no list, and no array of N x 3")
    if len(turns) != len(ways):
        raise InputError(f"{name}: {len(turns)} rotations but {len(ways)} translations")
    matrices = np.zeros((len(turns), 4, 4))
    for k, (rotation, translation) in enumerate(zip(turns, ways)):
        try:
            matrices[k] = Pose(to, from_frame, rotation=rotation, translation=translation).matrix
        except InputError as error:
            raise InputError(f"{name}[{k}]: {error}") from None
    return matrices


def _listed(given: Any, refusal: str) -> Sequence[Any]:
    try:
        return list(given)
    except TypeError:
        raise InputError(refusal) from None
