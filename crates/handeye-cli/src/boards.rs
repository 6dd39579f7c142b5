//! The boards that options of `handeye target` name: a row for each kind.

use clap::{Arg, ArgMatches, Args, Command, FromArgMatches, value_parser};
use handeye::{TargetModel, model::target::AprilTagFamily};

use crate::{args::TargetArgs, failure::Failure};

type Made = Result<TargetModel, Failure>;

/// A kind of board.
struct Row {
    /// Its name in files, and of its option.
    name: &'static str,
    /// What the help calls the option's value.
    value: &'static str,
    help: &'static str,
    by: By,
}

/// What the option's value says.
#[derive(Clone, Copy)]
enum By {
    /// Columns and rows.
    Size(fn(&TargetArgs, u32, u32) -> Made),
    /// Which marker.
    Id(fn(&TargetArgs, u32) -> Made),
}

/// In the order of the help.
const ROWS: [Row; 8] = [
    Row {
        name: "checkerboard",
        value: "CxR",
        help: "Checkerboard of so many INNER corners: columns x rows",
        by: By::Size(|args, columns, rows| {
            let square_mm = needed("square-mm", args.square_mm)?;
            Ok(TargetModel::Checkerboard { columns, rows, square_mm })
        }),
    },
    Row {
        name: "charuco",
        value: "XxY",
        help: "ChArUco board of so many squares: columns x rows",
        by: By::Size(charuco),
    },
    Row {
        name: "aprilgrid",
        value: "XxY",
        help: "Kalibr's grid of so many AprilTags: columns x rows",
        by: By::Size(aprilgrid),
    },
    Row {
        name: "tag-grid",
        value: "XxY",
        help: "OpenCV's grid of so many markers: columns x rows",
        by: By::Size(tag_grid),
    },
    Row {
        name: "tag",
        value: "ID",
        help: "One ArUco or AprilTag marker with this id",
        by: By::Id(|args, id| {
            let dictionary = needed("dictionary", args.dictionary.clone())?;
            Ok(TargetModel::Tag { dictionary, id, size_mm: needed("size-mm", args.size_mm)? })
        }),
    },
    Row {
        name: "circle-grid",
        value: "CxR",
        help: "Grid of so many circles: columns x rows",
        by: By::Size(|args, columns, rows| {
            Ok(TargetModel::CircleGrid { columns, rows, pitch_mm: pitch_mm(args)? })
        }),
    },
    Row {
        name: "asymmetric-circle-grid",
        value: "CxR",
        help: "OpenCV's asymmetric grid: circles in a row x rows",
        by: By::Size(|args, columns, rows| {
            Ok(TargetModel::AsymmetricCircleGrid { columns, rows, pitch_mm: pitch_mm(args)? })
        }),
    },
    Row {
        name: "modified-circle-grid",
        value: "CxR",
        help: "ROS-Industrial's grid with one larger circle: columns x rows",
        by: By::Size(|args, columns, rows| {
            Ok(TargetModel::ModifiedCircleGrid { columns, rows, pitch_mm: pitch_mm(args)? })
        }),
    },
];

fn charuco(args: &TargetArgs, squares_x: u32, squares_y: u32) -> Made {
    Ok(TargetModel::Charuco {
        squares_x,
        squares_y,
        square_mm: needed("square-mm", args.square_mm)?,
        marker_mm: needed("marker-mm", args.marker_mm)?,
        dictionary: needed("dictionary", args.dictionary.clone())?,
        legacy: args.legacy,
        first_id: args.first_id,
    })
}

fn aprilgrid(args: &TargetArgs, tags_x: u32, tags_y: u32) -> Made {
    Ok(TargetModel::Aprilgrid {
        tags_x,
        tags_y,
        tag_mm: needed("tag-mm", args.tag_mm)?,
        spacing: args.spacing,
        family: family(&args.family)?,
        first_id: args.first_id,
        corner_squares: !args.no_corner_squares,
        border_bits: args.border_bits,
    })
}

fn tag_grid(args: &TargetArgs, tags_x: u32, tags_y: u32) -> Made {
    Ok(TargetModel::TagGrid {
        dictionary: needed("dictionary", args.dictionary.clone())?,
        tags_x,
        tags_y,
        tag_mm: needed("tag-mm", args.tag_mm)?,
        gap_mm: needed("gap-mm", args.gap_mm)?,
        first_id: args.first_id,
    })
}

fn family(name: &str) -> Result<AprilTagFamily, Failure> {
    AprilTagFamily::named(name)
        .ok_or_else(|| Failure::Usage(format!("--family {name}: write 16h5, 25h9, 36h10 or 36h11")))
}

fn pitch_mm(args: &TargetArgs) -> Result<f64, Failure> {
    needed("pitch-mm", args.pitch_mm)
}

fn needed<T>(name: &str, value: Option<T>) -> Result<T, Failure> {
    value.ok_or_else(|| Failure::Usage(format!("--{name} is missing")))
}

fn pair(name: &str, text: &str) -> Result<(u32, u32), Failure> {
    let both = text.split_once('x').and_then(|(a, b)| Some((a.parse().ok()?, b.parse().ok()?)));
    both.ok_or_else(|| {
        Failure::Usage(format!("--{name} {text}: write columns x rows without blanks, such as 9x6"))
    })
}

/// All options, in words.
pub fn options() -> String {
    ROWS.map(|row| format!("--{}", row.name)).join(", ")
}

/// The board that one of the options names.
pub struct Board(Option<Chosen>);

enum Chosen {
    Size(&'static str, String, fn(&TargetArgs, u32, u32) -> Made),
    Id(u32, fn(&TargetArgs, u32) -> Made),
}

impl Board {
    /// The board, with the lengths that other options say; `None` where no option names one.
    pub fn target(&self, args: &TargetArgs) -> Option<Made> {
        Some(match self.0.as_ref()? {
            Chosen::Size(name, size, make) => {
                pair(name, size).and_then(|(columns, rows)| make(args, columns, rows))
            }
            Chosen::Id(id, make) => make(args, *id),
        })
    }
}

impl FromArgMatches for Board {
    fn from_arg_matches(matches: &ArgMatches) -> Result<Self, clap::Error> {
        let chosen = |row: &Row| match row.by {
            By::Size(make) => {
                let size = matches.get_one::<String>(row.name)?;
                Some(Chosen::Size(row.name, size.clone(), make))
            }
            By::Id(make) => matches.get_one(row.name).map(|id| Chosen::Id(*id, make)),
        };
        Ok(Self(ROWS.iter().find_map(chosen)))
    }

    fn update_from_arg_matches(&mut self, matches: &ArgMatches) -> Result<(), clap::Error> {
        *self = Self::from_arg_matches(matches)?;
        Ok(())
    }
}

impl Args for Board {
    fn augment_args(command: Command) -> Command {
        command.args(ROWS.iter().map(|row| {
            let option = Arg::new(row.name).long(row.name).value_name(row.value).help(row.help);
            let option = option.group("kind");
            match row.by {
                By::Size(_) => option,
                By::Id(_) => option.value_parser(value_parser!(u32)),
            }
        }))
    }

    fn augment_args_for_update(command: Command) -> Command {
        Self::augment_args(command)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use handeye::model::target::KINDS;

    #[test]
    fn every_kind_that_is_printed_has_an_option() {
        let printed: Vec<&str> =
            KINDS.iter().filter(|kind| kind.is_printed()).map(|kind| kind.name).collect();
        assert_eq!(ROWS.map(|row| row.name).to_vec(), printed);
    }
}
