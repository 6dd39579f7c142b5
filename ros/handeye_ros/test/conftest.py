"""The launch modules of ROS where they are installed, else stubs; the program where it is installed."""

import importlib.util
from pathlib import Path
import sys

HERE = Path(__file__).parent
sys.path.insert(0, str(HERE.parent))
if importlib.util.find_spec('launch_ros') is None:
    sys.path.insert(0, str(HERE / 'stubs'))
