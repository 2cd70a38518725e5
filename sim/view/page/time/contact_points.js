import {SeriesReader} from './series.js';

// Returns, for each sample, its place among the samples that have more than `least` points.
function placesOf(counts, least) {
  let place = -1;
  return counts.map((count) => (count > least ? ++place : place));
}

// The contact points at each sample (page/data.md).
export class ContactPoints {
  constructor({contactPoints, recording, bodies}) {
    this.pairs = [];
    if (!contactPoints) return;
    const {pairs, position, normal, force, series} = contactPoints;
    const reader = new SeriesReader(series);
    const vectors = (length, quantum) =>
        Array.from({length: 3}, () => reader.next(length, quantum));
    this.pairs = pairs.map(({bodies: names, most}) => {
      const counts = reader.next(recording.samples, 1);
      const points = Array.from({length: most}, (_, i) => {
        const places = placesOf(counts, i);
        const length = places[places.length - 1] + 1;
        return {
          places,
          position: vectors(length, position),
          normal: vectors(length, normal),
          force: vectors(length, force),
        };
      });
      const frame = bodies.findIndex((body) => body.name === names[0]);
      // People look at a part and not at the table, so the force on the part is shown.
      return {names, counts, points, frame, isTurned: names[1] === 'world'};
    });
  }

  // Returns the points of a pair at a sample, in the frame of its first body: position, normal and
  // force as arrays. Normal and force point from the second name that is shown to the first.
  at({counts, points, isTurned}, index) {
    const turned = (values) => (isTurned ? values.map((value) => -value) : values);
    return points.slice(0, counts[index]).map(({places, position, normal, force}) => {
      const at = (series) => series.map((values) => values[places[index]]);
      return {position: at(position), normal: turned(at(normal)), force: turned(at(force))};
    });
  }

  // Returns the norm of the whole force between two bodies, in newtons; undefined if it is unknown.
  forceBetween(bodies, index) {
    const pair = this.pairs.find(({names}) => names.every((name, i) => name === bodies[i]));
    if (!pair) return undefined;
    const forces = this.at(pair, index).map(({force}) => force);
    return Math.hypot(...[0, 1, 2].map((i) => forces.reduce((sum, force) => sum + force[i], 0)));
  }

  // Returns the force below which most forces of single points are.
  usualMost() {
    const norms = this.pairs.flatMap(({points}) => points.flatMap(({force}) => {
      const [x, y, z] = force;
      return Array.from(x, (_, i) => Math.hypot(x[i], y[i], z[i]));
    }));
    norms.sort((a, b) => a - b);
    return norms.length > 0 ? norms[Math.floor(0.99 * (norms.length - 1))] : 0;
  }
}
