// The 3-D stage: shapes of a scene and their placing at a frame. Frame W: x pedestrian's front,
// y car travel, z up.
import * as THREE from 'three';
import { floats, integers } from './bytes.js';

// As in the still pictures.
const kGold = 0xe29e2c;
const kBlue = 0x2662a8;
const kCar = 0xcbd0d5;
const kGlass = 0xcdecfa;

const material = (color, more = {}) => new THREE.MeshLambertMaterial({ color, ...more });

function ellipsoid(shape) {
  const mesh = new THREE.Mesh(new THREE.SphereGeometry(1, 32, 20), material(kGold));
  mesh.scale.set(...shape.semi_axes);
  mesh.position.set(...shape.p);
  const [w, x, y, z] = shape.q;
  mesh.quaternion.set(x, y, z, w);
  return mesh;
}

function surface(head) {
  const geometry = new THREE.BufferGeometry();
  geometry.setAttribute('position', new THREE.BufferAttribute(floats(head.vertices), 3));
  geometry.setIndex(new THREE.BufferAttribute(integers(head.triangles), 1));
  geometry.computeVertexNormals();
  return new THREE.Mesh(geometry, material(kBlue, { side: THREE.DoubleSide }));
}

/** One facet of the car front, extruded across the car. */
function panel(facet) {
  const [y0, z0] = facet.begin;
  const [y1, z1] = facet.end;
  const w = facet.half_width;
  const geometry = new THREE.BufferGeometry();
  geometry.setAttribute('position', new THREE.Float32BufferAttribute(
    [-w, y0, z0, w, y0, z0, w, y1, z1, -w, y1, z1], 3));
  geometry.setIndex([0, 1, 2, 0, 2, 3]);
  geometry.computeVertexNormals();
  const isGlass = facet.component.includes('wind');
  const group = new THREE.Group();
  group.add(new THREE.Mesh(geometry, material(isGlass ? kGlass : kCar, {
    side: THREE.DoubleSide, transparent: isGlass, opacity: isGlass ? 0.55 : 1 })));
  group.add(new THREE.LineSegments(new THREE.EdgesGeometry(geometry),
                                   new THREE.LineBasicMaterial({ color: 0x50565c })));
  return group;
}

function ground() {
  const grid = new THREE.GridHelper(12, 24, 0x9aa3ab, 0xd5dae0);
  grid.rotation.x = Math.PI / 2;
  return grid;
}

export class Stage {
  constructor(data) {
    this.scene = new THREE.Scene();
    this.scene.background = new THREE.Color(0xffffff);
    this.scene.add(new THREE.HemisphereLight(0xffffff, 0x9aa3ab, 2.2));
    const sun = new THREE.DirectionalLight(0xffffff, 1.6);
    sun.position.set(-3, -2, 5);
    this.scene.add(sun, ground());
    this.bodies = data.bodies.map(() => new THREE.Group());
    data.ellipsoids.forEach((shape) => this.bodies[shape.body].add(ellipsoid(shape)));
    this.head = new THREE.Group();
    if (data.head) this.head.add(surface(data.head));
    this.car = new THREE.Group();
    data.facets.forEach((facet) => this.car.add(panel(facet)));
    this.movers = [...this.bodies, this.head, this.car];
    this.scene.add(...this.movers);
    this.frames = floats(data.frames);
    this.stride = 1 + 7 * this.movers.length;
    this.count = Math.floor(this.frames.length / this.stride);
    this.headIndex = data.head ? this.bodies.length : Math.max(0, data.bodies.indexOf('head'));
  }

  /** More frames, as in the scene's block. */
  append(more) {
    const all = new Float32Array(this.frames.length + more.length);
    all.set(this.frames);
    all.set(more, this.frames.length);
    this.frames = all;
    this.count = Math.floor(all.length / this.stride);
  }

  headAt(t) {
    this.place(t);
    return this.headPosition.clone();
  }

  time(i) { return this.frames[i * this.stride]; }
  get begin() { return this.time(0); }
  get end() { return this.time(this.count - 1); }
  get headPosition() { return this.movers[this.headIndex].position; }

  /** Poses at t (s), between frames by straight lines and shortest turns. */
  place(t) {
    let low = 0;
    let high = this.count - 1;
    while (high - low > 1) {
      const middle = (low + high) >> 1;
      if (this.time(middle) <= t) low = middle; else high = middle;
    }
    const span = this.time(high) - this.time(low);
    const f = span > 0 ? Math.min(1, Math.max(0, (t - this.time(low)) / span)) : 0;
    const q = new THREE.Quaternion();
    const p = new THREE.Vector3();
    this.movers.forEach((mover, k) => {
      const a = low * this.stride + 1 + 7 * k;
      const b = high * this.stride + 1 + 7 * k;
      const v = this.frames;
      mover.position.set(v[a], v[a + 1], v[a + 2]).lerp(p.set(v[b], v[b + 1], v[b + 2]), f);
      mover.quaternion.set(v[a + 4], v[a + 5], v[a + 6], v[a + 3])
        .slerp(q.set(v[b + 4], v[b + 5], v[b + 6], v[b + 3]), f);
    });
  }
}
