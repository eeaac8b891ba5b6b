/** The search box with its list: type, arrow keys, Enter. */

import type { World } from "../world/world";
import { el } from "./dom";
import { icon } from "./icons";
import { find, type Hit } from "./find";
import type { Focus } from "./state";

export interface SearchBox {
  readonly element: HTMLElement;
  readonly open: () => void;
}

export function createSearchBox(world: World, choose: (focus: Focus) => void): SearchBox {
  const input = el("input", {
    label: "Search people, groups, places and actions",
    attrs: {
      ...{ type: "search", placeholder: "Search", autocomplete: "off", spellcheck: "false", role: "combobox" },
      ...{ "aria-expanded": "false", "aria-controls": "hits", "aria-autocomplete": "list" },
    },
  });
  const list = el("ul", { class: "hits card", attrs: { id: "hits", role: "listbox", "aria-label": "Found" } });
  const element = el(
    "div",
    { class: "search card", attrs: { role: "search" } },
    icon("search"),
    input,
    el("kbd", { text: "/" }),
    list,
  );
  const box = new Hits(world, input, list, choose);
  input.addEventListener("input", box.refresh);
  input.addEventListener("focus", box.refresh);
  input.addEventListener("blur", box.close);
  input.addEventListener("keydown", box.onKey);
  list.addEventListener("pointerdown", box.onPointer);
  return { element, open: () => input.focus() };
}

class Hits {
  #hits: readonly Hit[] = [];
  #at = 0;

  constructor(
    readonly world: World,
    readonly input: HTMLInputElement,
    readonly list: HTMLElement,
    readonly choose: (focus: Focus) => void,
  ) {}

  readonly refresh = (): void => {
    this.#hits = find(this.world, this.input.value);
    this.#at = 0;
    this.#show();
  };

  readonly close = (): void => {
    this.#hits = [];
    this.#show();
  };

  readonly onKey = (event: KeyboardEvent): void => {
    if (event.key === "ArrowDown" || event.key === "ArrowUp") {
      const step = event.key === "ArrowDown" ? 1 : this.#hits.length - 1;
      this.#at = this.#hits.length > 0 ? (this.#at + step) % this.#hits.length : 0;
      this.#mark();
      event.preventDefault();
    } else if (event.key === "Enter") this.#take(this.#at);
    else if (event.key === "Escape") {
      this.input.value = "";
      this.input.blur();
      event.preventDefault();
    }
  };

  /** Not `click`: the field would lose the focus first, and the list be gone. */
  readonly onPointer = (event: PointerEvent): void => {
    event.preventDefault();
    const item = event.target instanceof Element ? event.target.closest("li") : null;
    if (item !== null) this.#take([...this.list.children].indexOf(item));
  };

  #take(at: number): void {
    const hit = this.#hits[at];
    if (hit === undefined) return;
    this.input.value = "";
    this.input.blur();
    this.choose(hit.focus);
  }

  #show(): void {
    const asked = this.input.value.trim() !== "" && document.activeElement === this.input;
    this.list.replaceChildren(...(asked ? this.#items() : []));
    this.input.setAttribute("aria-expanded", String(asked));
    this.#mark();
  }

  #items(): HTMLElement[] {
    if (this.#hits.length === 0) return [el("p", { class: "none", text: "Nothing of that name" })];
    return this.#hits.map((hit, i) =>
      el(
        "li",
        { class: `hit ${hit.focus.kind}`, attrs: { role: "option", id: `hit-${i}` } },
        el("span", { class: "title", text: hit.title }),
        el("span", { class: "detail", text: hit.detail }),
      ),
    );
  }

  #mark(): void {
    const marked = this.#hits.length > 0 ? `hit-${this.#at}` : "";
    this.input.setAttribute("aria-activedescendant", marked);
    [...this.list.children].forEach((item, i) => {
      item.setAttribute("aria-selected", String(i === this.#at));
      if (i === this.#at) item.scrollIntoView({ block: "nearest" });
    });
  }
}
