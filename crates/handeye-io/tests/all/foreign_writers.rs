//! What other programs write: E57 of libE57, ZDF of the netCDF library, meshes of trimesh, to the last bit.
//! `HANDEYE_TEST_PYTHON` names the interpreter (default `python3`).

use std::{
    fs,
    path::{Path, PathBuf},
    process::Command,
};

use handeye_io::{ScanOptions, is_mesh, read_mesh, read_scan, scan_unit, units::LengthUnit};

const SIZE: (usize, usize) = (70, 50);

fn folder() -> PathBuf {
    let folder = std::env::temp_dir().join(format!("handeye-foreign-{}", std::process::id()));
    fs::create_dir_all(&folder).unwrap();
    folder
}

/// Points of a bent surface about half a metre away, in units of a metre; every seventh is missing.
fn points(metre: f32) -> Vec<[f32; 3]> {
    let point = |k: usize| {
        let (x, y) = ((k % SIZE.0) as f32 * 0.0031, (k / SIZE.0) as f32 * 0.0029);
        let seen = [x, y, 0.5 + (7.0 * x).sin() * 0.031 + y * y].map(|x| x * metre);
        if k % 7 == 3 { [f32::NAN; 3] } else { seen }
    };
    (0..SIZE.0 * SIZE.1).map(point).collect()
}

/// Runs a script on the points and the folder; `false` with a printed reason where Python lacks the module.
fn written(module: &str, script: &str, points: &[[f32; 3]]) -> bool {
    let python = std::env::var("HANDEYE_TEST_PYTHON").unwrap_or_else(|_| "python3".into());
    let import = Command::new(&python).args(["-c", &format!("import numpy, {module}")]).output();
    if !import.is_ok_and(|o| o.status.success()) {
        println!("skipped: {python} has no module {module}");
        return false;
    }
    let raw = folder().join(format!("{module}.raw"));
    let bytes: Vec<u8> = points.as_flattened().iter().flat_map(|x| x.to_le_bytes()).collect();
    fs::write(&raw, bytes).unwrap();
    let head = "import sys, os, numpy\np = numpy.fromfile(sys.argv[1], '<f4').reshape(-1, 3)\n\
                def out(name):\n    path = os.path.join(sys.argv[2], name)\n    \
                os.path.exists(path) and os.remove(path)\n    return path\n";
    let run = Command::new(python)
        .args(["-c", &format!("{head}{script}")])
        .args([&raw, &folder()])
        .output()
        .unwrap();
    assert!(run.status.success(), "{}", String::from_utf8_lossy(&run.stderr));
    true
}

fn same(found: &[[f32; 3]], expected: &[[f32; 3]], path: &Path) {
    assert_eq!(found.len(), expected.len(), "{}", path.display());
    for (k, (a, b)) in found.iter().zip(expected).enumerate() {
        let equal = a == b || a.iter().chain(b).all(|x| x.is_nan());
        assert!(equal, "{} {k}: {a:?}, {b:?}", path.display());
    }
}

