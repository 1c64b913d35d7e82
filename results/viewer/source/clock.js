// The one time that scene, timeline and plots show.

export const SPEEDS = [1, 2, 5, 10, 20, 60];

export class Clock {
  constructor(start, end) {
    this.start = start;
    this.end = end;
    this.time = start;
    this.speed = 10;
    this.playing = false;
    this.listeners = [];
    this.before = 0;
  }

  /** `listener(clock)` is called now and after every change of time, speed or playing. */
  listen(listener) {
    this.listeners.push(listener);
    listener(this);
  }

  set(time) {
    this.time = Math.min(this.end, Math.max(this.start, time));
    this.#tell();
  }

  setSpeed(speed) {
    this.speed = speed;
    this.#tell();
  }

  /** One step along SPEEDS. */
  changeSpeed(steps) {
    const at = SPEEDS.indexOf(this.speed) + steps;
    this.setSpeed(SPEEDS[Math.min(SPEEDS.length - 1, Math.max(0, at))]);
  }

  toggle(playing = !this.playing) {
    if (playing && this.time >= this.end) this.time = this.start;
    this.playing = playing;
    this.before = 0;
    this.#tell();
  }

  /** Called once a frame with its time stamp, ms. */
  advance(now) {
    if (!this.playing) return;
    const passed = this.before ? Math.min(0.25, (now - this.before) / 1000) : 0; // a tab that slept does not leap
    this.before = now;
    const next = this.time + passed * this.speed;
    if (next >= this.end) this.playing = false;
    this.set(next);
  }

  #tell() {
    for (const listener of this.listeners) listener(this);
  }
}

/** A number with so many decimals and a proper minus; never "-0.00". */
export function fixed(value, decimals) {
  const text = value.toFixed(decimals);
  return Number(text) === 0 ? text.replace('-', '') : text.replace('-', '\u2212');
}

/** "1:02:05" from seconds, "2:05" below an hour. */
export function clockText(seconds) {
  const s = Math.floor(seconds + 1e-6);
  const two = (v) => String(v).padStart(2, "0");
  const minutes = Math.floor(s / 60);
  return minutes < 60 ? `${minutes}:${two(s % 60)}` : `${Math.floor(minutes / 60)}:${two(minutes % 60)}:${two(s % 60)}`;
}
