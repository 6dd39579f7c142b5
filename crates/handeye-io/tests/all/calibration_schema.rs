//! The published JSON Schema of calibration.json names the keys that are written.

use std::{
    collections::{BTreeMap, BTreeSet},
    fs,
};

use handeye::{
    Calibration, Distortion, HandEye, Intrinsics, Pose, Setup, Verdict, Warning,
    calibrate::result::{
        Advice, Answer, ArmDeviation, ArmHeldOut, ArmResult, BlockGain, BoardDeviation, BodyFrame,
        BudgetEntry, CameraResult, Candidate, CaptureFlatness, CaptureResult, CaptureStep,
        ColourStepResult, CompensationResult, DepthResult, Determined, Equipment, FlatnessResult,
        FrameNames, FramesResult, InputFile, JudgedFinding, PoseCovariance, Scale, ScanResult,
        SceneKind, ScenePair, SceneResult, TipResult, TouchResult,
    },
    estimate::{
        certify::Certificate,
        compensation::{ByArm, ByPlace, Compensation, RobotErrors},
        evaluate::{Diversity, RmsResidual},
        place::{Kernel, Place},
        predict::{PredictedTre, TreMap, TreSlice},
    },
    findings::{
        movement::{Movement, MovementKind},
        severity::Severity,
    },
    model::kinematics::{Arm, Deviation, DhConvention, Joint, Parameter},
};
use nalgebra::{Isometry3, Vector3};
use serde_json::Value;

