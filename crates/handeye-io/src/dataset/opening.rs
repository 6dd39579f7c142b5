//! From a manifest to a dataset: its files found, their records read and put together.

use std::{collections::BTreeSet, path::PathBuf};

use handeye::{
    AnswerFrame, Base, Camera, Flange, Intrinsics, Pose, Setup, Target, TargetModel, TargetSize,
    Touch, Warning,
};

use super::{
    CaptureSource, Dataset, PlacementSource,
    corners::{CornerReading, Corners},
    inputs,
    manifest::{Manifest, PlacementSpec, Source},
    motion,
    pairing::{self, Series},
    poses::{self, Named},
    shapes::TargetSpec,
    touches,
};
use crate::{
    camera,
    error::{Error, malformed, nearest},
    files, image,
    scan::ScanOptions,
    table::distinct_names,
    target_file::Targets,
};

/// A manifest that is being turned into a dataset.
pub(super) struct Opening {
    pub(super) manifest: Manifest,
    pub(super) source: Source,
    pub(super) root: PathBuf,
}

/// What belongs to captures, each as its files have it.
#[derive(Default)]
struct Parts {
    robot: Vec<Named<Pose<Base, Flange>>>,
    images: Vec<PathBuf>,
    scans: Vec<PathBuf>,
    corners: Vec<(String, Corners)>,
    board: Vec<Named<Pose<Camera, Target>>>,
}

impl Opening {
    pub(super) fn dataset(&self) -> Result<Dataset, Error> {
        let mut warnings = Vec::new();
        self.check_target()?;
        let parts = self.parts(&mut warnings)?;
        self.dataset_of(parts, warnings)
    }

    /// What the manifest says of the cell, before there are captures.
    pub(super) fn cell(&self) -> Result<Dataset, Error> {
        self.check_target()?;
        self.dataset_of(Parts::default(), vec![])
    }

    fn dataset_of(&self, parts: Parts, mut warnings: Vec<Warning>) -> Result<Dataset, Error> {
        let (m, robot) = (&self.manifest, self.manifest.robot.as_ref());
        let shape = self.shape(&mut warnings)?;
        let intrinsics = self.intrinsics(&parts)?;
        let correspondences = match &m.point_pairs {
            Some(spec) => {
                touches::correspondences(spec, m.setup, &parts.robot, &self.source, &self.root)?
            }
            None => vec![],
        };
        let placements = self.placements()?;
        let mut captures = self.captures(&parts, &mut warnings)?;
        let motion = match &m.motion {
            Some(spec) => {
                Some(motion::of(spec, &parts.robot, &mut captures, &self.source, &self.root)?)
            }
            None => None,
        };
        Ok(Dataset {
            manifest: self.source.path.clone(),
            setup: m.setup,
            target: self.target()?.cloned(),
            target_size: self.target_and_size()?.map_or_else(Default::default, |(_, size)| size),
            shape,
            other_targets: self.other_targets()?,
            intrinsics,
            lens_sigma: self.lens_sigma()?,
            lens: m.camera.as_ref().and_then(|spec| spec.calibrate),
            picture: m.camera.as_ref().and_then(|spec| spec.width.zip(spec.height)),
            pixel_origin: m.corners.as_ref().and_then(|spec| spec.pixel_origin),
            captures,
            motion,
            touches: self.touches(&placements)?,
            placements,
            correspondences,
            workspace: m.workspace.as_ref().map(|w| self.workspace(w)).transpose()?,
            known_position: m.known_position.map(|k| self.known_position(&k)).transpose()?,
            guess: m.guess.map(|g| self.guess(&g)).transpose()?,
            arm: robot
                .map(|spec| poses::arm(spec, &self.source, &self.root))
                .transpose()?
                .flatten(),
            urdf: robot.map(|spec| poses::urdf(spec, &self.root)).transpose()?.flatten(),
            noise: self.noise(&m.noise)?,
            limits: self.limits(m)?,
            answer_frame: m.answer.frame.map(AnswerFrame::from),
            frames: m.frames.clone(),
            equipment: self.equipment()?,
            inputs: inputs::files(&self.source, &self.root),
            notation: robot.and_then(|r| r.table().notation),
            warnings,
            root: self.root.clone(),
            bit_depth: m.images.as_ref().and_then(|i| i.bit_depth),
            scan_options: self.scan_options(intrinsics, &parts)?,
            memory: None,
        })
    }

