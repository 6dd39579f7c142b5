//! Robot poses alone, without a camera: a file that is described as in a manifest's `[robot]`.

use std::path::{Path, PathBuf};

use handeye::{Base, Flange, Pose, Warning};
use serde::Deserialize;

use super::{
    manifest::{RobotSpec, Source},
    poses::{self, Writing},
};
use crate::{
    error::{Error, Place, malformed},
    files,
};

/// A file of robot poses and how it is written: the keys of a manifest's `[robot]`.
#[derive(Debug, Clone, Default)]
pub struct RobotFile {
    /// The file, a pattern of files, or a TOML file with a `[robot]` of its own.
    pub poses: PathBuf,
    /// Keys and values as in `[robot]`, such as `("notation", "kuka")`.
    pub keys: Vec<(&'static str, toml::Value)>,
}

/// The value of `columns`: numbers from 1, or names.
pub fn columns(all: &[String]) -> toml::Value {
    let column = |c: &String| match c.parse::<i64>() {
        Ok(number) => toml::Value::Integer(number),
        Err(_) => toml::Value::String(c.clone()),
    };
    toml::Value::Array(all.iter().map(column).collect())
}

/// The poses of a robot, each under its name.
#[derive(Debug, Clone)]
pub struct RobotPoses {
    /// Names, numbers from 1 where the file has none.
    pub names: Vec<String>,
    /// Where the flange was.
    pub base_from_flange: Vec<Pose<Base, Flange>>,
    /// How they are written; `None` where joint values stand for them.
    pub written: Option<Writing>,
    /// What looked suspicious.
    pub warnings: Vec<Warning>,
}

#[derive(Deserialize)]
struct WithRobot {
    robot: RobotSpec,
}

/// Reads robot poses.
///
/// # Errors
/// As [`super::Dataset::open`]: a file that cannot be read, a convention that was left open.
pub fn read_robot_poses(file: &RobotFile) -> Result<RobotPoses, Error> {
    let (spec, source, root) = described(file)?;
    let (found, warnings) = poses::of_robot(&spec, &source, &root)?;
    let named = found.iter().enumerate();
    let names = named.map(|(k, p)| p.id.clone().unwrap_or((k + 1).to_string())).collect();
    Ok(RobotPoses {
        names,
        base_from_flange: found.iter().map(|p| p.value).collect(),
        written: poses::writing(&spec, &source, &root)?,
        warnings,
    })
}

fn described(file: &RobotFile) -> Result<(RobotSpec, Source, PathBuf), Error> {
    let path = &file.poses;
    if files::extension(path) == "toml" {
        let source = Source { path: path.clone(), text: files::text(path)? };
        let spec = source.robot()?;
        return Ok((spec, source, path.parent().unwrap_or(Path::new("")).into()));
    }
    let mut table: toml::Table =
        file.keys.iter().map(|(key, value)| ((*key).to_owned(), value.clone())).collect();
    table.insert("poses".into(), path.to_string_lossy().into_owned().into());
    let spec = table
        .try_into()
        .map_err(|e| malformed(Place::file(path), e.to_string(), "correct the command"))?;
    Ok((spec, Source { path: path.clone(), text: String::new() }, PathBuf::new()))
}

impl Source {
    fn robot(&self) -> Result<RobotSpec, Error> {
        let with: WithRobot = toml::from_str(&self.text).map_err(|e| {
            malformed(Place::file(&self.path), e.message().to_owned(), "correct its [robot]")
        })?;
        Ok(with.robot)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn poses_are_read_as_a_manifest_would_have_them() {
        let folder = std::env::temp_dir().join(format!("handeye-robot-{}", std::process::id()));
        std::fs::create_dir_all(&folder).unwrap();
        let poses = folder.join("poses.csv");
        std::fs::write(&poses, "X,Y,Z,A,B,C\n100,0,0,90,0,0\n0,200,0,0,0,0\n").unwrap();
        let keys = vec![("notation", "kuka".into()), ("direction", "base_from_flange".into())];
        let read = read_robot_poses(&RobotFile { poses, keys }).unwrap();
        assert_eq!(read.names, ["1", "2"]);
        assert!((read.base_from_flange[0].translation().x - 0.1).abs() < 1e-12);
        std::fs::remove_dir_all(&folder).unwrap();
    }

    #[test]
    fn poses_are_written_as_they_were_read() {
        let folder =
            std::env::temp_dir().join(format!("handeye-robot-table-{}", std::process::id()));
        std::fs::create_dir_all(&folder).unwrap();
        let file = |name: &str| RobotFile {
            poses: folder.join(name),
            keys: vec![
                ("notation", "abb".into()),
                ("direction", "flange_from_base".into()),
                ("length_unit", "cm".into()),
            ],
        };
        let text = "id,x,y,z,q1,q2,q3,q4\na,10,-20,30,0.5,0.5,-0.5,0.5\nb,1,2,3,0.6,0,0.8,0\n";
        std::fs::write(folder.join("poses.csv"), text).unwrap();
        let read = read_robot_poses(&file("poses.csv")).unwrap();
        let names = read.names.iter().map(String::as_str);
        let table = read.written.as_ref().unwrap().table(names.zip(&read.base_from_flange));
        std::fs::write(folder.join("again.csv"), &table).unwrap();
        let again = read_robot_poses(&file("again.csv")).unwrap();
        assert_eq!(again.names, read.names);
        for (a, b) in read.base_from_flange.iter().zip(&again.base_from_flange) {
            assert!(a.local(b).amax() < 1e-9, "{table}");
        }
        std::fs::remove_dir_all(&folder).unwrap();
    }
}
