//! What is wrong with a cell, and does not show in any single capture.

use handeye::{
    Anchor, Base, Flange, HandEye, ImageCorner, Intrinsics, Mount, Observation, Placement, Point,
    Pose, Session, Setup, SurfaceCorner, TargetModel, TargetSize, detect,
    math::random::Random,
    nalgebra::{Isometry3, Matrix3, Vector3},
    simulate::{Cell, Recording, Truth},
};

/// One systematic error.
#[derive(Clone, Copy)]
pub enum Fault {
    /// None.
    None,
    /// The board is larger than declared by this share.
    Size(f64),
    /// The board is longer than declared along its y by this share.
    Aspect(f64),
    /// The ends of the board lie behind its middle by this (m).
    Bow(f64),
    /// The focal length is longer than declared by this share.
    Focal(f64),
    /// The principal point lies elsewhere than declared (px, both axes).
    Centre(f64),
    /// Scans are shifted against images (m, along x).
    ScanShift(f64),
    /// Scans are rotated against images (rad, about x).
    ScanTilt(f64),
    /// Scans are too large by this share.
    ScanScale(f64),
    /// The camera slips on its mount (m, and rad per m), evenly from the first capture to the last.
    Slip(f64),
    /// The camera is bumped (m, and rad per m) halfway.
    Bump(f64),
    /// The target is bumped (m, and rad per m) halfway.
    TargetBump(f64),
    /// The target was measured, and the robot moves farther than it says by this share.
    RobotScale(f64),
    /// Images are late, always in the same direction of travel: by this way (m).
    Late(f64),
}

/// How well a caliper measures a board, as a share of its size.
const CALIPER: f64 = 1e-4;
/// Rotation that goes with a slip or a bump, rad per m.
const ROTATION: f64 = 1.0;

/// Names of all groups.
pub const GROUPS: [&str; 10] = [
    "clean",
    "size",
    "few-sizes",
    "measured",
    "print",
    "lens",
    "few-lenses",
    "scans",
    "moves",
    "late",
];

/// The faults of a group, none first.
pub fn group(name: &str) -> Option<Vec<Fault>> {
    let mut all = vec![Fault::None];
    match name {
        "clean" => {}
        "size" => {
            let sizes = [0.001, 0.003, 0.005, 0.01, 0.02, 0.03];
            all.extend(sizes.iter().rev().map(|s| Fault::Size(-s)));
            all.extend(sizes.map(Fault::Size));
        }
        "few-sizes" => all.extend([-0.02, 0.001, 0.003, 0.005, 0.01].map(Fault::Size)),
        "measured" => all = [-0.001, 0.0, 0.001].map(Fault::RobotScale).to_vec(),
        "late" => all.extend([1e-3, 3e-3].map(Fault::Late)),
        "print" => {
            all.extend([-0.01, -0.005, -0.002, 0.002, 0.005, 0.01].map(Fault::Aspect));
            all.extend([-2e-3, -1e-3, -0.5e-3, 0.5e-3, 1e-3, 2e-3].map(Fault::Bow));
        }
        "lens" => {
            all.extend([-0.01, -0.005, -0.002, 0.002, 0.005, 0.01].map(Fault::Focal));
            all.extend([-20.0, -5.0, 5.0, 20.0].map(Fault::Centre));
        }
        "few-lenses" => all.extend([0.002, 0.005].map(Fault::Focal)),
        "scans" => {
            all.extend([0.5e-3, 1e-3, 2e-3, 6e-3].map(Fault::ScanShift));
            all.extend([0.001, 0.003, 0.01].map(Fault::ScanTilt));
            all.extend([-0.01, -0.003, 0.001, 0.003].map(Fault::ScanScale));
        }
        "moves" => {
            all.extend([0.3e-3, 1e-3, 3e-3].map(Fault::Slip));
            all.extend([0.5e-3, 1e-3, 5e-3].map(Fault::Bump));
            all.extend([1e-3, 5e-3].map(Fault::TargetBump));
        }
        _ => return None,
    }
    Some(all)
}

impl Fault {
    pub fn is_none(&self) -> bool {
        matches!(self, Self::None)
    }

