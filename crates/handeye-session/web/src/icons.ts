// The few icons of the page, drawn with lines.

import { svg } from "./dom";

const PATHS = {
  check: "M5 12.5 10 17.5 19 7",
  lock: "M7 11V8a5 5 0 0 1 10 0v3M6 11h12v9H6z",
  warning: "M12 3.5 22 20.5H2zM12 10v4.5M12 17.2v.6",
  cross: "M6 6l12 12M18 6 6 18",
  bin: "M5 7h14M10 7V4.5h4V7M7 7l1 13h8l1-13",
  again: "M19 12a7 7 0 1 1-2.2-5.1M19 4v5h-5",
  undo: "M9 5 4 10l5 5M4 10h10a5.5 5.5 0 0 1 0 11h-3",
  sound: "M4 9.5v5h3.5L12 19V5L7.5 9.5zM15.5 9a4 4 0 0 1 0 6M18 6.5a8 8 0 0 1 0 11",
  mute: "M4 9.5v5h3.5L12 19V5L7.5 9.5zM16 10l5 5M21 10l-5 5",
  keys: "M3 7h18v11H3zM7 11h.5M11 11h.5M15 11h.5M8 15h8",
  swap: "M4 9h13l-4-4M20 15H7l4 4",
  copy: "M9 9h11v11H9zM5 15H4V4h11v1",
  page: "M6 3h8l5 5v13H6zM14 3v5h5M9 13h7M9 17h7",
  skip: "M5 5l8 7-8 7zM17 5v14",
  back: "M10 5l-7 7 7 7M3 12h18",
  down: "M12 4v12M6 11l6 6 6-6M5 21h14",
} as const;

export type Icon = keyof typeof PATHS;

export function icon(name: Icon): SVGSVGElement {
  return svg(
    "svg",
    { viewBox: "0 0 24 24", class: "icon", "aria-hidden": "true", focusable: "false" },
    svg("path", { d: PATHS[name] }),
  );
}

export function setIcon(drawing: SVGSVGElement, name: Icon): void {
  const path = drawing.firstElementChild;
  if (path && path.getAttribute("d") !== PATHS[name]) path.setAttribute("d", PATHS[name]);
}
