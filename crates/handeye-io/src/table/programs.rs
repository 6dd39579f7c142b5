//! Poses that stand in programs of robots, as they are copied from the controller: KRL (KUKA), RAPID (ABB), TP programs
//! as FANUC prints them (`.ls`), and INFORM (Yaskawa). Everything else in them is passed over.

use std::path::Path;

use super::{Cell, Record};
use crate::error::{Error, Place, malformed};

/// A language of robots' programs.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Language {
    Krl,
    Rapid,
    Fanuc,
    Inform,
}

impl Language {
    /// The language of a program, by what only it has; `None` for any other text.
    pub(crate) fn of(text: &str) -> Option<Self> {
        let krl = ["DECL E6POS", "DECL POS", "DECL FRAME", "DEFDAT"];
        match () {
            () if krl.iter().any(|word| text.contains(word)) => Some(Self::Krl),
            () if text.contains("robtarget") && text.contains(":=") => Some(Self::Rapid),
            () if text.contains("/POS") && text.contains("P[") => Some(Self::Fanuc),
            () if text.contains("//POS") => Some(Self::Inform),
            () => None,
        }
    }

    /// The notation of its poses.
    pub(crate) fn notation(self) -> &'static str {
        match self {
            Self::Krl => "kuka",
            Self::Rapid => "abb",
            Self::Fanuc => "fanuc",
            Self::Inform => "yaskawa",
        }
    }

    /// The poses of a program, each by its name; those that it holds as joint values are passed over.
    pub(super) fn records(self, text: &str, path: &Path) -> Result<Vec<Record>, Error> {
        let found: Vec<Record> = match self {
            Self::Krl => structures(text, path),
            Self::Rapid => targets(text, path),
            Self::Fanuc => positions(text, path),
            Self::Inform => points(text, path),
        };
        if found.is_empty() {
            let what = "holds no pose that the robot can be sent to by X, Y and Z: joint values or pulses alone?";
            return Err(malformed(Place::file(path), what, "store the points as Cartesian poses"));
        }
        Ok(found)
    }
}

/// The numbers that make a pose; what else stands beside them (status, turn, external axes) does not.
const KRL_POSE: [&str; 6] = ["X", "Y", "Z", "A", "B", "C"];
const FANUC_POSE: [&str; 6] = ["X", "Y", "Z", "W", "P", "R"];

/// A record of named numbers, where all of them are there.
fn named(id: &str, wanted: &[&str], values: &[(String, f64)], place: Place) -> Option<Record> {
    let value =
        |name: &&str| values.iter().find(|(key, _)| key.eq_ignore_ascii_case(name)).map(|v| v.1);
    let numbers: Vec<f64> = wanted.iter().map(value).collect::<Option<_>>()?;
    Some(Record {
        cells: numbers.into_iter().map(Cell::Number).collect(),
        names: wanted.iter().map(|name| (*name).into()).collect(),
        by_header: false,
        id: Some(id.into()),
        place,
    })
}

/// `DECL E6POS XP1={X 514.8,Y -20.1,Z 700.0,A 90.0,B 0.0,C 180.0,S 2,T 10}`
fn structures(text: &str, path: &Path) -> Vec<Record> {
    let record = |(k, line): (usize, &str)| {
        let line = line.split(';').next().unwrap_or_default();
        let (before, rest) = line.split_once('{')?;
        let id = before.trim().trim_end_matches('=').split_whitespace().last()?;
        let pair = |part: &str| {
            let (key, value) = part.trim().split_once(char::is_whitespace)?;
            Some((key.to_owned(), value.trim().parse().ok()?))
        };
        let values: Vec<(String, f64)> =
            rest.split('}').next()?.split(',').filter_map(pair).collect();
        named(id, &KRL_POSE, &values, Place::line(path, k + 1))
    };
    text.lines().enumerate().filter_map(record).collect()
}

/// `CONST robtarget p10:=[[500,0,700],[0,0,1,0],[0,0,0,0],[9E9,9E9,9E9,9E9,9E9,9E9]];`
fn targets(text: &str, path: &Path) -> Vec<Record> {
    let record = |(k, line): (usize, &str)| {
        let line = line.split('!').next().unwrap_or_default();
        let (before, value) = line.split_once(":=")?;
        if !before.contains("robtarget") {
            return None;
        }
        let id = before.split_whitespace().last()?;
        let numbers =
            value.split(['[', ']', ',', ';']).map(str::trim).filter(|word| !word.is_empty());
        let numbers: Vec<f64> = numbers.map_while(|word| word.parse().ok()).take(7).collect();
        (numbers.len() == 7).then(|| Record {
            cells: numbers.into_iter().map(Cell::Number).collect(),
            names: vec![],
            by_header: false,
            id: Some(id.into()),
            place: Place::line(path, k + 1),
        })
    };
    text.lines().enumerate().filter_map(record).collect()
}

