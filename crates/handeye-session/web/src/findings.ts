// What was found beside the answer, and the captures that were refused: the grave ones before the others.

import type { App, Part } from "./app";
import { h, kind, list, show } from "./dom";
import { icon, setIcon } from "./icons";
import type { Finding, State } from "./state";
import { said, sentence, showTranslated } from "./words";

const REFUSED_SHOWN = 3;

function findingRow() {
  const sign = icon("warning");
  const [message, advice] = [h("p"), h("p", { class: "advice" })];
  const element = h("li", { class: "finding" }, sign, h("div", {}, message, advice));
  return {
    element,
    update(finding: Finding): void {
      showTranslated(message, finding.message, sentence);
      showTranslated(advice, finding.advice, sentence);
      show(advice, Boolean(finding.advice));
      setIcon(sign, finding.severity === "info" ? "page" : "warning");
      kind(element, "rejects", finding.severity === "rejects");
      kind(element, "changes", finding.severity === "changes-answer");
    },
  };
}

/** How grave a finding is now: what would reject a result rejects nothing while more captures are all that is missing. */
function severity(finding: Finding, state: State): NonNullable<Finding["severity"]> {
  const isOver = state.progress?.verdict === "rejected";
  return finding.severity === "rejects" && !isOver ? "info" : (finding.severity ?? "info");
}

/** Not worth a word as long as corners are being touched. */
const FEW_TOUCHES = "touches-not-enough";

/** The findings of one severity. */
export function makeFindings(_app: App, which: NonNullable<Finding["severity"]>): Part {
  const rows = h("ul", { class: "findings" });
  const id = which === "changes-answer" ? "grave" : null;
  const element = h("section", { class: `card of-${which}`, id }, said(h("h2"), which === "info" ? "remarks" : "findings"), rows);
  const draw = list<Finding>(rows, ({ code, message }) => `${code} ${message}`, findingRow);
  return {
    element,
    update(state) {
      const found = (state.progress?.findings ?? []).filter(({ code }) => state.step !== "touch" || code !== FEW_TOUCHES);
      const all = found.map((finding) => ({ ...finding, severity: severity(finding, state) }));
      const wanted = all.filter((finding) => finding.severity === which);
      draw(wanted);
      show(element, wanted.length > 0);
    },
  };
}

export function makeRefused(_app: App): Part {
  const rows = h("ul", { class: "findings" });
  const element = h("section", { class: "card" }, said(h("h2"), "refused"), rows);
  const draw = list<Finding>(rows, ({ code }) => code ?? "", findingRow);
  return {
    element,
    update(state) {
      const refused = [...(state.refused ?? [])].reverse().slice(0, REFUSED_SHOWN);
      draw(refused.map(({ time_s, why }) => ({ code: `${time_s} ${why}`, severity: "changes-answer", message: why })));
      show(element, refused.length > 0);
    },
  };
}
