//! Cameras in YAML, JSON and XML: ROS camera_info, OpenCV FileStorage, Kalibr camchains, and files
//! that name `fx fy cx cy` or a matrix somewhere.

use std::path::Path;

use super::found::Found;
use crate::{
    error::{Error, Place, malformed},
    tree::Tree,
};

const MATRIX: [&str; 12] = [
    "camera_matrix",
    "cameraMatrix",
    "camera_matrix_",
    "Camera_Matrix",
    "K",
    "k",
    "mtx",
    "matrix_3x3",
    "intrinsics_K",
    "intrinsic_matrix",
    "camera_intrinsics",
    "intrinsics",
];
const COEFFICIENTS: [&str; 12] = [
    "distortion_coefficients",
    "distortion_coeffs",
    "Distortion_Coefficients",
    "dist_coeffs",
    "dist_coeff",
    "distCoeffs",
    "distortion",
    "coefficients",
    "dist",
    "coeffs",
    "D",
    "d",
];

/// Keys of serial numbers, without capitals, `_`, `-` and blanks.
const SERIALS: [&str; 6] = [
    "serial",
    "serialnumber",
    "serialno",
    "cameraserial",
    "cameraserialnumber",
    "deviceserialnumber",
];
/// Keys of the camera's model, likewise; ROS calls it the camera's name.
const MODELS: [&str; 3] = ["cameraname", "devicename", "modelname"];

/// What a file says of the camera itself.
#[derive(Debug, Default)]
pub(crate) struct Maker {
    pub(crate) model: Option<String>,
    pub(crate) serial: Option<String>,
}

/// Of a document; of one with several cameras, of that which is called `camera`, or of none.
pub(super) fn maker(tree: &Tree, camera: Option<&str>) -> Maker {
    let tree = match camera {
        None => tree,
        Some(name) => tree.get(name).unwrap_or(&Tree::Null),
    };
    let find = |keys: &[&str]| {
        let look = |t: &Tree| {
            let Tree::Map(entries) = t else { return None };
            let named = entries.iter().find(|(key, value)| {
                let key = key.to_lowercase().replace(['_', '-', ' '], "");
                keys.contains(&key.as_str()) && said(value).is_some()
            });
            named.map(|(_, value)| value.clone())
        };
        anywhere(tree, &look, 0).as_ref().and_then(said)
    };
    Maker { model: find(&MODELS), serial: find(&SERIALS) }
}

/// A name or a number in words.
fn said(value: &Tree) -> Option<String> {
    match value {
        Tree::Text(text) => Some(text.trim().to_owned()).filter(|text| !text.is_empty()),
        Tree::Number(number) if number.fract() == 0.0 => Some(number.to_string()),
        _ => None,
    }
}

/// How deep a camera may hide in a document.
const DEEPEST: usize = 6;

/// The camera of a document, or the one of its cameras that is called `camera`.
pub(super) fn intrinsics(tree: &Tree, camera: Option<&str>, path: &Path) -> Result<Found, Error> {
    let tree = match camera {
        None => tree,
        Some(name) => tree.get(name).ok_or_else(|| no_camera(tree, name, path))?,
    };
    let mut cameras = Vec::new();
    collect(tree, "", 0, &mut cameras);
    let place = |at: &str| Place::field(path, if at.is_empty() { "camera" } else { at });
    match &cameras[..] {
        [] => Err(malformed(
            Place::file(path),
            "holds no camera",
            format!("fx fy cx cy, or a matrix named {}, are looked for", MATRIX[..6].join(", ")),
        )),
        [(at, holder)] => complete(tree, holder, &place(at)),
        several => Err(Error::Undeclared {
            place: Place::file(path),
            key: "camera".into(),
            question: format!(
                "the file holds several cameras: which one is it? {}",
                several.iter().map(|(at, _)| at.as_str()).collect::<Vec<_>>().join(", ")
            ),
        }),
    }
}

fn no_camera(tree: &Tree, name: &str, path: &Path) -> Error {
    let keys = match tree {
        Tree::Map(entries) => entries.iter().map(|(k, _)| k.as_str()).collect(),
        _ => vec![],
    };
    malformed(
        Place::field(path, name),
        format!("no camera is called {name}"),
        format!("the file has {}", keys.join(", ")),
    )
}

