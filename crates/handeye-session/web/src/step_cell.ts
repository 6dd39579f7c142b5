// The step "cell": where the camera is, and which error the work tolerates.

import { fixedBy } from "./actions";
import type { App, Part } from "./app";
import { card, makeFixed } from "./controls";
import { attribute, h, kind, svg } from "./dom";
import { numberField } from "./number_field";
import type { Setup } from "./state";
import { named, said, type Key } from "./words";

/** A drawing of the setup: arm, camera, board. */
function sketch(setup: Setup): SVGSVGElement {
  const line = (d: string, look: string) => svg("path", { d, class: look });
  const camera = (x: number, y: number, angle: number) =>
    svg(
      "g",
      { transform: `translate(${x} ${y}) rotate(${angle})` },
      line("M-7 -9h14v12h-14z", "camera"),
      line("M-5 3L-20 40H20L5 3z", "sight"),
    );
  const board = (x: number, y: number, angle: number) =>
    svg("g", { transform: `translate(${x} ${y}) rotate(${angle})` }, line("M-22 0h44v6h-44z", "board"));
  const arm = line("M24 92V58L52 26L86 34", "arm");
  const base = line("M10 92h28", "ground");
  const inHand = setup === "eye-in-hand";
  return svg(
    "svg",
    { viewBox: "0 0 150 104", class: "sketch", "aria-hidden": "true" },
    base,
    arm,
    inHand ? camera(90, 42, -8) : camera(128, 20, 28),
    inHand ? board(96, 88, 0) : board(90, 46, -40),
    line("M4 95h142", "ground"),
  );
}

export function makeStepCell(app: App): Part {
  const setups: Setup[] = ["eye-in-hand", "eye-to-hand"];
  const choices = setups.map((setup) => {
    const input = h("input", { type: "radio", name: "setup", value: setup });
    input.addEventListener("change", () => void app.send({ do: "cell", setup }));
    const words = h("span", {}, said(h("b"), setup.replaceAll("-", "_") as Key), said(h("small"), `${setup.replaceAll("-", "_")}_what` as Key));
    return { setup, input, element: h("label", { class: "choice" }, input, sketch(setup), words) };
  });
  const tolerance = numberField({
    label: "tolerance",
    unit: "mm",
    step: 0.1,
    least: 0.01,
    changed: () => void app.send({ do: "cell", tolerance_mm: tolerance.value() }),
  });
  const group = h("div", { role: "radiogroup", class: "choices" }, ...choices.map(({ element }) => element));
  named(group, "where_is_camera");
  const fixed = makeFixed();
  const element = h(
    "div",
    { class: "stack" },
    card("where_is_camera", fixed.element, group),
    card("how_accurate", tolerance.element, said(h("p", { class: "hint" }), "tolerance_what")),
  );
  return {
    element,
    update(state) {
      for (const { setup, input, element: label } of choices) {
        const chosen = state.cell?.setup === setup;
        if (input.checked !== chosen) input.checked = chosen;
        attribute(input, "disabled", fixedBy(state) !== null && !chosen);
        attribute(label, "data-setup", setup);
        kind(label, "chosen", chosen);
        kind(label, "fixed", fixedBy(state) !== null && !chosen);
      }
      fixed.update(state);
      tolerance.set(state.cell?.tolerance_mm);
    },
  };
}
