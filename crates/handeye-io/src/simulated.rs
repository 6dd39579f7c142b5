//! A simulated cell as a folder of captures, with its truth beside it.
//!
//! The folder is what a user would have recorded: manifest, pictures or corners, depth images,
//! robot poses, touches. `truth.json` holds what nobody would know, and the list of all files, by
//! which a later run knows its own folder again.

use std::{
    fmt::Write as _,
    fs,
    io::Cursor,
    path::{Component, Path, PathBuf},
};

use handeye::{
    Base, Camera, Distortion, Flange, GrayImage, ImageCorner, Intrinsics, Pose, Scan, Setup,
    Target,
    simulate::{Recording, recording::placement_name},
};
use image::{ExtendedColorType, ImageEncoder, codecs::png};
use serde_json::{Value, json};

use crate::{Error, MANIFEST, files::write_atomically};

/// Name of the file with the truth.
pub const TRUTH: &str = "truth.json";
/// Version of its format.
const FORMAT: &str = "handeye-simulation-1";
/// Metres per unit of the depth images: 0.1 mm, up to 6.5 m.
const DEPTH_SCALE: f64 = 1e-4;

/// Writes everything into a folder, made if need be, and returns the names of the files; one
/// picture at a time is in memory. `with_images` asks for pictures instead of lists of corners.
///
/// # Errors
/// What cannot be written.
pub fn write(recording: &Recording, out: &Path, with_images: bool) -> Result<Vec<String>, Error> {
    let cell = recording.cell;
    let mut folder = Folder { out, names: vec![TRUTH.into()] };
    folder.add(MANIFEST, manifest(recording, with_images).as_bytes())?;
    folder.add("robot.csv", robot(&recording.base_from_flange).as_bytes())?;
    if !recording.touches.is_empty() {
        folder.add("touches.csv", touches(recording).as_bytes())?;
    }
    for k in 0..cell.captures + cell.placements {
        let name = name(recording, k);
        if with_images {
            folder.add(&format!("images/{name}.png"), &picture(&recording.picture(k)))?;
        } else {
            let corners = corners(&recording.corners(k));
            folder.add(&format!("corners/{name}.csv"), corners.as_bytes())?;
        }
        if let (true, Some(scan)) = (with_images, recording.scan(k)) {
            folder.add(&format!("scans/{name}.png"), &depth(&scan))?;
        }
    }
    let truth = format!("{:#}\n", truth(recording, &folder.names));
    write_atomically(&out.join(TRUTH), truth.as_bytes())?;
    Ok(folder.names)
}

/// Removes what an earlier simulation wrote into a folder; says whether there was one.
///
/// # Errors
/// What cannot be removed.
pub fn clear(out: &Path) -> Result<bool, Error> {
    let Some(names) = earlier(out) else { return Ok(false) };
    for path in names.iter().map(|name| out.join(name)).filter(|path| path.is_file()) {
        fs::remove_file(&path).map_err(|source| Error::Write { path, source })?;
    }
    Ok(true)
}

/// The files of an earlier simulation; only names inside the folder count.
fn earlier(out: &Path) -> Option<Vec<PathBuf>> {
    let truth: Value = serde_json::from_slice(&fs::read(out.join(TRUTH)).ok()?).ok()?;
    let own = truth["format"] == FORMAT;
    let names = truth["files"].as_array().filter(|_| own)?;
    let inside = |p: &PathBuf| p.components().all(|c| matches!(c, Component::Normal(_)));
    Some(names.iter().filter_map(Value::as_str).map(PathBuf::from).filter(inside).collect())
}

struct Folder<'a> {
    out: &'a Path,
    names: Vec<String>,
}

impl Folder<'_> {
    fn add(&mut self, name: &str, content: &[u8]) -> Result<(), Error> {
        let path = self.out.join(name);
        if let Some(parent) = path.parent() {
            let write = |source| Error::Write { path: parent.into(), source };
            fs::create_dir_all(parent).map_err(write)?;
        }
        write_atomically(&path, content)?;
        self.names.push(name.into());
        Ok(())
    }
}

fn name(recording: &Recording, k: usize) -> String {
    let captures = recording.cell.captures;
    if k < captures { format!("{:03}", k + 1) } else { placement_name(k - captures) }
}

// ---------------------------------------------------------------- manifest

fn manifest(recording: &Recording, with_images: bool) -> String {
    let cell = recording.cell;
    let setup = match cell.setup {
        Setup::EyeInHand => "eye-in-hand",
        Setup::EyeToHand => "eye-to-hand",
    };
    let mut text = format!("# A simulated cell; its truth is in {TRUTH}.\nsetup = \"{setup}\"\n");
    text += &format!("\n[target]\n{}", table(&json!(cell.target)));
    text += &format!("\n[camera]\n{}", camera(&cell.intrinsics));
    text += "\n[robot]\nposes = \"robot.csv\"\nnotation = \"quaternion-xyzw\"\n\
             length_unit = \"m\"\ndirection = \"base_from_flange\"\n";
    let scans = with_images && cell.depth.is_some();
    text += if with_images {
        "\n[images]\nfiles = \"images/[captures].png\"\n"
    } else {
        "\n[corners]\nfiles = \"corners/[captures].csv\"\npixel_origin = \"centre\"\n"
    };
    if scans {
        text += &format!(
            "\n[scans]\nfiles = \"scans/[captures].png\"\ndepth_scale = {DEPTH_SCALE}\n\n\
             [scans.camera]\n{}",
            camera(&cell.scan_intrinsics())
        );
    }
    if !with_images && cell.noise.corner_px > 0.0 {
        text += &format!("\n[noise]\nimage_px = {}\n", cell.noise.corner_px);
    }
    for k in 0..cell.placements {
        text += &placement(&placement_name(k), with_images, scans);
    }
    text += &touches_table(recording);
    // captures have names of three digits, placements have others
    text.replace("[captures]", "???")
}

