//! Which pose belongs to which image: by order, or by the last number of their names.

use std::collections::BTreeMap;

use handeye::Warning;

use super::{manifest::Pairing, touches::mismatch};
use crate::{
    error::{Error, Place, malformed},
    files::last_number,
};

/// One list of things that belong to captures: their names, in order.
pub(super) struct Series {
    pub(super) what: &'static str,
    pub(super) place: Place,
    pub(super) names: Vec<Option<String>>,
}

/// For every capture, the index of its part in each series; the first series leads.
pub(super) fn pair(
    series: &[Series],
    pairing: Pairing,
    warnings: &mut Vec<Warning>,
) -> Result<Vec<Vec<usize>>, Error> {
    match pairing {
        Pairing::Order => by_order(series),
        Pairing::Number => by_number(series, warnings),
    }
}

fn by_order(series: &[Series]) -> Result<Vec<Vec<usize>>, Error> {
    let Some(first) = series.first() else { return Ok(vec![]) };
    for other in &series[1..] {
        if other.names.len() != first.names.len() {
            let (left, right) = (first.names.len(), other.names.len());
            return Err(mismatch(other.place.clone(), left, first.what, right, other.what));
        }
    }
    Ok((0..first.names.len()).map(|i| vec![i; series.len()]).collect())
}

fn by_number(series: &[Series], warnings: &mut Vec<Warning>) -> Result<Vec<Vec<usize>>, Error> {
    let numbered: Vec<BTreeMap<u64, usize>> =
        series.iter().map(numbers).collect::<Result<_, _>>()?;
    let everywhere = |n: &u64| numbered.iter().all(|m| m.contains_key(n));
    for (one, map) in series.iter().zip(&numbered) {
        let alone: Vec<String> =
            map.keys().filter(|n| !everywhere(n)).map(u64::to_string).collect();
        if !alone.is_empty() {
            let message = format!(
                "{}: {} with number {} have no partner and are not used",
                one.place,
                one.what,
                alone.join(", ")
            );
            warnings.push(Warning::new("without-partner", message));
        }
    }
    let common: Vec<u64> =
        numbered.first().into_iter().flat_map(|m| m.keys().copied()).filter(everywhere).collect();
    if common.is_empty()
        && let Some(first) = series.first()
    {
        return Err(malformed(
            first.place.clone(),
            "no two names share a number",
            "check the names, or pair by order",
        ));
    }
    Ok(common.iter().map(|n| numbered.iter().map(|m| m[n]).collect()).collect())
}

fn numbers(series: &Series) -> Result<BTreeMap<u64, usize>, Error> {
    let mut map = BTreeMap::new();
    for (i, name) in series.names.iter().enumerate() {
        let number = name.as_deref().and_then(last_number).ok_or_else(|| {
            let what = format!("the {} have no numbers in their names", series.what);
            malformed(
                series.place.clone(),
                what,
                "name them in an id column or file names, or pair by order",
            )
        })?;
        if map.insert(number, i).is_some() {
            let what = format!("two of the {} have number {number}", series.what);
            return Err(malformed(series.place.clone(), what, "rename one of them"));
        }
    }
    Ok(map)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn series(what: &'static str, names: &[&str]) -> Series {
        let names = names.iter().map(|n| Some(n.to_string())).collect();
        Series { what, place: Place::default(), names }
    }

    #[test]
    fn numbers_pair_across_gaps_and_say_what_is_left_out() {
        let (poses, images) =
            (series("poses", &["1", "2", "3"]), series("images", &["img_3", "img_1"]));
        let mut warnings = vec![];
        let pairs = pair(&[poses, images], Pairing::Number, &mut warnings).unwrap();
        assert_eq!(pairs, [[0, 1], [2, 0]]);
        assert_eq!(warnings.len(), 1);
        assert!(warnings[0].message.contains("poses with number 2 have no partner"));
    }
}