    fn check_target(&self) -> Result<(), Error> {
        let m = &self.manifest;
        let seen = m.images.is_some() || m.scans.is_some() || m.corners.is_some();
        match &m.target {
            None if seen => Err(self
                .source
                .undeclared("target", "which board does the camera see? ([target] kind = ...)")),
            None => Ok(()),
            Some(_) => self
                .boards()
                .map_or(Ok(()), Targets::check)
                .map_err(|source| Error::Values { place: self.source.place("target"), source }),
        }
    }

    fn boards(&self) -> Option<&Targets> {
        self.manifest.target.as_ref().and_then(TargetSpec::boards)
    }

    /// The target that the calibration uses.
    fn target(&self) -> Result<Option<&TargetModel>, Error> {
        Ok(self.target_and_size()?.map(|(target, _)| target))
    }

    fn target_and_size(&self) -> Result<Option<(&TargetModel, TargetSize)>, Error> {
        let Some(targets) = self.boards() else { return Ok(None) };
        let picked = targets.pick_with_size(self.manifest.captures.target.as_deref());
        picked.map(Some).map_err(|(what, advice)| {
            malformed(
                self.source.place("captures.target"),
                format!("captures.target {what}"),
                advice,
            )
        })
    }

    fn other_targets(&self) -> Result<Vec<TargetModel>, Error> {
        let own = self.target()?;
        let all = self.boards().into_iter().flat_map(Targets::models);
        Ok(all.filter(|model| Some(*model) != own).cloned().collect())
    }

    fn parts(&self, warnings: &mut Vec<Warning>) -> Result<Parts, Error> {
        let (m, source, root) = (&self.manifest, &self.source, &self.root);
        let mut parts = Parts::default();
        if let Some(spec) = &m.robot {
            let (poses, more) = poses::of_robot(spec, source, root)?;
            (parts.robot, _) = (poses, warnings.extend(more));
        } else if m.point_pairs.is_none() || m.setup == Setup::EyeInHand {
            return Err(
                source.undeclared("robot", "where are the robot's poses? ([robot] poses = ...)")
            );
        }
        if let Some(spec) = &m.images {
            parts.images = files::expand(root, &spec.files, &source.place("images.files"))?;
        }
        if let Some(spec) = &m.scans {
            parts.scans = files::expand(root, &spec.files, &source.place("scans.files"))?;
        }
        if let Some(spec) = &m.corners {
            let reading = CornerReading::of(spec, m.noise.image_px, self.target()?, source)?;
            parts.corners = reading.read_all(spec, source, root)?;
        }
        if let Some(spec) = &m.board_poses {
            let (poses, more) = poses::of_board(spec, source, root)?;
            (parts.board, _) = (poses, warnings.extend(more));
        }
        Ok(parts)
    }

    fn intrinsics(&self, parts: &Parts) -> Result<Option<Intrinsics>, Error> {
        let spec = self.manifest.camera.as_ref().filter(|spec| !spec.is_open());
        let Some(spec) = spec else { return Ok(None) };
        let picture = parts.images.first().map(|path| image::image_size(path)).transpose()?;
        camera::read(spec, &self.root, &self.source.place("camera"), picture).map(Some)
    }