/// All maps that hold a camera's focal lengths, one way or the other.
fn collect<'a>(tree: &'a Tree, at: &str, depth: usize, into: &mut Vec<(String, &'a Tree)>) {
    let Tree::Map(entries) = tree else { return };
    if lengths(tree).is_some() || matrix(tree).is_some() || kalibr(tree).is_some() {
        into.push((at.into(), tree));
    } else if depth < DEEPEST {
        for (key, value) in entries {
            let at = if at.is_empty() { key.clone() } else { format!("{at}.{key}") };
            collect(value, &at, depth + 1, into);
        }
    }
}

fn lengths(tree: &Tree) -> Option<[f64; 4]> {
    let number = |keys: &[&str]| tree.any(keys)?.number();
    Some([
        number(&["fx"])?,
        number(&["fy"])?,
        number(&["cx", "ppx", "px", "u0"])?,
        number(&["cy", "ppy", "py", "v0"])?,
    ])
}

fn matrix(tree: &Tree) -> Option<Vec<f64>> {
    MATRIX.iter().find_map(|key| tree.get(key)?.numbers().filter(|k| k.len() == 9))
}

/// Kalibr's `intrinsics: [fu, fv, pu, pv]`.
fn kalibr(tree: &Tree) -> Option<[f64; 4]> {
    tree.get("camera_model")?;
    tree.get("intrinsics")?.numbers()?.try_into().ok()
}

/// The camera in `holder`; size and distortion may stand beside it, anywhere in `tree`.
fn complete(tree: &Tree, holder: &Tree, place: &Place) -> Result<Found, Error> {
    if let Some(model) = holder.get("camera_model").and_then(Tree::text)
        && model != "pinhole"
    {
        let what = format!("the camera model \"{model}\" is not known");
        return Err(malformed(place.clone(), what, "calibrate with the pinhole model"));
    }
    let base = match (lengths(holder).or_else(|| kalibr(holder)), matrix(holder)) {
        (Some([fx, fy, cx, cy]), _) => {
            let (fx, fy, cx, cy) = (Some(fx), Some(fy), Some(cx), Some(cy));
            Found { fx, fy, cx, cy, ..Found::default() }
        }
        (None, k) => Found::from_matrix(&k.unwrap_or_default(), place)?,
    };
    let find = |look: &dyn Fn(&Tree) -> Option<Tree>| {
        anywhere(holder, look, 0).or_else(|| anywhere(tree, look, 0))
    };
    let coefficients = find(&|t| {
        COEFFICIENTS.iter().find_map(|k| t.get(k)).filter(|t| t.numbers().is_some()).cloned()
    });
    let model =
        find(&|t| t.any(&["distortion_model", "model"]).filter(|m| m.text().is_some()).cloned());
    Ok(Found {
        size: find(&|t| size(t).map(|(w, h)| pair(w, h))).and_then(|t| size_of(&t)).unzip(),
        model: model.and_then(|m| m.text().map(String::from)),
        distortion: coefficients.and_then(|t| t.numbers()).unwrap_or_default(),
        ..base
    })
}

/// The first thing that `look` finds, outer maps before inner ones.
fn anywhere(tree: &Tree, look: &dyn Fn(&Tree) -> Option<Tree>, depth: usize) -> Option<Tree> {
    let Tree::Map(entries) = tree else { return None };
    look(tree).or_else(|| {
        let inside = entries.iter().map(|(_, v)| v).filter(|_| depth < DEEPEST);
        inside.filter_map(|v| anywhere(v, look, depth + 1)).next()
    })
}

fn size(tree: &Tree) -> Option<(f64, f64)> {
    let side = |keys: &[&str]| tree.any(keys)?.number();
    if let (Some(w), Some(h)) = (side(&["image_width", "width"]), side(&["image_height", "height"]))
    {
        return Some((w, h));
    }
    match tree.any(&["resolution", "image_size"])?.numbers()?[..] {
        [w, h] => Some((w, h)),
        _ => None,
    }
}

fn pair(width: f64, height: f64) -> Tree {
    Tree::List(vec![Tree::Number(width), Tree::Number(height)])
}

