// The step "camera": is it connected, is its picture live, and which intrinsics does it have?

import type { App, Part } from "./app";
import { card } from "./controls";
import { attribute, field, h, kind, show } from "./dom";
import { facts } from "./facts";
import { numberField } from "./number_field";
import type { Camera, Intrinsics } from "./state";
import { labelled } from "./controls";
import { said, t, type Key } from "./words";

const NUMBERS = ["fx", "fy", "cx", "cy"] as const;
const LATE = 1; // s

/** The distortion's coefficients as they are written: apart by blanks, commas or semicolons. Null where one is no number. */
export function readNumbers(written: string): number[] | null {
  const numbers = written
    .split(/[\s,;[\]]+/)
    .filter(Boolean)
    .map(Number);
  return numbers.every(Number.isFinite) ? numbers : null;
}

export function makeStepCamera(app: App): Part {
  const seen = facts();
  const distortion = h("input", { type: "text", autocomplete: "off", placeholder: "k1 k2 p1 p2 k3" });
  distortion.addEventListener("change", () => send());
  const fields = NUMBERS.map((name) => numberField({ label: name as Key, unit: "px", step: 1, least: 0, buttons: false, changed: () => send() }));
  const form = h("div", { class: "grid" }, ...fields.map(({ element }) => element));
  const known = h("div", {}, form, labelled("distortion", distortion), said(h("p", { class: "hint" }), "intrinsics_hint"));
  let opened = false; // the form is open before anything was sent

  const choices = ([false, true] as const).map((isKnown) => {
    const input = h("input", { type: "radio", name: "intrinsics" });
    input.addEventListener("change", () => {
      opened = isKnown;
      if (!isKnown) void app.send({ do: "camera", intrinsics: null });
      app.redraw();
    });
    const words = h("span", {}, said(h("b"), isKnown ? "intrinsics_known" : "intrinsics_unknown"), said(h("small"), isKnown ? "intrinsics_known_what" : "intrinsics_unknown_what"));
    return { isKnown, input, element: h("label", { class: "choice plain" }, input, words) };
  });

  function send(): void {
    const [fx, fy, cx, cy] = fields.map((one) => one.value());
    const coefficients = readNumbers(distortion.value);
    attribute(distortion, "aria-invalid", coefficients === null && "true");
    if (!fx || !fy || cx === null || cx === undefined || cy === null || cy === undefined || !coefficients) return;
    const camera = app.state?.camera;
    const before = app.state?.cell?.intrinsics;
    const intrinsics: Partial<Intrinsics> = { fx, fy, cx, cy, distortion: coefficients };
    const width = camera?.width ?? before?.width;
    const height = camera?.height ?? before?.height;
    void app.send({ do: "camera", intrinsics: { width, height, ...intrinsics } });
  }

  const element = h(
    "div",
    { class: "stack" },
    card("camera", seen.element),
    card("intrinsics", h("div", { class: "choices" }, ...choices.map((choice) => choice.element)), known),
  );
  return {
    element,
    update(state) {
      seen.update(cameraFacts(state.camera));
      const intrinsics = state.cell?.intrinsics;
      const isOpen = opened || Boolean(intrinsics);
      for (const choice of choices) {
        choice.input.checked = choice.isKnown === isOpen;
        kind(choice.element, "chosen", choice.input.checked);
      }
      show(known, isOpen);
      if (!intrinsics) return;
      fields.forEach((one, i) => one.set(intrinsics[NUMBERS[i] as (typeof NUMBERS)[number]]));
      field(distortion, (intrinsics.distortion ?? []).join(" "));
    },
  };
}

export function cameraFacts(camera: Camera | null | undefined) {
  const connected = camera?.connected === true;
  const facts = [{ name: t("connected"), value: connected ? camera?.name : t("no_camera"), good: connected }];
  if (!connected) return facts;
  const age = camera?.age_s;
  const delay = camera?.delay_s;
  return [
    ...facts,
    { name: t("size"), value: camera?.width ? `${camera.width} × ${camera.height ?? "?"} px` : null, good: undefined },
    { name: t("age"), value: typeof age === "number" ? `${age.toFixed(2)} s` : null, good: typeof age === "number" ? age < LATE : undefined },
    { name: t("rest"), value: camera?.why, good: camera?.stands },
    { name: t("delay"), value: typeof delay === "number" ? `${delay.toFixed(2)} s` : t("not_known_yet"), good: undefined },
  ];
}
