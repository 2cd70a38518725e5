import * as three from 'three';

const materials = new Map();

function materialOf(color) {
  if (!materials.has(color)) materials.set(color, new three.MeshLambertMaterial({color}));
  return materials.get(color);
}

function geometryOf({type, size}) {
  if (type === 'box') return new three.BoxBufferGeometry(2 * size[0], 2 * size[1], 2 * size[2]);
  if (type === 'sphere') return new three.SphereBufferGeometry(size[0], 24, 16);
  // three.js has cylinders along y, the data along z.
  return new three.CylinderBufferGeometry(size[0], size[0], 2 * size[1], 40).rotateX(Math.PI / 2);
}

export function setPose(object, [x, y, z, w, i, j, k]) {
  object.position.set(x, y, z);
  object.quaternion.set(i, j, k, w);
}

// The floor is a square of a few metres with a grid; beyond it there is nothing.
function floorOf() {
  const floor = new three.Group();
  const ground = new three.Mesh(
      new three.PlaneBufferGeometry(6, 6), new three.MeshBasicMaterial({color: '#e6e9ec'}));
  const grid = new three.GridHelper(6, 24, '#c4cad0', '#d4d9de');
  grid.rotation.x = Math.PI / 2;
  grid.position.z = 1e-3;
  floor.add(ground, grid);
  return floor;
}

function objectOf(shape) {
  const object = shape.type === 'plane' ?
      floorOf() :
      new three.Mesh(geometryOf(shape), materialOf(shape.color));
  setPose(object, shape.pose);
  return object;
}

// Returns the edges of a part as lines.
export function edgesOf(part, color, opacity) {
  const geometry = new three.BufferGeometry();
  geometry.setAttribute('position', new three.Float32BufferAttribute(part.edges.flat(2), 3));
  const material = new three.LineBasicMaterial(
      {color: new three.Color(color), transparent: opacity < 1, opacity});
  return new three.LineSegments(geometry, material);
}

// The bodies at their true poses. Bodies that have collided, or that a sentence names, have the
// colour of what is wrong.
export class Stage {
  constructor(data, recording) {
    this.recording = recording;
    this.collisions = data.collisions;
    this.wrong = materialOf(data.colors.violated);
    this.named = [];
    this.names = data.bodies.map((body) => body.name);
    this.root = new three.Group();
    this.bodies = data.bodies.map((body) => {
      const group = new three.Group();
      group.add(...body.shapes.map(objectOf));
      this.root.add(group);
      return group;
    });
    this.materials = this.bodies.map((group) => group.children.map((object) => object.material));
    this.marked = this.bodies.map(() => false);
    for (const part of data.parts) {
      const body = data.bodies.findIndex((other) => other.name === part.body);
      this.bodies[body].add(edgesOf(part, data.colors.observed, 0.45));
    }
  }

  show(moment, time) {
    this.recording.bodies.forEach((track, i) => {
      if (track) this.recording.place(track, moment, this.bodies[i]);
    });
    const collided = this.collisions.filter((collision) => collision.time <= time);
    const wrong = [...collided.flatMap(({bodies}) => bodies), ...this.named];
    this.names.forEach((name, i) => this.markBody(i, wrong.includes(name)));
  }

  mark(names) {
    this.named = names;
  }

  markBody(index, isWrong) {
    if (this.marked[index] === isWrong) return;
    this.marked[index] = isWrong;
    this.materials[index].forEach((own, i) => {
      if (own) this.bodies[index].children[i].material = isWrong ? this.wrong : own;
    });
  }
}
