import {element} from '../dom.js';
import {Recording} from '../time/recording.js';

import {Picture} from './picture.js';

// Another execution of the same plan, drawn beside the first one by the same camera.
export class Beside {
  constructor(data) {
    const {name, times} = data.beside;
    this.name = name;
    this.steps = data.steps;
    this.times = times;
    const own = {...data, ...data.beside};
    this.recording = new Recording(own);
    this.picture = new Picture(own, this.recording);
    this.figure =
        element('figure', {class: 'half'}, this.picture.surface, element('figcaption', {}, name));
  }

  // Returns the time of this execution that is shown beside a time of the first execution. The
  // returned time is in the same step, after the same share of the step. If the first execution
  // broke the step off, this share is unknown, and the same number of seconds after the step's
  // beginning is taken. An execution without steps is shown at the same time.
  timeBeside(time) {
    if (this.times.length === 0) return Math.min(time, this.recording.end);
    const index = this.steps.findIndex((step) => step.from !== undefined && time < step.to);
    const other = this.times[index];
    if (other === undefined) return index < 0 ? this.recording.end : this.recording.start;
    const {from, to, ended} = this.steps[index];
    const share = ended ? (time - from) / (to - from) : 0;
    return other.from + (ended ? share * (other.to - other.from) : time - from);
  }

  show(time) {
    this.picture.show(this.timeBeside(time));
  }
}
