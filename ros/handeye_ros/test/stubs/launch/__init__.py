"""As much of the package launch of ROS 2 as the launch files here use, for tests without ROS."""


class LaunchContext:
    def __init__(self):
        self.launch_configurations = {}


class LaunchDescription:
    def __init__(self, entities):
        self.entities = entities

    def execute(self, context):
        return self.entities
