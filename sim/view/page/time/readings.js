import {element} from '../dom.js';
import {plainName} from '../steps/names.js';
import {numberText} from '../units.js';

const scaleOf = ({perCentimetre}) =>
    element('p', {}, `a centimetre of a force arrow: ${numberText(perCentimetre)}\u202fN`);

// Readings at the shown time, over the picture: the distance of each part's true pose from its
// believed pose, and the bodies that touch. A click on the first line hides them.
export class Readings {
  constructor(data, recording, player, contactMarks) {
    Object.assign(this, {data, recording, points: contactMarks.points});
    this.rows = data.parts.map((part) => {
      const cell = element('td');
      return {cell, row: element('tr', {}, element('th', {scope: 'row'}, part.name), cell)};
    });
    this.contacts = element('p');
    this.root = element(
        'details', {class: 'readings', open: true},
        element('summary', {}, 'distance of the true pose from the believed pose'),
        element('table', {}, ...this.rows.map(({row}) => row)), this.contacts,
        contactMarks.exist ? scaleOf(contactMarks) : null);
    this.bodies =
        data.parts.map((part) => data.bodies.findIndex((body) => body.name === part.body));
    player.onGlance(() => this.show(player.time));
    this.show(player.time);
  }

  forceText(bodies, {index}) {
    const force = this.points.forceBetween(bodies, index);
    return force === undefined ? '' : ` (${force.toFixed(1)}\u202fN)`;
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
            .map(({bodies}) => bodies.map(plainName).join(' – ') + this.forceText(bodies, moment));
    this.contacts.textContent = touching.length > 0 ? `touching: ${touching.join(', ')}` : '';
  }
}
