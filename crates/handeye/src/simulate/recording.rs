//! What is measured in a cell, and the truth behind it.

use nalgebra::{Matrix2, Matrix3, Vector2, Vector3};

use super::{
    Cell, Conditions, Scene, TrueCorner,
    cell::{CORNERS, PICTURES, SCANS, random},
    conditions::Paper,
};
use crate::{
    Base, Camera, Error, Flange, GrayImage, ImageCorner, Observation, Placement, Point, Pose, Scan,
    Session, SurfaceCorner, Target, Touch, detect,
    simulate::cell::{ROBOT, TOOL, Truth, direction, out_of_reach, placement_name},
};

/// What the robot says in a cell, and the truth behind it. Images and scans are made when asked
/// for, one at a time.
#[derive(Debug, Clone)]
pub struct Recording<'a> {
    /// The cell.
    pub cell: &'a Cell,
    /// Where the robot says it is, in every capture.
    pub base_from_flange: Vec<Pose<Base, Flange>>,
    /// Its joint values there; empty where it is no arm with joints.
    pub joints: Vec<Vec<f64>>,
    /// The touches.
    pub touches: Vec<Touch>,
    /// The truth.
    pub truth: Truth,
    pub(super) seed: u64,
}

/// Corners are never stated more precisely than this, px.
const LEAST_CORNER_PX: f64 = 1e-3;
/// 3D corners likewise, m.
const LEAST_DEPTH_M: f64 = 1e-6;

impl Cell {
    /// Sends the robot to all captures and touches; errors come from `seed`.
    ///
    /// # Errors
    /// [`Error::Invalid`] when the board does not fit into the image, or is no board.
    pub fn record(&self, seed: u64) -> Result<Recording<'_>, Error> {
        self.target.check()?;
        self.intrinsics.check()?;
        let camera_from_target = self.views()?;
        let at = |view| self.hand_eye.base_from_flange(self.setup, view);
        let base_from_flange: Vec<Pose<Base, Flange>> =
            camera_from_target[..self.captures].iter().map(at).collect();
        self.recorded(camera_from_target, base_from_flange, seed)
    }

    /// The same with captures at these poses of the robot, as many as the cell has; the target may then be partly, or not at
    /// all, in the image.
    ///
    /// # Errors
    /// As [`Cell::record`]; another number of poses than of captures.
    pub fn record_at(
        &self,
        base_from_flange: &[Pose<Base, Flange>],
        seed: u64,
    ) -> Result<Recording<'_>, Error> {
        self.target.check()?;
        self.intrinsics.check()?;
        if base_from_flange.len() != self.captures {
            let (poses, captures) = (base_from_flange.len(), self.captures);
            return Err(Error::Invalid(format!("{poses} poses for {captures} captures")));
        }
        let seen = |pose| self.hand_eye.camera_from_target(self.setup, pose);
        let placed = self.views()?.split_off(self.captures);
        let views = base_from_flange.iter().map(seen).chain(placed).collect();
        self.recorded(views, base_from_flange.to_vec(), seed)
    }

    fn recorded(
        &self,
        camera_from_target: Vec<Pose<Camera, Target>>,
        base_from_flange: Vec<Pose<Base, Flange>>,
        seed: u64,
    ) -> Result<Recording<'_>, Error> {
        let mut robot = random(seed, ROBOT, 0);
        let arm = self.robot();
        let says = |p| arm.reported(p, &self.noise, &mut robot);
        let reported = base_from_flange.iter().map(says).collect::<Option<Vec<_>>>();
        let (reported, joints) = reported.ok_or_else(out_of_reach)?.into_iter().unzip();
        let tip_error = direction(&mut random(self.seed, TOOL, 0)) * self.noise.tip_m;
        let hand_eye = self.hand_eye;
        let truth = Truth { hand_eye, camera_from_target, base_from_flange, tip_error };
        let touches = self.touch_all(&truth, seed).ok_or_else(out_of_reach)?;
        Ok(Recording { cell: self, base_from_flange: reported, joints, touches, truth, seed })
    }

    /// A session with corners that are projected, not detected in images: quick.
    ///
    /// # Errors
    /// As [`Cell::record`].
    pub fn session(&self, seed: u64) -> Result<(Session, Truth), Error> {
        let recording = self.record(seed)?;
        Ok((recording.session(), recording.truth))
    }
}

