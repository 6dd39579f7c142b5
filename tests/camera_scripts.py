"""Runs the book's scripts that take images, with what their makers have for tests: a simulated Basler camera, and frames of the
software device of RealSense's library, recorded and played back. All of them are parsed.

    python tests/camera_scripts.py
"""

import ast
import os
import re
import runpy
import subprocess
import sys
import tempfile
import time
from pathlib import Path

import cv2
import numpy as np

PAGE = Path(__file__).parents[1] / "book/src/cameras.md"
WIDTH, HEIGHT = 1280, 720
DEPTH_MM = 600


def scripts():
    """The scripts by the first word after `grab.py for`."""
    blocks = re.findall(r"```python norun\n(# grab\.py for (\S+).*?)```", PAGE.read_text(encoding="utf-8"), re.S)
    return {name: text for text, name in blocks}


def have(module):
    try:
        __import__(module)
    except ImportError:
        print(f"{module} is not installed: its script is skipped")
        return False
    return True


def basler(script, folder):
    image = folder / "image.png"
    done = subprocess.run(
        [sys.executable, script, image], env={**os.environ, "PYLON_CAMEMU": "1"}, capture_output=True, text=True
    )
    assert done.returncode == 0, done.stderr
    picture = cv2.imread(str(image), cv2.IMREAD_UNCHANGED)
    assert picture.ndim == 2 and picture.dtype == np.uint8 and picture.std() > 1, picture.shape
    # without a camera it says so, and fails
    done = subprocess.run(
        [sys.executable, script, image], env={**os.environ, "PYLON_CAMEMU": "0"}, capture_output=True, text=True
    )
    assert done.returncode != 0 and "devic" in done.stderr.lower(), done.stderr
    print("Basler: an image of the simulated camera")


def record(path, color, depth):
    """Frames of a software device in a file."""
    import pyrealsense2 as rs

    device = rs.software_device()
    sensors = [device.add_sensor(name) for name in ("Stereo Module", "RGB Camera")]
    intrinsics = rs.intrinsics()
    intrinsics.width, intrinsics.height = WIDTH, HEIGHT
    intrinsics.fx = intrinsics.fy = 900.0
    intrinsics.ppx, intrinsics.ppy = (WIDTH - 1) / 2, (HEIGHT - 1) / 2
    intrinsics.model, intrinsics.coeffs = rs.distortion.none, [0.0] * 5

    def stream(kind, uid, form, size):
        video = rs.video_stream()
        video.type, video.uid, video.fmt, video.bpp = kind, uid, form, size
        video.index, video.width, video.height, video.fps, video.intrinsics = 0, WIDTH, HEIGHT, 30, intrinsics
        return video

    profiles = [
        sensors[0].add_video_stream(stream(rs.stream.depth, 10, rs.format.z16, 2)),
        sensors[1].add_video_stream(stream(rs.stream.color, 11, rs.format.rgb8, 3)),
    ]
    sensors[0].add_read_only_option(rs.option.depth_units, 0.001)
    same = rs.extrinsics()
    same.rotation, same.translation = [1.0, 0, 0, 0, 1, 0, 0, 0, 1], [0.0, 0, 0]
    profiles[0].register_extrinsics_to(profiles[1], same)
    recorder = rs.recorder(str(path), device)
    queue = rs.frame_queue(200)
    recorded = recorder.query_sensors()
    for sensor in recorded:
        sensor.open(sensor.get_stream_profiles()[0])
        sensor.start(queue)
    for number in range(60):
        for sensor, profile, pixels, size in zip(sensors, profiles, (depth, color), (2, 3)):
            frame = rs.software_video_frame()
            frame.pixels, frame.bpp, frame.stride = pixels, size, size * WIDTH
            frame.timestamp, frame.frame_number = number * 1000 / 30, number
            frame.domain, frame.profile = rs.timestamp_domain.hardware_clock, profile.as_video_stream_profile()
            if size == 2:
                frame.depth_units = 0.001
            sensor.on_video_frame(frame)
        time.sleep(0.01)
    for sensor in recorded:
        sensor.stop()
        sensor.close()
    recorder.pause()


def realsense(script, folder):
    import pyrealsense2 as rs

    color = np.full((HEIGHT, WIDTH, 3), 90, np.uint8)
    color[200:400, 300:900] = (200, 100, 50)
    depth = np.full((HEIGHT, WIDTH), DEPTH_MM, np.uint16)
    depth[:, :200] = 0
    record(folder / "frames.db3", color, depth)
    real = rs.config

    def played():
        config = real()
        config.enable_device_from_file(str(folder / "frames.db3"), False)
        return config

    image, scan = folder / "image.png", folder / "scan.npy"
    arguments, rs.config = sys.argv, played
    sys.argv = ["grab.py", str(image), str(scan)]
    try:
        runpy.run_path(str(script))
    finally:
        sys.argv, rs.config = arguments, real
    assert np.array_equal(cv2.imread(str(image))[:, :, ::-1], color)
    points = np.load(scan)
    assert points.shape == (HEIGHT, WIDTH, 3)
    middle = points[HEIGHT // 2, WIDTH // 2]
    assert abs(middle[2] - DEPTH_MM * 1e-3) < 1e-6 and abs(middle[0]) < 1e-3, middle
    right = points[HEIGHT // 2, WIDTH - 50]
    assert abs(right[0] - (WIDTH - 50 - (WIDTH - 1) / 2) / 900 * 0.6) < 1e-3, right
    assert not points[HEIGHT // 2, 100].any(), "nothing was measured there"
    print("RealSense: image and points of one frame, in metres")


def main():
    found = scripts()
    assert set(found) == {"Basler", "RealSense", "Zivid", "Photoneo", "Mech-Eye"}, set(found)
    for text in found.values():
        ast.parse(text)
    with tempfile.TemporaryDirectory() as root:
        for name, module, run in [("Basler", "pypylon", basler), ("RealSense", "pyrealsense2", realsense)]:
            script = Path(root, f"{name}.py")
            script.write_text(found[name], encoding="utf-8")
            if have(module):
                run(script, Path(root))


main()
