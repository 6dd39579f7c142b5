"""Commands of the program, and temporary files that hold arrays for them."""

from __future__ import annotations

import json
import os
import pathlib
from os import PathLike, fspath
from tempfile import TemporaryDirectory
from typing import Any, Dict, List, Optional, Tuple, Union

from . import _core
from ._calibration import Calibration
from ._core import InputError
from ._types import Array, Path


class Files:
    """Files for a command, of what stands in memory."""

    def __init__(self) -> None:
        self._folder = TemporaryDirectory()

    def __enter__(self) -> Files:
        return self

    def __exit__(self, *_: object) -> None:
        self._folder.cleanup()

    def result(self, given: Union[Calibration, Path]) -> str:
        """A path as it is; the file of a calibration."""
        if not isinstance(given, Calibration):
            return fspath(given)
        number = len(os.listdir(self._folder.name))
        return self.text(f"calibration-{number}.json", given.to_json())

    def poses(self, matrices: Any) -> str:
        """A table of N x 4 x 4."""
        rows = [",".join(repr(float(x)) for x in matrix.reshape(16)) for matrix in matrices]
        return self.text("poses.csv", "\n".join(rows) + "\n")

    def surface(self, given: Any, metres: float) -> str:
        """A path as it is; the file of points, or of a mesh: a pair of vertices and triangles, or an object that has
        both, in units of so many metres."""
        import numpy as np

        if isinstance(given, (str, PathLike)):
            return fspath(given)
        mesh = _mesh(given)
        number = len(os.listdir(self._folder.name))
        if mesh is None:
            path = pathlib.Path(self._folder.name) / f"scan-{number}.npy"
            np.save(path, np.asarray(given, dtype=np.float64) / metres)
            return str(path)
        vertices, triangles = mesh
        lines = ["v " + " ".join(repr(float(x)) for x in vertex / metres) for vertex in vertices]
        lines += ["f " + " ".join(str(int(k) + 1) for k in triangle) for triangle in triangles]
        return self.text(f"mesh-{number}.obj", "\n".join(lines) + "\n")

    def matrix(self, name: str, given: Any) -> str:
        """A matrix of 4 x 4, as JSON."""
        import numpy as np

        return self.text(name, json.dumps(np.asarray(given, dtype=np.float64).tolist()))

    def text(self, name: str, content: str) -> str:
        """A text under this name."""
        path = pathlib.Path(self._folder.name) / name
        path.write_text(content, encoding="utf-8")
        return str(path)


def is_surface(given: Any) -> bool:
    """Whether it is a file or a mesh, and no array of points."""
    return isinstance(given, (str, PathLike)) or _mesh(given) is not None


def _mesh(given: Any) -> Optional[Tuple[Array, Array]]:
    """Vertices (N x 3) and triangles (M x 3) of a mesh, if it is one."""
    import numpy as np

    if isinstance(given, tuple) and len(given) == 2:
        vertices, triangles = given
    else:
        vertices = getattr(given, "vertices", None)
        triangles = getattr(given, "faces", getattr(given, "triangles", None))
        if vertices is None or triangles is None:
            return None
    vertices, triangles = np.asarray(vertices, dtype=np.float64), np.asarray(triangles)
    if vertices.ndim != 2 or vertices.shape[1] != 3 or triangles.ndim != 2 or triangles.shape[1] != 3:
        shapes = f"{vertices.shape} and {triangles.shape}"
        raise InputError(f"vertices and triangles of a mesh are N x 3 and M x 3, not {shapes}")
    return vertices, triangles


def option(name: str, value: Any) -> List[str]:
    """An option of the command, where it has a value."""
    return [] if value is None else [f"--{name}", fspath(value) if isinstance(value, PathLike) else str(value)]


def flag(name: str, on: bool) -> List[str]:
    """A switch of the command, where it is on."""
    return [f"--{name}"] if on else []


def document(words: List[str]) -> Dict[str, Any]:
    """What a command prints with ``--json``; its error as an exception."""
    code, out, err = _core.command(["handeye", *words, "--json", "--quiet"])
    document: Dict[str, Any] = json.loads(out) if out.strip() else {}
    error = document.get("error")
    if code in (1, 2) or error is not None:
        problem = error or {"message": err.strip()}
        refused = InputError(problem.get("message", ""))
        refused.code = problem.get("code")
        refused.file = None if problem.get("file") is None else pathlib.Path(problem["file"])
        refused.line, refused.capture = problem.get("line"), problem.get("capture")
        raise refused
    return document
