//! Planned views as programs of robots: a motion to each pose of the flange, and a halt in which the image is taken.
//!
//! The poses are of the flange in the base: each program sets the active tool and base to none first. Joint values go into
//! programs of UR only; other makers' joints may turn the other way, or be coupled, where their controllers show them.

use handeye::tools::plan::NextView;

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
pub fn program(maker: Maker, views: &[NextView]) -> String {
    let Ok(notation) = Notation::named(maker.name()) else { return String::new() };
    let pose = |view: &NextView| text::pose(view.station.base_from_flange.iso(), &notation);
    let numbered = || views.iter().enumerate().map(|(k, view)| (k + 1, view));
    match maker {
        Maker::Ur => {
            let lines: String = numbered()
                .map(|(k, view)| {
                    let there = match &view.station.joints {
                        Some(joints) => format!("[{}]", numbers(joints, 6)),
                        None => pose(view),
                    };
                    format!(
                        "  movej({there}, a=0.5, v=0.25)\n  sleep(1.0)\n  popup(\"view {k} of {}: take the image\", \
                         blocking=True)\n",
                        views.len()
                    )
                })
                .collect();
            format!("def calibration_views():\n  set_tcp(p[0, 0, 0, 0, 0, 0])\n{lines}end\n")
        }
        Maker::Kuka => {
            let lines: String = numbered()
                .map(|(k, view)| {
                    format!("  PTP {}\n  HALT ; view {k}: take the image\n", pose(view))
                })
                .collect();
            format!(
                "DEF calibration_views()\n  BAS(#INITMOV, 0)\n  BAS(#VEL_PTP, 10)\n  $TOOL = $NULLFRAME\n  $BASE = $NULLFRAME\n\
                 {lines}END\n"
            )
        }
        Maker::Fanuc => fanuc(views, &notation),
        Maker::Abb => {
            let lines: String = numbered()
                .map(|(k, view)| {
                    let there = pose(view);
                    let both = there.trim_start_matches('[').trim_end_matches(']');
                    format!(
                        "    MoveJ [[{both}],[0,0,0,0],[9E9,9E9,9E9,9E9,9E9,9E9]], v100, fine, tool0;\n    Stop; ! view {k}: \
                         take the image\n"
                    )
                })
                .collect();
            format!(
                "MODULE CalibrationViews\n  PROC calibration_views()\n    ConfJ \\Off;\n{lines}  ENDPROC\nENDMODULE\n"
            )
        }
    }
}

fn numbers(values: &[f64], digits: usize) -> String {
    values.iter().map(|v| format!("{v:.digits$}")).collect::<Vec<_>>().join(", ")
}

/// Positions stand behind the instructions; the wrist's configuration is that of most poses, and has to be checked.
fn fanuc(views: &[NextView], notation: &Notation) -> String {
    let mut motions = String::from("   1:  UFRAME_NUM=0 ;\n   2:  UTOOL_NUM=0 ;\n");
    let mut positions = String::new();
    for (k, view) in views.iter().enumerate() {
        let line = 3 + 2 * k;
        motions += &format!("{line:4}:  J P[{}] 10% FINE ;\n{:4}:  PAUSE ;\n", k + 1, line + 1);
        let v = notation.values(view.station.base_from_flange.iso(), notation.own_units());
        positions += &format!(
            "P[{}]{{\n   GP1:\n    UF : 0, UT : 0,    CONFIG : 'N U T, 0, 0, 0',\n    X = {:.3} mm,    Y = {:.3} mm,    \
             Z = {:.3} mm,\n    W = {:.4} deg,    P = {:.4} deg,    R = {:.4} deg\n}};\n",
            k + 1,
            v[0],
            v[1],
            v[2],
            v[3],
            v[4],
            v[5]
        );
    }
    format!(
        "/PROG  CALVIEWS\n/ATTR\nCOMMENT = \"calibration views\";\n/MN\n{motions}/POS\n{positions}/END\n"
    )
}