/// A result in which nothing is missing.
fn full(errors: RobotErrors) -> Calibration {
    let rows = Some([[0.0; 6]; 6]);
    let answer = Answer {
        mount_from_camera: Some(Pose::identity()),
        anchor_from_target: Some(Pose::identity()),
        covariance: PoseCovariance { mount_from_camera: rows, anchor_from_target: rows },
    };
    let residual = RmsResidual {
        rotation_rms_deg: Some(0.0),
        translation_rms_mm: Some(0.0),
        reprojection_rms_px: Some(0.0),
    };
    Calibration {
        format: "1".into(),
        setup: Setup::EyeInHand,
        verdict: Verdict::Accepted,
        reasons: vec!["why".into()],
        method: "m".into(),
        hand_eye: answer,
        name: "flange_from_camera".into(),
        chosen: Some("m".into()),
        why: "why".into(),
        candidates: vec![Candidate {
            name: "m".into(),
            hand_eye: answer,
            in_sample: residual,
            held_out: residual,
            touch_rms_mm: Some(0.0),
            held_out_mm: Some(0.0),
            predicted_tre_mm: Some(0.0),
            note: Some("n".into()),
        }],
        predicted_tre_mm: Some(PredictedTre {
            at_task_p95: Some(0.0),
            rms: 0.0,
            p95: 0.0,
            r#where: "w".into(),
            map: Some(TreMap {
                frame: "camera".into(),
                minimum_mm: [0.0; 3],
                maximum_mm: [1.0; 3],
                slices: vec![TreSlice { axes: [0, 1], p95_mm: vec![vec![Some(1.0)]] }],
            }),
        }),
        max_error_mm: Some(1.0),
        residual,
        held_out: residual,
        captures: vec![CaptureResult {
            id: "01".into(),
            used: true,
            reason: Some("r".into()),
            base_from_flange: Pose::identity(),
            camera_from_target: Some(Pose::identity()),
            corners: 1,
            corners_3d: 1,
            residual_px: Some(0.0),
            reprojection_px: Some(0.0),
            residual_mm: Some(0.0),
            residual_deg: Some(0.0),
            held_out_mm: Some(0.0),
            held_out_deg: Some(0.0),
        }],
        touches: vec![TouchResult {
            capture: "A".into(),
            corner: 0,
            residual_mm: 0.0,
            difference_mm: Vector3::zeros(),
            used: true,
        }],
        rejected: vec!["02".into()],
        undetermined: vec!["z".into()],
        determined: Some(Determined {
            rotation_xyzw: Some([0.0, 0.0, 0.0, 1.0]),
            translation_across_m: Some([0.0; 3]),
            free_rotations: vec![[1.0, 0.0, 0.0]],
            free_translations: vec![[1.0, 0.0, 0.0]],
        }),
        diversity: Some(Diversity {
            captures: 1,
            largest_rotation_deg: 0.0,
            axis_spread: [1.0; 3],
            travel_mm: [0.0; 3],
        }),
        error_budget: vec![BudgetEntry {
            source: "robot".into(),
            sigma: "s".into(),
            sigma_mm: Some(0.0),
            sigma_deg: Some(0.0),
            sigma_uncertainty: Some(0.1),
            at_workpiece_mm: Some(0.0),
        }],
        advice: vec![Advice { change: "c".into(), predicted_tre_mm: 0.0 }],
        time_offset_s: Some(0.0),
        time_offset_sigma_s: Some(0.0),
        scale: Some(1.0),
        scale_sigma: Some(0.0),
        target_scale: Some(Scale { value: 1.0, sigma: 0.0, used: false }),
        movement: Some(Movement {
            kind: MovementKind::Block,
            camera: true,
            target: false,
            first: "1".into(),
            last: "3".into(),
            at_end: true,
            at_a_place: false,
            displacement_mm: 1.0,
            rotation_deg: 0.1,
            probability: 1.0,
            widened_mm: 1.0,
        }),
        camera: Some(CameraResult {
            intrinsics: Intrinsics {
                distortion: Distortion::BrownConrady([0.0; 12]),
                ..Intrinsics::pinhole(1, 1, 1.0, 1.0, 0.0, 0.0)
            },
            sigma_fx: 0.0,
            sigma_fy: 0.0,
            sigma_cx: 0.0,
            sigma_cy: 0.0,
        }),
        depth: Some(DepthResult { scale: 1.0, sigma_scale: 0.0, bias_mm: 0.0, sigma_bias_mm: 0.0 }),
        scans: Some(ScanResult {
            colour_step: Some(ColourStepResult {
                black_minus_white_mm: 0.0,
                sigma_mm: 0.0,
                spread_mm: 0.0,
                applied: false,
                captures: vec![CaptureStep {
                    id: "01".into(),
                    black_minus_white_mm: 0.0,
                    sigma_mm: 0.0,
                }],
            }),
            flatness: Some(FlatnessResult {
                rms_mm: 0.0,
                peak_to_valley_mm: 0.0,
                sigma_mm: 0.0,
                chance: 1.0,
                map: vec![BoardDeviation {
                    x_mm: 0.0,
                    y_mm: 0.0,
                    deviation_mm: 0.0,
                    sigma_mm: 0.0,
                }],
                captures: vec![CaptureFlatness {
                    id: "01".into(),
                    rms_mm: 0.0,
                    peak_to_valley_mm: 0.0,
                    sigma_mm: 0.0,
                    chance: 1.0,
                }],
            }),
            frames: Some(FramesResult {
                scale: 0.0,
                sigma_scale: 0.0,
                tilt_deg: [0.0; 3],
                sigma_tilt_deg: [0.0; 3],
                shift_mm: [0.0; 3],
                sigma_shift_mm: [0.0; 3],
                proven: vec!["tilt".into()],
                chance: 1.0,
            }),
            scene: Some(SceneResult {
                kind: SceneKind::Scene,
                placed: 2,
                pairs: vec![ScenePair {
                    source: "01".into(),
                    target: "02".into(),
                    overlap: 1.0,
                    agreement: 1.0,
                    rms_mm: Some(0.0),
                    used: false,
                    reason: Some("why".into()),
                    undetermined: vec!["z".into()],
                }],
            }),
        }),
        tip: Some(TipResult { offset_mm: [0.0; 3], sigma_mm: [0.0; 3], frame: "flange".into() }),
        arm: Some(ArmResult {
            model: arm(),
            deviations: vec![ArmDeviation {
                joint: 1,
                parameter: Parameter::A,
                value: 0.0,
                sigma: 0.0,
                observed: true,
            }],
            mount_from_camera: Pose::identity(),
            anchor_from_target: Pose::identity(),
            tip_offset_mm: Some([0.0; 3]),
            held_out: ArmHeldOut { before_mm: Some(0.0), after_mm: Some(0.0) },
            robot_before_mm: 0.0,
            robot_after_mm: 0.0,
            predicted_tre_mm: Some(0.0),
        }),
        compensation: Some(CompensationResult {
            by_place: BlockGain { rigid_mm: 1.0, corrected_mm: 0.5 },
            by_time: BlockGain { rigid_mm: 1.0, corrected_mm: 0.5 },
            model: Some(Compensation {
                setup: Setup::EyeInHand,
                rigid: Pose::identity(),
                mount_from_camera: Pose::identity(),
                anchor_from_target: Pose::identity(),
                errors,
                covariance: vec![0.0],
                robot: [0.0; 2],
            }),
        }),
        certificate: Some(Certificate {
            certified: true,
            gap: 0.0,
            min_eigenvalue: 0.0,
            least_squares: HandEye {
                mount_from_camera: Pose::identity(),
                anchor_from_target: Pose::identity(),
            },
            rotation_to_answer_deg: 0.0,
            translation_to_answer_mm: 0.0,
        }),
        warnings: vec![Warning::new("code", "message")],
        findings: vec![JudgedFinding {
            code: "code".into(),
            severity: Severity::Info,
            message: "message".into(),
            headline: Some("headline".into()),
            advice: Some("advice".into()),
            data: BTreeMap::new(),
        }],
        run_id: Some("cbf29ce484222325".into()),
        frames: Some(FrameNames {
            mount: Some("tool0".into()),
            camera: Some("optical".into()),
            bodies: vec![BodyFrame { name: "body".into(), body_from_camera: Pose::identity() }],
        }),
        version: Some("0.1.0".into()),
        created: Some("2026-03-14T09:26:53Z".into()),
        dataset: Some("cell".into()),
        inputs: vec![InputFile { path: "handeye.toml".into(), sha256: "00".into() }],
        equipment: Equipment {
            camera: Some("camera".into()),
            camera_serial: Some("1".into()),
            robot: Some("robot".into()),
            robot_serial: Some("2".into()),
            board: Some("board".into()),
        },
    }
}

