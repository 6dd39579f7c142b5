//! Poses of a robot of Universal Robots, from a simulated controller, and through everything that goes wrong.

use std::{
    process::Command,
    sync::mpsc::{self, Receiver, RecvTimeoutError},
    thread,
    time::{Duration, Instant},
};

use handeye::{
    TargetModel,
    nalgebra::{Isometry3, Vector3},
};
use handeye_session::{
    engine::{Input, Problem, rest::RobotSample},
    sources::{
        outlet::{Outlet, Wanted},
        ur_rtde::{self, UrRobot},
    },
};

use crate::ur_simulator::{ARM, Arm, End, GOOD, Manner, Simulator};

/// So long is waited for what must come, on a machine however slow.
const PATIENCE: Duration = Duration::from_secs(120);
/// Silence of a robot that is never silent.
const LONG: Duration = Duration::from_secs(60);
/// Silence of one that is.
const SHORT: Duration = Duration::from_millis(100);

struct Listener(Receiver<Input>);

impl Listener {
    fn follow(port: u16, silence: Duration) -> Self {
        let (to, inputs) = mpsc::channel();
        let target = TargetModel::Checkerboard { columns: 9, rows: 6, square_mm: 30.0 };
        let wanted = Wanted { target, intrinsics: None, scans: None };
        let outlet = Outlet::new(to, wanted, tokio::sync::watch::channel(0).0);
        let pause = Duration::from_millis(1);
        ur_rtde::stream(UrRobot { pause, silence, ..UrRobot::new("127.0.0.1", port) }, outlet);
        Self(inputs)
    }

    fn next(&self) -> Input {
        self.0.recv_timeout(PATIENCE).unwrap()
    }

    /// The next problem.
    fn trouble(&self) -> Problem {
        loop {
            if let Input::Trouble(problem) = self.next() {
                return problem;
            }
        }
    }

    /// The next pose of this arm, and the problems before it.
    fn pose(&self, arm: &Arm) -> (RobotSample, Vec<Problem>) {
        let mut problems = vec![];
        loop {
            match self.next() {
                Input::Robot(sample) if is_of(&sample, arm) => return (sample, problems),
                Input::Trouble(problem) => problems.push(problem),
                _ => {}
            }
        }
    }
}

fn isometry([x, y, z, rx, ry, rz]: [f64; 6]) -> Isometry3<f64> {
    Isometry3::new(Vector3::new(x, y, z), Vector3::new(rx, ry, rz))
}

/// Whether it is of this arm: the flange, with the tool put on, has the tool where the controller says.
fn is_of(sample: &RobotSample, arm: &Arm) -> bool {
    let tcp = sample.base_from_flange.iso() * isometry(arm.tcp_offset);
    let off = (tcp.to_homogeneous() - isometry(arm.tcp_pose).to_homogeneous()).amax();
    off < 1e-12 && sample.joints == arm.joints
}

#[test]
fn poses_are_the_controllers_without_its_tool() {
    for (protocol, split) in [(2, false), (1, false), (2, true), (1, true)] {
        let one_each = !split;
        let simulator = Simulator::start(Manner { protocol, split, one_each, ..GOOD });
        let listener = Listener::follow(simulator.port(), LONG);
        let other = Arm { tcp_offset: [0.0; 6], mode: 5, ..ARM };
        let mut times = vec![];
        for arm in [ARM, other] {
            simulator.manner().arm = arm;
            for _ in 0..3 {
                let (sample, problems) = listener.pose(&arm);
                assert_eq!(problems, []);
                times.push(sample.time_s);
            }
        }
        assert!(times.is_sorted(), "{times:?}");
        // it was asked for nothing but to be read
        assert_eq!(*simulator.asked.lock().unwrap(), b"VvOS");
        simulator.stop();
    }
}

#[test]
fn a_fast_controller_is_read_at_a_rate_that_suffices() {
    let simulator = Simulator::start(Manner { protocol: 1, end: End::Drops(40), ..GOOD });
    let listener = Listener::follow(simulator.port(), LONG);
    let mut count = 0;
    while matches!(listener.next(), Input::Robot(_)) {
        count += 1;
    }
    // 40 values are 0.32 s
    assert!((1..=10).contains(&count), "{count}");
}

