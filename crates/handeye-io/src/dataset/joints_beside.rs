//! Joint values that stand beside poses, in columns that are called as the joints of the arm's URDF.

use std::path::Path;

use super::manifest::Source;
use crate::{
    error::Error,
    robot::{ArmModel, Urdf, UrdfSpec},
    table::Record,
    units::AngleUnit,
};

/// How they are read.
pub(super) struct JointsBeside<'a> {
    names: Vec<String>,
    model: ArmModel,
    angle_unit: Option<AngleUnit>,
    source: &'a Source,
    /// The manifest's key of the table.
    at: &'a str,
}

impl<'a> JointsBeside<'a> {
    /// Of a table at the manifest's key `at`, whose angles are in this unit, where that is declared.
    ///
    /// # Errors
    /// A file that is no model of an arm.
    pub(super) fn of(
        spec: &UrdfSpec,
        (angle_unit, at): (Option<AngleUnit>, &'a str),
        (source, root): (&'a Source, &Path),
    ) -> Result<Self, Error> {
        let urdf = Urdf::read(&root.join(&spec.file), &spec.base, &spec.flange)?;
        let (names, model) = (urdf.joint_names().to_vec(), ArmModel::of_urdf(&urdf));
        Ok(Self { names, model, angle_unit, source, at })
    }

    /// Those of a record, rad or m; none where it has no column of a joint.
    ///
    /// # Errors
    /// A joint without a column, what is no number, and angles without a unit.
    pub(super) fn values(&self, record: &Record) -> Result<Vec<f64>, Error> {
        if !self.names.iter().any(|name| record.named(&[name]).is_some()) {
            return Ok(vec![]);
        }
        let question = "in which unit are the angles of the table, those of the joints as well: \"deg\" or \"rad\"?";
        let undeclared = || self.source.undeclared(&format!("{}.angle_unit", self.at), question);
        let unit = self.angle_unit.ok_or_else(undeclared)?;
        Ok(self.model.in_si(&self.model.values(record)?, unit))
    }
}