    fn scan_options(
        &self,
        intrinsics: Option<Intrinsics>,
        parts: &Parts,
    ) -> Result<ScanOptions, Error> {
        let Some(spec) = &self.manifest.scans else { return Ok(ScanOptions::default()) };
        let picture = parts.images.first().map(|path| image::image_size(path)).transpose()?;
        let own = |c| {
            camera::read(
                c,
                &self.root,
                &self.source.place("scans.camera"),
                None.or(picture.filter(|_| c.width.is_none())),
            )
        };
        Ok(ScanOptions {
            length_unit: spec.length_unit,
            depth_scale: spec.depth_scale,
            organised: spec.organised,
            intrinsics: spec.camera.as_ref().map(own).transpose()?.or(intrinsics),
        })
    }

    fn captures(
        &self,
        parts: &Parts,
        warnings: &mut Vec<Warning>,
    ) -> Result<Vec<CaptureSource>, Error> {
        if parts.robot.is_empty() {
            return Ok(vec![]);
        }
        let mut series = self.series(parts);
        let alone = match self.manifest.motion {
            None => series.len() < 2,
            // the robot's poses belong to moments of their own
            Some(_) => {
                series.remove(0);
                series.is_empty()
            }
        };
        if alone {
            return match self.manifest.point_pairs {
                Some(_) => Ok(vec![]),
                None => Err(self.source.undeclared(
                    "images",
                    "what did the camera see? ([images], [scans], [corners] or [board_poses])",
                )),
            };
        }
        let pairs = pairing::pair(&series, self.manifest.captures.pairing, warnings)?;
        let ids = self.ids(&series, &pairs)?;
        let mut captures: Vec<CaptureSource> = Vec::new();
        for (id, indices) in ids.into_iter().zip(&pairs) {
            captures.push(capture(id, indices, &series, parts));
        }
        self.exclude(&mut captures)?;
        Ok(captures)
    }

    /// The lists that are there, the robot's first.
    fn series(&self, parts: &Parts) -> Vec<Series> {
        let place = |key: &str| self.source.place(key);
        let named = |paths: &[PathBuf]| distinct_names(paths).into_iter().map(Some).collect();
        let all = vec![
            Series {
                what: "robot poses",
                place: place("robot.poses"),
                names: parts.robot.iter().map(|p| p.id.clone()).collect(),
            },
            Series { what: "images", place: place("images.files"), names: named(&parts.images) },
            Series { what: "scans", place: place("scans.files"), names: named(&parts.scans) },
            Series {
                what: "lists of corners",
                place: place("corners.files"),
                names: parts.corners.iter().map(|(id, _)| Some(id.clone())).collect(),
            },
            Series {
                what: "board poses",
                place: place("board_poses.poses"),
                names: parts.board.iter().map(|p| p.id.clone()).collect(),
            },
        ];
        all.into_iter().filter(|s| !s.names.is_empty()).collect()
    }

    /// Names of the captures: their images', else what the tables call them, else their numbers.
    fn ids(&self, series: &[Series], pairs: &[Vec<usize>]) -> Result<Vec<String>, Error> {
        let named = |s: &&Series| s.names.iter().all(Option::is_some);
        let leading = series[1..].iter().chain(&series[..1]).position(|s| named(&s));
        let Some(at) = leading.map(|i| (i + 1) % series.len()) else {
            return Ok((1..=pairs.len()).map(|i| format!("{i:02}")).collect());
        };
        let ids: Vec<String> =
            pairs.iter().filter_map(|p| series[at].names[p[at]].clone()).collect();
        match ids.iter().enumerate().find(|(i, id)| ids[..*i].contains(id)) {
            Some((_, twice)) => Err(malformed(
                series[at].place.clone(),
                format!("two of the {} are called {twice}", series[at].what),
                "give each capture a name of its own",
            )),
            None => Ok(ids),
        }
    }

