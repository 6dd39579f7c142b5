"""Reads and writes messages by rclpy: JSON on standard input, JSON out. ros_user.py runs it with a Python that has rclpy."""

import json
import sys

from geometry_msgs.msg import TransformStamped
from rclpy.serialization import deserialize_message, serialize_message
from sensor_msgs.msg import CameraInfo


def fill(message, fields):
    """Nested dicts into a message; names that it does not have are an error."""
    for name, value in fields.items():
        if isinstance(value, dict):
            fill(getattr(message, name), value)
        else:
            setattr(message, name, value)


given = json.load(sys.stdin)
camera_info = deserialize_message(bytes.fromhex(given["camera_info"]), CameraInfo)
written = TransformStamped()
fill(written, given["transform"])
read = deserialize_message(serialize_message(written), TransformStamped)
xyz = read.transform.translation
answer = {
    "camera_info": {"frame_id": camera_info.header.frame_id, "k": list(camera_info.k)},
    "transform": {
        "frame_id": read.header.frame_id,
        "child_frame_id": read.child_frame_id,
        "translation": [xyz.x, xyz.y, xyz.z],
    },
}
json.dump(answer, sys.stdout)
