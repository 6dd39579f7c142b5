// The large picture: the live one with what was found in it and where the board has to go; or that of the capture that is
// selected, with its residuals.

import { selectedCapture, type App, type Part } from "./app";
import { button } from "./controls";
import { detailStore } from "./details";
import { h, kind, show, text } from "./dom";
import { frameFor } from "./live";
import { mm } from "./numbers";
import { drawEarlier, drawFound, drawGhost, drawResiduals, drawWay, type Colours, type Fit } from "./overlay";
import { isOutlier, isPlaced, isTouching, takesCaptures, touchesHere, type Capture, type State } from "./state";
import { named, sentence, t, showTranslated, translated } from "./words";

const COLOURS: Colours = {
  found: "#4be3ff",
  next: "#ffc531",
  earlier: "rgba(150,205,255,0.5)",
  residual: "#ffe14d",
  outlier: "#ff7a6b",
};
const LATE = 2; // s after which a picture is not live any more

const AGAIN = 2000; // ms until a picture that did not come is asked for again
const KEPT = 4; // pictures of captures

/** The pictures of the captures that were looked at last. One that was retaken is another one. */
function pictureStore(arrived: () => void) {
  const kept = new Map<string, ImageBitmap | null>();
  return ({ id, time_s }: Capture): ImageBitmap | null => {
    const name = `${id} ${time_s}`;
    const found = kept.get(name);
    if (found !== undefined) return found;
    kept.set(name, null);
    for (const old of [...kept.keys()].slice(0, -KEPT)) {
      kept.get(old)?.close();
      kept.delete(old);
    }
    void (async () => {
      try {
        const answer = await fetch(`/api/captures/${encodeURIComponent(id)}.jpg`);
        if (!answer.ok) throw new Error(answer.statusText);
        kept.set(name, await createImageBitmap(await answer.blob()));
      } catch {
        setTimeout(() => kept.delete(name), AGAIN);
        return;
      }
      arrived();
    })();
    return null;
  };
}

