"""The wrapper, with a program that only writes down how it was called, and with the real one where it is installed."""

import json
import os
from pathlib import Path
import subprocess
import sys

import pytest
from transforms import CALIBRATION, published

from handeye_ros import calibrate, program

FAKE = """#!{python}
import json, pathlib, sys
words = sys.argv[1:]
with open({log!r}, 'a') as log:
    log.write(json.dumps(words) + '\\n')
if words[0] == 'calibrate':
    out = pathlib.Path(words[words.index('--out') + 1])
    out.mkdir(parents=True, exist_ok=True)
    (out / 'calibration.json').write_text({result!r})
if words[0] == 'export':
    print('# a launch file')
sys.exit({codes!r}.get(words[0], 0))
"""
CAMERA_LINK = {'name': 'camera_link', 'body_from_camera': {}}
RESULT = {'frames': {'mount': 'tool0', 'camera': 'optical', 'bodies': [CAMERA_LINK]}}
OPTIONS = ['--target', 'board.toml', '--setup', 'eye-in-hand', '--base', 'base_link', '--flange', 'tool0']


@pytest.fixture
def fake(tmp_path, monkeypatch):
    """fake(setup, step=exit code) puts a fake program in place; what it returns lists the calls so far."""
    log = tmp_path / 'log'

    def make(setup='eye-in-hand', **codes):
        path = tmp_path / 'fake-handeye'
        result = json.dumps({**RESULT, 'setup': setup})
        path.write_text(FAKE.format(python=sys.executable, log=str(log), result=result, codes=codes))
        path.chmod(0o755)
        monkeypatch.setenv('HANDEYE', str(path))
        monkeypatch.chdir(tmp_path)
        return lambda: [json.loads(line) for line in log.read_text().splitlines()]

    return make


def test_a_bag_becomes_captures_then_a_result_then_a_launch_file(fake, capsys):
    calls = fake()
    assert calibrate.main(['session', *OPTIONS, '--image', '/camera/image_raw', '--max-error-mm', '2']) == 0
    assert calls() == [
        ['bag', 'session', '--out', 'result/captures', *OPTIONS, '--image', '/camera/image_raw'],
        ['calibrate', 'result/captures', '--out', 'result', '--max-error-mm', '2'],
        ['export', 'result', '--format', 'ros2-launch'],
    ]
    assert Path('result/flange_from_camera.launch.py').read_text() == '# a launch file\n'
    printed = capsys.readouterr().out
    assert f'result:={os.getcwd()}/result\n' in printed
    assert 'give child:=camera_link' in printed


def test_of_a_camera_beside_the_robot_the_parent_is_the_base(fake):
    fake(setup='eye-to-hand')
    assert calibrate.main(['session', *OPTIONS]) == 0
    assert Path('result/base_from_camera.launch.py').exists()


def test_frames_go_to_the_export(fake, capsys):
    calls = fake()
    assert calibrate.main(['session', '--child', 'camera_link', '--parent', 'wrist', '--out', 'a']) == 0
    assert calls()[-1] == ['export', 'a', '--format', 'ros2-launch', '--parent', 'wrist', '--child', 'camera_link']
    printed = capsys.readouterr().out
    assert 'parent:=wrist child:=camera_link' in printed and 'note:' not in printed


def test_a_folder_of_captures_is_calibrated_as_it_is(fake):
    calls = fake()
    Path('captures').mkdir()
    Path('captures/handeye.toml').touch()
    assert calibrate.main(['captures', '--out', 'result']) == 0
    assert [words[0] for words in calls()] == ['calibrate', 'export']
    assert calibrate.main(['captures', '--base', 'base_link']) == 2


@pytest.mark.parametrize('step, code, count', [('bag', 1, 1), ('bag', 2, 1), ('calibrate', 1, 2), ('calibrate', 3, 2)])
def test_a_step_that_fails_ends_it_without_a_launch_file(step, code, count, fake, capsys):
    calls = fake(**{step: code})
    Path('result').mkdir()
    old = Path('result/flange_from_camera.launch.py')
    old.write_text('# of an older result')
    assert calibrate.main(['session', *OPTIONS]) == code
    assert len(calls()) == count
    assert old.exists() == (step == 'bag')
    if code == 3:
        assert 'no launch file is written' in capsys.readouterr().err


def test_options_stand_behind_the_bag(fake, capsys):
    fake()
    with pytest.raises(SystemExit) as caught:
        calibrate.main(['--image', '/topic', 'session'])
    assert caught.value.code == 2 and 'BAG stands first' in capsys.readouterr().err


