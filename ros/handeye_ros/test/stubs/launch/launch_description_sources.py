import runpy


def get_launch_description_from_python_launch_file(path):
    return runpy.run_path(path)['generate_launch_description']()
