"""Finds the program handeye, and runs it."""

import importlib.util
import os
import shutil
import subprocess
import sys

VARIABLE = 'HANDEYE'
MISSING = (
    'the program handeye is not installed: no `handeye` is on the PATH, and this Python has no package `handeye`. '
    'Install its wheel (pip install handeye-*.whl) or its Debian package (apt install ./handeye_*.deb), '
    f'or set {VARIABLE} to the path of the program'
)


class ProgramError(RuntimeError):
    """The program is missing, or it refused its input; the message says what to do."""


def find():
    """Words that start the program: of $HANDEYE, of the PATH, or of the package of this Python."""
    named = os.environ.get(VARIABLE)
    if named:
        path = shutil.which(named)
        if path is None:
            raise ProgramError(f'{VARIABLE} is {named!r}, which is no program that can be run: set it to the path of handeye')
        return [path]
    path = shutil.which('handeye')
    if path is not None:
        return [path]
    if importlib.util.find_spec('handeye') is not None:
        return [sys.executable, '-m', 'handeye']
    raise ProgramError(MISSING)


def run(words):
    """Runs the program on this terminal; its exit code."""
    return subprocess.run([*find(), *words]).returncode


def output(words):
    """What the program prints; ProgramError with its message where it fails."""
    done = subprocess.run([*find(), *words], stdin=subprocess.DEVNULL, capture_output=True, text=True)
    if done.returncode != 0:
        raise ProgramError(done.stderr.strip() or f'handeye ended with exit code {done.returncode}')
    return done.stdout


def launch_file(result, parent='', child=''):
    """The text of a launch file that publishes a result (a folder, or its calibration.json) as a static transform."""
    frames = [*(['--parent', parent] if parent else []), *(['--child', child] if child else [])]
    return output(['export', result, '--format', 'ros2-launch', *frames])