def test_the_variable_comes_before_the_path_and_the_path_before_the_package(tmp_path, monkeypatch):
    for name in ('named', 'handeye'):
        (tmp_path / name).write_text('#!/bin/sh\n')
        (tmp_path / name).chmod(0o755)
    monkeypatch.setenv('PATH', str(tmp_path))
    monkeypatch.setenv('HANDEYE', str(tmp_path / 'named'))
    assert program.find() == [str(tmp_path / 'named')]
    monkeypatch.delenv('HANDEYE')
    assert program.find() == [str(tmp_path / 'handeye')]
    monkeypatch.setenv('PATH', '')
    monkeypatch.setattr(program.importlib.util, 'find_spec', lambda name: object())
    assert program.find() == [sys.executable, '-m', 'handeye']


def test_without_a_program_it_says_what_to_do(monkeypatch, capsys):
    monkeypatch.setenv('PATH', '')
    monkeypatch.delenv('HANDEYE', raising=False)
    monkeypatch.setattr(program.importlib.util, 'find_spec', lambda name: None)
    assert calibrate.main(['session', *OPTIONS]) == 1
    error = capsys.readouterr().err
    assert 'pip install handeye' in error and 'set HANDEYE' in error
    monkeypatch.setenv('HANDEYE', '/nowhere/handeye')
    assert calibrate.main(['session', *OPTIONS]) == 1
    assert "'/nowhere/handeye', which is no program" in capsys.readouterr().err
    with pytest.raises(program.ProgramError, match='set it to the path'):
        published(CALIBRATION, result='result')


def test_the_launch_file_needs_a_result(fake):
    fake()
    with pytest.raises(Exception, match='result'):
        published(CALIBRATION)


@pytest.fixture(scope='module')
def result(tmp_path_factory):
    """A result of the real program, with the frames of a bag."""
    try:
        words = program.find()
    except program.ProgramError as error:
        pytest.skip(str(error))
    folder = tmp_path_factory.mktemp('real')

    def handeye(*more):
        subprocess.run([*words, *more, '--quiet'], cwd=folder, check=True, stdout=subprocess.DEVNULL)

    handeye('simulate', 'cell', '--captures', '12', '--no-images', '--touches', '0')
    with open(folder / 'cell' / 'handeye.toml', 'a') as manifest:
        manifest.write(
            '[frames]\nmount = "tool0"\ncamera = "camera_color_optical_frame"\n[[frames.bodies]]\nname = "camera_link"\n'
            'body_from_camera = { translation_m = [0.0, 0.01, 0.0], rotation_xyzw = [-0.5, 0.5, -0.5, 0.5] }\n'
        )
    handeye('calibrate', 'cell', '--out', 'result')
    return folder / 'result'


@pytest.mark.parametrize('name', ['', 'calibration.json'])
def test_the_static_transform_is_that_of_the_result(name, result):
    found = published(CALIBRATION, result=str(result / name))
    assert (found['--frame-id'], found['--child-frame-id']) == ('tool0', 'camera_color_optical_frame')
    pose = json.loads((result / 'calibration.json').read_text())['hand_eye']['mount_from_camera']
    numbers = [float(found[f'--{name}']) for name in ('x', 'y', 'z', 'qx', 'qy', 'qz', 'qw')]
    assert numbers == pytest.approx([*pose['translation_m'], *pose['rotation_xyzw']], abs=1e-8)


def test_another_frame_of_the_camera_has_its_own_pose(result):
    optical = published(CALIBRATION, result=str(result))
    body = published(CALIBRATION, result=str(result), parent='wrist', child='camera_link')
    assert (body['--frame-id'], body['--child-frame-id']) == ('wrist', 'camera_link')
    apart = [float(body[key]) - float(optical[key]) for key in ('--x', '--y', '--z')]
    assert sum(d * d for d in apart) ** 0.5 == pytest.approx(0.01, abs=1e-6)


def test_a_result_that_was_not_accepted_is_refused(result, tmp_path):
    document = json.loads((result / 'calibration.json').read_text())
    document['verdict'] = 'rejected'
    (tmp_path / 'calibration.json').write_text(json.dumps(document))
    with pytest.raises(program.ProgramError, match='verdict is rejected'):
        published(CALIBRATION, result=str(tmp_path))
    with pytest.raises(program.ProgramError, match='does not exist'):
        published(CALIBRATION, result=str(tmp_path / 'missing'))
