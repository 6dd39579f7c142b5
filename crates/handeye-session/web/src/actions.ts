// What can be done at this moment: the one primary action, and those beside it.

import { selectedCapture, type App } from "./app";
import type { Icon } from "./icons";
import type { State, StepName } from "./state";
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

/** Whether the robot is at the next view; null where nobody knows. */
export function isAtNext(state: State): boolean | null {
  const off = state.next?.off;
  if (typeof off?.mm !== "number") return null;
  return off.mm < AT_VIEW_MM && (off.deg ?? 0) < AT_VIEW_DEG;
}

/** How many views had been checked when the virtual robot was last sent to one. */
let checksBeforeDrive: number | null = null;

const REPORT = "/api/report";
export const openReport = () => void window.open(REPORT, "_blank", "noopener");

function act(app: App, label: Key, command: Parameters<App["send"]>[0], enabled = true): Action {
  return { label, enabled, run: () => void app.send(command) };
}

/** Whether the captures are enough, and nothing speaks against them. */
export function isEnough(state: State): boolean {
  return state.progress?.enough === true && (state.progress.verdict ?? "accepted") === "accepted";
}

export function canTake(state: State): boolean {
  return !state.taking && !state.virtual_cell?.driving;
}

/** Takes a capture, of the pose that was typed where the robot is not connected. */
async function take(app: App): Promise<void> {
  const pose = app.choices.typed.trim();
  if (!app.state?.robot?.connected && pose) {
    if (!(await app.send({ do: "pose", text: pose }))) return;
    app.choose({ typed: "" });
  }
  await app.send({ do: "take" });
}

function takeAction(app: App, state: State): Action {
  return { label: state.taking ? "waiting_for_rest" : "take", enabled: canTake(state), run: () => void take(app) };
}

function inCapture(app: App, state: State): Action {
  if (state.virtual_cell?.driving) return act(app, "driving", { do: "cancel" }, false);
  if (state.taking) return takeAction(app, state);
  if (isEnough(state)) return act(app, "finish", { do: "finish" });
  if (state.virtual_cell && isAtNext(state) === false) return act(app, "drive", { do: "drive", to: "next" });
  return takeAction(app, state);
}

function inVerify(app: App, state: State): Action {
  const views = state.verify?.views?.length ?? 0;
  if (state.virtual_cell?.driving) return act(app, "driving", { do: "cancel" }, false);
  if (state.taking) return takeAction(app, state);
  if (state.verify?.verdict === "holds") return act(app, "to_result", { do: "confirm", step: "verify" });
  if (state.verify?.verdict === "does not hold") return act(app, "back_to_captures", { do: "go", step: "capture" });
  if (state.virtual_cell && checksBeforeDrive !== views) {
    return {
      label: "drive_check",
      enabled: true,
      run: () => void app.send({ do: "drive", to: "check" }).then((sent) => sent && (checksBeforeDrive = views)),
    };
  }
  return takeAction(app, state);
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
    case "verify":
      return inVerify(app, state);
    case "touch":
      return act(app, "go_on", { do: "confirm", step: "touch" });
    case "result":
      return { label: "open_report", enabled: true, icon: "page", run: openReport };
    default:
      return act(app, "confirm", { do: "confirm", step: state.step ?? "cell" });
  }
}

/** The actions beside the primary one. */
export function secondary(app: App, state: State): Action[] {
  const cancel = state.taking ? [act(app, "cancel", { do: "cancel" })] : [];
  const isTaking = primary(app, state).label === "take" || state.taking;
  switch (state.step) {
    case "capture":
      return [
        ...cancel,
        ...(isTaking ? [] : [takeAction(app, state)]),
        { ...act(app, "automatic", { do: "automatic", on: !state.automatic }), on: state.automatic === true },
      ];
    case "verify":
      return [...cancel, ...(isTaking ? [] : [takeAction(app, state)])];
    case "result":
      return [act(app, "back_to_captures", { do: "go", step: "capture" })];
    default:
      return cancel;
  }
}

export function canFinish(state: State): boolean {
  return (state.captures?.filter((capture) => capture.used !== false).length ?? 0) >= FEWEST_TO_FINISH;
}

/** The key N: the virtual robot drives to the next view; any other robot gets another view. */
export function nextView(app: App): void {
  if (app.state?.virtual_cell) void app.send({ do: "drive", to: app.state.step === "verify" ? "check" : "next" });
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
