// Moves the robot of the virtual cell in the camera's axes. No other robot can be moved from here.

import type { App, Part } from "./app";
import { card } from "./controls";
import { h, show } from "./dom";
import { said, t } from "./words";

const MOVE_MM = 40;
const TURN_DEG = 10;
const AXES = ["x", "y", "z"] as const;

export function makeJog(app: App): Part {
  const along = (axis: number, size: number) => AXES.map((_, i) => (i === axis ? size : 0));
  const key = (axis: number, sign: number, turns: boolean) => {
    const name = turns ? t("about_axis", { axis: AXES[axis] ?? "" }) : (AXES[axis] ?? "");
    const made = h("button", { type: "button" }, `${sign < 0 ? "−" : "+"} ${turns ? "↻ " : ""}${AXES[axis]}`);
    made.setAttribute("aria-label", `${sign < 0 ? "−" : "+"} ${name}`);
    made.addEventListener("click", (event) => {
      if (event.detail > 0) made.blur();
      const [move, turn] = turns ? [0, sign * TURN_DEG] : [sign * MOVE_MM, 0];
      void app.send({ do: "jog", move_mm: along(axis, move), turn_deg: along(axis, turn) });
    });
    return made;
  };
  const rows = [false, true].flatMap((turns) => [-1, 1].flatMap((sign) => AXES.map((_, axis) => key(axis, sign, turns))));
  const element = card("jog", said(h("p", { class: "hint" }), "jog_what"), h("div", { class: "jog" }, ...rows));
  return {
    element,
    update: (state) => show(element, Boolean(state.virtual_cell)),
  };
}
