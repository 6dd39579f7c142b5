// The step "verify": views that the calibration is not made with, and how far they are from where it predicts them.

import type { App, Part } from "./app";
import { button, card } from "./controls";
import { h, kind, list, show, text } from "./dom";
import { mm } from "./numbers";
import type { Verified } from "./state";
import { said, t } from "./words";

function viewRow(app: App, id: string) {
  const name = h("span");
  const error = h("b");
  const remove = button("delete", () => void app.send({ do: "delete", id }), { icon: "bin" });
  return {
    element: h("li", {}, name, error, remove),
    update(view: Verified): void {
      text(name, t("view_number", { number: id }));
      text(error, typeof view.distance_mm === "number" ? `${mm(view.distance_mm)} mm` : t("no_residual"));
    },
  };
}

export function makeStepVerify(app: App): Part {
  const answer = h("p", { class: "which verified" });
  const numbers = h("p", { class: "hint" });
  const rows = h("ol", { class: "touches" });
  const draw = list<Verified>(
    rows,
    ({ id }) => id,
    ({ id }) => viewRow(app, id),
  );
  const element = h(
    "div",
    { class: "stack" },
    card("verification", said(h("p", { class: "hint" }), "verification_why"), answer, numbers, rows),
  );
  return {
    element,
    update(state) {
      const { views, rms_mm: rms, expected_mm: expected, agrees } = state.verify ?? {};
      const isKnown = typeof agrees === "boolean";
      show(answer, isKnown);
      show(numbers, isKnown);
      kind(answer, "contradicts", agrees === false);
      text(answer, t(agrees ? "verified_yes" : "verified_no"));
      text(numbers, t("verified_by", { rms: mm(rms), expected: mm(expected) }));
      draw([...(views ?? [])].reverse());
    },
  };
}
