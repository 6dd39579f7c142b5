//! The messages of ROS that matter here. ROS 1 and ROS 2 have the same fields in the same order, but for the number
//! of each message, which ROS 1 keeps in its headers.

use std::sync::Arc;

use nalgebra::{Isometry3, Quaternion, Translation3, UnitQuaternion};

use super::wire::{Broken, Encoding, Wire};

/// When something was measured and in which frame.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Header {
    /// Nanoseconds since 1970, or since the simulation began.
    pub(super) stamp: i64,
    pub(super) frame: String,
}

/// `sensor_msgs/Image`.
pub(super) struct Image<'a> {
    pub(super) header: Header,
    pub(super) width: u32,
    pub(super) height: u32,
    pub(super) encoding: String,
    pub(super) big_endian: bool,
    /// Bytes of a row.
    pub(super) step: u32,
    pub(super) data: &'a [u8],
}

/// `sensor_msgs/CompressedImage`.
pub(super) struct CompressedImage<'a> {
    pub(super) header: Header,
    pub(super) format: String,
    pub(super) data: &'a [u8],
}

/// `sensor_msgs/CameraInfo`, but for the rotation to the rectified image.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct CameraInfo {
    pub(super) frame: String,
    pub(super) width: u32,
    pub(super) height: u32,
    pub(super) distortion_model: String,
    pub(super) distortion: Vec<f64>,
    /// 3 x 3, by rows.
    pub(super) matrix: [f64; 9],
    /// 3 x 4, by rows: of the rectified image.
    pub(super) projection: [f64; 12],
    pub(super) binning: [u32; 2],
    /// Left, top, height, width of the part that is read out; zeros mean all of it.
    pub(super) region: [u32; 4],
}

/// One field of a `sensor_msgs/PointCloud2`.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct PointField {
    pub(super) name: String,
    pub(super) offset: u32,
    pub(super) datatype: u8,
}

/// `sensor_msgs/PointCloud2`.
pub(super) struct PointCloud<'a> {
    pub(super) header: Header,
    pub(super) width: u32,
    pub(super) height: u32,
    pub(super) fields: Vec<PointField>,
    pub(super) big_endian: bool,
    pub(super) point_step: u32,
    pub(super) row_step: u32,
    pub(super) data: &'a [u8],
}

/// `sensor_msgs/JointState`, but for its header, velocities and efforts.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct JointState {
    pub(super) names: Arc<Vec<String>>,
    pub(super) positions: Vec<f64>,
}

/// `geometry_msgs/TransformStamped`: takes points of `child` into the header's frame.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Transform {
    pub(super) header: Header,
    pub(super) child: String,
    pub(super) parent_from_child: Isometry3<f64>,
}

/// `geometry_msgs/PoseStamped`.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct PoseStamped {
    pub(super) header: Header,
    pub(super) pose: Isometry3<f64>,
}

/// Nanoseconds of a second.
const SECOND: i64 = 1_000_000_000;
/// How far the length of a quaternion may be from one.
const UNIT: f64 = 1e-3;

pub(super) fn header(wire: &mut Wire) -> Result<Header, Broken> {
    let seconds = if wire.encoding() == Encoding::Ros1 {
        wire.u32()?; // the message's number
        i64::from(wire.u32()?)
    } else {
        i64::from(wire.i32()?)
    };
    let stamp = seconds * SECOND + i64::from(wire.u32()?);
    Ok(Header { stamp, frame: frame(&wire.text()?) })
}

/// Names of frames began with a slash, long ago.
pub(super) fn frame(name: &str) -> String {
    name.strip_prefix('/').unwrap_or(name).into()
}

pub(super) fn image<'a>(wire: &mut Wire<'a>) -> Result<Image<'a>, Broken> {
    let header = header(wire)?;
    let (height, width) = (wire.u32()?, wire.u32()?);
    let (encoding, big_endian, step) = (wire.text()?, wire.u8()? != 0, wire.u32()?);
    Ok(Image { header, width, height, encoding, big_endian, step, data: wire.bytes()? })
}

