// Sentences in the language that is chosen: the page's own, and what the server says. Elements remember a sentence of the
// page's own, so that another language reaches all of them at once; what the server says is put there with every drawing.

import { attribute, text } from "./dom";
import { SENTENCES, type Key } from "./sentences";
import { inGerman } from "./translation";

export type Language = "en" | "de";
export type { Key };

let language: Language = "en";

export function currentLanguage(): Language {
  return language;
}

/** A sentence; `{name}` in it is replaced by the value of that name. */
export function t(key: Key, values: Record<string, string | number> = {}): string {
  const [english, german] = SENTENCES[key];
  return (language === "de" ? german : english).replace(/\{(\w+)\}/g, (whole, name: string) => String(values[name] ?? whole));
}

/** What the server says as a sentence: with a capital, where it begins with a word, and a full stop. */
export function sentence(said: string): string {
  const trimmed = said.trim();
  const begins = /^(?!f[xy]\b|c[xy]\b)[a-z]+(?=[ ,:;.]|$)/.test(trimmed);
  const capital = begins ? trimmed.charAt(0).toUpperCase() + trimmed.slice(1) : trimmed;
  return /[.!?…:]$/.test(capital) ? capital : `${capital}.`;
}

/** What the server says, in the page's language; what of it is not known there stays English. */
export function translated(english: string): string {
  return language === "de" ? inGerman(english) : english;
}

const WORDS = /[a-z]{3}/i;

/** The element's text is what the server says, in whatever language. One that had to stay English is marked as that. */
export function showTranslated(
  element: Element,
  said: string | readonly string[] | null | undefined,
  as = (words: string) => words,
  between = "; ",
): void {
  const english = typeof said === "string" ? [said] : (said ?? []);
  const words = english.map(translated);
  const isForeign = language !== "en" && words.join() === english.join() && WORDS.test(words.join());
  text(element, words.length ? as(words.join(between)) : "");
  attribute(element, "lang", isForeign && "en");
}

/** The element's text is one of the page's own, put together. */
export function showOwn(element: Element, own: string): void {
  text(element, own);
  attribute(element, "lang", null);
}

/** The element's text is this sentence, in whatever language. */
export function said<E extends Element>(element: E, key: Key): E {
  if (element.getAttribute("data-say") !== key) {
    element.setAttribute("data-say", key);
    element.textContent = t(key);
  }
  return element;
}

/** The element's name for those who do not see it, and its tooltip. */
export function named<E extends Element>(element: E, key: Key, tooltip = false): E {
  if (element.getAttribute("data-name") !== key) {
    element.setAttribute("data-name", key);
    if (tooltip) element.setAttribute("data-tooltip", "");
    rename(element);
  }
  return element;
}

function rename(element: Element): void {
  const name = t(element.getAttribute("data-name") as Key);
  element.setAttribute("aria-label", name);
  if (element.hasAttribute("data-tooltip")) element.setAttribute("title", name);
}

export function speak(wanted: Language): void {
  if (wanted === language) return;
  language = wanted;
  document.documentElement.lang = wanted;
  for (const element of document.querySelectorAll("[data-say]")) {
    element.textContent = t(element.getAttribute("data-say") as Key);
  }
  document.querySelectorAll("[data-name]").forEach(rename);
}
