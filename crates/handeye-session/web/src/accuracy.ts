// How accurate the result would be now: the predicted position error against the tolerance, its history, the six directions.

import { canFinish, isEnough } from "./actions";
import type { App, Part } from "./app";
import { button } from "./controls";
import { h, kind, show, text } from "./dom";
import { mm } from "./numbers";
import { directions, history, toleranceBar } from "./plots";
import type { State } from "./state";
import { said, t, translated } from "./words";

function verdictText(state: State): string {
  const progress = state.progress;
  if (!progress) return t("no_progress");
  if (progress.verdict === "rejected") return t("verdict_rejected");
  if (typeof progress.p95_mm !== "number") return t("verdict_undetermined");
  return isEnough(state) ? t("verdict_enough") : t("verdict_more");
}

export function makeAccuracy(app: App): Part {
  const number = h("b");
  const unit = h("span", { class: "unit" }, "mm");
  const limit = h("small");
  const verdict = h("p", { class: "verdict" });
  const [bar, past, six] = [toleranceBar(), history(), directions()];
  const working = said(h("small", { class: "working" }), "assessing");
  const sixTitle = said(h("h3"), "six_directions");
  const undetermined = h("p", { class: "undetermined" });
  const truth = h("p", { class: "truth" });
  const below = h("button", { type: "button", class: "below" });
  below.addEventListener("click", () => document.getElementById("grave")?.scrollIntoView({ block: "nearest" }));
  const finish = button("finish_now", () => void app.send({ do: "finish" }));
  const element = h(
    "section",
    { class: "card accuracy" },
    said(h("h2"), "accuracy"),
    h("div", { class: "number" }, number, unit, verdict),
    bar.element,
    h("div", { class: "allowed" }, limit, working),
    below,
    past.element,
    sixTitle,
    six.element,
    undetermined,
    truth,
    finish,
  );
  return {
    element,
    update(state) {
      const progress = state.progress;
      const tolerance = progress?.tolerance_mm ?? state.cell?.tolerance_mm;
      const error = progress?.p95_mm;
      const bad = progress?.verdict === "rejected";
      text(number, mm(error));
      text(limit, tolerance ? t("of_tolerance", { tolerance: mm(tolerance) }) : "");
      bar.update(error, tolerance, t("error_label", { error: mm(error), tolerance: mm(tolerance) }));
      text(verdict, verdictText(state));
      kind(element, "good", isEnough(state));
      kind(element, "bad", bad);
      past.update(progress?.history ?? [], tolerance);
      six.update(progress?.directions ?? []);
      show(sixTitle, Boolean(progress?.directions?.length));
      const grave = (progress?.findings ?? []).filter(({ severity }) => severity === "changes-answer").length;
      text(below, t("findings_below", { count: grave }));
      show(below, grave > 0);
      const free = progress?.undetermined ?? [];
      text(undetermined, free.length ? t("undetermined_list", { list: free.map(translated).join(", ") }) : "");
      show(undetermined, free.length > 0);
      const off = state.virtual_cell?.truth_error_mm;
      text(truth, typeof off === "number" ? t("truth_error", { mm: mm(off) }) : "");
      show(truth, typeof off === "number");
      kind(working, "idle", !state.assessing);
      show(finish, state.step === "capture" && canFinish(state) && !isEnough(state));
    },
  };
}
