"""`ros2 run handeye_ros calibrate BAG ...`: from a bag to a calibration and a launch file."""

import argparse
import json
from pathlib import Path
import sys

from . import program

ABOUT = """\
Calibrates from a ROS bag (MCAP, SQLite, ROS 1), or from a folder of captures that was made of one.

FOLDER gets the captures, calibration.json, report.html, and, if the result is accepted, flange_from_camera.launch.py (or
base_from_camera.launch.py), which publishes it as a static transform."""

EXAMPLES = """\
All other options go to `handeye bag`: --image, --depth, --camera-info, --pose, --joints, --urdf, --motion, --most,
--stamps; `handeye help bag` explains them. BAG stands first.

Examples:
  ros2 run handeye_ros calibrate session --target board.toml --setup eye-in-hand \\
      --base base_link --flange tool0
  ros2 launch handeye_ros calibration.launch.py result:=result

Exit codes are those of handeye: 0 accepted, 1 the input cannot be used, 2 wrong command line, 3 rejected or undetermined.
"""


def main(words=None):
    """The console script."""
    try:
        return calibrate(*arguments(sys.argv[1:] if words is None else words))
    except program.ProgramError as error:
        print(f'error: {error}', file=sys.stderr)
        return 1


def arguments(words):
    """The arguments of this script, and those for `handeye bag`."""
    parser = argparse.ArgumentParser(
        prog='ros2 run handeye_ros calibrate',
        usage='%(prog)s BAG [--out FOLDER] [--parent FRAME] [--child FRAME] [--max-error-mm MM] [OPTIONS OF handeye bag]',
        description=ABOUT,
        epilog=EXAMPLES,
        formatter_class=argparse.RawDescriptionHelpFormatter,
        allow_abbrev=False,
    )
    parser.add_argument('bag', metavar='BAG', help='the bag (a file, or its folder), or a folder with handeye.toml')
    parser.add_argument('--out', metavar='FOLDER', default='result', help='where the result goes [default: result]')
    parser.add_argument('--parent', metavar='FRAME', help='parent in the launch file [default: that of the bag]')
    parser.add_argument(
        '--child',
        metavar='FRAME',
        help='child in the launch file [default: the optical frame of the bag]; or another frame of the camera, as camera_link',
    )
    parser.add_argument('--max-error-mm', metavar='MM', help='accept only a smaller predicted error (95 %%)')
    if words and words[0].startswith('-') and words[0] not in ('-h', '--help'):
        parser.error('BAG stands first, options behind it')
    return parser.parse_known_args(words)


def calibrate(args, rest):
    """All steps; the exit code."""
    out = Path(args.out)
    captures = Path(args.bag)
    if not (captures / 'handeye.toml').exists():
        captures = out / 'captures'
        code = program.run(['bag', args.bag, '--out', str(captures), *rest])
        if code != 0:
            return code
    elif rest:
        print(f'error: {" ".join(rest)}: {captures} is a folder of captures, not a bag', file=sys.stderr)
        return 2
    # nobody may take an older result for this one
    for old in out.glob('*_from_camera.launch.py'):
        old.unlink()
    limit = [] if args.max_error_mm is None else ['--max-error-mm', args.max_error_mm]
    code = program.run(['calibrate', str(captures), '--out', str(out), *limit])
    if code == 0:
        write_launch_file(out, args)
    elif code == 3:
        print('not accepted: no launch file is written; report.html says why', file=sys.stderr)
    elif code == 1:
        repeat = f'ros2 run handeye_ros calibrate {captures} --out {out}'
        print(f'correct {captures / "handeye.toml"}, then: {repeat}', file=sys.stderr)
    return code


def write_launch_file(out, args):
    """The static transform, and what to do next."""
    result = json.loads((out / 'calibration.json').read_text())
    parent = {'eye-in-hand': 'flange', 'eye-to-hand': 'base'}[result['setup']]
    path = out / f'{parent}_from_camera.launch.py'
    path.write_text(program.launch_file(str(out), args.parent or '', args.child or ''))
    frames = ''.join(f' {key}:={value}' for key in ('parent', 'child') if (value := getattr(args, key)))
    print(f'\nlaunch file: {path}')
    print(f'next: ros2 launch handeye_ros calibration.launch.py result:={out.resolve()}{frames}')
    names = result.get('frames') or {}
    bodies = [body['name'] for body in names.get('bodies') or []]
    if bodies and not args.child:
        optical = names.get('camera', "the camera's optical frame")
        print(
            f'note: in the bag {optical} has the parent {bodies[0]} already, and a frame of tf has one parent only. Where '
            f"the camera's driver publishes it, give child:={bodies[-1]}"
        )


if __name__ == '__main__':
    sys.exit(main())
