//! Sessions with a model of the robot: what is proposed is reached, the folder keeps it, and a wrong one is named.

use std::{
    fs,
    path::{Path, PathBuf},
    sync::Arc,
};

use handeye::{Config, Setup};
use handeye_io::{
    CellSettings, Dataset, SessionFolder, Urdf, calibrate::calibrate_dataset, plan::UrdfOption,
    read_result,
};
use handeye_session::{
    engine::{Command, Step, shown::State},
    host::Host,
    script::{Action, Player},
    sources::virtual_cell::{Faults, VirtualCell},
};

use crate::new_folder;

/// An arm of six joints and 1.6 m reach, with rods as links; `upper` is the length of its upper arm, m.
fn arm(upper: f64) -> String {
    let joint = |n: usize, z: f64, axis: &str| {
        let parent = if n == 1 { "base_link".into() } else { format!("link{}", n - 1) };
        format!(
            "<joint name=\"joint_{n}\" type=\"revolute\"><parent link=\"{parent}\"/><child link=\"link{n}\"/>\
             <origin xyz=\"0 0 {z}\"/><axis xyz=\"{axis}\"/>\
             <limit lower=\"-6.2\" upper=\"6.2\" effort=\"1\" velocity=\"1\"/></joint>\n"
        )
    };
    let rod = |n: usize, length: f64, radius: f64| {
        format!(
            "<link name=\"link{n}\"><collision><origin xyz=\"0 0 {}\"/><geometry>\
             <cylinder radius=\"{radius}\" length=\"{}\"/></geometry></collision></link>\n",
            0.5 * length,
            0.6 * length
        )
    };
    let links = [(2, upper, 0.06), (3, 0.2, 0.05), (4, 0.5, 0.05)];
    let rods: String = links.map(|(n, length, radius)| rod(n, length, radius)).concat();
    let joints = [
        (1, 0.2, "0 0 1"),
        (2, 0.25, "0 1 0"),
        (3, upper, "0 1 0"),
        (4, 0.2, "0 0 1"),
        (5, 0.5, "0 1 0"),
        (6, 0.1, "0 0 1"),
    ];
    let joints: String = joints.map(|(n, z, axis)| joint(n, z, axis)).concat();
    format!(
        "<robot name=\"arm\"><link name=\"base_link\"/><link name=\"base\"/>\n<link name=\"link1\"/><link name=\"link5\"/>\
         <link name=\"link6\"/><link name=\"tool0\"/>\n{rods}{joints}\
         <joint name=\"turned\" type=\"fixed\"><parent link=\"base_link\"/><child link=\"base\"/>\
         <origin rpy=\"0 0 3.141592653589793\"/></joint>\n\
         <joint name=\"end\" type=\"fixed\"><parent link=\"link6\"/><child link=\"tool0\"/><origin xyz=\"0 0 0.05\"/></joint>\
         </robot>\n"
    )
}

fn written(name: &str, text: &str) -> PathBuf {
    let path = new_folder().with_extension(name);
    fs::write(&path, text).unwrap();
    path
}

fn option(file: &Path, base: &str) -> UrdfOption {
    UrdfOption { file: file.into(), base: base.into(), flange: "tool0".into() }
}

/// A session of a robot that is `real`, with the model `given`; a robot without joint values where `real` is `None`.
fn player(root: &Path, real: Option<&UrdfOption>, given: Option<&UrdfOption>) -> Player {
    let cell = VirtualCell::new(Setup::EyeInHand, 4, Faults::default()).unwrap();
    // views are wanted as long as the test goes on
    let settings = CellSettings { tolerance_mm: 0.1, ..cell.settings() };
    let mut folder = SessionFolder::open(root, Some(&settings)).unwrap();
    if let Some(given) = given {
        folder.use_urdf(given).unwrap();
    }
    let cell = match real {
        Some(real) => cell.with_arm(Arc::new(real.read().unwrap())),
        None => cell,
    };
    Player::new(Host::new(folder), cell)
}

fn begin(player: &mut Player) {
    for step in [Step::Cell, Step::Camera, Step::Robot, Step::Board] {
        player.command(Command::Confirm { step }).unwrap();
    }
    player.command(Command::Take).unwrap();
}

fn script(text: &str) -> Vec<Action> {
    serde_json::from_str(text).unwrap()
}

