//! Targets in a file of their own, or in a manifest.

use std::{fmt, path::Path};

use handeye::{TargetModel, TargetSize, model::target::KINDS};
use serde::{
    Deserialize, Deserializer, Serialize, Serializer,
    de::{
        DeserializeSeed, Error as _, IntoDeserializer, MapAccess, SeqAccess, Visitor,
        value::{MapAccessDeserializer, MapDeserializer},
    },
};

use crate::{
    error::{Error, Place, malformed},
    files,
};

/// One of several targets in a file.
#[derive(Debug, Clone, PartialEq)]
pub struct NamedTarget {
    /// What the file calls it.
    pub name: String,
    /// The target.
    pub model: TargetModel,
    /// How well its size is known.
    pub size: TargetSize,
}

/// What stands under `target`: one, or a list of them, each with a name.
#[derive(Debug, Clone, PartialEq)]
pub enum Targets {
    /// `[target]`
    One(TargetModel, TargetSize),
    /// `[[target]]`
    Several(Vec<NamedTarget>),
}

impl Targets {
    /// The target of this name, or the only one.
    ///
    /// # Errors
    /// What is wrong, and what to do, where there is not just one of that name.
    pub fn pick(&self, name: Option<&str>) -> Result<&TargetModel, (String, String)> {
        self.pick_with_size(name).map(|(model, _)| model)
    }

    /// The same, and how well its size is known.
    ///
    /// # Errors
    /// As [`Self::pick`].
    pub fn pick_with_size(
        &self,
        name: Option<&str>,
    ) -> Result<(&TargetModel, TargetSize), (String, String)> {
        let (targets, name) = match (self, name) {
            (Self::One(model, size), None) => return Ok((model, *size)),
            (Self::One(..), Some(name)) => {
                let what = format!("is {name:?}, but the only target has no name");
                return Err((what, "leave it out".into()));
            }
            (Self::Several(targets), name) => (targets, name),
        };
        let names: Vec<&str> = targets.iter().map(|t| t.name.as_str()).collect();
        let advice = format!("name one of {}", names.join(", "));
        match name {
            Some(name) => targets
                .iter()
                .find(|t| t.name == name)
                .map(|t| (&t.model, t.size))
                .ok_or_else(|| (format!("is {name:?}, and no target has that name"), advice)),
            None if targets.len() == 1 => Ok((&targets[0].model, targets[0].size)),
            None => Err((format!("is missing, with {} targets", targets.len()), advice)),
        }
    }

    /// All of them.
    pub fn models(&self) -> Vec<&TargetModel> {
        match self {
            Self::One(model, _) => vec![model],
            Self::Several(targets) => targets.iter().map(|t| &t.model).collect(),
        }
    }

    /// What the `k`-th is called, where there are several.
    pub fn name(&self, k: usize) -> Option<&str> {
        match self {
            Self::One(..) => None,
            Self::Several(targets) => targets.get(k).map(|t| t.name.as_str()),
        }
    }

    /// Refuses dimensions that no target has, and targets that cannot be told apart.
    ///
    /// # Errors
    /// What is wrong, and what it should be.
    pub fn check(&self) -> Result<(), handeye::Error> {
        let targets = match self {
            Self::One(model, _) => return model.check(),
            Self::Several(targets) => targets,
        };
        for (k, target) in targets.iter().enumerate() {
            let name = &target.name;
            let invalid = |what: String| Err(handeye::Error::Invalid(what));
            if let Err(error) = target.model.check() {
                return invalid(format!("target {name:?}: {error}"));
            }
            for other in &targets[..k] {
                if other.name == *name {
                    return invalid(format!("two targets are called {name:?}"));
                }
                if let Some(why) = other.model.mistaken_for(&target.model) {
                    return invalid(format!("targets {:?} and {name:?}: {why}", other.name));
                }
            }
        }
        Ok(())
    }
}

impl<'de> Deserialize<'de> for Targets {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        deserializer.deserialize_any(TargetsVisitor)
    }
}

/// The keys of a target as they are written.
#[derive(Serialize)]
struct TargetKeys<'a> {
    name: Option<&'a str>,
    #[serde(flatten)]
    model: &'a TargetModel,
    square_sigma_mm: Option<f64>,
}

impl<'a> TargetKeys<'a> {
    fn of(name: Option<&'a str>, model: &'a TargetModel, size: TargetSize) -> Self {
        let square_sigma_mm = match size {
            TargetSize::Printed => None,
            TargetSize::Measured(share) => Some(share * model.pitch_m() * 1e3),
        };
        Self { name, model, square_sigma_mm }
    }
}

