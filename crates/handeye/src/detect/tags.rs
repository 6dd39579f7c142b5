//! Boards of tags: grids of markers, and AprilGrids.
//!
//! All tags in the image are read one by one. Which of them are the board's, their places say: from
//! a tag the next ones are predicted by the homography of the nearest, and those that are where they
//! should be belong together. The largest such group is the board; what the others read does not
//! count. Tags of the board that were not read are looked for where they should be. A tag that stands
//! alone must be read better than chance allows.

use std::collections::BTreeMap;

use nalgebra::{Matrix2, Vector2};

use super::{
    fits::sorted,
    homography,
    tag::{Level, Levels, Print, Quad, SeenTag, without_copies},
    view::{Sighting, View},
};
use crate::{
    GrayImage, ImageCorner, TargetModel,
    detect::outcome::{NotFound, Outcome},
    model::target::{
        kinds::PlacedTag,
        look::{Look, Tags},
    },
};

/// A tag belongs to a group when its corners are this near to where they should be, in its sides:
/// the next tag is more than one side away.
const NEAR: f64 = 0.3;
/// Measured corners must be this near to where the nearest tags say, in the tag's sides.
const IN_PLACE: f64 = 0.1;
/// Variance of corners before the lens is known, px².
const ROUGHLY_PX2: f64 = 0.01;
/// Fewer tags do not tell how the lens bends their sides.
const FEWEST_FOR_LENS: usize = 4;
/// Tags that predict another one.
const NEIGHBOURS: usize = 4;
/// Tags are beside one another at this distance, in steps of the board: as far as across a corner.
const BESIDE: f64 = 1.5;
/// Most tags that are read in an image beyond those of the board: the others are chance.
const MOST_OTHERS: usize = 100;
/// Most groups that are tried.
const MOST_GROUPS: usize = 20;
/// A tag that stands alone must be less likely than this to be read by chance in some dark square.
const CHANCE: f64 = 1e-5;

/// A board of tags.
pub(super) struct Board<'a> {
    target: &'a TargetModel,
    print: Print,
    tags: BTreeMap<u32, PlacedTag>,
    /// Distance between neighbouring tags, m.
    step: f64,
    name: String,
}

/// Tags of the board by their markers, px in the original.
type Group = BTreeMap<u32, SeenTag>;

impl<'a> Board<'a> {
    /// `None` for targets of other kinds.
    pub fn of(target: &'a TargetModel) -> Option<Result<Self, NotFound>> {
        match target.look() {
            Look::Tags(tags) => Some(Self::new(target, &tags)),
            Look::Squares
            | Look::MarkedSquares(_)
            | Look::Tag { .. }
            | Look::Circles(_)
            | Look::Ball => None,
        }
    }

    /// The board of such tags.
    pub fn new(target: &'a TargetModel, look: &Tags) -> Result<Self, NotFound> {
        let tags = target.tags().into_iter().map(|tag| (tag.marker, tag)).collect();
        let border = look.border_bits as usize;
        Ok(Self {
            target,
            print: Print::new(&look.dictionary, border, Some(look.gap), look.joined)?,
            tags,
            step: target.pitch_m() * (1.0 + look.gap),
            name: look.dictionary.clone(),
        })
    }

    /// The corners of all tags that are found.
    pub fn detect(&self, image: &GrayImage) -> Outcome {
        let levels = Levels::new(image);
        let corners = self.search(&levels, |level, group| self.corners(level, image, group));
        let corners = corners.ok_or_else(|| NotFound::NoTags { dictionary: self.name.clone() })?;
        if corners.is_empty() {
            return Err(NotFound::TooFew { found: 0, needed: self.target.len() });
        }
        Ok(sorted(corners))
    }

    /// The tags of the board that are found, their corners to about a pixel, by corner ids; and
    /// their sides, px.
    pub(crate) fn rough(&self, image: &GrayImage) -> BTreeMap<u32, (Vector2<f64>, f64)> {
        let corners = |tag: &SeenTag| {
            let side = tag.area().sqrt();
            self.tags[&tag.id].corners.into_iter().zip(tag.quad.map(|pixel| (pixel, side)))
        };
        let found =
            self.search(&Levels::new(image), |_, group| group.values().flat_map(corners).collect());
        found.unwrap_or_default()
    }

    /// What becomes of the group in the smallest image that shows one; a tag alone counts when no
    /// image shows more.
    fn search<T>(&self, levels: &Levels, then: impl Fn(&Level, &Group) -> T) -> Option<T> {
        let mut alone = None;
        let found = levels.search(|level, clear| {
            let group = self.group(level, clear)?;
            let found = then(level, &group);
            if group.len() == 1 && self.tags.len() > 1 {
                alone.get_or_insert(found);
                return None;
            }
            Some(found)
        });
        found.or(alone)
    }