const ONE_MORE: &str = r#"[{"do": "drive", "to": "next"}, {"do": "take"}]"#;

/// The next view is one that the arm reaches within its limits; returns its joint values, rad.
fn assert_reached(state: &State, urdf: &Urdf) -> Vec<f64> {
    let next = state.next.as_ref().unwrap_or_else(|| panic!("{}: {:?}", state.say, state.arm));
    let joints: Vec<f64> =
        next.joints_deg.as_ref().unwrap().iter().map(|deg| deg.to_radians()).collect();
    assert_eq!(joints.len(), 6);
    for (joint, (low, high)) in joints.iter().zip(urdf.limits()) {
        assert!((low..=high).contains(&joint), "{joints:?}");
    }
    let there = urdf.arm().base_from_flange(&joints);
    assert!(there.distance_to(&next.base_from_flange) < 1e-6, "{there:?}");
    // and it is drawn there
    let drawn =
        state.arm.as_ref().unwrap().next_points.as_ref().unwrap().last().unwrap().to_owned();
    let at = next.base_from_flange.translation();
    assert!((0..3).all(|k| (drawn[k] - at[k]).abs() < 1e-4), "{drawn:?} {at}");
    joints
}

#[test]
fn proposed_views_are_reached_and_the_folder_keeps_the_model() {
    let (root, file) = (new_folder(), written("urdf", &arm(0.6)));
    let given = option(&file, "base_link");
    let urdf = given.read().unwrap();
    let mut session = player(&root, Some(&given), Some(&given));
    begin(&mut session);
    let mut farthest = 0.0f64;
    for _ in 0..7 {
        let state = session.state();
        let now = state.robot.joints_deg.clone().unwrap();
        let there = assert_reached(&state, &urdf);
        let way = now.iter().zip(&there).map(|(now, there)| (now.to_radians() - there).abs());
        farthest = way.fold(farthest, f64::max);
        session.play(&script(ONE_MORE)).unwrap();
    }
    println!("the longest way of a joint is {:.0} degrees", farthest.to_degrees());
    let state = session.state();
    assert!(state.captures.len() == 8 && state.problem.is_none(), "{:?}", state.problem);
    assert!(state.arm.as_ref().unwrap().measured);
    session.command(Command::Finish).unwrap();

    // the folder is a dataset whose captures have joint values
    fs::remove_file(&file).unwrap();
    let dataset = Dataset::open(&root).unwrap();
    assert!(dataset.urdf.is_some() && dataset.captures.iter().all(|c| c.joints.len() == 6));
    let apart = dataset
        .captures
        .iter()
        .map(|c| urdf.arm().base_from_flange(&c.joints).distance_to(&c.base_from_flange));
    assert!(apart.fold(0.0, f64::max) < 1e-7);
    let result = read_result(&root.join("result/calibration.json")).unwrap();
    let (again, _) = calibrate_dataset(&dataset, &Config::default(), &|_, _| {}).unwrap();
    assert_eq!(again.run_id, result.run_id);
    assert!(result.findings.iter().all(|f| f.code != "joints-and-poses-differ"));

    // it goes on with the model
    let before = fs::read(root.join("handeye.toml")).unwrap();
    drop(session);
    let session = player(&root, Some(&option(&root.join("robot/robot.urdf"), "base_link")), None);
    let state = session.state();
    assert!(state.arm.as_ref().unwrap().points.is_some() && state.captures.len() == 8);
    assert_eq!(fs::read(root.join("handeye.toml")).unwrap(), before);
    drop(session);
    fs::remove_dir_all(root).unwrap();
}

#[test]
fn without_joint_values_the_model_serves_for_the_next_views() {
    let (root, file) = (new_folder(), written("urdf", &arm(0.6)));
    let given = option(&file, "base_link");
    let urdf = given.read().unwrap();
    let mut session = player(&root, None, Some(&given));
    begin(&mut session);
    for _ in 0..3 {
        let state = session.state();
        let arm = state.arm.as_ref().unwrap();
        assert!(!arm.measured && arm.points.as_ref().unwrap().len() == 8, "{arm:?}");
        assert!(state.robot.joints_deg.is_none());
        assert_reached(&state, &urdf);
        session.play(&script(ONE_MORE)).unwrap();
    }
    // a capture's view is reached again, in the branch of now
    session.command(Command::Retake { id: "002".into() }).unwrap();
    assert_reached(&session.state(), &urdf);
    let dataset = Dataset::open(&root).unwrap();
    assert!(dataset.urdf.is_some() && dataset.captures.iter().all(|c| c.joints.is_empty()));
    assert!(dataset.warnings.is_empty(), "{:?}", dataset.warnings);
    drop(session);
    fs::remove_dir_all(root).unwrap();
    fs::remove_file(file).unwrap();
}

