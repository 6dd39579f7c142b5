#!/usr/bin/env bash
# Walks the paths of three users from the first file to the result, as a fresh installation has it.
#
#   tests/paths/run.sh PYTHON VENV     a Python with the wheel and its test requirements; a folder for tools of ROS
#
# What cannot be installed is skipped, and that is printed.
set -euo pipefail
cd "$(dirname "$0")/../.."
# not resolved: the Python of an environment is a link
python=$(realpath -s "$1")
tools=$(realpath -s "$2")
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT

# HANDEYE is what handeye_ros takes as the program; the paths take the one beside their Python
program=$(dirname "$python")/handeye
"$program" --version
unset HANDEYE HANDEYE_ROS_INSTALL HANDEYE_ROS_PYTHON

pip_install() { "$tools/bin/pip" install -q --disable-pip-version-check -r "$1" 2>"$work/pip.log"; }

if [ ! -x "$tools/bin/python" ]; then python3 -m venv "$tools"; fi
if [ -x "$tools/bin/colcon" ] || pip_install ros/requirements.txt; then
  export HANDEYE_ROS_INSTALL=$work/install
  colcon() { HANDEYE=$program PYTHONDONTWRITEBYTECODE=1 "$tools/bin/colcon" --log-base "$work/log" "$@"; }
  folders=(--base-paths ros --build-base "$work/build" --install-base "$HANDEYE_ROS_INSTALL")
  colcon list --base-paths ros | grep 'ros\.ament_python'
  colcon build "${folders[@]}" --event-handlers console_direct-
  colcon test "${folders[@]}" --event-handlers console_direct+ --return-code-on-test-failure \
    --pytest-args -p no:cacheprovider
else
  echo "SKIPPED the ament package: colcon cannot be installed: $(tail -n 1 "$work/pip.log")"
fi
has_rclpy() { "$tools/bin/python" -c 'import rclpy, geometry_msgs.msg, sensor_msgs.msg' 2>"$work/pip.log"; }
if has_rclpy || { pip_install ros/requirements-rclpy.txt && has_rclpy; }; then
  export HANDEYE_ROS_PYTHON=$tools/bin/python
else
  echo "SKIPPED rclpy: it cannot be installed: $(tail -n 1 "$work/pip.log")"
fi

for path in opencv_user integrator ros_user; do
  echo "-- $path"
  "$python" "tests/paths/$path.py"
done
