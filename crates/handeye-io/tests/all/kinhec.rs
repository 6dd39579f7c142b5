//! A data set in KinHEC's layout, written by the Arrow library, as it is and packed in all ways that are read: imported
//! and calibrated to the truth it was made from. `HANDEYE_TEST_PYTHON` names the interpreter (default `python3`).

use std::{
    fs,
    path::{Path, PathBuf},
    process::Command,
};

use handeye::{Config, Setup, Verdict};
use handeye_io::{Declared, import, read_poses};
use nalgebra::{Isometry3, Vector3};

/// Two sequences: pairs of an eye in hand, and streams by two clocks of an eye to hand whose distances are doubled.
const WRITE: &str = "
import sys, os, numpy as np, pyarrow as pa, pyarrow.parquet as pq
from scipy.spatial.transform import Rotation as R
folder, options = sys.argv[1], eval(sys.argv[2])
def pose(t, r):
    m = np.eye(4); m[:3, :3] = R.from_rotvec(r).as_matrix(); m[:3, 3] = t
    return m
inv = np.linalg.inv
def flange(t):
    return pose([.4 + .2 * np.sin(.9 * t), .2 * np.cos(.7 * t), .5 + .1 * np.sin(1.1 * t)],
                [2.8 + .4 * np.sin(.8 * t), .5 * np.cos(.6 * t), .6 * np.sin(.5 * t)])
X, Y = pose([.05, -.02, .1], [.1, .2, 1.5]), pose([.5, .1, 0], [0, .1, .3])
def parts(prefix, poses):
    q = [R.from_matrix(p[:3, :3]).as_quat() for p in poses]
    c = {prefix + '_p' + a: [p[k, 3] for p in poses] for k, a in enumerate('xyz')}
    c.update({prefix + '_q' + a: [v[k] for v in q] for a, k in zip('wxyz', (3, 0, 1, 2))})
    return c
def write(name, columns):
    os.makedirs(os.path.dirname(os.path.join(folder, name)), exist_ok=True)
    pq.write_table(pa.table(columns), os.path.join(folder, name), **options)
def both(kind, ids, robot, camera):
    for what, prefix, frames in (('robot', 'base_ee', robot), ('camera', 'cam_target', camera)):
        columns = {'sequence_id': [i for i, f in zip(ids, frames) for _ in f],
                   'frame': pa.array([k for f in frames for k in range(len(f))], pa.int32()),
                   't': [t for f in frames for t, _ in f],
                   'q_meas': [[1.0, 2.0]] * sum(map(len, frames))}
        poses = [p for f in frames for _, p in f]
        columns.update(parts(prefix + '_meas', [np.eye(4) if p is None else p for p in poses]))
        for c in columns:
            if '_meas_' in c:
                columns[c] = [None if p is None else v for v, p in zip(columns[c], poses)]
        columns.update(parts(prefix + '_gt', [np.eye(4)] * len(poses)))
        write(what + '/' + kind + '.parquet', columns)
times = np.arange(24) * .9
pairs = [(t, flange(t)) for t in times]
seen = [(t, None if k == 5 else inv(p @ X) @ Y) for k, (t, p) in enumerate(pairs)]
clock = [(k * .02, flange(k * .02)) for k in range(600)]
late = []
for t in np.arange(5, 55) * .21:
    c = inv(X) @ flange(t) @ Y
    c[:3, 3] *= 2
    late.append((t + .25, c))
both('a-00000', ['a-000000', 'a-000001'], [pairs, clock], [seen, late])
n = 2
write('sequences.parquet', {'sequence_id': ['a-000000', 'a-000001'], 'configuration': ['eye_in_hand', 'eye_to_hand'],
      'sync': ['synchronous', 'asynchronous'], 'scale': [1.0, 2.0], 'scale_drift_std': [0.0, 0.0],
      'robot_file': ['robot/a-00000.parquet'] * n, 'camera_file': ['camera/a-00000.parquet'] * n})
";

/// The data set, or `None` with a printed reason where Python lacks the library.
fn written(name: &str, options: &str) -> Option<PathBuf> {
    let python = std::env::var("HANDEYE_TEST_PYTHON").unwrap_or_else(|_| "python3".into());
    let import = Command::new(&python).args(["-c", "import pyarrow, scipy"]).output();
    if !import.is_ok_and(|o| o.status.success()) {
        println!("SKIPPED: {python} has no modules pyarrow and scipy");
        return None;
    }
    let folder = std::env::temp_dir().join(format!("handeye-kinhec-{name}-{}", std::process::id()));
    fs::remove_dir_all(&folder).ok();
    fs::create_dir_all(&folder).unwrap();
    let run = Command::new(python).args(["-c", WRITE]).arg(&folder).arg(options).output().unwrap();
    assert!(run.status.success(), "{}", String::from_utf8_lossy(&run.stderr));
    Some(folder)
}

