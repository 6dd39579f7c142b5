//! A route as a program of a robot: a motion to each pose of the flange, and a halt in which the image is taken.
//!
//! The poses are of the flange in the base: each program sets the active tool and base to none first. The motions are those
//! whose ways were checked: of joints where the arm is known, else straight ones. Joint values go into programs of UR only;
//! other makers' joints may rotate the other way, or be coupled, where their controllers show them.

use handeye::tools::plan::{Route, Stop};

use crate::{export::text, robot::Notation};

/// A maker whose programs are written.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Maker {
    /// URScript.
    Ur,
    /// KRL.
    Kuka,
    /// TP, as `.ls`.
    Fanuc,
    /// RAPID.
    Abb,
}

impl Maker {
    /// All of them, by name.
    pub const ALL: [(&'static str, Maker); 4] =
        [("ur", Maker::Ur), ("kuka", Maker::Kuka), ("fanuc", Maker::Fanuc), ("abb", Maker::Abb)];

    /// The maker of a name.
    ///
    /// # Errors
    /// Which names there are.
    pub fn named(name: &str) -> Result<Maker, String> {
        let found = Self::ALL.iter().find(|(own, _)| own.eq_ignore_ascii_case(name));
        found.map(|(_, maker)| *maker).ok_or_else(|| {
            let names: Vec<&str> = Self::ALL.iter().map(|(name, _)| *name).collect();
            format!("no programs for {name:?}; there are {}", names.join(", "))
        })
    }

    fn name(self) -> &'static str {
        Self::ALL.iter().find(|(_, maker)| *maker == self).map_or("", |(name, _)| name)
    }
}

/// The program; it has to be read and run slowly by a person first.
pub fn program(maker: Maker, route: &Route) -> String {
    let Ok(notation) = Notation::named(maker.name()) else { return String::new() };
    let stops = route.stops();
    let lines = |of: fn(&Stop, &Notation) -> String| -> String {
        stops.iter().map(|stop| of(stop, &notation)).collect()
    };
    match maker {
        Maker::Ur => format!(
            "def calibration_views():\n  # {CHECKED}\n  set_tcp(p[0, 0, 0, 0, 0, 0])\n{}end\n",
            lines(ur)
        ),
        Maker::Kuka => format!(
            "DEF calibration_views()\n  ; {CHECKED}\n  BAS(#INITMOV, 0)\n  BAS(#VEL_PTP, 10)\n  $VEL.CP = 0.1\n  \
             $TOOL = $NULLFRAME\n  $BASE = $NULLFRAME\n{}END\n",
            lines(kuka)
        ),
        Maker::Fanuc => fanuc(&stops, &notation),
        Maker::Abb => format!(
            "MODULE CalibrationViews\n  PROC calibration_views()\n    ! {CHECKED}\n    ConfJ \\Off;\n    ConfL \\Off;\n{}  \
             ENDPROC\nENDMODULE\n",
            lines(abb)
        ),
    }
}

/// What a person has to know who runs it.
const CHECKED: &str =
    "begins where the robot stood in the last capture; check the arm's configuration, run slowly";

fn flange(stop: &Stop, notation: &Notation) -> String {
    text::pose(stop.station.base_from_flange.iso(), notation)
}

/// A line for each view at which the image is taken; on the way there is none.
fn halt(stop: &Stop, line: &str) -> String {
    if stop.is_view { line.replace("{}", &stop.name) } else { String::new() }
}

fn ur(stop: &Stop, notation: &Notation) -> String {
    let motion = match &stop.station.joints {
        Some(joints) => {
            let values: Vec<String> = joints.iter().map(|q| format!("{q:.6}")).collect();
            format!("movej([{}], a=0.5, v=0.25)", values.join(", "))
        }
        None => format!("movel({}, a=0.3, v=0.1)", flange(stop, notation)),
    };
    let halt = halt(stop, "  sleep(1.0)\n  popup(\"{}: take the image\", blocking=True)\n");
    format!("  {motion}\n{halt}")
}

fn kuka(stop: &Stop, notation: &Notation) -> String {
    let motion = if stop.station.joints.is_some() { "PTP" } else { "LIN" };
    let halt = halt(stop, "  HALT ; {}: take the image\n");
    format!("  {motion} {}\n{halt}", flange(stop, notation))
}

fn abb(stop: &Stop, notation: &Notation) -> String {
    let motion = if stop.station.joints.is_some() { "MoveJ" } else { "MoveL" };
    let pose = flange(stop, notation);
    let both = pose.trim_start_matches('[').trim_end_matches(']');
    let halt = halt(stop, "    Stop; ! {}: take the image\n");
    format!(
        "    {motion} [[{both}],[0,0,0,0],[9E9,9E9,9E9,9E9,9E9,9E9]], v100, fine, tool0;\n{halt}"
    )
}

/// Positions stand behind the instructions; the wrist's configuration is that of most poses, and has to be checked.
fn fanuc(stops: &[Stop], notation: &Notation) -> String {
    let mut instructions = vec!["UFRAME_NUM=0 ;".to_owned(), "UTOOL_NUM=0 ;".to_owned()];
    let mut positions = String::new();
    for (k, stop) in (1..).zip(stops) {
        instructions.push(match stop.station.joints {
            Some(_) => format!("J P[{k}] 10% FINE ;"),
            None => format!("L P[{k}] 50mm/sec FINE ;"),
        });
        if stop.is_view {
            instructions.push("PAUSE ;".into());
        }
        let v = notation.values(stop.station.base_from_flange.iso(), notation.own_units());
        positions += &format!(
            "P[{k}:\"{}\"]{{\n   GP1:\n    UF : 0, UT : 0,    CONFIG : 'N U T, 0, 0, 0',\n    X = {:.3} mm,    Y = {:.3} \
             mm,    Z = {:.3} mm,\n    W = {:.4} deg,    P = {:.4} deg,    R = {:.4} deg\n}};\n",
            stop.name, v[0], v[1], v[2], v[3], v[4], v[5]
        );
    }
    let numbered =
        (1..).zip(&instructions).map(|(k, line): (usize, _)| format!("{k:4}:  {line}\n"));
    format!(
        "/PROG  CALVIEWS\n/ATTR\nCOMMENT = \"calibration views\";\n/MN\n{}/POS\n{positions}/END\n",
        numbered.collect::<String>()
    )
}

#[cfg(test)]
mod tests {
    use handeye::{
        Pose,
        nalgebra::{Matrix3, Vector3},
        tools::plan::{NextView, Station},
    };

