// The top of the page: what to do next in one sentence, and the buttons of the moment.

import { primary, secondary, type Action } from "./actions";
import type { App, Part } from "./app";
import { attribute, h, kind, list } from "./dom";
import { sayOf } from "./state";
import { showOwn, said, t, showTranslated } from "./words";

const SIZES = [27, 24, 21, 18, 16, 14]; // px of the sentence's letters; the largest that fits is taken
const TALLEST = 78; // px of all its lines

/** Sets the sentence in the largest letters that fit. */
function fit(sentence: HTMLElement): void {
  for (const size of SIZES) {
    sentence.style.fontSize = `${size}px`;
    if (sentence.scrollHeight <= TALLEST) return;
  }
}

/** A button whose action changes while it stays the same element. */
export function actionButton(look: string) {
  let action: Action | null = null;
  const label = h("span");
  const element = h("button", { type: "button", class: look }, label);
  element.addEventListener("click", (event) => {
    if (event.detail > 0) element.blur();
    if (action?.enabled) action.run();
  });
  return {
    element,
    update(wanted: Action): void {
      action = wanted;
      said(label, wanted.label);
      attribute(element, "aria-disabled", !wanted.enabled && "true");
      attribute(element, "aria-pressed", wanted.on === undefined ? null : String(wanted.on));
    },
  };
}

export function makeHead(app: App, element: HTMLElement): Part {
  const sentence = h("h1");
  const others = h("div", { class: "others" });
  const main = actionButton("primary");
  const busy = h("span", { class: "busy", "aria-hidden": "true" });
  main.element.prepend(busy);
  main.element.append(h("kbd", { "aria-hidden": "true" }, "␣"));
  const drawOthers = list<Action>(
    others,
    (action) => action.label,
    () => actionButton("large"),
  );
  element.append(sentence, others, main.element);
  let width = 0;
  new ResizeObserver(() => {
    if (sentence.clientWidth === width) return;
    width = sentence.clientWidth;
    fit(sentence);
  }).observe(sentence);
  return {
    element,
    update(state) {
      const action = primary(app, state);
      main.update(action);
      kind(main.element, "waiting", Boolean(state.taking || state.virtual_cell?.driving));
      drawOthers(app.state ? secondary(app, state) : []);
      const before = sentence.textContent;
      if (app.state) showTranslated(sentence, sayOf(state));
      else showOwn(sentence, t("connecting"));
      if (sentence.textContent !== before) fit(sentence);
    },
  };
}
