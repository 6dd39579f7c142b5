use std::sync::atomic::{AtomicUsize, Ordering};

use handeye::{
    Setup,
    simulate::{Cell, Recording},
};

use super::*;
use crate::{files::process, simulated, temporary_folder};

static FOLDERS: AtomicUsize = AtomicUsize::new(0);

fn new_folder() -> PathBuf {
    let number = FOLDERS.fetch_add(1, Ordering::Relaxed);
    let root = temporary_folder().join(format!("handeye-session-{}-{number}", process()));
    fs::remove_dir_all(&root).ok();
    root
}

fn cell() -> Cell {
    let intrinsics = handeye::Intrinsics::pinhole(480, 300, 450.0, 450.0, 239.5, 149.5);
    Cell { intrinsics, captures: 4, touches: 0, ..Cell::new(Setup::EyeInHand, 3) }
}

fn settings(cell: &Cell) -> CellSettings {
    CellSettings {
        setup: cell.setup,
        target: cell.target.clone(),
        intrinsics: Some(cell.intrinsics),
        tolerance_mm: 1.0,
        notation: "ur".into(),
        guess: None,
        tip_mm: None,
        scans: None,
        arm: None,
    }
}

/// Takes captures of a simulated cell; returns their names.
fn take(folder: &mut SessionFolder, recording: &Recording, which: &[usize]) -> Vec<String> {
    let one = |&k: &usize| {
        let png = simulated::picture(&recording.picture(k));
        folder
            .take(&NewCapture {
                base_from_flange: recording.base_from_flange[k],
                typed: &[],
                joints: &[],
                robot_time_s: Some(k as f64),
                image_time_s: None,
                image: Some(("png", &png)),
                scan: None,
            })
            .unwrap()
    };
    which.iter().map(one).collect()
}

fn names(folder: &SessionFolder) -> Vec<String> {
    folder.captures().iter().map(|c| c.id.clone()).collect()
}

fn names_in(dataset: &Dataset) -> Vec<String> {
    dataset.captures.iter().map(|c| c.id.clone()).collect()
}

#[test]
fn the_folder_is_a_dataset_at_any_moment() {
    let (root, cell) = (new_folder(), cell());
    let recording = cell.record(1).unwrap();
    let mut folder = SessionFolder::open(&root, Some(&settings(&cell))).unwrap();
    assert_eq!(folder.dataset().unwrap().target, Some(cell.target.clone()));

    assert_eq!(take(&mut folder, &recording, &[0, 1, 2]), ["001", "002", "003"]);
    folder.delete("002").unwrap();
    assert_eq!(take(&mut folder, &recording, &[3]), ["004"]);

    let dataset = Dataset::open(&root).unwrap();
    assert_eq!(names_in(&dataset), ["001", "003", "004"]);
    assert!(dataset.warnings.is_empty(), "{:?}", dataset.warnings);
    let pose = dataset.captures[1].base_from_flange;
    assert!(pose.distance_to(&recording.base_from_flange[2]) < 2e-9);
    assert_eq!(dataset.limits.max_error, Some(1e-3));

    folder.restore("002").unwrap();
    assert_eq!(names_in(&folder.dataset().unwrap()), ["001", "002", "003", "004"]);
    assert!(folder.delete("009").unwrap_err().to_string().contains("no capture 009"));
    fs::remove_dir_all(root).unwrap();
}

#[test]
fn a_session_goes_on_where_it_was() {
    let (root, cell) = (new_folder(), cell());
    let recording = cell.record(1).unwrap();
    let mut folder = SessionFolder::open(&root, Some(&settings(&cell))).unwrap();
    take(&mut folder, &recording, &[0, 1]);
    folder.delete("001").unwrap();
    let why = "no board".to_owned();
    let refused = RefusedCapture { why, base_from_flange: None, time_s: 1.0 };
    folder.refuse(refused.clone()).unwrap();
    let held = SessionFolder::open(&root, None).err().unwrap().to_string();
    assert!(held.contains("in use by another session"), "{held}");
    drop(folder);

    let mut folder = SessionFolder::open(&root, None).unwrap();
    assert_eq!(names(&folder), ["002"]);
    assert_eq!(folder.deleted()[0].id, "001");
    assert_eq!(folder.refused(), [&refused]);
    assert_eq!(folder.settings(), &settings(&cell));
    assert_eq!(take(&mut folder, &recording, &[2]), ["003"]);
    let other = CellSettings { setup: Setup::EyeToHand, ..settings(&cell) };
    let why = folder.is_of_cell(&other).unwrap_err().to_string();
    assert!(why.contains("begin a session in a new folder"), "{why}");
    folder.set(&CellSettings { tolerance_mm: 0.4, ..settings(&cell) }).unwrap();
    assert_eq!(folder.dataset().unwrap().limits.max_error, Some(0.4e-3));
    fs::remove_dir_all(root).unwrap();
}

