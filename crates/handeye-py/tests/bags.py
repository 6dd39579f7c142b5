"""Records a simulated folder of captures as a ROS bag, with the writer of PyPI's rosbags."""

import json
from pathlib import Path

import cv2
import numpy as np
from rosbags.rosbag1 import Writer as Ros1Writer
from rosbags.rosbag2 import CompressionFormat, CompressionMode, StoragePlugin
from rosbags.rosbag2 import Writer as Ros2Writer
from rosbags.typesys import Stores, get_types_from_msg, get_typestore

START = 1_700_000_000_000_000_000  # ns
FIXED = {"world": "base_link", "wrist": "tool0"}  # static transforms: parent to child


def matrix(translation, xyzw):
    x, y, z, w = np.asarray(xyzw) / np.linalg.norm(xyzw)
    m = np.eye(4)
    m[:3, :3] = [
        [1 - 2 * (y * y + z * z), 2 * (x * y - z * w), 2 * (x * z + y * w)],
        [2 * (x * y + z * w), 1 - 2 * (x * x + z * z), 2 * (y * z - x * w)],
        [2 * (x * z - y * w), 2 * (y * z + x * w), 1 - 2 * (x * x + y * y)],
    ]
    m[:3, 3] = translation
    return m


def quaternion(m):
    """Of a rotation: by the largest component, so that nothing is divided by zero."""
    r = m[:3, :3]
    four = np.array(
        [
            1 + r[0, 0] - r[1, 1] - r[2, 2],
            1 - r[0, 0] + r[1, 1] - r[2, 2],
            1 - r[0, 0] - r[1, 1] + r[2, 2],
            1 + r[0, 0] + r[1, 1] + r[2, 2],
        ]
    )
    k = int(np.argmax(four))
    q = np.empty(4)
    q[k] = four[k]
    i, j, l = [(1, 2, 3), (0, 2, 3), (0, 1, 3), (0, 1, 2)][k]
    if k == 3:
        q[:3] = [r[2, 1] - r[1, 2], r[0, 2] - r[2, 0], r[1, 0] - r[0, 1]]
    else:
        a, b = sorted({0, 1, 2} - {k})
        q[a] = r[k, a] + r[a, k]
        q[b] = r[k, b] + r[b, k]
        q[3] = r[(k + 2) % 3, (k + 1) % 3] - r[(k + 1) % 3, (k + 2) % 3]
    return q / np.linalg.norm(q)


