// The step "touch": where the tip is in the flange, which corner of the board it touches next, and how far the touches are
// from the answer.

import type { App, Part } from "./app";
import { button, card } from "./controls";
import { h, list, show, svg, text } from "./dom";
import { numberField } from "./number_field";
import { mm } from "./numbers";
import type { Maybe, Target, Touch, Touching } from "./state";
import { said, t } from "./words";

const SIDE = 20; // of a square in the drawing
const MOST = 60; // squares in a row that are drawn
const FARTHEST = 2000; // mm from flange to tip

/** The board with the corner to touch, and those that were; null where it has no squares. */
function drawing(target: Maybe<Target>, touch: Touching): SVGSVGElement | null {
  const isCharuco = target?.kind === "charuco";
  if (!isCharuco && target?.kind !== "checkerboard") return null;
  const columns = Number(isCharuco ? target?.squares_x : Number(target?.columns) + 1);
  const rows = Number(isCharuco ? target?.squares_y : Number(target?.rows) + 1);
  if (!(columns > 1 && rows > 1 && columns < MOST && rows < MOST)) return null;
  const squares: SVGElement[] = [];
  for (let row = 0; row < rows; row += 1) {
    for (let column = row % 2; column < columns; column += 2) {
      squares.push(svg("rect", { x: column * SIDE, y: row * SIDE, width: SIDE, height: SIDE }));
    }
  }
  const inRow = columns - 1;
  const at = (corner: number) => ({ cx: ((corner % inRow) + 1) * SIDE, cy: (Math.floor(corner / inRow) + 1) * SIDE });
  const touched = (touch.touches ?? []).map(({ corner }) => svg("circle", { ...at(corner), r: 6, class: "touched" }));
  const next = svg("circle", { ...at(touch.corner), r: 11, class: "mark" });
  return svg(
    "svg",
    { viewBox: `-4 -4 ${columns * SIDE + 8} ${rows * SIDE + 8}`, class: "touch-board", "aria-hidden": "true" },
    svg("rect", { x: 0, y: 0, width: columns * SIDE, height: rows * SIDE, class: "paper" }),
    svg("g", { class: "squares" }, ...squares),
    ...touched,
    next,
  );
}

function touchRow(app: App, id: string) {
  const corner = h("span");
  const error = h("b");
  const remove = button("delete", () => void app.send({ do: "untouch", id }), { icon: "bin" });
  return {
    element: h("li", {}, corner, error, remove),
    update(touch: Touch): void {
      text(corner, t("corner_number", { number: String(touch.corner) }));
      text(error, typeof touch.residual_mm === "number" ? `${mm(touch.residual_mm)} mm` : t("no_residual"));
    },
  };
}

export function makeStepTouch(app: App): Part {
  const axes = (["tip_x", "tip_y", "tip_z"] as const).map((label) =>
    numberField({ label, unit: "mm", step: 1, least: -FARTHEST, buttons: false, changed: sendTip }),
  );
  const place = h("div", { class: "drawing" });
  const which = h("p", { class: "which" });
  const rows = h("ol", { class: "touches" });
  const draw = list<Touch>(
    rows,
    ({ id }) => id,
    ({ id }) => touchRow(app, id),
  );
  const made = card("touches", rows);
  const element = h(
    "div",
    { class: "stack" },
    card("tip", said(h("p", { class: "hint" }), "tip_hint"), h("div", { class: "grid" }, ...axes.map((axis) => axis.element))),
    card("touch_next", which, place, said(h("p", { class: "hint" }), "touch_why")),
    made,
  );
  let drawn = "";

  function sendTip(): void {
    const [x, y, z] = axes.map((axis) => axis.value());
    if (typeof x !== "number" || typeof y !== "number" || typeof z !== "number") return;
    void app.send({ do: "tip", in_flange_mm: [x, y, z] });
  }

  return {
    element,
    update(state) {
      const touch = state.touch;
      if (!touch) return;
      axes.forEach((axis, k) => axis.set(touch.tip_mm?.[k]));
      text(which, t("corner_number", { number: String(touch.corner) }));
      const touches = touch.touches ?? [];
      draw([...touches].reverse());
      show(made, touches.length > 0);
      const name = JSON.stringify([state.cell?.target, touch.corner, touches.map(({ corner }) => corner)]);
      if (name === drawn) return;
      drawn = name;
      const board = drawing(state.cell?.target, touch);
      place.replaceChildren(...(board ? [board] : []));
      show(place, board !== null);
    },
  };
}
