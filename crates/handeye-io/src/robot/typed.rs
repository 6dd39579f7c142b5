//! A pose as people type it from a pendant: numbers in a notation's order, or by their names, with points or commas.
//!
//! ```text
//! 612.3 -4.1 233 10 20 -170        X=612,3; Y=-4,1; Z=233; A=10; B=20; C=-170        p[0.612, -0.004, 0.233, 0, 3.14, 0]
//! ```

use super::{Column, Notation};
use crate::table::plain;

/// A number, and the name before it.
#[derive(Debug, Clone, PartialEq)]
struct Named {
    name: String,
    value: f64,
}

impl Notation {
    /// The numbers of a typed pose, in the notation's order; `Err` says what was read instead.
    pub(crate) fn typed(&self, text: &str) -> Result<Vec<f64>, String> {
        let wanted = self.columns.len();
        // commas are decimal where that gives as many numbers as the pose has
        let readings = [true, false].map(|decimal_commas| numbers(text, decimal_commas));
        let [in_commas, in_points] = &readings;
        let has_points = text.contains('.');
        let found = match (in_commas, in_points) {
            (Some(found), _) if found.len() == wanted && !has_points => found,
            (_, Some(found)) => found,
            (Some(found), None) => found,
            (None, None) => {
                return Err(format!("\"{text}\" holds something else than numbers and names"));
            }
        };
        if found.len() != wanted {
            return Err(format!(
                "{} numbers, but a pose of {} has {wanted}: {}",
                found.len(),
                self.name,
                self.order()
            ));
        }
        if found.iter().all(|number| number.name.is_empty()) {
            return Ok(found.iter().map(|number| number.value).collect());
        }
        let of_column = |column: &Column| {
            let is_own = |n: &&Named| column.names.iter().any(|name| plain(name) == plain(&n.name));
            let mut own = found.iter().filter(is_own);
            Some(own.next()?.value).filter(|_| own.next().is_none())
        };
        let values: Option<Vec<f64>> = self.columns.iter().map(of_column).collect();
        values.ok_or_else(|| {
            let names: Vec<&str> = found.iter().map(|n| &n.name[..]).collect();
            format!(
                "the names {} are not those of {}: {}",
                names.join(" "),
                self.name,
                self.order()
            )
        })
    }

    /// The names of the numbers, in order.
    fn order(&self) -> String {
        let names = self.columns.iter().filter_map(|c| c.names.first().copied());
        names.collect::<Vec<_>>().join(" ")
    }
}

/// `None` where something is neither a number nor a name.
fn numbers(text: &str, decimal_commas: bool) -> Option<Vec<Named>> {
    let text = text.trim().trim_start_matches("p[");
    let is_number = |c: char| {
        c.is_ascii_digit() || matches!(c, '.' | '+' | '-') || (decimal_commas && c == ',')
    };
    let mut found = vec![];
    let mut name = String::new();
    let mut rest = text;
    let mut after_number = false;
    while let Some(first) = rest.chars().next() {
        if is_number(first) && (first != ',' || rest[1..].starts_with(|c: char| c.is_ascii_digit()))
        {
            // 1.2.3 is no two numbers
            if after_number && matches!(first, '.' | ',') {
                return None;
            }
            let end = number_end(rest, decimal_commas);
            let value: f64 = rest[..end].replace(',', ".").parse().ok()?;
            found.push(Named { name: std::mem::take(&mut name), value });
            rest = &rest[end..];
            after_number = true;
            continue;
        } else if first.is_alphabetic() {
            let end = rest.find(|c: char| !c.is_alphanumeric() && c != '_').unwrap_or(rest.len());
            // a number may follow its name at once: X612.3
            let letters = rest[..end].find(|c: char| c.is_ascii_digit()).unwrap_or(end);
            let word = &rest[..letters];
            if !matches!(word.to_ascii_lowercase().as_str(), "mm" | "deg" | "rad" | "m") {
                name = word.to_owned();
            }
            rest = &rest[letters..];
        } else if first.is_whitespace() || "=:;,[]{}()|°".contains(first) {
            rest = &rest[first.len_utf8()..];
        } else {
            return None;
        }
        after_number = false;
    }
    (!found.is_empty()).then_some(found)
}

/// Where the number at the beginning ends.
fn number_end(text: &str, decimal_commas: bool) -> usize {
    let bytes = text.as_bytes();
    let digit = |k: usize| bytes.get(k).is_some_and(u8::is_ascii_digit);
    let mut end = usize::from(matches!(bytes[0], b'+' | b'-'));
    let mut has_point = false;
    while end < bytes.len() {
        let is_point =
            bytes[end] == b'.' || (decimal_commas && bytes[end] == b',' && digit(end + 1));
        if is_point && !has_point {
            has_point = true;
        } else if !digit(end) {
            break;
        }
        end += 1;
    }
    // 1e-3
    if end < bytes.len() && matches!(bytes[end], b'e' | b'E') {
        let sign = usize::from(matches!(bytes.get(end + 1), Some(b'+' | b'-')));
        if digit(end + 1 + sign) {
            end += 1 + sign;
            while digit(end) {
                end += 1;
            }
        }
    }
    end.max(1)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn read(notation: &str, text: &str) -> Result<Vec<f64>, String> {
        Notation::named(notation).unwrap().typed(text)
    }

    #[test]
    fn a_pose_is_read_as_people_type_it() {
        let pose = Ok(vec![612.3, -4.1, 233.0, 10.0, 20.0, -170.0]);
        for text in [
            "612.3 -4.1 233 10 20 -170",
            "612.3, -4.1, 233, 10, 20, -170",
            "612,3 -4,1 233 10 20 -170",
            "612,3; -4,1; 233; 10; 20; -170",
            "X 612.3 Y -4.1 Z 233 A 10 B 20 C -170",
            "X=612,3; Y=-4,1; Z=233,0; A=10; B=20; C=-170",
            "{X 612.3,Y -4.1,Z 233.0,A 10.0,B 20.0,C -170.0}",
            "C -170 B 20 A 10 Z 233 mm Y -4.1 X612.3",
        ] {
            assert_eq!(read("kuka", text), pose, "{text}");
        }
        let ur = read("ur", "p[0.6123, -4.1e-3, .233, 0, 3.1, 0]").unwrap();
        assert_eq!(ur, [0.6123, -0.0041, 0.233, 0.0, 3.1, 0.0]);
    }

    #[test]
    fn what_is_no_pose_of_the_notation_is_refused() {
        for (text, said) in [
            ("1 2 3", "3 numbers, but a pose of kuka has 6"),
            ("X 1 Y 2 Z 3 W 4 P 5 R 6", "are not those of kuka"),
            ("X 1 X 2 Z 3 A 4 B 5 C 6", "are not those of kuka"),
            ("1 2 3 4 5 6 7", "7 numbers"),
            ("1,2,3,4,5,6,7", "7 numbers"),
            ("1 -231.777723.728 4 5 6", "something else"),
            ("1,5 -231,777723,728 4 5 6", "numbers"),
            ("", "numbers"),
            ("1 2 3 4 5 $", "something else"),
            ("- - - - - -", "something else"),
            ("ä é 1 2 3 4 5 6 ∞", "something else"),
        ] {
            let message = read("kuka", text).unwrap_err();
            assert!(message.contains(said), "{text}: {message}");
        }
    }
}
