// Images that are handed over here: files that are chosen or dropped, and the camera of this browser.

import type { App, Part } from "./app";
import { button, card } from "./controls";
import { h, show } from "./dom";
import { Refusal, sendImage } from "./link";
import { showOwn, said, sentence, t, showTranslated, type Key } from "./words";

const WIDTH = 1920; // px that the camera is asked for
const HEIGHT = 1080;

/** What the camera sees now, without loss. */
function still(video: HTMLVideoElement): Promise<Blob | null> {
  const canvas = document.createElement("canvas");
  [canvas.width, canvas.height] = [video.videoWidth, video.videoHeight];
  canvas.getContext("2d")?.drawImage(video, 0, 0);
  return new Promise((done) => canvas.toBlob(done, "image/png"));
}

export function makeUpload(app: App): Part {
  const chosen = h("input", { type: "file", accept: "image/*", class: "unseen", "aria-hidden": "true", tabindex: -1 });
  const video = h("video", { class: "preview", playsinline: true });
  video.muted = true;
  const why = h("p", { class: "hint bad", role: "status" });
  const choose = button("choose_image", () => chosen.click());
  const open = button("browser_camera", () => void start());
  const take = button("take_image", () => void shoot(), { class: "take-image" });
  const stop = button("camera_off", () => finish());
  const buttons = h("div", { class: "buttons" }, choose, open, take, stop);
  const element = card("image", said(h("p", { class: "hint" }), "upload_hint"), video, buttons, chosen, why);
  let stream: MediaStream | null = null;
  let problem: { own: Key } | { said: string } | null = null;

  chosen.addEventListener("change", () => {
    const file = chosen.files?.[0];
    chosen.value = "";
    if (file) void hand(file);
  });
  element.addEventListener("dragover", (event) => event.preventDefault());
  element.addEventListener("drop", (event) => {
    event.preventDefault();
    const file = event.dataTransfer?.files[0];
    if (file) void hand(file);
  });

  function say(what: typeof problem): void {
    problem = what;
    app.redraw();
  }

  async function hand(image: Blob): Promise<void> {
    try {
      await sendImage(image);
      say(null);
    } catch (refused) {
      say(refused instanceof Refusal ? { said: refused.problem.message } : { own: "image_not_sent" });
    }
  }

  async function start(): Promise<void> {
    try {
      // a browser hands out its cameras only to pages of this machine, or over an encrypted connection
      stream = await navigator.mediaDevices.getUserMedia({ video: { width: { ideal: WIDTH }, height: { ideal: HEIGHT } } });
      video.srcObject = stream;
      await video.play();
      say(null);
    } catch {
      finish();
      say({ own: "no_browser_camera" });
    }
  }

  async function shoot(): Promise<void> {
    const image = await still(video);
    if (image) await hand(image);
  }

  function finish(): void {
    stream?.getTracks().forEach((track) => track.stop());
    [stream, video.srcObject] = [null, null];
    app.redraw();
  }

  return {
    element,
    update(state) {
      const isUsed = state.camera?.uploads === true;
      if (!isUsed && stream) finish();
      show(element, isUsed);
      const isOn = stream !== null;
      show(video, isOn);
      show(open, !isOn);
      show(take, isOn);
      show(stop, isOn);
      show(why, problem !== null);
      if (problem && "own" in problem) showOwn(why, t(problem.own));
      else showTranslated(why, problem?.said, sentence);
    },
  };
}