    pub fn name(&self) -> String {
        match self {
            Self::None => "clean".into(),
            Self::Size(s) => format!("size {:+.1} %", s * 100.0),
            Self::Aspect(s) => format!("board {:+.1} % in y", s * 100.0),
            Self::Bow(m) => format!("board bent by {:+.1} mm", m * 1e3),
            Self::Focal(s) => format!("focal {:+.1} %", s * 100.0),
            Self::Centre(px) => format!("centre {px:+.0} px"),
            Self::ScanShift(m) => format!("scans shifted {:.1} mm", m * 1e3),
            Self::ScanTilt(rad) => format!("scans tilted {:.2} deg", rad.to_degrees()),
            Self::ScanScale(s) => format!("scans scaled {:+.1} %", s * 100.0),
            Self::Slip(m) => format!("camera slips {:.1} mm", m * 1e3),
            Self::Bump(m) => format!("camera bumped {:.1} mm", m * 1e3),
            Self::TargetBump(m) => format!("target bumped {:.1} mm", m * 1e3),
            Self::RobotScale(s) => format!("measured, robot {:+.1} %", s * 100.0),
            Self::Late(m) => format!("images late by {:.0} mm", m * 1e3),
        }
    }

    /// Changes the cell itself, before anything is measured.
    pub fn build(&self, cell: &mut Cell) {
        if let (Self::Size(share), TargetModel::Checkerboard { square_mm, .. }) =
            (self, &mut cell.target)
        {
            *square_mm *= 1.0 + share;
        }
        match self {
            Self::Aspect(share) => cell.print_scale[1] = *share,
            Self::Bow(m) => cell.bow_mm = m * 1e3,
            Self::Focal(share) => {
                cell.intrinsics.fx *= 1.0 + share;
                cell.intrinsics.fy *= 1.0 + share;
            }
            Self::Centre(px) => {
                cell.intrinsics.cx += px;
                cell.intrinsics.cy += px;
            }
            _ => {}
        }
        if let Some(depth) = &mut cell.depth {
            match self {
                Self::ScanShift(m) => depth.shift_m.x = *m,
                Self::ScanTilt(rad) => depth.turn_rad.x = *rad,
                Self::ScanScale(share) => depth.scale = *share,
                _ => {}
            }
        }
    }

    /// Whether the fault can happen in such a cell.
    pub fn concerns(&self, scans: bool) -> bool {
        scans || !matches!(self, Self::ScanShift(_) | Self::ScanTilt(_) | Self::ScanScale(_))
    }

    /// Changes what is declared, or what was measured.
    pub fn spoil(&self, session: &mut Session, recording: &Recording, seed: u64) {
        let n = session.observations.len();
        for (k, o) in session.observations.iter_mut().enumerate() {
            if let Some(by) = self.moved(k, n, seed) {
                o.base_from_flange = self.reported(&o.base_from_flange, &by, recording);
            }
        }
        let usual = Cell::new(recording.cell.setup, recording.cell.seed);
        session.target = Some(usual.target);
        self.change_robot(session);
        session.camera = Some(usual.intrinsics);
        pose_anew(session);
    }

    /// What the robot says of all captures and touches alike.
    fn change_robot(&self, session: &mut Session) {
        match *self {
            Self::RobotScale(share) => {
                session.target_size = TargetSize::Measured(CALIPER);
                for o in &mut session.observations {
                    o.base_from_flange = scaled(&o.base_from_flange, share);
                }
                for touch in &mut session.touches {
                    touch.in_base = Point::from_vector(touch.in_base.vector() / (1.0 + share));
                    touch.base_from_flange = touch.base_from_flange.map(|f| scaled(&f, share));
                }
            }
            Self::Late(m) => {
                let way = moved_by(Vector3::new(0.0, m, 0.0));
                for o in &mut session.observations {
                    o.base_from_flange = Pose::claim(way * o.base_from_flange.iso());
                }
            }
            _ => {}
        }
    }

    /// How far capture `k` of `n` is from where camera or target end up.
    fn moved(&self, k: usize, n: usize, seed: u64) -> Option<Isometry3<f64>> {
        let (size, share) = match self {
            Self::Slip(m) => (*m, k as f64 / (n - 1) as f64 - 1.0),
            Self::Bump(m) | Self::TargetBump(m) => (*m, if 2 * k < n { -1.0 } else { 0.0 }),
            _ => return None,
        };
        let mut random = Random::new(seed ^ 0x51e9);
        let shift = random.normal3().normalize() * size;
        let turn = random.normal3().normalize() * (size * ROTATION);
        Some(Isometry3::new(shift * share, turn * share))
    }

