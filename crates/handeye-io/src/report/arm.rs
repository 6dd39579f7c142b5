//! What is wrong with the robot: with its arm, or from place to place.

use std::fmt::Write;

use handeye::{
    Calibration,
    calibrate::result::{ArmDeviation, ArmResult, BlockGain},
    model::kinematics::Parameter,
    quaternion_xyzw,
};

use super::{escape, mm, section};

/// Empty where no arm was examined, or nothing found.
pub(super) fn arm(c: &Calibration) -> String {
    let Some(arm) = &c.arm else { return String::new() };
    let mut content = format!(
        "<p>The arm is not as its model says. With the corrected model the robot's position errs by \
         <b>{:.2} mm</b> per axis instead of {:.2}, and captures that were left out are missed by {} \
         mm instead of {}. The corrected model is <code>corrected_arm.json</code>; a robot that \
         computes with it uses the camera's place below, with a predicted error of {} mm RMS. The \
         answer above is for the robot as it is.</p>",
        arm.robot_after_mm,
        arm.robot_before_mm,
        mm(arm.held_out.after_mm),
        mm(arm.held_out.before_mm),
        mm(arm.predicted_tre_mm),
    );
    let [x, y, z] = (arm.mount_from_camera.translation() * 1e3).into();
    let [i, j, k, w] = quaternion_xyzw(&arm.mount_from_camera.iso().rotation);
    let _ = write!(
        content,
        "<p><code>{}</code> with the corrected model: translation ({x:.3}, {y:.3}, {z:.3}) mm, \
         quaternion {i:.7} {j:.7} {k:.7} {w:.7} (x y z w)</p>",
        c.name
    );
    content += &table(arm);
    section("The arm", "", &content)
}

/// What correcting the robot's poses is worth; empty where it does not err by place.
pub(super) fn correction(c: &Calibration) -> String {
    let Some(found) = &c.compensation else { return String::new() };
    let row = |what: &str, gain: &BlockGain| {
        format!(
            "<tr><td class=\"words\">{what}</td><td>{:.3}</td><td>{:.3}</td><td>{:.0} %</td></tr>",
            gain.rigid_mm,
            gain.corrected_mm,
            100.0 * gain.corrected_mm / gain.rigid_mm
        )
    };
    let rows = row("that lie near one another", &found.by_place)
        + &row("that follow one another", &found.by_time);
    let offer = match c.correction() {
        Ok(_) => "<code>handeye compensate POSES --result calibration.json</code> says where to send the robot, for \
             poses that were computed with the transform above."
            .to_owned(),
        Err(why) => format!("No correction is offered: {}.", escape(&why)),
    };
    let content = format!(
        "<p>This robot's error depends on its pose. What its error is at a place was tried out on captures that were \
         left out in blocks. {offer}</p><table><tr><th class=\"words\">captures left out</th><th>error with the \
         transform alone</th><th>error with poses corrected</th><th></th></tr>{rows}</table><p class=\"note\">mm, root mean square \
         over the points of the target.</p>"
    );
    section("Correcting poses", "", &content)
}

fn table(arm: &ArmResult) -> String {
    let rows: String = arm.deviations.iter().map(row).collect();
    format!(
        "<table><tr><th>joint</th><th class=\"words\">parameter</th><th>found minus given</th>\
         <th>&plusmn;</th><th class=\"words\"></th></tr>{rows}</table>\
         <p class=\"note\">Angles in degrees, lengths in mm. What views and touches do not tell \
         stays near the model.</p>"
    )
}

fn row(d: &ArmDeviation) -> String {
    let name = match d.parameter {
        Parameter::ThetaOffset => "zero of the joint",
        Parameter::D => "d, along the axis",
        Parameter::A => "a, length of the link",
        Parameter::Alpha => "alpha, turn of the link about x",
        Parameter::Beta => "beta, turn of the link about y",
    };
    let unit = if d.parameter.is_angle() { "&deg;" } else { " mm" };
    let known = if d.observed { "" } else { "not observable" };
    format!(
        "<tr><td>{}</td><td class=\"words\">{name}</td><td>{:+.3}{unit}</td><td>{:.3}</td>\
         <td class=\"words\">{known}</td></tr>",
        d.joint, d.value, d.sigma
    )
}
