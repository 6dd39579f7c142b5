//! Findings about the frames of images and scans.

use super::{Found, row::Row};

/// A source whose frame an answer can be for.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Frame {
    /// That of the images.
    Images,
    /// That of the scans.
    Scans,
}

impl Frame {
    fn name(self) -> &'static str {
        match self {
            Self::Images => "images",
            Self::Scans => "scans",
        }
    }

    fn other(self) -> &'static str {
        match self {
            Self::Images => "scans",
            Self::Scans => "images",
        }
    }
}

/// Three numbers, about or along x, y and z, each with its standard deviation.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct OfAxes {
    /// The numbers.
    pub values: [f64; 3],
    /// Their standard deviations.
    pub sigmas: [f64; 3],
}

/// How scans lie against images.
#[derive(Debug, Clone, PartialEq)]
pub struct OffsetOfScans {
    /// Shift and its largest standard deviation, mm.
    pub shift_mm: Option<([f64; 3], f64)>,
    /// Rotation and its largest standard deviation, degrees.
    pub rotation_deg: Option<([f64; 3], f64)>,
}

/// Where the source that is not used puts the camera.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct OtherAnswer {
    /// The camera's position, mm.
    pub position_mm: [f64; 3],
    /// Mean distance of both answers where the target was seen, mm.
    pub differs_mm: f64,
}

/// What is found about the frames of images and scans.
#[derive(Debug, Clone, PartialEq)]
pub enum FramesFinding {
    /// They differ, and the captures do not tell how.
    NotSeparable,
    /// Distances in scans are longer by a share.
    Scale {
        /// The share.
        value: f64,
        /// Its standard deviation.
        sigma: f64,
    },
    /// Scans are rotated, degrees.
    Tilt(OfAxes),
    /// Scans are shifted, mm.
    Shift(OfAxes),
    /// Each source has its own answer, and one is taken.
    Disagree {
        /// The source that is used.
        used: Frame,
        /// Mean distance of the target between both, mm.
        distance_mm: f64,
        /// Angle of the target between both, degrees.
        angle_deg: f64,
        /// What the other one says; `None` where it determines no answer.
        other: Option<OtherAnswer>,
    },
    /// They differ by a rigid offset, which was taken out.
    Offset {
        /// The offset.
        scans_are: OffsetOfScans,
        /// By how much it moves the target, mm.
        at_target_mm: f64,
        /// The frame that the answer is for.
        answer: Frame,
        /// Where the camera is for the other frame, mm.
        other_position_mm: [f64; 3],
    },
    /// An offset that does not bring both together: the scans' own answer is taken.
    OffsetNotConfirmed {
        /// The offset.
        scans_seem: OffsetOfScans,
        /// Distance of both answers with it taken out, mm.
        apart_mm: f64,
    },
}

impl FramesFinding {
    /// What was seen and where, with its numbers.
    pub(crate) fn message(&self) -> String {
        match self {
            Self::NotSeparable => "images and scans put the target at different positions, and these captures do not tell whether the scans are scaled, rotated or shifted: show the target at several \
                                   distances and tilts, and check the calibration between image and scan"
                .into(),
            Self::Scale { value, sigma } => format!(
                "scans put the target {:+.3} +- {:.3} % farther away than images do: the focal length, the size of the target or the scale of depth is wrong; only the robot's motions can tell which",
                value * 100.0,
                sigma * 100.0
            ),
            Self::Tilt(axes) => format!(
                "scans are rotated against images by {} degrees about x, y, z of the camera: check the calibration between image and depth, and in which frame the points are given",
                axes.in_words()
            ),
            Self::Shift(axes) => format!(
                "scans are shifted against images by {} mm along x, y, z of the camera: check the calibration between image and depth, in which frame the points are given, and whether depth has an offset",
                axes.in_words()
            ),
            Self::Disagree { used, distance_mm, angle_deg, other } => format!(
                "images and scans put the target {distance_mm:.1} mm and {angle_deg:.2} degrees apart (mean of the \
                 captures): the answer is for the frame of the {used}, from the {used} alone; the {} alone {}. Check \
                 the calibration between image and scan, in which frame the points are given, and the lens of the \
                 images; `frame` of [answer] chooses the other one",
                used.other(),
                other_in_words(other.as_ref()),
                used = used.name(),
            ),
            Self::Offset { scans_are, at_target_mm, answer, other_position_mm: [x, y, z] } => format!(
                "the frame of the scans is not that of the images: scans are {}, {at_target_mm:.2} mm at the target. \
                 The answer is for the {}; for the {} the camera is at ({x:.2}, {y:.2}, {z:.2}) mm. Check the \
                 calibration between image and scan, and in which frame the points are given",
                scans_are.in_words(),
                answer.name(),
                answer.other(),
            ),
            Self::OffsetNotConfirmed { scans_seem, apart_mm } => format!(
                "the frame of the scans is not that of the images: scans seem {}, but with that taken out the images \
                 put the camera {apart_mm:.2} mm from where the scans alone do. The answer is from the scans alone. \
                 Check the calibration between image and scan, the lens of the images, and in which frame the points \
                 are given",
                scans_seem.in_words(),
            ),
        }
    }
}

