// The captures as a list, the newest first: residual, what it was rejected for; select one to see it, delete it, retake it.

import type { App, Part } from "./app";
import { button } from "./controls";
import { attribute, h, kind, list, show, text, width } from "./dom";
import { icon } from "./icons";
import { mm } from "./numbers";
import { isOutlier, type Capture, type State } from "./state";
import { said, sentence, t, showTranslated, translated } from "./words";

let scale = 1; // mm of a full bar

function captureRow(app: App, id: string) {
  const fill = h("span", { class: "fill" });
  const [millimetres, pixels, reason] = [h("b"), h("small"), h("p", { class: "reason" })];
  const sign = icon("warning");
  const select = h(
    "button",
    { type: "button", class: "capture" },
    h("span", { class: "id" }, id),
    h("span", { class: "bar", "aria-hidden": "true" }, fill),
    sign,
    millimetres,
    pixels,
  );
  select.addEventListener("click", (event) => {
    if (event.detail > 0) select.blur();
    app.choose({ selected: app.choices.selected === id ? null : id, large: "picture" });
  });
  const tools = h(
    "div",
    { class: "tools" },
    button("delete", () => void app.send({ do: "delete", id }), { icon: "bin" }),
    button("retake", () => void app.send({ do: "retake", id }), { icon: "again" }),
  );
  const element = h("li", {}, select, reason, tools);
  let wasSelected = false;
  return {
    element,
    update(capture: Capture): void {
      const selected = app.choices.selected === id;
      const outlier = isOutlier(capture);
      const error = capture.residual_mm;
      width(fill, typeof error === "number" ? (100 * error) / scale : 0);
      text(millimetres, typeof error === "number" ? `${mm(error)} mm` : t(outlier ? "not_used" : "no_residual"));
      text(pixels, typeof capture.residual_px === "number" ? `${mm(capture.residual_px)} px` : "");
      showTranslated(reason, capture.reason, sentence);
      show(reason, Boolean(capture.reason) && (selected || outlier));
      show(sign, outlier);
      show(tools, selected);
      kind(element, "outlier", outlier);
      kind(element, "selected", selected);
      attribute(select, "aria-pressed", String(selected));
      if (selected && !wasSelected) element.scrollIntoView({ block: "nearest" });
      wasSelected = selected;
    },
  };
}

export function makeCaptures(app: App): Part {
  const count = h("span", { class: "count" });
  const undo = button("undo", () => void app.send({ do: "undo" }), { icon: "undo" });
  const rows = h("ol", { class: "captures" });
  const none = said(h("p", { class: "none" }), "no_captures");
  const deleted = h("ul", { class: "deleted" });
  const draw = list<Capture>(
    rows,
    (capture) => capture.id,
    (capture) => captureRow(app, capture.id),
  );
  const drawDeleted = list<{ id: string }>(
    deleted,
    ({ id }) => id,
    ({ id }) => {
      const name = h("span");
      const restore = button("restore", () => void app.send({ do: "restore", id }), { icon: "undo" });
      return { element: h("li", {}, name, restore), update: () => text(name, t("deleted_id", { id })) };
    },
  );
  const element = h(
    "section",
    { class: "card list" },
    h("div", { class: "top" }, h("h2", {}, said(h("span"), "captures"), " ", count), undo),
    none,
    rows,
    deleted,
  );
  return {
    element,
    update(state: State) {
      const captures = state.captures ?? [];
      const errors = captures.filter((capture) => !isOutlier(capture)).map(({ residual_mm: error }) => error ?? 0);
      scale = Math.max(state.cell?.tolerance_mm ?? 0, ...errors, 1e-6);
      text(count, String(captures.length));
      show(count, captures.length > 0);
      show(none, captures.length === 0);
      show(undo, Boolean(state.can_undo));
      attribute(undo, "title", state.can_undo && translated(state.can_undo));
      draw([...captures].reverse());
      drawDeleted((state.deleted ?? []).filter(({ id }) => !/^[pt]/.test(id)));
    },
  };
}
