//! A cause with what it also looks like: said once, and not once more as if each were a fault of its own.

use super::{Finding, Found, row::Row};

/// What a cause can look like beside itself.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
#[non_exhaustive]
pub enum Effect {
    /// The intrinsics seem to be others than those given.
    Intrinsics,
    /// The depth of scans seems off.
    Depth,
    /// Scans seem larger or smaller than images say.
    Scale,
    /// Scans seem rotated against images.
    Tilt,
    /// Scans seem shifted against images.
    Shift,
}

impl Effect {
    /// In words beside its cause.
    fn in_words(self) -> &'static str {
        match self {
            Self::Intrinsics => "other intrinsics than the given ones",
            Self::Depth => "depth that is off",
            Self::Scale => "scans of another scale than images",
            Self::Tilt => "scans rotated against images",
            Self::Shift => "scans shifted against images",
        }
    }
}

/// A cause, and what it explains. Code, headline and numbers are those of the cause.
#[derive(Debug, Clone, PartialEq)]
pub struct CombinedFinding {
    /// The cause.
    pub cause: Box<Finding>,
    /// What follows from it.
    pub effects: Vec<Effect>,
}

impl Found for CombinedFinding {
    fn row(&self) -> &'static Row {
        self.cause.found().row()
    }

    fn message(&self) -> String {
        let words: Vec<&str> = self.effects.iter().map(|effect| effect.in_words()).collect();
        format!(
            "{}; it also looks like {}, no farther off than this explains, and the answer takes that into account: correct \
             this first",
            self.cause.message(),
            words.join(" and ")
        )
    }

    fn data(&self) -> Vec<(&'static str, f64)> {
        self.cause.found().data()
    }

    fn headline(&self) -> Option<String> {
        self.cause.headline()
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::findings::TargetFinding;

    #[test]
    fn effects_are_said_with_their_cause() {
        let bent = TargetFinding::NotFlat { captures: 9, peak_to_valley_mm: 1.2, sigma_mm: 0.1 };
        let cause = Finding::from(bent);
        let effects = vec![Effect::Tilt, Effect::Shift];
        let both = Finding::from(CombinedFinding { cause: cause.clone().into(), effects });
        let words =
            "it also looks like scans rotated against images and scans shifted against images";
        assert!(both.message().starts_with(&cause.message()) && both.message().contains(words));
        assert_eq!((both.code(), both.data()), (cause.code(), cause.data()));
    }
}
