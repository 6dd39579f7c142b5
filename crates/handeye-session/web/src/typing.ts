// The field for a pose that is read from the pendant. What is typed there is kept while the page shows something else.

import type { App } from "./app";
import { attribute, h } from "./dom";
import type { State } from "./state";
import { said } from "./words";

let fields = 0;

/** `enter` is done with the key Enter. */
export function makeTyping(app: App, enter: () => void) {
  fields += 1;
  const id = `typed-pose-${fields}`;
  const input = h("input", { type: "text", autocomplete: "off", spellcheck: "false", id });
  input.addEventListener("input", () => app.choose({ typed: input.value }));
  input.addEventListener("keydown", (event) => {
    if (event.key === "Escape") input.blur();
    if (event.key !== "Enter" || event.repeat) return;
    event.preventDefault();
    enter();
  });
  const element = h("div", { class: "typing labelled" }, said(h("label", { for: id }), "typed_pose"), input);
  return {
    element,
    input,
    update(state: State): void {
      const { columns = [], units = [] } = state.robot ?? {};
      const unit = (i: number) => (units[i] && units[i] !== units[i + 1] ? ` (${units[i]})` : "");
      attribute(input, "placeholder", columns.map((name, i) => name + unit(i)).join(" "));
      if (input.value !== app.choices.typed) input.value = app.choices.typed;
    },
  };
}