    /// The robot pose that shows the same with camera, or target, not moved.
    fn reported(
        &self,
        says: &Pose<Base, Flange>,
        by: &Isometry3<f64>,
        recording: &Recording,
    ) -> Pose<Base, Flange> {
        let HandEye { mount_from_camera, anchor_from_target } = recording.truth.hand_eye;
        let (x, y) = (mount_from_camera.iso(), anchor_from_target.iso());
        let setup = recording.cell.setup;
        let a = *setup.anchor_from_mount(*says).iso();
        // A X = Y B with X exp(by), or Y exp(by), in the place of X or Y
        let a = match self {
            Self::TargetBump(_) => y * by * y.inverse() * a,
            _ => a * x * by.inverse() * x.inverse(),
        };
        let claimed: Pose<Anchor, Mount> = Pose::claim(a);
        setup.anchor_from_mount(claimed.rename()).rename()
    }

    /// What is true of the answer: for the frame of the scans where there are any, and in the base as the robot has it.
    pub fn truth(&self, truth: &Truth, cell: &Cell) -> Truth {
        let mut truth = truth.clone();
        if let Self::RobotScale(share) = self {
            // what the camera sees, from where the robot reckons: the base, or the tool that it moves there
            let x = truth.hand_eye.mount_from_camera;
            let views = &truth.camera_from_target[..cell.captures];
            let middle =
                views.iter().map(Pose::translation).sum::<Vector3<f64>>() / views.len() as f64;
            let from = match cell.setup {
                Setup::EyeToHand => Vector3::zeros(),
                Setup::EyeInHand => cell.tip_in_flange.vector(),
            };
            let way = x.iso().rotation * middle + x.translation() - from;
            let shift = way * (1.0 / (1.0 + share) - 1.0);
            truth.hand_eye.mount_from_camera = Pose::claim(moved_by(shift) * x.iso());
        }
        if let Some(depth) = &cell.depth {
            let scan_from_image = Isometry3::new(depth.shift_m, depth.turn_rad);
            let x = truth.hand_eye.mount_from_camera;
            truth.hand_eye.mount_from_camera = Pose::claim(x.iso() * scan_from_image.inverse());
        }
        truth
    }
}

/// The pose that a robot says which moves farther than it says by this share.
fn scaled(pose: &Pose<Base, Flange>, share: f64) -> Pose<Base, Flange> {
    let shift = pose.translation() * (1.0 / (1.0 + share) - 1.0);
    Pose::claim(moved_by(shift) * pose.iso())
}

fn moved_by(shift: Vector3<f64>) -> Isometry3<f64> {
    Isometry3::new(shift, Vector3::zeros())
}

/// Corners of scans where the declared rays of their pixels meet the scanned board, as the program lifts them.
fn lift_anew(corners: &[ImageCorner], surface: &mut [SurfaceCorner], camera: &Intrinsics) {
    let points: Vec<Vector3<f64>> = surface.iter().map(|c| c.in_camera.vector()).collect();
    let middle = points.iter().sum::<Vector3<f64>>() / points.len().max(1) as f64;
    let scatter: Matrix3<f64> =
        points.iter().map(|p| (p - middle) * (p - middle).transpose()).sum();
    let eigen = scatter.symmetric_eigen();
    let normal: Vector3<f64> = eigen.eigenvectors.column(eigen.eigenvalues.imin()).into();
    for corner in surface {
        let pixel = corners.iter().find(|c| c.id == corner.id).map(|c| c.pixel);
        let Some(ray) = pixel.and_then(|p| camera.ray(&p)) else { continue };
        // what the scan says beside the plane stays: its noise, and the board's shape
        let p = corner.in_camera.vector();
        let beside = (p - middle).dot(&normal);
        let depth = (middle.dot(&normal) + beside) / ray.dot(&normal);
        corner.in_camera = Point::from_vector(ray * depth);
    }
}

/// Poses of the target as the declared board and lens give them.
fn pose_anew(session: &mut Session) {
    let (Some(target), Some(camera)) = (session.target.clone(), session.camera) else { return };
    let posed = |corners: &[_], surface: &[_]| {
        detect::target_poses(corners, surface, &target, &camera)
            .map_or(vec![], |poses| detect::with_symmetries(&poses, &target))
    };
    let scans = session.observations.iter_mut().map(|o| (&o.corners, &mut o.surface));
    for (corners, surface) in scans.filter(|(_, surface)| surface.len() >= 4) {
        lift_anew(corners, surface, &camera);
    }
    for Observation { corners, surface, candidates, .. } in &mut session.observations {
        *candidates = posed(corners, surface);
    }
    for Placement { corners, surface, candidates, .. } in &mut session.placements {
        *candidates = posed(corners, surface);
    }
}
