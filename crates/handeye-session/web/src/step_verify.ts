// The step "verify": views that were not used, and how far the result is from right at each.

import type { App, Part } from "./app";
import { card } from "./controls";
import { h, kind, list, show, text } from "./dom";
import { makeJog } from "./jog";
import { mm } from "./numbers";
import { toleranceBar } from "./plots";
import type { Maybe } from "./state";
import { said, t } from "./words";

interface Check {
  id: string;
  error: Maybe<number>;
  tolerance: Maybe<number>;
}

function checkRow() {
  const [name, value] = [h("span", { class: "id" }), h("b")];
  const bar = toleranceBar();
  return {
    element: h("li", {}, name, bar.element, value),
    update({ id, error, tolerance }: Check): void {
      text(name, id);
      text(value, `${mm(error)} mm`);
      bar.update(error, tolerance, t("error_label", { error: mm(error), tolerance: mm(tolerance) }));
    },
  };
}

export function makeStepVerify(app: App): Part {
  const sentence = h("p", { class: "verdict" });
  const worst = h("div", { class: "number" });
  const [number, limit] = [h("b"), h("small")];
  worst.append(number, h("span", { class: "unit" }, "mm"), limit);
  const rows = h("ul", { class: "checks" });
  const none = said(h("p", { class: "none" }), "no_checks");
  const draw = list<Check>(rows, ({ id }) => id, checkRow);
  const box = card("verify", worst, sentence, none, rows);
  box.classList.add("accuracy");
  const jog = makeJog(app);
  const element = h("div", { class: "stack" }, box, jog.element);
  return {
    element,
    update(state) {
      show(element, Boolean(state.verify));
      const verify = state.verify;
      const tolerance = state.cell?.tolerance_mm;
      text(number, mm(verify?.worst_mm));
      text(limit, tolerance ? t("of_tolerance", { tolerance: mm(tolerance) }) : "");
      text(sentence, verify?.sentence);
      show(sentence, Boolean(verify?.sentence));
      kind(box, "good", verify?.verdict === "holds");
      kind(box, "bad", verify?.verdict === "does not hold");
      draw((verify?.views ?? []).map((view) => ({ id: view.id, error: view.error_mm, tolerance })));
      show(none, !verify?.views?.length);
      jog.update(state);
    },
  };
}
