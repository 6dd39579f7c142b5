// What must not be overlooked, right below the sentence: no connection, a problem, a command that was refused, a verdict
// that is not good, a capture that was refused. While one of the first kinds is there, nothing on the page is green.

import type { App, Part } from "./app";
import { h, kind, show } from "./dom";
import { icon, type Icon } from "./icons";
import { button } from "./controls";
import type { Problem, State } from "./state";
import { showOwn, sentence, t, showTranslated, type Key } from "./words";

const HOLD = 1500; // ms that a notice stays after its reason has gone, so that nothing jumps
const FEWEST = 4; // captures before which it is no problem that they cannot be assessed
const REFUSED_FOR = 10_000; // ms that a refused capture is shown for

/** Words of the page's own, or what the server says. */
type Words = { own: Key } | { said: string | readonly string[] };

interface Notice {
  message: Words;
  advice?: Words | null;
}

function write(element: Element, words: Words): void {
  if ("own" in words) showOwn(element, t(words.own));
  else showTranslated(element, words.said, sentence);
}

interface Strip {
  element: HTMLElement;
  set(notice: Notice | null, hold?: boolean): void;
}

function strip(look: string, sign: Icon, closed?: () => void): Strip {
  const message = h("strong");
  const advice = h("span");
  const element = h("div", { class: `notice ${look}` }, icon(sign), h("p", {}, message, " ", advice));
  if (closed) element.append(button("close", closed, { icon: "cross", bare: true, class: "plain" }));
  element.hidden = true;
  let gone = 0;
  return {
    element,
    set(notice, hold = true) {
      if (notice) {
        gone = 0;
        write(message, notice.message);
        write(advice, notice.advice ?? { said: [] });
        show(element, true);
      } else if (!element.hidden) {
        gone ||= performance.now();
        if (!hold || performance.now() - gone > HOLD) show(element, false);
      }
    },
  };
}

/** A verdict that says no: of the captures so far, or of the result. */
export function badVerdict(state: State): Notice | null {
  if (state.step === "result" && state.result?.verdict && state.result.verdict !== "accepted") {
    const key = state.result.verdict === "rejected" ? "result_rejected" : "result_undetermined";
    return { message: { own: key }, advice: { said: state.progress?.reasons ?? [] } };
  }
  if (state.progress?.verdict === "rejected") {
    return { message: { own: "rejected_so_far" }, advice: { said: state.progress.reasons ?? [] } };
  }
  return null;
}

/** The connection's notice. */
function lostNotice(app: App): Notice | null {
  if (app.signedOut) return { message: { own: "signed_out" }, advice: { own: "signed_out_advice" } };
  if (app.lostSince === null) return null;
  return { message: { own: "lost" }, advice: { own: "lost_advice" } };
}

export function makeNotices(app: App, element: HTMLElement): Part {
  const lost = strip("bad", "warning");
  const problem = strip("bad", "warning");
  const refused = strip("bad", "cross", () => {
    app.refused = null;
    app.redraw();
  });
  const verdict = strip("bad", "warning");
  const late = strip("doubtful", "warning", () => {
    lateSeen = true;
    app.redraw();
  });
  let lateSeen = false;
  const capture = strip("doubtful", "cross", () => {
    shownUntil = 0;
    app.redraw();
  });
  let shownUntil = 0;
  let last: string | null = null;
  const alerts = h("div", { role: "alert" }, lost.element, problem.element, refused.element);
  const others = h("div", { role: "status" }, verdict.element, late.element, capture.element);
  element.append(alerts, others);

  const shown = (given: Problem | null | undefined): Notice | null =>
    given ? { message: given.message ? { said: given.message } : { own: "not_sent" }, advice: { said: given.advice ?? [] } } : null;

  return {
    element,
    update(state) {
      lost.set(lostNotice(app), false);
      const isEarly = state.problem?.code === "not-assessed" && (state.captures?.length ?? 0) < FEWEST;
      const given = isEarly ? null : state.problem;
      const isMild = state.problem?.code === "image-late"; // nothing is wrong, it only takes longer
      problem.set(isMild ? null : shown(given));
      late.set(isMild && !lateSeen && state.step === "capture" ? shown(state.problem) : null, false);
      refused.set(shown(app.refused), false);
      const bad = badVerdict(state);
      verdict.set(state.step === "result" ? null : bad); // the result says it itself
      const newest = state.refused?.[state.refused.length - 1];
      const name = newest ? `${newest.time_s} ${newest.why}` : "";
      if (last !== null && name && name !== last) shownUntil = performance.now() + REFUSED_FOR;
      last = name;
      const isSaid = state.problem?.code === "not-taken"; // in its own words
      const fresh = newest && !isSaid && performance.now() < shownUntil;
      capture.set(fresh ? { message: { own: "capture_refused" }, advice: { said: newest.why } } : null, false);
      kind(document.body, "trouble", Boolean(lostNotice(app) || (given && !isMild) || app.refused || bad));
      kind(document.body, "lost", app.lostSince !== null);
    },
  };
}