const PICTURE_AND_SCAN_DIFFER: Row = Row::rejects(
    "picture-and-scan-differ",
    "show the target at several distances and tilts, and check the calibration between image and scan",
);
pub(crate) const PICTURE_AND_SCAN_SCALE: Row = Row::changes(
    "picture-and-scan-scale",
    "images and scans disagree in scale",
    "check focal length, size of the target and scale of depth",
);
pub(crate) const PICTURE_AND_SCAN_TILT: Row = Row::changes(
    "picture-and-scan-tilt",
    "images and scans disagree in rotation",
    "use the point cloud that is registered to the image (the same optical frame)",
);
pub(crate) const PICTURE_AND_SCAN_SHIFT: Row = Row::changes(
    "picture-and-scan-shift",
    "images and scans disagree in position",
    "use the point cloud that is registered to the image (the same optical frame)",
);
pub(crate) const PICTURE_AND_SCAN_DISAGREE: Row = Row::changes(
    "picture-and-scan-disagree",
    "images and scans disagree, and the answer is for the frame of one of them",
    "check the calibration between image and depth, and the frame of the points",
);

/// All codes of this subject.
pub(super) const ROWS: &[&Row] = &[
    &PICTURE_AND_SCAN_DIFFER,
    &PICTURE_AND_SCAN_SCALE,
    &PICTURE_AND_SCAN_TILT,
    &PICTURE_AND_SCAN_SHIFT,
    &PICTURE_AND_SCAN_DISAGREE,
];

/// What the difference of both frames consists of: where that is said, one headline is enough.
pub(crate) const PARTS_OF_DISAGREE: [&Row; 3] =
    [&PICTURE_AND_SCAN_SCALE, &PICTURE_AND_SCAN_TILT, &PICTURE_AND_SCAN_SHIFT];

impl Found for FramesFinding {
    fn row(&self) -> &'static Row {
        match self {
            Self::NotSeparable => &PICTURE_AND_SCAN_DIFFER,
            Self::Scale { .. } => &PICTURE_AND_SCAN_SCALE,
            Self::Tilt(_) => &PICTURE_AND_SCAN_TILT,
            Self::Shift(_) => &PICTURE_AND_SCAN_SHIFT,
            Self::Disagree { .. } | Self::Offset { .. } | Self::OffsetNotConfirmed { .. } => {
                &PICTURE_AND_SCAN_DISAGREE
            }
        }
    }

    fn message(&self) -> String {
        FramesFinding::message(self)
    }

    fn headline(&self) -> Option<String> {
        let frame = match self {
            Self::Disagree { used, .. } => used,
            Self::Offset { answer, .. } => answer,
            Self::OffsetNotConfirmed { .. } => &Frame::Scans,
            Self::NotSeparable | Self::Scale { .. } | Self::Tilt(_) | Self::Shift(_) => {
                return None;
            }
        };
        let name = frame.name();
        Some(format!("images and scans disagree, and the answer is for the frame of the {name}"))
    }

    fn data(&self) -> Vec<(&'static str, f64)> {
        match self {
            Self::NotSeparable => vec![],
            Self::Scale { value, sigma } => vec![("value", *value), ("sigma", *sigma)],
            Self::Tilt(axes) => named(["x_deg", "y_deg", "z_deg"], axes.values),
            Self::Shift(axes) => named(["x_mm", "y_mm", "z_mm"], axes.values),
            Self::Disagree { distance_mm, angle_deg, .. } => {
                vec![("distance_mm", *distance_mm), ("angle_deg", *angle_deg)]
            }
            Self::Offset { at_target_mm, .. } => vec![("at_target_mm", *at_target_mm)],
            Self::OffsetNotConfirmed { apart_mm, .. } => vec![("apart_mm", *apart_mm)],
        }
    }
}

fn named(names: [&'static str; 3], values: [f64; 3]) -> Vec<(&'static str, f64)> {
    names.into_iter().zip(values).collect()
}

fn other_in_words(other: Option<&OtherAnswer>) -> String {
    other.map_or("determine no answer".into(), |o| {
        let [x, y, z] = o.position_mm;
        format!(
            "put the camera at ({x:.2}, {y:.2}, {z:.2}) mm, which differs by {:.2} mm where the target was seen",
            o.differs_mm
        )
    })
}

impl OfAxes {
    fn in_words(&self) -> String {
        let one = |k: usize| format!("{:+.3} +- {:.3}", self.values[k], self.sigmas[k]);
        format!("({}, {}, {})", one(0), one(1), one(2))
    }
}

impl OffsetOfScans {
    fn in_words(&self) -> String {
        let axes = |v: &[f64; 3], digits: usize| {
            let one = |x: f64| if x == 0.0 { "0".to_owned() } else { format!("{x:+.digits$}") };
            format!("({}, {}, {})", one(v[0]), one(v[1]), one(v[2]))
        };
        let shift = self.shift_mm.as_ref();
        let shift = shift.map(|(v, s)| format!("shifted by {} +- {s:.3} mm", axes(v, 3)));
        let turn = self.rotation_deg.as_ref();
        let turn = turn.map(|(v, s)| format!("rotated by {} +- {s:.4} degrees", axes(v, 4)));
        shift.into_iter().chain(turn).collect::<Vec<_>>().join(" and ")
    }
}
