// Elements from values.

export type Child = Node | string | null | undefined | false;
type Props = Record<string, string | number | boolean | null | undefined | ((event: Event) => void)>;

// A name of the tool, which may be broken between its parts only: "packed(", "index_bits=", "32)".
export function breakable(name: string): DocumentFragment {
  const made = document.createDocumentFragment();
  for (const part of name.split(/(?<=[(,=_/+|:])/)) made.append(part, document.createElement("wbr"));
  return made;
}

// h("button", {class: "quiet", onclick: f, hidden: true}, "Copy"). Functions are listeners, true is a bare attribute,
// false, null and undefined none.
export function h<K extends keyof HTMLElementTagNameMap>(
  tag: K,
  props: Props = {},
  ...children: Child[]
): HTMLElementTagNameMap[K] {
  const element = document.createElement(tag);
  for (const [name, value] of Object.entries(props)) {
    if (typeof value === "function") element.addEventListener(name.replace(/^on/, ""), value);
    else if (value === true) element.setAttribute(name, "");
    else if (value !== false && value != null) element.setAttribute(name, String(value));
  }
  element.append(...children.filter((child): child is Node | string => child != null && child !== false));
  return element;
}

// A text whose names of the tool stand between backticks.
export function withCode(text: string): Child[] {
  return text.split("`").map((part, at) => (at % 2 === 1 ? h("code", {}, part) : part));
}
