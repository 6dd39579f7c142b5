// Small drawings of numbers: a bar against the tolerance, the history of the error, bars of the six directions.

import { attribute, h, kind, list, show, svg, text, width } from "./dom";
import { mm, small } from "./numbers";
import type { Direction, Maybe } from "./state";
import { t } from "./words";

/** A bar from nought to twice the tolerance, with a line at the tolerance. */
export function toleranceBar() {
  const fill = h("span", { class: "fill" });
  const element = h("div", { class: "tolerance", role: "img" }, fill, h("span", { class: "limit" }));
  return {
    element,
    update(value: Maybe<number>, tolerance: Maybe<number>, label: string): void {
      const part = typeof value === "number" && tolerance ? value / (2 * tolerance) : null;
      width(fill, part === null ? 0 : Math.max(1.5, 100 * part));
      kind(element, "good", part !== null && part <= 0.5);
      kind(element, "over", part !== null && part > 0.5);
      attribute(element, "aria-label", label);
    },
  };
}

const [WIDE, HIGH] = [300, 74];
const [LEFT, RIGHT, TOP, BOTTOM] = [8, 8, 10, 20];
const CLIP = 4; // times the tolerance: what is larger is drawn at the upper edge

/** The predicted error after each capture, and the tolerance as a line. */
export function history() {
  const curve = svg("path", { class: "curve" });
  const limit = svg("path", { class: "limit" });
  const dots = svg("g");
  const caption = svg("text", { class: "axis", x: LEFT, y: HIGH - 4 });
  const last = svg("text", { class: "axis", x: WIDE - RIGHT, y: HIGH - 4, "text-anchor": "end" });
  const element = svg("svg", { viewBox: `0 0 ${WIDE} ${HIGH}`, class: "history", role: "img" }, limit, curve, dots, caption, last);
  let drawn = "";
  return {
    element,
    update(points: [number, Maybe<number>][], tolerance: Maybe<number>): void {
      const known = points.filter((point): point is [number, number] => typeof point[1] === "number");
      const name = JSON.stringify([known, tolerance, t("captures")]);
      show(element, known.length > 1);
      if (name === drawn) return;
      drawn = name;
      const [first, end] = [known[0], known[known.length - 1]];
      if (!first || !end) return;
      const most = Math.max(...known.map(([, error]) => error));
      const top = tolerance ? Math.min(most, CLIP * tolerance, Math.max(most, 1.2 * tolerance)) : most;
      const ceiling = tolerance ? Math.max(top, 1.2 * tolerance) : top;
      const x = (n: number) => LEFT + ((WIDE - LEFT - RIGHT) * (n - first[0])) / Math.max(1, end[0] - first[0]);
      const y = (error: number) => HIGH - BOTTOM - ((HIGH - TOP - BOTTOM) * Math.min(error, ceiling)) / ceiling;
      attribute(curve, "d", known.map(([n, error], i) => `${i ? "L" : "M"}${x(n).toFixed(1)} ${y(error).toFixed(1)}`).join(""));
      attribute(limit, "d", tolerance ? `M${LEFT} ${y(tolerance).toFixed(1)}H${WIDE - RIGHT}` : "");
      dots.replaceChildren(
        ...known.map(([n, error]) =>
          svg("circle", { cx: x(n), cy: y(error), r: 3, class: tolerance && error <= tolerance ? "good" : "" }, svg("title", {}, `${n}: ${mm(error)} mm`)),
        ),
      );
      text(caption, t("captures_count", { count: first[0] }));
      text(last, t("captures_count", { count: end[0] }));
      const told = known.map(([n, error]) => `${n}: ${mm(error)} mm`).join(", ");
      attribute(element, "aria-label", t("history_label", { points: told }));
    },
  };
}

function directionName(name: string): string {
  return name.startsWith("about ") ? t("about_axis", { axis: name.slice(6) }) : name;
}

/** The standard deviations of the six directions, those of one unit against each other. */
export function directions() {
  const element = h("dl", { class: "directions" }); // positions in the first column, rotations in the second
  let all: Direction[] = [];
  const draw = list<Direction>(
    element,
    (direction) => direction.name,
    () => {
      const [name, fill, value] = [h("dt"), h("span", { class: "fill" }), h("b")];
      const bar = h("span", { class: "bar", "aria-hidden": "true" }, fill);
      const row = h("div", { class: "direction" }, name, h("dd", {}, bar, value));
      return {
        element: row,
        update(direction: Direction): void {
          const known = typeof direction.sigma === "number";
          const most = Math.max(...all.filter(({ unit }) => unit === direction.unit).map(({ sigma }) => sigma ?? 0));
          text(name, directionName(direction.name));
          width(fill, known && most > 0 ? (100 * (direction.sigma as number)) / most : 100);
          kind(row, "unknown", !known);
          const unit = direction.unit === "deg" ? "°" : ` ${direction.unit ?? ""}`;
          text(value, known ? `${small(direction.sigma)}${unit}` : "?");
          attribute(row, "title", known ? null : t("unknown_direction", { direction: directionName(direction.name) }));
        },
      };
    },
  );
  return {
    element,
    update(given: Direction[]): void {
      all = given;
      const [first, second] = [given.filter(isPosition), given.filter((one) => !isPosition(one))];
      draw(first.flatMap((one, i) => [one, second[i]]).concat(second.slice(first.length)).filter((one) => one !== undefined));
    },
  };
}

const isPosition = (direction: Direction) => direction.unit !== "deg";
