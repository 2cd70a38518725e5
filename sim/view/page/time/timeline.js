import {element} from '../dom.js';
import {standingOf} from '../steps/standing.js';
import {numberText} from '../units.js';

const BAND = 22;    // pixels: the steps
const FOOT = 18;    // pixels: the seconds
const EDGE = 8;     // pixels at both ends
const NARROW = 48;  // pixels: a narrower step has no place for the name of its action
const THIN = 4;     // pixels: a step without duration

// Steps, forces and occurrences over time, and the time that is shown. Pressing or dragging changes
// the time that is shown.
export class Timeline {
  constructor(data, recording, player) {
    Object.assign(this, {data, recording, player});
    this.surface = element('canvas', {
      class: 'timeline',
      tabindex: 0,
      role: 'slider',
      'aria-label': 'Time in seconds',
      'aria-valuemin': recording.start.toFixed(2),
      'aria-valuemax': recording.end.toFixed(2),
    });
    this.note = element('div', {class: 'note'});
    this.cursor = element('div', {class: 'cursor'});
    this.root = element('div', {class: 'time'}, this.surface, this.cursor, this.note);
    this.mostForce = Math.max(
        10, ...recording.times.map((_, i) => recording.forceNorm(i)),
        ...data.guards.map((guard) => guard.force));
    this.listen();
    new ResizeObserver(() => this.resize()).observe(this.root);
    player.onChange(() => this.show());
    player.onGlance(() => this.tellTime());
  }

  listen() {
    const {surface, player} = this;
    surface.addEventListener('pointerdown', (event) => {
      surface.setPointerCapture(event.pointerId);
      player.playing = false;
      player.seek(this.timeAt(event.offsetX));
    });
    surface.addEventListener('pointermove', (event) => {
      if (event.buttons === 1) player.seek(this.timeAt(event.offsetX));
      this.tell(event.offsetX);
    });
    surface.addEventListener('pointerleave', () => {
      this.note.textContent = '';
    });
  }

  x(time) {
    const {start, end} = this.player;
    return EDGE + ((time - start) / (end - start)) * (this.width - 2 * EDGE);
  }
  timeAt(x) {
    const {start, end} = this.player;
    return start + ((x - EDGE) / (this.width - 2 * EDGE)) * (end - start);
  }
  y(force) {
    const bottom = this.height - FOOT;
    return bottom - (force / (1.08 * this.mostForce)) * (bottom - BAND - 6);
  }

  // Says what is under the pointer.
  tell(x) {
    const time = this.timeAt(x);
    const index = this.recording.indexAt(time);
    const near = this.data.occurrences.filter((other) => Math.abs(this.x(other.time) - x) < 4);
    const force =
        `${time.toFixed(2)} s · ${numberText(this.recording.forceNorm(index))} N at the wrist`;
    this.note.textContent = [force, ...near.map((other) => other.text)].join(' · ');
  }

  resize() {
    const ratio = window.devicePixelRatio;
    [this.width, this.height] = [this.root.clientWidth, this.root.clientHeight];
    [this.surface.width, this.surface.height] = [this.width * ratio, this.height * ratio];
    this.pen = this.surface.getContext('2d');
    this.pen.scale(ratio, ratio);
    this.draw();
    this.show();
  }

  show() {
    this.cursor.style.transform = `translateX(${this.x(this.player.time)}px)`;
  }
  tellTime() {
    this.surface.setAttribute('aria-valuenow', this.player.time.toFixed(2));
  }

  draw() {
    this.pen.clearRect(0, 0, this.width, this.height);
    this.pen.font = '11px system-ui, sans-serif';
    this.drawScales();
    this.drawForce();
    for (const guard of this.data.guards) this.drawGuard(guard);
    this.drawName();
    for (const step of this.data.steps) this.drawStep(step);
    for (const occurrence of this.data.occurrences) this.drawOccurrence(occurrence);
  }

