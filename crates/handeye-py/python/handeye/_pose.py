"""Rigid transforms that know their frames."""

from __future__ import annotations

from typing import Any, Dict, Mapping, Optional, Union, overload

from ._core import InputError
from ._types import Array, ArrayLike

# rotations may be off by so much: they were printed with three digits
_ROUNDED = 5e-3


class Pose:
    """``to_from_frame``: takes points of ``from_frame`` into ``to``; metres.

    ``a @ b`` is checked: the inner frames must be the same.

    >>> base_from_flange = Pose("base", "flange", translation=[0.5, 0.0, 0.3])
    >>> flange_from_camera = Pose("flange", "camera", translation=[0.0, 0.1, 0.0])
    >>> (base_from_flange @ flange_from_camera).name
    'base_from_camera'
    >>> flange_from_camera @ base_from_flange
    Traceback (most recent call last):
    ...
    handeye.InputError: flange_from_camera @ base_from_flange: camera is not base
    """

    __slots__ = ("__weakref__", "_from", "_matrix", "_to")
    # arrays leave @ and == to a pose
    __array_ufunc__ = None

    def __init__(
        self,
        to: str,
        from_frame: str,
        matrix: Any = None,
        *,
        rotation: Any = None,
        translation: Any = None,
    ) -> None:
        """From a 4 x 4 ``matrix``, or a ``rotation`` and a ``translation`` (m).

        A rotation is a 3 x 3 matrix, a quaternion ``x y z w`` or a rotation vector (rad).

        Raises InputError where that is no rigid transform.
        """
        import numpy as np

        if matrix is None:
            matrix = np.eye(4)
            if rotation is not None:
                matrix[:3, :3] = _rotation(rotation)
            if translation is not None:
                matrix[:3, 3] = _numbers(translation, "a translation", 3)
        elif rotation is not None or translation is not None:
            raise InputError("give either a matrix, or a rotation and a translation")
        else:
            matrix = _numbers(matrix, "a pose", 16, (4, 4)).copy()
        _check(matrix)
        matrix[:3, :3] = _nearest(matrix[:3, :3])
        self._to, self._from = str(to), str(from_frame)
        self._matrix: Array = _closed(matrix)

    @classmethod
    def _of(cls, to: str, from_frame: str, matrix: Array) -> Pose:
        """Of a matrix that is one."""
        pose = cls.__new__(cls)
        pose._to, pose._from, pose._matrix = to, from_frame, _closed(matrix)
        return pose

    @classmethod
    def from_dict(cls, pose: Mapping[str, Any]) -> Pose:
        """From ``{"to": ..., "from": ..., "translation_m": [...], "rotation_xyzw": [...]}``."""
        return cls(
            pose["to"],
            pose["from"],
            rotation=pose["rotation_xyzw"],
            translation=pose["translation_m"],
        )

    @property
    def to(self) -> str:
        """Frame that points are taken into."""
        return self._to

    @property
    def from_frame(self) -> str:
        """Frame that points are given in."""
        return self._from

    @property
    def name(self) -> str:
        """``to_from_from``, such as ``base_from_camera``."""
        return f"{self._to}_from_{self._from}"

    @property
    def matrix(self) -> Array:
        """Homogeneous matrix, 4 x 4, read only."""
        return self._matrix

    @property
    def rotation(self) -> Array:
        """Rotation matrix, 3 x 3, read only."""
        return self._matrix[:3, :3]

    @property
    def translation(self) -> Array:
        """Origin of ``from_frame`` in ``to``, m; 3, read only."""
        return self._matrix[:3, 3]

    @property
    def quaternion_xyzw(self) -> Array:
        """Rotation as a unit quaternion, the real part last and not negative; 4."""
        return _quaternion(self._matrix[:3, :3])

    @property
    def rotation_vector(self) -> Array:
        """Rotation as an axis times its angle (rad), 3."""
        import numpy as np

        q = self.quaternion_xyzw
        sine = float(np.linalg.norm(q[:3]))
        if sine == 0.0:
            return np.zeros(3)
        vector: Array = q[:3] * (2.0 * np.arctan2(sine, q[3]) / sine)
        return vector

    def inverse(self) -> Pose:
        """``from_from_to``."""
        import numpy as np

        matrix = np.eye(4)
        matrix[:3, :3] = self.rotation.T
        matrix[:3, 3] = -self.rotation.T @ self.translation
        return self._of(self._from, self._to, matrix)

    def to_dict(self) -> Dict[str, Any]:
        """As in handeye's JSON."""
        return {
            "to": self._to,
            "from": self._from,
            "translation_m": self.translation.tolist(),
            "rotation_xyzw": self.quaternion_xyzw.tolist(),
        }

    @overload
    def __matmul__(self, other: Pose) -> Pose: ...
    @overload
    def __matmul__(self, other: ArrayLike) -> Array: ...
    def __matmul__(self, other: Union[Pose, ArrayLike]) -> Union[Pose, Array]:
        """With a pose: the chain of both. With points (3, or N x 3, m): their places in ``to``."""
        import numpy as np

        if isinstance(other, Pose):
            if self._from != other._to:
                raise InputError(
                    f"{self.name} @ {other.name}: {self._from} is not {other._to}"
                )
            matrix = self._matrix @ other._matrix
            matrix[:3, :3] = _nearest(matrix[:3, :3])
            return self._of(self._to, other._from, matrix)
        points = np.asarray(other, dtype=np.float64)
        if points.shape[-1:] != (3,) or points.ndim > 2:
            raise InputError(f"{self.name} @ points of the shape {points.shape}: N x 3 is needed")
        moved: Array = points @ self.rotation.T + self.translation
        return moved

    def __array__(self, dtype: Any = None, copy: Optional[bool] = None) -> Array:
        import numpy as np

        if dtype is None or np.dtype(dtype) == np.float64:
            return self._matrix.copy() if copy else self._matrix
        if copy is False:
            raise ValueError("a pose holds float64: another type is a copy")
        converted: Array = self._matrix.astype(dtype)
        return converted

    def __eq__(self, other: object) -> bool:
        if not isinstance(other, Pose):
            return NotImplemented
        same_frames = (self._to, self._from) == (other._to, other._from)
        return same_frames and bool((self._matrix == other._matrix).all())

    def __hash__(self) -> int:
        return hash((self._to, self._from, (self._matrix + 0.0).tobytes()))  # -0 is 0

    def __reduce__(self) -> Any:
        return (_again, (self._to, self._from, self._matrix.copy()))

    def __repr__(self) -> str:
        x, y, z = (1e3 * self.translation).tolist()
        a, b, c, d = self.quaternion_xyzw.tolist()
        return (
            f"<{self.name}: ({x:.3f}, {y:.3f}, {z:.3f}) mm, "
            f"xyzw ({a:.6f}, {b:.6f}, {c:.6f}, {d:.6f})>"
        )


