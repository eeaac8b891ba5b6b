/** Where a world comes from: the page itself, or a file that the user drops or chooses. */

import { readWorld } from "../world/read";
import { startPlayer, type Player } from "./app";
import { el } from "./dom";

/** Plays the world that the page holds, or asks for one; a world file dropped on the page takes its place. */
export function open(root: HTMLElement): void {
  const page = new Page(root);
  const held = document.getElementById("world")?.textContent?.trim() ?? "";
  if (held === "") page.ask();
  else page.show(() => decode(held));
  page.letDrop();
}

class Page {
  readonly #root: HTMLElement;
  #player: Player | null = null;

  constructor(root: HTMLElement) {
    this.#root = root;
  }

  ask(): void {
    this.#say(
      "Drop a world file here",
      "A file that ends in .genc, as genc populate writes it. It stays on this computer.",
    );
  }

  /** Plays the world in these bytes; what is wrong with them is said in one line. */
  show(bytes: () => Uint8Array): void {
    try {
      const world = readWorld(bytes());
      this.#player?.stop();
      this.#player = startPlayer(this.#root, world);
      window.genc = this.#player.api;
      void this.#player.api.ready.then(markReady);
    } catch (error) {
      this.#player?.stop();
      this.#say("This world cannot be played", error instanceof Error ? error.message : String(error));
    }
  }

  letDrop(): void {
    const cover = el("div", { class: "drop", text: "Drop the world file" });
    document.body.append(cover);
    const carriesFile = (event: DragEvent): boolean => event.dataTransfer?.types.includes("Files") === true;
    addEventListener("dragover", (event) => {
      if (!carriesFile(event)) return;
      event.preventDefault();
      cover.classList.add("shown");
    });
    addEventListener("dragleave", (event) => {
      if (event.relatedTarget === null) cover.classList.remove("shown");
    });
    addEventListener("drop", (event) => {
      if (!carriesFile(event)) return;
      event.preventDefault();
      cover.classList.remove("shown");
      void this.#take(event.dataTransfer?.files[0]);
    });
  }

  async #take(file: File | undefined): Promise<void> {
    if (file === undefined) return;
    const bytes = new Uint8Array(await file.arrayBuffer());
    this.show(() => bytes);
  }

  #say(title: string, line: string): void {
    const input = el("input", { label: "Choose a world file", attrs: { type: "file", accept: ".genc" } });
    input.addEventListener("change", () => void this.#take(input.files?.[0]));
    const card = el(
      "main",
      { class: "message card", attrs: { role: "alert" } },
      el("h1", { text: title }),
      el("p", { text: line }),
      input,
    );
    this.#root.replaceChildren(card);
    markReady();
  }
}

function markReady(): void {
  document.documentElement.dataset["ready"] = "1";
}

function decode(base64: string): Uint8Array {
  let letters: string;
  try {
    letters = atob(base64);
  } catch {
    throw new Error("The world in this page is damaged. Write it again with genc populate.");
  }
  const bytes = new Uint8Array(letters.length);
  for (let i = 0; i < bytes.length; i += 1) bytes[i] = letters.charCodeAt(i);
  return bytes;
}
