//! A ball: it has no corners, is not printed, and is found in 3D scans only.

use nalgebra::Vector2;

use crate::{
    Error, TargetModel,
    model::{
        print::Art,
        target::{family::Family, kinds::Kind, look::Look},
        texture::Texture,
    },
};

pub(in crate::model::target) const KIND: Kind = Kind {
    name: "sphere",
    example: || TargetModel::Sphere { diameter_mm: Some(50.0) },
    counts: &[],
    help: "Ball",
};

pub(in crate::model::target) struct Sphere {
    pub diameter_mm: Option<f64>,
}

impl Family for Sphere {
    fn look(&self) -> Look {
        Look::Ball
    }

    fn grid(&self) -> (u32, u32) {
        (0, 0)
    }

    fn lengths_mm(&self) -> Vec<(&'static str, f64)> {
        self.diameter_mm.map(|d| ("diameter_mm", d)).into_iter().collect()
    }

    fn in_plane(&self, _: u32) -> Vector2<f64> {
        Vector2::zeros()
    }

    fn check_counts(&self) -> Result<(), Error> {
        Ok(())
    }

    fn art(&self, _: &TargetModel) -> Result<Art, Error> {
        Err(Error::Invalid("target: a ball is not printed; it is found in 3D scans".into()))
    }

    fn texture(&self, _: &TargetModel) -> Option<Texture> {
        None
    }

    fn in_words(&self) -> String {
        match self.diameter_mm {
            Some(d) => format!("Ball of {d} mm"),
            None => "Ball".into(),
        }
    }
}
