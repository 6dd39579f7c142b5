//! Which topics of a bag are the images, the scans and the camera.

use std::path::Path;

use super::{
    messages::CameraInfo,
    survey::{CLOUD, COMPRESSED, IMAGE, Survey, Topic},
};
use crate::error::{Error, unusable};

/// What a bag's images and scans are.
#[derive(Debug, Clone, Default, PartialEq)]
pub(super) struct Chosen {
    pub(super) image: Option<String>,
    pub(super) scan: Option<String>,
    /// Topics of the cameras of both.
    pub(super) image_camera: Option<String>,
    pub(super) scan_camera: Option<String>,
    pub(super) notes: Vec<String>,
}

/// Names that the user gave.
#[derive(Debug, Clone, Default)]
pub(super) struct Asked<'a> {
    pub(super) image: Option<&'a str>,
    pub(super) scan: Option<&'a str>,
    pub(super) camera: Option<&'a str>,
}

fn is_depth(topic: &Topic) -> bool {
    let shape = topic.shape.as_deref().unwrap_or_default();
    let depth = ["16UC1", "32FC1", "compressedDepth"].iter().any(|e| shape.contains(e));
    topic.kind == CLOUD || depth && [IMAGE, COMPRESSED].contains(&topic.kind.as_str())
}

fn is_picture(topic: &Topic) -> bool {
    [IMAGE, COMPRESSED].contains(&topic.kind.as_str()) && !is_depth(topic)
}

pub(super) fn choose(survey: &Survey, asked: &Asked, bag: &Path) -> Result<Chosen, Error> {
    let mut chosen = Chosen { image: image(survey, asked.image, bag)?, ..Chosen::default() };
    chosen.scan = match asked.scan {
        None if chosen.image.as_ref().is_some_and(|i| is_depth(&survey.topics[i])) => None,
        Some(name) => Some(scan(survey, name, &chosen, bag)?),
        None => scan_beside(survey, &mut chosen),
    };
    if chosen.image.is_none() && chosen.scan.is_none() {
        return Err(unusable(
            bag,
            format!("has neither images nor scans: {}", listed(survey, |_| true)),
        ));
    }
    if let Some(name) = asked.camera.filter(|name| !survey.cameras.contains_key(*name)) {
        let known = listed(survey, |t| t.kind == "sensor_msgs/CameraInfo");
        return Err(unusable(bag, format!("has no sensor_msgs/CameraInfo on {name}: {known}")));
    }
    let camera = |topic: &String| camera_beside(survey, topic.as_str());
    chosen.image_camera =
        asked.camera.map(String::from).or_else(|| chosen.image.as_ref().and_then(camera));
    chosen.scan_camera = chosen.scan.as_ref().and_then(camera);
    let leading = chosen.image.as_ref().or(chosen.scan.as_ref());
    if let Some(leading) =
        leading.filter(|_| chosen.image_camera.is_none() && chosen.scan_camera.is_none())
    {
        let known = survey.cameras.keys().map(String::as_str).collect::<Vec<_>>().join(", ");
        if !known.is_empty() {
            chosen.notes.push(format!(
                "no camera_info lies beside {leading} in its frame; --camera-info takes one of: {known}"
            ));
        }
    }
    Ok(chosen)
}

/// The topic of images that was asked for, or the only one; of one camera, raw before packed.
fn image(survey: &Survey, asked: Option<&str>, bag: &Path) -> Result<Option<String>, Error> {
    let all: Vec<&String> =
        survey.topics.iter().filter(|(_, t)| is_picture(t)).map(|(name, _)| name).collect();
    if let Some(name) = asked {
        return match survey.topics.get(name) {
            // images of 16 bits look like depth: here somebody says what they are
            Some(topic) if [IMAGE, COMPRESSED].contains(&topic.kind.as_str()) => {
                Ok(Some(name.into()))
            }
            Some(topic) => Err(unusable(bag, format!("{name} holds {}, no images", topic.kind))),
            None => Err(unusable(
                bag,
                format!("has no topic {name}; images are on {}", listed(survey, is_picture)),
            )),
        };
    }
    let single: Vec<&&String> = all.iter().filter(|name| !is_packed(name, &all)).collect();
    match single[..] {
        [] => Ok(None),
        [one] => Ok(Some((*one).clone())),
        _ => Err(unusable(
            bag,
            format!(
                "has images on several topics: say which (--image TOPIC): {}",
                listed(survey, is_picture)
            ),
        )),
    }
}

