class Node:
    def __init__(self, *, package, executable, name, arguments):
        self.node_package, self.node_executable = package, executable
        self.__arguments = arguments  # under the name that the real one has as well
