//! The robot's model in a session's folder, and the joint values beside its poses.

use std::{fs, path::Path, sync::Arc};

use super::{ArmLinks, CellSettings, SessionFolder, StoredCapture, URDF, make_parent};
use crate::{
    Error, Urdf,
    files::write_atomically,
    plan::UrdfOption,
    robot::{self, Notation, Rotation},
    table,
};

/// The model of a folder.
pub(super) fn of(root: &Path, links: Option<&ArmLinks>) -> Result<Option<Arc<Urdf>>, Error> {
    let read = |links: &ArmLinks| Urdf::read(&root.join(URDF), &links.base, &links.flange);
    Ok(links.map(read).transpose()?.map(Arc::new))
}

impl SessionFolder {
    /// The robot's model.
    pub fn urdf(&self) -> Option<&Arc<Urdf>> {
        self.urdf.as_ref()
    }

    /// Takes a model of the robot into the folder, with the meshes of its links that are found, in place of one that it has.
    ///
    /// # Errors
    /// A file that is no such model; a folder that cannot be written.
    pub fn use_urdf(&mut self, option: &UrdfOption) -> Result<(), Error> {
        let given = option.read()?;
        for (below, mesh) in robot::meshes(&given) {
            copied(&mesh, &self.root.join(URDF).with_file_name("").join(below))?;
        }
        let path = self.root.join(URDF);
        make_parent(&path)?;
        self.write_if_changed(URDF, given.text())?;
        let links = ArmLinks { base: option.base.clone(), flange: option.flange.clone() };
        self.urdf = of(&self.root, Some(&links))?;
        match self.settings.arm.as_ref() == Some(&links) {
            true => self.settle(),
            false => self.set(&CellSettings { arm: Some(links), ..self.settings.clone() }),
        }
    }

    /// Whether joint values stand beside the poses: the model names them, and every capture has them.
    pub(super) fn has_joints(&self) -> bool {
        let Some(urdf) = &self.urdf else { return false };
        let count = urdf.joint_names().len();
        let captures = self.captures();
        !captures.is_empty()
            && captures.iter().all(|c| c.joints.len() == count)
            && Notation::named(&self.settings.notation)
                .is_ok_and(|notation| are_columns_beside(urdf.joint_names(), &notation))
    }

    /// A table of the captures' poses with their joint values behind them, in the notation's unit of angles, and metres.
    pub(super) fn with_joints(&self, poses: &str) -> String {
        let Some(urdf) = &self.urdf else { return poses.into() };
        let Ok(notation) = Notation::named(&self.settings.notation) else { return poses.into() };
        let prismatic = urdf.prismatic();
        let value = |(value, is_prismatic): (&f64, &bool)| match is_prismatic {
            true => format!(",{value:.9}"),
            false => format!(",{:.9}", notation.angle_unit.from_radians(*value)),
        };
        let of_capture =
            |c: &StoredCapture| c.joints.iter().zip(&prismatic).map(value).collect::<String>();
        let names = urdf.joint_names().iter().map(|name| format!(",{name}")).collect::<String>();
        let captures = self.captures();
        let beside = std::iter::once(names).chain(captures.into_iter().map(of_capture));
        poses.lines().zip(beside).map(|(line, more)| format!("{line}{more}\n")).collect()
    }
}

/// Whether these names can be those of columns behind a pose: none is taken for one of the pose's own numbers.
fn are_columns_beside(names: &[String], notation: &Notation) -> bool {
    let own = notation.columns.iter().flat_map(|column| column.names);
    let own: Vec<String> = own.copied().map(table::plain).collect();
    let is_word = |name: &str| {
        !name.is_empty()
            && name.chars().all(|c| c.is_alphanumeric() || matches!(c, '_' | '-' | '.' | '/'))
    };
    let mut plain: Vec<String> = names.iter().map(|name| table::plain(name)).collect();
    let is_free = plain.iter().all(|name| !own.contains(name));
    plain.sort();
    plain.dedup();
    notation.rotation != Rotation::Matrix
        && is_free
        && plain.len() == names.len()
        && names.iter().all(|name| is_word(name) && !table::is_id_name(name))
}

/// A copy of a file, unless it is there already.
fn copied(from: &Path, to: &Path) -> Result<(), Error> {
    let bytes = fs::read(from).map_err(|source| Error::Read { path: from.into(), source })?;
    if fs::read(to).is_ok_and(|old| old == bytes) {
        return Ok(());
    }
    make_parent(to)?;
    write_atomically(to, &bytes)
}
