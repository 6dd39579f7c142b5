//! Rigid transforms that know their frames.
//!
//! `Pose<A, B>` is `a_from_b`: it takes a point written in `B` to the same point written in `A`,
//! and it is also "where `B` sits, seen from `A`". Inner frames cancel, left to right:
//!
//! ```
//! # use handeye::*;
//! # let base_from_flange = Pose::<Base, Flange>::identity();
//! # let flange_from_camera = Pose::<Flange, Camera>::identity();
//! # let point_in_camera = Point::<Camera>::new(0.0, 0.0, 1.0);
//! let base_from_camera: Pose<Base, Camera> = base_from_flange * flange_from_camera;
//! let point_in_base: Point<Base> = base_from_camera * point_in_camera;
//! ```
//!
//! ```compile_fail,E0277
//! # use handeye::*;
//! # let base_from_flange = Pose::<Base, Flange>::identity();
//! # let camera_from_target = Pose::<Camera, Target>::identity();
//! let oops = base_from_flange * camera_from_target; // Flange is not Camera
//! ```

use std::{fmt, marker::PhantomData, ops::Mul};

use nalgebra::{
    Isometry3, Matrix3, Matrix4, Point3, Quaternion, Rotation3, Translation3, UnitQuaternion,
    Vector3, Vector6,
};
use serde::{Deserialize, Deserializer, Serialize, Serializer, de};

use crate::math::lie;

/// A coordinate frame; its name is what files and Python see.
pub trait Frame: 'static {
    /// Lower-case name, as written in files.
    const NAME: &'static str;
}