#[test]
fn a_controller_that_comes_late_is_said_once_and_found() {
    let simulator = Simulator::start(GOOD);
    let address = simulator.address;
    simulator.stop();
    // nobody is at that port now
    while std::net::TcpListener::bind(address).is_err() {
        thread::sleep(Duration::from_millis(10));
    }
    let listener = Listener::follow(address.port(), LONG);
    let problem = listener.trouble();
    assert_eq!(problem.code, "robot-unreachable");
    assert!(problem.message.contains(&address.to_string()), "{}", problem.message);
    assert!(problem.message.contains("refuses"), "{}", problem.message);
    thread::sleep(Duration::from_millis(100));
    let simulator = loop {
        // whoever connects again and again may for a moment sit at the port itself
        if let Ok(simulator) = Simulator::at(address, GOOD) {
            break simulator;
        }
    };
    // most often nothing more; whoever else had the port in between would have been heard
    let problems = listener.pose(&ARM).1;
    assert!(problems.iter().all(|p| p.code != "robot-unreachable"), "{problems:?}");
    simulator.stop();
}

/// What is wrong is said once, by this name, and over as soon as it is put right.
fn is_said_once(wrong: Manner, silence: Duration, code: &str) -> Problem {
    let simulator = Simulator::start(wrong);
    let listener = Listener::follow(simulator.port(), silence);
    let problem = listener.trouble();
    assert_eq!(problem.code, code, "{}", problem.message);
    assert!(!problem.advice.is_empty());
    // at once, and until it is put right, nothing else is said
    let begin = Instant::now();
    let is_quiet = wrong.end == End::Never;
    while is_quiet && wrong.arm.mode == 7 && simulator.connections.load(ACQUIRE) < 5 {
        assert!(begin.elapsed() < PATIENCE);
        thread::sleep(Duration::from_millis(2));
    }
    if wrong.arm.mode != 7 {
        thread::sleep(SHORT); // values of an arm that is off go on to come
    }
    *simulator.manner() = Manner { arm: Arm { joints: [0.5; 6], ..ARM }, ..GOOD };
    let problems = listener.pose(&Arm { joints: [0.5; 6], ..ARM }).1;
    assert!(!is_quiet || problems.is_empty(), "{problems:?}");
    simulator.stop();
    problem
}

const ACQUIRE: std::sync::atomic::Ordering = std::sync::atomic::Ordering::Acquire;

#[test]
fn what_a_controller_lacks_is_named() {
    let message = |wrong, code| is_said_once(wrong, LONG, code).message;
    let said = message(Manner { missing: &["actual_TCP_pose"], ..GOOD }, "robot-fields");
    assert!(said.contains("software 5.11.6, does not send actual_TCP_pose"), "{said}");
    let missing = &["actual_q", "tcp_offset"];
    let said = message(Manner { missing, protocol: 1, ..GOOD }, "robot-fields");
    assert!(said.contains("does not send actual_q, tcp_offset"), "{said}");
    let said = message(Manner { retyped: "actual_q", ..GOOD }, "robot-fields");
    assert!(said.contains("sends actual_q otherwise than as VECTOR6D"), "{said}");
    let tool = is_said_once(Manner { missing: &["tcp_offset"], ..GOOD }, LONG, "robot-tool");
    assert!(tool.message.contains("does not report its TCP"), "{}", tool.message);
    assert!(tool.advice.contains("set the TCP to zero on the pendant"), "{}", tool.advice);
    let said = message(Manner { starts: false, ..GOOD }, "robot-refused");
    assert!(said.ends_with("poses: no recipe"), "{said}");
    message(Manner { arm: Arm { mode: 3, ..ARM }, ..GOOD }, "robot-off");
}

#[test]
fn what_is_no_rtde_is_named() {
    for bytes in [
        &b"\x00\x02U"[..],
        b"\x00\x00\x00",
        b"HTTP/1.1 400 Bad Request\r\n\r\n",
        b"\x00\x0cU\x01half",
        b"\x00\x04U\x01",
    ] {
        for count in [0, 2] {
            is_said_once(Manner { end: End::Says(count, bytes), ..GOOD }, LONG, "robot-garbled");
        }
    }
    for value in [f64::NAN, f64::INFINITY, 1e30] {
        let mut arm = ARM;
        arm.tcp_pose[2] = value;
        is_said_once(Manner { arm, ..GOOD }, LONG, "robot-garbled");
    }
}

