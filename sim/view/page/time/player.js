export const SPEEDS = [0.1, 0.25, 0.5, 1, 2, 4, 8];

const GLANCE = 100;  // milliseconds

// The time that is shown, and its passing. Listeners are called after each change.
export class Player {
  constructor(recording) {
    [this.start, this.end] = [recording.start, recording.end];
    this.times = recording.times;
    this.time = this.start;
    this.speed = 1;
    this.playing = false;
    this.listeners = [];
  }

  onChange(listener) {
    this.listeners.push(listener);
  }
  // The listener is called after each change, but only some times a second while time passes:
  // nobody reads more texts, and new texts take time.
  onGlance(listener) {
    let last = 0;
    this.onChange(() => {
      const now = performance.now();
      if (this.playing && now - last < GLANCE) return;
      last = now;
      listener(this);
    });
  }
  changed() {
    for (const listener of this.listeners) listener(this);
  }

  seek(time) {
    this.time = Math.min(this.end, Math.max(this.start, time));
    if (this.time === this.end) this.playing = false;
    this.changed();
  }
  // Moves by whole samples.
  step(count) {
    this.playing = false;
    const near = this.times.findIndex((time) => time >= this.time - 1e-6);
    this.seek(this.times[Math.min(this.times.length - 1, Math.max(0, near + count))]);
  }
  toggle() {
    this.play(!this.playing);
  }
  play(playing) {
    if (playing && this.time >= this.end) this.time = this.start;
    this.playing = playing;
    this.changed();
  }
  setSpeed(speed) {
    this.speed = speed;
    this.changed();
  }
  faster(steps) {
    const index = SPEEDS.indexOf(this.speed) + steps;
    this.setSpeed(SPEEDS[Math.min(SPEEDS.length - 1, Math.max(0, index))]);
  }
  // Lets this many seconds of real time pass.
  pass(seconds) {
    if (this.playing) this.seek(this.time + this.speed * seconds);
  }
}
