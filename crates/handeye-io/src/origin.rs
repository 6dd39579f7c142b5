//! What a result was made from, by which version, and when: so that it can be traced years later.

use std::{
    env,
    fs::File,
    io::{self, Read},
    path::{Path, PathBuf},
    time::{SystemTime, UNIX_EPOCH},
};

use handeye::calibrate::result::{Equipment, InputFile, Origin};
use hmac_sha256::Hash;

use crate::{
    Dataset,
    error::Error,
    files,
    parallel::{self, in_order},
};

/// Of a dataset.
pub(crate) fn of_dataset(dataset: &Dataset) -> Result<Origin, Error> {
    let folder = dataset.manifest.parent().unwrap_or(Path::new(""));
    let origin = of_files(&dataset.title(), &[&dataset.root, folder], &dataset.inputs)?;
    Ok(Origin { equipment: dataset.equipment.clone(), ..origin })
}

/// Of a file of poses.
pub(crate) fn of_file(file: &Path) -> Result<Origin, Error> {
    let folder = file.parent().unwrap_or(Path::new(""));
    of_files(&files::stem(file), &[folder], &[file.into()])
}

fn of_files(name: &str, folders: &[&Path], paths: &[PathBuf]) -> Result<Origin, Error> {
    let threads = parallel::threads([]);
    let input = |path: &PathBuf| {
        let sha256 = sha256(path).map_err(|source| Error::Read { path: path.clone(), source })?;
        let below =
            folders.iter().find_map(|folder| path.strip_prefix(folder).ok()).unwrap_or(path);
        Ok(InputFile { path: below.display().to_string().replace('\\', "/"), sha256 })
    };
    let inputs = in_order(paths.len(), threads, |k| input(&paths[k]));
    Ok(Origin {
        version: env!("CARGO_PKG_VERSION").into(),
        created: now(),
        dataset: Some(name.into()),
        inputs: inputs.into_iter().collect::<Result<_, Error>>()?,
        equipment: Equipment::default(),
    })
}

fn sha256(path: &Path) -> io::Result<String> {
    let (mut file, mut hash, mut part) = (File::open(path)?, Hash::new(), vec![0; 1 << 16]);
    loop {
        match file.read(&mut part)? {
            0 => break,
            count => hash.update(&part[..count]),
        }
    }
    Ok(hash.finalize().iter().map(|byte| format!("{byte:02x}")).collect())
}

/// The first second of a year of five digits.
const YEAR_10000: u64 = 253_402_300_800;

/// The time, or that of `SOURCE_DATE_EPOCH`: then the same input gives the same bytes.
fn now() -> Option<String> {
    let fixed = env::var("SOURCE_DATE_EPOCH").ok().and_then(|seconds| seconds.parse().ok());
    let fixed = fixed.filter(|seconds| *seconds < YEAR_10000);
    let clock = || SystemTime::now().duration_since(UNIX_EPOCH).ok().map(|passed| passed.as_secs());
    fixed.or_else(clock).map(in_utc)
}

/// Seconds since 1970 as a date and a time of the Gregorian calendar (ISO 8601).
fn in_utc(seconds: u64) -> String {
    let (mut days, of_day) = (seconds / 86_400, seconds % 86_400);
    let is_leap = |y: u64| y.is_multiple_of(4) && (!y.is_multiple_of(100) || y.is_multiple_of(400));
    let mut year = 1970;
    while days >= 365 + u64::from(is_leap(year)) {
        days -= 365 + u64::from(is_leap(year));
        year += 1;
    }
    let february = 28 + u64::from(is_leap(year));
    let mut month = 1;
    for length in [31, february, 31, 30, 31, 30, 31, 31, 30, 31, 30] {
        if days < length {
            break;
        }
        days -= length;
        month += 1;
    }
    let (hour, minute, second) = (of_day / 3600, of_day / 60 % 60, of_day % 60);
    format!("{year:04}-{month:02}-{:02}T{hour:02}:{minute:02}:{second:02}Z", days + 1)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn seconds_are_dates() {
        for (seconds, date) in [
            (0, "1970-01-01T00:00:00Z"),
            (951_782_399, "2000-02-28T23:59:59Z"),
            (951_782_400, "2000-02-29T00:00:00Z"),
            (1_704_067_199, "2023-12-31T23:59:59Z"),
            (4_107_542_400, "2100-03-01T00:00:00Z"),
        ] {
            assert_eq!(in_utc(seconds), date);
        }
    }

    #[test]
    fn files_have_the_published_sum() {
        let path = env::temp_dir().join(format!("handeye-sum-{}", std::process::id()));
        std::fs::write(&path, "abc").unwrap();
        let found = of_file(&path).unwrap();
        std::fs::remove_file(&path).unwrap();
        let sum = "ba7816bf8f01cfea414140de5dae2223b00361a396177a9cb410ff61f20015ad"; // FIPS 180-2
        assert_eq!(found.inputs[0].sha256, sum);
    }
}