def _again(to: str, from_frame: str, matrix: Array) -> Pose:
    """What was pickled, bit for bit."""
    return Pose._of(to, from_frame, matrix)


def _closed(matrix: Array) -> Array:
    """A view that nobody can open for writing."""
    matrix.setflags(write=False)
    return matrix.view()


def _numbers(given: Any, what: str, count: int, shape: Any = None) -> Array:
    import numpy as np

    try:
        array: Array = np.asarray(given, dtype=np.float64)
    except (TypeError, ValueError) as error:
        raise InputError(f"{what} is an array of {count} numbers: {error}") from None
    if array.size != count or (shape is not None and array.shape != shape):
        raise InputError(f"{what} has {shape or count} numbers, not {array.shape}")
    return array if shape is not None else array.reshape(count)


def _nearest(r: Array) -> Array:
    """The nearest rotation, by Newton's steps to the orthogonal factor."""
    import numpy as np

    for _ in range(4):
        if np.abs(r @ r.T - np.eye(3)).max() < 1e-15:
            break
        r = 0.5 * (r + np.linalg.inv(r).T)
    return r


def _check(matrix: Array) -> None:
    import numpy as np

    if not np.isfinite(matrix).all():
        raise InputError("a pose holds a number that is NaN or infinite")
    rotation = matrix[:3, :3]
    off = float(np.abs(rotation @ rotation.T - np.eye(3)).max())
    if off <= _ROUNDED and np.linalg.det(rotation) < 0:
        raise InputError("the matrix mirrors: its determinant is -1, that of a rotation is 1; is an axis reversed?")
    if off > _ROUNDED or np.linalg.det(rotation) < 0 or matrix[3].tolist() != [0, 0, 0, 1]:
        raise InputError(
            "the matrix is no rigid transform: three rows of rotation and translation (m), then 0 0 0 1"
        )


def _rotation(rotation: Any) -> Array:
    import numpy as np

    try:
        r: Array = np.asarray(rotation, dtype=np.float64)
    except (TypeError, ValueError) as error:
        raise InputError(f"a rotation is an array of numbers: {error}") from None
    if r.shape in ((3, 1), (1, 3)):
        r = r.reshape(3)
    if r.shape == (3, 3):
        return r
    if r.shape == (4,):
        length = float(np.linalg.norm(r))
        if not abs(length - 1.0) < _ROUNDED:
            raise InputError(f"a quaternion (x, y, z, w) has the length 1, not {length:.4f}")
        x, y, z, w = (r / length).tolist()
        return np.array(
            [
                [1 - 2 * (y * y + z * z), 2 * (x * y - z * w), 2 * (x * z + y * w)],
                [2 * (x * y + z * w), 1 - 2 * (x * x + z * z), 2 * (y * z - x * w)],
                [2 * (x * z - y * w), 2 * (y * z + x * w), 1 - 2 * (x * x + y * y)],
            ]
        )
    if r.shape == (3,):
        angle = float(np.linalg.norm(r))
        if angle == 0.0:
            return np.eye(3)
        half = np.append(np.sin(angle / 2) / angle * r, np.cos(angle / 2))
        return _rotation(half)
    raise InputError(
        f"a rotation of the shape {r.shape}: give 3 x 3, a quaternion (x, y, z, w), or a vector (rad)"
    )


def _quaternion(r: Array) -> Array:
    import numpy as np

    # the largest of the four first, so that nothing small is divided by
    squares = [1 + r[0, 0] - r[1, 1] - r[2, 2], 1 - r[0, 0] + r[1, 1] - r[2, 2]]
    squares += [1 - r[0, 0] - r[1, 1] + r[2, 2], 1 + np.trace(r)]
    k = int(np.argmax(squares))
    a, b, c = r[2, 1] - r[1, 2], r[0, 2] - r[2, 0], r[1, 0] - r[0, 1]
    d, e, f = r[1, 0] + r[0, 1], r[0, 2] + r[2, 0], r[2, 1] + r[1, 2]
    q = np.array(
        [
            [squares[0], d, e, a],
            [d, squares[1], f, b],
            [e, f, squares[2], c],
            [a, b, c, squares[3]],
        ][k]
    )
    unit: Array = q / np.linalg.norm(q)
    return -unit if unit[3] < 0 else unit
