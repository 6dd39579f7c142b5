//! Scans and meshes of every kind that is read.

use std::borrow::Cow;

use crate::{file, told};
use handeye::Intrinsics;
use handeye_io::{ScanOptions, is_mesh, read_mesh, read_scan, scan_unit, units::LengthUnit};

const KINDS: [&str; 15] = [
    "ply", "pcd", "npy", "npz", "png", "tiff", "xyz", "csv", "asc", "txt", "pts", "e57", "zdf",
    "stl", "obj",
];

/// Bytes of a page of E57, with its checksum.
const PAGE: usize = 1024;

/// Reads some bytes.
pub fn run(data: &[u8]) {
    let data = with_checksums(data);
    let Some(path) = file(&data, &KINDS) else { return };
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
}

/// Makes the checksums of E57 right, else hardly any input would come farther than to them. Where the
/// first byte is small they stay as they are.
fn with_checksums(data: &[u8]) -> Cow<'_, [u8]> {
    match data {
        [first @ 128..=255, file @ ..] if KINDS[usize::from(*first) % KINDS.len()] == "e57" => {
            let whole = file.chunks_exact(PAGE).flat_map(|page| {
                let content = &page[..PAGE - 4];
                [content, &castagnoli(content).to_be_bytes()].concat()
            });
            Cow::from_iter([*first].into_iter().chain(whole))
        }
        _ => data.into(),
    }
}

/// The checksum of a page.
fn castagnoli(bytes: &[u8]) -> u32 {
    let bit = |crc: u32| if crc & 1 == 1 { crc >> 1 ^ 0x82F6_3B78 } else { crc >> 1 };
    !bytes.iter().fold(!0, |crc, byte| (0..8).fold(crc ^ u32::from(*byte), |crc, _| bit(crc)))
}

/// A mesh that is read can be sampled, or it is told why not.
fn mesh(path: &std::path::Path) {
    let Some(mesh) = told(read_mesh(path, Some(LengthUnit::Millimetre))) else { return };
    let spacing = (mesh.area_m2() / 1e3).sqrt().max(1e-4);
    if let Ok(scan) = mesh.sampled(spacing) {
        assert!(scan.points().iter().flatten().all(|x| x.is_finite()));
    }
}