fn size_of(tree: &Tree) -> Option<(u32, u32)> {
    let whole = |x: f64| ((1.0..=65_535.0).contains(&x) && x.fract() == 0.0).then_some(x as u32);
    match tree.numbers()?[..] {
        [w, h] => Some((whole(w)?, whole(h)?)),
        _ => None,
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use handeye::{Distortion, Intrinsics};

    fn read(yaml: &str, camera: Option<&str>) -> Result<Intrinsics, Error> {
        let tree: Tree = serde_saphyr::from_str(yaml).unwrap();
        let found = intrinsics(&tree, camera, Path::new("cam.yaml"))?;
        found.intrinsics(&Place::file(Path::new("cam.yaml")), Some((640, 480)), None)
    }

    #[test]
    fn ros_camera_info_is_read() {
        let camera = read(
            "image_width: 800\nimage_height: 600\ncamera_matrix:\n  rows: 3\n  cols: 3\n  data: [700, 0, 400, 0, 701, 300, 0, 0, 1]\n\
             distortion_model: plumb_bob\ndistortion_coefficients:\n  rows: 1\n  cols: 5\n  data: [-0.1, 0.2, 0, 0, 0.3]\n\
             projection_matrix:\n  rows: 3\n  cols: 4\n  data: [1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0]\n",
            None,
        )
        .unwrap();
        assert_eq!((camera.width, camera.height, camera.fy, camera.cx), (800, 600, 701.0, 400.0));
        let Distortion::BrownConrady(k) = camera.distortion else { panic!() };
        assert_eq!(k[..5], [-0.1, 0.2, 0.0, 0.0, 0.3]);
    }

    #[test]
    fn a_kalibr_camchain_asks_which_camera() {
        let yaml = "cam0:\n  camera_model: pinhole\n  intrinsics: [460, 461, 320, 240]\n  distortion_model: equidistant\n  \
                    distortion_coeffs: [0.1, 0.2, 0.3, 0.4]\n  resolution: [640, 480]\n\
                    cam1:\n  camera_model: pinhole\n  intrinsics: [450, 451, 321, 241]\n  distortion_model: radtan\n  \
                    distortion_coeffs: [0.1, 0.2, 0.3, 0.4]\n  resolution: [640, 480]\n";
        let message = read(yaml, None).unwrap_err().to_string();
        assert!(message.contains("which one is it? cam0, cam1"), "{message}");
        let camera = read(yaml, Some("cam0")).unwrap();
        assert_eq!(camera.distortion, Distortion::KannalaBrandt([0.1, 0.2, 0.3, 0.4]));
        assert!(matches!(
            read(yaml, Some("cam1")).unwrap().distortion,
            Distortion::BrownConrady(_)
        ));
    }

    #[test]
    fn a_size_that_the_file_leaves_out_is_the_pictures() {
        let camera = read("intrinsics:\n  fx: 1\n  fy: 2\n  cx: 3\n  cy: 4\n", None).unwrap();
        assert_eq!((camera.width, camera.height, camera.distortion), (640, 480, Distortion::None));
    }

    #[test]
    fn a_file_says_whose_intrinsics_it_holds() {
        let of = |yaml: &str, camera| {
            let tree: Tree = serde_saphyr::from_str(yaml).unwrap();
            let Maker { model, serial } = maker(&tree, camera);
            (model, serial)
        };
        let words = |a: &str, b: &str| (Some(a.to_owned()), Some(b.to_owned()));
        let ros = "camera_name: narrow_stereo\nimage_width: 8\n";
        assert_eq!(of(ros, None), (Some("narrow_stereo".into()), None));
        let maker_s = "info: {Model-Name: D435, Serial Number: 843112070187}\nfx: 1\n";
        assert_eq!(of(maker_s, None), words("D435", "843112070187"));
        let two = "left: {serial: A1}\nright: {serial: B2}\n";
        assert_eq!(of(two, Some("right")), (None, Some("B2".into())));
        assert_eq!(of("serial: ''\ncamera: {fx: 1}\n", None), (None, None));
    }

    #[test]
    fn a_skewed_camera_is_refused() {
        let error = read("K: [500, 3, 320, 0, 500, 240, 0, 0, 1]\n", None).unwrap_err();
        assert!(error.to_string().contains("skew of 3"), "{error}");
    }
}
