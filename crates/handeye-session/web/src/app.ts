// What all parts of the page share: the last state, what this browser alone has chosen, and how to send a command.

import { command, Refusal } from "./link";
import type { Command, Problem, State, VerifyBy } from "./state";
import type { Language } from "./words";

/** What this browser has chosen; the server does not know of it. */
export interface Choices {
  language: Language | null; // null: that of the browser
  muted: boolean;
  selected: string | null; // the capture that is looked at
  large: "picture" | "cell";
  joints: boolean; // joint values in place of the pose
  typed: string; // a pose that is being typed
  by: VerifyBy;
}

export interface App {
  state: State | null;
  choices: Choices;
  /** The connection is lost since then, ms. */
  lostSince: number | null;
  signedOut: boolean;
  /** What a command was refused for. */
  refused: Problem | null;
  redraw(): void;
  /** Sends a command. False where it was refused; the reason is then shown. */
  send(wanted: Command): Promise<boolean>;
  choose(some: Partial<Choices>): void;
}

/** A part of the page. */
export interface Part {
  element: HTMLElement;
  update(state: State): void;
}

const STORED = ["language", "muted", "joints"] as const;
const STORE = "handeye-session";

function stored(): Partial<Choices> {
  try {
    return JSON.parse(localStorage.getItem(STORE) ?? "{}") as Partial<Choices>;
  } catch {
    return {};
  }
}

function store(choices: Choices): void {
  try {
    localStorage.setItem(STORE, JSON.stringify(Object.fromEntries(STORED.map((name) => [name, choices[name]]))));
  } catch {
    // a browser that stores nothing forgets the choices, that is all
  }
}

export function makeApp(redraw: () => void): App {
  const app: App = {
    state: null,
    choices: { language: null, muted: false, selected: null, large: "picture", joints: false, typed: "", by: "views", ...stored() },
    lostSince: null,
    signedOut: false,
    refused: null,
    redraw,
    async send(wanted) {
      try {
        await command(wanted);
        app.refused = null;
        redraw();
        return true;
      } catch (why) {
        app.refused = why instanceof Refusal ? why.problem : { code: "no-connection", message: "", advice: null };
        redraw();
        return false;
      }
    },
    choose(some) {
      Object.assign(app.choices, some);
      if (app.state) app.state.by = app.choices.by;
      store(app.choices);
      redraw();
    },
  };
  return app;
}

/** The captures, and the one that is selected. */
export function selectedCapture(app: App) {
  return app.state?.captures?.find((capture) => capture.id === app.choices.selected) ?? null;
}
