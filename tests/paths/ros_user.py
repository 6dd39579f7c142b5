"""The path of a user of ROS 2: a bag with images, camera_info, tf and tf_static becomes a launch file with a static transform.

The package ros/handeye_ros does the same where colcon has built it ($HANDEYE_ROS_INSTALL: the install folder), and the ROS 2
client library reads the messages where it is installed ($HANDEYE_ROS_PYTHON: a Python with rclpy).
"""

import importlib.util
import json
import os
import pathlib
import subprocess
import sys
import time

import numpy as np
from session import Truth, distance_in_sigmas, found_in, holds, pose, program, run, skipped, work

import handeye

ROOT = pathlib.Path(__file__).resolve().parents[2]
ROS_TESTS = ROOT / "ros/handeye_ros/test"
sys.path += [str(ROOT / "crates/handeye-py/tests"), str(ROOT / "ros/handeye_ros"), str(ROS_TESTS)]
if importlib.util.find_spec("launch_ros") is None:
    sys.path.append(str(ROS_TESTS / "stubs"))
from bags import START, WRIST_FROM_TOOL0, Bag, Cell, matrix, record_robot  # noqa: E402
from transforms import CALIBRATION, published  # noqa: E402

COUNT = 10
BASE, FLANGE, OPTICAL, BODY = "base_link", "tool0", "camera_color_optical_frame", "camera_link"
# the driver's tree: the camera's body, and in it the optical frame
DRIVER = {
    (BODY, "camera_color_frame"): matrix([0.0, 0.015, 0.0], [0, 0, 0, 1]),
    ("camera_color_frame", OPTICAL): matrix([0, 0, 0], [-0.5, 0.5, -0.5, 0.5]),
}
CAMERA_TOPICS = "/camera/color"
BOARD = 'kind = "checkerboard"\ncolumns = 9\nrows = 6\nsquare_mm = 30.0\n'
FROM_BAG = ["--target", "board.toml", "--setup", "eye-in-hand", "--base", BASE, "--flange", FLANGE]


def record(cell, path, rate=25):
    """`ros2 bag record -a` while the robot goes from place to place: 1 s at each, 1 s to the next."""
    bag = Bag(path, "mcap")
    static = {("wrist", FLANGE): WRIST_FROM_TOOL0, **DRIVER}
    bag.transforms("/tf_static", START, [bag.transform(START, *names, m) for names, m in static.items()])
    for k, image in enumerate(cell.images):
        last = k + 1 == len(cell.images)
        for tick in range(rate * (1 if last else 2)):
            now = START + (2 * k * rate + tick) * 10**9 // rate
            on_the_way = max(0.0, tick / rate - 1)
            record_robot(bag, now, cell.step(k, on_the_way)[0] if on_the_way else cell.poses[k], None)
            if tick % 5 == 2:
                bag.camera(f"{CAMERA_TOPICS}/camera_info", now, OPTICAL, cell.size, cell.k, [0.0] * 5)
                bag.picture(f"{CAMERA_TOPICS}/image_raw", now, OPTICAL, image)
    bag.close()


def transform_of(options):
    """Of the options of a static_transform_publisher: parent, child, 4 x 4."""
    x, y, z, qx, qy, qz, qw = (float(options[f"--{name}"]) for name in ("x", "y", "z", "qx", "qy", "qz", "qw"))
    return options["--frame-id"], options["--child-frame-id"], matrix([x, y, z], [qx, qy, qz, qw])


def by_the_package(launch):
    """The same by the ament package, as `ros2 run` and `ros2 launch` start it."""
    install = os.environ.get("HANDEYE_ROS_INSTALL")
    if not install:
        skipped("ros2 run handeye_ros calibrate", "the package is not built (HANDEYE_ROS_INSTALL is not set)")
        return
    prefix = pathlib.Path(install) / "handeye_ros"
    script = prefix / "lib/handeye_ros/calibrate"
    setup = f". {install}/local_setup.sh && exec {script} session {' '.join(FROM_BAG)} --out by_ros"
    print(f"$ ros2 run handeye_ros calibrate session {' '.join(FROM_BAG)} --out by_ros", flush=True)
    done = subprocess.run(["sh", "-c", setup], capture_output=True, text=True)
    holds(done.returncode == 0, "the package calibrates the bag", done.stdout + done.stderr)
    name = "flange_from_camera.launch.py"
    same = pathlib.Path("by_ros", name).read_text() == launch.read_text()
    holds(same, f"by_ros/{name} is the launch file of the program")
    holds(f"child:={BODY}" in done.stdout, "it says which child to use beside the camera's driver", done.stdout)
    options = published(prefix / "share/handeye_ros/launch/calibration.launch.py", result=str(pathlib.Path("by_ros")))
    holds(options == published(launch), "its calibration.launch.py publishes the same static transform")


