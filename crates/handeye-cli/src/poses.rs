//! Files of robot poses, as flags describe them.

use handeye_io::RobotFile;

use crate::{args::PosesArgs, failure::Failure};

/// The flags, as a manifest's `[robot]` would have them.
pub fn described(args: &PosesArgs) -> Result<RobotFile, Failure> {
    let own = args.poses.extension().is_some_and(|e| e == "toml");
    if !own && args.notation.is_none() {
        return Err(Failure::Usage(
            "--notation is missing: how are the poses written? (ur, kuka, abb, matrix4x4, \
             quaternion-xyzw, euler-xyz-extrinsic, ...)"
                .into(),
        ));
    }
    if !own && args.direction.is_none() {
        return Err(Failure::Usage(
            "--direction is missing: do the poses take points of the flange into the base \
             (base_from_flange: where the flange is, what controllers show) or the other way \
             (flange_from_base)?"
                .into(),
        ));
    }
    let mut keys = Vec::new();
    for (key, value) in [
        ("notation", &args.notation),
        ("direction", &args.direction),
        ("length_unit", &args.length_unit),
        ("angle_unit", &args.angle_unit),
        ("rows", &args.rows),
    ] {
        keys.extend(value.clone().map(|v| (key, v.into())));
    }
    if !args.field.is_empty() {
        keys.push(("field", args.field.clone().into()));
    }
    if !args.columns.is_empty() {
        keys.push(("columns", handeye_io::columns(&args.columns)));
    }
    if args.skip_header > 0 {
        keys.push(("skip_header", i64::from(args.skip_header).into()));
    }
    Ok(RobotFile { poses: args.poses.clone(), keys })
}
