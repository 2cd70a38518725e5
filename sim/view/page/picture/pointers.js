import * as three from 'three';

const LEAST = 0.03;  // metres: the least side of the box that the camera looks at

// Lines that point to the place where a condition is decided. They are drawn over what hides them.
export class Pointers {
  constructor(data) {
    this.color = new three.Color(data.colors.violated);
    this.root = new three.Group();
  }

  // Each line has two ends in the world frame.
  show(lines) {
    this.root.remove(...this.root.children);
    this.ends = lines.flat().map((end) => new three.Vector3(...end));
    if (this.ends.length === 0) return;
    const geometry = new three.BufferGeometry().setFromPoints(this.ends);
    const look = {color: this.color, depthTest: false, transparent: true};
    const drawn = [
      new three.LineSegments(geometry, new three.LineBasicMaterial(look)),
      new three.Points(
          geometry, new three.PointsMaterial({...look, size: 5, sizeAttenuation: false})),
    ];
    for (const object of drawn) object.renderOrder = 2;
    this.root.add(...drawn);
  }

  // Returns a box around the lines; null if there are none.
  box() {
    if (this.root.children.length === 0) return null;
    const box = new three.Box3().setFromPoints(this.ends);
    const short = Math.max(0, LEAST - box.getSize(new three.Vector3()).length());
    return box.expandByScalar(short / 2);
  }
}