    /// The board's tags in one image: at least two, or one that is beyond doubt.
    fn group(&self, level: &Level, clear: &GrayImage) -> Option<Group> {
        let mut seen = self.print.read_all(level.image(), clear, self.tags.keys().copied());
        seen.sort_by(|a, b| a.errors.cmp(&b.errors).then(b.area().total_cmp(&a.area())));
        let mut seen = without_copies(&seen);
        seen.truncate(self.tags.len() + MOST_OTHERS);
        for tag in &mut seen {
            tag.quad = level.approached(&tag.quad, &self.print);
        }
        let mut groups = self.groups(&seen);
        let largest = groups.iter().map(BTreeMap::len).max()?;
        if largest == 1 {
            groups.retain(|group| group.values().all(|tag| self.beyond_chance(tag)));
            return if groups.len() == 1 { groups.pop() } else { None };
        }
        let mut group = groups.into_iter().find(|group| group.len() == largest)?;
        self.complete(level, &mut group);
        Some(group)
    }

    /// Tags that are where they should be, seen from one another; larger groups of equal numbers of
    /// tags come from the best tags and come first.
    fn groups(&self, seen: &[SeenTag]) -> Vec<Group> {
        let mut groups: Vec<Group> = vec![];
        for seed in seen {
            let taken = groups.iter().any(|g| g.get(&seed.id).is_some_and(|t| t == seed));
            if !taken && groups.len() < MOST_GROUPS {
                groups.push(self.grown(*seed, seen));
            }
        }
        groups
    }

    /// The group of one tag: the nearest one that fits comes next.
    fn grown(&self, seed: SeenTag, seen: &[SeenTag]) -> Group {
        let mut group = Group::from([(seed.id, seed)]);
        let mut others: Vec<(f64, &SeenTag)> =
            seen.iter().map(|tag| (self.distance(seed.id, tag.id), tag)).collect();
        loop {
            others.retain(|(_, tag)| !group.contains_key(&tag.id));
            others.sort_by(|a, b| a.0.total_cmp(&b.0));
            let fits =
                |tag: &SeenTag| self.off(&group, tag.id, &tag.quad).is_some_and(|off| off < NEAR);
            let Some(next) = others.iter().map(|(_, tag)| *tag).find(|tag| fits(tag)) else {
                return group;
            };
            group.insert(next.id, *next);
            for (nearest, tag) in &mut others {
                *nearest = nearest.min(self.distance(next.id, tag.id));
            }
        }
    }

    /// Distance between two tags on the board, m.
    fn distance(&self, a: u32, b: u32) -> f64 {
        (self.tags[&a].top_left - self.tags[&b].top_left).norm()
    }

    /// The largest distance of a tag's corners from where the group says they are, in its sides.
    fn off(&self, group: &Group, id: u32, quad: &Quad) -> Option<f64> {
        let wanted = self.predicted(group, id)?;
        let area = SeenTag { id, errors: 0, quad: *quad }.area();
        let off = quad.iter().zip(&wanted).map(|(a, b)| (a - b).norm());
        (area > 0.0).then(|| off.fold(0.0, f64::max) / area.sqrt())
    }

    /// Where the nearest tags of a group say that another tag is, px.
    fn predicted(&self, group: &Group, id: u32) -> Option<Quad> {
        let origin = self.tags[&id].top_left;
        let mut near: Vec<(f64, &SeenTag)> = group
            .values()
            .filter(|tag| tag.id != id)
            .map(|tag| (self.distance(tag.id, id), tag))
            .collect();
        near.sort_by(|a, b| a.0.total_cmp(&b.0));
        near.truncate(NEIGHBOURS);
        let from: Vec<Vector2<f64>> =
            near.iter().flat_map(|(_, tag)| self.places(tag.id)).map(|p| p - origin).collect();
        let to: Vec<Vector2<f64>> = near.iter().flat_map(|(_, tag)| tag.quad).collect();
        let h = homography::fit(&from, &to)?;
        let quad = self.places(id).map(|p| homography::apply(&h, &(p - origin)));
        quad.iter().all(|p| p.x.is_finite() && p.y.is_finite()).then_some(quad)
    }

    /// The corners of a tag on the board, as those of its quadrilateral, in metres.
    fn places(&self, id: u32) -> Quad {
        let place =
            |id: u32| self.target.corner(id).map_or_else(Vector2::zeros, |p| p.vector().xy());
        self.tags[&id].corners.map(place)
    }

    /// Adds the tags beside those of the group that can be read where they should be, in this image
    /// or in a larger one.
    fn complete(&self, level: &Level, group: &mut Group) {
        for level in level.and_larger() {
            loop {
                let added = self.beside(&level, group);
                if added.is_empty() {
                    break;
                }
                group.extend(added);
            }
        }
    }

    fn beside(&self, level: &Level, group: &Group) -> Group {
        let beside = |id: u32| group.keys().any(|k| self.distance(*k, id) < BESIDE * self.step);
        let read = |&id: &u32| {
            let quad = level.reduced(&self.predicted(group, id)?);
            let upright = |tag: &SeenTag| tag.quad == quad;
            let tag = self.print.read(level.image(), &quad, [id]).filter(upright)?;
            let quad = level.approached(&tag.quad, &self.print);
            let in_place = self.off(group, id, &quad)? < NEAR;
            in_place.then_some((id, SeenTag { quad, ..tag }))
        };
        let missing = self.tags.keys().filter(|id| !group.contains_key(id) && beside(**id));
        missing.filter_map(read).collect()
    }

