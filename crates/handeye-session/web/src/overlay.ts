// What is drawn over a picture: corners, the board's outline of the next view, the way there, residuals.

import { isOutlier, type Capture, type CaptureDetail, type Maybe, type Pair, type State } from "./state";
import { mm } from "./numbers";
import { t } from "./words";

/** From pixels of the camera to those of the canvas. */
export interface Fit {
  scale: number;
  left: number;
  top: number;
  width: number; // of the canvas
  height: number;
}

export interface Colours {
  found: string;
  next: string;
  earlier: string;
  residual: string;
  outlier: string;
}

const at = (fit: Fit, [u, v]: Pair): Pair => [fit.left + (u + 0.5) * fit.scale, fit.top + (v + 0.5) * fit.scale];

const mean = (points: Pair[]): Pair => [
  points.reduce((sum, p) => sum + p[0], 0) / points.length,
  points.reduce((sum, p) => sum + p[1], 0) / points.length,
];

/** Draws twice, dark below light, so that it is seen on every picture. */
function outlined(draw: CanvasRenderingContext2D, colour: string, width: number): void {
  draw.strokeStyle = "rgba(0,0,0,0.55)";
  draw.lineWidth = width + 2;
  draw.stroke();
  draw.strokeStyle = colour;
  draw.lineWidth = width;
  draw.stroke();
}

function dots(draw: CanvasRenderingContext2D, fit: Fit, points: Pair[], radius: number): void {
  draw.beginPath();
  for (const point of points) {
    const [x, y] = at(fit, point);
    draw.moveTo(x + radius, y);
    draw.arc(x, y, radius, 0, 2 * Math.PI);
  }
}

function label(draw: CanvasRenderingContext2D, words: string, x: number, y: number, colour: string, fit: Fit): void {
  draw.font = '600 14px system-ui, "Segoe UI", Roboto, "DejaVu Sans", sans-serif';
  const wide = draw.measureText(words).width + 16;
  const left = Math.max(6, Math.min(fit.width - wide - 6, x - wide / 2));
  const top = Math.max(6, Math.min(fit.height - 30, y - 12));
  draw.fillStyle = "rgba(8,12,18,0.78)";
  draw.beginPath();
  draw.roundRect(left, top, wide, 24, 6);
  draw.fill();
  draw.fillStyle = colour;
  draw.textBaseline = "middle";
  draw.textAlign = "left";
  draw.fillText(words, left + 8, top + 12.5);
}

/** Corners of earlier captures: what of the image is covered. */
export function drawEarlier(draw: CanvasRenderingContext2D, fit: Fit, all: Pair[][], colours: Colours): void {
  draw.fillStyle = colours.earlier;
  for (const points of all) {
    for (const point of points) {
      const [x, y] = at(fit, point);
      draw.fillRect(x - 1.5, y - 1.5, 3, 3);
    }
  }
}

/** About a fifth of the distance between neighbouring corners, on the canvas. */
function cornerRadius(fit: Fit, corners: Pair[]): number {
  const [us, vs] = [corners.map(([u]) => u), corners.map(([, v]) => v)];
  const area = (Math.max(...us) - Math.min(...us)) * (Math.max(...vs) - Math.min(...vs));
  return Math.min(5.5, Math.max(2, 0.14 * fit.scale * Math.sqrt(area / Math.max(1, corners.length))));
}

export function drawFound(draw: CanvasRenderingContext2D, fit: Fit, corners: Pair[], colours: Colours): void {
  dots(draw, fit, corners, cornerRadius(fit, corners));
  outlined(draw, colours.found, 1.8);
}

function polygon(draw: CanvasRenderingContext2D, fit: Fit, points: Pair[]): void {
  draw.beginPath();
  points.forEach((point, i) => (i ? draw.lineTo(...at(fit, point)) : draw.moveTo(...at(fit, point))));
  draw.closePath();
}

export function drawGhost(draw: CanvasRenderingContext2D, fit: Fit, state: State, colours: Colours): void {
  const outline = state.next?.ghost ?? [];
  const corners = state.next?.ghost_corners ?? [];
  if (outline.length > 2) {
    polygon(draw, fit, outline);
    draw.fillStyle = colours.next;
    draw.globalAlpha = 0.14;
    draw.fill();
    draw.globalAlpha = 1;
    draw.setLineDash([10, 6]);
    outlined(draw, colours.next, 2.5);
    draw.setLineDash([]);
  }
  dots(draw, fit, corners, 2.5);
  draw.fillStyle = colours.next;
  draw.fill();
  if (state.next?.number !== undefined && outline.length > 2) {
    const places = outline.map((point) => at(fit, point));
    const top = Math.min(...places.map(([, y]) => y));
    label(draw, t("view_number", { number: state.next.number }), mean(places)[0], top - 18, colours.next, fit);
  }
}

