//! A command that takes an image: it covers every camera whose maker has a library in any language. `{out}` in it is the
//! file that it writes, and `{scan}` (PLY) or `{scan.pcd}` and the like that of the scan of the same moment. It comes from
//! the manifest's side, the command line, and never from the page.

use std::{
    fs,
    path::{Path, PathBuf},
    process::{Child, Command, Stdio},
    sync::{
        atomic::{AtomicUsize, Ordering},
        mpsc::{self, Sender},
    },
    thread,
    time::{Duration, Instant},
};

use super::{
    folder,
    outlet::{CameraImage, Outlet, Wanted},
    scan,
};

/// A command that takes longer hangs.
const PATIENCE: Duration = Duration::from_secs(60);
/// Of what it prints, so much is shown.
const SHOWN_CHARS: usize = 300;

/// Images that this process has asked for: several sessions in it do not share a file.
static GRABS: AtomicUsize = AtomicUsize::new(0);

/// Waits to be asked for images, and takes them by the command; the answer is the sender to ask by.
pub fn grabber(command: String, outlet: Outlet) -> Sender<()> {
    let (ask, asked) = mpsc::channel();
    thread::spawn(move || {
        while asked.recv().is_ok() {
            // several askings at once are one
            while asked.try_recv().is_ok() {}
            // an image is not older than the command that took it
            let begin = outlet.now();
            let alive = match grab(&command, &outlet.wanted(), PATIENCE) {
                Ok(image) => outlet.image(image, begin),
                Err(why) => outlet.trouble(
                    "no-image",
                    why,
                    "run the command by hand: does it write the image?",
                ),
            };
            if !alive {
                return;
            }
        }
    });
    ask
}

/// Takes one image.
fn grab(command: &str, wanted: &Wanted, patience: Duration) -> Result<CameraImage, String> {
    let number = GRABS.fetch_add(1, Ordering::Relaxed);
    let name = format!("handeye-grab-{}-{number}", handeye_io::process());
    let folder = handeye_io::temporary_folder().join(name);
    fs::remove_dir_all(&folder).ok();
    fs::create_dir_all(&folder).map_err(|e| format!("{}: {e}", folder.display()))?;
    let taken = grab_in(&folder, command, wanted, patience);
    fs::remove_dir_all(&folder).ok();
    taken
}

/// The placeholder of the scan in a command, and the ending of its file.
pub fn scan_in(command: &str) -> Option<(&str, &str)> {
    let begin = command.find("{scan")?;
    let rest = &command[begin..];
    let (whole, _) = rest.split_at(rest.find('}')? + 1);
    match whole.strip_prefix("{scan")?.strip_suffix('}')? {
        "" => Some((whole, "ply")),
        ending => Some((whole, ending.strip_prefix('.')?)),
    }
}

fn grab_in(
    folder: &Path,
    command: &str,
    wanted: &Wanted,
    patience: Duration,
) -> Result<CameraImage, String> {
    let out = folder.join("image.png");
    let placed = wanted.scans.and_then(|settings| Some((settings, scan_in(command)?)));
    let scan =
        placed.map(|(settings, (_, ending))| (settings, folder.join(format!("scan.{ending}"))));
    let (printed, errors) = (folder.join("stdout"), folder.join("stderr"));
    let file =
        |path: &PathBuf| fs::File::create(path).map_err(|e| format!("{}: {e}", path.display()));
    let mut line = command.replace("{out}", &out.display().to_string());
    if let (Some((_, (place, _))), Some((_, path))) = (&placed, &scan) {
        line = line.replace(place, &path.display().to_string());
    }
    let child = shell(&line)
        .stdin(Stdio::null())
        .stdout(file(&printed)?)
        .stderr(file(&errors)?)
        .spawn()
        .map_err(|e| format!("the command cannot be run: {e}"))?;
    let said = || {
        let text = [&errors, &printed].map(|path| fs::read(path).unwrap_or_default()).concat();
        let text = String::from_utf8_lossy(&text);
        let last: Vec<char> = text.trim().chars().rev().take(SHOWN_CHARS).collect();
        last.into_iter().rev().filter(|c| !c.is_control() || *c == '\n').collect::<String>()
    };
    match ended(child, patience)? {
        None => {
            return Err(format!(
                "the command has not ended after {} s: {}",
                patience.as_secs(),
                said()
            ));
        }
        Some(false) => return Err(format!("the command has failed: {}", said())),
        Some(true) => {}
    }
    let length = fs::metadata(&out)
        .map_err(|_| format!("the command has written no image to {{out}}: {}", said()))?
        .len();
    let (image, _) = folder::read(&out, length)?;
    let Some((settings, path)) = scan else { return Ok(image) };
    if !path.exists() {
        return Err(format!(
            "the command has written an image, and no scan to {{scan}}: {}",
            said()
        ));
    }
    Ok(CameraImage { scan: Some(scan::read(&path, wanted, &settings)?), ..image })
}

