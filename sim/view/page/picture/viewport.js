import * as three from 'three';

import {element} from '../dom.js';

import {Beside} from './beside.js';
import {Orbit} from './orbit.js';
import {Picture} from './picture.js';
import {WorkView} from './work_view.js';

// The picture of the execution by one camera, and that of the execution beside it. They are drawn
// again only if something has changed.
export class Viewport {
  constructor(data, recording) {
    this.picture = new Picture(data, recording);
    this.surface = this.picture.surface;
    this.outlines = this.picture.outlines;
    this.beside = data.beside ? new Beside(data) : null;
    this.showsBeside = this.beside !== null;
    this.root = this.rootOf();
    this.camera = new three.PerspectiveCamera(40, 1, 0.01, 40);
    this.camera.up.set(0, 0, 1);
    this.orbit = new Orbit(this.camera, () => {
      this.stale = true;
    });
    this.note = element('div', {class: 'contact-note', hidden: true});
    this.root.append(this.note);
    for (const picture of this.pictures()) {
      this.orbit.listen(picture.surface);
      this.tellOfContacts(picture);
    }
    this.work = new WorkView(data, this.picture.stage, this.orbit);
    this.cameras = data.cameras;
    this.camerasChosen = [];
    this.frames = 0;
    this.show(recording.start);
    this.choose(data.drawings ? WorkView.NAME : data.cameras[0].name);
    new ResizeObserver(() => this.resize()).observe(this.surface);
  }

  rootOf() {
    if (!this.beside) return element('div', {class: 'views'}, this.surface);
    const first = element(
        'figure', {class: 'half'}, this.surface, element('figcaption', {}, 'this execution'));
    return element('div', {class: 'views'}, first, this.beside.figure);
  }

  pictures() {
    return this.beside ? [this.picture, this.beside.picture] : [this.picture];
  }

  cameraNames() {
    return [...this.cameras.map((camera) => camera.name), WorkView.NAME];
  }
  onChoice(listener) {
    this.camerasChosen.push(listener);
  }

  choose(name) {
    this.chosen = name;
    const camera = this.cameras.find((other) => other.name === name);
    this.work.follows = !camera;
    if (camera)
      this.orbit.lookBy(camera, this.middle());
    else
      this.work.frame();
    for (const listener of this.camerasChosen) listener(name);
  }

  // Says what touches under the pointer.
  tellOfContacts({surface, contacts}) {
    const tell = (text, event) => {
      this.note.hidden = text === '';
      this.note.textContent = text;
      const {left, top, width} = this.root.getBoundingClientRect();
      const x = Math.min(event.clientX - left + 14, width - this.note.offsetWidth - 4);
      this.note.style.transform = `translate(${x}px, ${event.clientY - top + 14}px)`;
    };
    surface.addEventListener('pointermove', (event) => {
      const {offsetX, offsetY, buttons} = event;
      tell(buttons === 0 ? contacts.textAt(offsetX, offsetY, this.camera, surface) : '', event);
    });
    surface.addEventListener('pointerleave', (event) => tell('', event));
  }

  middle() {
    const middle = new three.Vector3();
    const parts = this.outlines.parts;
    for (const {frame} of parts) middle.addScaledVector(frame.position, 1 / parts.length);
    return middle;
  }

  show(time) {
    this.picture.show(time);
    if (this.showsBeside) this.beside.show(time);
    this.work.follow();
    this.time = time;
    this.stale = true;
  }

  // Shows or hides the second execution ("showsBeside"), or one of the kinds of Picture.toggle.
  // Returns whether it is shown now.
  toggle(kind) {
    const [shown] = kind === 'showsBeside' ? [this.toggleBeside()] :
                                             this.pictures().map((other) => other.toggle(kind));
    this.show(this.time);
    return shown;
  }
  toggleBeside() {
    this.showsBeside = !this.showsBeside;
    this.beside.figure.hidden = !this.showsBeside;
    return this.showsBeside;
  }

  // Draws bodies in the colour of what is wrong, others as ghosts, and lines in the world. Looks at
  // the ghosts and the lines.
  mark(names, {ghosts = [], lines = []} = {}) {
    const {stage, pointers} = this.picture;
    stage.mark(names);
    this.picture.ghosts.show(ghosts, names);
    pointers.show(lines);
    const box = this.picture.ghosts.box() || pointers.box();
    if (box) this.orbit.frame(box.getCenter(new three.Vector3()), box.getSize(new three.Vector3()));
    this.show(this.time);
  }

  resize() {
    const [aspect] = this.pictures().map((picture) => picture.resize());
    if (aspect === 0) return;
    this.camera.aspect = aspect;
    this.camera.updateProjectionMatrix();
    this.stale = true;
    this.draw();
  }

  draw() {
    if (!this.stale) return;
    this.picture.draw(this.camera);
    if (this.showsBeside) this.beside.picture.draw(this.camera);
    ++this.frames;
    this.stale = false;
  }
}