#[test]
fn a_wrong_model_is_named_at_the_step_robot() {
    let (real, other) = (written("urdf", &arm(0.6)), written("urdf", &arm(0.5)));
    let real = option(&real, "base");
    // by another arm, by other links, by another number of joints
    let fewer = UrdfOption { flange: "link5".into(), ..real.clone() };
    for (given, said) in [
        (option(&other, "base"), "give the URDF of this robot (--urdf)"),
        (option(&real.file, "base_link"), "give --base-link base --flange-link tool0"),
        (fewer, "the robot gives 6 joint values, its model (URDF) has 5 joints"),
    ] {
        let root = new_folder();
        let mut session = player(&root, Some(&real), Some(&given));
        for step in [Step::Cell, Step::Camera] {
            session.command(Command::Confirm { step }).unwrap();
        }
        let refused = session.command(Command::Confirm { step: Step::Robot }).unwrap_err();
        assert!(refused.contains(said), "{refused}");
        let state = session.state();
        assert_eq!(state.problem.unwrap().code, "arm-contradicts");
        assert!(state.say.contains("its model (URDF)"), "{}", state.say);
        drop(session);
        // with the right one it goes on
        let mut session = player(&root, Some(&real), Some(&real));
        begin(&mut session);
        assert_eq!(session.state().captures.len(), 1);
        drop(session);
        fs::remove_dir_all(root).unwrap();
    }
    fs::remove_file(real.file).unwrap();
    fs::remove_file(other).unwrap();
}

#[test]
fn a_model_that_does_not_reach_the_poses_is_named() {
    let small = arm(0.6).replace("0 0 0.5\"", "0 0 0.05\"").replace("0 0 0.6\"", "0 0 0.06\"");
    let (root, file) = (new_folder(), written("urdf", &small));
    let mut session = player(&root, None, Some(&option(&file, "base_link")));
    let problem = session.state().problem.unwrap();
    assert_eq!(problem.code, "arm-does-not-reach");
    // captures are taken nevertheless, and views are proposed near them
    begin(&mut session);
    let state = session.state();
    assert!(state.next.is_some_and(|next| next.joints_deg.is_none()), "{}", state.say);
    drop(session);
    fs::remove_dir_all(root).unwrap();
    fs::remove_file(file).unwrap();
}

#[test]
fn what_is_no_model_is_refused_and_meshes_come_along() {
    let root = new_folder();
    let cell = VirtualCell::new(Setup::EyeInHand, 7, Faults::default()).unwrap();
    let mut folder = SessionFolder::open(&root, Some(&cell.settings())).unwrap();
    let file = written("urdf", &arm(0.6));
    let wrong = folder.use_urdf(&option(&file, "base_lnk")).unwrap_err().to_string();
    assert!(wrong.contains("there is no link base_lnk; did you mean base_link?"), "{wrong}");
    assert!(folder.urdf().is_none() && !root.join("robot").exists());

    let given = new_folder();
    fs::create_dir_all(given.join("meshes")).unwrap();
    fs::write(given.join("meshes/link.stl"), "solid link\nendsolid link\n").unwrap();
    let mesh = "<link name=\"link5\"><collision><geometry><mesh filename=\"package://our_arm/meshes/link.stl\"/></geometry>\
                </collision></link>";
    let text = arm(0.6).replace("<link name=\"link5\"/>", mesh);
    fs::write(given.join("arm.urdf"), &text).unwrap();
    folder.use_urdf(&option(&given.join("arm.urdf"), "base_link")).unwrap();
    assert!(root.join("robot/our_arm/meshes/link.stl").is_file());
    assert_eq!(fs::read_to_string(root.join("robot/robot.urdf")).unwrap(), text);
    drop(folder);
    for gone in [root, given] {
        fs::remove_dir_all(gone).unwrap();
    }
    fs::remove_file(file).unwrap();
}
