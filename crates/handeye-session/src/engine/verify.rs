//! Views and touches that verify the captures: the answer is not made with them, and should predict them as well as its own.

use handeye::{Base, Flange, Pose, model::residual::Residual, tools::held_out::HeldOutTest};
use handeye_io::{StoredCapture, StoredTouch};

use super::{
    Engine, Refusal, Step,
    obey::later,
    say::{Proof, capitalised, contradiction, proof},
    shown::{TouchShown, TouchView, VerifyShown, VerifyView},
    taking::{ELSEWHERE, KNOWN},
    touch::WHERE_IS_THE_TIP,
};
use crate::assess::TouchTest;

impl Engine {
    /// Whether images are taken in this step.
    pub(super) fn takes_captures(&self) -> bool {
        matches!(self.step, Step::Capture | Step::Verify)
    }

    /// Whether there is something to verify.
    pub(super) fn may_verify(&self) -> Result<(), Refusal> {
        let known = self.assessed.as_ref().is_some_and(|assessed| {
            let result = &assessed.calibration;
            result.hand_eye.mount_from_camera.is_some()
                && result.captures.iter().filter(|c| c.used).count() >= KNOWN
        });
        match known || self.has_verification() {
            true => Ok(()),
            false => {
                Err(later("first captures are taken until they determine the transform".into()))
            }
        }
    }

    fn touches_that_verify(&self) -> impl Iterator<Item = &StoredTouch> {
        self.folder.touches.iter().filter(|touch| touch.verifies)
    }

    /// Whether there are views or touches that verify.
    fn has_verification(&self) -> bool {
        !self.folder.verification.is_empty() || self.touches_that_verify().next().is_some()
    }

    /// What the views say, where they were assessed, or why they say nothing.
    fn verification(&self) -> Option<&Result<HeldOutTest, String>> {
        self.assessed.as_ref().filter(|_| !self.assessing)?.verification.as_ref()
    }

    /// What the touches say likewise.
    fn touch_test(&self) -> Option<&Result<TouchTest, String>> {
        self.assessed.as_ref().filter(|_| !self.assessing)?.touch_test.as_ref()
    }

    /// Why views and touches do not verify the captures.
    pub(super) fn not_verified(&self) -> Option<String> {
        let views = match self.verification() {
            Some(Ok(test)) => (!test.agrees()).then(|| against(test)),
            Some(Err(why)) => Some(not_assessed(why)),
            None if self.assessed.is_none() && self.has_verification() => {
                Some(not_assessed("the captures cannot be assessed"))
            }
            None => None,
        };
        let touches = || match self.touch_test()? {
            Ok(test) => (!test.agrees()).then(|| self.touches_against(test)),
            Err(why) => Some(format!(
                "not verified: the touches cannot be assessed: {why}. Delete them, and touch again"
            )),
        };
        views.or_else(touches)
    }

    fn touches_against(&self, test: &TouchTest) -> String {
        if let (true, Some(offset)) = (test.found.is_shifted(), &test.found.offset) {
            let mm = offset.mean * 1e3;
            return format!(
                "not verified: at all touches the tip was off by about the same, ({:.1}, {:.1}, {:.1}) mm in the base: the tip is elsewhere in the flange than declared, or camera or board were moved since the captures. Measure the tip, delete these touches, and touch again; if something was moved, begin a new session",
                mm.x, mm.y, mm.z
            );
        }
        let off = |touch: &&StoredTouch| test.distance_mm(&touch.id).unwrap_or(0.0);
        let worst = self.touches_that_verify().max_by(|a, b| off(a).total_cmp(&off(b)));
        let (corner, mm) = worst.map_or((0, 0.0), |touch| (touch.corner, off(&touch)));
        format!(
            "not verified: at corner {corner} the tip was {mm:.2} mm from where the calibration predicts it, and {:.2} mm (RMS) are expected. Was it this corner, and did the tip slip? Then delete the touch. If not, camera or board were moved since the captures, or the robot errs there: do not use the result",
            test.expected_mm
        )
    }

    /// Whether views and touches agree; what cannot be assessed does not.
    fn agrees(&self) -> Option<bool> {
        let views = self.verification().map(|found| found.as_ref().ok().map(HeldOutTest::agrees));
        let touches = self.touch_test().map(|found| found.as_ref().ok().map(TouchTest::agrees));
        let each = [views, touches].into_iter().flatten();
        match each.clone().any(|agrees| agrees == Some(false)) {
            true => Some(false),
            false => each.reduce(Option::and).flatten(),
        }
    }

    /// What verifies the captures, in words; `None` where nothing does yet.
    fn agreement(&self) -> Option<String> {
        let views = self.verification().and_then(|found| found.as_ref().ok()).map(agreement);
        let touches = self.touch_test().and_then(|found| found.as_ref().ok());
        match (views, touches) {
            (Some(views), Some(test)) => Some(format!("{views}; {}", touched(test))),
            (None, Some(test)) => Some(format!("verified {}", touched(test))),
            (views, None) => views,
        }
    }

    pub(super) fn verify_proof(&self) -> Proof {
        if !self.has_verification() {
            return proof(
                false,
                "no view has been taken and no corner touched that verifies the captures",
            );
        }
        match (self.not_verified(), self.agreement()) {
            (Some(why), _) => proof(false, why),
            (None, Some(agreement)) if !self.assessing => proof(true, agreement),
            (None, _) => proof(false, "views and touches are being assessed"),
        }
    }

