//! Mistakes, planted into a case.

use super::*;

/// Where a run of captures begins, of which most are before it: at least two belong to it.
fn late(random: &mut Random, n: usize) -> usize {
    let longest = (n.saturating_sub(4)).min((n - 1) / 2).max(2);
    n - 2 - random.bits() as usize % (longest - 1)
}

/// A place that nobody takes for noise: 30 mm and 5 degrees away.
fn elsewhere() -> Iso {
    Iso::new(Vector3::new(0.025, -0.015, 0.005), Vector3::new(0.02, 0.01, 0.09))
}

pub(super) fn plant(mistake: Mistake, case: &mut Case, random: &mut Random) {
    declare_wrongly(mistake, case, random);
    spoil(mistake, case, random);
}

/// Mistakes in what the manifest says.
fn declare_wrongly(mistake: Mistake, case: &mut Case, random: &mut Random) {
    let signed = |random: &mut Random, low: f64, high: f64| {
        let size = random.between(low, high);
        if random.bits().is_multiple_of(2) { 1.0 + size } else { 1.0 / (1.0 + size) }
    };
    let d = &mut case.declared;
    match mistake {
        M::RobotInverted => d.robot_direction = true,
        M::BoardInverted => d.board_direction = true,
        M::BothInverted => (d.robot_direction, d.board_direction) = (true, true),
        M::SetupExchanged => {
            d.setup = Some(match case.setup {
                Setup::EyeInHand => Setup::EyeToHand,
                Setup::EyeToHand => Setup::EyeInHand,
            });
        }
        M::EulerOrder | M::VectorAsEuler => {
            let mut other = euler(random);
            while other.rotation == case.notation.rotation {
                other = euler(random);
            }
            d.notation = Some(other);
        }
        M::EulerAsVector => d.notation = Some(named("rotation-vector")),
        M::QuaternionOrder => {
            let is_xyzw = case.notation.name == "quaternion-xyzw";
            d.notation = Some(named(if is_xyzw { "quaternion-wxyz" } else { "quaternion-xyzw" }));
        }
        M::DegreesRadians => {
            let angle = match case.units.angle {
                AngleUnit::Radian => AngleUnit::Degree,
                AngleUnit::Degree => AngleUnit::Radian,
            };
            d.units = Some(Units { angle, ..case.units });
        }
        M::MillimetresMetres => {
            let length = match case.units.length {
                LengthUnit::Metre => LengthUnit::Millimetre,
                _ => LengthUnit::Metre,
            };
            d.units = Some(Units { length, ..case.units });
        }
        M::SquareSizeFar => d.square_mm = Some(case.square_mm * signed(random, 0.06, 0.15)),
        M::SquareSizeNear => d.square_mm = Some(case.square_mm * signed(random, 0.02, 0.04)),
        M::HalfPixel => d.pixel_origin_corner = true,
        _ => {}
    }
}

/// Mistakes in what was measured.
fn spoil(mistake: Mistake, case: &mut Case, random: &mut Random) {
    let n = case.robot.len();
    let i = random.bits() as usize % n;
    let j = (i + 1 + random.bits() as usize % (n - 1)) % n;
    match mistake {
        M::RotationsTransposed => {
            case.robot.iter_mut().for_each(|p| p.rotation = p.rotation.inverse());
            case.stored_inverted = false;
        }
        M::AxisMirrored => {
            let axis = random.bits() as usize % 3;
            case.robot.iter_mut().for_each(|p| p.translation.vector[axis] *= -1.0);
            case.stored_inverted = false;
        }
        M::BaseLeftHanded => {
            case.robot.iter_mut().for_each(|p| *p = mirrored(p));
            case.stored_inverted = false;
        }
        M::OrderShifted => case.rotate_pictures(1 + i % (n - 1)),
        M::OrderReversed => {
            case.session.observations.reverse();
            case.board.iter_mut().for_each(|b| b.reverse());
        }
        M::PicturesExchanged => {
            case.session.observations.swap(i, j);
            case.board.iter_mut().for_each(|b| b.swap(i, j));
        }
        M::RobotPoseFrozen => case.robot[j] = case.robot[i],
        M::CameraStill => case.show_again(i, j),
        M::CaptureRepeated => {
            case.robot[j] = case.robot[i];
            case.show_again(i, j);
        }
        M::TargetMoved | M::CameraMoved => {
            let from = late(random, n);
            case.move_from(from, mistake == M::CameraMoved);
        }
        _ => {}
    }
}

/// The same pose with the x axis of its base turned round.
fn mirrored(p: &Iso) -> Iso {
    let half_turn = UnitQuaternion::from_scaled_axis(Vector3::x() * PI);
    let t = p.translation.vector;
    Iso::from_parts(Vector3::new(-t.x, t.y, t.z).into(), half_turn * p.rotation * half_turn)
}

impl Case {
    fn rotate_pictures(&mut self, k: usize) {
        self.session.observations.rotate_left(k);
        self.board.iter_mut().for_each(|b| b.rotate_left(k));
    }

    /// Capture `j` has the image of capture `i`.
    fn show_again(&mut self, i: usize, j: usize) {
        self.session.observations[j] = self.session.observations[i].clone();
        if let Some(board) = &mut self.board {
            board[j] = board[i];
        }
    }

    /// From this capture on, target or camera is elsewhere.
    fn move_from(&mut self, from: usize, camera: bool) {
        let by = elsewhere();
        let moved = |p: &Iso| if camera { by * p } else { p * by };
        let intrinsics = self.session.camera.expect("simulated");
        let target = self.session.target.clone().expect("simulated");
        for k in from..self.robot.len() {
            let observation = &mut self.session.observations[k];
            let seen = *observation.candidates[0].camera_from_target.iso();
            let shift = |corner: &mut handeye::ImageCorner| {
                let Some(at) = target.corner(corner.id) else { return };
                let place = |p: &Iso| {
                    let pose: Pose<Camera, Target> = Pose::claim(*p);
                    intrinsics.project(&(pose * at).vector())
                };
                if let (Some(old), Some(new)) = (place(&seen), place(&moved(&seen))) {
                    corner.pixel += new - old;
                }
            };
            observation.corners.iter_mut().for_each(shift);
            if let Some(board) = &mut self.board {
                board[k] = moved(&board[k]);
            }
        }
    }
}
