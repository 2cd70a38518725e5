import {Vector3} from 'three';

const FROM = new Vector3(0.8, -0.75, 0.6).normalize();  // the usual direction of the renders
const MARGIN = 1.15;

// The camera that follows the parts and the hand that is nearest to them.
export class WorkView {
  static NAME = 'work';

  constructor(data, stage, orbit) {
    const bodies = (holds) => stage.bodies.filter((_, i) => holds(data.bodies[i].name));
    this.hands = bodies((name) => name.endsWith('gripper/hand'));
    this.parts = bodies((name) => name.startsWith('part/'));
    this.orbit = orbit;
    this.follows = false;
  }

  // Returns the middle of what is followed.
  middle() {
    const nearest = (hand) =>
        Math.min(...this.parts.map((p) => p.position.distanceTo(hand.position)));
    const hand = this.hands.reduce((a, b) => (nearest(a) <= nearest(b) ? a : b));
    this.points = [...this.parts, hand].map((body) => body.position);
    const middle = new Vector3();
    for (const point of this.points) middle.addScaledVector(point, 1 / this.points.length);
    return middle;
  }

  frame() {
    const middle = this.middle();
    const radius = Math.max(...this.points.map((point) => point.distanceTo(middle))) + 0.06;
    const angle = (35 * Math.PI) / 180;
    const eye = middle.clone().addScaledVector(FROM, (MARGIN * radius) / Math.sin(angle / 2));
    this.orbit.lookBy(
        {eye: eye.toArray(), forward: FROM.clone().negate().toArray(), angle}, middle);
    this.last = middle;
  }

  // Moves the camera along with what it follows; distance and direction stay as people turned them.
  follow() {
    if (!this.follows) return;
    const middle = this.middle();
    this.orbit.target.add(middle).sub(this.last);
    this.last = middle;
    this.orbit.moved();
  }
}
