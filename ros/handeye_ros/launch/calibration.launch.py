"""Publishes a calibration of handeye as a static transform.

ros2 launch handeye_ros calibration.launch.py result:=FOLDER

FOLDER is that of a result, or its calibration.json. The frames are those of the result; parent:= and child:= name others.
A result that was not accepted is refused.
"""

from pathlib import Path
from tempfile import TemporaryDirectory

from handeye_ros import program
from launch import LaunchDescription
from launch.actions import DeclareLaunchArgument, OpaqueFunction
from launch.launch_description_sources import get_launch_description_from_python_launch_file
from launch.substitutions import LaunchConfiguration


def generate_launch_description():
    return LaunchDescription([
        DeclareLaunchArgument('result', description='folder of a calibration, or its calibration.json'),
        DeclareLaunchArgument('parent', default_value='', description='parent frame, if not that of the result'),
        DeclareLaunchArgument(
            'child', default_value='', description='frame of the camera, if not its optical frame: as camera_link'
        ),
        OpaqueFunction(function=static_transform),
    ])


def static_transform(context):
    """The launch file that the program writes for this result."""
    result, parent, child = (LaunchConfiguration(name).perform(context) for name in ('result', 'parent', 'child'))
    text = program.launch_file(str(Path(result).expanduser()), parent, child)
    with TemporaryDirectory() as folder:
        path = Path(folder) / 'static_transform.launch.py'
        path.write_text(text)
        return [get_launch_description_from_python_launch_file(str(path))]
