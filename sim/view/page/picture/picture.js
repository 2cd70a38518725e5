import * as three from 'three';

import {element} from '../dom.js';

import {ContactMarks} from './contact_marks.js';
import {Ghosts} from './ghosts.js';
import {Outlines} from './outlines.js';
import {Pointers} from './pointers.js';
import {Stage} from './stage.js';

const GROUND = '#f3f5f7';

function lights() {
  const sun = new three.DirectionalLight('#ffffff', 0.46);
  sun.position.set(1.2, -1.6, 2.6);
  const fill = new three.DirectionalLight('#ffffff', 0.18);
  fill.position.set(-1.5, 1.2, 1);
  return [new three.AmbientLight('#ffffff', 0.56), sun, fill];
}

const newSurface = () =>
    element('canvas', {'aria-label': 'Scene in three dimensions', role: 'img'});

function drawsInSoftware(context) {
  const names = context.getExtension('WEBGL_debug_renderer_info');
  return names !== null &&
      /swiftshader|llvmpipe|software/i.test(context.getParameter(names.UNMASKED_RENDERER_WEBGL));
}

// Without a graphics card, smooth edges and fine pixels would take most of the time of each frame.
// A first context tells whether there is a card. Without a card, the picture is drawn by this first
// context, because making another context takes time.
function newRenderer() {
  const canvas = newSurface();
  const context = canvas.getContext('webgl', {antialias: false, alpha: false, stencil: false});
  if (context && drawsInSoftware(context)) return new three.WebGLRenderer({canvas, context});
  const renderer = new three.WebGLRenderer({canvas: newSurface(), antialias: true});
  renderer.setPixelRatio(Math.min(2, window.devicePixelRatio));
  return renderer;
}

// The bodies and outlines of one execution at one time.
export class Picture {
  constructor(data, recording) {
    this.recording = recording;
    this.stage = new Stage(data, recording);
    this.outlines = new Outlines(data, recording);
    this.contacts = new ContactMarks(data, this.stage);
    this.ghosts = new Ghosts(data);
    this.pointers = new Pointers(data);
    this.scene = new three.Scene();
    this.scene.background = new three.Color(GROUND);
    this.scene.add(
        this.stage.root, this.outlines.root, this.contacts.root, this.ghosts.root,
        this.pointers.root, ...lights());
    this.renderer = newRenderer();
    this.surface = this.renderer.domElement;
  }

  show(time) {
    const moment = this.recording.momentAt(time);
    this.stage.show(moment, time);
    this.outlines.show(moment, time);
    this.contacts.show(moment);
  }

  // Shows or hides the ghosts of believed poses ("showsBelieved"), the error sets ("showsSets"), or
  // the contacts ("showsContacts"). Returns whether they are shown now.
  toggle(kind) {
    if (kind !== 'showsContacts') return (this.outlines[kind] = !this.outlines[kind]);
    return (this.contacts.root.visible = !this.contacts.root.visible);
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
