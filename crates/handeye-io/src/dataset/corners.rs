//! Corners of the board that someone else's detector found.

use std::path::{Path, PathBuf};

use handeye::{ImageCorner, TargetModel};
use nalgebra::{Matrix2, Vector2};

use super::manifest::{CornersSpec, PixelOrigin, Source};
use crate::{
    error::Error,
    files,
    table::{self, Layout, Record},
};

/// Standard deviation of a corner whose detector does not say it, px.
const USUAL_SIGMA_PX: f64 = 0.1;

/// The corners of one capture.
pub(super) type Corners = Vec<ImageCorner>;

/// How corners are read: what the manifest says of them.
pub(super) struct CornerReading<'a> {
    pub(super) origin: PixelOrigin,
    pub(super) sigma_px: Option<f64>,
    pub(super) target: Option<&'a TargetModel>,
}

impl<'a> CornerReading<'a> {
    pub(super) fn of(
        spec: &CornersSpec,
        sigma_px: Option<f64>,
        target: Option<&'a TargetModel>,
        source: &Source,
    ) -> Result<Self, Error> {
        let origin = spec.pixel_origin.ok_or_else(|| {
            source.undeclared(
                "corners.pixel_origin",
                "is (0, 0) the \"centre\" of the first pixel (OpenCV's convention) or its \"corner\"?",
            )
        })?;
        Ok(Self { origin, sigma_px, target })
    }

    /// The corners of a file with one capture.
    pub(super) fn read(&self, path: &Path) -> Result<Corners, Error> {
        self.corners(&table::records(path, &Layout::default())?)
    }

    fn corners(&self, records: &[Record]) -> Result<Corners, Error> {
        let mut corners: Corners = Vec::with_capacity(records.len());
        for record in records {
            let corner = self.corner(record)?;
            if corners.iter().any(|c| c.id == corner.id) {
                return Err(record.refuse(
                    format!("corner {} appears twice", corner.id),
                    "remove one of the lines",
                ));
            }
            corners.push(corner);
        }
        Ok(corners)
    }

    fn corner(&self, record: &Record) -> Result<ImageCorner, Error> {
        let columns: [&[&str]; 3] =
            [&["id", "corner", "corner_id"], &["x", "x_px", "u"], &["y", "y_px", "v"]];
        let n = record.numbers(&columns, "a corner")?;
        let known = self.target.is_none_or(|t| (n[0] as usize) < t.len());
        if n[0] < 0.0 || n[0].fract() != 0.0 || !known {
            return Err(
                record.refuse(format!("the target has no corner {}", n[0]), self.advice_on_ids())
            );
        }
        let shift = if self.origin == PixelOrigin::Corner { 0.5 } else { 0.0 };
        let sigma = self.sigma_px.unwrap_or(USUAL_SIGMA_PX);
        Ok(ImageCorner {
            id: n[0] as u32,
            pixel: Vector2::new(n[1] - shift, n[2] - shift),
            covariance: Matrix2::identity() * sigma.powi(2),
        })
    }

    /// What to do about an id that the target has not.
    fn advice_on_ids(&self) -> String {
        if self.target.is_some_and(TargetModel::is_empty) {
            return "the declared target is a ball and has no corners: correct [target], or remove [corners]"
                .into();
        }
        let declared = self.target.map_or(String::new(), |target| {
            let (columns, rows) = target.grid();
            format!(
                "; as declared the target has {columns} x {rows} corners, 0 to {}",
                target.len() - 1
            )
        });
        format!("ids count from 0, row by row{declared}: correct [target] or the list")
    }

    /// The corners of many captures: a file for each, or one table with a column `capture`.
    pub(super) fn read_all(
        &self,
        spec: &CornersSpec,
        source: &Source,
        root: &Path,
    ) -> Result<Vec<(String, Corners)>, Error> {
        let paths = files::expand(root, &spec.files, &source.place("corners.files"))?;
        if files::is_pattern(&spec.files) {
            return self.file_per_capture(&paths);
        }
        let mut groups: Vec<(String, Vec<Record>)> = Vec::new();
        for record in table::records(&paths[0], &Layout::default())? {
            let capture = record.text_named(&["capture", "image"]).ok_or_else(|| {
                record.refuse(
                    "the table has no column capture",
                    "name the capture of every corner, or give a file for each",
                )
            })?;
            match groups.iter_mut().find(|(id, _)| *id == capture) {
                Some((_, group)) => group.push(record),
                None => groups.push((capture, vec![record])),
            }
        }
        groups.into_iter().map(|(id, group)| Ok((id, self.corners(&group)?))).collect()
    }

    fn file_per_capture(&self, paths: &[PathBuf]) -> Result<Vec<(String, Corners)>, Error> {
        let named = table::distinct_names(paths).into_iter().zip(paths);
        named.map(|(name, path)| Ok((name, self.read(path)?))).collect()
    }
}
