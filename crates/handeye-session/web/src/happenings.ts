// What happened between one state and the next: a sound for it, and words for those who do not look.

import type { App } from "./app";
import { play } from "./sounds";
import { sayOf, type State } from "./state";
import { badVerdict } from "./notices";
import { currentLanguage, showTranslated } from "./words";

const QUIET = 700; // ms that a sentence has to stay before it is spoken

const newest = (state: State): string => {
  const last = state.refused?.[state.refused.length - 1];
  return last ? `${last.time_s} ${last.why}` : "";
};

/** Plays the sounds of what is new. */
export function listen(app: App, before: State | null, now: State): void {
  if (!before || app.choices.muted) return;
  const known = new Set([...(before.captures ?? []), ...(before.deleted ?? [])].map(({ id }) => id));
  const isTaken = now.captures?.some(({ id }) => !known.has(id));
  const isRefused = newest(now) !== "" && newest(now) !== newest(before);
  const isBad = Boolean(badVerdict(now) ?? now.problem);
  if (now.progress?.enough && !before.progress?.enough && !isBad) play("enough");
  else if (isRefused) play("refused");
  else if (isTaken) play("taken");
}

/** Speaks the sentence of what to do next, once it has stayed a while. */
export function makeSpeaker(element: HTMLElement): (state: State) => void {
  let wanted = "";
  let timer: ReturnType<typeof setTimeout> | undefined;
  return (state) => {
    const said = [state.problem?.message ?? "", sayOf(state) ?? ""].filter(Boolean);
    const sentence = `${currentLanguage()} ${said.join(" ")}`;
    if (sentence === wanted) return;
    wanted = sentence;
    clearTimeout(timer);
    timer = setTimeout(() => showTranslated(element, said, (words) => words, " "), QUIET);
  };
}
