// Elements: made once, then changed only where something differs, so that focus, scroll and selection stay.

type Child = Node | string | null;
type Attributes = Record<string, string | number | boolean | null | undefined | ((event: Event) => void)>;

/** An element. Attributes that are functions are listeners. */
export function h<K extends keyof HTMLElementTagNameMap>(
  tag: K,
  attributes: Attributes = {},
  ...children: Child[]
): HTMLElementTagNameMap[K] {
  return dressed(document.createElement(tag), attributes, children);
}

/** An element of a drawing. */
export function svg<K extends keyof SVGElementTagNameMap>(
  tag: K,
  attributes: Attributes = {},
  ...children: Child[]
): SVGElementTagNameMap[K] {
  return dressed(document.createElementNS("http://www.w3.org/2000/svg", tag), attributes, children);
}

function dressed<E extends Element>(element: E, attributes: Attributes, children: Child[]): E {
  for (const [name, value] of Object.entries(attributes)) {
    if (typeof value === "function") element.addEventListener(name, value);
    else attribute(element, name, value);
  }
  for (const child of children) if (child !== null) element.append(child);
  return element;
}

/** Sets an attribute; false, null and undefined take it away. */
export function attribute(element: Element, name: string, value: string | number | boolean | null | undefined): void {
  if (value === false || value === null || value === undefined) {
    if (element.hasAttribute(name)) element.removeAttribute(name);
    return;
  }
  const wanted = value === true ? "" : String(value);
  if (element.getAttribute(name) !== wanted) element.setAttribute(name, wanted);
}

/** Sets the text, where it differs. */
export function text(element: Element, wanted: Maybe<string>): void {
  const given = wanted ?? "";
  if (element.textContent !== given) element.textContent = given;
}

type Maybe<T> = T | null | undefined;

export function show(element: HTMLElement | SVGElement, visible: boolean): void {
  if (element instanceof HTMLElement) {
    if (element.hidden === visible) element.hidden = !visible;
  } else attribute(element, "display", visible ? null : "none");
}

export function kind(element: Element, name: string, on: boolean): void {
  if (element.classList.contains(name) !== on) element.classList.toggle(name, on);
}

/** The width of a bar in percent. */
export function width(element: HTMLElement, percent: number): void {
  const wanted = `${Math.round(Math.min(100, Math.max(0, percent)) * 10) / 10}%`;
  if (element.style.width !== wanted) element.style.width = wanted;
}

/** Sets what a field holds, unless someone is typing there. */
export function field(element: HTMLInputElement | HTMLSelectElement | HTMLTextAreaElement, value: string): void {
  if (document.activeElement !== element && element.value !== value) element.value = value;
}

export interface Row<T> {
  element: Element;
  update(item: T): void;
}

/** A list whose rows stay the same elements while their keys are there. */
export function list<T>(parent: Element, key: (item: T) => string, make: (item: T) => Row<T>) {
  const rows = new Map<string, Row<T>>();
  return (items: readonly T[]): void => {
    const wanted = new Set(items.map(key));
    for (const [name, row] of rows) {
      if (!wanted.has(name)) {
        row.element.remove();
        rows.delete(name);
      }
    }
    let place = parent.firstElementChild;
    for (const item of items) {
      const name = key(item);
      let row = rows.get(name);
      if (!row) rows.set(name, (row = make(item)));
      if (row.element === place) place = place.nextElementSibling;
      else parent.insertBefore(row.element, place);
      row.update(item);
    }
  };
}
