/** State that can be watched. */

type Watcher<S> = { readonly keys: readonly (keyof S)[]; readonly tell: (state: Readonly<S>) => void };

export class Store<S extends object> {
  readonly #state: S;
  readonly #watchers: Watcher<S>[] = [];

  constructor(initial: S) {
    this.#state = { ...initial };
  }

  get state(): Readonly<S> {
    return this.#state;
  }

  /** Changes some values and tells those who watch one that is new. */
  set(change: Partial<S>): void {
    const changed = (Object.keys(change) as (keyof S)[]).filter((key) => change[key] !== this.#state[key]);
    if (changed.length === 0) return;
    Object.assign(this.#state, change);
    for (const { keys, tell } of this.#watchers) {
      if (keys.some((key) => changed.includes(key))) tell(this.#state);
    }
  }

  /** Calls `tell` now, and whenever one of these values changes. */
  watch(keys: readonly (keyof S)[], tell: (state: Readonly<S>) => void): void {
    this.#watchers.push({ keys, tell });
    tell(this.#state);
  }
}
