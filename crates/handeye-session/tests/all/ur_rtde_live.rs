//! A session whose poses stream from a robot of Universal Robots, and whose images a command takes.

use std::{
    fs,
    path::Path,
    thread,
    time::{Duration, Instant},
};

use handeye::{Base, Flange, Pose, Setup, Tool, nalgebra::Isometry3};
use handeye_io::{SessionFolder, simulated};
use handeye_session::{
    engine::{Command, Step},
    host::Host,
    live::{Camera, Cell, Live},
    sources::{
        ur_rtde::UrRobot,
        virtual_cell::{Faults, VirtualCell},
    },
};
use serde_json::Value;

use crate::{
    new_folder,
    ur_simulator::{ARM, Arm, End, GOOD, Manner, Simulator},
};

const PATIENCE: Duration = Duration::from_secs(120);

fn state(live: &Live) -> Value {
    serde_json::from_str(&live.shown().borrow().json).unwrap()
}

/// Waits until the state is such, on a machine however slow.
fn wait(live: &Live, what: &str, is_so: impl Fn(&Value) -> bool) -> Value {
    let begin = Instant::now();
    loop {
        let state = state(live);
        if is_so(&state) {
            return state;
        }
        assert!(begin.elapsed() < PATIENCE, "{what}: {state:#}");
        thread::sleep(Duration::from_millis(20));
    }
}

/// What a controller reports whose flange is there.
fn arm_at(base_from_flange: Pose<Base, Flange>) -> Arm {
    let [x, y, z, rx, ry, rz] = ARM.tcp_offset;
    let flange_from_tcp: Pose<Flange, Tool> =
        Pose::claim(Isometry3::new([x, y, z].into(), [rx, ry, rz].into()));
    let base_from_tcp = base_from_flange * flange_from_tcp;
    let (at, turn) = (base_from_tcp.translation(), base_from_tcp.iso().rotation.scaled_axis());
    Arm { tcp_pose: [at.x, at.y, at.z, turn.x, turn.y, turn.z], ..ARM }
}

/// Pose and joints of the first capture in a journal.
fn stored(journal: &Path) -> (Pose<Base, Flange>, Vec<f64>) {
    let text = fs::read_to_string(journal).unwrap();
    let mut lines = text.lines().map(|line| serde_json::from_str::<Value>(line).unwrap());
    let taken = |line: Value| line.as_object()?.values().find(|v| v["joints"].is_array()).cloned();
    let taken = lines.find_map(taken).unwrap();
    let pose = serde_json::from_value(taken["base_from_flange"].clone()).unwrap();
    (pose, serde_json::from_value(taken["joints"].clone()).unwrap())
}

#[test]
fn a_capture_is_of_the_streamed_pose_and_the_image_of_the_command() {
    let root = new_folder();
    fs::create_dir_all(&root).unwrap();
    let cell = VirtualCell::new(Setup::EyeInHand, 2, Faults::default()).unwrap();
    fs::write(root.join("now.png"), simulated::picture(&cell.image(0.0, 1))).unwrap();
    let arm = arm_at(cell.sample(0.0).base_from_flange);
    let simulator = Simulator::start(Manner { arm, interval: Duration::from_millis(40), ..GOOD });
    let folder = SessionFolder::open(&root.join("cell"), Some(&cell.settings())).unwrap();
    let camera = Camera::Command(format!("cp {} {{out}}", root.join("now.png").display()));
    let robot = UrRobot::new("127.0.0.1", simulator.port());
    let live = Live::begin(Host::new(folder), Cell::Ur(robot, camera));

    wait(&live, "a pose comes", |s| s["robot"]["connected"] == true);
    // no pose can be typed beside it
    let typed = live.command_blocking(Command::Pose { text: "1 2 3 4 5 6".into() });
    assert!(typed.unwrap_err().message.contains("poses come from the robot"));
    live.command_blocking(Command::Grab).unwrap();
    wait(&live, "an image comes", |s| s["camera"]["found"] == "54 of 54 corners");
    for step in [Step::Cell, Step::Camera, Step::Robot, Step::Board] {
        let name = serde_json::to_value(step).unwrap();
        wait(&live, "the step is proven", |_| {
            live.command_blocking(Command::Confirm { step }).is_ok()
        });
        wait(&live, "the step is left", |s| s["step"] != name);
    }
    live.command_blocking(Command::Take).unwrap();
    wait(&live, "a capture is stored", |s| s["captures"].as_array().unwrap().len() == 1);

    // an outage is shown, and over with the next pose
    simulator.manner().end = End::Drops(0);
    wait(&live, "the outage is shown", |s| s["problem"]["code"] == "robot-lost");
    simulator.manner().end = End::Never;
    wait(&live, "the outage is over", |s| s["problem"].is_null());

    let (pose, joints) = stored(&root.join("cell/journal.jsonl"));
    let [x, y, z, rx, ry, rz] = arm.tcp_offset;
    let offset = Isometry3::new([x, y, z].into(), [rx, ry, rz].into());
    let [x, y, z, rx, ry, rz] = arm.tcp_pose;
    let flange = Isometry3::new([x, y, z].into(), [rx, ry, rz].into()) * offset.inverse();
    assert!((pose.matrix() - flange.to_homogeneous()).amax() < 1e-12);
    assert_eq!(joints, ARM.joints);
    simulator.stop();
    fs::remove_dir_all(&root).ok();
}

/// Reads the joints and the tool's pose, and prints them.
const READER: &str = r#"
import signal, sys
signal.alarm(60)  # it ends, whatever it waits for
try:
    import rtde_receive
except ImportError as missing:
    print("SKIPPED:", missing)
    sys.exit()
robot = rtde_receive.RTDEReceiveInterface(sys.argv[1], 125.0)
print(*robot.getActualQ(), *robot.getActualTCPPose(), robot.getRobotMode())
robot.disconnect()
"#;

/// The simulated controller is one to a program that others wrote: PyPI's ur_rtde. `HANDEYE_TEST_PYTHON` names the
/// interpreter (default `python3`).
#[test]
#[cfg(target_os = "linux")]
fn a_foreign_client_reads_the_simulated_controller() {
    // it knows one port; other addresses of this machine are free most often
    let Ok(simulator) = Simulator::at("127.0.0.7:30004".parse().unwrap(), GOOD) else {
        println!("SKIPPED: the port of RTDE is taken");
        return;
    };
    let python = std::env::var("HANDEYE_TEST_PYTHON").unwrap_or_else(|_| "python3".into());
    let run = std::process::Command::new(python).args(["-c", READER, "127.0.0.7"]).output();
    let Ok(run) = run else {
        println!("SKIPPED: no python3");
        return;
    };
    simulator.stop();
    let said = String::from_utf8_lossy(&run.stdout);
    if said.starts_with("SKIPPED") {
        println!("{said}");
        return;
    }
    assert!(run.status.success(), "{said}{}", String::from_utf8_lossy(&run.stderr));
    let read: Vec<f64> = said.split_whitespace().map(|word| word.parse().unwrap()).collect();
    assert_eq!(read, [&ARM.joints[..], &ARM.tcp_pose, &[7.0]].concat(), "{said}");
}
