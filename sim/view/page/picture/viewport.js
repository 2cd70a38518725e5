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
    for (const {surface} of this.pictures()) this.orbit.listen(surface);
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

  // Shows or hides the ghosts ("showsBelieved"), the error sets ("showsSets"), or the execution
  // beside ("showsBeside").
  toggle(kind) {
    if (kind === 'showsBeside') {
      this.showsBeside = !this.showsBeside;
      this.beside.figure.hidden = !this.showsBeside;
    } else {
      for (const {outlines} of this.pictures()) outlines[kind] = !outlines[kind];
    }
    this.show(this.time);
    return kind === 'showsBeside' ? this.showsBeside : this.outlines[kind];
  }

  // Draws bodies in the colour of what is wrong.
  mark(names) {
    this.picture.stage.mark(names);
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
