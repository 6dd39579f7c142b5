// What can be done at this moment: the one primary action, and those beside it.

import { selectedCapture, type App } from "./app";
import type { Icon } from "./icons";
import { isOutlier, isPlaced, isTouching, takesCaptures, touchesHere, type State, type StepName } from "./state";
import type { Key } from "./words";

export interface Action {
  label: Key;
  enabled: boolean;
  on?: boolean; // of a switch
  icon?: Icon;
  run(): void;
}

const AT_VIEW_MM = 2; // nearer than this and AT_VIEW_DEG, the robot is at the next view
const AT_VIEW_DEG = 1;
const FEWEST_TO_FINISH = 3;

/** Whether the robot is at the next view; null where nobody knows: a pose that was typed is where it has been. */
export function isAtNext(state: State): boolean | null {
  const off = state.next?.off;
  if (typeof off?.mm !== "number" || state.robot?.typed) return null;
  return off.mm < AT_VIEW_MM && (off.deg ?? 0) < AT_VIEW_DEG;
}


const REPORT = "/api/report";
export const openReport = () => void window.open(REPORT, "_blank", "noopener");

function act(app: App, label: Key, command: Parameters<App["send"]>[0], enabled = true): Action {
  return { label, enabled, run: () => void app.send(command) };
}

/** Whether the captures are enough, and nothing speaks against them. */
export function isEnough(state: State): boolean {
  return state.progress?.enough === true && (state.progress.verdict ?? "accepted") === "accepted";
}

/** What was there when a capture was asked for here: until something has come of it, no second one is. */
let asked: { outcomes: number; problem: string; at: number } | null = null;
const ASKED_FOR = 20_000; // ms after which this is over in any case

const outcomes = (state: State): number =>
  [state.captures, state.deleted, state.refused, state.verify?.views, state.touch?.placements, state.verify?.touch?.placements].reduce((sum, all) => sum + (all?.length ?? 0), 0);

const problemOf = ({ problem }: State): string => (problem && problem.code !== "image-late" ? problem.message : "");

function isStoring(state: State): boolean {
  if (!asked) return false;
  if (state.taking) asked.at = performance.now();
  const problem = problemOf(state);
  const isOver = asked.outcomes !== outcomes(state) || (problem !== "" && problem !== asked.problem);
  if (isOver || performance.now() - asked.at > ASKED_FOR) asked = null;
  return asked !== null;
}

/** Whether a capture can be asked for. */
export function canTake(state: State): boolean {
  return !state.taking && !state.virtual_cell?.driving && !isStoring(state);
}

/** Sends the pose that was typed, where one was. False where it was refused. */
export async function sendTyped(app: App): Promise<boolean> {
  const pose = app.choices.typed.trim();
  if (!app.state?.robot?.typed || !pose) return true;
  if (!(await app.send({ do: "pose", text: pose }))) return false;
  app.choose({ typed: "" });
  return true;
}

/** Takes a capture, of the pose that was typed where poses are. */
export async function take(app: App): Promise<void> {
  if (await sendTyped(app)) await ask(app, "take");
}

/** Asks for an image that is stored. */
async function ask(app: App, command: "take" | "place"): Promise<void> {
  if (!app.state || app.state.taking) return;
  asked = { outcomes: outcomes(app.state), problem: problemOf(app.state), at: performance.now() };
  if (!(await app.send({ do: command }))) asked = null;
}

/** No longer waits for a standstill. */
export function cancel(app: App): void {
  asked = null;
  void app.send({ do: "cancel" });
}

function takeAction(app: App, state: State): Action {
  const byHand = state.robot?.typed || state.camera?.single;
  const label = !state.taking ? (state.step === "verify" ? "take_view" : "take") : byHand ? "waiting_for_both" : "waiting_for_rest";
  return { label, enabled: canTake(state), run: () => void take(app) };
}

function inCapture(app: App, state: State): Action {
  if (state.virtual_cell?.driving) return act(app, "driving", { do: "cancel" }, false);
  if (state.taking) return takeAction(app, state);
  if (state.assessing || isStoring(state)) return act(app, "assessing_now", { do: "cancel" }, false);
  if (isEnough(state)) return act(app, "finish", { do: "finish" });
  if (state.virtual_cell && isAtNext(state) === false) return act(app, "drive", { do: "drive", to: "next" });
  return takeAction(app, state);
}

const DONE_VIEWS = 3; // then finishing is the next thing

function inVerify(app: App, state: State): Action {
  const count = state.verify?.views?.length ?? 0;
  if (state.virtual_cell?.driving) return act(app, "driving", { do: "cancel" }, false);
  if (state.taking) return takeAction(app, state);
  if (state.assessing || isStoring(state)) return act(app, "assessing_now", { do: "cancel" }, false);
  if (count >= DONE_VIEWS && state.verify?.agrees === true) return act(app, "finish", { do: "finish" });
  if (state.virtual_cell && isAtNext(state) === false) return act(app, "drive", { do: "drive", to: "next" });
  return takeAction(app, state);
}

const DONE_TOUCHES = 6; // then finishing is the next thing
const DONE_VERIFYING = 4; // where they verify

/** Takes the image of a board that was laid into the view; in a virtual cell somebody lays it there first. */
export function placeAction(app: App, state: State): Action {
  if (state.taking) return { label: "waiting_for_board", enabled: false, run: () => cancel(app) };
  if (state.virtual_cell && touchesHere(state)?.lying !== "new") return act(app, "lay_board", { do: "drive", to: "placement" });
  return { label: "place", enabled: !isStoring(state), run: () => void ask(app, "place") };
}

