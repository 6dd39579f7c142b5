"""From a ROS bag to the static transform of the camera.

    python ros_bag.py BAG BASE_FRAME FLANGE_FRAME [TARGET.toml]

Without a bag, one is recorded from a simulated cell (that needs `pip install rosbags`): an arm that stops at ten
places, its transforms on /tf, and a camera that never stops taking pictures.
"""

from __future__ import annotations

import json
import pathlib
import sys
import tempfile
from typing import Any

import numpy as np

import handeye

TARGET = {"kind": "checkerboard", "columns": 9, "rows": 6, "square_mm": 30.0}


def record(bag: pathlib.Path, cell: pathlib.Path) -> None:
    """What `ros2 bag record` would write: half a second at each place and half on the way to the next."""
    import cv2
    from rosbags.rosbag2 import StoragePlugin, Writer
    from rosbags.typesys import Stores, get_typestore

    types = get_typestore(Stores.ROS2_JAZZY)

    def make(kind: str, *values: Any) -> Any:
        return types.types[kind.replace("/", "/msg/")](*values)

    def header(ns: int, frame: str) -> Any:
        return make("std_msgs/Header", make("builtin_interfaces/Time", ns // 10**9, ns % 10**9), frame)

    poses = np.genfromtxt(cell / "robot.csv", delimiter=",", skip_header=1)[:, 1:]
    images = [cv2.imread(str(path), cv2.IMREAD_GRAYSCALE) for path in sorted(cell.glob("images/*.png"))]
    height, width = images[0].shape
    f, cx, cy = 0.9375 * width, (width - 1) / 2, (height - 1) / 2
    with Writer(bag, version=9, storage_plugin=StoragePlugin.MCAP) as writer:
        topics: dict[str, Any] = {}

        def write(topic: str, ns: int, kind: str, *values: Any) -> None:
            name = kind.replace("/", "/msg/")
            if topic not in topics:
                topics[topic] = writer.add_connection(topic, name, typestore=types)
            writer.write(topics[topic], ns, types.serialize_cdr(make(kind, *values), name))

        def send(topic: str, ns: int, kind: str, frame: str, *values: Any) -> None:
            write(topic, ns, "sensor_msgs/" + kind, header(ns, frame), height, width, *values)

        for tick in range(50 * len(poses) - 25):
            ns = 1_700_000_000_000_000_000 + tick * 20_000_000
            place, way = tick // 50, max(0, tick % 50 - 24) / 25
            x, y, z, *xyzw = poses[place]
            if way > 0:
                x, y, z, *xyzw = between(poses[place], poses[place + 1], way)
            vector = make("geometry_msgs/Vector3", x, y, z)
            transform = make("geometry_msgs/Transform", vector, make("geometry_msgs/Quaternion", *xyzw))
            stamped = make("geometry_msgs/TransformStamped", header(ns, "base_link"), "tool0", transform)
            write("/tf", ns, "tf2_msgs/TFMessage", [stamped])
            if tick % 5 == 2:
                roi = make("sensor_msgs/RegionOfInterest", 0, 0, 0, 0, False)
                k, d, r, p = [f, 0, cx, 0, f, cy, 0, 0, 1], [0] * 5, np.eye(3), [f, 0, cx, 0, 0, f, cy, 0, 0, 0, 1, 0]
                d, k, r, p = (np.asarray(v, float).ravel() for v in (d, k, r, p))
                send("/camera/camera_info", ns, "CameraInfo", "camera", "plumb_bob", d, k, r, p, 0, 0, roi)
                send("/camera/image_raw", ns, "Image", "camera", "mono8", 0, width, images[place].ravel())


def between(a: Any, b: Any, way: float) -> Any:
    """On the straight way from one pose to another."""
    b = np.where(np.arange(7) < 3, b, b * np.sign(a[3:] @ b[3:]))
    pose = (1 - way) * a + way * b
    pose[3:] /= np.linalg.norm(pose[3:])
    return pose


def main() -> None:
    work = pathlib.Path(tempfile.mkdtemp())
    truth = None
    if len(sys.argv) > 3:
        bag, base, flange = pathlib.Path(sys.argv[1]), sys.argv[2], sys.argv[3]
        target: Any = sys.argv[4] if len(sys.argv) > 4 else TARGET
    else:
        bag, base, flange, target = work / "bag", "base_link", "tool0", TARGET
        handeye.simulate(work / "cell", captures=10, width=960, height=600)
        truth = json.loads((work / "cell" / "truth.json").read_text())["mount_from_camera"]
        record(bag, work / "cell")

    contents = handeye.bag_contents(bag)
    for topic, about in contents.topics.items():
        print(f"{topic:22} {about.messages:5} x {about.type}")
    print("\n".join(contents.frames))

    captures = handeye.extract_bag(bag, work / "captures", base=base, flange=flange, setup="eye-in-hand", target=target)
    print("\n".join(captures.notes))
    if captures.questions:
        sys.exit("answer in " + str(work / "captures" / "handeye.toml") + ":\n" + "\n".join(captures.questions))

    calibration = handeye.calibrate(work / "captures", out=work / "result")
    print(f"{calibration.verdict}: {'; '.join(calibration.reasons)}")
    if not calibration.accepted:
        sys.exit("not to be used")
    print(json.dumps(calibration.to_ros(parent=flange, child="camera"), indent=2))
    if truth is not None:
        true = handeye.Pose("flange", "camera", rotation=truth["rotation_xyzw"], translation=truth["translation_m"])
        error_mm = 1e3 * float(np.linalg.norm((true.inverse() @ calibration.pose).translation))
        print(f"off the truth by {error_mm:.3f} mm")
        assert error_mm < 1.5


if __name__ == "__main__":
    main()