    fn exclude(&self, captures: &mut Vec<CaptureSource>) -> Result<(), Error> {
        let unique: BTreeSet<&String> = self.manifest.captures.exclude.iter().collect();
        for id in unique {
            let Some(at) = captures.iter().position(|c| c.id == *id) else {
                let near = nearest(id, captures.iter().map(|c| c.id.as_str()));
                let advice = near.map_or("the captures are called like their images".into(), |n| {
                    format!("did you mean {n}?")
                });
                return Err(malformed(
                    self.source.place("captures.exclude"),
                    format!("there is no capture {id}"),
                    advice,
                ));
            };
            captures.remove(at);
        }
        Ok(())
    }

    fn placements(&self) -> Result<Vec<PlacementSource>, Error> {
        let mut all: Vec<PlacementSource> = Vec::new();
        for spec in &self.manifest.placements {
            let placement = self.placement(spec)?;
            if all.iter().any(|p| p.id == placement.id) {
                return Err(malformed(
                    self.source.place("placements"),
                    format!("two placements are called {}", placement.id),
                    "give each a name of its own",
                ));
            }
            all.push(placement);
        }
        Ok(all)
    }

    fn placement(&self, spec: &PlacementSpec) -> Result<PlacementSource, Error> {
        let (m, place) = (&self.manifest, self.source.place("placements"));
        let file = |name: &Option<String>| -> Result<Option<PathBuf>, Error> {
            let Some(name) = name else { return Ok(None) };
            match &files::expand(&self.root, name, &place)?[..] {
                [only] => Ok(Some(only.clone())),
                several => Err(malformed(
                    place.clone(),
                    format!("\"{name}\" is {} files, a placement has one", several.len()),
                    "name the file of this placement",
                )),
            }
        };
        let corners = match (file(&spec.corners)?, &m.corners) {
            (Some(path), Some(c)) => Some(
                CornerReading::of(c, m.noise.image_px, self.target()?, &self.source)?
                    .read(&path)?,
            ),
            (Some(_), None) => {
                return Err(self.source.undeclared(
                    "corners.pixel_origin",
                    "is (0, 0) the \"centre\" of the first pixel or its \"corner\"?",
                ));
            }
            (None, _) => None,
        };
        let camera_from_target = match (&spec.board_pose, &m.board_poses) {
            (Some(numbers), Some(board)) => {
                let reading =
                    poses::Reading::of(&board.table(), "board_poses", &self.source, &self.root)?;
                Some(poses::board_pose(reading.pose(numbers, &place)?, board, &self.source)?)
            }
            (Some(_), None) => {
                return Err(self.source.undeclared(
                    "board_poses",
                    "how is board_pose written? (notation, length_unit, direction)",
                ));
            }
            (None, _) => None,
        };
        let (image, scan) = (file(&spec.image)?, file(&spec.scan)?);
        Ok(PlacementSource { id: spec.id.clone(), image, scan, corners, camera_from_target })
    }

    fn touches(&self, placements: &[PlacementSource]) -> Result<Vec<Touch>, Error> {
        let Some(spec) = &self.manifest.touches else { return Ok(vec![]) };
        touches::read(
            spec,
            &touches::TouchContext {
                target: self.target()?,
                robot: self.manifest.robot.as_ref(),
                placements: placements.iter().map(|p| p.id.clone()).collect(),
                source: &self.source,
                root: &self.root,
            },
        )
    }
}

fn capture(id: String, indices: &[usize], series: &[Series], parts: &Parts) -> CaptureSource {
    let at = |what: &str| series.iter().position(|s| s.what == what).map(|i| indices[i]);
    let record = at("robot poses");
    let robot = record.map(|i| parts.robot[i].value);
    CaptureSource {
        id,
        robot_record: record.unwrap_or(0),
        base_from_flange: robot.unwrap_or(Pose::identity()),
        time_s: None,
        joints: record.map_or_else(Vec::new, |i| parts.robot[i].joints.clone()),
        image: at("images").map(|i| parts.images[i].clone()),
        scan: at("scans").map(|i| parts.scans[i].clone()),
        corners: at("lists of corners").map(|i| parts.corners[i].1.clone()),
        camera_from_target: at("board poses").map(|i| parts.board[i].value),
    }
}
