//! The manifest of a simulated cell.

use std::fmt::Write as _;

use handeye::{
    Distortion, Intrinsics,
    simulate::{Cell, Recording, cell::placement_name},
};
use serde_json::{Value, json};

use super::{ARM, ScanFormat, TRUTH, Writing, pictures::DEPTH_SCALE};

/// The text of `handeye.toml`.
pub(super) fn manifest(recording: &Recording, writing: Writing) -> String {
    let with_images = writing.images;
    let cell = recording.cell;
    let setup = cell.setup.name();
    let mut text = format!("# A simulated cell; its truth is in {TRUTH}.\nsetup = \"{setup}\"\n");
    text += &format!("\n[target]\n{}", table(&json!(cell.target)));
    text += &format!("\n[camera]\n{}", camera(&cell.intrinsics));
    text += "\n[robot]\nposes = \"robot.csv\"\ndirection = \"base_from_flange\"\n";
    text += &match cell.arm {
        Some(_) => format!("notation = \"joints\"\nangle_unit = \"deg\"\ndh = \"{ARM}\"\n"),
        None => "notation = \"quaternion-xyzw\"\nlength_unit = \"m\"\n".into(),
    };
    let scans = with_images && cell.depth.is_some();
    text += if cell.target.is_empty() {
        "" // a ball is seen in scans alone
    } else if with_images {
        "\n[images]\nfiles = \"images/[captures].png\"\n"
    } else {
        "\n[corners]\nfiles = \"corners/[captures].csv\"\npixel_origin = \"centre\"\n"
    };
    if scans {
        text += &format!(
            "\n[scans]\nfiles = \"scans/[captures].{}\"\n{}",
            writing.scans.ending(),
            scan_keys(cell, writing.scans)
        );
    }
    if !with_images && cell.noise.corner_px > 0.0 {
        text += &format!("\n[noise]\nimage_px = {}\n", cell.noise.corner_px);
    }
    for k in 0..cell.placements {
        text += &placement(&placement_name(k), with_images, scans.then_some(writing.scans));
    }
    text += &touches_table(recording);
    // captures have names of three digits, placements have others
    text.replace("[captures]", "???")
}

fn scan_keys(cell: &Cell, format: ScanFormat) -> String {
    match format {
        ScanFormat::DepthPng => format!(
            "depth_scale = {DEPTH_SCALE}\n\n[scans.camera]\n{}",
            camera(&cell.scan_intrinsics())
        ),
        ScanFormat::Ply | ScanFormat::Pcd => "length_unit = \"m\"\n".into(),
    }
}

fn placement(id: &str, with_images: bool, scans: Option<ScanFormat>) -> String {
    let mut text = format!("\n[[placements]]\nid = \"{id}\"\n");
    text += &if with_images {
        format!("image = \"images/{id}.png\"\n")
    } else {
        format!("corners = \"corners/{id}.csv\"\n")
    };
    if let Some(format) = scans {
        text += &format!("scan = \"scans/{id}.{}\"\n", format.ending());
    }
    text
}

fn touches_table(recording: &Recording) -> String {
    if recording.touches.is_empty() {
        return String::new();
    }
    let tip = recording.believed_tip().vector() * 1e3;
    let kind = match recording.cell.arm {
        Some(_) => "kind = \"joints\"\n",
        None => "kind = \"flange-pose\"\nnotation = \"quaternion-xyzw\"\nlength_unit = \"m\"\n",
    };
    format!(
        "\n[touches]\nfile = \"touches.csv\"\n{kind}\n\
         [touches.tip]\nin_flange_mm = [{:?}, {:?}, {:?}]\n",
        tip.x, tip.y, tip.z
    )
}

fn camera(c: &Intrinsics) -> String {
    let mut text = format!(
        "width = {}\nheight = {}\nfx = {:?}\nfy = {:?}\ncx = {:?}\ncy = {:?}\n",
        c.width, c.height, c.fx, c.fy, c.cx, c.cy
    );
    let model = match c.distortion {
        Distortion::None => return text + "distortion_model = \"none\"\n",
        Distortion::BrownConrady(_) => "brown-conrady",
        Distortion::KannalaBrandt(_) => "kannala-brandt",
    };
    let _ = writeln!(text, "distortion_model = \"{model}\"");
    let _ = writeln!(text, "distortion = {:?}", c.coefficients());
    text
}

/// A flat JSON object as TOML.
fn table(value: &Value) -> String {
    let entries = value.as_object().into_iter().flatten();
    entries.map(|(key, value)| format!("{key} = {value}\n")).collect()
}
