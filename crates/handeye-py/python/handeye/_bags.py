"""ROS bags: what they hold, and folders of captures out of them."""

from __future__ import annotations

import json
from os import PathLike, fspath
from typing import Any, Dict, List, Mapping, NamedTuple, Optional, Union

from . import _core
from ._inputs import count, json_of
from ._types import Path


class BagTopic(NamedTuple):
    """A topic of a bag."""

    type: str
    """As ``sensor_msgs/Image``."""
    messages: int
    frame: Optional[str]
    """That of the first message."""
    shape: Optional[str]
    """Size and encoding of the first picture or cloud."""


class BagContents(NamedTuple):
    """What a ROS bag holds."""

    topics: Dict[str, BagTopic]
    frames: List[str]
    """The tree of the transforms, a line each, indented."""
    joints: Dict[str, List[str]]
    """Names of the joints, by topic."""
    has_robot_description: bool
    broken: List[str]
    """Where it ends too early or is broken."""


class Extracted(NamedTuple):
    """What became of a ROS bag."""

    captures: int
    moving: bool
    """Whether the robot moved in them."""
    notes: List[str]
    """What was done, and what is worth knowing."""
    questions: List[str]
    """What must be added to ``handeye.toml`` before the folder can be calibrated."""


def bag_contents(bag: Path) -> BagContents:
    """Topics, frames and joints of a ROS bag: MCAP or SQLite of ROS 2, or a bag of ROS 1.

    :param bag: the file, or the folder of a bag of ROS 2.
    :raises InputError: what is no bag.
    """
    found = json.loads(_core.bag_contents(fspath(bag)))
    found["topics"] = {name: BagTopic(**about) for name, about in found["topics"].items()}
    return BagContents(**found)


def extract_bag(
    bag: Path,
    out: Path,
    *,
    base: Optional[str] = None,
    flange: Optional[str] = None,
    pose: Optional[str] = None,
    joints: Union[bool, str] = False,
    urdf: Optional[Path] = None,
    setup: Optional[str] = None,
    target: Union[Mapping[str, Any], Path, None] = None,
    image: Optional[str] = None,
    depth: Optional[str] = None,
    camera_info: Optional[str] = None,
    motion: str = "auto",
    most: int = 150,
    stamps: str = "header",
) -> Extracted:
    """A folder of captures out of a ROS bag, for :func:`calibrate`.

    The robot's pose is interpolated to the time of each picture, but never over a gap. A bag that was not closed is
    read as far as it goes; ``notes`` say so.

    :param bag: the file, or the folder of a bag of ROS 2.
    :param out: a new folder.
    :param base: the frame of the robot's base, as ``base_link``.
    :param flange: the frame of its flange, as ``tool0``.
    :param pose: a topic of poses of the flange in the base, in place of ``base`` and ``flange``.
    :param joints: take joint values in place of transforms; the topic, or True where there is only one.
    :param urdf: the robot's model for ``joints``; else the bag's ``robot_description``.
    :param setup: ``"eye-in-hand"``: the camera is on the flange; ``"eye-to-hand"``: beside the robot.
    :param target: as for :func:`detect`, what the camera sees.
    :param image: topic of the pictures, where there are several; likewise ``depth`` and ``camera_info``.
    :param motion: ``"still"``: one picture of each place at which the robot stood; ``"moving"``: many of the motion, and
        the time offset of the camera is estimated; ``"auto"``: still where it stood at six places and more.
    :param most: most pictures of a moving robot.
    :param stamps: the time of a picture is that of its ``"header"``, or that at which it was ``"recorded"``.
    :raises InputError: a bag that cannot be used, or lacks what is asked for.
    """
    file = target if isinstance(target, (str, PathLike)) else None
    table = None if target is None or file is not None else json_of(target)  # type: ignore[arg-type]
    text = _core.extract_bag(
        fspath(bag),
        fspath(out),
        base=base,
        flange=flange,
        pose=pose,
        joints=joints,
        urdf=None if urdf is None else fspath(urdf),
        setup_name=setup,
        target_json=table,
        target_file=None if file is None else fspath(file),
        image=image,
        depth=depth,
        camera_info=camera_info,
        motion=motion,
        most=count("most", most),
        stamps=stamps,
    )
    return Extracted(**json.loads(text))