fn placement(id: &str, with_images: bool, scans: bool) -> String {
    let mut text = format!("\n[[placements]]\nid = \"{id}\"\n");
    text += &if with_images {
        format!("image = \"images/{id}.png\"\n")
    } else {
        format!("corners = \"corners/{id}.csv\"\n")
    };
    if scans {
        text += &format!("scan = \"scans/{id}.png\"\n");
    }
    text
}

fn touches_table(recording: &Recording) -> String {
    if recording.touches.is_empty() {
        return String::new();
    }
    let tip = recording.believed_tip().vector() * 1e3;
    format!(
        "\n[touches]\nfile = \"touches.csv\"\nkind = \"flange-pose\"\n\
         notation = \"quaternion-xyzw\"\nlength_unit = \"m\"\n\n\
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

// ---------------------------------------------------------------- tables

const POSE: &str = "x,y,z,qx,qy,qz,qw";

fn pose(p: &Pose<Base, Flange>) -> String {
    let (t, q) = (p.translation(), p.iso().rotation.coords);
    format!("{},{},{},{},{},{},{}", t.x, t.y, t.z, q.x, q.y, q.z, q.w)
}

fn robot(poses: &[Pose<Base, Flange>]) -> String {
    let line = |(k, p): (usize, &Pose<Base, Flange>)| format!("{:03},{}\n", k + 1, pose(p));
    format!("capture,{POSE}\n") + &poses.iter().enumerate().map(line).collect::<String>()
}

fn touches(recording: &Recording) -> String {
    let mut text = format!("placement,corner,{POSE}\n");
    for touch in &recording.touches {
        if let Some(p) = &touch.base_from_flange {
            let _ = writeln!(text, "{},{},{}", touch.placement, touch.corner, pose(p));
        }
    }
    text
}

fn corners(all: &[ImageCorner]) -> String {
    let line = |c: &ImageCorner| format!("{},{},{}\n", c.id, c.pixel.x, c.pixel.y);
    "id,x,y\n".to_owned() + &all.iter().map(line).collect::<String>()
}

// ---------------------------------------------------------------- pictures

fn picture(image: &GrayImage) -> Vec<u8> {
    png_of(
        &image.to_u8(),
        (image.width(), image.height()),
        ExtendedColorType::L8,
        png::FilterType::NoFilter,
    )
}

fn depth(scan: &Scan) -> Vec<u8> {
    let unit = |p: &[f32; 3]| (f64::from(p[2]) / DEPTH_SCALE).round().clamp(0.0, 65535.0) as u16;
    // NaN becomes 0: nothing seen
    let bytes: Vec<u8> = scan.points().iter().flat_map(|p| unit(p).to_ne_bytes()).collect();
    png_of(&bytes, (scan.width(), scan.height()), ExtendedColorType::L16, png::FilterType::Adaptive)
}

/// Noise on flat fields is packed best unfiltered, slopes of depth as differences.
fn png_of(
    bytes: &[u8],
    (width, height): (usize, usize),
    colour: ExtendedColorType,
    filter: png::FilterType,
) -> Vec<u8> {
    let mut out = Cursor::new(Vec::new());
    let encoder = png::PngEncoder::new_with_quality(&mut out, png::CompressionType::Best, filter);
    let written = encoder.write_image(bytes, width as u32, height as u32, colour);
    written.expect("a picture of the size of its bytes, into memory");
    out.into_inner()
}

// ---------------------------------------------------------------- truth

fn truth(recording: &Recording, names: &[String]) -> Value {
    let (cell, truth) = (recording.cell, &recording.truth);
    let seen = |(k, p): (usize, &Pose<Camera, Target>)| {
        let place = truth.base_from_flange.get(k);
        json!({"id": name(recording, k), "camera_from_target": p, "base_from_flange": place})
    };
    let n = &cell.noise;
    json!({
        "format": FORMAT,
        "seed": cell.seed,
        "setup": cell.setup,
        "mount_from_camera": truth.hand_eye.mount_from_camera,
        "anchor_from_target": truth.hand_eye.anchor_from_target,
        "tip_error_mm": (truth.tip_error * 1e3).as_slice(),
        "noise": {
            "robot_repeatability_mm": n.robot_repeatability_m * 1e3,
            "robot_repeatability_deg": n.robot_repeatability_rad.to_degrees(),
            "robot_absolute_mm": n.robot_absolute_m * 1e3,
            "robot_absolute_deg": n.robot_absolute_rad.to_degrees(),
            "corner_px": n.corner_px,
            "touch_mm": n.touch_m * 1e3,
            "tip_mm": n.tip_m * 1e3,
            "depth_mm_at_1_m": cell.depth.map(|d| d.sigma_at_1m * 1e3),
            "picture_grey_values": cell.optics.noise,
            "picture_blur_px": cell.optics.blur_px,
        },
        "views": truth.camera_from_target.iter().enumerate().map(seen).collect::<Vec<_>>(),
        "files": names,
    })
}
