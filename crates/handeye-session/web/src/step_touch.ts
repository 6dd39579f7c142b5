// The step "touch": where the tip is in the flange, which boards were laid down to be touched, which corner the tip touches
// next, and how far the touches are from the answer.

import { placeAction } from "./actions";
import type { App, Part } from "./app";
import { button, card } from "./controls";
import { h, list, show, svg, text } from "./dom";
import { numberField } from "./number_field";
import { mm } from "./numbers";
import { isPlaced, isTouching, touchesHere, type Maybe, type Placement, type State, type Target, type Touch, type Touching } from "./state";
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
  const here = (touch.touches ?? []).filter(({ placement }) => (placement ?? null) === (touch.placement ?? null));
  const touched = here.map(({ corner }) => svg("circle", { ...at(corner), r: 6, class: "touched" }));
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
      const number = String(touch.corner);
      text(corner, touch.placement ? t("placed_corner", { id: touch.placement, number }) : t("corner_number", { number }));
      text(error, typeof touch.residual_mm === "number" ? `${mm(touch.residual_mm)} mm` : t("no_residual"));
    },
  };
}

function placementRow(app: App, id: string) {
  const name = h("span");
  const remove = button("delete", () => void app.send({ do: "delete", id }), { icon: "bin" });
  return {
    element: h("li", {}, name, h("b"), remove),
    update: ({ touches }: Placement) => text(name, t("placement_touches", { id, count: String(touches ?? 0) })),
  };
}

/** The boards that were laid into the view of a camera beside the robot. */
function placementsCard(app: App) {
  const rows = h("ol", { class: "placements" });
  const draw = list<Placement>(
    rows,
    ({ id }) => id,
    ({ id }) => placementRow(app, id),
  );
  const place = () => app.state && placeAction(app, app.state).run();
  const [again, lay] = [button("place_again", place), button("lay_board", place)];
  const element = card("placements", said(h("p", { class: "hint" }), "placement_what"), rows, again, lay);
  return {
    element,
    update(touch: Touching, state: State): void {
      show(element, touch.lays === true);
      // before that it is the primary action
      const isNext = isPlaced(touch) && !state.taking;
      show(again, isNext && !state.virtual_cell);
      show(lay, isNext && Boolean(state.virtual_cell));
      draw([...(touch.placements ?? [])].reverse());
    },
  };
}

/** What was deleted of placements and touches, to take it in again. */
function deletedHere(app: App) {
  const element = h("ul", { class: "deleted" });
  const draw = list<{ id: string }>(
    element,
    ({ id }) => id,
    ({ id }) => {
      const name = h("span");
      const restore = button("restore", () => void app.send({ do: "restore", id }), { icon: "undo" });
      return { element: h("li", {}, name, restore), update: () => text(name, t("deleted_id", { id })) };
    },
  );
  return { element, update: (all: { id: string }[]) => draw(all.filter(({ id }) => /^[pt]/.test(id))) };
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
  const deleted = deletedHere(app);
  const undo = button("undo", () => void app.send({ do: "undo" }), { icon: "undo" });
  const made = card("touches", rows, deleted.element, undo);
  const placements = placementsCard(app);
  const why = h("p", { class: "hint" });
  const next = card("touch_next", which, place, why);
  const tip = card("tip", said(h("p", { class: "hint" }), "tip_hint"), h("div", { class: "grid" }, ...axes.map((axis) => axis.element)));
  const cards = [placements.element, next, made];
  const element = h("div", { class: "stack" }, tip, ...cards);
  let drawn = "";
  let isTipLast = false;

  /** Where the tip is comes first while nobody has said it, and last where it was said before this step; never under a hand. */
  function order(last: boolean): void {
    if (last === isTipLast || tip.contains(document.activeElement)) return;
    isTipLast = last;
    element.replaceChildren(...(last ? [...cards, tip] : [tip, ...cards]));
  }

  function sendTip(): void {
    const [x, y, z] = axes.map((axis) => axis.value());
    if (typeof x !== "number" || typeof y !== "number" || typeof z !== "number") return;
    void app.send({ do: "tip", in_flange_mm: [x, y, z] });
  }

  return {
    element,
    update(state) {
      const touch = isTouching(state) ? touchesHere(state) : null;
      show(element, Boolean(touch));
      if (!touch) return;
      order(state.step === "verify" && Boolean(touch.tip_mm));
      axes.forEach((axis, k) => axis.set(touch.tip_mm?.[k]));
      placements.update(touch, state);
      text(which, t("corner_number", { number: String(touch.corner) }));
      text(why, t(state.step === "verify" ? "verify_touches_why" : "touch_why"));
      show(next, !touch.lays || isPlaced(touch));
      const touches = touch.touches ?? [];
      draw([...touches].reverse());
      const gone = state.deleted ?? [];
      deleted.update(gone);
      show(undo, Boolean(state.can_undo));
      show(made, touches.length > 0 || gone.some(({ id }) => /^[pt]/.test(id)));
      const name = JSON.stringify([state.cell?.target, touch.corner, touch.placement, touches.map(({ corner }) => corner)]);
      if (name === drawn) return;
      drawn = name;
      const board = drawing(state.cell?.target, touch);
      place.replaceChildren(...(board ? [board] : []));
      show(place, board !== null);
    },
  };
}
