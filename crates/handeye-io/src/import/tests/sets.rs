use super::*;

const POSE: &str = "f 4\nr 0 0 0.5\nt 0.1 0.2 0.3\n";

#[test]
fn folders_of_halcon_are_read_whatever_the_type_of_their_poses() {
    let folder = folder("halcon-set");
    let half = (2.0 * 0.5f64.atan()).to_degrees();
    for k in 0..4 {
        let robot =
            if k == 0 { POSE.into() } else { format!("# gba\nf 0\nr 0 0 {half}\nt 0.1 0.2 0.3\n") };
        fs::write(folder.join(format!("tool_in_base_{k}.dat")), robot).unwrap();
        fs::write(folder.join(format!("obj_in_cam_{k}.dat")), POSE).unwrap();
    }
    fs::write(folder.join("campar.dat"), "ParGroup: Cameras: Internal Parameters;\n").unwrap();
    let imported = import(&folder, &of(Setup::EyeInHand)).unwrap();
    assert!(imported.questions.is_empty(), "{:?}", imported.questions);
    let set = opened(&imported);
    assert_eq!(set.captures.len(), 4);
    let first = *set.captures[0].base_from_flange.iso();
    assert!((first.translation.vector - nalgebra::Vector3::new(0.1, 0.2, 0.3)).norm() < 1e-15);
    for capture in &set.captures {
        assert!((first.inverse() * capture.base_from_flange.iso()).rotation.angle() < 1e-7);
        assert!(capture.camera_from_target.is_some());
    }
    fs::remove_dir_all(folder).ok();
}

#[test]
fn a_direction_that_halcons_names_do_not_say_is_asked() {
    let folder = folder("halcon-asked");
    for k in 0..3 {
        fs::write(folder.join(format!("robot_pose_{k}.dat")), POSE).unwrap();
        fs::write(folder.join(format!("calib_{k}.png")), "").unwrap();
    }
    let asked = import(&folder, &of(Setup::EyeInHand)).unwrap();
    assert!(asked.questions[0].contains("ToolInBasePose"), "{:?}", asked.questions);
    assert!(asked.questions[1].contains("which target"), "{:?}", asked.questions);
    assert!(asked.text.contains("# direction = ") && asked.text.contains("calib_*.png"));
    let inverse = Direction::named("flange_from_base").unwrap();
    let declared = Declared { directions: vec![inverse], ..of(Setup::EyeInHand) };
    let told = import(&folder, &declared).unwrap();
    assert!(told.text.contains("\ndirection = \"flange_from_base\"\n"), "{}", told.text);
    fs::remove_dir_all(folder).ok();
}

#[test]
fn zivids_poses_are_found_in_both_of_its_formats() {
    let matrix = "[1, 0, 0, 100], [0, 1, 0, 200], [0, 0, 1, 300], [0, 0, 0, 1]";
    let new =
        format!("__version__:\n  serializer: 1\n  data: 1\nFloatMatrix:\n  Data: [{matrix}]\n");
    let bare = matrix.replace(['[', ']'], "");
    let old = format!(
        "%YAML:1.0\n---\nPoseState: !!opencv-matrix\n   rows: 4\n   cols: 4\n   dt: d\n   data: [ {bare} ]\n"
    );
    for (name, text) in [("new", new), ("old", old)] {
        let folder = folder(&format!("zivid-{name}"));
        for k in 1..4 {
            fs::write(folder.join(format!("img0{k}.zdf")), "").unwrap();
            fs::write(folder.join(format!("pos0{k}.yaml")), &text).unwrap();
        }
        let mut imported = import(&folder, &of(Setup::EyeToHand)).unwrap();
        assert!(imported.questions[0].contains("which target"));
        imported.text +=
            "\n[target]\nkind = \"checkerboard\"\ncolumns = 7\nrows = 6\nsquare_mm = 30.0\n";
        let set = opened(&imported);
        assert_eq!(set.captures.len(), 3);
        let place = set.captures[1].base_from_flange.translation();
        assert!((place - nalgebra::Vector3::new(0.1, 0.2, 0.3)).norm() < 1e-15, "{name}: {place}");
        fs::remove_dir_all(folder).ok();
    }
}

