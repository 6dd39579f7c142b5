//! `handeye plan`: views that are reached, that bring what they promise, and that keep away from what stands around.

use handeye::nalgebra::{Isometry3, UnitQuaternion, Vector3};
use serde_json::Value;

use crate::folder::{Folder, Run, handeye};

#[track_caller]
fn ends(run: &Run, code: i32) -> &Run {
    assert_eq!(run.code, code, "{}{}", run.stdout, run.stderr);
    run
}

fn cell(captures: &str, more: &[&str]) -> Folder {
    let folder = Folder::new();
    let simulate =
        ["simulate", "cell", "--captures", captures, "--no-images", "--touches", "0", "--quiet"];
    ends(&handeye(&folder, &[&simulate[..], more].concat()), 0);
    folder
}

/// An arm of 1.4 m reach: Denavit and Hartenberg's `a`, `alpha`, `d` and offset of each joint, as rods of a URDF.
const ARM: [[f64; 4]; 6] = [
    [0.15, -90.0, 0.45, 0.0],
    [0.60, 0.0, 0.0, -90.0],
    [0.12, -90.0, 0.0, 0.0],
    [0.0, 90.0, 0.64, 0.0],
    [0.0, -90.0, 0.0, 0.0],
    [0.0, 0.0, 0.10, 0.0],
];

fn urdf() -> String {
    let turn = |axis: Vector3<f64>, degrees: f64| UnitQuaternion::new(axis * degrees.to_radians());
    let mut before = Isometry3::identity();
    let mut text = String::from("<robot name=\"arm\"><link name=\"base_link\"/>\n");
    let origin = |pose: &Isometry3<f64>| {
        let (t, (r, p, y)) = (pose.translation.vector, pose.rotation.euler_angles());
        format!("<origin xyz=\"{} {} {}\" rpy=\"{r} {p} {y}\"/>", t.x, t.y, t.z)
    };
    for (k, [a, alpha, d, offset]) in ARM.into_iter().enumerate() {
        let parent = if k == 0 { "base_link".into() } else { format!("link{k}") };
        let at =
            before * Isometry3::from_parts(Vector3::zeros().into(), turn(Vector3::z(), offset));
        before = Isometry3::from_parts(Vector3::z().scale(d).into(), UnitQuaternion::identity())
            * Isometry3::from_parts(Vector3::x().scale(a).into(), turn(Vector3::x(), alpha));
        let rod = match k {
            1 => {
                "<collision><origin xyz=\"0.3 0 0\" rpy=\"0 1.5707963 0\"/><geometry><cylinder radius=\"0.08\" length=\"0.6\"/></geometry></collision>"
            }
            3 => {
                "<collision><origin xyz=\"0 0 0.25\"/><geometry><box size=\"0.06 0.06 0.4\"/></geometry></collision>"
            }
            _ => "",
        };
        text += &format!(
            "<link name=\"link{n}\">{rod}</link><joint name=\"j{n}\" type=\"revolute\"><parent link=\"{parent}\"/><child link=\"link{n}\"/>\
             {}<axis xyz=\"0 0 1\"/><limit lower=\"-3.0\" upper=\"3.0\" effort=\"1\" velocity=\"1\"/></joint>\n",
            origin(&at),
            n = k + 1
        );
    }
    text + &format!(
        "<link name=\"tool0\"/><joint name=\"end\" type=\"fixed\"><parent link=\"link6\"/><child link=\"tool0\"/>{}</joint></robot>",
        origin(&before)
    )
}

fn position(pose: &Value) -> Vector3<f64> {
    let t = &pose["base_from_flange"]["translation_m"];
    Vector3::from_fn(|k, _| t[k].as_f64().unwrap())
}

/// Where the flange is by its joint values.
fn flange(joints: &Value) -> Vector3<f64> {
    let about = |axis: Vector3<f64>, angle: f64| {
        Isometry3::from_parts(Vector3::zeros().into(), UnitQuaternion::new(axis * angle))
    };
    let along = |v: Vector3<f64>| Isometry3::from_parts(v.into(), UnitQuaternion::identity());
    let mut at = Isometry3::identity();
    for (k, [a, alpha, d, offset]) in ARM.into_iter().enumerate() {
        let q = joints[k].as_f64().unwrap() + f64::to_radians(offset);
        at = at * about(Vector3::z(), q) * along(Vector3::z() * d) * along(Vector3::x() * a);
        at *= about(Vector3::x(), alpha.to_radians());
    }
    at.translation.vector
}

#[test]
fn a_plan_ends_below_the_tolerance_and_each_view_brings_something() {
    let folder = cell("3", &[]);
    let found =
        ends(&handeye(&folder, &["plan", "cell", "--tolerance-mm", "0.6", "--json"]), 0).json();
    let errors: Vec<f64> = found["poses"]
        .as_array()
        .unwrap()
        .iter()
        .map(|v| v["predicted_p95_mm"].as_f64().unwrap())
        .collect();
    assert!(errors.len() >= 3 && errors.windows(2).all(|w| w[1] < w[0]), "{errors:?}");
    assert!(errors[errors.len() - 1] <= 0.6 && found["enough"] == false);
    let text = handeye(
        &folder,
        &["plan", "cell", "--tolerance-mm", "0.6", "--format", "kuka", "--out", "views.csv"],
    );
    assert!(ends(&text, 0).stdout.contains("within the tolerance of 0.6 mm"), "{}", text.stdout);
    let table = folder.read("views.csv");
    assert!(table.starts_with("id,x,y,z,A,B,C\nview-01,"), "{table}");
    assert_eq!(table.lines().count(), 1 + errors.len());
    let next = ends(&handeye(&folder, &["plan", "cell", "--next", "--json", "--quiet"]), 0).json();
    assert_eq!(next["poses"].as_array().unwrap().len(), 1);

    // many captures are enough
    let many = cell("25", &[]);
    let found = ends(&handeye(&many, &["plan", "cell", "--tolerance-mm", "2"]), 0).stdout.clone();
    assert!(found.contains("enough for the tolerance of 2 mm"), "{found}");
}

