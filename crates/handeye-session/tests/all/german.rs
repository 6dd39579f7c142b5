//! The page's German of what the session says (`web/src/sentences.ts`): every sentence that a session shows has a template
//! there, and every template consists of words that the sources still have.

use std::{fs, path::Path};

use handeye::{Pose, Setup, nalgebra::Rotation3, nalgebra::Vector3};
use handeye_io::SessionFolder;
use handeye_session::{
    engine::{Command, Destination, Step, shown::State},
    host::Host,
    script::Player,
    sources::{
        mistakes::{Event, Mistake},
        virtual_cell::{Faults, VirtualCell},
    },
};

use crate::new_folder;

/// A sentence of the server with what differs in it, and its German.
struct Template {
    english: String,
    german: String,
    pieces: Vec<Piece>,
}

#[derive(Debug, Clone, PartialEq, Eq, PartialOrd, Ord)]
enum Piece {
    Words(String),
    /// `{name}`: a number or a name.
    Word(String),
    /// `{name*}`: text that is translated itself.
    Text(String),
    /// `{name~}`: text that stays.
    Kept(String),
}

fn pieces(text: &str) -> Vec<Piece> {
    let words = |text: &str| (!text.is_empty()).then(|| Piece::Words(text.to_owned()));
    let Some((before, rest)) = text.split_once('{') else {
        return words(text).into_iter().collect();
    };
    let (name, rest) = rest.split_once('}').unwrap();
    let piece = match name.strip_suffix('*').ok_or_else(|| name.strip_suffix('~')) {
        Ok(name) => Piece::Text(name.into()),
        Err(Some(name)) => Piece::Kept(name.into()),
        Err(None) => Piece::Word(name.into()),
    };
    words(before).into_iter().chain([piece]).chain(pieces(rest)).collect()
}

/// The table of the page, the templates with most letters of their own first.
fn templates() -> Vec<Template> {
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("web/src/sentences.ts");
    let text = fs::read_to_string(path).unwrap();
    let (_, table) = text.split_once("export const SERVER_SENTENCES").unwrap();
    let lines = table.lines().map(str::trim).filter(|line| line.starts_with("[\""));
    let read = |line: &str| -> [String; 2] {
        serde_json::from_str(line.trim_end_matches(',')).unwrap_or_else(|e| panic!("{line}: {e}"))
    };
    let made = |[english, german]: [String; 2]| {
        let pieces = pieces(&plain(&english.replace('|', "")));
        Template { english, german, pieces }
    };
    let mut all: Vec<Template> = lines.map(read).map(made).collect();
    let size = |piece: &Piece| if let Piece::Words(words) = piece { words.len() } else { 0 };
    all.sort_by_key(|t| std::cmp::Reverse(t.pieces.iter().map(size).sum::<usize>()));
    assert!(all.len() > 400, "{} templates are read", all.len());
    all
}

/// Without the capital at the beginning and the full stop at the end.
fn plain(text: &str) -> String {
    let text = text.strip_suffix('.').unwrap_or(text);
    let mut letters = text.chars();
    letters.next().map_or_else(String::new, |first| first.to_lowercase().chain(letters).collect())
}

/// Whether a text is of these pieces; what is to be translated itself is added to `free`.
fn fits<'a>(pieces: &[Piece], text: &'a str, free: &mut Vec<&'a str>) -> bool {
    let Some((first, rest)) = pieces.split_first() else { return text.is_empty() };
    if let Piece::Words(words) = first {
        return text.strip_prefix(&words[..]).is_some_and(|text| fits(rest, text, free));
    }
    let count = free.len();
    for end in text.char_indices().map(|(at, letter)| at + letter.len_utf8()) {
        let (value, after) = text.split_at(end);
        if matches!(first, Piece::Word(_)) && value.ends_with(char::is_whitespace) {
            return false;
        }
        if matches!(first, Piece::Text(_)) {
            free.push(value);
        }
        if fits(rest, after, free) {
            return true;
        }
        free.truncate(count);
    }
    false
}

