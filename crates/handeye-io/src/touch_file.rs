//! Points that the camera measured and the robot touched, in a CSV or JSON file of our own.

use std::path::Path;

use handeye::{Base, Camera, Flange, Point, Pose};
use nalgebra::{Isometry3, Quaternion, Translation3, UnitQuaternion};
use serde::Deserialize;

use crate::{
    error::{Error, Place, malformed},
    files,
    table::{self, Layout, Record},
    units::{farthest, too_far},
};

/// A point that the camera measured and the tip touched.
#[derive(Debug, Clone, PartialEq)]
pub struct TouchedPoint {
    /// Its name, or its number from 1.
    pub id: String,
    /// As the camera measured it.
    pub in_camera: Point<Camera>,
    /// Where the tip was.
    pub in_base: Point<Base>,
    /// Where the flange was when the camera measured; needed for a camera on the flange.
    pub base_from_flange: Option<Pose<Base, Flange>>,
}

/// Reads a `.csv` with columns `camera_x_mm ... touched_x_mm ...`, or a `.json` with `touches`.
///
/// # Errors
/// A file that cannot be read, a column that is missing, a unit that is not said.
pub fn read_touched_points(path: &Path) -> Result<Vec<TouchedPoint>, Error> {
    let all = match files::extension(path).as_str() {
        "json" => from_json(path)?,
        _ => {
            let records = table::records(path, &Layout::default())?;
            records.iter().enumerate().map(|(k, r)| from_record(k, r)).collect::<Result<_, _>>()?
        }
    };
    match all.is_empty() {
        true => Err(malformed(Place::file(path), "holds no touches", "add a line for each touch")),
        false => Ok(all),
    }
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct Touches {
    touches: Vec<JsonTouch>,
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct JsonTouch {
    id: Option<String>,
    in_camera_m: [f64; 3],
    touched_in_base_m: [f64; 3],
    base_from_flange: Option<Pose<Base, Flange>>,
}

fn from_json(path: &Path) -> Result<Vec<TouchedPoint>, Error> {
    let read: Touches = serde_json::from_str(&files::text(path)?).map_err(|e| {
        let place = Place { line: Some(e.line()), ..Place::file(path) };
        let what = e.to_string();
        let what = what.split(" at line ").next().unwrap_or(&what).to_owned();
        malformed(place, what, "see \"For verify\" in the chapter on touches of the book")
    })?;
    let point = |(k, t): (usize, JsonTouch)| {
        let id = t.id.unwrap_or((k + 1).to_string());
        let flange = t.base_from_flange.map_or([0.0; 3], |p| p.translation().into());
        if let Some(far) = farthest(&[t.in_camera_m, t.touched_in_base_m, flange].concat()) {
            let what = format!("touch {id}: {}", too_far(far));
            let advice = "correct the number, or leave the touch out";
            return Err(malformed(Place::file(path), what, advice));
        }
        Ok(TouchedPoint {
            id,
            in_camera: Point::from_vector(t.in_camera_m.into()),
            in_base: Point::from_vector(t.touched_in_base_m.into()),
            base_from_flange: t.base_from_flange,
        })
    };
    read.touches.into_iter().enumerate().map(point).collect()
}

fn from_record(k: usize, record: &Record) -> Result<TouchedPoint, Error> {
    let point = |prefix: &str| -> Result<[f64; 3], Error> {
        let [x, y, z] = ["x", "y", "z"].map(|axis| length(record, &format!("{prefix}_{axis}")));
        Ok([x?, y?, z?])
    };
    let has_flange = record.names.iter().any(|n| n.trim().to_lowercase().starts_with("flange_"));
    Ok(TouchedPoint {
        id: record.text_named(&["id", "name"]).unwrap_or((k + 1).to_string()),
        in_camera: Point::from_vector(point("camera")?.into()),
        in_base: Point::from_vector(point("touched")?.into()),
        base_from_flange: has_flange.then(|| flange(record, point("flange")?)).transpose()?,
    })
}

fn flange(record: &Record, [x, y, z]: [f64; 3]) -> Result<Pose<Base, Flange>, Error> {
    let number = |name: &str| {
        record.number_named(&[name]).ok_or_else(|| {
            record.refuse(
                format!("has no number under {name}"),
                "the flange pose is flange_x_mm flange_y_mm flange_z_mm flange_qx flange_qy \
                 flange_qz flange_qw",
            )
        })
    };
    let [qx, qy, qz, qw] = ["flange_qx", "flange_qy", "flange_qz", "flange_qw"].map(number);
    let q = Quaternion::new(qw?, qx?, qy?, qz?);
    if !(0.999..=1.001).contains(&q.norm()) {
        let what = format!("the quaternion's length is {:.6}, not 1", q.norm());
        return Err(record.refuse(what, "correct the flange pose"));
    }
    let rotation = UnitQuaternion::from_quaternion(q);
    Ok(Pose::claim(Isometry3::from_parts(Translation3::new(x, y, z), rotation)))
}

/// A length (m) whose unit is at the end of its column's name.
fn length(record: &Record, name: &str) -> Result<f64, Error> {
    let column = |unit: &str| {
        let wanted = format!("{name}{unit}");
        record.names.iter().position(|n| n.trim().eq_ignore_ascii_case(&wanted))
    };
    let number = |at: Option<usize>| match record.cells.get(at?) {
        Some(table::Cell::Number(x)) if x.is_finite() => Some(*x),
        _ => None,
    };
    let found = number(column("_mm")).map(|mm| mm / 1000.0).or_else(|| number(column("_m")));
    if let Some(far) = found.and_then(|metres| farthest(&[metres])) {
        return Err(record.refuse(
            format!("{name}: {}", too_far(far)),
            "correct the number, or leave the touch out",
        ));
    }
    found.ok_or_else(|| {
        let advice = match column("") {
            Some(_) => format!("say the unit in the header: {name}_mm or {name}_m"),
            None => "the columns are camera_x_mm camera_y_mm camera_z_mm touched_x_mm \
                     touched_y_mm touched_z_mm (or _m), under a header"
                .into(),
        };
        record.refuse(format!("has no number under {name}_mm"), advice)
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    fn read(name: &str, text: &str) -> Result<Vec<TouchedPoint>, String> {
        let folder = std::env::temp_dir().join(format!("handeye-touch-{}", std::process::id()));
        std::fs::create_dir_all(&folder).unwrap();
        let path = folder.join(name);
        std::fs::write(&path, text).unwrap();
        read_touched_points(&path).map_err(|e| e.to_string())
    }

    #[test]
    fn csv_and_json_hold_the_same() {
        let csv = "id,camera_x_mm,camera_y_mm,camera_z_mm,touched_x_m,touched_y_m,touched_z_m\n\
                   a,10,20,900,0.5,-0.25,0.125\n";
        let json = r#"{"touches": [{"id": "a", "in_camera_m": [0.01, 0.02, 0.9],
                       "touched_in_base_m": [0.5, -0.25, 0.125]}]}"#;
        assert_eq!(read("a.csv", csv).unwrap(), read("a.json", json).unwrap());
    }

    #[test]
    fn a_length_without_a_unit_is_asked_for() {
        let csv = "camera_x,camera_y,camera_z,touched_x,touched_y,touched_z\n1,2,3,4,5,6\n";
        let message = read("b.csv", csv).unwrap_err();
        assert!(message.contains("say the unit in the header: camera_x_mm"), "{message}");
    }

    #[test]
    fn a_number_beyond_any_robot_is_named_with_its_line() {
        let csv = "camera_x_mm,camera_y_mm,camera_z_mm,touched_x_mm,touched_y_mm,touched_z_mm\n\
                   1,2,3,4,5,6\n1e300,2,3,4,5,6\n";
        let message = read("e.csv", csv).unwrap_err();
        assert!(message.contains("e.csv:3") && message.contains("camera_x"), "{message}");
        let json = r#"{"touches": [{"id": "a", "in_camera_m": [0.01, 0.02, 0.9],
                       "touched_in_base_m": [0.5, -1e200, 0.125]}]}"#;
        let message = read("e.json", json).unwrap_err();
        assert!(message.contains("touch a: a position 1.0e200 m"), "{message}");
    }

    #[test]
    fn the_flange_is_read_with_its_quaternion() {
        let csv = "camera_x_mm,camera_y_mm,camera_z_mm,touched_x_mm,touched_y_mm,touched_z_mm,\
                   flange_x_mm,flange_y_mm,flange_z_mm,flange_qx,flange_qy,flange_qz,flange_qw\n\
                   1,2,3,4,5,6,100,200,300,1,0,0,0\n";
        let pose = read("c.csv", csv).unwrap()[0].base_from_flange.unwrap();
        assert!((pose.translation().y - 0.2).abs() < 1e-12);
        let missing = csv.replace("flange_qw", "w");
        assert!(read("d.csv", &missing).unwrap_err().contains("flange_qw"));
    }
}