#[test]
fn a_program_killed_at_any_step_of_a_capture_loses_nothing_that_was_confirmed() {
    let (root, cell) = (new_folder(), cell());
    let recording = cell.record(1).unwrap();
    let mut folder = SessionFolder::open(&root, Some(&settings(&cell))).unwrap();
    take(&mut folder, &recording, &[0, 1]);
    let before: Vec<_> =
        ["robot.csv", JOURNAL].map(|name| fs::read(root.join(name)).unwrap()).into();
    take(&mut folder, &recording, &[2]);
    drop(folder);
    let (image, aside) = (root.join("images/003.png"), root.join("deleted/images/003.png"));
    let journal = fs::read(root.join(JOURNAL)).unwrap();
    let aside_folder = aside.parent().unwrap();

    // killed after the line, before its image was in place: the capture is whole
    fs::create_dir_all(aside_folder).unwrap();
    fs::rename(&image, &aside).unwrap();
    fs::write(root.join("robot.csv"), &before[0]).unwrap();
    assert_eq!(names_in(&Dataset::open(&root).unwrap()), ["001", "002"]);
    assert_eq!(names(&SessionFolder::open(&root, None).unwrap()), ["001", "002", "003"]);
    assert_eq!(names_in(&Dataset::open(&root).unwrap()), ["001", "002", "003"]);

    // killed before the table was written: the folder can be used even now
    fs::write(root.join("robot.csv"), &before[0]).unwrap();
    assert_eq!(names_in(&Dataset::open(&root).unwrap()), ["001", "002"]);
    assert_eq!(names(&SessionFolder::open(&root, None).unwrap()), ["001", "002", "003"]);

    // killed within the line: it was never confirmed, and its name is free
    for end in [before[1].len(), before[1].len() + 1, journal.len() - 1] {
        if image.exists() {
            fs::create_dir_all(aside_folder).unwrap();
            fs::rename(&image, &aside).unwrap();
        }
        fs::write(root.join("robot.csv"), &before[0]).unwrap();
        fs::write(root.join(JOURNAL), &journal[..end]).unwrap();
        let mut folder = SessionFolder::open(&root, None).unwrap();
        assert_eq!(names(&folder), ["001", "002"]);
        assert_eq!(take(&mut folder, &recording, &[3]), ["003"]);
        let pose = folder.captures()[2].base_from_flange;
        assert!(pose.distance_to(&recording.base_from_flange[3]) < 1e-12);
    }
    fs::remove_dir_all(root).unwrap();
}

#[test]
fn other_folders_and_damaged_journals_are_refused_with_what_to_do() {
    let (root, cell) = (new_folder(), cell());
    fs::create_dir_all(&root).unwrap();
    fs::write(root.join("notes.txt"), "mine").unwrap();
    let message = SessionFolder::open(&root, Some(&settings(&cell))).err().unwrap().to_string();
    assert!(message.contains("give an empty or a new folder"), "{message}");
    fs::write(root.join(JOURNAL), "{\"cell\": 3}\n").unwrap();
    let message = SessionFolder::open(&root, None).err().unwrap().to_string();
    assert!(message.contains("line 1") && message.contains("calibrate the folder"), "{message}");
    fs::remove_dir_all(root).unwrap();
}

#[test]
fn numbers_that_were_typed_in_another_notation_are_read_again() {
    // what was read first, what the pendant shows, and numbers of it that no pose gives back in the first reading
    for (first, really, numbers) in [
        ("fanuc", "kuka", [612.3, -4.1, 233.0, 10.0, 20.0, -170.0]),
        ("kuka", "doosan", [612.3, -4.1, 233.0, 45.0, 170.0, 45.0]),
        ("ur", "ur-rpy", [0.6, -0.1, 0.4, 3.0, 0.1, 1.6]),
    ] {
        let (root, cell) = (new_folder(), cell());
        let settings = CellSettings { notation: first.into(), ..settings(&cell) };
        let mut folder = SessionFolder::open(&root, Some(&settings)).unwrap();
        let read = |notation: &str| Writing::of(notation).unwrap().pose(&numbers).unwrap();
        let capture = NewCapture {
            base_from_flange: read(first),
            typed: &numbers,
            joints: &[],
            robot_time_s: None,
            image_time_s: None,
            image: None,
            scan: None,
        };
        folder.take(&capture).unwrap();
        folder.touch(&new_touch((None, 3), (read(first), &numbers))).unwrap();
        // whether or not the notation was corrected before, and twice is as good as once
        folder.set(&CellSettings { notation: really.into(), ..settings }).unwrap();
        folder.reread(really).unwrap();
        folder.reread(really).unwrap();
        let off = |folder: &SessionFolder| {
            let poses =
                [folder.captures()[0].base_from_flange, folder.touches()[0].base_from_flange];
            poses.map(|pose| pose.distance_to(&read(really)) + pose.angle_to(&read(really)))
        };
        assert!(off(&folder).iter().all(|off| *off < 1e-9), "{first} {:?}", off(&folder));

        // and so they are when the folder is opened again
        drop(folder);
        let folder = SessionFolder::open(&root, None).unwrap();
        assert!(off(&folder).iter().all(|off| *off < 1e-9), "{first} {:?}", off(&folder));
        assert_eq!(folder.settings().notation, really);
        drop(folder);
        fs::remove_dir_all(root).unwrap();
    }
}