pub(super) fn compressed_image<'a>(wire: &mut Wire<'a>) -> Result<CompressedImage<'a>, Broken> {
    Ok(CompressedImage { header: header(wire)?, format: wire.text()?, data: wire.bytes()? })
}

pub(super) fn camera_info(wire: &mut Wire) -> Result<CameraInfo, Broken> {
    let frame = header(wire)?.frame;
    let (height, width) = (wire.u32()?, wire.u32()?);
    let distortion_model = wire.text()?;
    let distortion = wire.list(Wire::f64)?;
    let (matrix, _, projection) = (wire.numbers()?, wire.numbers::<9>()?, wire.numbers()?);
    let binning = [wire.u32()?, wire.u32()?];
    let region = [wire.u32()?, wire.u32()?, wire.u32()?, wire.u32()?];
    Ok(CameraInfo {
        frame,
        width,
        height,
        distortion_model,
        distortion,
        matrix,
        projection,
        binning,
        region,
    })
}

pub(super) fn point_cloud<'a>(wire: &mut Wire<'a>) -> Result<PointCloud<'a>, Broken> {
    let header = header(wire)?;
    let (height, width) = (wire.u32()?, wire.u32()?);
    let fields = wire.list(point_field)?;
    let (big_endian, point_step, row_step) = (wire.u8()? != 0, wire.u32()?, wire.u32()?);
    let data = wire.bytes()?;
    Ok(PointCloud { header, width, height, fields, big_endian, point_step, row_step, data })
}

fn point_field(wire: &mut Wire) -> Result<PointField, Broken> {
    let field = PointField { name: wire.text()?, offset: wire.u32()?, datatype: wire.u8()? };
    wire.u32()?; // how many of them
    Ok(field)
}

/// Header, names and positions of a `sensor_msgs/JointState`.
pub(super) fn joint_state(wire: &mut Wire) -> Result<(Header, Vec<String>, Vec<f64>), Broken> {
    Ok((header(wire)?, wire.list(Wire::text)?, wire.list(Wire::f64)?))
}

/// Each of a message, or what is wrong with it.
pub(super) fn transforms(wire: &mut Wire) -> Result<Vec<Result<Transform, Broken>>, Broken> {
    wire.list(|wire| {
        let (header, child) = (header(wire)?, frame(&wire.text()?));
        let numbers = (wire.numbers()?, wire.numbers()?);
        Ok(match pose(numbers) {
            Ok(parent_from_child) => Ok(Transform { header, child, parent_from_child }),
            Err(what) => Err(format!("{what} ({} to {child})", header.frame)),
        })
    })
}

/// `geometry_msgs/PoseStamped`, and what begins alike: with the name of a child frame behind the header, or without.
pub(super) fn pose_stamped(wire: &mut Wire, has_child: bool) -> Result<PoseStamped, Broken> {
    let header = header(wire)?;
    if has_child {
        wire.text()?;
    }
    Ok(PoseStamped { header, pose: pose((wire.numbers()?, wire.numbers()?))? })
}

pub(super) fn text(wire: &mut Wire) -> Result<String, Broken> {
    wire.text()
}

/// Of a position and a quaternion.
fn pose((translation, [x, y, z, w]): ([f64; 3], [f64; 4])) -> Result<Isometry3<f64>, Broken> {
    let q = Quaternion::new(w, x, y, z);
    if !((q.norm() - 1.0).abs() < UNIT) || !translation.iter().all(|t| t.is_finite()) {
        return Err(format!(
            "has a pose whose quaternion has the length {:.4}, not 1, or that is not finite",
            q.norm()
        ));
    }
    Ok(Isometry3::from_parts(Translation3::from(translation), UnitQuaternion::from_quaternion(q)))
}
