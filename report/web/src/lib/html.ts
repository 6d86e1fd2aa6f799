// Text becomes HTML in one place: everything that is put into html`...` is escaped, unless it is HTML already.

export class Html {
  constructor(readonly text: string) {}
  toString(): string {
    return this.text;
  }
}

const ENTITIES: Record<string, string> = {"&": "&amp;", "<": "&lt;", ">": "&gt;", '"': "&quot;", "'": "&#39;"};

export const escapeHtml = (text: unknown): string => String(text).replace(/[&<>"']/g, (c) => ENTITIES[c]);

function part(value: unknown): string {
  if (value === null || value === undefined || value === false || value === true) return "";
  if (value instanceof Html) return value.text;
  if (Array.isArray(value)) return value.map(part).join("");
  return escapeHtml(value);
}

export function html(texts: TemplateStringsArray, ...values: unknown[]): Html {
  return new Html(texts.reduce((all, text, i) => all + part(values[i - 1]) + text));
}

/// Of our own words, never of data.
export const raw = (text: string): Html => new Html(text);

export const join = (parts: unknown[], between: Html): Html =>
    new Html(parts.map(part).filter(Boolean).join(between.text));

export function fill(element: Element, content: Html): void {
  element.innerHTML = content.text;
}

export function find<T extends Element = HTMLElement>(root: ParentNode, selector: string): T {
  const found = root.querySelector<T>(selector);
  if (!found) throw new Error(`the page has no ${selector}`);
  return found;
}
