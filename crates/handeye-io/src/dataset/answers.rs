//! Answers put into a first manifest: what a dialogue asks, one question after the other.

use super::draft::QUESTION;

/// A question that waits in a manifest.
#[derive(Debug, Clone, PartialEq)]
pub struct OpenQuestion {
    /// The question, whole.
    pub text: String,
    /// The keys below it.
    pub keys: Vec<OpenKey>,
    /// Its first and last line, with the keys; counted from 0.
    lines: (usize, usize),
}

/// A key that is commented out.
#[derive(Debug, Clone, PartialEq)]
pub struct OpenKey {
    /// Its name.
    pub name: String,
    /// The value that stands there as an example, as TOML.
    pub example: String,
}

impl OpenQuestion {
    /// Words in quotation marks in the question: what its first key may be.
    pub fn choices(&self) -> Vec<&str> {
        let is_text = self.keys.first().is_some_and(|key| key.example.starts_with('"'));
        let mut all = vec![];
        for word in self.text.split('"').skip(1).step_by(2).filter(|_| is_text) {
            if !all.contains(&word) {
                all.push(word);
            }
        }
        all
    }
}

impl OpenKey {
    /// A key of this name, with an example as TOML.
    pub fn new(name: impl Into<String>, example: impl Into<String>) -> Self {
        Self { name: name.into(), example: example.into() }
    }

    /// What a person typed, as TOML: without quotation marks, and with a decimal comma.
    ///
    /// # Errors
    /// What is no such value.
    pub fn value(&self, typed: &str) -> Result<String, String> {
        let typed = typed.trim();
        let is_text = self.example.starts_with('"') && !typed.starts_with(['"', '\'']);
        let value = match is_text {
            true => toml::Value::String(typed.into()).to_string(),
            false if typed.matches(',').count() == 1 && !typed.contains('[') => {
                typed.replace(',', ".")
            }
            false => typed.into(),
        };
        let parsed: Option<toml::Table> = toml::from_str(&format!("value = {value}")).ok();
        let example: Option<toml::Table> =
            toml::from_str(&format!("value = {}", self.example)).ok();
        let (Some(found), Some(wanted)) = (parsed, example) else {
            return Err(format!("{typed} cannot be read; such as {}", self.example));
        };
        let is_number = |v: &toml::Value| v.is_integer() || v.is_float();
        let (found, wanted) = (&found["value"], &wanted["value"]);
        let fits = found.same_type(wanted) || is_number(found) && is_number(wanted);
        if fits {
            Ok(value)
        } else {
            Err(format!("{typed} is no {}; such as {}", wanted.type_str(), self.example))
        }
    }
}

/// The questions that wait in a manifest, in its order.
pub fn open_questions(manifest: &str) -> Vec<OpenQuestion> {
    let lines: Vec<&str> = manifest.lines().collect();
    let mut all: Vec<OpenQuestion> = vec![];
    let mut k = 0;
    while k < lines.len() {
        let Some(first) = lines[k].strip_prefix(QUESTION) else {
            k += 1;
            continue;
        };
        let (begin, mut text) = (k, first.trim().to_owned());
        k += 1;
        while let Some(more) = lines.get(k).and_then(|line| line.strip_prefix("#   ")) {
            text = format!("{text} {}", more.trim());
            k += 1;
        }
        let mut keys = vec![];
        while let Some(key) = lines.get(k).and_then(|line| open_key(line)) {
            keys.push(key);
            k += 1;
        }
        all.push(OpenQuestion { text, keys, lines: (begin, k) });
    }
    all
}

fn open_key(line: &str) -> Option<OpenKey> {
    let (name, value) = line.strip_prefix("# ")?.split_once(" = ")?;
    let is_name = !name.is_empty() && name.bytes().all(|b| b.is_ascii_lowercase() || b == b'_');
    let example = value.split("  # ").next().unwrap_or(value).trim();
    is_name.then(|| OpenKey::new(name, example))
}

/// The manifest with these lines in place of a question and its keys.
pub fn answered_with(manifest: &str, question: &OpenQuestion, lines: &[String]) -> String {
    let (begin, end) = question.lines;
    let mut all: Vec<&str> = manifest.lines().collect();
    all.splice(begin..end, lines.iter().map(String::as_str));
    all.join("\n") + "\n"
}

#[cfg(test)]
mod tests {
    use super::*;

    const MANIFEST: &str = "# QUESTION: does the robot carry the camera (\"eye-in-hand\"), or the\n\
                            #   board (\"eye-to-hand\")?\n# setup = \"eye-in-hand\"\n\n[target]\n\
                            # QUESTION: how long is a square?\n# columns = 11\n# square_mm = 30.0  # measured\n# or this\n";

    #[test]
    fn questions_are_found_with_their_keys_and_choices() {
        let all = open_questions(MANIFEST);
        assert_eq!(all.len(), 2);
        assert_eq!(
            all[0].text,
            "does the robot carry the camera (\"eye-in-hand\"), or the board (\"eye-to-hand\")?"
        );
        assert_eq!(all[0].choices(), ["eye-in-hand", "eye-to-hand"]);
        let keys: Vec<_> =
            all[1].keys.iter().map(|k| (k.name.as_str(), k.example.as_str())).collect();
        assert_eq!(keys, [("columns", "11"), ("square_mm", "30.0")]);
        assert!(all[1].choices().is_empty());
    }

    #[test]
    fn answers_take_the_place_of_their_question() {
        let first = &open_questions(MANIFEST)[0];
        let setup = first.keys[0].value("eye-to-hand").unwrap();
        let text = answered_with(MANIFEST, first, &[format!("setup = {setup}")]);
        assert!(text.starts_with("setup = \"eye-to-hand\"\n\n[target]\n"), "{text}");
        let second = &open_questions(&text)[0];
        let side = second.keys[1].value("24,5").unwrap();
        let text =
            answered_with(&text, second, &["columns = 9".into(), format!("square_mm = {side}")]);
        assert_eq!(
            text,
            "setup = \"eye-to-hand\"\n\n[target]\ncolumns = 9\nsquare_mm = 24.5\n# or this\n"
        );
        assert!(open_questions(&text).is_empty());
    }

    #[test]
    fn values_of_another_kind_are_refused() {
        let key = |example: &str| OpenKey::new("x", example);
        assert_eq!(key("30.0").value("25").unwrap(), "25");
        assert_eq!(key("\"mm\"").value("m").unwrap(), "\"m\"");
        assert_eq!(key("\"mm\"").value("\"m\"").unwrap(), "\"m\"");
        assert_eq!(key("[0.0, 0.0, 150.0]").value("[0, 0, 90.5]").unwrap(), "[0, 0, 90.5]");
        assert_eq!(key("30.0").value("wide").unwrap_err(), "wide cannot be read; such as 30.0");
        assert_eq!(key("30.0").value("true").unwrap_err(), "true is no float; such as 30.0");
    }
}
