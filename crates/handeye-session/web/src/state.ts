// What the server says about the session: the state, as JSON. Every part may be missing or null, so that an older page and a
// newer server get on.

export type Pair = [number, number];
export type Maybe<T> = T | null | undefined;

/** `a_from_b`: takes points of `from` to `to`. */
export interface Pose {
  to?: string;
  from?: string;
  translation_m: [number, number, number];
  rotation_xyzw: [number, number, number, number];
}

export const STEPS = ["cell", "camera", "robot", "board", "capture", "touch", "verify", "result"] as const;

/** Steps in which images are taken. */
export const takesCaptures = ({ step, by }: State): boolean => step === "capture" || (step === "verify" && by !== "touches");

/** Whether corners are touched, for the calibration or to verify it. */
export const isTouching = ({ step, by }: State): boolean => step === "touch" || (step === "verify" && by === "touches");

/** What to do next. */
export const sayOf = (state: State): Maybe<string> =>
  state.step === "verify" && state.by === "touches" ? (state.verify?.say_touch ?? state.say) : state.say;

/** The touches that belong to the step. */
export const touchesHere = (state: State): Maybe<Touching> => (state.step === "verify" ? state.verify?.touch : state.touch);
export type StepName = (typeof STEPS)[number];

export interface Step {
  name: StepName;
  state: "done" | "now" | "open" | "locked";
  proof?: Maybe<string>;
  proven?: boolean;
}

export interface Problem {
  code?: string;
  message: string;
  advice?: Maybe<string>;
}

/** A target as `[target]` of `handeye.toml` has it. */
export type Target = { kind: string } & Record<string, unknown>;

export interface Intrinsics {
  width: number;
  height: number;
  fx: number;
  fy: number;
  cx: number;
  cy: number;
  distortion: Distortion;
}

export type Distortion =
  | { model: "none" }
  | { model: "brown-conrady"; coefficients: number[] } // OpenCV's order, twelve of them
  | { model: "kannala-brandt"; coefficients: number[] }; // four

export type Setup = "eye-in-hand" | "eye-to-hand";

export interface Cell {
  setup?: Setup;
  tolerance_mm?: number;
  target?: Maybe<Target>;
  intrinsics?: Maybe<Intrinsics>;
  notation?: string;
  is_virtual?: boolean;
}

export interface Robot {
  connected?: boolean;
  typed?: boolean; // its poses are typed from the pendant
  stands?: boolean;
  why?: string;
  columns?: string[];
  units?: string[];
  numbers?: Maybe<number[]>;
  joints_deg?: Maybe<number[]>;
  base_from_flange?: Maybe<Pose>;
}

/** The robot's model. */
export interface Arm {
  joints?: string[]; // their names
  units?: string[];
  measured?: boolean; // whether the robot gives its joint values
  points?: Maybe<Point[]>; // base, joints and flange, in the base, m
  next_points?: Maybe<Point[]>; // at the next view
}

export type Point = [number, number, number];

export interface Camera {
  connected?: boolean;
  single?: boolean; // its pictures come one by one
  width?: number;
  height?: number;
  frame?: number;
  age_s?: Maybe<number>;
  stands?: boolean;
  why?: string;
  corners?: Maybe<Pair[]>;
  found?: Maybe<string>;
  missing?: Maybe<string>;
  delay_s?: Maybe<number>;
  uploads?: boolean;
}

export interface Next {
  number?: number;
  reason?: string;
  before_mm?: Maybe<number>;
  after_mm?: Maybe<number>;
  columns?: string[];
  units?: string[];
  numbers?: Maybe<number[]>;
  joints_deg?: Maybe<number[]>;
  base_from_flange?: Maybe<Pose>;
  camera_from_target?: Maybe<Pose>;
  ghost?: Maybe<Pair[]>;
  ghost_corners?: Maybe<Pair[]>;
  off?: Maybe<{ mm?: Maybe<number>; deg?: Maybe<number> }>;
}

export interface Capture {
  id: string;
  time_s?: number;
  used?: boolean;
  reason?: Maybe<string>;
  residual_px?: Maybe<number>;
  residual_mm?: Maybe<number>;
  residual_deg?: Maybe<number>;
  held_out_mm?: Maybe<number>;
  corners?: number;
  corners_3d?: number;
  base_from_flange?: Maybe<Pose>;
  camera_from_target?: Maybe<Pose>;
}