impl Recording<'_> {
    /// Where the robot believes the tip, in the flange.
    pub fn believed_tip(&self) -> Point<Flange> {
        Point::from_vector(self.cell.tip_in_flange.vector() - self.truth.tip_error)
    }

    /// The scene of image `k`: captures first, then placements.
    pub fn scene(&self, k: usize) -> Scene {
        Scene {
            target: self.cell.target.clone(),
            camera_from_target: self.truth.camera_from_target[k],
            intrinsics: self.cell.intrinsics,
        }
    }

    fn conditions(&self) -> Conditions {
        Conditions { print: self.cell.print_errors(), ..Conditions::default() }
    }

    /// Renders image `k`.
    pub fn picture(&self, k: usize) -> GrayImage {
        let seed = random(self.seed, PICTURES, k).bits();
        self.scene(k).picture_under(&self.conditions(), &self.cell.optics, seed)
    }

    /// Renders scan `k`, pixel-aligned with the image; `None` without a 3D camera.
    pub fn scan(&self, k: usize) -> Option<Scan> {
        let sensor = self.cell.depth?;
        let scene = Scene { intrinsics: self.cell.scan_intrinsics(), ..self.scene(k) };
        Some(scene.scan_under(&self.conditions(), &sensor, random(self.seed, SCANS, k).bits()))
    }

    /// Corners of image `k`, projected, with their noise.
    pub fn corners(&self, k: usize) -> Vec<ImageCorner> {
        let mut random = random(self.seed, CORNERS, k);
        let sigma = self.cell.noise.corner_px;
        let stated = Matrix2::identity() * sigma.max(LEAST_CORNER_PX).powi(2);
        let mut corner = |c: TrueCorner| {
            let TrueCorner { id, pixel: exact, .. } = c;
            let pixel = exact + Vector2::new(random.normal(), random.normal()) * sigma;
            ImageCorner { id, pixel, covariance: stated }
        };
        let seen = self.scene(k).corners_under(&self.conditions(), &self.cell.optics);
        seen.into_iter().map(&mut corner).collect()
    }

    /// Corners of scan `k`: the depth, with its noise, on the rays of the corners in the image.
    pub fn surface(&self, k: usize, corners: &[ImageCorner]) -> Vec<SurfaceCorner> {
        let Some(sensor) = self.cell.depth else { return vec![] };
        let mut random = random(self.seed, SCANS, k);
        let scene = self.scene(k);
        let scene = Scene { camera_from_target: sensor.sees(&scene.camera_from_target), ..scene };
        let paper = Paper::new(&self.cell.target, &self.conditions().print);
        let mut felt = |c: &ImageCorner| {
            let ray = self.cell.intrinsics.ray(&c.pixel)?;
            let (_, depth) = scene.on_board(&ray, paper.as_ref())?;
            let z = sensor.reads(depth, false);
            let sigma = sensor.sigma_at_1m * z * z;
            let in_camera = Point::from_vector(ray * (z + sigma * random.normal()));
            let covariance = self.felt_covariance(&ray, z, sigma, c);
            Some(SurfaceCorner { id: c.id, in_camera, covariance })
        };
        corners.iter().filter_map(&mut felt).collect()
    }

    fn felt_covariance(&self, ray: &Vector3<f64>, z: f64, s: f64, c: &ImageCorner) -> Matrix3<f64> {
        let camera = &self.cell.intrinsics;
        let sideways = Vector2::new(z / camera.fx, z / camera.fy);
        let mut covariance = ray * ray.transpose() * s.powi(2);
        covariance += Matrix3::identity() * LEAST_DEPTH_M.powi(2);
        (0..2).for_each(|i| covariance[(i, i)] += sideways[i].powi(2) * c.covariance[(i, i)]);
        covariance
    }

    /// Everything as a session, without rendering.
    pub fn session(&self) -> Session {
        let cell = self.cell;
        let observations = (0..cell.captures).map(|k| self.observation(k)).collect();
        let placements = (0..cell.placements).map(|k| self.placement(k)).collect();
        Session {
            arm: cell.built_arm().map(|a| a.model),
            target: Some(cell.target.clone()),
            camera: Some(cell.intrinsics),
            placements,
            touches: self.touches.clone(),
            ..Session::of_captures(cell.setup, observations)
        }
    }

    fn observation(&self, k: usize) -> Observation {
        let corners = self.corners(k);
        let surface = self.surface(k, &corners);
        let candidates = self.candidates(&corners, &surface);
        let (base_from_flange, joints) = (self.base_from_flange[k], self.joints[k].clone());
        let capture = format!("{:03}", k + 1);
        let bare = Observation::bare(capture, base_from_flange, Pose::identity());
        Observation { joints, corners, surface, candidates, ..bare }
    }

    fn placement(&self, k: usize) -> Placement {
        let corners = self.corners(self.cell.captures + k);
        let surface = self.surface(self.cell.captures + k, &corners);
        let candidates = self.candidates(&corners, &surface);
        Placement { id: placement_name(k), corners, surface, candidates, not_seen: None }
    }

    fn candidates(&self, c: &[ImageCorner], s: &[SurfaceCorner]) -> Vec<crate::TargetPose> {
        let target = &self.cell.target;
        detect::target_poses(c, s, target, &self.cell.intrinsics)
            .map_or(vec![], |poses| detect::with_symmetries(&poses, target))
    }
}
