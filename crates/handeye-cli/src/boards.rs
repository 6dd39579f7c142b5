//! The boards that options of `handeye target` name: one for each kind that is printed.

use clap::{Arg, ArgMatches, Args, Command, FromArgMatches};
use handeye::{
    TargetModel,
    model::target::{AprilTagFamily, KINDS, Kind},
};
use serde_json::{Map, Value, json};

use crate::{args::TargetArgs, failure::Failure};

/// All options, in words.
pub fn options() -> String {
    let all: Vec<String> = printed().map(|kind| format!("--{}", kind.name)).collect();
    all.join(", ")
}

fn printed() -> impl Iterator<Item = &'static Kind> {
    KINDS.iter().filter(|kind| kind.is_printed())
}

/// The kind that one of the options names, and what its value says.
pub struct Board(Option<(&'static Kind, String)>);

impl Board {
    /// The board, with the lengths that other options say; `None` where no option names one.
    pub fn target(&self, args: &TargetArgs) -> Option<Result<TargetModel, Failure>> {
        let (kind, value) = self.0.as_ref()?;
        Some(target(kind, value, args))
    }
}

/// The kind's keys, each from the option that has its name.
fn target(kind: &Kind, value: &str, args: &TargetArgs) -> Result<TargetModel, Failure> {
    let mut said = others(args)?;
    for (key, number) in kind.counts.iter().zip(counts(kind, value)?) {
        said.insert((*key).into(), number.into());
    }
    let mut declared = Map::new();
    for key in keys(kind) {
        let value = said.remove(&key).filter(|value| !value.is_null());
        let missing = || Failure::Usage(format!("--{} is missing", key.replace('_', "-")));
        declared.insert(key.clone(), value.ok_or_else(missing)?);
    }
    declared.insert("kind".into(), kind.name.into());
    serde_json::from_value(declared.into())
        .map_err(|e| Failure::Usage(format!("{}: {e}", kind.name)))
}

/// All keys of a kind, as its example has them.
fn keys(kind: &Kind) -> Vec<String> {
    let example = serde_json::to_value((kind.example)()).unwrap_or_default();
    let keys = example.as_object().into_iter().flat_map(Map::keys);
    keys.filter(|key| *key != "kind").cloned().collect()
}

/// What options say of the boards that need it; null where they say nothing.
fn others(args: &TargetArgs) -> Result<Map<String, Value>, Failure> {
    let wrong = || format!("--family {}: write 16h5, 25h9, 36h10 or 36h11", args.family);
    let family = AprilTagFamily::named(&args.family).ok_or_else(|| Failure::Usage(wrong()))?;
    let all = json!({
        "square_mm": args.square_mm,
        "marker_mm": args.marker_mm,
        "dictionary": args.dictionary,
        "family": family,
        "tag_mm": args.tag_mm,
        "spacing": args.spacing,
        "gap_mm": args.gap_mm,
        "first_id": args.first_id,
        "border_bits": args.border_bits,
        "corner_squares": !args.no_corner_squares,
        "legacy": args.legacy,
        "size_mm": args.size_mm,
        "pitch_mm": args.pitch_mm,
    });
    Ok(all.as_object().cloned().unwrap_or_default())
}

/// The numbers in an option's value: as many as the kind has counts.
fn counts(kind: &Kind, text: &str) -> Result<Vec<u32>, Failure> {
    let numbers: Result<Vec<u32>, _> = text.split('x').map(str::parse).collect();
    let advice = match kind.counts {
        [_] => "write the number of a marker, such as 3",
        _ => "write columns x rows without blanks, such as 9x6",
    };
    numbers
        .ok()
        .filter(|all| all.len() == kind.counts.len())
        .ok_or_else(|| Failure::Usage(format!("--{} {text}: {advice}", kind.name)))
}

impl FromArgMatches for Board {
    fn from_arg_matches(matches: &ArgMatches) -> Result<Self, clap::Error> {
        let chosen =
            |kind: &'static Kind| Some((kind, matches.get_one::<String>(kind.name)?.clone()));
        Ok(Self(printed().find_map(chosen)))
    }

    fn update_from_arg_matches(&mut self, matches: &ArgMatches) -> Result<(), clap::Error> {
        *self = Self::from_arg_matches(matches)?;
        Ok(())
    }
}

impl Args for Board {
    fn augment_args(command: Command) -> Command {
        command.args(printed().map(|kind| {
            let value = if kind.counts.len() == 1 { "ID" } else { "CxR" };
            let option = Arg::new(kind.name).long(kind.name).value_name(value);
            option.help(kind.help).group("kind")
        }))
    }

    fn augment_args_for_update(command: Command) -> Command {
        Self::augment_args(command)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_key_of_a_kind_has_an_option() {
        let command = TargetArgs::augment_args(Command::new("target"));
        let has = |name: &str| command.get_arguments().any(|a| a.get_long() == Some(name));
        for kind in printed() {
            assert!(has(kind.name), "--{}", kind.name);
            for key in keys(kind).iter().filter(|key| !kind.counts.contains(&key.as_str())) {
                let option = key.replace('_', "-");
                assert!(has(&option) || has(&format!("no-{option}")), "--{option}");
            }
        }
    }
}
