import {element} from '../dom.js';
import {plainName} from '../steps/names.js';

// What is read off the shown time, over the picture: how far each part is from where it is believed
// to be, and what touches.
export class Readings {
  constructor(data, recording, player) {
    Object.assign(this, {data, recording, shownAt: 0});
    this.rows = data.parts.map((part) => {
      const cell = element('td');
      return {cell, row: element('tr', {}, element('th', {scope: 'row'}, part.name), cell)};
    });
    this.contacts = element('p');
    this.root = element(
        'div', {class: 'readings'},
        element(
            'table', {}, element('caption', {}, 'truly off the believed pose'),
            ...this.rows.map(({row}) => row)),
        this.contacts);
    this.bodies =
        data.parts.map((part) => data.bodies.findIndex((body) => body.name === part.body));
    player.onChange(() => this.showSometimes(player));
    this.show(player.time);
  }

  // While time passes, nobody reads more than some texts a second.
  showSometimes(player) {
    const now = performance.now();
    if (player.playing && now - this.shownAt < 100) return;
    this.shownAt = now;
    this.show(player.time);
  }

  show(time) {
    const moment = this.recording.momentAt(time);
    this.rows.forEach(({cell}, i) => {
      const {length, angle} = this.recording.deviation(this.bodies[i], i, moment);
      cell.textContent =
          `${(1000 * length).toFixed(2)} mm, ${((180 / Math.PI) * angle).toFixed(2)}°`;
    });
    const touching =
        this.data.contacts
            .filter(({times}) => times.some(([from, to]) => from <= time && time <= to))
            .map(({bodies}) => bodies.map(plainName).join(' – '));
    this.contacts.textContent = touching.length > 0 ? `touching: ${touching.join(', ')}` : '';
  }
}
