//! Touched corners: in the form that the joint fit takes ([`touched_boards`]), those that name another corner
//! ([`touch_outliers`]), and the fit of images and touches together ([`views_and_touches`]).

pub(crate) mod touch_outliers;
pub(crate) mod touched_boards;
pub(crate) mod views_and_touches;