/// A touch of a corner of a placement, with the flange there as it was typed.
fn new_touch<'a>(
    (placement, corner): (Option<&'a str>, u32),
    (base_from_flange, typed): (Pose<Base, Flange>, &'a [f64]),
) -> NewTouch<'a> {
    NewTouch { placement, corner, verifies: false, base_from_flange, typed, time_s: 1.0 }
}

#[test]
fn boards_that_are_laid_down_and_touched_are_those_of_the_dataset() {
    let root = new_folder();
    let intrinsics = cell().intrinsics;
    let cell = Cell { intrinsics, captures: 3, placements: 1, ..Cell::new(Setup::EyeToHand, 3) };
    let recording = cell.record(1).unwrap();
    let settings = CellSettings { tip_mm: Some([0.0, 0.0, 150.0]), ..settings(&cell) };
    let mut folder = SessionFolder::open(&root, Some(&settings)).unwrap();
    take(&mut folder, &recording, &[0, 1, 2]);
    let png = simulated::picture(&recording.picture(3));
    let image = Some(("png", &png[..]));
    let placement = NewPlacement { image_time_s: Some(1.0), image, scan: None };
    let touch = |folder: &mut SessionFolder, placement: &str, corner: u32| {
        let pose = recording.base_from_flange[0];
        folder.touch(&new_touch((Some(placement), corner), (pose, &[])))
    };
    let missing = touch(&mut folder, "p01", 0).unwrap_err().to_string();
    assert!(missing.contains("has no placement p01"), "{missing}");
    assert_eq!(folder.place(&placement).unwrap(), "p01");
    assert_eq!(folder.place(&placement).unwrap(), "p02");
    for (on, corner) in [("p01", 3), ("p02", 3), ("p02", 8)] {
        touch(&mut folder, on, corner).unwrap();
    }
    let seen = |folder: &SessionFolder| -> (Vec<String>, Vec<(String, u32)>) {
        let dataset = folder.dataset().unwrap();
        let placements = dataset.placements.iter().map(|p| p.id.clone()).collect();
        (placements, dataset.touches.iter().map(|t| (t.placement.clone(), t.corner)).collect())
    };
    let on = |placement: &str, corner: u32| (placement.to_owned(), corner);
    let all =
        (vec!["p01".to_owned(), "p02".to_owned()], vec![on("p01", 3), on("p02", 3), on("p02", 8)]);
    assert_eq!(seen(&folder), all);

    // with a placement its touches go; one that was deleted before stays so
    folder.untouch("t03").unwrap();
    folder.delete("p02").unwrap();
    assert_eq!(seen(&folder), (vec!["p01".into()], vec![on("p01", 3)]));
    assert_eq!(folder.deleted_beside(), ["p02"]);
    assert_eq!(folder.laid_last(), Some("p02"));
    assert!(folder.restore("t03").is_err());
    drop(folder);
    let mut folder = SessionFolder::open(&root, None).unwrap();
    folder.restore("p02").unwrap();
    assert_eq!(folder.deleted_beside(), ["t03"]);
    folder.restore("t03").unwrap();
    assert_eq!(seen(&folder), all);
    assert!(!root.join(DELETED).exists());
    assert_eq!(folder.place(&placement).unwrap(), "p03");

    // a board whose touches verify the answer is none of those that it is made with
    let pose = recording.base_from_flange[0];
    let verifying = NewTouch { verifies: true, ..new_touch((Some("p03"), 3), (pose, &[])) };
    folder.touch(&verifying).unwrap();
    assert_eq!(seen(&folder), all);
    let mixed = touch(&mut folder, "p03", 0).unwrap_err().to_string();
    assert!(mixed.contains("lay the board elsewhere"), "{mixed}");
    let held_out = folder.verification_dataset(None).unwrap();
    assert_eq!(held_out.placements.iter().map(|p| &p.id[..]).collect::<Vec<_>>(), ["p03"]);
    assert_eq!(held_out.touches.len(), 1);
    let tip = pose * handeye::Point::new(0.0, 0.0, 0.15);
    assert_eq!(held_out.touches[0].in_base, tip);
    drop(folder);
    let mut folder = SessionFolder::open(&root, None).unwrap();
    assert!(folder.touches().last().unwrap().verifies);
    folder.untouch("t04").unwrap();
    assert_eq!(seen(&folder).0, ["p01", "p02", "p03"]);
    drop(folder);
    fs::remove_dir_all(root).unwrap();
}

#[test]
fn poses_that_nobody_typed_are_not_read_again() {
    let (root, cell) = (new_folder(), cell());
    let recording = cell.record(0).unwrap();
    let mut folder = SessionFolder::open(&root, Some(&settings(&cell))).unwrap();
    take(&mut folder, &recording, &[0]);
    let why = folder.reread("kuka").unwrap_err().to_string();
    assert!(why.contains("the robot gave it"), "{why}");
    assert_eq!(folder.settings().notation, "ur");
    drop(folder);
    fs::remove_dir_all(root).unwrap();
}
