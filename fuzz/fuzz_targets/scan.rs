//! Scans and meshes of every kind that is read.
#![no_main]

use std::{panic, sync::Once};

use handeye::Intrinsics;
use handeye_fuzz::{file, told};
use handeye_io::{ScanOptions, is_mesh, read_mesh, read_scan, scan_unit, units::LengthUnit};
use libfuzzer_sys::fuzz_target;

const KINDS: [&str; 15] = [
    "ply", "pcd", "npy", "npz", "png", "tiff", "xyz", "csv", "asc", "txt", "pts", "e57", "zdf", "stl",
    "obj",
];

fuzz_target!(|data: &[u8]| {
    // Panics of other crates that are caught and told are no faults: only those that leave this
    // function end the program.
    static QUIET: Once = Once::new();
    QUIET.call_once(|| panic::set_hook(Box::new(|what| eprintln!("panicked: {what}"))));
    let Some(path) = file(data, &KINDS) else { return };
    scan_unit(&path);
    if is_mesh(&path) {
        mesh(&path);
    }
    told(read_scan(&path, &ScanOptions::default()));
    let options = ScanOptions {
        length_unit: Some(LengthUnit::Millimetre),
        depth_scale: Some(1e-3),
        organised: None,
        intrinsics: Some(Intrinsics::pinhole(8, 6, 9.0, 9.0, 3.5, 2.5)),
    };
    if let Some(scan) = told(read_scan(&path, &options)) {
        assert_eq!(scan.points().len(), scan.width() * scan.height());
    }
});

/// A mesh that is read can be sampled, or it is told why not.
fn mesh(path: &std::path::Path) {
    let Some(mesh) = told(read_mesh(path, Some(LengthUnit::Millimetre))) else { return };
    let spacing = (mesh.area_m2() / 1e3).sqrt().max(1e-4);
    if let Ok(scan) = mesh.sampled(spacing) {
        assert!(scan.points().iter().flatten().all(|x| x.is_finite()));
    }
}