#[test]
fn joints_keep_limits_and_lead_to_the_pose_and_boxes_are_kept_away_from() {
    let folder = cell("4", &[]);
    folder.put("arm.urdf", &urdf());
    let plan = ["plan", "cell", "--count", "6", "--urdf", "arm.urdf", "--json", "--quiet"];
    let free = ends(&handeye(&folder, &plan), 0).json();
    let views = free["poses"].as_array().unwrap();
    assert_eq!((views.len(), free["joint_names"][5].as_str()), (6, Some("j6")));
    for view in views {
        let joints = &view["joints_rad"];
        assert!((flange(joints) - position(view)).norm() < 1e-9, "{view}");
        assert!(joints.as_array().unwrap().iter().all(|q| q.as_f64().unwrap().abs() < 3.0));
    }
    // a post where one of the views was
    let at = position(&views[5]) * 1e3;
    let post = format!(
        "clearance_mm = 20\n[[box]]\nname = \"post\"\nminimum_mm = [{}, {}, {}]\nmaximum_mm = [{}, {}, {}]\n\
         [[on_flange]]\nname = \"camera\"\nminimum_mm = [-20, -20, 20]\nmaximum_mm = [20, 20, 60]\n",
        at.x - 40.0,
        at.y - 40.0,
        at.z - 40.0,
        at.x + 40.0,
        at.y + 40.0,
        at.z + 40.0
    );
    folder.put("boxes.toml", &post);
    let walled = handeye(&folder, &[&plan[..], &["--avoid", "boxes.toml"]].concat());
    let walled = ends(&walled, 0).json();
    for view in walled["poses"].as_array().unwrap() {
        let off = (position(view) * 1e3 - at).abs().max();
        assert!(off > 40.0, "{off} mm from the middle of the post");
    }
    folder.put("boxes.toml", "[[box]]\nnam = \"post\"\n");
    let refused = handeye(&folder, &[&plan[..4], &["--avoid", "boxes.toml"]].concat());
    assert!(
        ends(&refused, 1).error().starts_with("boxes.toml:2: unknown field `nam`"),
        "{}",
        refused.stderr
    );
    let wrong = handeye(&folder, &["plan", "cell", "--urdf", "arm.urdf", "--flange-link", "tool"]);
    assert!(ends(&wrong, 1).error().ends_with("did you mean tool0?"), "{}", wrong.stderr);
}

#[test]
fn one_capture_and_a_guess_are_a_plan_and_without_a_guess_it_is_asked_for() {
    let folder = cell("1", &[]);
    let asked = handeye(&folder, &["plan", "cell"]);
    assert!(
        ends(&asked, 1).error().contains("roughly where does the camera sit?"),
        "{}",
        asked.stderr
    );
    let manifest = folder.read("cell/handeye.toml");
    let guess = "\n[guess]\ntranslation_mm = [60, -30, 50]\noptical_axis = [0, 0, 1]\nimage_x = [1, 0, 0]\n";
    folder.put("cell/handeye.toml", &(manifest.clone() + guess));
    let found = handeye(&folder, &["plan", "cell", "--count", "3"]);
    assert!(
        ends(&found, 0).stdout.contains("needed to determine all directions"),
        "{}",
        found.stdout
    );
    folder.put(
        "cell/handeye.toml",
        &(manifest + &guess.replace("image_x = [1, 0, 0]", "image_x = [0, 0, 2]")),
    );
    let wrong = handeye(&folder, &["plan", "cell"]);
    assert!(
        ends(&wrong, 1).error().contains("optical_axis and image_x are not two directions"),
        "{}",
        wrong.stderr
    );
}

#[test]
fn touches_are_planned_and_programs_of_robots_written() {
    let folder = cell("5", &["--setup", "eye-to-hand"]);
    let found = ends(
        &handeye(&folder, &["plan", "cell", "--count", "2", "--touches", "--json", "--quiet"]),
        0,
    )
    .json();
    let touches = found["touches"].as_array().unwrap();
    let after: Vec<f64> = touches.iter().map(|t| t["predicted_p95_mm"].as_f64().unwrap()).collect();
    assert!(touches.len() == 12 && after[11] < after[0], "{after:?}");
    assert!(touches[0]["camera_from_target"]["translation_m"][2].as_f64().unwrap() > 0.5);
    for (maker, line) in [
        ("ur", "movel(p["),
        ("kuka", "LIN {x "),
        ("fanuc", "L P[2] 50mm/sec FINE"),
        ("abb", "MoveL [["),
    ] {
        let run =
            handeye(&folder, &["plan", "cell", "--count", "2", "--program", maker, "--quiet"]);
        assert!(ends(&run, 0).stdout.contains(line), "{}", run.stdout);
    }
    let none = handeye(&folder, &["plan", "cell", "--program", "lego"]);
    assert!(ends(&none, 2).error().contains("there are ur, kuka, fanuc, abb"), "{}", none.stderr);
}

#[test]
fn a_touch_closes_what_a_robot_with_four_axes_leaves_open() {
    let folder = cell("6", &["--tilt-deg", "0", "--seed", "2"]);
    let found = handeye(&folder, &["plan", "cell", "--count", "1", "--touches", "--quiet"]);
    let found = &ends(&found, 0).stdout;
    let touch = found.lines().find(|line| line.contains("touch corner")).unwrap();
    assert!(touch.contains("of the board: then all is determined, to "), "{found}");
}
