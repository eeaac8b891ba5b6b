/** Elements made in code. All text goes in as text, never as markup: what a world file says is not trusted. */

export interface Props {
  readonly class?: string;
  readonly text?: string;
  readonly title?: string;
  /** The name that a screen reader says. */
  readonly label?: string;
  readonly attrs?: Readonly<Record<string, string>>;
  readonly click?: (event: MouseEvent) => void;
}

export function el<K extends keyof HTMLElementTagNameMap>(
  tag: K,
  props: Props = {},
  ...children: readonly (Node | string)[]
): HTMLElementTagNameMap[K] {
  const made = document.createElement(tag);
  if (props.class !== undefined) made.className = props.class;
  if (props.text !== undefined) made.textContent = props.text;
  if (props.title !== undefined) made.title = props.title;
  if (props.label !== undefined) made.setAttribute("aria-label", props.label);
  for (const [name, value] of Object.entries(props.attrs ?? {})) made.setAttribute(name, value);
  if (props.click !== undefined) made.addEventListener("click", props.click as (event: Event) => void);
  made.append(...children);
  return made;
}

export function svg<K extends keyof SVGElementTagNameMap>(
  tag: K,
  attrs: Readonly<Record<string, string | number>> = {},
  ...children: readonly (Node | string)[]
): SVGElementTagNameMap[K] {
  const made = document.createElementNS("http://www.w3.org/2000/svg", tag);
  for (const [name, value] of Object.entries(attrs)) made.setAttribute(name, String(value));
  made.append(...children);
  return made;
}

export function button(props: Props, ...children: readonly (Node | string)[]): HTMLButtonElement {
  return el("button", { ...props, attrs: { type: "button", ...props.attrs } }, ...children);
}

/** Sets text only where it changed: the browser then has nothing to lay out anew. */
export function setText(target: Element, text: string): void {
  if (target.textContent !== text) target.textContent = text;
}