    /// Whether a tag is hardly read by chance: `ids × turns × readings × ways to err / codes`.
    fn beyond_chance(&self, tag: &SeenTag) -> bool {
        let bits = self.print.dictionary.side().pow(2) as f64;
        let mut ways = 1.0; // to choose k wrong bits
        let mut sum = 0.0;
        for k in 0..=tag.errors {
            sum += ways;
            ways *= (bits - f64::from(k)) / f64::from(k + 1);
        }
        self.tags.len() as f64 * 4.0 * 2.0 * sum / bits.exp2() < CHANCE
    }

    /// The corners of a group, measured; of tags that are out of place none.
    fn corners(&self, level: &Level, image: &GrayImage, group: &Group) -> Vec<ImageCorner> {
        let nearer = |tag: &SeenTag| SeenTag { quad: level.nearer(&tag.quad, &self.print), ..*tag };
        let near = self.in_place(group.values().map(|tag| (tag.id, nearer(tag))).collect());
        let view = self.view(image, &near);
        let measure = |tag: &SeenTag| {
            let bows = view.as_ref().and_then(|view| self.bows(view, tag.id)).unwrap_or_default();
            Some((tag.id, level.measured(tag, &self.print, bows)?))
        };
        let measured: BTreeMap<u32, [ImageCorner; 4]> = near.values().filter_map(measure).collect();
        let exact = |(id, corners): (&u32, &[ImageCorner; 4])| {
            (*id, SeenTag { quad: corners.each_ref().map(|c| c.pixel), ..near[id] })
        };
        let kept = self.in_place(measured.iter().map(exact).collect());
        let on_board = |id: u32, c: ImageCorner| ImageCorner {
            id: self.tags[&id].corners[c.id as usize],
            ..c
        };
        let whole = kept.keys().flat_map(|id| measured[id].map(|c| on_board(*id, c)));
        let in_part = self.unread(&kept).filter_map(|id| {
            let view = view.as_ref()?;
            let quad = self.seen_by(view, id)?;
            Some((id, level.seen_in_part(&quad, &self.print, self.bows(view, id)?)))
        });
        let in_part =
            in_part.flat_map(|(id, corners)| corners.into_iter().flatten().map(move |c| (id, c)));
        whole.chain(in_part.map(|(id, c)| on_board(id, c))).collect()
    }

    /// The tags of the board that are not in a group.
    fn unread<'b>(&'b self, group: &'b Group) -> impl Iterator<Item = u32> + 'b {
        self.tags.keys().copied().filter(|id| !group.contains_key(id))
    }

    /// Where a view has a tag.
    fn seen_by(&self, view: &View, id: u32) -> Option<Quad> {
        let [a, b, c, d] = self.places(id).map(|p| view.pixel(&(p / self.step)));
        Some([a?, b?, c?, d?])
    }

    /// How the board is seen, lens included, from enough tags.
    fn view(&self, image: &GrayImage, tags: &Group) -> Option<View<'static>> {
        let sighting = |(on_board, pixel): (Vector2<f64>, Vector2<f64>)| Sighting {
            on_board: on_board / self.step,
            pixel,
            covariance: Matrix2::identity() * ROUGHLY_PX2,
        };
        let corners = |tag: &SeenTag| self.places(tag.id).into_iter().zip(tag.quad);
        let sightings: Vec<Sighting> = tags.values().flat_map(corners).map(sighting).collect();
        let enough = tags.len() >= FEWEST_FOR_LENS;
        enough.then(|| View::fit(&sightings, (image.width(), image.height()), None)).flatten()
    }

    /// How far the lens moves the middles of a tag's sides outwards, px.
    fn bows(&self, view: &View, id: u32) -> Option<[f64; 4]> {
        let places = self.places(id).map(|p| p / self.step);
        let bow = |k: usize| {
            let (a, b) = (places[k], places[(k + 1) % 4]);
            let (start, end) = (view.pixel(&a)?, view.pixel(&b)?);
            let along = (end - start).normalize();
            Some(Vector2::new(along.y, -along.x).dot(&(view.pixel(&((a + b) * 0.5))? - start)))
        };
        Some([bow(0)?, bow(1)?, bow(2)?, bow(3)?])
    }

    /// Tags but for those that are not where the others say. One alone is, but of two that
    /// contradict each other none.
    fn in_place(&self, mut tags: Group) -> Group {
        let alone = tags.len() == 1;
        while !alone && let Some(worst) = self.out_of_place(&tags) {
            tags.remove(&worst);
        }
        tags
    }

    /// The tag that is farthest from where the others say, if that is too far.
    fn out_of_place(&self, tags: &Group) -> Option<u32> {
        let off =
            |tag: &SeenTag| (self.off(tags, tag.id, &tag.quad).unwrap_or(f64::INFINITY), tag.id);
        let worst = tags.values().map(off).max_by(|a, b| a.0.total_cmp(&b.0))?;
        (!(worst.0 < IN_PLACE)).then_some(worst.1)
    }
}

#[cfg(test)]
mod tests;