#[test]
fn silence_half_packages_and_clocks_that_stand_are_named() {
    for count in [0, 2] {
        for end in [End::Silent(count), End::Half(count), End::Frozen(count + 1), End::Talks] {
            is_said_once(Manner { end, ..GOOD }, SHORT, "robot-silent");
        }
    }
    // a robot whose clock begins again is no other robot
    is_said_once(Manner { end: End::Drops(3), ..GOOD }, LONG, "robot-lost");
}

/// Threads and memory (kB) of this program, where that can be seen.
fn usage() -> Option<(usize, usize)> {
    let status = std::fs::read_to_string("/proc/self/status").ok()?;
    let number = |name: &str| {
        let line = status.lines().find(|line| line.starts_with(name))?;
        line.split_whitespace().nth(1)?.parse().ok()
    };
    Some((number("Threads:")?, number("VmRSS:")?))
}

#[test]
fn a_thousand_disconnects_are_survived_without_growing() {
    const ALONE: &str = "HANDEYE_TEST_ALONE";
    if std::env::var_os(ALONE).is_none() {
        // in a program of its own: others have threads and memory, too
        let name = "ur_rtde::a_thousand_disconnects_are_survived_without_growing";
        let own = std::env::current_exe().unwrap();
        let run = Command::new(own).args([name, "--exact"]).env(ALONE, "1").output().unwrap();
        let said = String::from_utf8_lossy(&run.stdout);
        assert!(run.status.success() && said.contains("1 passed"), "{said}");
        return;
    }
    let interval = Duration::from_micros(1);
    let simulator = Simulator::start(Manner { end: End::Drops(1), interval, ..GOOD });
    let listener = Listener::follow(simulator.port(), LONG);
    let mut early = None;
    for count in 0..1000 {
        let (_, problems) = listener.pose(&ARM);
        // each is an outage of its own
        let codes: Vec<&str> = problems.iter().map(|p| &p.code[..]).collect();
        assert_eq!(codes, if count == 0 { vec![] } else { vec!["robot-lost"] });
        if count == 100 {
            early = usage();
        }
    }
    simulator.manner().end = End::Never;
    listener.pose(&ARM);
    assert!(simulator.connections.load(ACQUIRE) >= 1000);
    if let (Some((threads, memory)), Some((later, more))) = (early, usage()) {
        // of the simulator a thread or two may still be ending
        assert!(later <= threads + 4, "{threads} threads, then {later}");
        assert!(more < memory + 4096, "{memory} kB, then {more} kB");
    }
}

#[test]
fn random_bytes_neither_break_nor_stop_it() {
    let simulator = Simulator::start(Manner { end: End::Noise, ..GOOD });
    let listener = Listener::follow(simulator.port(), Duration::from_millis(50));
    let begin = Instant::now();
    while simulator.connections.load(ACQUIRE) < 300 {
        assert!(begin.elapsed() < 2 * PATIENCE, "it hangs");
        match listener.0.recv_timeout(SHORT) {
            Ok(Input::Robot(sample)) => {
                assert!(sample.base_from_flange.is_finite());
                assert!(sample.joints.iter().all(|q| q.is_finite()));
            }
            Ok(Input::Trouble(problem)) => assert!(problem.code.starts_with("robot-")),
            Ok(Input::Clock(_)) => {} // asks whether anybody listens
            Ok(other) => panic!("{other:?}"),
            Err(RecvTimeoutError::Timeout) => {}
            Err(gone) => panic!("{gone}"),
        }
    }
    let arm = Arm { joints: [0.25; 6], ..ARM };
    *simulator.manner() = Manner { arm, ..GOOD };
    listener.pose(&arm);
    simulator.stop();
}

#[test]
fn hosts_and_ports_are_read() {
    for (text, host, port) in [
        ("192.168.1.5", "192.168.1.5", 30004),
        ("ur5:40004", "ur5", 40004),
        ("::1", "::1", 30004),
        ("[fe80::1]:4", "fe80::1", 4),
        ("[::1]", "::1", 30004),
    ] {
        assert_eq!(text.parse(), Ok(UrRobot::new(host, port)), "{text}");
    }
    for text in ["", ":30004", "ur5:", "ur5:0", "ur5:65536", "ur5:x", "[::1", "[::1]x", "a b"] {
        assert!(text.parse::<UrRobot>().is_err(), "{text}");
    }
}