/// `P[1]{ GP1: UF : 0, UT : 1, CONFIG : 'N U T, 0, 0, 0', X = 500.000 mm, ... R = 0.000 deg };` over several lines.
fn positions(text: &str, path: &Path) -> Vec<Record> {
    let mut all = vec![];
    let mut rest = text;
    while let Some(at) = rest.find("P[") {
        let line = text[..text.len() - rest.len() + at].matches('\n').count() + 1;
        rest = &rest[at + 2..];
        let Some((head, body)) = rest.split_once('{') else { break };
        // a use of the point in the program, not its declaration
        if head.contains(['\n', '}']) {
            continue;
        }
        let id = head.split([']', ':']).next().unwrap_or_default().trim();
        let body = body.split('}').next().unwrap_or_default();
        let first_group = body.split("GP2").next().unwrap_or_default();
        let pair = |part: &str| {
            let (key, value) = part.split_once('=')?;
            let number = value.split_whitespace().next()?.parse().ok()?;
            Some((key.split_whitespace().last()?.to_owned(), number))
        };
        let values: Vec<(String, f64)> = first_group.split(',').filter_map(pair).collect();
        all.extend(named(id, &FANUC_POSE, &values, Place::line(path, line)));
    }
    all
}

/// `C00000=500.000,0.000,700.000,180.0000,0.0000,0.0000` below `///POSTYPE BASE`; pulses are no poses.
fn points(text: &str, path: &Path) -> Vec<Record> {
    let mut are_pulses = true;
    let mut all = vec![];
    for (k, line) in text.lines().enumerate() {
        if let Some(kind) = line.trim().strip_prefix("///POSTYPE") {
            are_pulses = kind.trim() == "PULSE";
        }
        let Some((id, values)) = line.split_once('=').filter(|_| !are_pulses) else { continue };
        let numbers: Option<Vec<f64>> = values.split(',').map(|v| v.trim().parse().ok()).collect();
        let Some(numbers) = numbers.filter(|n| n.len() >= 6) else { continue };
        all.push(Record {
            cells: numbers.into_iter().take(6).map(Cell::Number).collect(),
            names: vec![],
            by_header: false,
            id: Some(id.trim().into()),
            place: Place::line(path, k + 1),
        });
    }
    all
}

#[cfg(test)]
mod tests {
    use super::*;

    const KRL: &str = "&ACCESS RVP\nDEFDAT MESSEN PUBLIC\nDECL E6AXIS XHOME={A1 0.0,A2 -90.0,A3 90.0,A4 0.0,A5 0.0,A6 0.0}\n\
        DECL E6POS XP1={X 514.8,Y -20.1,Z 700.0,A 90.0,B 0.5,C 180.0,S 2,T 10,E1 0.0}\nP[2]={X 1,Y 2,Z 3,A 4,B 5,C 6}\nENDDAT\n";
    const RAPID: &str = "MODULE Cal\n  CONST robtarget p10:=[[514.8,-20.1,700],[0,0.5,0.5,-0.7071],[0,0,0,0],[9E9,9E9,9E9,9E9,9E9,9E9]];\n\
        PROC main()\n MoveL p10,v100,fine,tool0;\nENDPROC\nENDMODULE\n";
    const FANUC: &str = "/PROG CAL\n/MN\n  1:L P[1] 100mm/sec FINE ;\n/POS\nP[1]{\n   GP1:\n\tUF : 0, UT : 1,\t\tCONFIG : 'N U T, 0, 0, 0',\n\
        \tX =   514.800  mm,\tY =   -20.100  mm,\tZ =   700.000  mm,\n\tW =  -180.000 deg,\tP =     0.500 deg,\tR =    90.000 deg\n};\n\
        P[2:\"home\"]{\n   GP1:\n\tJ1= 0.0 deg,\tJ2= 0.0 deg\n};\n/END\n";
    const INFORM: &str = "/JOB\n//NAME CAL\n//POS\n///NPOS 1,0,0,0,0,0\n///POSTYPE PULSE\n///PULSE\nC00000=1,2,3,4,5,6\n\
        ///POSTYPE BASE\n///RECTAN\n///RCONF 0,0,0\nC00001=514.800,-20.100,700.000,180.0000,0.5000,90.0000\n//INST\nNOP\n";

    fn read(text: &str) -> (&'static str, Vec<Record>) {
        let language = Language::of(text).unwrap();
        (language.notation(), language.records(text, Path::new("cal.dat")).unwrap())
    }

    #[test]
    fn poses_of_all_languages_are_found_and_nothing_else() {
        for (text, notation, ids, lines) in [
            (KRL, "kuka", &["XP1", "P[2]"][..], &[4, 5][..]),
            (RAPID, "abb", &["p10"], &[2]),
            (FANUC, "fanuc", &["1"], &[5]),
            (INFORM, "yaskawa", &["C00001"], &[11]),
        ] {
            let (found, records) = read(text);
            assert_eq!(found, notation);
            let own: Vec<&str> = records.iter().filter_map(|r| r.id.as_deref()).collect();
            assert_eq!(own, ids, "{notation}");
            assert_eq!(
                records[0].cells[..3],
                [514.8, -20.1, 700.0].map(Cell::Number),
                "{notation}"
            );
            let places: Vec<Place> =
                lines.iter().map(|line| Place::line(Path::new("cal.dat"), *line)).collect();
            assert_eq!(records.iter().map(|r| r.place.clone()).collect::<Vec<_>>(), places);
        }
    }

    #[test]
    fn a_program_of_joint_values_alone_is_refused() {
        let text = KRL.lines().take(3).collect::<Vec<_>>().join("\n");
        let error = Language::Krl.records(&text, Path::new("cal.dat")).unwrap_err().to_string();
        assert!(error.contains("holds no pose") && error.contains("Cartesian"), "{error}");
        assert_eq!(Language::of("X,Y,Z\n1,2,3\n"), None);
    }
}
