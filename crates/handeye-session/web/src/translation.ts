// What the server says, in the page's language: its English sentences are matched against the templates of `sentences.ts`.
// A text for which there is no template is taken apart at the ends of its sentences and clauses; what stays unknown stays as
// it is.

import { SERVER_SENTENCES } from "./sentences";

interface Template {
  pattern: RegExp;
  longest: string; // its longest piece of text: what does not hold it does not match
  names: string[]; // of its placeholders, with their marks
  german: string;
}

const PLACEHOLDER = /\{(\w+)([*~]?)\}/g;
const escaped = (literal: string) => literal.replace(/[.*+?^${}()|[\]\\]/g, "\\$&");
const bare = (text: string) => text.replace(/\.$/, "");

function prepared(english: string, german: string): Template & { size: number } {
  const text = bare(english.replaceAll("|", ""));
  const literals = text.split(/\{\w+[*~]?\}/);
  const names = [...text.matchAll(PLACEHOLDER)].map(([, name, mark]) => `${name}${mark}`);
  const first = literals[0] ?? "";
  const anyCase = /^[a-z]/i.test(first) ? `[${first.charAt(0).toLowerCase()}${first.charAt(0).toUpperCase()}]${escaped(first.slice(1))}` : escaped(first);
  const rest = literals.slice(1).map((literal, i) => `${/[*~]$/.test(names[i] ?? "") ? "(.+?)" : "(\\S+?)"}${escaped(literal)}`);
  return {
    pattern: new RegExp(`^${anyCase}${rest.join("")}$`, "s"),
    longest: literals.map((literal, i) => (i === 0 ? literal.slice(1) : literal)).reduce((a, b) => (b.length > a.length ? b : a)),
    names,
    german: bare(german),
    size: literals.join("").length,
  };
}

/** Those with most letters of their own first. */
const templates = SERVER_SENTENCES.map(([english, german]) => prepared(english, german)).sort((a, b) => b.size - a.size);

const capital = (text: string) => text.charAt(0).toUpperCase() + text.slice(1);

/** Words that have a capital only where a sentence begins. */
const SMALL = new Set(
  `
  Ab Aber Alle Als Am An Auch Auf Aufgenommen Aus Bei Beide Bestätigen Bis Da Danach Darauf Darin Das Dasselbe Davon Den
  Der Des Die Dies Diese Dieser Dieses Dort Dorthin Ein Eine Einem Einen Einer Eins Entweder Er Erst Es Etwas Für
  Genug Geprüft Geschrieben Herausfinden Hier Hingelegte Höchstens Ihr Ihre Im In Ist Jetzt Kein Keine Mehr Mit Nach
  Maßgebend Neben Nicht Nichts Noch Nur Oder Ohne Seine Seit Sich Sie Siehe Sind Startet Steckt Stimmen Um Und Viele
  Vielleicht Vom Von Vor Vorhergesagter Warmlaufen Warte Was Welche Wenn Wie Wiederholt Wo Zu Zum Zur Zwischen
  `.split(/\s+/),
);

/** The German as it begins after `before`, in place of this English. */
function begun(german: string, english: string, before: string): string {
  if (/[:(] ?$/.test(before)) return german;
  if (/^\p{Lu}/u.test(english)) return capital(german);
  const word = /^\p{L}+/u.exec(german)?.[0] ?? "";
  return SMALL.has(word) ? german.charAt(0).toLowerCase() + german.slice(1) : german;
}

/** A text for which there is one template. */
function whole(english: string, before: string): string | null {
  const text = bare(english);
  for (const { pattern, longest, names, german } of templates) {
    if (!text.includes(longest)) continue;
    const found = pattern.exec(text);
    if (!found) continue;
    const values = new Map(names.map((name, i) => [name, found[i + 1] ?? ""]));
    const filled = german.replace(PLACEHOLDER, (mark, name: string, kind: string, at: number) => {
      const value = values.get(name + kind) ?? mark;
      return kind === "*" ? inside(value, before + german.slice(0, at)) : value;
    });
    const made = begun(filled, text, before);
    return english.endsWith(".") && !/[.!?…:]$/.test(made) ? `${made}.` : made;
  }
  return null;
}

const ENDS = /([.?;:]|, and|, or|,) /g;
const IN_GERMAN: Record<string, string> = { ", and": ", und", ", or": ", oder" };
const MOST_ENDS = 24; // a text that has more is none of sentences

/** A text, part by part where it is not known as a whole. */
function inside(english: string, before = ""): string {
  const known = whole(english, before);
  if (known !== null) return known;
  const ends = [...english.matchAll(ENDS)].slice(0, MOST_ENDS);
  const cut = (end: RegExpExecArray, left: string | null) => {
    const mark = end[1] ?? "";
    const isOfSentence = mark === "." || mark === "?";
    const first = left ?? english.slice(0, end.index) + (isOfSentence ? mark : "");
    const start = isOfSentence ? `${first} ` : `${first}${IN_GERMAN[mark] ?? mark} `;
    return start + inside(english.slice(end.index + end[0].length), before + start);
  };
  // the longest beginning that is known; where none is, the shortest part stays as it is
  for (const end of [...ends].reverse()) {
    const mark = end[1] ?? "";
    const left = whole(english.slice(0, end.index) + (mark === "." || mark === "?" ? mark : ""), before);
    if (left !== null) return cut(end, left);
  }
  const first = ends.find(([, mark]) => mark !== ","); // which ends a part of a list alone
  if (!first) return english;
  const rest = cut(first, null);
  return rest.endsWith(english.slice(first.index + first[0].length)) ? english : rest;
}

const KEPT = 300; // texts; those with numbers of now are others all the time
const kept = new Map<string, string>();

/** What the server says, in German. */
export function inGerman(english: string): string {
  const before = kept.get(english);
  if (before !== undefined) return before;
  if (kept.size >= KEPT) kept.delete(kept.keys().next().value as string);
  const german = inside(english);
  kept.set(english, german);
  return german;
}
