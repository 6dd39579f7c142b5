// The step "touch": which corners of the board the tip touches.

import type { App, Part } from "./app";
import { card } from "./controls";
import { h, show, svg } from "./dom";
import type { Maybe, Target } from "./state";
import { said } from "./words";

const SIDE = 20; // of a square in the drawing

/** The board with its outermost inner corners and their numbers; null where it has no squares. */
function drawing(target: Maybe<Target>): SVGSVGElement | null {
  const isCharuco = target?.kind === "charuco";
  if (!isCharuco && target?.kind !== "checkerboard") return null;
  const columns = Number(isCharuco ? target?.squares_x : Number(target?.columns) + 1);
  const rows = Number(isCharuco ? target?.squares_y : Number(target?.rows) + 1);
  if (!(columns > 1 && rows > 1 && columns < 60 && rows < 60)) return null;
  const squares: SVGElement[] = [];
  for (let row = 0; row < rows; row += 1) {
    for (let column = row % 2; column < columns; column += 2) {
      squares.push(svg("rect", { x: column * SIDE, y: row * SIDE, width: SIDE, height: SIDE }));
    }
  }
  const [c, r] = [columns - 1, rows - 1];
  const corners: [string, number, number, number][] = [
    ["A", 0, 1, 1],
    ["B", c - 1, c, 1],
    ["C", r * c - 1, c, r],
    ["D", (r - 1) * c, 1, r],
  ];
  const marks = corners.flatMap(([name, id, x, y]) => [
    svg("circle", { cx: x * SIDE, cy: y * SIDE, r: 9, class: "mark" }),
    svg("text", { x: x * SIDE, y: y * SIDE + (y === 1 ? -14 : 28), "text-anchor": "middle" }, `${name} = ${id}`),
  ]);
  return svg(
    "svg",
    { viewBox: `-30 -24 ${columns * SIDE + 60} ${rows * SIDE + 48}`, class: "touch-board", "aria-hidden": "true" },
    svg("rect", { x: 0, y: 0, width: columns * SIDE, height: rows * SIDE, class: "paper" }),
    svg("g", { class: "squares" }, ...squares),
    ...marks,
  );
}

export function makeStepTouch(_app: App): Part {
  const place = h("div", { class: "drawing" });
  const how = h("ol", { class: "how" }, said(h("li"), "touch_1"), said(h("li"), "touch_2"), said(h("li"), "touch_3"));
  const element = card("touch", said(h("p"), "touch_why"), place, how);
  let drawn = "?";
  return {
    element,
    update(state) {
      show(element, Boolean(state.touch));
      const name = JSON.stringify(state.cell?.target ?? null);
      if (name === drawn) return;
      drawn = name;
      const board = drawing(state.cell?.target);
      place.replaceChildren(...(board ? [board] : []));
      show(place, board !== null);
    },
  };
}
