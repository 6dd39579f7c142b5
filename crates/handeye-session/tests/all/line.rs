//! A robot's program at a socket: it is told what each capture was worth, and where to go.

use std::{
    fs,
    io::{BufRead, BufReader, Write},
    net::{SocketAddr, TcpListener, TcpStream},
    path::PathBuf,
    thread,
    time::{Duration, Instant},
};

use handeye::Setup;
use handeye_io::{CellSettings, SessionFolder, Writing, simulated};
use handeye_session::{
    engine::{Command, Step},
    host::Host,
    live::{Camera, Cell, Live},
    server::line,
    sources::virtual_cell::{Faults, VirtualCell},
};

use crate::new_folder;

/// Longer than any image takes.
const PATIENCE: Duration = Duration::from_secs(120);

/// A cell whose images a command takes, and whose robot speaks.
pub struct Bench {
    pub cell: VirtualCell,
    live: Live,
    pub root: PathBuf,
    pub address: SocketAddr,
    now: f64,
}

impl Bench {
    fn new() -> Self {
        Self::of("kuka")
    }

    pub fn of(notation: &str) -> Self {
        let root = new_folder();
        fs::create_dir_all(&root).unwrap();
        let cell = VirtualCell::new(Setup::EyeInHand, 2, Faults::default()).unwrap();
        let settings = CellSettings { notation: notation.into(), ..cell.settings() };
        let folder = SessionFolder::open(&root.join("cell"), Some(&settings)).unwrap();
        let command = format!("cp {} {{out}}", root.join("now.png").display());
        let live = Live::begin(Host::new(folder), Cell::Hand(Camera::Command(command)));
        let listener = TcpListener::bind("127.0.0.1:0").unwrap();
        let address = listener.local_addr().unwrap();
        line::listen(live.clone(), listener).unwrap();
        Self { cell, live, root, address, now: 0.0 }
    }

    /// The image that the camera would take now.
    pub fn expose(&self) {
        let png = simulated::picture(&self.cell.image(self.now, 1));
        fs::write(self.root.join("now.png"), png).unwrap();
    }

    /// Confirms all steps before the captures.
    pub fn confirm(&self) {
        for step in [Step::Cell, Step::Camera, Step::Robot, Step::Board] {
            // the image was not taken yet: that is what the steps wait for
            if step == Step::Camera {
                self.live.command_blocking(Command::Grab).unwrap();
                let seen = |json: &str| json.contains("\"found\":\"54 of 54 corners\"");
                let begin = Instant::now();
                while !seen(&self.live.shown().borrow().json) {
                    assert!(begin.elapsed() < PATIENCE, "no image comes");
                    thread::sleep(Duration::from_millis(20));
                }
            }
            self.live.command_blocking(Command::Confirm { step }).unwrap();
        }
    }

    fn drive(&mut self, numbers: &[f64]) {
        let text = numbers.iter().map(f64::to_string).collect::<Vec<_>>().join(" ");
        self.cell.drive(Writing::of("kuka").unwrap().typed(&text).unwrap(), self.now);
        self.now += 20.0;
        self.expose();
    }

    fn pose(&self) -> String {
        let reported = self.cell.sample(self.now).base_from_flange;
        let numbers = Writing::of("kuka").unwrap().numbers(&reported);
        let numbers = numbers.iter().map(|x| format!("{x:.4}"));
        format!("pose {}", numbers.collect::<Vec<_>>().join(" "))
    }
}

impl Drop for Bench {
    fn drop(&mut self) {
        fs::remove_dir_all(&self.root).ok();
    }
}

struct Robot {
    stream: TcpStream,
    lines: BufReader<TcpStream>,
}

impl Robot {
    fn connect(bench: &Bench) -> Self {
        let stream = TcpStream::connect(bench.address).unwrap();
        let lines = BufReader::new(stream.try_clone().unwrap());
        Self { stream, lines }
    }

    fn hears(&mut self) -> String {
        let mut line = String::new();
        self.lines.read_line(&mut line).unwrap();
        line.trim().to_owned()
    }

    fn says(&mut self, line: &str) -> String {
        self.stream.write_all(format!("{line}\r\n").as_bytes()).unwrap();
        self.hears()
    }
}

#[test]
fn a_robots_program_is_led_to_the_end() {
    let mut bench = Bench::new();
    bench.expose();
    let mut robot = Robot::connect(&bench);
    assert_eq!(robot.says("hello"), "ok handeye kuka");
    assert!(robot.says(&bench.pose()).contains("`capture`"));
    bench.confirm();
    let mut said = robot.says(&bench.pose());
    for _ in 0..30 {
        if said.starts_with("enough") {
            break;
        }
        let mut words = said.split_whitespace();
        assert_eq!(words.next(), Some("ok"), "{said}");
        let numbers: Vec<f64> = words.filter_map(|w| w.parse().ok()).collect();
        bench.drive(&numbers[numbers.len() - 6..]);
        said = robot.says(&bench.pose());
    }
    assert!(said.starts_with("enough"), "{said}");
    assert_eq!(robot.says("next"), "enough");
}

#[test]
fn garbage_half_lines_and_second_robots_get_an_answer_or_nothing() {
    let bench = Bench::new();
    let mut robot = Robot::connect(&bench);
    for (line, answer) in [
        ("fly me to the moon", "error the lines are"),
        ("pose 1 2 3", "error 3 numbers"),
        ("pose", "error"),
        ("pose X 1 Y 2 Z 3 W 4 P 5 R 6", "error the names"),
        ("", "error the lines are"),
        ("\u{0}\u{7}", "error the lines are"),
        ("next", "none"),
        ("HELLO", "ok handeye kuka"),
    ] {
        let said = robot.says(line);
        assert!(said.starts_with(answer), "{line:?}: {said}");
    }
    let mut second = Robot::connect(&bench);
    assert_eq!(second.hears(), "error another robot is connected");
    robot.stream.write_all(&[b'x'; 5000]).unwrap();
    assert_eq!(robot.hears(), "error a line of more than 1024 bytes");
    drop((robot, second));
    // it may come back, and half a line asks for nothing
    for _ in 0..20 {
        let mut stream = TcpStream::connect(bench.address).unwrap();
        stream.write_all(b"pose 1 2").unwrap();
    }
    let again = (0..200).any(|_| {
        thread::sleep(Duration::from_millis(20));
        let mut robot = Robot::connect(&bench);
        robot.stream.write_all(b"hello\n").unwrap();
        robot.hears() == "ok handeye kuka"
    });
    assert!(again);
}
