"""What a launch file publishes, evaluated with the launch modules."""

from pathlib import Path

from launch import LaunchContext
from launch.launch_description_sources import get_launch_description_from_python_launch_file

CALIBRATION = Path(__file__).parent.parent / 'launch' / 'calibration.launch.py'


def published(launch_file, **arguments):
    """The arguments of the one static_transform_publisher that a launch file starts: option to value."""
    context = LaunchContext()
    context.launch_configurations.update(arguments)
    nodes = list(nodes_of(get_launch_description_from_python_launch_file(str(launch_file)), context))
    assert [(n.node_package, n.node_executable) for n in nodes] == [('tf2_ros', 'static_transform_publisher')]
    words = nodes[0]._Node__arguments
    return dict(zip(words[::2], words[1::2]))


def nodes_of(entity, context):
    if hasattr(entity, 'node_executable'):
        yield entity
        return
    inner = entity.entities if hasattr(entity, 'entities') else entity.execute(context)
    for each in inner or []:
        yield from nodes_of(each, context)
