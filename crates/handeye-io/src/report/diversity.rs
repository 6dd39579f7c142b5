//! Whether the poses differ enough, and what was found of target and camera along with them.

use std::fmt::Write;

use handeye::Calibration;

use super::{has_board, plot, section};

pub(super) fn diversity(c: &Calibration) -> String {
    let mut content = String::new();
    if let Some(d) = &c.diversity {
        let _ = write!(
            content,
            "<p>{} captures; the largest rotation between two is {:.0} degrees; the robot travelled {:.0} x {:.0} x {:.0} mm.</p>{}\
             <p class=\"note\">Rotations about one axis only leave the position along it free. The second bar should be above 0.05.</p>",
            d.captures,
            d.largest_rotation_deg,
            d.travel_mm[0],
            d.travel_mm[1],
            d.travel_mm[2],
            plot::shares(&[
                ("first axis", d.axis_spread[0]),
                ("second axis", d.axis_spread[1]),
                ("third axis", d.axis_spread[2])
            ]),
        );
    }
    if let Some(s) = &c.target_scale {
        let (what, of) = match has_board(c) {
            true => ("Size of the target as the robot's motions see it", "the declared one"),
            false => ("Distances as the robot's motions see them", "those in the scans"),
        };
        let _ = write!(
            content,
            "<p class=\"note\">{what}: {:.4} &plusmn; {:.4} of {of}.</p>",
            s.value, s.sigma
        );
    }
    if let Some(k) = &c.camera {
        let _ = write!(
            content,
            "<p class=\"note\">Camera, found along with the poses: fx {:.2} &plusmn; {:.2}, fy {:.2} &plusmn; {:.2}, \
             cx {:.2} &plusmn; {:.2}, cy {:.2} &plusmn; {:.2} px.</p>",
            k.intrinsics.fx,
            k.sigma_fx,
            k.intrinsics.fy,
            k.sigma_fy,
            k.intrinsics.cx,
            k.sigma_cx,
            k.intrinsics.cy,
            k.sigma_cy
        );
    }
    if content.is_empty() { content } else { section("Poses", "", &content) }
}
