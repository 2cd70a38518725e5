import {Quaternion, Vector3} from 'three';

import {SeriesReader} from './series.js';

// The poses and forces at each sample (page/data.md).
export class Recording {
  constructor(data) {
    const {samples, time, length, turn, force, series} = data.recording;
    const reader = new SeriesReader(series);
    const some = (count, quantum) =>
        Array.from({length: count}, () => reader.next(samples, quantum));
    const track = () => ({position: some(3, length), turn: some(4, turn)});
    this.times = reader.next(samples, time);
    this.bodies = data.bodies.map((body) => (body.name === 'world' ? null : track()));
    this.believed = data.parts.map(track);
    this.force = some(3, force);
    this.torque = some(3, force);
  }

  get start() {
    return this.times[0];
  }
  get end() {
    return this.times[this.times.length - 1];
  }

  // Returns the index of the last sample at or before the time.
  indexAt(time) {
    let [low, high] = [0, this.times.length - 1];
    while (low < high) {
      const middle = (low + high + 1) >> 1;
      if (this.times[middle] <= time)
        low = middle;
      else
        high = middle - 1;
    }
    return low;
  }

  // Returns where a time lies between two samples.
  momentAt(time) {
    const index = this.indexAt(time);
    const next = Math.min(index + 1, this.times.length - 1);
    const span = this.times[next] - this.times[index];
    return {index, next, part: span > 0 ? Math.min(1, (time - this.times[index]) / span) : 0};
  }

  // Sets an object of the scene to the pose of a track.
  place(track, {index, next, part}, object) {
    const at = (series) => series[index] + part * (series[next] - series[index]);
    object.position.set(...track.position.map(at));
    const [w, x, y, z] = track.turn.map(at);
    object.quaternion.set(x, y, z, w).normalize();
  }

  // Returns how far a part truly is from where it is believed to be: metres, radians.
  deviation(body, part, moment) {
    const [truth, belief] = [freeBody(), freeBody()];
    this.place(this.bodies[body], moment, truth);
    this.place(this.believed[part], moment, belief);
    return {
      length: truth.position.distanceTo(belief.position),
      angle: 2 * Math.acos(Math.min(1, Math.abs(truth.quaternion.dot(belief.quaternion)))),
    };
  }

  forceNorm(index) {
    return Math.hypot(...this.force.map((series) => series[index]));
  }
  forceAlong(index, direction) {
    return this.force.reduce((sum, series, axis) => sum + series[index] * direction[axis], 0);
  }
}

const freeBody = () => ({position: new Vector3(), quaternion: new Quaternion()});
