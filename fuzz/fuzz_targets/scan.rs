//! Scans of every kind that is read.
#![no_main]

use handeye::Intrinsics;
use handeye_fuzz::{file, told};
use handeye_io::{ScanOptions, read_scan, units::LengthUnit};
use libfuzzer_sys::fuzz_target;

fuzz_target!(|data: &[u8]| {
    let Some(path) = file(data, &["ply", "pcd", "npy", "npz", "png", "tiff"]) else { return };
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
