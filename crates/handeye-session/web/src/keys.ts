// The keyboard. Keys that belong to a field, a button or an open sheet are left to it.

import { cancel, canTake, deleteSelected, goTo, nextView, primary, selectBy, take } from "./actions";
import type { App } from "./app";
import { takesCaptures } from "./state";

const AGAIN = 350; // ms in which a second press of the same key counts as a slip

function isTyping(element: Element | null): boolean {
  return element instanceof HTMLInputElement
    ? element.type !== "radio"
    : element instanceof HTMLTextAreaElement || element instanceof HTMLSelectElement;
}

/** Whether the element that has the focus answers the space bar itself. */
function answersSpace(element: Element | null): boolean {
  return Boolean(element?.closest("button, a, summary, input, [role=tabpanel]"));
}

function retake(app: App): void {
  if (app.choices.selected) void app.send({ do: "retake", id: app.choices.selected });
}

function escape(app: App): void {
  if (app.choices.selected) app.choose({ selected: null });
  else if (app.state?.taking) cancel(app);
}

/** What a key does; null for those that do nothing. */
function effect(app: App, key: string, help: HTMLDialogElement): (() => void) | null {
  const state = app.state;
  const isTaking = state !== null && takesCaptures(state);
  const step = state?.steps?.[Number(key) - 1];
  if (step) return () => goTo(app, step.name);
  switch (key.toLowerCase()) {
    case " ":
    case "enter":
      return () => {
        const action = state && primary(app, state);
        if (action?.enabled) action.run();
      };
    case "n":
      return () => isTaking && nextView(app);
    case "t":
      return () => isTaking && canTake(state) && void take(app);
    case "a":
      return () => isTaking && void app.send({ do: "automatic", on: !state.automatic });
    case "d":
    case "delete":
      return () => deleteSelected(app);
    case "r":
      return () => retake(app);
    case "z":
      return () => state?.can_undo && void app.send({ do: "undo" });
    case "arrowdown":
    case "arrowleft":
      return () => selectBy(app, -1);
    case "arrowup":
    case "arrowright":
      return () => selectBy(app, 1);
    case "c":
      return () => app.choose({ large: app.choices.large === "cell" ? "picture" : "cell" });
    case "m":
      return () => app.choose({ muted: !app.choices.muted });
    case "escape":
      return () => escape(app);
    case "?":
      return () => help.showModal();
    default:
      return null;
  }
}

export function listenToKeys(app: App, help: HTMLDialogElement): void {
  let last = { key: "", at: 0 };
  addEventListener("keydown", (event) => {
    if (event.ctrlKey || event.metaKey || event.altKey || event.defaultPrevented || help.open) return;
    const focus = document.activeElement;
    if (isTyping(focus)) return;
    const isPrimary = event.key === " " || event.key === "Enter";
    if (isPrimary && answersSpace(focus)) return;
    if (event.key.startsWith("Arrow") && focus instanceof HTMLInputElement) return;
    const does = effect(app, event.key, help);
    if (!does) return;
    event.preventDefault();
    const isSlip = event.key === last.key && event.timeStamp - last.at < AGAIN && !event.key.startsWith("Arrow");
    if (isSlip || (event.repeat && !event.key.startsWith("Arrow"))) return;
    last = { key: event.key, at: event.timeStamp };
    does();
  });
}
