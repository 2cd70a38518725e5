import * as three from 'three';

import {plainName} from '../steps/names.js';
import {ContactPoints} from '../time/contact_points.js';
import {numberText} from '../units.js';

export const TOUCHING = '#00797f';

const LONGEST = 0.08;  // metres: the usual greatest length of an arrow
const NORMAL = 0.012;  // metres
const NEAR = 12;       // pixels within which the pointer finds a point
const SHAFT = 0.0008;  // metres: radius
const HEAD = 0.0026;   // metres: radius; the length is three times this
const UP = new three.Vector3(0, 1, 0);

// Returns the newtons that a centimetre of an arrow stands for: 1, 2 or 5 times a power of ten.
function scaleFor(force) {
  const least = Math.max(1e-3, force / (100 * LONGEST));
  const power = 10 ** Math.floor(Math.log10(least));
  return power * [1, 2, 5, 10].find((step) => step * power >= least);
}

function inFront(object) {
  object.frustumCulled = false;
  object.renderOrder = 1;
  return object;
}

// Where bodies touch: points, normals, and forces as arrows whose lengths are to scale. They are
// drawn over what hides them.
export class ContactMarks {
  constructor(data, stage) {
    this.points = new ContactPoints(data);
    this.stage = stage;
    this.exist = this.points.pairs.length > 0;
    this.perCentimetre = scaleFor(this.points.usualMost());
    this.marks = [];
    this.root = new three.Group();
    if (this.exist) this.addObjects();
  }

  addObjects() {
    const most = this.points.pairs.reduce((sum, {points}) => sum + points.length, 0);
    const look = {color: TOUCHING, depthTest: false, transparent: true};
    const buffer = (vertices) => {
      const geometry = new three.BufferGeometry();
      const numbers = new Float32Array(3 * vertices);
      geometry.setAttribute('position', new three.BufferAttribute(numbers, 3));
      return geometry;
    };
    const arrows = (geometry) =>
        inFront(new three.InstancedMesh(geometry, new three.MeshBasicMaterial(look), most));
    this.dots = inFront(new three.Points(
        buffer(most), new three.PointsMaterial({...look, size: 5, sizeAttenuation: false})));
    this.normals = inFront(new three.LineSegments(
        buffer(2 * most), new three.LineBasicMaterial({...look, opacity: 0.6})));
    // The shaft and the head of an arrow begin at the origin and point along y.
    this.shafts = arrows(new three.CylinderBufferGeometry(1, 1, 1, 5).translate(0, 0.5, 0));
    this.heads = arrows(new three.ConeBufferGeometry(1, 1, 8).translate(0, 0.5, 0));
    this.root.add(this.dots, this.normals, this.shafts, this.heads);
  }

  show(moment) {
    if (!this.exist) return;
    this.marks = this.points.pairs.flatMap((pair) => this.marksOf(pair, moment.index));
    this.placeDots();
    this.marks.forEach((mark, i) => this.placeArrow(mark, i));
    for (const mesh of [this.shafts, this.heads]) {
      mesh.count = this.marks.length;
      mesh.instanceMatrix.needsUpdate = true;
    }
  }

  // Points move along with the first body of their pair.
  marksOf(pair, index) {
    const body = this.stage.bodies[pair.frame];
    const turn = body ? body.quaternion : new three.Quaternion();
    return this.points.at(pair, index).map(({position, normal, force}) => {
      const at = new three.Vector3(...position).applyQuaternion(turn);
      if (body) at.add(body.position);
      return {
        pair,
        at,
        normal: new three.Vector3(...normal).applyQuaternion(turn),
        force: new three.Vector3(...force).applyQuaternion(turn),
      };
    });
  }

  placeDots() {
    const [dots, ends] = [this.dots, this.normals].map((object) => object.geometry);
    this.marks.forEach(({at, normal}, i) => {
      const tip = at.clone().addScaledVector(normal, NORMAL);
      at.toArray(dots.attributes.position.array, 3 * i);
      at.toArray(ends.attributes.position.array, 6 * i);
      tip.toArray(ends.attributes.position.array, 6 * i + 3);
    });
    dots.setDrawRange(0, this.marks.length);
    ends.setDrawRange(0, 2 * this.marks.length);
    for (const geometry of [dots, ends]) geometry.attributes.position.needsUpdate = true;
  }

  placeArrow({at, force}, i) {
    const length = force.length() / (100 * this.perCentimetre);
    const head = Math.min(3 * HEAD, length / 2);
    const along = force.clone().normalize();
    const turn = new three.Quaternion().setFromUnitVectors(UP, along);
    const matrix = new three.Matrix4();
    const shaft = new three.Vector3(SHAFT, length - head, SHAFT);
    this.shafts.setMatrixAt(i, matrix.compose(at, turn, shaft));
    const neck = at.clone().addScaledVector(along, length - head);
    const cone = new three.Vector3(head / 3, head, head / 3);
    this.heads.setMatrixAt(i, matrix.compose(neck, turn, cone));
  }

  // Says what touches at a place of the picture, in pixels, and with which force; empty if nothing
  // does.
  textAt(x, y, camera, {clientWidth, clientHeight}) {
    if (!this.root.visible) return '';
    const away = this.marks.map(({at}) => {
      const seen = at.clone().project(camera);
      return Math.hypot(
          ((seen.x + 1) / 2) * clientWidth - x, ((1 - seen.y) / 2) * clientHeight - y);
    });
    const nearest = away.indexOf(Math.min(...away));
    return away[nearest] <= NEAR ? this.textOf(this.marks[nearest]) : '';
  }

  textOf({pair, normal, force}) {
    const [on, by] = (pair.isTurned ? pair.names : [...pair.names].reverse()).map(plainName);
    const along = force.dot(normal);
    const across = Math.sqrt(Math.max(0, force.lengthSq() - along * along));
    const newtons = (value) => `${numberText(value, 3)}\u202fN`;
    return `force on ${on} from ${by === 'world' ? 'the table' : by}: ${newtons(force.length())} (${
        newtons(along)} along the normal, ${newtons(across)} across)`;
  }
}