function inTouch(app: App, state: State): Action {
  const here = touchesHere(state);
  const count = here?.touches?.length ?? 0;
  const verifies = state.step === "verify";
  if (state.virtual_cell?.driving) return act(app, "driving", { do: "cancel" }, false);
  if (state.assessing) return act(app, "assessing_now", { do: "cancel" }, false);
  if (!here?.tip_mm) return act(app, "touch_it", { do: "touch" }, false);
  const isDone = verifies ? count >= DONE_VERIFYING && state.verify?.agrees === true : count >= DONE_TOUCHES;
  // once these verify, a board that is taken away is not asked for again
  if (verifies && isDone && !state.taking) return act(app, "finish", { do: "finish" });
  if (here.lays && (state.taking || !isPlaced(here))) return placeAction(app, state);
  if (isDone) return act(app, "finish", { do: "finish" });
  if (state.virtual_cell && here.at_corner !== true) return act(app, "drive_tip", { do: "drive", to: "touch" });
  if (!state.robot?.typed && state.robot?.stands === false) return { label: "waiting_for_rest", enabled: false, run: () => {} };
  return { label: "touch_it", enabled: true, run: () => void touch(app) };
}

/** Takes a touch, of the pose that was typed where poses are. */
async function touch(app: App): Promise<void> {
  if (await sendTyped(app)) await app.send({ do: "touch" });
}

/** What the space bar does now. */
export function primary(app: App, state: State): Action {
  const action = primaryOf(app, state);
  return app.lostSince === null && app.state ? action : { ...action, enabled: false };
}

function primaryOf(app: App, state: State): Action {
  switch (state.step) {
    case "capture":
      return inCapture(app, state);
    case "touch":
      return inTouch(app, state);
    case "verify":
      return isTouching(state) ? inTouch(app, state) : inVerify(app, state);
    case "result":
      if (!state.result) return act(app, "back_to_captures", { do: "go", step: "capture" });
      return { label: "open_report", enabled: true, icon: "page", run: openReport };
    case "robot":
      return { label: "confirm", enabled: isProven(state) || app.choices.typed.trim() !== "", run: () => void confirmRobot(app) };
    default:
      return act(app, "confirm", { do: "confirm", step: state.step ?? "cell" }, isProven(state));
  }
}

/** Whether what the step shows is enough to go on. */
const isProven = (state: State): boolean => state.steps?.find(({ name }) => name === state.step)?.proven !== false;

async function confirmRobot(app: App): Promise<void> {
  if (await sendTyped(app)) await app.send({ do: "confirm", step: "robot" });
}

/** The actions beside the primary one. */
export function secondary(app: App, state: State): Action[] {
  const stop = state.taking ? [{ label: "cancel" as const, enabled: true, run: () => cancel(app) }] : [];
  const isTaking = takesCaptures(state) && (["take", "take_view"].includes(primary(app, state).label) || state.taking);
  switch (state.step) {
    case "capture":
      return [
        ...stop,
        ...(isTaking ? [] : [takeAction(app, state)]),
        ...(isEnough(state) && state.touch ? [act(app, "go_touch", { do: "go", step: "touch" })] : []),
        ...(isEnough(state) && state.verify ? [act(app, "go_verify", { do: "go", step: "verify" })] : []),
        { ...act(app, "automatic", { do: "automatic", on: !state.automatic }), on: state.automatic === true },
      ];
    case "touch":
      return [
        ...stop,
        ...(primary(app, state).label === "finish" ? [] : [act(app, "finish", { do: "finish" })]),
        act(app, "back_to_captures", { do: "go", step: "capture" }),
      ];
    case "verify":
      return [
        ...stop,
        ...(isTaking || isTouching(state) ? [] : [takeAction(app, state)]),
        ...(primary(app, state).label === "finish" ? [] : [act(app, "finish", { do: "finish" })]),
        act(app, "back_to_captures", { do: "go", step: "capture" }),
      ];
    case "result":
      return state.result ? [act(app, "back_to_captures", { do: "go", step: "capture" })] : [];
    default:
      return stop;
  }
}

export function canFinish(state: State): boolean {
  return (state.captures?.filter((capture) => !isOutlier(capture)).length ?? 0) >= FEWEST_TO_FINISH;
}

/** Why setup, board and intrinsics cannot be changed; null where they can. */
export function fixedBy(state: State): Key | null {
  return state.cell?.is_virtual ? "fixed_virtual" : null;
}

/** The key N: the virtual robot drives to the next view; any other robot gets another view. */
export function nextView(app: App): void {
  if (app.state?.virtual_cell) void app.send({ do: "drive", to: "next" });
  else skip(app);
}

export function skip(app: App): void {
  void app.send({ do: "skip", why: "cannot reach" });
}

export function deleteSelected(app: App): void {
  const capture = selectedCapture(app);
  if (capture) void app.send({ do: "delete", id: capture.id });
}

/** Selects the capture so many places later in time; from none, the last one. */
export function selectBy(app: App, places: number): void {
  const captures = app.state?.captures ?? [];
  if (!captures.length) return;
  const now = captures.findIndex((capture) => capture.id === app.choices.selected);
  const wanted = now < 0 ? captures.length - 1 : Math.min(captures.length - 1, Math.max(0, now + places));
  app.choose({ selected: captures[wanted]?.id ?? null });
}

export function goTo(app: App, step: StepName): void {
  const found = app.state?.steps?.find(({ name }) => name === step);
  if (found && found.state !== "locked") void app.send({ do: "go", step });
}
