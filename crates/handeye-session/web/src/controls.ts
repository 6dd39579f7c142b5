// Buttons, all made the same way: large, with a name, and not holding the focus after a touch, so that the space bar stays
// with the primary action.

import { fixedBy } from "./actions";
import { h, show } from "./dom";
import { icon, setIcon, type Icon } from "./icons";
import type { State } from "./state";
import { named, said, type Key } from "./words";

interface Look {
  class?: string;
  icon?: Icon;
  bare?: boolean; // the icon alone is seen
}

export function button(key: Key, clicked: () => void, look: Look = {}): HTMLButtonElement {
  const made = h("button", { type: "button", class: look.class });
  made.addEventListener("click", (event) => {
    if (event.detail > 0) made.blur();
    clicked();
  });
  if (look.icon) made.append(icon(look.icon));
  if (look.bare) named(made, key, true);
  else made.append(said(h("span"), key));
  return made;
}

/** A heading and what belongs to it. */
export function card(key: Key, ...children: (Node | null)[]): HTMLElement {
  return h("section", { class: "card" }, said(h("h2"), key), ...children);
}

/** A labelled field. */
export function labelled(key: Key, control: HTMLElement): HTMLLabelElement {
  return h("label", { class: "labelled" }, said(h("span"), key), control);
}

/** Says why something cannot be changed, or what a change does to the captures. */
export function makeFixed() {
  const [sign, why] = [icon("lock"), h("span")];
  const element = h("p", { class: "fixed-by" }, sign, why);
  return {
    element,
    update(state: State): void {
      const key = fixedBy(state) ?? (state.captures?.length ? "read_again" : null);
      show(element, key !== null);
      setIcon(sign, key === "read_again" ? "again" : "lock");
      if (key) said(why, key);
    },
  };
}