fn arm() -> Arm {
    Arm {
        base_from_first_joint: Pose::claim(Isometry3::translation(0.1, 0.0, 0.0)),
        last_link_from_flange: Pose::claim(Isometry3::translation(0.0, 0.0, 0.1)),
        ..Arm::new(DhConvention::Standard, vec![Joint::default()])
    }
}

/// Each kind of errors that a robot may have.
fn errors() -> [RobotErrors; 3] {
    let place = || Place::new(&Pose::identity(), &[0.0]).touching();
    let by = |kernel| {
        RobotErrors::ByPlace(ByPlace {
            kernel,
            about: vec![place()],
            waves: vec![vec![1.0]],
            strengths: vec![[0.0; 6]],
            level: [0.0; 2],
            arm: Some(arm()),
        })
    };
    let of_arm = ByArm {
        given: arm(),
        corrected: arm(),
        deviations: vec![Deviation { joint: 0, parameter: Parameter::A }],
        seen: vec![place()],
    };
    [by(Kernel::OF_POSES[0]), by(Kernel::OF_JOINTS), RobotErrors::ByArm(of_arm)]
}

/// The schema behind a reference, the one of what is not null, and that one of several that has the value's keys.
fn resolved<'a>(root: &'a Value, schema: &'a Value, value: &Value) -> &'a Value {
    if let Some(all) = schema.get("oneOf").and_then(Value::as_array) {
        let first = value.as_object().and_then(|o| o.keys().next()).unwrap();
        return all.iter().find(|s| s["properties"].get(first).is_some()).unwrap();
    }
    let reference = schema.get("$ref").or_else(|| schema.get("anyOf")?.get(0)?.get("$ref"));
    match reference.and_then(Value::as_str) {
        Some(name) => root.pointer(name.trim_start_matches('#')).unwrap(),
        None => schema,
    }
}

fn compare(root: &Value, schema: &Value, value: &Value, at: &str) {
    let schema = resolved(root, schema, value);
    match value {
        Value::Object(object) => {
            let known = schema["properties"].as_object().unwrap_or_else(|| panic!("{at}"));
            let keys = |o: &serde_json::Map<String, Value>| -> BTreeSet<String> {
                o.keys().cloned().collect()
            };
            assert_eq!(keys(known), keys(object), "{at}");
            for (key, inner) in object {
                compare(root, &known[key], inner, &format!("{at}.{key}"));
            }
        }
        Value::Array(items) => {
            for item in items {
                compare(root, &schema["items"], item, &format!("{at}[]"));
            }
        }
        Value::String(word) => {
            let words = schema["enum"].as_array();
            assert!(words.is_none_or(|w| w.contains(&word.as_str().into())), "{at}: {word}");
        }
        _ => {}
    }
}

#[test]
fn the_schema_and_the_result_have_the_same_keys() {
    let path = concat!(env!("CARGO_MANIFEST_DIR"), "/schema/calibration.schema.json");
    let schema: Value = serde_json::from_str(&fs::read_to_string(path).unwrap()).unwrap();
    for errors in errors() {
        compare(&schema, &schema, &serde_json::to_value(full(errors)).unwrap(), "calibration");
    }
}