    use super::*;

    fn station(x: f64, joints: bool) -> Station {
        let base_from_flange = Pose::from_parts(&Matrix3::identity(), Vector3::new(x, 0.0, 0.5));
        Station { base_from_flange, joints: joints.then(|| vec![x; 6]) }
    }

    fn route(joints: bool) -> Route {
        let view = |x: f64, via_start: bool| NextView {
            station: station(x, joints),
            camera_from_target: Pose::identity(),
            via_start,
            before: None,
            after: None,
        };
        Route {
            views: vec![view(0.1, false), view(0.2, true)],
            undetermined: vec![],
            expected: None,
            start: Some(station(0.7, joints)),
            stopped: None,
        }
    }

    #[test]
    fn a_blocked_way_goes_by_the_start_and_takes_no_image_there() {
        let motions = ["movej([0.7", "PTP {x 700.0", "J P[2] 10% FINE", "MoveJ [[700.0"];
        for ((_, maker), detour) in Maker::ALL.into_iter().zip(motions) {
            let text = program(maker, &route(true));
            let lines: Vec<&str> = text.lines().collect();
            let way = lines.iter().position(|line| line.contains(detour)).unwrap();
            let halts = ["popup", "HALT", "PAUSE", "Stop;"];
            let halted = |line: &str| halts.iter().any(|halt| line.contains(halt));
            assert!(halted(lines[way - 1]) && !halted(lines[way + 1]), "{text}");
            assert_eq!(lines.iter().filter(|line| halted(line)).count(), 2, "{text}");
        }
    }

    #[test]
    fn motions_are_straight_where_straight_ways_were_checked() {
        for ((_, maker), motion) in
            Maker::ALL.into_iter().zip(["movel(p[", "LIN {", "L P[1] ", "MoveL [["])
        {
            let text = program(maker, &route(false));
            assert_eq!(
                text.matches(motion).count(),
                if maker == Maker::Fanuc { 1 } else { 3 },
                "{text}"
            );
        }
    }
}