fn shell(command: &str) -> Command {
    let (program, option) = if cfg!(windows) { ("cmd", "/C") } else { ("sh", "-c") };
    let mut shell = Command::new(program);
    // in place of the shell, so that ending it ends the command
    let command = if cfg!(windows) { command.to_owned() } else { format!("exec {command}") };
    shell.args([option, &command]);
    shell
}

/// Whether it has succeeded; `None` where it had to be ended.
fn ended(mut child: Child, patience: Duration) -> Result<Option<bool>, String> {
    let begin = Instant::now();
    while begin.elapsed() < patience {
        match child.try_wait() {
            Ok(Some(status)) => return Ok(Some(status.success())),
            Ok(None) => thread::sleep(Duration::from_millis(20)),
            Err(e) => return Err(format!("the command is lost: {e}")),
        }
    }
    child.kill().ok();
    child.wait().ok();
    Ok(None)
}

#[cfg(test)]
#[cfg(unix)]
mod tests {
    use handeye::TargetModel;
    use handeye_io::{ScanSettings, simulated};

    use super::*;

    fn wanted(scans: Option<ScanSettings>) -> Wanted {
        let target = TargetModel::Checkerboard { columns: 9, rows: 6, square_mm: 30.0 };
        Wanted { target, intrinsics: None, scans }
    }

    #[test]
    fn a_command_writes_the_scan_that_goes_with_the_image() {
        let name = format!("handeye-grab-scan-{}", std::process::id());
        let source = std::env::temp_dir().join(name);
        fs::create_dir_all(&source).unwrap();
        let (image, scan) = (source.join("a.png"), source.join("a.xyz"));
        let grey = handeye::GrayImage::new(32, 16, vec![9.0; 512]).unwrap();
        fs::write(&image, simulated::picture(&grey)).unwrap();
        fs::write(&scan, "0.1 0 0.6\n0 0.1 0.6\n").unwrap();
        let (image, scan) = (image.display(), scan.display());
        let both = format!("cp {image} {{out}} && cp {scan} {{scan.xyz}}");
        // one program ends when it is ended: a line of two is one shell's
        let both = format!("sh -c '{both}'");
        let grab = |line: &str, scans| grab(line, &wanted(scans), Duration::from_secs(5));
        let taken = grab(&both, Some(ScanSettings::METRES)).unwrap().scan.unwrap();
        assert_eq!((&taken.0[..], &taken.1[..]), ("xyz", &b"0.1 0 0.6\n0 0.1 0.6\n"[..]));
        let alone = format!("cp {image} {{out}} # {{scan}}");
        let why = grab(&alone, Some(ScanSettings::METRES)).unwrap_err();
        assert!(why.contains("no scan"), "{why}");
        assert_eq!(scan_in("grab {out} {scan}"), Some(("{scan}", "ply")));
        assert_eq!(scan_in("grab {out} {scan.zdf}"), Some(("{scan.zdf}", "zdf")));
        assert!(
            ["grab {out}", "grab {scanner}", "grab {scan"].iter().all(|l| scan_in(l).is_none())
        );
        fs::remove_dir_all(source).unwrap();
    }

    #[test]
    fn commands_that_fail_hang_or_write_rubbish_are_named() {
        let source =
            std::env::temp_dir().join(format!("handeye-grab-source-{}.png", std::process::id()));
        let png = simulated::picture(&handeye::GrayImage::new(32, 16, vec![9.0; 512]).unwrap());
        fs::write(&source, &png).unwrap();
        let quick = Duration::from_millis(600);
        let image =
            grab(&format!("cp {} {{out}}", source.display()), &wanted(None), quick).unwrap();
        assert_eq!(image.file.unwrap().1[..], png[..]);
        for (command, said) in [
            ("sh -c 'echo no camera 4711 >&2; exit 3'", "no camera 4711"),
            ("sleep 30", "has not ended"),
            ("true", "written no image"),
            ("sh -c 'echo half > {out}'", "image.png"),
            ("this-is-no-program", "has failed"),
        ] {
            let message = grab(command, &wanted(None), quick).unwrap_err();
            assert!(message.contains(said), "{command}: {message}");
        }
        fs::remove_file(source).unwrap();
    }
}
