/** Frames on demand: they are asked for while something moves, and no longer. */

/** After the last change the panels, which follow more slowly, have this long to catch up. */
const SETTLING = 350;

/** A page that slept must not leap when it wakes. */
const LONGEST_FRAME = 0.25;

const REMEMBERED = 121;

export class Loop {
  readonly #tick: (seconds: number) => boolean;
  readonly #durations: number[] = [];
  #frame = 0;
  #last = 0;
  #awakeUntil = 0;
  #nFrames = 0;

  /** `tick` gets the seconds since the last frame and says whether it moves on by itself. */
  constructor(tick: (seconds: number) => boolean) {
    this.#tick = tick;
  }

  /** Something has changed: draw, and go on until it has settled. */
  readonly wake = (): void => {
    this.#awakeUntil = performance.now() + SETTLING;
    if (this.#frame === 0) {
      this.#last = performance.now();
      this.#frame = requestAnimationFrame(this.#run);
    }
  };

  stop(): void {
    cancelAnimationFrame(this.#frame);
    this.#frame = -1;
  }

  get nFrames(): number {
    return this.#nFrames;
  }

  /** The median script time of the last frames, in milliseconds. */
  get scriptMs(): number {
    const sorted = [...this.#durations].sort((a, b) => a - b);
    return sorted[sorted.length >> 1] ?? 0;
  }

  readonly #run = (now: number): void => {
    const seconds = Math.min(Math.max(now - this.#last, 0) / 1000, LONGEST_FRAME);
    this.#last = now;
    const began = performance.now();
    const moves = this.#tick(seconds);
    this.#durations.push(performance.now() - began);
    if (this.#durations.length > REMEMBERED) this.#durations.shift();
    this.#nFrames += 1;
    const goesOn = moves || performance.now() < this.#awakeUntil;
    this.#frame = goesOn ? requestAnimationFrame(this.#run) : 0;
  };
}