/// Whether a topic is another one packed: `.../image_raw/compressed` beside `.../image_raw`.
fn is_packed(name: &str, all: &[&String]) -> bool {
    all.iter().any(|raw| name.strip_prefix(raw.as_str()).is_some_and(|rest| rest.starts_with('/')))
}

/// A scan counts in the frame of the images.
fn scan(survey: &Survey, name: &str, chosen: &Chosen, bag: &Path) -> Result<String, Error> {
    let Some(topic) = survey.topics.get(name).filter(|t| is_depth(t)) else {
        return Err(unusable(
            bag,
            format!("has no depth images or clouds on {name}: {}", listed(survey, is_depth)),
        ));
    };
    let image = chosen.image.as_ref().and_then(|i| survey.topics.get(i));
    if let Some(image) = image.filter(|image| image.frame != topic.frame) {
        let frame = |t: &Topic| t.frame.clone().unwrap_or_default();
        let what = format!(
            "{name} counts in the frame {}, the images in {}: take depth that the driver has aligned to the \
             images, or images of the depth camera itself (--image)",
            frame(topic),
            frame(image)
        );
        return Err(unusable(bag, what));
    }
    Ok(name.into())
}

/// The only depth in the frame of the images; clouds before depth images.
fn scan_beside(survey: &Survey, chosen: &mut Chosen) -> Option<String> {
    let frame = match &chosen.image {
        Some(image) => Some(&survey.topics.get(image)?.frame),
        None => None,
    };
    let depth: Vec<&String> =
        survey.topics.iter().filter(|(_, t)| is_depth(t)).map(|(name, _)| name).collect();
    let all = survey.topics.iter().filter(|(name, t)| is_depth(t) && !is_packed(name, &depth));
    let (near, far): (Vec<_>, Vec<_>) = all.partition(|(_, t)| frame.is_none_or(|f| t.frame == *f));
    if !far.is_empty() {
        let names: Vec<&str> = far.iter().map(|(name, _)| name.as_str()).collect();
        chosen.notes.push(format!(
            "not used, for it counts in another frame than the images: {}",
            names.join(", ")
        ));
    }
    let clouds: Vec<_> = near.iter().filter(|(_, t)| t.kind == CLOUD).collect();
    let one = match (&clouds[..], &near[..]) {
        ([one], _) => one.0,
        (_, [one]) => one.0,
        (_, []) => return None,
        (_, several) => {
            let names: Vec<&str> = several.iter().map(|(name, _)| name.as_str()).collect();
            chosen.notes.push(format!(
                "not used, for there are several (--depth TOPIC takes one): {}",
                names.join(", ")
            ));
            return None;
        }
    };
    Some(one.clone())
}

/// The camera's topic beside one of its images: the nearest `camera_info` upwards of the same frame.
fn camera_beside(survey: &Survey, topic: &str) -> Option<String> {
    let frame = survey.topics.get(topic)?.frame.clone().unwrap_or_default();
    let mut above = topic;
    while let Some(end) = above.rfind('/') {
        above = &above[..end];
        let name = format!("{above}/camera_info");
        let fits =
            |info: &CameraInfo| info.frame.is_empty() || frame.is_empty() || info.frame == frame;
        if survey.cameras.get(&name).is_some_and(fits) {
            return Some(name);
        }
    }
    None
}

pub(super) fn listed(survey: &Survey, wanted: impl Fn(&Topic) -> bool) -> String {
    let one = |(name, t): (&String, &Topic)| {
        let shape = t.shape.as_ref().map_or(String::new(), |s| format!(", {s}"));
        format!("{name} ({}{shape})", t.kind)
    };
    let all: Vec<String> = survey.topics.iter().filter(|(_, t)| wanted(t)).map(one).collect();
    if all.is_empty() { "there are none".into() } else { all.join(", ") }
}
