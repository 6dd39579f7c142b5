// What is known of a device or of the board, as a list of living facts with a sign before each: good, not good, unknown.

import { h, kind, list, show, text } from "./dom";
import { icon, setIcon } from "./icons";
import { showOwn, showTranslated } from "./words";

export interface Fact {
  name: string;
  value?: string | null | undefined;
  said?: string | null | undefined; // by the server, in place of a value
  good?: boolean | undefined;
}

export function facts() {
  const element = h("dl", { class: "facts" });
  const draw = list<Fact>(
    element,
    ({ name }) => name,
    () => {
      const sign = icon("check");
      const [name, value] = [h("dt"), h("dd")];
      const row = h("div", {}, sign, name, value);
      return {
        element: row,
        update(fact: Fact): void {
          text(name, fact.name);
          if (fact.said) showTranslated(value, fact.said);
          else showOwn(value, fact.value || "–");
          kind(row, "good", fact.good === true);
          kind(row, "bad", fact.good === false);
          setIcon(sign, fact.good === false ? "warning" : "check");
          sign.style.visibility = fact.good === undefined ? "hidden" : "visible";
        },
      };
    },
  );
  return {
    element,
    update(given: Fact[]): void {
      show(element, given.length > 0);
      draw(given);
    },
  };
}
