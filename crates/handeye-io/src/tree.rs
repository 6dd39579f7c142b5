//! A JSON or YAML document, as it stands: nested lists and maps in the order of the file.

use std::{collections::HashSet, fmt, path::Path};

use serde::de::{self, Deserialize, Deserializer, MapAccess, SeqAccess, Visitor};

use crate::{
    error::{Error, Place, malformed},
    files,
};

/// A value of a structured document.
#[derive(Debug, Clone, PartialEq)]
pub(crate) enum Tree {
    Null,
    Bool(bool),
    Number(f64),
    Text(String),
    List(Vec<Tree>),
    Map(Vec<(String, Tree)>),
}

impl Tree {
    /// Reads a `.json`, `.yaml`, `.yml`, `.calib`, `.samples` or OpenCV `.xml` file.
    pub(crate) fn read(path: &Path) -> Result<Tree, Error> {
        let text = files::text(path)?;
        match files::extension(path).as_str() {
            "json" => Self::from_json(&text, path),
            "xml" => crate::xml::tree(&text, path),
            _ => Self::from_yaml(&text, path),
        }
    }

    fn from_json(text: &str, path: &Path) -> Result<Tree, Error> {
        serde_json::from_str(text).map_err(|e| {
            malformed(Place::line(path, e.line()), format!("is not JSON: {e}"), "correct the file")
        })
    }

    fn from_yaml(text: &str, path: &Path) -> Result<Tree, Error> {
        // y is a key of points, not a truth value
        let options = serde_saphyr::options! { strict_booleans: true };
        serde_saphyr::from_str_with_options(text, options).map_err(|e| {
            let line = e.location().map(|l| l.line() as usize);
            let what = e.to_string().lines().next().unwrap_or_default().to_string();
            let place = Place { line, ..Place::file(path) };
            malformed(place, format!("is not YAML: {what}"), "correct the file")
        })
    }

    /// The value under a key of a map.
    pub(crate) fn get(&self, key: &str) -> Option<&Tree> {
        match self {
            Tree::Map(entries) => entries.iter().find(|(k, _)| k == key).map(|(_, v)| v),
            _ => None,
        }
    }

    /// The value under the first of several usual names of a key.
    pub(crate) fn any(&self, keys: &[&str]) -> Option<&Tree> {
        keys.iter().find_map(|key| self.get(key))
    }

    /// The number, if it is one.
    pub(crate) fn number(&self) -> Option<f64> {
        match self {
            Tree::Number(x) => Some(*x),
            Tree::Text(text) => text.trim().parse().ok(),
            Tree::List(items) if items.len() == 1 => items[0].number(),
            _ => None,
        }
    }

    /// The text, if it is one.
    pub(crate) fn text(&self) -> Option<&str> {
        match self {
            Tree::Text(text) => Some(text),
            _ => None,
        }
    }

    /// All numbers of nested lists, row by row; of an OpenCV matrix, its `data`. `None` if
    /// something else stands between them.
    pub(crate) fn numbers(&self) -> Option<Vec<f64>> {
        match self {
            Tree::Number(_) | Tree::Text(_) => Some(vec![self.number()?]),
            Tree::List(items) => {
                let mut all = Vec::new();
                for item in items {
                    all.extend(item.numbers()?);
                }
                Some(all)
            }
            Tree::Map(_) => self.any(&["data", "Data"])?.numbers(),
            _ => None,
        }
    }
}

impl<'de> Deserialize<'de> for Tree {
    fn deserialize<D: Deserializer<'de>>(d: D) -> Result<Self, D::Error> {
        d.deserialize_any(Reader)
    }
}

struct Reader;

impl<'de> Visitor<'de> for Reader {
    type Value = Tree;

    fn expecting(&self, f: &mut fmt::Formatter) -> fmt::Result {
        f.write_str("a value")
    }
    fn visit_unit<E>(self) -> Result<Tree, E> {
        Ok(Tree::Null)
    }
    fn visit_none<E>(self) -> Result<Tree, E> {
        Ok(Tree::Null)
    }
    fn visit_some<D: Deserializer<'de>>(self, d: D) -> Result<Tree, D::Error> {
        d.deserialize_any(Reader)
    }
    fn visit_bool<E>(self, value: bool) -> Result<Tree, E> {
        Ok(Tree::Bool(value))
    }
    fn visit_i64<E>(self, value: i64) -> Result<Tree, E> {
        Ok(Tree::Number(value as f64))
    }
    fn visit_u64<E>(self, value: u64) -> Result<Tree, E> {
        Ok(Tree::Number(value as f64))
    }
    fn visit_f64<E>(self, value: f64) -> Result<Tree, E> {
        Ok(Tree::Number(value))
    }
    fn visit_str<E>(self, value: &str) -> Result<Tree, E> {
        Ok(Tree::Text(value.into()))
    }
    fn visit_seq<A: SeqAccess<'de>>(self, mut seq: A) -> Result<Tree, A::Error> {
        let mut items = Vec::new();
        while let Some(item) = seq.next_element()? {
            items.push(item);
        }
        Ok(Tree::List(items))
    }
    fn visit_map<A: MapAccess<'de>>(self, mut map: A) -> Result<Tree, A::Error> {
        let (mut entries, mut seen) = (Vec::new(), HashSet::new());
        while let Some(key) = map.next_key::<String>()? {
            if !seen.insert(key.clone()) {
                return Err(de::Error::custom(format!("the key \"{key}\" appears twice")));
            }
            entries.push((key, map.next_value()?));
        }
        Ok(Tree::Map(entries))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn opencv_yaml_is_read_with_its_odd_directive_and_tags() {
        let text = "%YAML:1.0\n---\ny: 2\n7: 3\nK: !!opencv-matrix\n   rows: 1\n   cols: 2\n   dt: d\n   data: [ 1., 2.5e-1 ]\n";
        let tree = Tree::from_yaml(text, Path::new("a.yml")).unwrap();
        assert_eq!(tree.get("K").and_then(Tree::numbers), Some(vec![1.0, 0.25]), "{tree:?}");
        assert_eq!(tree.get("y").and_then(Tree::number), Some(2.0), "a key, no truth value");
        assert_eq!(tree.get("7").and_then(Tree::number), Some(3.0));
    }

    #[test]
    fn a_key_that_appears_twice_is_refused() {
        let error = Tree::from_json("{\"x\": 1,\n \"x\": 2}", Path::new("a.json")).unwrap_err();
        assert!(
            error.to_string().starts_with("a.json:2: is not JSON: the key \"x\" appears twice")
        );
        assert!(Tree::from_yaml("x: 1\nx: 2\n", Path::new("a.yaml")).is_err());
    }

    #[test]
    fn what_is_not_a_number_is_refused_by_its_line() {
        let error = Tree::from_yaml("- 1\n- .nan\n", Path::new("a.yaml")).unwrap_err();
        assert!(error.to_string().starts_with("a.yaml:2: is not YAML: "), "{error}");
    }
}