export function makePicture(app: App): Part & { draw(): void } {
  const image = h("canvas", { "aria-hidden": "true" });
  const overlay = h("canvas", { role: "img" });
  const tag = h("p", { class: "tag" });
  const back = button("back_to_live", () => app.choose({ selected: null }), { icon: "back" });
  const missing = h("p", { class: "caption bad" });
  const element = h("div", { class: "pane picture" }, image, overlay, h("div", { class: "corner" }, back, tag), missing);
  named(overlay, "live_picture");
  const captured = pictureStore(() => draw());
  const details = detailStore(() => {
    draw();
    app.redraw(); // which asks for the next one
  });
  let pending = false;
  let shownImage: ImageBitmap | null = null;
  let shownSize = "";

  new ResizeObserver(() => draw()).observe(element);

  /** Draws once before the next frame of the screen, however often it is called. */
  function draw(): void {
    if (pending) return;
    pending = true;
    requestAnimationFrame(() => {
      pending = false;
      if (app.state) drawNow(app.state);
    });
  }

  function fitted(bitmap: ImageBitmap | null, state: State): Fit {
    const { clientWidth: wide, clientHeight: high } = element;
    const width = state.camera?.width || bitmap?.width || 1280;
    const height = state.camera?.height || bitmap?.height || 800;
    const scale = Math.min(wide / width, high / height);
    return { scale, left: (wide - width * scale) / 2, top: (high - height * scale) / 2, width: wide, height: high };
  }

  function drawNow(state: State): void {
    const capture = selectedCapture(app);
    const bitmap = capture ? captured(capture) : (frameFor(state.camera?.frame)?.image ?? null);
    const fit = fitted(bitmap, state);
    if (fit.width === 0 || fit.height === 0) return;
    const ratio = Math.min(2, devicePixelRatio);
    const size = `${fit.width} ${fit.height} ${fit.scale} ${ratio}`;
    if (bitmap !== shownImage || size !== shownSize) drawImage(bitmap, fit, ratio);
    [shownImage, shownSize] = [bitmap, size];
    const over = prepared(overlay, fit, ratio);
    if (capture) drawResiduals(over, fit, capture, details.of(capture.id), COLOURS);
    else drawLive(over, fit, state);
  }

  function drawImage(bitmap: ImageBitmap | null, fit: Fit, ratio: number): void {
    const draw = prepared(image, fit, ratio);
    if (bitmap && bitmap.width) {
      draw.drawImage(bitmap, fit.left, fit.top, fit.width - 2 * fit.left, fit.height - 2 * fit.top);
    }
  }

  function drawLive(draw: CanvasRenderingContext2D, fit: Fit, state: State): void {
    if (state.step === "capture") {
      const used = (state.captures ?? []).filter((capture) => !isOutlier(capture));
      drawEarlier(draw, fit, used.map(({ id }) => details.of(id)?.points ?? []), COLOURS);
      drawGhost(draw, fit, state, COLOURS);
    }
    if (state.camera?.corners?.length) drawFound(draw, fit, state.camera.corners, COLOURS);
    if (takesCaptures(state)) drawWay(draw, fit, state, COLOURS);
  }

  return {
    element,
    draw,
    update(state) {
      const capture = selectedCapture(app);
      show(back, capture !== null);
      details.update(state, app.choices.selected);
      describe(state, capture);
      draw();
    },
  };

  function describe(state: State, capture: Capture | null): void {
    const age = state.camera?.age_s;
    const late = capture === null && (state.camera?.connected === false || (!state.camera?.single && (age ?? 0) > LATE));
    text(tag, capture ? captureTag(capture) : liveTag(state));
    kind(tag, "bad", late || (capture !== null && isOutlier(capture)));
    const trouble = capture ? capture.reason : needsBoard(state) ? state.camera?.missing : null;
    showTranslated(missing, trouble, sentence);
    show(missing, Boolean(trouble));
    named(overlay, capture ? "captured_picture" : "live_picture");
  }
}

/** Whether the next image is to show the board: while corners are touched, the camera sees whatever part of it. */
function needsBoard(state: State): boolean {
  if (!isTouching(state)) return true;
  const touch = touchesHere(state);
  return touch?.lays === true && (Boolean(state.taking) || !isPlaced(touch));
}

function captureTag(capture: Capture): string {
  const used = isOutlier(capture) ? ` · ${t("not_used")}` : "";
  return `${t("capture_id", { id: capture.id })} · ${mm(capture.residual_mm)} mm · ${mm(capture.residual_px)} px${used}`;
}

function liveTag(state: State): string {
  const camera = state.camera;
  if (!camera?.frame) return t(camera?.single ? "no_picture" : "no_camera");
  if (!frameFor(camera.frame)) return t("no_picture");
  if (camera.single) return [t("picture_number", { number: camera.frame ?? "" }), camera.found && translated(camera.found)].filter(Boolean).join(" · ");
  if ((camera?.age_s ?? 0) > LATE) return t("picture_old", { seconds: Math.round(camera?.age_s ?? 0) });
  return camera?.found ? `${t("live")} · ${translated(camera.found)}` : t("live");
}

/** A cleared canvas of the size of its place, in CSS pixels. */
function prepared(canvas: HTMLCanvasElement, fit: Fit, ratio: number): CanvasRenderingContext2D {
  const [wide, high] = [Math.round(fit.width * ratio), Math.round(fit.height * ratio)];
  if (canvas.width !== wide) canvas.width = wide;
  if (canvas.height !== high) canvas.height = high;
  const draw = canvas.getContext("2d") as CanvasRenderingContext2D;
  draw.setTransform(ratio, 0, 0, ratio, 0, 0);
  draw.clearRect(0, 0, fit.width, fit.height);
  return draw;
}