/** How the found corners get onto those of the next view: a shift, a rotation and a change of size in the image. */
export function similarity(from: Pair[], to: Pair[]): { angle: number; scale: number } | null {
  if (from.length !== to.length || from.length < 3) return null;
  const [a, b] = [mean(from), mean(to)];
  let [real, imaginary, size] = [0, 0, 0];
  from.forEach((p, i) => {
    const q = to[i] as Pair;
    const [px, py, qx, qy] = [p[0] - a[0], p[1] - a[1], q[0] - b[0], q[1] - b[1]];
    real += px * qx + py * qy;
    imaginary += px * qy - py * qx;
    size += px * px + py * py;
  });
  if (size === 0) return null;
  return { angle: Math.atan2(imaginary, real), scale: Math.hypot(real, imaginary) / size };
}

const HEAD = 12; // px, of an arrow

function arrowHead(draw: CanvasRenderingContext2D, x: number, y: number, direction: number, size = HEAD): void {
  for (const side of [-2.6, 2.6]) {
    draw.moveTo(x, y);
    draw.lineTo(x + size * Math.cos(direction + side), y + size * Math.sin(direction + side));
  }
}

const NEAR = 40; // px of the canvas below which no arrow is needed
const ROTATED = 0.12; // rad
const RESIZED = 0.08;
const CAPTION = 64; // px at the lower edge of the picture, where the caption is

/** Which way the board has to go in the image: an arrow, an arc for the rotation, and nearer or farther in words. */
export function drawWay(draw: CanvasRenderingContext2D, fit: Fit, state: State, colours: Colours): void {
  const corners = state.camera?.corners ?? [];
  const ghosts = state.next?.ghost_corners ?? [];
  if (!corners.length || ghosts.length < 3) return;
  const [x, y] = at(fit, mean(corners));
  const [gx, gy] = at(fit, mean(ghosts));
  const distance = Math.hypot(gx - x, gy - y);
  const direction = Math.atan2(gy - y, gx - x);
  draw.lineCap = "round";
  if (distance > NEAR) {
    draw.beginPath();
    draw.moveTo(x, y);
    draw.lineTo(gx, gy);
    arrowHead(draw, gx, gy, direction, 16);
    outlined(draw, colours.next, 4);
  }
  const change = similarity(corners, ghosts);
  if (!change) return;
  for (const [points, colour] of [[corners, colours.found], [ghosts, colours.next]] as const) {
    dots(draw, fit, points.slice(0, 1), 9); // the first corner, so that the board is not brought there the wrong way round
    outlined(draw, colour, 2.5);
  }
  if (Math.abs(change.angle) > ROTATED) {
    const radius = 44;
    const start = -Math.PI / 2;
    const end = start + change.angle;
    draw.beginPath();
    draw.arc(x, y, radius, start, end, change.angle < 0);
    const along = end + (change.angle > 0 ? Math.PI / 2 : -Math.PI / 2);
    arrowHead(draw, x + radius * Math.cos(end), y + radius * Math.sin(end), along);
    outlined(draw, colours.next, 3);
  }
  const words = [
    Math.abs(change.angle) > ROTATED ? t("rotate_by", { deg: Math.round(Math.abs((change.angle * 180) / Math.PI)) }) : "",
    change.scale > 1 + RESIZED ? t("nearer") : change.scale < 1 - RESIZED ? t("farther") : "",
  ].filter(Boolean);
  const lowest = Math.max(...[...(state.next?.ghost ?? []), ...corners].map((point) => at(fit, point)[1]));
  if (words.length) label(draw, words.join(", "), gx, Math.min(lowest + 24, fit.height - CAPTION), colours.next, fit);
}

const ARROW_PX = 34; // of the canvas: about the length of the longest residual arrow

/** The round factor by which residuals are drawn longer. */
export function magnification(arrows: Pair[], fit: Fit): number {
  const longest = Math.max(0, ...arrows.map(([x, y]) => Math.hypot(x, y)));
  if (longest === 0) return 1;
  const wanted = ARROW_PX / (longest * fit.scale);
  const power = 10 ** Math.floor(Math.log10(wanted));
  return Math.max(1, [5, 2, 1].map((step) => step * power).find((factor) => factor <= wanted) ?? power);
}

/** A capture's corners with their residuals, drawn longer by a factor that is said. */
export function drawResiduals(
  draw: CanvasRenderingContext2D,
  fit: Fit,
  capture: Capture,
  detail: Maybe<CaptureDetail>,
  colours: Colours,
): void {
  const points = detail?.points ?? [];
  const arrows = detail?.arrows ?? [];
  dots(draw, fit, points, 2);
  outlined(draw, colours.found, 1.5);
  if (!arrows.length) return;
  const factor = magnification(arrows, fit);
  draw.beginPath();
  points.forEach((point, i) => {
    const [dx, dy] = arrows[i] ?? [0, 0];
    const [x, y] = at(fit, point);
    const [ex, ey] = [x + dx * factor * fit.scale, y + dy * factor * fit.scale];
    draw.moveTo(x, y);
    draw.lineTo(ex, ey);
    arrowHead(draw, ex, ey, Math.atan2(dy, dx), 6);
  });
  outlined(draw, isOutlier(capture) ? colours.outlier : colours.residual, 2);
  const words = t("arrows_longer", { factor, px: mm(capture.residual_px) });
  label(draw, words, fit.width / 2, fit.height - 20, "#fff", fit);
}
