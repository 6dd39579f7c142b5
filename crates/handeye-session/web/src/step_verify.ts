// The step "verify": views that the calibration is not made with, or corners that are touched, and how far they are from where
// it predicts them.

import type { App, Part } from "./app";
import { button, card } from "./controls";
import { attribute, h, kind, list, show, text } from "./dom";
import { mm } from "./numbers";
import type { Verified, VerifyBy } from "./state";
import { named, said, t, type Key } from "./words";

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

/** What the result is verified by: this browser's choice. */
function makeChoice(app: App) {
  const ways: VerifyBy[] = ["views", "touches"];
  const choices = ways.map((by) => {
    const input = h("input", { type: "radio", name: "verify-by", value: by });
    input.addEventListener("change", () => app.choose({ by }));
    return { by, input, element: h("label", { class: "choice" }, input, said(h("b"), `by_${by}` as Key)) };
  });
  const group = h("div", { role: "radiogroup", class: "choices pair" }, ...choices.map((choice) => choice.element));
  named(group, "verification");
  const what = h("p", { class: "hint" });
  return {
    group,
    what,
    update(): void {
      for (const { by, input, element: label } of choices) {
        const chosen = app.choices.by === by;
        if (input.checked !== chosen) input.checked = chosen;
        kind(label, "chosen", chosen);
        attribute(label, "data-by", by);
      }
      text(what, t(`by_${app.choices.by}_what` as Key));
    },
  };
}

export function makeStepVerify(app: App): Part {
  const answer = h("p", { class: "which verified" });
  const ofViews = h("p", { class: "hint" });
  const ofTouches = h("p", { class: "hint" });
  const choice = makeChoice(app);
  const rows = h("ol", { class: "touches" });
  const draw = list<Verified>(
    rows,
    ({ id }) => id,
    ({ id }) => viewRow(app, id),
  );
  const views = card("verification_views", rows);
  const element = h("div", { class: "stack" }, card("verification", answer, ofViews, ofTouches, choice.group, choice.what), views);
  return {
    element,
    update(state) {
      const { views: all = [], rms_mm: rms, expected_mm: expected, agrees, touch, touches_expected_mm: touched } = state.verify ?? {};
      choice.update();
      show(choice.group, Boolean(touch));
      const isKnown = typeof agrees === "boolean";
      show(answer, isKnown);
      kind(answer, "contradicts", agrees === false);
      text(answer, t(agrees ? "verified_yes" : "verified_no"));
      show(ofViews, typeof rms === "number");
      text(ofViews, t("verified_by_views", { rms: mm(rms), expected: mm(expected) }));
      show(ofTouches, typeof touched === "number");
      text(ofTouches, t("verified_by_touches", { rms: mm(touch?.rms_mm), expected: mm(touched) }));
      show(views, app.choices.by === "views" && all.length > 0);
      draw([...all].reverse());
    },
  };
}