  drawScales() {
    const {pen, width, height} = this;
    const {start, end} = this.player;
    const spacing = [0.5, 1, 2, 5, 10, 20, 50].find((s) => (end - start) / s < width / 60) || 100;
    pen.textAlign = 'center';
    const first = Math.ceil(start / spacing) * spacing;
    for (let time = first; time <= end; time += spacing) {
      pen.fillStyle = '#e3e7eb';
      pen.fillRect(Math.round(this.x(time)), BAND, 1, height - FOOT - BAND);
      pen.fillStyle = '#52606f';
      pen.fillText(
          time === first ? `${numberText(time)} s` : numberText(time), this.x(time), height - 4);
    }
    pen.fillStyle = '#98a2ad';
    pen.fillRect(EDGE, height - FOOT, width - 2 * EDGE, 1);
  }

  drawName() {
    const {pen} = this;
    const guards = this.data.guards.length > 0 ?
        '; blue: resistance in a guarded move; dashed: the force that ends the move' :
        '';
    const name = `grey: force at the wrist, up to ${numberText(Math.round(this.mostForce))} N${guards}`;
    pen.textAlign = 'left';
    pen.fillStyle = '#ffffff';
    pen.fillRect(EDGE + 1, BAND + 3, pen.measureText(name).width + 4, 14);
    pen.fillStyle = '#52606f';
    pen.fillText(name, EDGE + 2, BAND + 14);
  }

  drawForce() {
    const {pen, recording} = this;
    pen.beginPath();
    recording.times.forEach((time, i) => {
      pen[i === 0 ? 'moveTo' : 'lineTo'](this.x(time), this.y(recording.forceNorm(i)));
    });
    pen.strokeStyle = '#52606f';
    pen.lineWidth = 1.25;
    pen.stroke();
  }

  // Draws the resistance that a guarded move met, and the force that ends the move.
  drawGuard({from, to, force, direction}) {
    const {pen, recording} = this;
    const [first, last] = [recording.indexAt(from), recording.indexAt(to)];
    const before = recording.forceAlong(first, direction);
    pen.strokeStyle = this.data.colors.predicted;
    pen.lineWidth = 2;
    pen.beginPath();
    for (let i = first; i <= last; ++i) {
      const against = Math.max(0, before - recording.forceAlong(i, direction));
      pen[i === first ? 'moveTo' : 'lineTo'](this.x(recording.times[i]), this.y(against));
    }
    pen.stroke();
    pen.lineWidth = 1;
    pen.setLineDash([4, 3]);
    pen.beginPath();
    pen.moveTo(this.x(from) - 3, this.y(force));
    pen.lineTo(this.x(to) + 3, this.y(force));
    pen.stroke();
    pen.setLineDash([]);
  }

  drawStep(step) {
    if (step.from === undefined) return;
    const {pen} = this;
    const left = this.x(step.from);
    const right = Math.max(this.x(step.to), left + THIN);
    const standing = standingOf(step, this.data.colors);
    pen.fillStyle = standing.color;
    pen.globalAlpha = standing.isOpen ? 0.6 : 0.16;
    pen.fillRect(left + 0.5, 0, right - left - 1, BAND - 4);
    pen.globalAlpha = 1;
    pen.fillStyle = standing.isOpen ? '#14202e' : '#2c3a49';
    pen.textAlign = 'left';
    pen.fillText(this.labelOf(step, right - left - 9), left + 5, 13);
  }

  // Returns as much of a step's number and action as fits into this many pixels.
  labelOf({number, action}, width) {
    const fits = (text) => this.pen.measureText(text).width <= width;
    const whole = `${number} ${action}`;
    if (fits(whole)) return whole;
    const cut = [...whole].map((_, i) => `${whole.slice(0, i)}…`).filter(fits).pop();
    if (width >= NARROW && cut) return cut;
    return fits(number) ? number : '';
  }

  drawOccurrence({time, bad}) {
    this.pen.fillStyle = bad ? this.data.colors.violated : '#748ca4';
    this.pen.fillRect(this.x(time) - 1, this.height - FOOT - 5, 2, 5);
  }
}
