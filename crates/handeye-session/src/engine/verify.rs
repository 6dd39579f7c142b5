//! Views that verify the captures: the answer is not made with them, and should predict them as well as its own.

use handeye::{Base, Flange, Pose, model::residual::Residual, tools::held_out::HeldOutTest};
use handeye_io::StoredCapture;

use super::{
    Engine, Refusal, Step,
    obey::later,
    say::{Proof, capitalised, contradiction, proof},
    shown::{VerifyShown, VerifyView},
    taking::{ELSEWHERE, KNOWN},
};

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
        match known || !self.folder.verification.is_empty() {
            true => Ok(()),
            false => {
                Err(later("first captures are taken until they determine the transform".into()))
            }
        }
    }

    /// What the views say, where they were assessed, or why they say nothing.
    fn verification(&self) -> Option<&Result<HeldOutTest, String>> {
        self.assessed.as_ref().filter(|_| !self.assessing)?.verification.as_ref()
    }

    /// Why the views do not verify the captures.
    pub(super) fn not_verified(&self) -> Option<String> {
        match self.verification() {
            Some(Ok(test)) => (!test.agrees()).then(|| against(test)),
            Some(Err(why)) => Some(not_assessed(why)),
            None if self.assessed.is_none() && !self.folder.verification.is_empty() => {
                Some(not_assessed("the captures cannot be assessed"))
            }
            None => None,
        }
    }

    pub(super) fn verify_proof(&self) -> Proof {
        if self.folder.verification.is_empty() {
            return proof(false, "no view has been taken that verifies the captures");
        }
        match (self.not_verified(), self.verification()) {
            (Some(why), _) => proof(false, why),
            (None, Some(Ok(test))) => proof(true, agreement(test)),
            (None, _) => proof(false, "the views are being assessed"),
        }
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
        if let Some(Ok(test)) = &assessed.verification {
            return format!(
                "{}. Take another one, best where the robot will work, or finish.",
                capitalised(&agreement(test))
            );
        }
        match &assessed.next {
            Some(next) if self.is_at(next) => "The robot is at the view: take it.".into(),
            Some(_) => "Drive to the view that is shown, or to where the robot will work, and take it: the calibration is not made with it.".into(),
            None => "Drive to where the robot will work, with the whole board in the image, and take the view: the calibration is not made with it.".into(),
        }
    }

    /// What is added to the sentence on the result.
    pub(super) fn verified(&self) -> String {
        match self.verification() {
            Some(Ok(test)) => format!("; {}", agreement(test)),
            _ => String::new(),
        }
    }

    /// What is shown of the views; `None` where none can be taken.
    pub(super) fn verify_view(&self) -> Option<VerifyView> {
        self.may_verify().ok()?;
        let test = self.verification().and_then(|found| found.as_ref().ok());
        let of = |id: &str| test?.views.iter().find(|view| view.id == id);
        let shown = self.folder.verification.iter().map(|view| VerifyShown {
            id: view.id.clone(),
            distance_mm: of(&view.id).map(|found| found.distance_mm),
            angle_deg: of(&view.id).map(|found| found.angle_deg),
        });
        Some(VerifyView {
            views: shown.collect(),
            rms_mm: test.map(|test| test.rms_mm),
            expected_mm: test.map(|test| test.expected_mm),
            agrees: test.map(HeldOutTest::agrees),
        })
    }
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
