// The pose of the next view in large digits, in the notation of the pendant, and how far the robot is from it. Where there is
// no next view, the pose that the robot has.

import { canTake, isAtNext, sendTyped, skip, take } from "./actions";
import type { App, Part } from "./app";
import { button } from "./controls";
import { attribute, h, kind, list, show, text } from "./dom";
import { makeTyping } from "./typing";
import { columns, mm, small, type Column } from "./numbers";
import { isTouching, takesCaptures, type Next, type State } from "./state";
import { showOwn, said, t, showTranslated } from "./words";

interface Digit extends Column {
  value: number | null;
  now: number | null;
}

const SEEN_FOR = 1200; // ms that a number is marked after it has changed
const CHANGED = 50; // units of its last digit: more than the noise of a robot that stands

/** Says for a while that a number has moved, so that one sees which follow the robot. */
function mover() {
  let reference: number | null = null;
  let movedAt = -SEEN_FOR;
  return (value: number | null, digits: number): boolean => {
    if (value === null || reference === null) reference = value;
    else if (Math.abs(value - reference) > CHANGED * 10 ** -digits) {
      reference = value;
      movedAt = performance.now();
    }
    return performance.now() - movedAt < SEEN_FOR;
  };
}

function digitRow() {
  const moved = mover();
  const [name, value, unit, now] = [h("strong"), h("b"), h("span"), h("small")];
  const element = h("div", { class: "digit" }, h("dt", {}, name, unit, now), h("dd", {}, value));
  return {
    element,
    update(digit: Digit): void {
      kind(element, "moved", digit.now === null && moved(digit.value, digit.digits));
      text(name, digit.name);
      text(value, digit.value === null ? "–" : digit.value.toFixed(digit.digits));
      text(unit, digit.unit && ` ${digit.unit}`);
      text(now, digit.now === null ? "" : t("now_at", { value: digit.now.toFixed(digit.digits) }));
    },
  };
}

/** The numbers to show: those of the pose, or of the joints. */
function digits(state: State, joints: boolean): Digit[] {
  const { robot, next, cell } = state;
  const wanted = takesCaptures(state) ? next : null;
  const shown: Next = wanted ?? robot ?? {};
  const values = (joints ? shown.joints_deg : shown.numbers) ?? [];
  const now = wanted && !robot?.typed ? (joints ? robot?.joints_deg : robot?.numbers) : null;
  const names = joints ? values.map((_, i) => `J${i + 1}`) : shown.columns;
  const count = values.length || (names?.length ?? 0);
  const units = joints ? values.map((_, i) => state.arm?.units?.[i] ?? "°") : shown.units;
  return columns(names, count, cell?.notation, units).map((column, i) => ({
    ...column,
    digits: joints ? 2 : column.digits,
    value: values[i] ?? null,
    now: now?.length === values.length ? (now[i] ?? null) : null,
  }));
}

export function makePosePanel(app: App): Part {
  const title = h("h2");
  const off = h("p", { class: "off" });
  const gain = h("p", { class: "gain" });
  const numbers = h("dl", { class: "digits" });
  const draw = list<Digit & { key: string }>(numbers, (digit) => digit.key, digitRow);
  const beside = h("p", { class: "joint-values" });
  const joints = h("button", { type: "button" }, said(h("span"), "joints"));
  joints.addEventListener("click", () => app.choose({ joints: !app.choices.joints }));
  const other = button("other_view", () => skip(app), { icon: "skip" });
  const typing = makeTyping(app, () => void (app.state && takesCaptures(app.state) && canTake(app.state) ? take(app) : sendTyped(app)));
  const element = h(
    "section",
    { class: "pose" },
    h("div", { class: "top" }, title, off),
    numbers,
    beside,
    typing.element,
    h("div", { class: "foot" }, gain, joints, other),
  );
  return {
    element,
    update(state) {
      const next = takesCaptures(state) ? state.next : null;
      text(title, next ? t("next_view", { number: next.number ?? "" }) : t("robot_now"));
      const there = next ? isAtNext(state) : null;
      // of a pose that was typed nobody knows whether the robot is there
      if (next && !state.robot?.typed) showOwn(off, offText(state));
      else showTranslated(off, state.step === "robot" ? null : state.robot?.why);
      kind(off, "there", there === true);
      kind(off, "away", there === false);
      const hasGain = typeof next?.before_mm === "number" && typeof next.after_mm === "number";
      text(gain, hasGain ? t("gain", { before: mm(next?.before_mm), after: mm(next?.after_mm) }) : "");
      const hasJoints = Boolean((next ?? state.robot)?.joints_deg?.length);
      const shown = digits(state, app.choices.joints && hasJoints);
      draw(shown.map((digit, i) => ({ ...digit, key: `${i} ${digit.name}` })));
      kind(numbers, "many", shown.length > 9);
      text(beside, hasJoints && !app.choices.joints ? jointText(state) : "");
      show(joints, hasJoints);
      attribute(joints, "aria-pressed", String(app.choices.joints));
      show(other, Boolean(next));
      typing.update(state);
      show(typing.element, state.robot?.typed === true && (takesCaptures(state) || isTouching(state)));
    },
  };
}

const JOINT_DIGITS = 1;

/** The joint values of the view, beside its pose. */
function jointText(state: State): string {
  const shown = (takesCaptures(state) ? state.next : null) ?? state.robot;
  const value = (joint: number, i: number) => `J${i + 1} ${joint.toFixed(JOINT_DIGITS)} ${state.arm?.units?.[i] ?? "°"}`;
  return (shown?.joints_deg ?? []).map(value).join("  ");
}

function offText(state: State): string {
  const off = state.next?.off;
  if (!off || typeof off.mm !== "number") return "";
  if (isAtNext(state)) return t("at_view");
  return t("away", { mm: mm(off.mm), deg: small(off.deg) });
}
