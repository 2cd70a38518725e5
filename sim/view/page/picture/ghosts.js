import * as three from 'three';

import {edgesOf, meshOf, setPose} from './stage.js';

// Translucent bodies in the situation that a reason is about. In this situation a constraint fails,
// or a way of the arm is not proved. Bodies that collide there have the colour of what is wrong.
export class Ghosts {
  constructor(data) {
    this.data = data;
    this.root = new three.Group();
    const translucent = (color) =>
        new three.MeshLambertMaterial({color, transparent: true, opacity: 0.5});
    this.usual = translucent(data.colors.inconclusive);
    this.wrong = translucent(data.colors.violated);
  }

  show(ghosts, marked) {
    this.root.remove(...this.root.children);
    for (const {body, pose} of ghosts) this.root.add(this.ghostOf(body, pose, marked));
  }

  ghostOf(name, pose, marked) {
    const {bodies, parts, colors} = this.data;
    const isWrong = marked.includes(name);
    const ghost = new three.Group();
    const {shapes} = bodies.find((body) => body.name === name);
    ghost.add(meshOf(shapes, isWrong ? this.wrong : this.usual));
    const part = parts.find((other) => other.body === name);
    if (part) ghost.add(edgesOf(part, isWrong ? colors.violated : colors.inconclusive, 1));
    setPose(ghost, pose);
    return ghost;
  }

  // Returns the box around all ghosts; null if there is none.
  box() {
    return this.root.children.length > 0 ? new three.Box3().setFromObject(this.root) : null;
  }
}