fn sequence(id: &str) -> Declared {
    Declared { sequence: Some(id.into()), ..Declared::default() }
}

#[track_caller]
fn calibrated(folder: &Path, id: &str) -> handeye::Calibration {
    let imported = import(folder, &sequence(id)).unwrap_or_else(|e| panic!("{e}"));
    let path = folder.join(&imported.name);
    fs::write(&path, &imported.text).unwrap();
    read_poses(&path).unwrap().calibrate(&Config::default()).unwrap()
}

#[track_caller]
fn is_at(found: &handeye::Calibration, truth: Isometry3<f64>) {
    assert_eq!(found.verdict, Verdict::Accepted, "{:?}", found.reasons);
    let apart = found.hand_eye.mount_from_camera.unwrap().iso().inverse() * truth;
    assert!(apart.translation.vector.norm() < 1e-3 && apart.rotation.angle() < 1e-3, "{apart}");
}

#[test]
fn sequences_are_calibrated_however_their_tables_are_packed() {
    let ways = [
        ("zstd", "dict(compression='zstd', row_group_size=100)"),
        ("snappy", "dict(compression='snappy')"),
        ("gzip", "dict(compression='gzip')"),
        ("plain", "dict(compression='none', use_dictionary=False)"),
    ];
    for (name, options) in ways {
        let Some(folder) = written(name, options) else { return };
        let x = Isometry3::new(Vector3::new(0.05, -0.02, 0.1), Vector3::new(0.1, 0.2, 1.5));
        let pairs = calibrated(&folder, "a-000000");
        assert_eq!((pairs.setup, pairs.captures.len()), (Setup::EyeInHand, 23), "one was not seen");
        is_at(&pairs, x);
        let streams = calibrated(&folder, "a-000001");
        assert_eq!(streams.setup, Setup::EyeToHand);
        is_at(&streams, x);
        assert!((streams.time_offset_s.unwrap() - 0.25).abs() < 1e-3);
        assert!((streams.scale.unwrap() - 2.0).abs() < 1e-2);
        fs::remove_dir_all(folder).unwrap();
    }
}

#[test]
fn what_is_missing_in_the_tables_is_told() {
    let Some(folder) = written("told", "dict(compression='zstd')") else { return };
    let error = import(&folder, &Declared::default()).unwrap_err().to_string();
    assert!(error.contains("which of its 2 sequences? a-000000, a-000001"), "{error}");
    let error = import(&folder, &sequence("b")).unwrap_err().to_string();
    assert!(error.contains("has no sequence b; there are a-000000, a-000001"), "{error}");
    let error = import(&folder, &sequence("a-00001")).unwrap_err().to_string();
    assert!(error.contains("has no sequence a-00001; did you mean a-000001?"), "{error}");
    let hand = Declared { setup: Some(Setup::EyeToHand), ..sequence("a-000000") };
    assert!(
        import(&folder, &hand).unwrap_err().to_string().contains("says that it is eye-in-hand")
    );
    let camera = folder.join("camera/a-00000.parquet");
    let whole = fs::read(&camera).unwrap();
    for length in [0, 3, 100, whole.len() / 2, whole.len() - 1] {
        fs::write(&camera, &whole[..length]).unwrap();
        let error = import(&folder, &sequence("a-000000")).unwrap_err().to_string();
        assert!(error.contains("a-00000.parquet"), "{error}");
    }
    for k in (4..whole.len()).step_by(97) {
        let mut broken = whole.clone();
        broken[k] ^= 0x55;
        fs::write(&camera, broken).unwrap();
        import(&folder, &sequence("a-000000")).ok(); // refused or read, but it ends
    }
    fs::remove_file(&camera).unwrap();
    let error = import(&folder, &sequence("a-000000")).unwrap_err();
    assert_eq!(error.code(), "cannot-read");
    fs::remove_dir_all(folder).unwrap();
}

#[test]
fn other_compressions_are_named() {
    let Some(folder) = written("brotli", "dict(compression='brotli')") else { return };
    let error = import(&folder, &sequence("a-000000")).unwrap_err().to_string();
    assert!(error.contains("write it with zstd, snappy or gzip"), "{error}");
    fs::remove_dir_all(folder).unwrap();
}
