import * as three from 'three';

import {element} from './dom.js';
import {Orbit} from './orbit.js';
import {Outlines} from './outlines.js';
import {Stage} from './stage.js';
import {WorkView} from './work_view.js';

const GROUND = '#f3f5f7';

function lights() {
  const sun = new three.DirectionalLight('#ffffff', 0.46);
  sun.position.set(1.2, -1.6, 2.6);
  const fill = new three.DirectionalLight('#ffffff', 0.18);
  fill.position.set(-1.5, 1.2, 1);
  return [new three.AmbientLight('#ffffff', 0.56), sun, fill];
}

// Without a graphics card, smooth edges would take a third of the time of each frame.
function hasGraphicsCard() {
  const context = document.createElement('canvas').getContext('webgl');
  const names = context && context.getExtension('WEBGL_debug_renderer_info');
  return !names ||
      !/swiftshader|llvmpipe|software/i.test(context.getParameter(names.UNMASKED_RENDERER_WEBGL));
}

// The picture: the bodies and outlines at one time, by one camera. It is drawn again only if
// something has changed.
export class Viewport {
  constructor(data, recording) {
    this.recording = recording;
    this.stage = new Stage(data, recording);
    this.outlines = new Outlines(data, recording);
    this.scene = new three.Scene();
    this.scene.background = new three.Color(GROUND);
    this.scene.add(this.stage.root, this.outlines.root, ...lights());
    this.surface = element('canvas', {'aria-label': 'Scene in three dimensions', role: 'img'});
    this.renderer = new three.WebGLRenderer({canvas: this.surface, antialias: hasGraphicsCard()});
    this.renderer.setPixelRatio(Math.min(2, window.devicePixelRatio));
    this.camera = new three.PerspectiveCamera(40, 1, 0.01, 40);
    this.camera.up.set(0, 0, 1);
    this.orbit = new Orbit(this.camera, this.surface, () => {
      this.stale = true;
    });
    this.work = new WorkView(data, this.stage, this.orbit);
    this.cameras = data.cameras;
    this.camerasChosen = [];
    this.frames = 0;
    this.show(recording.start);
    this.choose(data.cameras[0].name);
    new ResizeObserver(() => this.resize()).observe(this.surface);
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
    const moment = this.recording.momentAt(time);
    this.stage.show(moment);
    this.outlines.show(moment, time);
    this.work.follow();
    this.time = time;
    this.stale = true;
  }

  // Shows or hides the ghosts ("showsBelieved") or the error sets ("showsSets").
  toggle(kind) {
    this.outlines[kind] = !this.outlines[kind];
    this.show(this.time);
    return this.outlines[kind];
  }

  resize() {
    const {clientWidth, clientHeight} = this.surface;
    if (clientWidth === 0 || clientHeight === 0) return;
    this.renderer.setSize(clientWidth, clientHeight, false);
    this.camera.aspect = clientWidth / clientHeight;
    this.camera.updateProjectionMatrix();
    this.stale = true;
    this.draw();
  }

  draw() {
    if (!this.stale) return;
    this.renderer.render(this.scene, this.camera);
    ++this.frames;
    this.stale = false;
  }
}