impl Serialize for Targets {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        match self {
            Self::One(model, size) => TargetKeys::of(None, model, *size).serialize(serializer),
            Self::Several(targets) => serializer.collect_seq(
                targets.iter().map(|t| TargetKeys::of(Some(&t.name), &t.model, t.size)),
            ),
        }
    }
}

pub(crate) struct TargetsVisitor;

impl<'de> Visitor<'de> for TargetsVisitor {
    type Value = Targets;

    fn expecting(&self, f: &mut fmt::Formatter) -> fmt::Result {
        f.write_str("a table [target], or tables [[target]] with a name each")
    }

    fn visit_map<A: MapAccess<'de>>(self, map: A) -> Result<Targets, A::Error> {
        let mut size = SizeKeys::default();
        let rest = WithoutSize { map, size: &mut size };
        let model = TargetModel::deserialize(MapAccessDeserializer::new(rest))?;
        let size = size.of(&model).map_err(A::Error::custom)?;
        Ok(Targets::One(model, size))
    }

    fn visit_seq<A: SeqAccess<'de>>(self, mut seq: A) -> Result<Targets, A::Error> {
        let mut targets = vec![];
        while let Some(mut keys) = seq.next_element::<toml::Table>()? {
            let Some(toml::Value::String(name)) = keys.remove("name") else {
                let what = "one of several targets has no name: write name = \"left\" or the like";
                return Err(A::Error::custom(what));
            };
            let in_words =
                |what: &str| A::Error::custom(format!("target {name:?}: {}", what.trim()));
            let one = TargetsVisitor.visit_map(MapDeserializer::new(keys.into_iter()));
            let one = one.map_err(|e: toml::de::Error| in_words(e.message()))?;
            if let Targets::One(model, size) = one {
                targets.push(NamedTarget { name, model, size });
            }
        }
        if targets.is_empty() {
            return Err(A::Error::custom("the list of targets is empty"));
        }
        Ok(Targets::Several(targets))
    }
}

/// Standard deviation of a size that a caliper told, mm over the longest side of the target.
const CALIPER_MM: f64 = 0.03;
/// Least standard deviation of a target's size, as a share: no board is known better.
const LEAST_SIGMA: f64 = 1e-5;

/// The keys beside a target's dimensions that say how well its size is known.
#[derive(Default)]
#[cfg_attr(test, derive(schemars::JsonSchema))]
pub(crate) struct SizeKeys {
    /// Whether the size was measured with a caliper. It is then held to 0.03 mm over the longest side, and data that
    /// say otherwise are reported; a size that was not measured is a prior that the data may move.
    measured: Option<bool>,
    /// Standard deviation of the declared length (of a square, a tag, or the pitch), where it was measured.
    square_sigma_mm: Option<f64>,
}

impl SizeKeys {
    fn of(&self, model: &TargetModel) -> Result<TargetSize, String> {
        let pitch_mm = model.pitch_m() * 1e3;
        if self.measured.or(self.square_sigma_mm.map(|_| true)).is_some() && pitch_mm <= 0.0 {
            return Err("measured and square_sigma_mm belong to targets of a declared size".into());
        }
        match (self.square_sigma_mm, self.measured) {
            (Some(sigma), _) if !(sigma > 0.0 && sigma < 0.5 * pitch_mm) => Err(format!(
                "square_sigma_mm = {sigma} is not the standard deviation of a length of {pitch_mm} mm"
            )),
            (Some(sigma), _) => Ok(TargetSize::Measured((sigma / pitch_mm).max(LEAST_SIGMA))),
            (None, Some(true)) => {
                let longest = model.corners().iter().map(|c| c.vector().norm()).fold(0.0, f64::max);
                let share = CALIPER_MM / (longest * 1e3).max(pitch_mm);
                Ok(TargetSize::Measured(share.max(LEAST_SIGMA)))
            }
            (None, _) => Ok(TargetSize::Printed),
        }
    }
}

/// The keys of a target without those, which are put aside.
struct WithoutSize<'a, A> {
    map: A,
    size: &'a mut SizeKeys,
}

impl<'de, A: MapAccess<'de>> MapAccess<'de> for WithoutSize<'_, A> {
    type Error = A::Error;