#[test]
fn e57_of_lib_e57() {
    let script = "
import pye57
seen = numpy.isfinite(p[:, 0])
k = numpy.arange(len(p))
def data(which, more):
    q = numpy.where(numpy.isfinite(p), p, 0.25)[which]
    d = dict(cartesianX=q[:, 0].astype('d'), cartesianY=q[:, 1].astype('d'), cartesianZ=q[:, 2].astype('d'))
    d.update({n: v[which] for n, v in more.items()})
    return d
grid = dict(rowIndex=(k // 70).astype('H'), columnIndex=(k % 70).astype('H'),
            intensity=(k * 0.5).astype('f'), cartesianInvalidState=(~seen).astype('b'))
e = pye57.E57(out('grid.e57'), mode='w')
e.write_scan_raw(data(k >= 0, grid), translation=numpy.array([1.0, 2.0, 3.0]))
e.close()
e = pye57.E57(out('several.e57'), mode='w')
e.write_scan_raw(data(seen, {}))
e.write_scan_raw(data(seen, {}), translation=numpy.array([0.5, 0.0, -0.25]), rotation=numpy.array([0.0, 1.0, 0.0, 0.0]))
e.close()
";
    let given = points(1.0);
    if !written("pye57", script, &given) {
        return;
    }
    let grid = folder().join("grid.e57");
    let scan = read_scan(&grid, &ScanOptions::default()).unwrap();
    assert_eq!((scan.width(), scan.height()), SIZE);
    same(scan.points(), &given, &grid);
    let several = folder().join("several.e57");
    let scan = read_scan(&several, &ScanOptions::default()).unwrap();
    let seen: Vec<[f32; 3]> =
        given.into_iter().filter(|p| p[0].is_finite() && *p != [0.0; 3]).collect();
    let (one, other) = scan.points().split_at(seen.len());
    same(one, &seen, &several);
    // half a turn about x
    let turned = |p: &[f32; 3]| [p[0] + 0.5, -p[1], -p[2] - 0.25];
    for (a, b) in other.iter().zip(seen.iter().map(turned)) {
        assert!((0..3).all(|i| (a[i] - b[i]).abs() < 1e-6), "{a:?} {b:?}");
    }
}

#[test]
fn zdf_of_the_netcdf_library() {
    let script = "
import netCDF4
for name, options in (('plain.zdf', {}), ('packed.zdf', dict(zlib=True, shuffle=True)),
                      ('parts.zdf', dict(zlib=True, complevel=9, chunksizes=(16, 32, 3), fletcher32=True))):
    with netCDF4.Dataset(out(name), 'w', format='NETCDF4') as f:
        g = f.createGroup('data')
        for n, size in (('rows', 50), ('cols', 70), ('xyz', 3), ('rgba', 4)):
            g.createDimension(n, size)
        g.createVariable('rgba_image', 'u1', ('rows', 'cols', 'rgba'))[:] = 7
        g.createVariable('pointcloud', 'f4', ('rows', 'cols', 'xyz'), fill_value=False, **options)[:] = p.reshape(50, 70, 3)
        g.createVariable('contrast', 'f4', ('rows', 'cols'))[:] = 1.5
";
    let given = points(1000.0);
    if !written("netCDF4", script, &given) {
        return;
    }
    let metres: Vec<[f32; 3]> =
        given.iter().map(|p| p.map(|x| (f64::from(x) / 1000.0) as f32)).collect();
    for name in ["plain.zdf", "packed.zdf", "parts.zdf"] {
        let path = folder().join(name);
        assert_eq!(scan_unit(&path), Some(LengthUnit::Millimetre));
        let scan = read_scan(&path, &ScanOptions::default()).unwrap();
        assert_eq!((scan.width(), scan.height()), SIZE);
        same(scan.points(), &metres, &path);
    }
    for (name, length) in [("packed.zdf", 9000), ("plain.zdf", 40_000)] {
        let whole = fs::read(folder().join(name)).unwrap();
        let cut = folder().join("cut.zdf");
        fs::write(&cut, &whole[..length]).unwrap();
        let message = read_scan(&cut, &ScanOptions::default()).unwrap_err().to_string();
        assert!(message.contains("cut.zdf: cannot be read as ZDF ("), "{message}");
    }
}

#[test]
fn zdf_without_points_of_three_numbers_is_refused() {
    let script = "
import netCDF4
for name, group, dims, kind in (('flat.zdf', 'data', (50, 70), 'f4'), ('other.zdf', 'else', (50, 70, 3), 'f4'),
                                ('huge.zdf', 'data', (900000, 900000, 3), 'f4'), ('wide.zdf', 'data', (9000, 9000, 3), 'f4')):
    with netCDF4.Dataset(out(name), 'w', format='NETCDF4') as f:
        g = f.createGroup(group)
        names = []
        for k, size in enumerate(dims):
            names.append(g.createDimension('d%d' % k, size).name)
        g.createVariable('pointcloud', kind, names, zlib=True, chunksizes=[min(d, 64) for d in dims])
";
    if !written("netCDF4", script, &points(1.0)) {
        return;
    }
    for (name, expected) in [
        (
            "flat.zdf",
            "flat.zdf: data/pointcloud of shape [50, 70] is no scan; it should be height x width x 3",
        ),
        ("other.zdf", "other.zdf: cannot be read as ZDF ("),
        (
            "huge.zdf",
            "huge.zdf: the number of points is 810000000000, more than the limit of 100000000; is the file damaged?",
        ),
        (
            "wide.zdf",
            "wide.zdf: is cut short: the header promises 81000000 points; copy or record it again",
        ),
    ] {
        let path = folder().join(name);
        let message = read_scan(&path, &ScanOptions::default()).unwrap_err().to_string();
        assert!(message.contains(expected), "{message}");
    }
}

#[test]
fn meshes_of_trimesh() {
    let script = "
import trimesh
p = numpy.where(numpy.isfinite(p), p, 0.125)
k = numpy.arange(70 * 49).reshape(49, 70)[:, :69].ravel()
faces = numpy.concatenate([numpy.stack([k, k + 1, k + 70], 1), numpy.stack([k + 1, k + 71, k + 70], 1)])
m = trimesh.Trimesh(p, faces, process=False, validate=False)
m.export(out('binary.stl'))
m.export(out('text.stl'), file_type='stl_ascii')
m.export(out('mesh.obj'), digits=12)
m.export(out('binary.ply'))
m.export(out('text.ply'), encoding='ascii')
";
    let given = points(1.0);
    if !written("trimesh", script, &given) {
        return;
    }
    let vertices: Vec<[f32; 3]> =
        given.iter().map(|p| if p[0].is_nan() { [0.125; 3] } else { *p }).collect();
    let cells = |next: [u32; 3]| {
        (0..49u32).flat_map(move |i| (0..69).map(move |j| next.map(|n| i * 70 + j + n)))
    };
    let triangles: Vec<[u32; 3]> = cells([0, 1, 70]).chain(cells([1, 71, 70])).collect();
    let place = |t: &[u32; 3]| t.map(|v| vertices[v as usize]);
    for (name, rounding) in [
        ("binary.stl", 0.0),
        ("binary.ply", 0.0),
        ("mesh.obj", 0.0),
        // in text they are written with eight digits
        ("text.stl", 1e-8),
        ("text.ply", 1e-8),
    ] {
        let path = folder().join(name);
        assert!(is_mesh(&path), "{name}");
        let mesh = read_mesh(&path, Some(LengthUnit::Metre)).unwrap();
        assert_eq!(mesh.triangles().len(), triangles.len(), "{name}");
        for (found, expected) in mesh.triangles().iter().zip(&triangles) {
            let found = found.map(|v| mesh.vertices()[v as usize]);
            let equal = found
                .as_flattened()
                .iter()
                .zip(place(expected).as_flattened())
                .all(|(a, b)| (a - b).abs() <= rounding);
            assert!(equal, "{name}: {found:?} {:?}", place(expected));
        }
    }
}
