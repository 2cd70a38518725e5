import {Vector3} from 'three';

const NEAREST = 0.02;  // metres from the target
const FARTHEST = 12;

// Moves a camera about a target, z up, by mouse, wheel, pen or fingers.
export class Orbit {
  constructor(camera, onMove) {
    this.camera = camera;
    this.onMove = onMove;
    this.target = new Vector3();
    this.azimuth = 0;
    this.polar = 1;  // from the zenith, radians
    this.distance = 1;
    this.pointers = new Map();
  }

  // Lets people move the camera on this surface.
  listen(surface) {
    surface.addEventListener('pointerdown', (event) => this.press(event));
    surface.addEventListener('pointermove', (event) => this.drag(event));
    for (const end of ['pointerup', 'pointercancel']) {
      surface.addEventListener(end, (event) => this.pointers.delete(event.pointerId));
    }
    surface.addEventListener('wheel', (event) => this.roll(event), {passive: false});
    surface.addEventListener('contextmenu', (event) => event.preventDefault());
  }

  // Looks from where a camera of the scene stands. It turns about the point of its line of sight
  // that is nearest to `middle`.
  lookBy({eye, forward, up, angle}, middle) {
    const [from, ahead] = [new Vector3(...eye), new Vector3(...forward)];
    this.distance = Math.max(0.3, middle.clone().sub(from).dot(ahead));
    this.target.copy(from).addScaledVector(ahead, this.distance);
    const back = ahead.clone().negate();
    this.polar = Math.max(1e-3, Math.acos(Math.min(1, Math.max(-1, back.z))));
    const side = Math.hypot(back.x, back.y) < 1e-6 ? new Vector3(...up).negate() : back;
    this.azimuth = Math.atan2(side.y, side.x);
    this.camera.fov = (angle * 180) / Math.PI;
    this.camera.updateProjectionMatrix();
    this.moved();
  }

  // Looks at a box of this size from the present direction.
  frame(middle, size) {
    this.target.copy(middle);
    this.distance = size.length() / Math.tan((this.camera.fov * Math.PI) / 360);
    this.moved();
  }

  moved() {
    const {azimuth, polar, distance, target, camera} = this;
    const flat = Math.sin(polar) * distance;
    camera.position.set(
        Math.cos(azimuth) * flat, Math.sin(azimuth) * flat, Math.cos(polar) * distance);
    camera.position.add(target);
    camera.lookAt(target);
    this.onMove();
  }

  press(event) {
    this.surface = event.currentTarget;
    this.surface.setPointerCapture(event.pointerId);
    this.pointers.set(event.pointerId, {x: event.clientX, y: event.clientY});
  }

  drag(event) {
    const last = this.pointers.get(event.pointerId);
    if (!last) return;
    const [dx, dy] = [event.clientX - last.x, event.clientY - last.y];
    if (this.pointers.size === 2)
      this.pinch(event, dx, dy);
    else if (event.buttons === 1 && !event.shiftKey && !event.ctrlKey)
      this.turn(dx, dy);
    else
      this.pan(dx, dy);
    Object.assign(last, {x: event.clientX, y: event.clientY});
    this.moved();
  }

  turn(dx, dy) {
    const rate = (2 * Math.PI) / this.surface.clientHeight / 1.5;
    this.azimuth -= rate * dx;
    this.polar = Math.min(Math.PI - 1e-3, Math.max(1e-3, this.polar - rate * dy));
  }

  pan(dx, dy) {
    const height = 2 * this.distance * Math.tan((this.camera.fov * Math.PI) / 360);
    const metres = height / this.surface.clientHeight;
    const [right, up] = [new Vector3(), new Vector3()];
    this.camera.matrix.extractBasis(right, up, new Vector3());
    this.target.addScaledVector(right, -dx * metres).addScaledVector(up, dy * metres);
  }

  // Two fingers pan together, and zoom by their distance.
  pinch(event, dx, dy) {
    const others = [...this.pointers].filter(([id]) => id !== event.pointerId);
    const other = others[0][1];
    const last = this.pointers.get(event.pointerId);
    const before = Math.hypot(last.x - other.x, last.y - other.y);
    const after = Math.hypot(event.clientX - other.x, event.clientY - other.y);
    this.zoom(before / Math.max(1, after));
    this.pan(dx / 2, dy / 2);
  }

  roll(event) {
    event.preventDefault();
    const pixels = event.deltaY * (event.deltaMode === 1 ? 16 : 1);
    this.zoom(Math.exp(0.0015 * pixels));
    this.moved();
  }

  zoom(factor) {
    this.distance = Math.min(FARTHEST, Math.max(NEAREST, this.distance * factor));
  }
}
