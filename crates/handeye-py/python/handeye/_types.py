"""Types of arguments; NumPy itself is imported where it is needed, so that the package loads fast."""

from os import PathLike
from typing import TYPE_CHECKING, Any, Union

if TYPE_CHECKING:
    import numpy as np
    import numpy.typing as npt

    Array = npt.NDArray[np.float64]
    Ids = npt.NDArray[np.uint32]
    ArrayLike = npt.ArrayLike
else:
    Array = Ids = ArrayLike = Any

Path = Union[str, "PathLike[str]"]