class Bag:
    """One writer for both generations of ROS."""

    def __init__(self, path, kind, packing=None):
        self.ros1 = kind == "ros1"
        self.types = get_typestore(Stores.ROS1_NOETIC if self.ros1 else Stores.ROS2_JAZZY)
        if self.ros1:
            text = "geometry_msgs/TransformStamped[] transforms"  # not among the writer's own
            self.types.register(get_types_from_msg(text, "tf2_msgs/msg/TFMessage"))
            self.writer = Ros1Writer(path)
        else:
            plugin = StoragePlugin.MCAP if kind == "mcap" else StoragePlugin.SQLITE3
            self.writer = Ros2Writer(path, version=9, storage_plugin=plugin)
            if packing:
                self.writer.set_compression(CompressionMode[packing.upper()], CompressionFormat.ZSTD)
        self.connections = {}
        self.count = 0
        self.messages = []

    def type(self, name):
        return self.types.types[name]

    def header(self, stamp, frame):
        time = self.type("builtin_interfaces/msg/Time")(sec=stamp // 10**9, nanosec=stamp % 10**9)
        header = self.type("std_msgs/msg/Header")
        if not self.ros1:
            return header(stamp=time, frame_id=frame)
        self.count += 1
        return header(seq=self.count, stamp=time, frame_id=frame)

    def add(self, topic, kind, recorded, **fields):
        """Messages are written in the order in which they were recorded."""
        self.messages.append((recorded, len(self.messages), topic, kind, fields))

    def close(self):
        with self.writer:
            for recorded, _, topic, kind, fields in sorted(self.messages, key=lambda m: m[:2]):
                if topic not in self.connections:
                    self.connections[topic] = self.writer.add_connection(
                        topic, kind, typestore=self.types
                    )
                message = self.type(kind)(**fields)
                data = self.types.serialize_ros1 if self.ros1 else self.types.serialize_cdr
                self.writer.write(self.connections[topic], recorded, data(message, kind))

    def transform(self, stamp, parent, child, m):
        vector = self.type("geometry_msgs/msg/Vector3")
        quat = self.type("geometry_msgs/msg/Quaternion")
        x, y, z, w = (float(v) for v in quaternion(m))
        return self.type("geometry_msgs/msg/TransformStamped")(
            header=self.header(stamp, parent),
            child_frame_id=child,
            transform=self.type("geometry_msgs/msg/Transform")(
                translation=vector(*(float(v) for v in m[:3, 3])), rotation=quat(x=x, y=y, z=z, w=w)
            ),
        )

    def transforms(self, topic, recorded, all_of_them):
        self.add(topic, "tf2_msgs/msg/TFMessage", recorded, transforms=all_of_them)

    def picture(self, topic, stamp, frame, image, late=0, packed=False):
        header = self.header(stamp, frame)
        if packed:
            data = cv2.imencode(".png", image)[1].ravel()
            kind = "sensor_msgs/msg/CompressedImage"
            self.add(topic, kind, stamp + late, header=header, format="png", data=data)
            return
        height, width = image.shape[:2]
        encoding = "16UC1" if image.dtype == np.uint16 else "mono8" if image.ndim == 2 else "bgr8"
        self.add(
            topic,
            "sensor_msgs/msg/Image",
            stamp + late,
            header=header,
            height=height,
            width=width,
            encoding=encoding,
            is_bigendian=0,
            step=image.strides[0],
            data=np.frombuffer(image.tobytes(), np.uint8),
        )

    def cloud(self, topic, stamp, frame, points):
        height, width = points.shape[:2]
        field = self.type("sensor_msgs/msg/PointField")
        fields = [field(name=n, offset=4 * k, datatype=7, count=1) for k, n in enumerate("xyz")]
        self.add(
            topic,
            "sensor_msgs/msg/PointCloud2",
            stamp,
            header=self.header(stamp, frame),
            height=height,
            width=width,
            fields=fields,
            is_bigendian=False,
            point_step=12,
            row_step=12 * width,
            data=np.frombuffer(points.astype(np.float32).tobytes(), np.uint8),
            is_dense=False,
        )

    def camera(self, topic, stamp, frame, size, k, d):
        names = "DKRP" if self.ros1 else "dkrp"
        k = np.asarray(k, float).reshape(3, 3)
        values = [
            np.asarray(d, float),
            k.ravel(),
            np.eye(3).ravel(),
            np.hstack([k, np.zeros((3, 1))]).ravel(),
        ]
        roi = self.type("sensor_msgs/msg/RegionOfInterest")(0, 0, 0, 0, False)
        self.add(
            topic,
            "sensor_msgs/msg/CameraInfo",
            stamp,
            header=self.header(stamp, frame),
            height=size[1],
            width=size[0],
            distortion_model="plumb_bob",
            **dict(zip(names, values)),
            binning_x=0,
            binning_y=0,
            roi=roi,
        )


def read_cell(folder):
    """Poses, pictures and camera of a simulated folder."""
    folder = Path(folder)
    rows = np.genfromtxt(folder / "robot.csv", delimiter=",", names=True, dtype=None, encoding="utf8")
    truth = json.loads((folder / "truth.json").read_text())
    images = [cv2.imread(str(p), cv2.IMREAD_GRAYSCALE) for p in sorted(folder.glob("images/*.png"))]
    return rows, truth, images


def organised(path, size):
    """The points of a cloud (PLY), H x W x 3."""
    head, body = path.read_bytes().split(b"end_header\n", 1)
    columns = sum(line.startswith(b"property float") for line in head.splitlines())
    return np.frombuffer(body, "<f4").reshape(size[1], size[0], columns)[..., :3]


def between(a, b, part):
    """The pose on the way from one to another, by a straight line and the shortest turn."""
    rotation, _ = cv2.Rodrigues(a[:3, :3].T @ b[:3, :3])
    step = cv2.Rodrigues(rotation * part)[0]
    m = np.eye(4)
    m[:3, :3] = a[:3, :3] @ step
    m[:3, 3] = a[:3, 3] + part * (b[:3, 3] - a[:3, 3])
    return m


def smooth(part):
    return 3 * part**2 - 2 * part**3


def dh(a, alpha, d, theta):
    """Denavit and Hartenberg's link, standard: Rz Tz Tx Rx."""
    ct, st, ca, sa = np.cos(theta), np.sin(theta), np.cos(alpha), np.sin(alpha)
    return np.array(
        [[ct, -st * ca, st * sa, a * ct], [st, ct * ca, -ct * sa, a * st], [0, sa, ca, d], [0, 0, 0, 1.0]]
    )


def forward(arm, q):
    m = np.eye(4)
    for joint, value in zip(arm["joints"], q):
        m = m @ dh(joint["a"], joint["alpha"], joint["d"], value + joint["theta_offset"])
    return m


def xyz_rpy(m):
    """As URDF has it: R = Rz(yaw) Ry(pitch) Rx(roll)."""
    r = m[:3, :3]
    pitch = np.arctan2(-r[2, 0], np.hypot(r[0, 0], r[1, 0]))
    if np.hypot(r[0, 0], r[1, 0]) < 1e-9:
        roll, yaw = np.arctan2(-r[1, 2], r[1, 1]), 0.0
    else:
        roll, yaw = np.arctan2(r[2, 1], r[2, 2]), np.arctan2(r[1, 0], r[0, 0])
    numbers = lambda v: " ".join(repr(float(x)) for x in v)
    return f'<origin xyz="{numbers(m[:3, 3])}" rpy="{numbers([roll, pitch, yaw])}"/>'


def urdf(arm):
    """The arm as a URDF; its last link is tool0."""
    links = ["base_link"] + [f"link_{k + 1}" for k in range(len(arm["joints"]))] + ["tool0"]
    text, before = "".join(f'<link name="{n}"/>\n' for n in ["world", *links]), np.eye(4)
    text += '<joint name="stand" type="fixed"><parent link="world"/><child link="base_link"/></joint>\n'
    for k, joint in enumerate(arm["joints"]):
        origin = xyz_rpy(before @ dh(0, 0, 0, joint["theta_offset"]))
        text += (
            f'<joint name="joint_{k + 1}" type="revolute"><parent link="{links[k]}"/><child link="{links[k + 1]}"/>'
            f'{origin}<axis xyz="0 0 1"/><limit lower="-7" upper="7" effort="1" velocity="1"/></joint>\n'
        )
        before = dh(joint["a"], joint["alpha"], joint["d"], 0)
    text += f'<joint name="end" type="fixed"><parent link="{links[-2]}"/><child link="tool0"/>{xyz_rpy(before)}</joint>'
    return f'<?xml version="1.0"?>\n<robot name="arm">\n{text}\n</robot>\n'


WRIST_FROM_TOOL0 = matrix([0.01, 0.02, 0.07], [0.1, 0.2, 0.3, 0.9])
WORLD_FROM_BASE = matrix([0.5, 0.0, 0.8], [0.0, 0.0, 0.7, 0.7])
CAMERA = "camera_color_optical_frame"


class Cell:
    """A simulated folder, its poses in order, and joint values where it has an arm."""

    def __init__(self, folder):
        folder = Path(folder)
        rows, self.truth, self.images = read_cell(folder)
        columns = [rows[name] for name in rows.dtype.names[1:]]
        numbers = np.array(columns, float).T
        self.arm = self.joints = None
        if (folder / "arm.json").exists():
            self.arm = json.loads((folder / "arm.json").read_text())
            self.joints = np.radians(numbers)
            self.poses = [forward(self.arm, q) for q in self.joints]
        else:
            self.poses = [matrix(n[:3], n[3:]) for n in numbers]
        k = next(
            line.split("=")[1]
            for line in (folder / "handeye.toml").read_text().splitlines()
            if line.startswith("fx")
        )
        height, width = self.images[0].shape
        self.size = (width, height)
        self.k = [[float(k), 0, (width - 1) / 2], [0, float(k), (height - 1) / 2], [0, 0, 1]]
        self.clouds = [organised(p, self.size) for p in sorted(folder.glob("scans/*.ply"))]

    def step(self, k, part):
        """The flange, and the joints, on the way from capture k to the next."""
        if self.arm is None:
            return between(self.poses[k], self.poses[k + 1], part), None
        q = self.joints[k] + part * (self.joints[k + 1] - self.joints[k])
        return forward(self.arm, q), q


def record_robot(bag, stamp, pose, q):
    """One sample of the robot, as its driver and the state publisher write it."""
    base_from_wrist = pose @ np.linalg.inv(WRIST_FROM_TOOL0)
    bag.transforms("/tf", stamp, [bag.transform(stamp, "base_link", "wrist", base_from_wrist)])
    if q is not None:
        names = [f"joint_{k + 1}" for k in range(len(q))]
        # drivers give them in an order of their own
        order = [2, 1, 0, *range(3, len(q))]
        bag.add(
            "/joint_states",
            "sensor_msgs/msg/JointState",
            stamp,
            header=bag.header(stamp, ""),
            name=[names[k] for k in order],
            position=np.array([q[k] for k in order]),
            velocity=np.array([]),
            effort=np.array([]),
        )


def record_still(cell, path, kind, rest_s=1.5, move_s=1.0, rate=50, depth=None, packed=False, gap=None, packing=None, before=None):
    """A robot that stops at every capture. While it moves, the camera shows the last picture, which is wrong there."""
    bag = Bag(path, kind, packing)
    topic = "/camera/color/image_raw" + ("/compressed" if packed else "")
    static = [("world", "base_link", WORLD_FROM_BASE), ("wrist", "tool0", WRIST_FROM_TOOL0)]
    static.append(("wrist", CAMERA, matrix([0.3, 0, 0], [0, 0, 0, 1])))  # where somebody thinks it is
    bag.transforms("/tf_static", START, [bag.transform(START, p, c, m) for p, c, m in static])
    if cell.arm is not None:
        bag.add("/robot_description", "std_msgs/msg/String", START, data=urdf(cell.arm))
    bag.camera("/camera/color/camera_info", START, CAMERA, cell.size, cell.k, [0.0] * 5)
    ticks = lambda seconds: range(int(seconds * rate))
    now = START
    for k in range(len(cell.poses)):
        for tick in ticks(rest_s + (move_s if k + 1 < len(cell.poses) else 0)):
            later = tick / rate - rest_s
            q = None if cell.joints is None else cell.joints[k]
            pose = cell.poses[k]
            if later > 0:
                pose, q = cell.step(k, smooth(later / move_s))
            if gap is None or k not in gap:
                record_robot(bag, now, pose, q)
            if tick % (rate // 5) == 3:
                bag.picture(topic, now + 1_234_567, CAMERA, cell.images[k], 30_000_000, packed)
                if depth == "depth":
                    image = np.round(1e3 * np.nan_to_num(cell.clouds[k][..., 2])).astype(np.uint16)
                    bag.picture("/camera/aligned_depth/image_raw", now + 2_000_000, CAMERA, image)
                elif depth == "cloud":
                    bag.cloud("/camera/points", now + 2_000_000, CAMERA, cell.clouds[k])
            now += 10**9 // rate
    if before is not None:
        before(bag)
    bag.close()


def order_of_least_way(poses):
    """From each pose to the nearest that is left."""
    way, left = [0], set(range(1, len(poses)))
    distance = lambda a, b: np.linalg.norm(poses[a][:3, 3] - poses[b][:3, 3]) + 0.3 * np.linalg.norm(
        cv2.Rodrigues(poses[a][:3, :3].T @ poses[b][:3, :3])[0]
    )
    while left:
        way.append(min(left, key=lambda b: distance(way[-1], b)))
        left.remove(way[-1])
    return way


def record_moving(cell, path, kind, offset_s=0.0, step_s=0.5, rate=100, gap=None):
    """A robot that never stops; a picture is taken wherever the folder has one. Camera time is robot time + offset."""
    from scipy.interpolate import CubicSpline
    from scipy.spatial.transform import Rotation, RotationSpline

    way = order_of_least_way(cell.poses)
    poses = [cell.poses[k] for k in way]
    times = step_s * (1 + np.arange(len(poses)) + 0.3 * np.sin(np.arange(len(poses))))
    places = CubicSpline(times, [p[:3, 3] for p in poses])
    turns = RotationSpline(times, Rotation.from_matrix([p[:3, :3] for p in poses]))
    bag = Bag(path, kind)
    if cell.arm is not None:
        values = CubicSpline(times, [cell.joints[k] for k in way])
        bag.add("/robot_description", "std_msgs/msg/String", START, data=urdf(cell.arm))
    bag.transforms("/tf_static", START, [bag.transform(START, "wrist", "tool0", WRIST_FROM_TOOL0)])
    bag.camera("/camera/camera_info", START, CAMERA, cell.size, cell.k, [0.0] * 5)
    for t in np.arange(times[0] - 0.2, times[-1] + 0.2, 1 / rate):
        if gap is not None and gap[0] < t < gap[1]:
            continue
        pose = np.eye(4)
        pose[:3, :3], pose[:3, 3] = turns(t).as_matrix(), places(t)
        q = None
        if cell.arm is not None:
            q = values(t)
            pose = forward(cell.arm, q)
        record_robot(bag, START + round(t * 1e9), pose, q)
    for t, k in zip(times, way):
        bag.picture("/camera/image_raw", START + round((t + offset_s) * 1e9), CAMERA, cell.images[k])
    bag.close()


def off(result, truth):
    """By how much the camera's place is off: mm and degrees."""
    found = result["hand_eye"]["mount_from_camera"]
    true = truth["mount_from_camera"]
    a, b = (matrix(p["translation_m"], p["rotation_xyzw"]) for p in (found, true))
    turn = np.linalg.norm(cv2.Rodrigues(a[:3, :3].T @ b[:3, :3])[0])
    return 1e3 * np.linalg.norm(a[:3, 3] - b[:3, 3]), np.degrees(turn)