macro_rules! frames { ($($(#[$doc:meta])* $Frame:ident = $name:literal;)*) => { $(
    $(#[$doc])* #[derive(Debug, Clone, Copy, PartialEq, Eq)] pub enum $Frame {}
    impl Frame for $Frame { const NAME: &'static str = $name; }
)* } }

frames! {
    /// The body the camera is bolted to: the flange (eye-in-hand) or the base (eye-to-hand).
    Mount = "mount";
    /// The body the target is fixed to: the base (eye-in-hand) or the flange (eye-to-hand).
    Anchor = "anchor";
    /// Robot base, as the controller reports it.
    Base = "base";
    /// Robot flange, without any tool.
    Flange = "flange";
    /// A tool whose pose the controller reports instead of the flange's.
    Tool = "tool";
    /// Tip of the touching tool.
    Tip = "tip";
    /// Optical frame: x right, y down, z into the scene.
    Camera = "camera";
    /// The calibration target.
    Target = "target";
    /// Where the joints of an arm's model begin.
    FirstJoint = "first joint";
    /// Where they end.
    LastLink = "last link";
}

/// Positions beyond this, m, are no robot's and no camera's: the number is wrong. Their squares would
/// leave no digits to the others.
pub const FARTHEST_M: f64 = 1e6;

/// `a_from_b`: takes a point in `B` to the same point in `A`. Metres and radians.
pub struct Pose<A, B> {
    iso: Isometry3<f64>,
    frames: PhantomData<fn() -> (A, B)>,
}

/// A point written in frame `F`, in metres.
pub struct Point<F> {
    xyz: Point3<f64>,
    frame: PhantomData<fn() -> F>,
}

impl<A, B> Pose<A, B> {
    /// States, unchecked, that `iso` takes `B` to `A`. The way in from untyped numbers.
    pub fn claim(iso: Isometry3<f64>) -> Self {
        Self { iso, frames: PhantomData }
    }
    /// The same transform under other frame names: states that `C` is `A` and `D` is `B`.
    pub fn rename<C, D>(self) -> Pose<C, D> {
        Pose::claim(self.iso)
    }
    /// Both frames coincide.
    pub fn identity() -> Self {
        Self::claim(Isometry3::identity())
    }
    /// `b_from_a`.
    pub fn inverse(self) -> Pose<B, A> {
        Pose::claim(self.iso.inverse())
    }
    /// The same rotation, the translation times `factor`: the pose in another unit of length.
    pub fn farther(&self, factor: f64) -> Self {
        let mut iso = self.iso;
        iso.translation.vector *= factor;
        Self::claim(iso)
    }
    /// The untyped transform.
    pub fn iso(&self) -> &Isometry3<f64> {
        &self.iso
    }
    /// Rotation part as a matrix.
    pub fn rotation(&self) -> Matrix3<f64> {
        self.iso.rotation.to_rotation_matrix().into_inner()
    }
    /// Origin of `B`, written in `A`, in metres.
    pub fn translation(&self) -> Vector3<f64> {
        self.iso.translation.vector
    }
    /// Homogeneous 4 x 4 matrix.
    pub fn matrix(&self) -> Matrix4<f64> {
        self.iso.to_homogeneous()
    }
    /// `self * exp(delta)`; `delta` is rotation (rad) first, then translation (m), written in `B`.
    pub fn retract(self, delta: &Vector6<f64>) -> Self {
        Self::claim(self.iso * lie::exp(delta))
    }
    /// The `delta` with `self.retract(&delta) == other`.
    pub fn local(&self, other: &Self) -> Vector6<f64> {
        lie::log(&self.iso.inv_mul(&other.iso))
    }
    /// Angle (rad) of the rotation that takes one pose to the other.
    pub fn angle_to(&self, other: &Self) -> f64 {
        lie::angle(&self.iso.rotation, &other.iso.rotation)
    }
    /// Distance (m) between the two origins of `B`.
    pub fn distance_to(&self, other: &Self) -> f64 {
        (self.translation() - other.translation()).norm()
    }
    /// All seven numbers are finite.
    pub fn is_finite(&self) -> bool {
        self.iso
            .rotation
            .coords
            .iter()
            .chain(self.iso.translation.vector.iter())
            .all(|x| x.is_finite())
    }
    /// The position is beyond [`FARTHEST_M`].
    pub fn is_too_far(&self) -> bool {
        self.iso.translation.vector.amax() > FARTHEST_M
    }
    /// From a rotation matrix and a translation (m): see [`Pose::claim`].
    pub fn from_parts(rotation: &Matrix3<f64>, translation: Vector3<f64>) -> Self {
        let rotation = quaternion_of(rotation);
        Self::claim(Isometry3::from_parts(Translation3::from(translation), rotation))
    }
}

/// Unit quaternion of a rotation matrix, exact for half turns as well.
fn quaternion_of(rotation: &Matrix3<f64>) -> UnitQuaternion<f64> {
    UnitQuaternion::from_rotation_matrix(&Rotation3::from_matrix_unchecked(*rotation))
}

impl<F> Point<F> {
    /// From coordinates in metres.
    pub fn new(x: f64, y: f64, z: f64) -> Self {
        Self { xyz: Point3::new(x, y, z), frame: PhantomData }
    }
    /// From a vector of coordinates in metres.
    pub fn from_vector(v: Vector3<f64>) -> Self {
        Self { xyz: Point3::from(v), frame: PhantomData }
    }
    /// Coordinates, as a point.
    pub fn xyz(&self) -> &Point3<f64> {
        &self.xyz
    }
    /// Coordinates, as a vector from the origin.
    pub fn vector(&self) -> Vector3<f64> {
        self.xyz.coords
    }
    /// The same point under another frame name.
    pub fn rename<G>(self) -> Point<G> {
        Point::from_vector(self.xyz.coords)
    }
}

impl<A, B> Clone for Pose<A, B> {
    fn clone(&self) -> Self {
        *self
    }
}
impl<A, B> Copy for Pose<A, B> {}
impl<A, B> PartialEq for Pose<A, B> {
    fn eq(&self, other: &Self) -> bool {
        self.iso == other.iso
    }
}
impl<F> Clone for Point<F> {
    fn clone(&self) -> Self {
        *self
    }
}
impl<F> Copy for Point<F> {}
impl<F> PartialEq for Point<F> {
    fn eq(&self, other: &Self) -> bool {
        self.xyz == other.xyz
    }
}

impl<A: Frame, B: Frame> fmt::Debug for Pose<A, B> {
    fn fmt(&self, f: &mut fmt::Formatter) -> fmt::Result {
        let (t, q) = (self.iso.translation.vector, self.iso.rotation.coords);
        write!(f, "{}_from_{} {{ t: [{}, {}, {}], ", A::NAME, B::NAME, t.x, t.y, t.z)?;
        write!(f, "xyzw: [{}, {}, {}, {}] }}", q.x, q.y, q.z, q.w)
    }
}
impl<F: Frame> fmt::Debug for Point<F> {
    fn fmt(&self, f: &mut fmt::Formatter) -> fmt::Result {
        write!(f, "[{}, {}, {}]_in_{}", self.xyz.x, self.xyz.y, self.xyz.z, F::NAME)
    }
}

impl<A, B, C> Mul<Pose<B, C>> for Pose<A, B> {
    type Output = Pose<A, C>;
    fn mul(self, b_from_c: Pose<B, C>) -> Pose<A, C> {
        Pose::claim(self.iso * b_from_c.iso)
    }
}

impl<A, B> Mul<Point<B>> for Pose<A, B> {
    type Output = Point<A>;
    fn mul(self, in_b: Point<B>) -> Point<A> {
        Point { xyz: self.iso * in_b.xyz, frame: PhantomData }
    }
}

/// The quaternion of a rotation, as files and people get it: of the two that mean the same, the one with `w >= 0`.
pub fn quaternion_xyzw(rotation: &UnitQuaternion<f64>) -> [f64; 4] {
    let [x, y, z, w]: [f64; 4] = rotation.coords.into();
    if w < 0.0 { [-x, -y, -z, -w] } else { [x, y, z, w] }
}

/// A pose as files hold it.
#[derive(Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema), schemars(rename = "Pose"))]
#[serde(deny_unknown_fields)]
struct Stored {
    #[serde(default, skip_serializing_if = "Option::is_none")]
    to: Option<String>,
    #[serde(default, skip_serializing_if = "Option::is_none")]
    from: Option<String>,
    translation_m: [f64; 3],
    rotation_xyzw: [f64; 4],
}

#[cfg(feature = "schema")]
impl<A: Frame, B: Frame> schemars::JsonSchema for Pose<A, B> {
    fn schema_name() -> std::borrow::Cow<'static, str> {
        Stored::schema_name()
    }

    fn json_schema(generator: &mut schemars::SchemaGenerator) -> schemars::Schema {
        Stored::json_schema(generator)
    }
}

impl<A: Frame, B: Frame> Serialize for Pose<A, B> {
    fn serialize<S: Serializer>(&self, s: S) -> Result<S::Ok, S::Error> {
        Stored {
            to: Some(A::NAME.into()),
            from: Some(B::NAME.into()),
            translation_m: self.iso.translation.vector.into(),
            rotation_xyzw: quaternion_xyzw(&self.iso.rotation),
        }
        .serialize(s)
    }
}

/// How far a stored quaternion's length may be from one before it is refused.
const UNIT_TOLERANCE: f64 = 1e-3;
/// Lengths this close to one come from long products of rotations.
const ROUNDING: f64 = 1e-12;

impl<'de, A: Frame, B: Frame> Deserialize<'de> for Pose<A, B> {
    fn deserialize<D: Deserializer<'de>>(d: D) -> Result<Self, D::Error> {
        let stored = Stored::deserialize(d)?;
        for (found, wanted) in [(&stored.to, A::NAME), (&stored.from, B::NAME)] {
            if found.as_deref().is_some_and(|name| name != wanted) {
                let name = |frame: &Option<String>| frame.clone().unwrap_or("?".into());
                return Err(de::Error::custom(format!(
                    "expected {}_from_{}, found {}_from_{}",
                    A::NAME,
                    B::NAME,
                    name(&stored.to),
                    name(&stored.from)
                )));
            }
        }
        let quaternion = Quaternion::from_vector(stored.rotation_xyzw.into());
        if (quaternion.norm() - 1.0).abs().is_nan()
            || (quaternion.norm() - 1.0).abs() > UNIT_TOLERANCE
        {
            return Err(de::Error::custom(format!(
                "rotation_xyzw has length {}, not 1: is it a quaternion?",
                quaternion.norm()
            )));
        }
        if stored.translation_m.iter().any(|x| !x.is_finite()) {
            return Err(de::Error::custom("translation_m is not finite"));
        }
        // what was written is read again bit for bit
        let rotation = if (quaternion.norm_squared() - 1.0).abs() < ROUNDING {
            UnitQuaternion::new_unchecked(quaternion)
        } else {
            UnitQuaternion::from_quaternion(quaternion)
        };
        let translation = Translation3::from(Vector3::from(stored.translation_m));
        Ok(Self::claim(Isometry3::from_parts(translation, rotation)))
    }
}

impl<F> Serialize for Point<F> {
    fn serialize<S: Serializer>(&self, s: S) -> Result<S::Ok, S::Error> {
        [self.xyz.x, self.xyz.y, self.xyz.z].serialize(s)
    }
}

impl<'de, F> Deserialize<'de> for Point<F> {
    fn deserialize<D: Deserializer<'de>>(d: D) -> Result<Self, D::Error> {
        let [x, y, z] = <[f64; 3]>::deserialize(d)?;
        Ok(Self::new(x, y, z))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn frames_are_checked_when_read() {
        let json = serde_json::to_string(&Pose::<Base, Flange>::identity()).unwrap();
        assert_eq!(
            json,
            r#"{"to":"base","from":"flange","translation_m":[0.0,0.0,0.0],"rotation_xyzw":[0.0,0.0,0.0,1.0]}"#
        );
        let err = serde_json::from_str::<Pose<Flange, Camera>>(&json).err().unwrap();
        assert!(err.to_string().starts_with("expected flange_from_camera, found base_from_flange"));
    }

    #[test]
    fn what_was_written_is_read_again_bit_for_bit() {
        for k in 0..1000 {
            let k = f64::from(k);
            let turn = Vector3::new(k.sin(), (2.0 * k).cos(), (3.0 * k).sin());
            let pose = Pose::<Base, Flange>::claim(Isometry3::new(turn * 0.1, turn));
            let json = serde_json::to_string(&pose).unwrap();
            assert_eq!(serde_json::from_str::<Pose<Base, Flange>>(&json).unwrap(), pose);
        }
    }

    #[test]
    fn frame_names_may_be_left_out() {
        let json = r#"{"translation_m":[1,2,3],"rotation_xyzw":[0,0,0,1]}"#;
        let pose = serde_json::from_str::<Pose<Base, Flange>>(json).unwrap();
        assert_eq!(pose.translation(), Vector3::new(1.0, 2.0, 3.0));
    }

    #[test]
    fn a_zero_quaternion_is_refused() {
        let json = r#"{"translation_m":[1,2,3],"rotation_xyzw":[0,0,0,0]}"#;
        assert!(serde_json::from_str::<Pose<Base, Flange>>(json).is_err());
    }

    #[test]
    fn costs_nothing() {
        assert_eq!(size_of::<Pose<Base, Flange>>(), size_of::<Isometry3<f64>>());
    }

    #[test]
    fn local_undoes_retract() {
        let pose =
            Pose::<Base, Flange>::identity().retract(&Vector6::new(0.3, -1.2, 2.0, 0.5, 0.1, -0.7));
        let delta = Vector6::new(-0.2, 0.7, 0.1, 0.01, 0.4, -0.3);
        assert!((pose.local(&pose.retract(&delta)) - delta).norm() < 1e-12);
    }
}
