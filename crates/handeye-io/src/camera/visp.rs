//! ViSP's camera XML: `px py u0 v0`, and `kud kdu` for its own distortion model.

use std::path::Path;

use super::found::Found;
use crate::{
    error::{Error, Place, malformed},
    tree::Tree,
};

/// The camera, if the document is ViSP's.
pub(super) fn intrinsics(tree: &Tree, path: &Path) -> Result<Option<Found>, Error> {
    let Some(camera) = tree.get("camera") else { return Ok(None) };
    let Some(model) = camera.get("model") else { return Ok(None) };
    let number = |tree: &Tree, key: &str| tree.get(key).and_then(Tree::number);
    let (Some(fx), Some(u0)) = (number(model, "px"), number(model, "u0")) else { return Ok(None) };
    for key in ["kud", "kdu"] {
        if number(model, key).is_some_and(|k| k != 0.0) {
            return Err(malformed(
                Place::field(path, key),
                "ViSP's distortion model is not known here",
                "give fx fy cx cy and OpenCV's coefficients in [camera], or leave [camera] out",
            ));
        }
    }
    let side = |key: &str| number(camera, key).map(|n| n as u32);
    Ok(Some(Found {
        size: (side("image_width"), side("image_height")),
        fx: Some(fx),
        fy: number(model, "py"),
        cx: Some(u0),
        cy: number(model, "v0"),
        ..Found::default()
    }))
}

#[cfg(test)]
mod tests {
    use super::*;

    fn read(kud: &str) -> Result<Option<Found>, Error> {
        let text = format!(
            "<root><camera><name>C</name><image_width>640</image_width><image_height>480</image_height>\
             <model><type>perspectiveProjWithDistortion</type><px>600</px><py>601</py><u0>320</u0>\
             <v0>240</v0><kud>{kud}</kud><kdu>0</kdu></model></camera></root>"
        );
        intrinsics(&crate::xml::tree(&text, Path::new("c.xml"))?, Path::new("c.xml"))
    }

    #[test]
    fn a_camera_without_distortion_is_read() {
        let camera = read("-0").unwrap().unwrap();
        assert_eq!((camera.size, camera.fy), ((Some(640), Some(480)), Some(601.0)));
    }

    #[test]
    fn a_distortion_of_its_own_kind_is_refused() {
        let message = read("0.1").unwrap_err().to_string();
        assert!(
            message.starts_with("c.xml [kud]: ViSP's distortion model is not known"),
            "{message}"
        );
    }
}