/// The texts in it that are to be translated themselves, where there is a template of the whole.
fn whole<'a>(text: &'a str, all: &[Template]) -> Option<Vec<&'a str>> {
    all.iter().find_map(|template| {
        let mut free = vec![];
        fits(&template.pieces, text, &mut free).then_some(free)
    })
}

/// Whether it holds a word of a language: no number, unit, key or name.
fn has_words(text: &str) -> bool {
    let is_key = text.starts_with('[') && text.contains(" = ");
    let words = text.split(|c: char| !c.is_ascii_alphabetic());
    !is_key && words.into_iter().any(|word| word.len() > 3)
}

/// Whether the page has German for all of a text, as a whole or part by part.
fn is_known(text: &str, all: &[Template]) -> bool {
    let text = plain(text.trim());
    if !has_words(&text) {
        return true;
    }
    if let Some(free) = whole(&text, all) {
        return free.iter().all(|part| is_known(part, all));
    }
    let ends = [". ", "? ", "; ", ": ", ", and ", ", or ", ", "];
    let mut cuts: Vec<(usize, usize)> = { ends.iter() }
        .flat_map(|end| {
            text.match_indices(end).map(|(at, end)| (at + usize::from(end == "? "), at + end.len()))
        })
        .collect();
    cuts.sort_unstable();
    let known = |&(end, next): &(usize, usize)| {
        let free = whole(&text[..end], all)?;
        Some(free.iter().all(|part| is_known(part, all)) && is_known(&text[next..], all))
    };
    let with_known = cuts.iter().rev().find_map(known);
    let first = || {
        cuts.first()
            .is_some_and(|&(end, next)| !has_words(&text[..end]) && is_known(&text[next..], all))
    };
    with_known.unwrap_or_else(first)
}

#[test]
fn german_has_the_same_placeholders() {
    for Template { english, german, .. } in templates() {
        let names = |text: &str| {
            let mut names: Vec<Piece> = pieces(text)
                .into_iter()
                .filter(|piece| !matches!(piece, Piece::Words(_)))
                .collect();
            names.sort();
            names.dedup();
            names
        };
        assert_eq!(names(&english), names(&german), "{english}\n{german}");
    }
}

/// All sources in one text, strings as they are printed.
fn sources(folder: &Path) -> String {
    let mut text = String::new();
    for entry in fs::read_dir(folder).unwrap() {
        let path = entry.unwrap().path();
        if path.is_dir() {
            text += &sources(&path);
        } else if path.extension().is_some_and(|ending| ending == "rs") {
            let file = fs::read_to_string(&path).unwrap();
            let code = file.lines().filter(|line| !line.trim_start().starts_with("//"));
            for line in code {
                let line = line.trim_start().replace("\\\"", "\"");
                match line.strip_suffix('\\') {
                    Some(part) => text += part, // the string goes on
                    None => text = text + &line + "\n",
                }
            }
        }
    }
    text
}

/// Shorter words are found anywhere.
const SHORT: usize = 12;

#[test]
fn what_is_translated_is_still_said() {
    let crates = Path::new(env!("CARGO_MANIFEST_DIR")).parent().unwrap();
    let folders = ["handeye", "handeye-io", "handeye-session"];
    let sources: String =
        folders.iter().map(|name| sources(&crates.join(name).join("src"))).collect();
    let all = templates();
    let english =
        all.iter().map(|template| template.english.strip_suffix('.').unwrap_or(&template.english));
    let words =
        english.flat_map(|text| text.split('|').flat_map(pieces)).filter_map(|piece| match piece {
            Piece::Words(words) if words.len() >= SHORT => Some(words),
            _ => None,
        });
    let gone: Vec<String> = words.filter(|words| !sources.contains(&words[..])).collect();
    assert!(gone.is_empty(), "no longer said: {gone:#?}");
}

/// A session, and what it has shown that the page has no German for.
struct Heard<'a> {
    player: Player,
    all: &'a [Template],
    /// How many texts were heard.
    count: usize,
    unknown: Vec<String>,
}

