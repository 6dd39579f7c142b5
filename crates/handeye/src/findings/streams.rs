//! Findings about streams of poses, their clocks, and errors that change with time.

use super::{Found, row::Row};

/// What is found about streams.
#[derive(Debug, Clone, PartialEq)]
pub enum StreamFinding {
    /// Samples came out of order.
    Unsorted {
        /// `robot` or `camera`.
        stream: &'static str,
        /// How many.
        count: usize,
    },
    /// Samples are there twice.
    Repeated {
        /// `robot` or `camera`.
        stream: &'static str,
        /// How many.
        count: usize,
    },
    /// Samples share their time with a different pose.
    Conflicting {
        /// `robot` or `camera`.
        stream: &'static str,
        /// How many.
        count: usize,
    },
    /// Samples are too far apart for a pose between them.
    Gaps {
        /// `robot` or `camera`.
        stream: &'static str,
        /// How many.
        count: usize,
        /// The longest interval that is none, s.
        limit_s: f64,
        /// The same over the stream's median interval.
        times_median: f64,
    },
    /// Captures at times at which there is no pose of the robot.
    WithoutRobotPose {
        /// Their names.
        captures: Vec<String>,
    },
    /// Camera time minus robot time.
    Offset {
        /// The offset, s.
        offset_s: f64,
        /// Its standard deviation.
        sigma_s: f64,
        /// Samples that are captures.
        chosen: usize,
        /// All samples.
        of: usize,
    },
    /// The streams do not tell the offset.
    OffsetUndetermined,
    /// The motion repeats, and other offsets fit as well.
    OffsetAmbiguous {
        /// The others, s.
        others_s: Vec<f64>,
    },
    /// Errors of neighbouring captures are correlated.
    NeighboursAlike {
        /// Their correlation.
        correlation: f64,
    },
    /// Errors change slowly from capture to capture.
    Drift {
        /// Of what, and by how much.
        drift: Drift,
        /// Whether the answer takes it into account; there is none otherwise.
        is_fitted: bool,
    },
}

/// A random walk of errors.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Drift {
    /// Whether the camera moves in its holder; the target or the robot otherwise.
    pub of_camera: bool,
    /// Standard deviation per axis from one capture to the next, degrees.
    pub rotation_deg: f64,
    /// The same, mm.
    pub position_mm: f64,
    /// The same of the unit of distances; zero where it is known.
    pub scale: f64,
}

impl Drift {
    /// What moves, and by how much.
    pub fn in_words(&self) -> String {
        let what = match self.of_camera {
            false => "the target or the robot seems to move",
            true => "the camera seems to move in its holder",
        };
        let unit = match self.scale > 0.0 {
            true => format!(", {:.3} % of the unit of distances", self.scale * 100.0),
            false => String::new(),
        };
        format!(
            "{what} by {:.3} degrees and {:.2} mm per axis{unit} from one capture to the next",
            self.rotation_deg, self.position_mm
        )
    }
}

const STREAM_UNSORTED: Row = Row::info("stream-unsorted");
const STREAM_REPEATED: Row = Row::info("stream-repeated");
const STREAM_CONFLICTING: Row = Row::info("stream-conflicting");
const STREAM_GAPS: Row = Row::info("stream-gaps");
const CAPTURE_WITHOUT_ROBOT_POSE: Row = Row::info("capture-without-robot-pose");
const TIME_OFFSET: Row = Row::info("time-offset");
const TIME_OFFSET_UNDETERMINED: Row = Row::info("time-offset-undetermined");
const TIME_OFFSET_AMBIGUOUS: Row = Row::info("time-offset-ambiguous");
const NEIGHBOURS_ALIKE: Row = Row::info("neighbours-alike");
const DRIFT: Row = Row::changes(
    "drift",
    "errors changed slowly during the session, and the answer takes that into account",
    "warm up, and look for something that gives way",
);

/// All codes of this subject.
pub(super) const ROWS: &[&Row] = &[
    &STREAM_UNSORTED,
    &STREAM_REPEATED,
    &STREAM_CONFLICTING,
    &STREAM_GAPS,
    &CAPTURE_WITHOUT_ROBOT_POSE,
    &TIME_OFFSET,
    &TIME_OFFSET_UNDETERMINED,
    &TIME_OFFSET_AMBIGUOUS,
    &NEIGHBOURS_ALIKE,
    &DRIFT,
];