    fn next_key_seed<K: DeserializeSeed<'de>>(
        &mut self,
        seed: K,
    ) -> Result<Option<K::Value>, A::Error> {
        while let Some(key) = self.map.next_key::<String>()? {
            match key.as_str() {
                "measured" => self.size.measured = Some(self.map.next_value()?),
                "square_sigma_mm" => self.size.square_sigma_mm = Some(self.map.next_value()?),
                _ => return seed.deserialize(key.into_deserializer()).map(Some),
            }
        }
        Ok(None)
    }

    fn next_value_seed<V: DeserializeSeed<'de>>(&mut self, seed: V) -> Result<V::Value, A::Error> {
        self.map.next_value_seed(seed)
    }
}

#[derive(Serialize, Deserialize)]
struct WithTargets {
    target: Targets,
}

/// The target of a manifest, or of a file with the same keys under `[target]` or at its top.
///
/// # Errors
/// What cannot be read, is no target, or has dimensions that no board has; several targets.
pub fn read_target(path: &Path) -> Result<TargetModel, Error> {
    let targets = read_targets(path)?;
    targets.pick(None).cloned().map_err(|_| {
        let advice = "give a file with one [target]";
        malformed(Place::file(path), "describes several targets, and one is needed", advice)
    })
}

/// The targets of a manifest, or of a file with the same keys: `[target]`, `[[target]]`, or one at its
/// top.
///
/// # Errors
/// What cannot be read, is no target, or has dimensions that no board has; targets that cannot be
/// told apart.
pub fn read_targets(path: &Path) -> Result<Targets, Error> {
    let text = files::text(path)?;
    let refuse = |e: toml::de::Error| {
        let line = e.span().map(|s| 1 + text[..s.start.min(text.len())].matches('\n').count());
        let what = in_words(e.message());
        malformed(Place { line, ..Place::file(path) }, what, advice())
    };
    let table: toml::Table = toml::from_str(&text).map_err(refuse)?;
    let targets = if table.contains_key("target") {
        toml::from_str::<WithTargets>(&text).map_err(refuse)?.target
    } else if table.contains_key("kind") {
        toml::from_str(&text).map_err(refuse)?
    } else {
        return Err(malformed(Place::file(path), "describes no target", advice()));
    };
    targets.check().map_err(|source| Error::Values { place: Place::file(path), source })?;
    Ok(targets)
}

/// What makes a target, with an example.
pub(crate) fn advice() -> String {
    let kinds = KINDS.map(|kind| kind.name);
    format!(
        "write kind = \"{}\" (or {}) and its dimensions under [target], each on a line of its own: of a checkerboard \
         columns = 11, rows = 8 (INNER corners) and square_mm = 30.0; `handeye target` writes them for the boards that \
         it draws",
        kinds[0],
        kinds[1..].join(", ")
    )
}

/// What is wrong with a TOML file, on one line.
pub(crate) fn in_words(message: &str) -> String {
    match message.trim() {
        "missing field `kind`" => "the target's kind is missing".into(),
        other => other.replace('\n', " "),
    }
}

