import * as three from 'three';

// The colours are at the vertices.
const PAINTED = new three.MeshLambertMaterial({vertexColors: three.VertexColors});

// Each facet has corners of its own, so that light shows its edges.
function hullOf({vertices, facets}) {
  const positions = [];
  const triangles = [];
  for (const facet of facets) {
    const first = positions.length / 3;
    for (const vertex of facet) positions.push(...vertices[vertex]);
    for (let i = 2; i < facet.length; ++i) triangles.push(first, first + i - 1, first + i);
  }
  const geometry = new three.BufferGeometry();
  geometry.setAttribute('position', new three.Float32BufferAttribute(positions, 3));
  geometry.setIndex(triangles);
  geometry.computeVertexNormals();
  return geometry;
}

function geometryOf(shape) {
  const {type, size} = shape;
  if (type === 'hull') return hullOf(shape);
  if (type === 'box') return new three.BoxBufferGeometry(2 * size[0], 2 * size[1], 2 * size[2]);
  if (type === 'sphere') return new three.SphereBufferGeometry(size[0], 16, 12);
  // three.js has cylinders along y, the data along z.
  return new three.CylinderBufferGeometry(size[0], size[0], 2 * size[1], 24).rotateX(Math.PI / 2);
}

export function setPose(object, [x, y, z, w, i, j, k]) {
  object.position.set(x, y, z);
  object.quaternion.set(i, j, k, w);
}

function matrixOf(pose) {
  const frame = new three.Object3D();
  setPose(frame, pose);
  frame.updateMatrix();
  return frame.matrix;
}

// The floor is a square of a few metres with a grid; beyond it there is nothing.
function floorOf(shape) {
  const floor = new three.Group();
  const ground = new three.Mesh(
      new three.PlaneBufferGeometry(6, 6), new three.MeshBasicMaterial({color: '#e6e9ec'}));
  const grid = new three.GridHelper(6, 24, '#c4cad0', '#d4d9de');
  grid.rotation.x = Math.PI / 2;
  grid.position.z = 1e-3;
  floor.add(ground, grid);
  setPose(floor, shape.pose);
  return floor;
}

// Returns a shape in the frame of its body, with a colour at each vertex.
function paintedOf(shape) {
  const geometry = geometryOf(shape).applyMatrix(matrixOf(shape.pose));
  const color = new three.Color(shape.color).toArray();
  const colors = geometry.attributes.position.array.map((_, i) => color[i % 3]);
  return geometry.setAttribute('color', new three.BufferAttribute(colors, 3));
}

// Returns shapes as one mesh, which is drawn by one call. Planes are left out.
export function meshOf(shapes, material) {
  const merged = new three.BufferGeometry();
  const corners = [];
  const numbers = {position: [], normal: [], color: []};
  for (const {index, attributes} of shapes.filter(({type}) => type !== 'plane').map(paintedOf)) {
    const first = numbers.position.length / 3;
    for (const corner of index.array) corners.push(first + corner);
    for (const name of Object.keys(numbers)) numbers[name].push(...attributes[name].array);
  }
  for (const [name, values] of Object.entries(numbers)) {
    merged.setAttribute(name, new three.Float32BufferAttribute(values, 3));
  }
  merged.setIndex(corners);
  return new three.Mesh(merged, material);
}

const AT_ORIGIN = [0, 0, 0, 1, 0, 0, 0];

// Returns the edges of a part at several poses as lines, which are drawn by one call.
export function edgesOf(part, color, opacity, poses = [AT_ORIGIN]) {
  const ends = poses.flatMap((pose) => {
    const matrix = matrixOf(pose);
    return part.edges.flat().flatMap(
        (end) => new three.Vector3(...end).applyMatrix4(matrix).toArray());
  });
  const geometry = new three.BufferGeometry();
  geometry.setAttribute('position', new three.Float32BufferAttribute(ends, 3));
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
    this.wrong = new three.MeshLambertMaterial({color: data.colors.violated});
    this.named = [];
    this.names = data.bodies.map((body) => body.name);
    this.root = new three.Group();
    this.meshes = data.bodies.map((body) => meshOf(body.shapes, PAINTED));
    this.bodies = data.bodies.map((body, i) => {
      const group = new three.Group();
      const planes = body.shapes.filter(({type}) => type === 'plane');
      group.add(this.meshes[i], ...planes.map(floorOf));
      this.root.add(group);
      return group;
    });
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
    this.names.forEach((name, i) => {
      this.meshes[i].material = wrong.includes(name) ? this.wrong : PAINTED;
    });
  }

  mark(names) {
    this.named = names;
  }
}
