// The rail on the left: the eight steps with their state and what is known of each, and the page's own settings.

import { goTo } from "./actions";
import type { App, Part } from "./app";
import { button } from "./controls";
import { attribute, h, kind, list, show, text } from "./dom";
import { icon, setIcon } from "./icons";
import type { Step } from "./state";
import { currentLanguage, named, said, sentence, t, showTranslated, translated, type Key } from "./words";

interface Numbered extends Step {
  number: number;
}

function stepRow(app: App, name: Step["name"]) {
  const number = h("span", { class: "number" });
  const sign = icon("check");
  const state = h("span", { class: "unseen" });
  const proof = h("small");
  const element = h(
    "button",
    { type: "button", class: "step" },
    h("span", { class: "sign", "aria-hidden": "true" }, number, sign),
    h("span", { class: "what" }, said(h("b"), `step_${name}` as Key), state, proof),
  );
  element.addEventListener("click", (event) => {
    if (event.detail > 0) element.blur();
    goTo(app, name);
  });
  return {
    element: h("li", {}, element),
    update(step: Numbered): void {
      text(number, String(step.number));
      for (const look of ["done", "now", "open", "locked"] as const) kind(element, look, step.state === look);
      kind(element, "proven", step.proven === true);
      attribute(element, "aria-current", step.state === "now" && "step");
      attribute(element, "aria-disabled", step.state === "locked" && "true");
      const signed = step.state === "done" || step.state === "locked";
      show(number, !signed);
      show(sign, signed);
      setIcon(sign, step.state === "locked" ? "lock" : "check");
      text(state, ` ${t(`state_${step.state}`)} `);
      showTranslated(proof, step.proof, (words) => sentence(words).replace(/\.$/, ""));
      attribute(element, "title", step.proof && sentence(translated(step.proof)));
    },
  };
}

export function makeRail(app: App, element: HTMLElement, help: () => void): Part {
  named(element, "steps");
  const title = h("strong");
  const folder = h("small");
  const steps = h("ol");
  const draw = list<Numbered>(
    steps,
    (step) => step.name,
    (step) => stepRow(app, step.name),
  );
  const sound = button("sound_off", () => app.choose({ muted: !app.choices.muted }), { icon: "sound", bare: true });
  const soundIcon = sound.querySelector("svg") as SVGSVGElement;
  const language = h("button", { type: "button" });
  language.addEventListener("click", () => app.choose({ language: currentLanguage() === "en" ? "de" : "en" }));
  const keys = button("keys", help, { icon: "keys", bare: true });
  element.append(h("div", { class: "brand" }, title, folder), steps, h("div", { class: "tools" }, sound, language, keys));
  return {
    element,
    update(state) {
      text(title, state.title ?? "handeye");
      text(folder, state.folder);
      attribute(folder, "title", state.folder);
      draw((state.steps ?? []).map((step, i) => ({ ...step, number: i + 1 })));
      setIcon(soundIcon, app.choices.muted ? "mute" : "sound");
      named(sound, app.choices.muted ? "sound_on" : "sound_off", true);
      text(language, currentLanguage() === "en" ? "DE" : "EN");
      named(language, currentLanguage() === "en" ? "in_german" : "in_english", true);
      attribute(language, "lang", currentLanguage() === "en" ? "de" : "en");
    },
  };
}
