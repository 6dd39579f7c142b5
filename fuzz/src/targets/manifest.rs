//! Manifests, with images, scans and poses beside them.

use std::{fs, sync::Once};

use crate::{folder, told};
use handeye_io::{Dataset, MANIFEST};

const POSES: &str = "id,x,y,z,a,b,c\n01,100,200,300,10,20,30\n02,150,210,280,-10,15,40\n";
const CAMERA: &str = r#"{"width": 64, "height": 48, "fx": 60, "fy": 60, "cx": 31.5, "cy": 23.5}"#;
const TOUCHES: &str = "corner,x,y,z\n0,1,2,3\n5,4,5,6\n";

static BESIDE: Once = Once::new();

/// Reads some bytes.
pub fn run(data: &[u8]) {
    let folder = folder();
    BESIDE.call_once(|| {
        for (name, text) in
            [("poses.csv", POSES), ("camera.json", CAMERA), ("touches.csv", TOUCHES)]
        {
            fs::write(folder.join(name), text).expect("a temporary file can be written");
        }
        for name in ["01.png", "02.png"] {
            fs::write(folder.join(name), b"").expect("a temporary file can be written");
        }
    });
    fs::write(folder.join(MANIFEST), data).expect("a temporary file can be written");
    told(Dataset::open(&folder));
}