/// The lines of a manifest that describe a target.
pub fn target_toml(target: &TargetModel) -> String {
    let targets = WithTargets { target: Targets::One(target.clone(), TargetSize::Printed) };
    // a flat table of numbers and short names: this cannot fail
    toml::to_string(&targets).unwrap_or_default()
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::fs;

    fn read(name: &str, text: &str) -> Result<TargetModel, String> {
        let folder = std::env::temp_dir().join(format!("handeye-target-{}", std::process::id()));
        fs::create_dir_all(&folder).unwrap();
        let path = folder.join(name);
        fs::write(&path, text).unwrap();
        let target = read_target(&path);
        fs::remove_file(&path).unwrap();
        target.map_err(|e| e.to_string().replace(&format!("{}/", folder.display()), ""))
    }

    #[test]
    fn what_is_written_is_read() {
        let board = TargetModel::Charuco {
            squares_x: 5,
            squares_y: 7,
            square_mm: 30.5,
            marker_mm: 22.0,
            dictionary: "DICT_6X6_250".into(),
            legacy: false,
            first_id: 0,
        };
        assert_eq!(read("written.toml", &target_toml(&board)), Ok(board));
    }

    #[test]
    fn how_well_the_size_is_known_stands_beside_it() {
        let keys = "kind = \"checkerboard\"\ncolumns = 9\nrows = 6\nsquare_mm = 20.0\n";
        let size = |name: &str, more: &str| {
            let targets = several(name, &format!("[target]\n{keys}{more}"))?;
            Ok::<_, String>(targets.pick_with_size(None).unwrap().1)
        };
        assert_eq!(size("printed.toml", ""), Ok(TargetSize::Printed));
        assert_eq!(size("not.toml", "measured = false\n"), Ok(TargetSize::Printed));
        assert_eq!(
            size("sigma.toml", "square_sigma_mm = 0.01\n"),
            Ok(TargetSize::Measured(0.01 / 20.0))
        );
        let Ok(TargetSize::Measured(share)) = size("caliper.toml", "measured = true\n") else {
            panic!("a caliper was used")
        };
        assert!((1e-4..3e-4).contains(&share), "{share}");
        let message = size("zero.toml", "square_sigma_mm = 0\n").unwrap_err();
        assert!(message.contains("square_sigma_mm = 0 is not"), "{message}");
    }

    #[test]
    fn the_keys_stand_at_the_top_or_in_a_manifest() {
        let board = TargetModel::Checkerboard { columns: 9, rows: 6, square_mm: 20.0 };
        let keys = "kind = \"checkerboard\"\ncolumns = 9\nrows = 6\nsquare_mm = 20.0\n";
        assert_eq!(read("top.toml", keys), Ok(board.clone()));
        let manifest = format!("setup = \"eye-in-hand\"\n[target]\n{keys}[robot]\nposes = \"p\"\n");
        assert_eq!(read("manifest.toml", &manifest), Ok(board));
    }

    const LEFT: &str = "[[target]]\nname = \"left\"\nkind = \"tag\"\ndictionary = \"DICT_6X6_250\"\nid = 1\nsize_mm = 40\n";

    fn several(name: &str, text: &str) -> Result<Targets, String> {
        let folder = std::env::temp_dir().join(format!("handeye-targets-{}", std::process::id()));
        fs::create_dir_all(&folder).unwrap();
        let path = folder.join(name);
        fs::write(&path, text).unwrap();
        let targets = read_targets(&path);
        fs::remove_file(&path).unwrap();
        targets.map_err(|e| e.to_string().replace(&format!("{}/", folder.display()), ""))
    }

    #[test]
    fn several_targets_have_names() {
        let right = LEFT.replace("left", "right").replace("id = 1", "id = 2");
        let targets = several("two.toml", &format!("{LEFT}{right}")).unwrap();
        let picked = targets.pick(Some("right")).unwrap();
        assert!(matches!(picked, TargetModel::Tag { id: 2, .. }));
        let (what, advice) = targets.pick(None).unwrap_err();
        assert_eq!((&*what, &*advice), ("is missing, with 2 targets", "name one of left, right"));
        let (what, _) = targets.pick(Some("top")).unwrap_err();
        assert_eq!(what, "is \"top\", and no target has that name");
        assert!(several("one.toml", LEFT).unwrap().pick(None).is_ok());
        let message = read("both.toml", &format!("{LEFT}{right}")).unwrap_err();
        assert!(message.starts_with("both.toml: describes several targets"), "{message}");
    }

    #[test]
    fn lists_of_targets_are_checked() {
        let again = LEFT.replace("left", "right");
        for (name, more, expected) in [
            (
                "same.toml",
                again.as_str(),
                "same.toml: targets \"left\" and \"right\": both have marker 1 of DICT_6X6_250",
            ),
            ("twice.toml", LEFT, "twice.toml: two targets are called \"left\""),
            (
                "nameless.toml",
                "[[target]]\nkind = \"tag\"\n",
                "nameless.toml:1: one of several targets has no name",
            ),
            (
                "key.toml",
                "[[target]]\nname = \"b\"\nkind = \"sphere\"\nradius = 2\n",
                "key.toml:1: target \"b\": unknown field `radius`",
            ),
        ] {
            let message = several(name, &format!("{LEFT}{more}")).unwrap_err();
            assert!(message.starts_with(expected), "{message}");
        }
        assert!(
            several("empty.toml", "target = []").unwrap_err().contains("list of targets is empty")
        );
    }

    #[test]
    fn what_is_no_target_is_refused() {
        for (name, text, expected) in [
            ("none.toml", "setup = 1\n", "none.toml: describes no target; write kind ="),
            ("cut.toml", "kind = \n", "cut.toml:1: "),
            (
                "row.toml",
                "kind = \"checkerboard\"\ncolumns = 9\nrows = 1\nsquare_mm = 20.0",
                "row.toml: target: 9 x 1 inner corners; a board needs at least 2 x 2",
            ),
            ("kind.toml", "[target]\nkind = \"chess\"\n", "kind.toml:2: unknown variant `chess`"),
            (
                "open.toml",
                "[target]\n# kind = \"checkerboard\"\n",
                "open.toml:1: the target's kind is missing; write kind = \"checkerboard\" (or charuco,",
            ),
        ] {
            let message = read(name, text).unwrap_err();
            assert!(message.starts_with(expected), "{message}");
        }
    }
}