    /// The touches that verify, and how far they are from where they were predicted.
    pub(super) fn verifying_touches(&self) -> Vec<TouchShown> {
        let test = self.touch_test().and_then(|found| found.as_ref().ok());
        let shown = self.touches_that_verify().map(|touch| TouchShown {
            id: touch.id.clone(),
            placement: touch.placement.clone(),
            corner: touch.corner,
            residual_mm: test.and_then(|test| test.distance_mm(&touch.id)),
            used: true,
        });
        shown.collect()
    }

    /// Why the view that would be taken now says nothing new: the robot is where another one was taken, and the image is as
    /// it was there.
    pub(super) fn view_of_another(&self, here: &Pose<Base, Flange>) -> Option<String> {
        let all = self.folder.captures.iter().chain(&self.folder.verification);
        let near =
            |c: &&StoredCapture| Residual::between(&c.base_from_flange, here).is_within(ELSEWHERE);
        let other = { all }.find(near)?;
        Some(format!(
            "the robot is where {} was taken: a view from another pose verifies more",
            other.id
        ))
    }

    pub(super) fn say_verify(&self) -> String {
        if let Err(why) = self.may_verify() {
            return format!("{}.", capitalised(&why.message));
        }
        if let Some(busy) = self.say_busy() {
            return busy;
        }
        if let Some(why) = self.not_verified() {
            return format!("{}.", capitalised(&why));
        }
        let Some(assessed) = &self.assessed else {
            return "The captures cannot be assessed.".into();
        };
        if let Some(why) = assessed.contradiction() {
            return contradiction(why, self.folder.captures.len());
        }
        if let Some(agreement) = self.agreement() {
            return and_go_on(&agreement);
        }
        match &assessed.next {
            Some(next) if self.is_at(next) => "The robot is at the view: take it.".into(),
            Some(_) => "Drive to the view that is shown, or to where the robot will work, and take it: the calibration is not made with it.".into(),
            None => "Drive to where the robot will work, with the whole board in the image, and take the view: the calibration is not made with it.".into(),
        }
    }

    /// What to do next for whoever verifies by touches.
    fn say_touching(&self, view: &TouchView) -> String {
        if let Some(busy) = self.say_busy() {
            return busy;
        }
        if let Some(why) = self.not_verified() {
            return format!("{}.", capitalised(&why));
        }
        let assessed = self.assessed.as_ref();
        if let Some(why) = assessed.and_then(|assessed| assessed.contradiction()) {
            return contradiction(why, self.folder.captures.len());
        }
        match (view.tip_mm, self.agreement(), self.say_laying(true)) {
            (None, ..) => WHERE_IS_THE_TIP.into(),
            (_, Some(agreement), _) => and_go_on(&agreement),
            (_, None, Some(lay)) => lay.into(),
            (_, None, None) => {
                format!("Bring the tip to corner {} of the board, and touch it.", view.corner)
            }
        }
    }

    /// What is added to the sentence on the result.
    pub(super) fn verified(&self) -> String {
        self.agreement().map_or(String::new(), |agreement| format!("; {agreement}"))
    }

    /// What is shown of views and touches; `None` where none can be taken.
    pub(super) fn verify_view(&self) -> Option<VerifyView> {
        self.may_verify().ok()?;
        let test = self.verification().and_then(|found| found.as_ref().ok());
        let touch_test = self.touch_test().and_then(|found| found.as_ref().ok());
        let of = |id: &str| test?.views.iter().find(|view| view.id == id);
        let shown = self.folder.verification.iter().map(|view| VerifyShown {
            id: view.id.clone(),
            distance_mm: of(&view.id).map(|found| found.distance_mm),
            angle_deg: of(&view.id).map(|found| found.angle_deg),
        });
        let touch = self.touch_view(true);
        Some(VerifyView {
            say_touch: touch.as_ref().map(|view| self.say_touching(view)),
            views: shown.collect(),
            rms_mm: test.map(|test| test.rms_mm),
            expected_mm: test.map(|test| test.expected_mm),
            agrees: self.agrees(),
            touch,
            touches_expected_mm: touch_test.map(|test| test.expected_mm),
        })
    }
}

fn and_go_on(agreement: &str) -> String {
    format!(
        "{}. Take another view or touch another corner, best where the robot will work, or finish.",
        capitalised(agreement)
    )
}

fn agreement(test: &HeldOutTest) -> String {
    let HeldOutTest { rms_mm, expected_mm, .. } = test;
    match test.views.len() {
        1 => format!(
            "verified by a view: {rms_mm:.2} mm from its prediction, {expected_mm:.2} mm are expected"
        ),
        count => format!(
            "verified by {count} views: {rms_mm:.2} mm (RMS) from their predictions, {expected_mm:.2} mm are expected"
        ),
    }
}

fn touched(test: &TouchTest) -> String {
    let (rms_mm, expected_mm) = (test.rms_mm(), test.expected_mm);
    match test.ids.len() {
        1 => format!(
            "by a touch: {rms_mm:.2} mm from where the corner is predicted, {expected_mm:.2} mm are expected"
        ),
        count => format!(
            "by {count} touches: {rms_mm:.2} mm (RMS) from where the corners are predicted, {expected_mm:.2} mm are expected"
        ),
    }
}

fn not_assessed(why: &str) -> String {
    format!("not verified: the views cannot be assessed: {why}. Delete them, and take others")
}

fn against(test: &HeldOutTest) -> String {
    let (id, mm) = test.worst().map_or(("", 0.0), |view| (&view.id[..], view.distance_mm));
    format!(
        "not verified: in view {id} the board is {mm:.2} mm from where the calibration predicts it, and {:.2} mm (RMS) are expected: camera or board were moved since the captures, or the robot errs there. If something was moved, begin a new session, and do not use a result that was written before; if not, take captures there, and delete the view if it is wrong itself",
        test.expected_mm
    )
}
