import * as three from 'three';

import {element} from '../dom.js';

import {Outlines} from './outlines.js';
import {Stage} from './stage.js';

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

// The bodies and outlines of one execution at one time.
export class Picture {
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
  }

  show(time) {
    const moment = this.recording.momentAt(time);
    this.stage.show(moment, time);
    this.outlines.show(moment, time);
  }

  // Returns the width over the height; 0 if the picture is not shown.
  resize() {
    const {clientWidth, clientHeight} = this.surface;
    if (clientWidth === 0 || clientHeight === 0) return 0;
    this.renderer.setSize(clientWidth, clientHeight, false);
    return clientWidth / clientHeight;
  }

  draw(camera) {
    this.renderer.render(this.scene, camera);
  }
}