/// A manifest of calibration-rs with poses in a table, and its files.
fn calibration_rs(folder: &Path) -> &'static str {
    fs::create_dir_all(folder.join("cam0")).unwrap();
    let mut poses = "name,px,py,pz,a,b,c\n".to_string();
    for k in 0..3 {
        fs::write(folder.join(format!("cam0/{k}.png")), "").unwrap();
        poses += &format!("{k},100,200,300,90,0,{k}\n");
    }
    fs::write(folder.join("poses.csv"), poses).unwrap();
    "version = 1\ntopology = \"single_cam_handeye\"\n\
     [[cameras]]\nid = \"cam0\"\nimages = { kind = \"glob\", pattern = \"cam0/*.png\" }\n\
     [target]\nkind = \"charuco\"\nrows = 5\ncols = 7\nsquare_size_m = 0.03\nmarker_size_m = 0.022\n\
     dictionary = \"DICT_4X4_50\"\n\
     [robot_poses]\npath = \"poses.csv\"\nformat = \"csv\"\n\
     columns = { pose_id = \"name\", tx = \"px\", ty = \"py\", tz = \"pz\", rotation = [\"a\", \"b\", \"c\"] }\n\
     [pose_pairing]\nkind = \"by_index\"\n\
     [pose_convention]\ntransform = \"t_tcp_base\"\nrotation_format = \"euler_zyx_deg\"\n\
     translation_units = \"mm\"\n"
}

#[test]
fn manifests_of_calibration_rs_are_told_in_our_words() {
    let folder = folder("calibration-rs");
    let file = folder.join("dataset.toml");
    fs::write(&file, calibration_rs(&folder)).unwrap();
    let asked = import(&file, &Declared::default()).unwrap();
    assert!(asked.questions.len() == 1 && asked.questions[0].contains("who carries the camera"));
    let set = opened(&import(&file, &of(Setup::EyeInHand)).unwrap());
    assert_eq!(set.captures.len(), 3);
    let flange_from_base = set.captures[0].base_from_flange.iso().inverse();
    assert!(
        (flange_from_base.translation.vector - nalgebra::Vector3::new(0.1, 0.2, 0.3)).norm()
            < 1e-12
    );
    let x = flange_from_base * nalgebra::Vector3::x();
    assert!((x - nalgebra::Vector3::y()).norm() < 1e-12, "90 degrees about z: {x}");
    fs::remove_dir_all(folder).ok();
}

#[test]
fn what_calibration_rs_left_unresolved_is_asked_and_not_believed() {
    let folder = folder("unresolved");
    let file = folder.join("dataset.toml");
    let open = "_unresolved = [\"pose_convention.transform\", \"target.square_size_m\"]\n";
    fs::write(&file, open.to_string() + calibration_rs(&folder)).unwrap();
    let asked = import(&file, &of(Setup::EyeInHand)).unwrap();
    assert!(asked.questions[0].contains("pose_convention.transform is marked as _unresolved"));
    assert!(
        asked.text.contains("# direction = ") && asked.text.contains("# [target]"),
        "{}",
        asked.text
    );
    let manifest = folder.join(&asked.name);
    fs::write(&manifest, &asked.text).unwrap();
    assert!(Dataset::open(&manifest).is_err(), "nothing is assumed");
    let without = calibration_rs(&folder).split("[robot_poses]").next().unwrap().to_string();
    fs::write(&file, without).unwrap();
    let error = import(&file, &of(Setup::EyeInHand)).unwrap_err().to_string();
    assert!(error.contains("without robot_poses"), "{error}");
    fs::remove_dir_all(folder).ok();
}