def by_rclpy(calibration):
    """Messages of the bag, and the result as a message, by the client library of ROS 2."""
    python = os.environ.get("HANDEYE_ROS_PYTHON")
    if not python:
        skipped("messages by rclpy", "no Python with rclpy is named (HANDEYE_ROS_PYTHON is not set)")
        return
    from rosbags.highlevel import AnyReader

    topic = f"{CAMERA_TOPICS}/camera_info"
    with AnyReader([pathlib.Path("session")]) as reader:
        of_topic = [c for c in reader.connections if c.topic == topic]
        _, _, camera_info = next(reader.messages(of_topic))
    given = {"camera_info": bytes(camera_info).hex(), "transform": calibration.to_ros(parent=FLANGE, child=OPTICAL)}
    words = [python, pathlib.Path(__file__).with_name("ros_messages.py")]
    done = subprocess.run(words, input=json.dumps(given), capture_output=True, text=True)
    holds(done.returncode == 0, "rclpy reads camera_info of the bag, and writes the result as TransformStamped", done.stderr)
    read = json.loads(done.stdout)
    names = read["transform"]["frame_id"], read["transform"]["child_frame_id"]
    holds(names == (FLANGE, read["camera_info"]["frame_id"]), f"the message goes from {names[0]} to the camera of the bag")
    apart = np.abs(np.array(read["transform"]["translation"]) - calibration.pose.translation).max()
    holds(apart == 0.0, "its numbers are those of the calibration")


def main():
    start = time.time()
    folder = work()
    os.environ["HANDEYE"] = program()  # of the launch file, too
    run("simulate", "sim", "--captures", COUNT, "--width", 640, "--height", 400, "--touches", 0, "--quiet")
    record(Cell("sim"), pathlib.Path("session"))
    truth = Truth("sim")
    pathlib.Path("board.toml").write_text(BOARD)

    print("1. calibrate, with the bag itself")
    _, error = run("calibrate", "session", expected=1)
    holds("handeye bag" in error, f"the error names the command to run: {error.strip()}", error)

    print("2. what the bag holds")
    out, _ = run("bag", "session")
    print("\n".join("  | " + line for line in out.splitlines()))
    for word in (f"{CAMERA_TOPICS}/image_raw", "/tf_static", BASE, FLANGE, OPTICAL, BODY):
        holds(word in out, f"{word} is listed", out)
    _, error = run("bag", "session", "--out", "captures", expected=2)
    holds("--base" in error and "--flange" in error, "without frames the error names --base and --flange", error)

    print("3. captures, then the calibration")
    out, errors = run("bag", "session", "--out", "captures", *FROM_BAG)
    holds("next: handeye calibrate captures" in out, f"one image of each of the {COUNT} places; the next command is named")
    out, errors = run("calibrate", "captures", "--out", "result", "--format", "ros2-launch")
    result, found = found_in("result")
    holds(out.strip().startswith("ACCEPTED") and f"{COUNT} of {COUNT} captures used" in out, "accepted", out + errors)
    mm, degrees = truth.off(found)
    far = distance_in_sigmas(result, truth)
    # 99.9 % of 6 degrees of freedom
    holds(far < 4.74, f"off the truth by {mm:.3f} mm, {degrees:.4f} degrees: {far:.1f} sigma of the stated covariance")

    print("4. the launch file")
    launch = pathlib.Path("result/flange_from_camera.launch.py")
    parent, child, numbers = transform_of(published(launch))
    holds((parent, child) == (FLANGE, OPTICAL), f"its frames are those of the bag: {parent}, {child}")
    apart = np.abs(numbers - found.matrix).max()
    holds(apart < 1e-8, f"its transform is that of calibration.json: they differ by {apart:.1e}")
    run("export", "result", "--format", "ros2-launch", "--child", BODY, "--out", "body.launch.py", "--quiet")
    parent, child, of_body = transform_of(published(pathlib.Path("body.launch.py")))
    body_from_optical = np.linalg.multi_dot([np.eye(4), *DRIVER.values()])
    apart = np.abs(of_body @ body_from_optical - found.matrix).max()
    holds((parent, child) == (FLANGE, BODY) and apart < 1e-8, f"of {BODY}: with the driver's tree it leads to the same place")
    holds(published(CALIBRATION, result="result") == published(launch), "calibration.launch.py publishes the same")
    imported, _ = run("import", launch, "--out", "back.json", "--setup", "eye-in-hand")
    back = pose("flange", "camera", json.loads(pathlib.Path("back.json").read_text()))
    apart = np.abs(back.matrix - found.matrix).max()
    holds(apart < 1e-8, f"handeye import reads it back: {apart:.1e}", imported)

    print("5. by ROS itself")
    by_the_package(launch)
    by_rclpy(handeye.calibrate("captures"))
    print(f"path of a ROS user: {time.time() - start:.0f} s")
    del folder


if __name__ == "__main__":
    main()