impl<'a> Heard<'a> {
    fn new(root: &Path, (setup, seed): (Setup, u64), faults: Faults, all: &'a [Template]) -> Self {
        let cell = VirtualCell::new(setup, seed, faults).unwrap();
        let folder = SessionFolder::open(root, Some(&cell.settings())).unwrap();
        let mut heard =
            Self { player: Player::new(Host::new(folder), cell), all, count: 0, unknown: vec![] };
        heard.listen();
        heard
    }

    /// Whether the command was obeyed.
    fn command(&mut self, command: Command) -> bool {
        let refused = self.player.command(command).err();
        let is_obeyed = refused.is_none();
        self.hear(refused);
        self.listen();
        is_obeyed
    }

    fn confirm(&mut self) -> bool {
        [Step::Cell, Step::Camera, Step::Robot, Step::Board]
            .into_iter()
            .all(|step| self.command(Command::Confirm { step }))
    }

    /// A capture at the next view, or by hand where the board is not seen there.
    fn take(&mut self, number: usize) {
        let before = self.player.state().captures.len();
        if number == 1 || self.command(Command::Drive { to: Destination::Next }) {
            self.command(Command::Take);
        }
        if self.player.state().captures.len() == before {
            self.player.show_board(number).unwrap();
            self.command(Command::Take);
        }
    }

    fn until_enough(&mut self) {
        for number in 1..30 {
            if self.player.state().progress.is_some_and(|p| p.enough) {
                return;
            }
            self.take(number);
        }
    }

    /// A robot that carries the board touches another one, which views do not leave there.
    fn lay_anew(&mut self, setup: Setup) {
        if setup == BASE {
            self.command(Command::Drive { to: Destination::Placement });
            self.player.pass(3.0);
            self.command(Command::Place);
        }
    }

    fn listen(&mut self) {
        let state = self.player.state();
        self.hear(shown(&state));
    }

    fn hear(&mut self, texts: impl IntoIterator<Item = String>) {
        for text in texts {
            self.count += 1;
            if !self.unknown.contains(&text) && !is_known(&text, self.all) {
                self.unknown.push(text);
            }
        }
    }
}

/// What the page shows of a session's words; findings of the core, which are many, need no German.
fn shown(state: &State) -> Vec<String> {
    let steps = state.steps.iter().filter_map(|step| step.proof.clone());
    let problem = state.problem.iter().flat_map(|p| [p.message.clone(), p.advice.clone()]);
    let devices = [&state.robot.why, &state.camera.why].map(Clone::clone);
    let camera = state.camera.found.iter().chain(&state.camera.missing).cloned();
    let captures = state.captures.iter().filter_map(|capture| capture.reason.clone());
    let refused = state.refused.iter().map(|refused| refused.why.clone());
    let reasons = state.progress.iter().flat_map(|progress| progress.reasons.clone());
    let next = state.next.iter().map(|next| next.reason.clone());
    let of_touches = state.verify.as_ref().and_then(|verify| verify.say_touch.clone());
    let say = std::iter::once(state.say.clone()).chain(of_touches);
    (say.chain(steps).chain(problem).chain(devices).chain(camera))
        .chain(captures)
        .chain(refused)
        .chain(reasons)
        .chain(next)
        .collect()
}

const HAND: Setup = Setup::EyeInHand;
const BASE: Setup = Setup::EyeToHand;

fn finished(heard: Heard, root: &Path) {
    let Heard { player, count, unknown, .. } = heard;
    drop(player);
    fs::remove_dir_all(root).unwrap();
    assert!(
        unknown.is_empty() && count > 20,
        "of {count} texts the page has no German for {unknown:#?}"
    );
}

