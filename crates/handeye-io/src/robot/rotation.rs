//! The ways to write a rotation in numbers, and back.

use nalgebra::{Matrix3, Quaternion, UnitQuaternion, Vector3};

use super::euler::{self, Axes, Sense};

/// How a notation writes its rotation.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Rotation {
    /// The whole pose as a 4x4 matrix, row by row.
    Matrix,
    /// Unit quaternion, the scalar last.
    QuaternionXyzw,
    /// Unit quaternion, the scalar first.
    QuaternionWxyz,
    /// Axis times angle.
    Vector,
    /// Three angles about the axes, about the moving (intrinsic) or the fixed (extrinsic) frame.
    Euler(Axes, Sense),
}

/// How far a quaternion's length may be from one.
const TOLERANCE: f64 = 1e-3;
/// How far a matrix may be from a rotation: it was printed with three digits.
const ROUNDED: f64 = 5e-3;

impl Rotation {
    /// Position and rotation numbers of a notation's numbers.
    pub(super) fn split(self, si: &[f64]) -> (Vector3<f64>, Vec<f64>) {
        match self {
            // the last row stays with the rotation, to be checked
            Rotation::Matrix => (Vector3::new(si[3], si[7], si[11]), si.to_vec()),
            _ => (Vector3::new(si[0], si[1], si[2]), si[3..].to_vec()),
        }
    }

    /// The inverse of [`Rotation::split`].
    pub(super) fn join(self, p: &Vector3<f64>, rotation: &[f64]) -> Vec<f64> {
        match (self, rotation) {
            (Rotation::Matrix, &[a, b, c, d, e, f, g, h, i]) => {
                vec![a, b, c, p.x, d, e, f, p.y, g, h, i, p.z, 0.0, 0.0, 0.0, 1.0]
            }
            _ => p.iter().chain(rotation).copied().collect(),
        }
    }

    /// Numbers (radians) as a rotation; `Err` says why they are none.
    pub(super) fn read(self, n: &[f64]) -> Result<UnitQuaternion<f64>, String> {
        match self {
            Rotation::Matrix => from_matrix(n),
            Rotation::QuaternionXyzw => unit(Quaternion::new(n[3], n[0], n[1], n[2])),
            Rotation::QuaternionWxyz => unit(Quaternion::new(n[0], n[1], n[2], n[3])),
            Rotation::Vector => Ok(UnitQuaternion::new(Vector3::new(n[0], n[1], n[2]))),
            Rotation::Euler(axes, sense) => Ok(euler::rotation(axes, sense, [n[0], n[1], n[2]])),
        }
    }

    /// A rotation as numbers (radians).
    pub(super) fn write(self, rotation: &UnitQuaternion<f64>) -> Vec<f64> {
        let [x, y, z, w] = handeye::quaternion_xyzw(rotation);
        match self {
            Rotation::Matrix => {
                rotation.to_rotation_matrix().matrix().transpose().iter().copied().collect()
            }
            Rotation::QuaternionXyzw => vec![x, y, z, w],
            Rotation::QuaternionWxyz => vec![w, x, y, z],
            Rotation::Vector => rotation.scaled_axis().iter().copied().collect(),
            Rotation::Euler(axes, sense) => euler::angles(axes, sense, rotation).to_vec(),
        }
    }
}

fn unit(q: Quaternion<f64>) -> Result<UnitQuaternion<f64>, String> {
    let length = q.norm();
    if !(1.0 - TOLERANCE..=1.0 + TOLERANCE).contains(&length) {
        return Err(format!("the quaternion's length is {length:.6}, not 1"));
    }
    Ok(UnitQuaternion::from_quaternion(q))
}

fn from_matrix(n: &[f64]) -> Result<UnitQuaternion<f64>, String> {
    if n[12..] != [0.0, 0.0, 0.0, 1.0] {
        return Err(format!("the last row of the matrix is {:?}, not 0 0 0 1", &n[12..]));
    }
    rotation_near(&Matrix3::new(n[0], n[1], n[2], n[4], n[5], n[6], n[8], n[9], n[10]))
}

/// The rotation that a matrix is but for the rounding of its digits.
///
/// # Errors
/// Why it is none: it stretches, mirrors, or is not finite.
pub fn rotation_near(m: &Matrix3<f64>) -> Result<UnitQuaternion<f64>, String> {
    let apart = (m.transpose() * m - Matrix3::identity()).abs().max();
    if !(0.0..=ROUNDED).contains(&apart) {
        return Err(format!(
            "the matrix is no rotation: its columns are off unit and square by {apart:.1e}"
        ));
    }
    if m.determinant() < 0.0 {
        return Err("the matrix mirrors (its determinant is -1): an axis is turned round".into());
    }
    let nearest = handeye::math::nearest_rotation(m).ok_or("the matrix is no rotation")?;
    // of its two quaternions the one that its matrix gives
    Ok(UnitQuaternion::from_rotation_matrix(&nearest.to_rotation_matrix()))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_is_no_rotation_is_refused() {
        let zero = Rotation::QuaternionXyzw.read(&[0.0; 4]).unwrap_err();
        assert_eq!(zero, "the quaternion's length is 0.000000, not 1");
        let mut matrix =
            [1.0, 0.0, 0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 0.0, 1.0];
        matrix[0] = 1.1;
        assert!(
            Rotation::Matrix.read(&matrix).unwrap_err().starts_with("the matrix is no rotation")
        );
        matrix[0] = -1.0;
        assert!(Rotation::Matrix.read(&matrix).unwrap_err().starts_with("the matrix mirrors"));
        matrix[15] = 2.0;
        assert!(Rotation::Matrix.read(&matrix).unwrap_err().starts_with("the last row"));
        assert!(Rotation::QuaternionWxyz.read(&[f64::NAN, 0.0, 0.0, 0.0]).is_err());
    }

    #[test]
    fn a_rounded_matrix_becomes_the_nearest_rotation() {
        let turn = UnitQuaternion::new(Vector3::new(0.0, 3.0, 0.4));
        let m = turn.to_rotation_matrix();
        let r = |i: usize, j: usize| (m.matrix()[(i, j)] * 1e4_f64).round() / 1e4;
        let mut n = [0.0; 16];
        for i in 0..3 {
            for j in 0..3 {
                n[4 * i + j] = r(i, j);
            }
        }
        n[15] = 1.0;
        let read = Rotation::Matrix.read(&n).unwrap();
        assert!(read.angle_to(&turn) < 1e-4);
        assert!((read.norm() - 1.0).abs() < 1e-15);
    }

    /// The orthonormal factor of `m`, by Newton's iteration (N. Higham, SIAM J. Sci. Stat. Comput. 7, 1986).
    fn orthonormal_factor(mut m: Matrix3<f64>) -> Matrix3<f64> {
        for _ in 0..6 {
            m = 0.5 * (m + m.transpose().try_inverse().unwrap());
        }
        m
    }

    #[test]
    fn the_rotation_near_a_matrix_is_its_orthonormal_factor() {
        let mut random = handeye::math::random::Random::new(5);
        let mut most = 0.0_f64;
        for digits in [1e3_f64, 1e4, 1e6, 1e9, 1e16] {
            for _ in 0..2000 {
                let turn = UnitQuaternion::new(random.normal3() * 2.0);
                let m = turn.to_rotation_matrix().matrix().map(|x| (x * digits).round() / digits);
                let found = rotation_near(&m).unwrap().to_rotation_matrix();
                most = most.max((found.matrix() - orthonormal_factor(m)).amax());
            }
        }
        assert!(most < 2e-15, "{most}");
    }
}
