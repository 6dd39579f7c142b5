// The page of a live calibration. It shows the state of the server and the live picture, and sends commands; what is right
// and what comes next is the server's to say.

import { makeAccuracy } from "./accuracy";
import { makeApp, type Part } from "./app";
import { makeCaptures } from "./captures";
import { makeCell } from "./cell3d";
import { attribute, kind, show } from "./dom";
import { makeFindings, makeRefused } from "./findings";
import { listen, makeSpeaker } from "./happenings";
import { makeHead } from "./head";
import { makeHelp } from "./help";
import { listenToKeys } from "./keys";
import { follow, Refusal } from "./link";
import { watch } from "./live";
import { makeNotices } from "./notices";
import { makePicture } from "./picture";
import { makePosePanel } from "./pose_panel";
import { makeRail } from "./rail";
import { wakeSounds } from "./sounds";
import type { State, StepName } from "./state";
import { makeStepBoard } from "./step_board";
import { makeStepCamera } from "./step_camera";
import { makeStepCell } from "./step_cell";
import { makeStepResult } from "./step_result";
import { makeStepRobot } from "./step_robot";
import { makeStepTouch } from "./step_touch";
import { makeStepVerify } from "./step_verify";
import { makeUpload } from "./upload";
import { named, speak } from "./words";

const app = makeApp(redraw);
const place = (id: string) => document.getElementById(id) as HTMLElement;
const help = makeHelp();
const stage = place("stage");
const side = place("side");
const picture = makePicture(app);
const speakOf = makeSpeaker(place("spoken"));

/** Each part, and the steps in which it is seen. */
const ALL: StepName[] = ["cell", "camera", "robot", "board", "capture", "touch", "verify", "result"];
const WORK: StepName[] = ["robot", "capture", "touch", "verify"];
const ANSWER: StepName[] = ["capture", "touch", "verify", "result"];
const onStage: [Part, StepName[]][] = [
  [picture, ALL],
  [makeCell(app), WORK],
  [makePosePanel(app), WORK],
  [makeStepResult(app), ["result"]],
];
const onSide: [Part, StepName[]][] = [
  [makeUpload(app), ["camera", "board", "capture", "verify"]],
  [makeStepCell(app), ["cell"]],
  [makeStepCamera(app), ["camera"]],
  [makeStepRobot(app), ["robot"]],
  [makeStepBoard(app), ["board"]],
  [makeStepVerify(app), ["verify"]],
  [makeStepTouch(app), ["touch", "verify"]],
  [makeFindings(app, "rejects"), ANSWER],
  [makeAccuracy(app), ["capture", "result"]],
  [makeCaptures(app), ["capture", "result"]],
  [makeFindings(app, "changes-answer"), ANSWER],
  [makeRefused(app), ["capture", "verify"]],
  [makeFindings(app, "info"), ANSWER],
];
const always: Part[] = [makeNotices(app, place("notices")), makeRail(app, place("rail"), () => help.showModal()), makeHead(app, place("head"))];

named(stage, "stage");
named(side, "side");
document.body.append(help);
stage.append(...onStage.map(([{ element }]) => element));
side.append(...onSide.map(([{ element }]) => element));

function redraw(): void {
  const state = app.state ?? EMPTY;
  speak(app.choices.language ?? (navigator.language.startsWith("de") ? "de" : "en"));
  const step = state.step ?? "cell";
  if (document.body.dataset.step !== step) side.scrollTop = 0;
  attribute(document.body, "data-step", step);
  kind(document.body, "starting", app.state === null);
  kind(stage, "large-cell", app.choices.large === "cell");
  if (!state.captures?.some(({ id }) => id === app.choices.selected)) app.choices.selected = null;
  kind(stage, "looking", app.choices.selected !== null);
  for (const part of always) part.update(state);
  for (const [part, steps] of [...onStage, ...onSide]) {
    const seen = steps.includes(step);
    if (!seen) show(part.element, false);
    else {
      if (part.element.dataset.seen !== step) show(part.element, true);
      part.update(state);
    }
    part.element.dataset.seen = seen ? step : "";
  }
  document.title = state.title ? `${state.title} – handeye` : "handeye";
}

const EMPTY: State = { version: 0 };

let waiting = false;
let before: State | null = null;

const UNSEEN = 250; // ms after which a state is drawn without a frame of the screen, which a hidden page does not get

/** A new state is drawn with the next frame of the screen: states that come faster than that are not all drawn. */
function arrived(state: State): void {
  app.state = { ...state, by: app.choices.by };
  app.lostSince = null;
  app.signedOut = false;
  if (waiting) return;
  waiting = true;
  const draw = () => {
    if (!waiting || !app.state) return;
    waiting = false;
    clearTimeout(late);
    cancelAnimationFrame(next);
    listen(app, before, app.state);
    speakOf(app.state);
    before = app.state;
    redraw();
  };
  const next = requestAnimationFrame(draw);
  const late = setTimeout(draw, UNSEEN);
}

function lost(why: unknown): void {
  if (why === null) app.lostSince = null;
  else {
    app.lostSince ??= performance.now();
    app.signedOut = why instanceof Refusal && why.status === 401;
  }
  redraw();
}

for (const event of ["pointerdown", "keydown"]) addEventListener(event, wakeSounds);
listenToKeys(app, help);
redraw();
void follow(arrived, lost);
void watch(
  () => app.state !== null && app.lostSince === null && (app.state.step !== "result" || app.choices.selected !== null),
  picture.draw,
);