/** Whether a capture was rejected; one that was not assessed yet is not used either, but for no reason. */
export const isOutlier = ({ used, reason }: Capture): boolean => used === false && Boolean(reason);

/** What was measured in a capture's picture. */
export interface CaptureDetail {
  id: string;
  points: Pair[];
  arrows: Maybe<Pair[]>; // found minus predicted, px
}

export type Verdict = "accepted" | "rejected" | "undetermined";

export interface Direction {
  name: string;
  sigma?: Maybe<number>;
  unit?: string;
}

export interface Finding {
  code?: string;
  severity?: "info" | "changes-answer" | "rejects";
  message: string;
  advice?: Maybe<string>;
}

export interface Progress {
  captures?: number;
  verdict?: Verdict;
  reasons?: string[];
  p95_mm?: Maybe<number>;
  tolerance_mm?: Maybe<number>;
  enough?: boolean;
  undetermined?: string[];
  directions?: Direction[];
  history?: [number, Maybe<number>][];
  findings?: Finding[];
  mount_from_camera?: Maybe<Pose>;
  anchor_from_target?: Maybe<Pose>;
}

export interface Result {
  files?: string[];
  verdict?: Verdict;
  headline?: string;
}

/** Corners that are touched. */
export interface Touching {
  tip_mm?: Maybe<[number, number, number]>;
  corner: number; // to be touched next
  columns?: number;
  lays?: boolean; // boards are laid into the view to be touched
  placements?: Placement[];
  placement?: Maybe<string>; // the one whose corners are touched now
  lying?: Maybe<"nothing" | "new" | "placed">; // in the view of a virtual cell's camera
  touches?: Touch[];
  rms_mm?: Maybe<number>;
  at_corner?: Maybe<boolean>; // whether a virtual robot's tip is there
}

/** Whether the board whose corners are touched lies where its image shows it. */
export const isPlaced = ({ placement, lying }: Touching): boolean => Boolean(placement) && (lying ?? "placed") === "placed";

/** A board that was laid into the view to be touched. */
export interface Placement {
  id: string;
  touches?: number;
}

export interface Touch {
  id: string;
  placement?: Maybe<string>;
  corner: number;
  residual_mm?: Maybe<number>;
  used?: boolean;
}

/** Views and touches that verify the captures. */
export interface Verifying {
  views?: Verified[];
  rms_mm?: Maybe<number>;
  expected_mm?: Maybe<number>;
  agrees?: Maybe<boolean>; // of both
  touch?: Maybe<Touching>;
  say_touch?: Maybe<string>;
  touches_expected_mm?: Maybe<number>;
}

/** What a result is verified by. */
export type VerifyBy = "views" | "touches";

export interface Verified {
  id: string;
  distance_mm?: Maybe<number>;
  angle_deg?: Maybe<number>;
}

export interface State {
  version: number;
  by?: VerifyBy; // chosen in this browser
  folder?: string;
  title?: string;
  step?: StepName;
  steps?: Step[];
  say?: string;
  problem?: Maybe<Problem>;
  cell?: Maybe<Cell>;
  robot?: Maybe<Robot>;
  arm?: Maybe<Arm>;
  camera?: Maybe<Camera>;
  next?: Maybe<Next>;
  taking?: Maybe<{ since_s?: number; why?: Maybe<string> }>;
  automatic?: boolean;
  captures?: Maybe<Capture[]>;
  deleted?: Maybe<{ id: string }[]>;
  refused?: Maybe<{ time_s?: number; why: string }[]>;
  can_undo?: Maybe<string>;
  assessing?: boolean;
  assessed?: number; // changes with every assessment
  progress?: Maybe<Progress>;
  touch?: Maybe<Touching>;
  verify?: Maybe<Verifying>;
  result?: Maybe<Result>;
  virtual_cell?: Maybe<{ truth_error_mm?: Maybe<number>; driving?: boolean }>;
}

export type Command = { do: string } & Record<string, unknown>;