impl Found for StreamFinding {
    fn row(&self) -> &'static Row {
        match self {
            Self::Unsorted { .. } => &STREAM_UNSORTED,
            Self::Repeated { .. } => &STREAM_REPEATED,
            Self::Conflicting { .. } => &STREAM_CONFLICTING,
            Self::Gaps { .. } => &STREAM_GAPS,
            Self::WithoutRobotPose { .. } => &CAPTURE_WITHOUT_ROBOT_POSE,
            Self::Offset { .. } => &TIME_OFFSET,
            Self::OffsetUndetermined => &TIME_OFFSET_UNDETERMINED,
            Self::OffsetAmbiguous { .. } => &TIME_OFFSET_AMBIGUOUS,
            Self::NeighboursAlike { .. } => &NEIGHBOURS_ALIKE,
            Self::Drift { .. } => &DRIFT,
        }
    }

    fn message(&self) -> String {
        match self {
            Self::Unsorted { stream, count } => {
                format!("{count} {stream} samples were out of order and have been sorted")
            }
            Self::Repeated { stream, count } => {
                format!("{count} {stream} samples are listed twice; each is used once")
            }
            Self::Conflicting { stream, count } => format!(
                "{count} {stream} samples have the time stamp of a different pose and are not used: are the time stamps rounded too much?"
            ),
            Self::Gaps { stream, count, limit_s, times_median } => format!(
                "the {stream} stream has {count} gaps (longer than {limit_s:.4} s, {times_median} times its median interval, or with a quarter turn and more between two samples); poses are not interpolated there"
            ),
            Self::WithoutRobotPose { captures } => format!(
                "{} captures were taken where the robot's poses have a gap, or before or after them, and are not used: {}",
                captures.len(),
                captures.join(", ")
            ),
            Self::Offset { offset_s, sigma_s, chosen, of } => format!(
                "the camera's clock is ahead of the robot's by {offset_s:.6} s +- {sigma_s:.6} s (camera time = robot \
                 time + offset); {chosen} of {of} samples, spread evenly over the motion, are the captures"
            ),
            Self::OffsetUndetermined => "the streams do not tell the time offset between camera and robot: the robot \
                                         does not move where the camera sees the target, or moves at a constant speed; \
                                         let it start, stop and rotate about changing axes"
                .into(),
            Self::OffsetAmbiguous { others_s } => format!(
                "the motion repeats, so time offsets of {} s fit as well; the one with the longest common time was chosen. The camera's pose does not depend on it",
                others_s.iter().map(|o| format!("{o:.3}")).collect::<Vec<_>>().join(", ")
            ),
            Self::NeighboursAlike { correlation } => format!(
                "residuals of neighbouring captures are correlated ({correlation:.2}): errors change slowly with the pose, and the answer is less certain than stated"
            ),
            Self::Drift { drift, is_fitted: true } => format!(
                "errors change slowly from capture to capture: {}; the answer takes it into account",
                drift.in_words()
            ),
            Self::Drift { drift, is_fitted: false } => drift.in_words(),
        }
    }

    fn data(&self) -> Vec<(&'static str, f64)> {
        match self {
            Self::Unsorted { count, .. }
            | Self::Repeated { count, .. }
            | Self::Conflicting { count, .. } => vec![("count", *count as f64)],
            Self::Gaps { count, limit_s, .. } => {
                vec![("count", *count as f64), ("limit_s", *limit_s)]
            }
            Self::WithoutRobotPose { captures } => vec![("captures", captures.len() as f64)],
            Self::Offset { offset_s, sigma_s, .. } => {
                vec![("offset_s", *offset_s), ("sigma_s", *sigma_s)]
            }
            Self::NeighboursAlike { correlation } => vec![("correlation", *correlation)],
            Self::Drift { drift, .. } => {
                vec![("rotation_deg", drift.rotation_deg), ("position_mm", drift.position_mm)]
            }
            Self::OffsetUndetermined | Self::OffsetAmbiguous { .. } => vec![],
        }
    }
}
