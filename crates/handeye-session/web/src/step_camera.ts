// The step "camera": is it connected, is its picture live, and which intrinsics does it have?

import { fixedBy } from "./actions";
import type { App, Part } from "./app";
import { card, labelled, makeFixed } from "./controls";
import { attribute, field, h, kind, show } from "./dom";
import { facts } from "./facts";
import { numberField } from "./number_field";
import type { Camera, Distortion } from "./state";
import { said, t, type Key } from "./words";

const NUMBERS = ["fx", "fy", "cx", "cy"] as const;
const LATE = 2; // s

/** The distortion's coefficients as they are written: apart by blanks, commas or semicolons. Null where one is no number. */
export function readNumbers(written: string): number[] | null {
  const numbers = written
    .split(/[\s,;[\]]+/)
    .filter(Boolean)
    .map(Number);
  return numbers.every(Number.isFinite) ? numbers : null;
}

const MODELS: [Distortion["model"], Key, coefficients: number][] = [
  ["none", "no_distortion", 0],
  ["brown-conrady", "brown_conrady", 12],
  ["kannala-brandt", "kannala_brandt", 4],
];

/** The distortion of a model with these coefficients, those that are not written being nought. Null where there are too many. */
function distortionOf(model: string, numbers: number[]): Distortion | null {
  const count = MODELS.find(([name]) => name === model)?.[2] ?? 0;
  if (count === 0) return { model: "none" };
  if (numbers.length > count) return null;
  const coefficients = Array.from({ length: count }, (_, i) => numbers[i] ?? 0);
  return { model: model as "brown-conrady" | "kannala-brandt", coefficients };
}

/** The coefficients as they are written, without the noughts at the end. */
function written(distortion: Distortion): string {
  const all = distortion.model === "none" ? [] : [...distortion.coefficients];
  while (all.length && all[all.length - 1] === 0) all.pop();
  return all.join(" ");
}

export function makeStepCamera(app: App): Part {
  const seen = facts();
  const distortion = h("input", { type: "text", autocomplete: "off", placeholder: "k1 k2 p1 p2 k3" });
  distortion.addEventListener("change", () => send());
  const model = h("select", {}, ...MODELS.map(([value, key]) => said(h("option", { value }), key)));
  model.addEventListener("change", () => {
    send();
    app.redraw();
  });
  const fixed = makeFixed();
  const how = said(h("p", { class: "hint" }), "save_picture");
  const fields = NUMBERS.map((name) => numberField({ label: name as Key, unit: "px", step: 1, least: 0, buttons: false, changed: () => send() }));
  const form = h("div", { class: "grid" }, ...fields.map(({ element }) => element));
  const coefficients = labelled("distortion", distortion);
  const known = h("div", { class: "lens" }, form, labelled("distortion_model", model), coefficients, said(h("p", { class: "hint" }), "intrinsics_hint"));
  let opened = false; // the form is open before anything was sent

  const choices = ([false, true] as const).map((isKnown) => {
    const input = h("input", { type: "radio", name: "intrinsics" });
    input.addEventListener("change", () => {
      opened = isKnown;
      if (!isKnown) void app.send({ do: "camera", intrinsics: null });
      app.redraw();
    });
    const key: Key = isKnown ? "intrinsics_known" : "intrinsics_unknown";
    const words = h("span", {}, said(h("b"), key), said(h("small"), `${key}_what`));
    return { isKnown, input, element: h("label", { class: "choice plain" }, input, words) };
  });

  function send(): void {
    const [fx, fy, cx, cy] = fields.map((one) => one.value());
    const numbers = readNumbers(distortion.value);
    const lens = numbers && distortionOf(model.value, numbers);
    attribute(distortion, "aria-invalid", lens === null && "true");
    if (!fx || !fy || cx === null || cx === undefined || cy === null || cy === undefined || !lens) return;
    const camera = app.state?.camera;
    const before = app.state?.cell?.intrinsics;
    const width = camera?.width || (before?.width ?? 0); // 0: of any size
    const height = camera?.height || (before?.height ?? 0);
    void app.send({ do: "camera", intrinsics: { width, height, fx, fy, cx, cy, distortion: lens } });
  }

  const element = h(
    "div",
    { class: "stack" },
    card("camera", seen.element, how),
    card("intrinsics", fixed.element, h("div", { class: "choices" }, ...choices.map((choice) => choice.element)), known),
  );
  return {
    element,
    update(state) {
      seen.update(cameraFacts(state.camera));
      show(how, state.camera?.single === true && state.camera.uploads !== true);
      const intrinsics = state.cell?.intrinsics;
      const isOpen = opened || Boolean(intrinsics);
      const fixes = fixedBy(state);
      for (const choice of choices) {
        choice.input.checked = choice.isKnown === isOpen;
        kind(choice.element, "chosen", choice.input.checked);
        attribute(choice.input, "disabled", fixes !== null && !choice.input.checked);
        kind(choice.element, "fixed", fixes !== null && !choice.input.checked);
      }
      fixed.update(state);
      for (const one of fields) one.disable(fixes !== null);
      for (const one of [model, distortion]) attribute(one, "disabled", fixes !== null);
      show(known, isOpen);
      if (intrinsics) field(model, intrinsics.distortion.model);
      show(coefficients, model.value !== "none");
      attribute(distortion, "placeholder", model.value === "kannala-brandt" ? "k1 k2 k3 k4" : "k1 k2 p1 p2 k3");
      if (!intrinsics) return;
      fields.forEach((one, i) => one.set(intrinsics[NUMBERS[i] as (typeof NUMBERS)[number]]));
      field(distortion, written(intrinsics.distortion));
    },
  };
}

export function cameraFacts(camera: Camera | null | undefined) {
  const connected = camera?.connected === true;
  const single = camera?.single === true;
  const missing = t(single ? "no_picture" : "no_camera");
  const come = connected ? t(single ? "one_by_one" : "streaming") : missing;
  const facts = [{ name: t("pictures"), value: come, good: connected || (single ? undefined : false) }];
  if (!connected) return facts;
  const age = camera?.age_s;
  const delay = camera?.delay_s;
  return [
    ...facts,
    { name: t("size"), value: camera?.width ? `${camera.width} × ${camera.height ?? "?"} px` : null, good: undefined },
    ...(single
      ? [{ name: t("newest"), said: camera?.why, good: undefined }]
      : [
          { name: t("age"), value: typeof age === "number" ? `${age.toFixed(2)} s` : null, good: typeof age === "number" ? age < LATE : undefined },
          { name: t("rest"), said: camera?.why, good: camera?.stands },
        ]),
    ...(single ? [] : [{ name: t("delay"), value: typeof delay === "number" ? `${delay.toFixed(2)} s` : t("not_known_yet"), good: undefined }]),
  ];
}