#[test]
fn a_session_from_nothing_to_the_result_is_heard_in_german() {
    let (all, root) = (templates(), new_folder());
    let mut heard = Heard::new(&root, (HAND, 7), Faults::default(), &all);
    heard.command(Command::Take); // too early
    assert!(heard.confirm());
    heard.until_enough();
    heard.command(Command::Go { step: Step::Verify });
    for _ in 0..3 {
        heard.command(Command::Drive { to: Destination::Next });
        heard.command(Command::Take);
    }
    heard.command(Command::Take); // once more where it stands
    assert!(heard.command(Command::Finish));
    assert!(heard.player.state().say.starts_with("Accepted"));
    finished(heard, &root);
}

#[test]
fn sessions_with_touches_are_heard_in_german() {
    let all = templates();
    for setup in [HAND, BASE] {
        let root = new_folder();
        let mut heard = Heard::new(&root, (setup, 9), Faults::default(), &all);
        assert!(heard.confirm());
        heard.until_enough();
        heard.command(Command::Go { step: Step::Touch });
        heard.command(Command::Drive { to: Destination::Touch });
        if setup == BASE {
            heard.command(Command::Place);
            heard.command(Command::Drive { to: Destination::Placement });
            heard.player.pass(3.0);
            heard.command(Command::Place);
        }
        for _ in 0..4 {
            heard.command(Command::Drive { to: Destination::Touch });
            assert!(heard.command(Command::Touch { corner: None }));
        }
        heard.command(Command::Touch { corner: None }); // where it has touched already
        heard.command(Command::Drive { to: Destination::Touch });
        let there = heard.player.state().touch.unwrap().corner;
        heard.command(Command::Touch { corner: Some((there + 9) % 54) });
        assert!(heard.player.state().say.contains("is rejected as an outlier"));
        let wrong = heard.player.state().touch.unwrap().touches.pop().unwrap().id;
        heard.command(Command::Untouch { id: wrong });
        heard.command(Command::Go { step: Step::Verify });
        heard.lay_anew(setup);
        for _ in 0..2 {
            heard.command(Command::Drive { to: Destination::Touch });
            assert!(heard.command(Command::Touch { corner: None }));
        }
        heard.command(Command::Drive { to: Destination::Next });
        heard.command(Command::Take);
        assert!(heard.player.state().say.contains("by 2 touches"));
        let tip = heard.player.cell().settings().tip_mm.unwrap();
        heard.command(Command::Tip { in_flange_mm: [tip[0] + 3.0, tip[1], tip[2] - 4.0] });
        heard.command(Command::Tip { in_flange_mm: tip });
        heard.lay_anew(setup);
        heard.command(Command::Drive { to: Destination::Touch });
        heard.command(Command::Touch { corner: Some(11) });
        assert!(heard.player.state().say.contains("at corner 11"));
        heard.command(Command::Undo);
        heard.command(Command::Finish);
        finished(heard, &root);
    }
}

#[test]
fn sessions_with_mistakes_are_heard_in_german() {
    let all = templates();
    let knock = Rotation3::new(Vector3::new(0.01, -0.006, 0.0));
    let knocked =
        Event::CameraMoved(Pose::from_parts(knock.matrix(), Vector3::new(0.002, 0.0, 0.001)));
    let euler = Mistake::Notation { written: "kuka", read: "staubli" };
    let mistakes = [
        (HAND, euler),
        (HAND, Mistake::Square(1.05)),
        (BASE, Mistake::OtherSetup),
        (BASE, Mistake::OtherBoard),
    ];
    for (setup, mistake) in mistakes {
        heard_with(&all, setup, Faults { mistake: Some(mistake), ..Faults::default() }, None);
    }
    heard_with(&all, HAND, Faults::default(), Some((6, knocked)));
}

fn heard_with(all: &[Template], setup: Setup, faults: Faults, event: Option<(usize, Event)>) {
    let root = new_folder();
    let mut heard = Heard::new(&root, (setup, 41), faults, all);
    if heard.confirm() {
        for number in 1..=7 {
            if let Some((_, event)) = event.filter(|(at, _)| *at == number) {
                heard.player.cell().happens(&event);
            }
            heard.take(number);
        }
        heard.command(Command::Finish);
    } else {
        heard.count += 20; // it is named at once
    }
    finished(heard, &root);
}
