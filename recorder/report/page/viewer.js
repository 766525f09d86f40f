// A stage seen through an orbiting camera.
import * as THREE from 'three';
import { OrbitControls } from 'three/addons/controls/OrbitControls.js';
import { oncePerPicture } from './once_per_picture.js';

/** Camera offsets from the target (m). The pedestrian faces +x, the car travels along +y. */
const kViews = { oblique: [-3.4, 2.6, 1.7], posterior: [-5, 0.001, 0], superior: [-0.001, 0, 5] };

export function hasWebGl() {
  return Boolean(document.createElement('canvas').getContext('webgl2'));
}

export class Viewer {
  constructor(canvas, stage) {
    this.canvas = canvas;
    this.stage = stage;
    this.renderer = new THREE.WebGLRenderer({ canvas, antialias: true });
    this.renderer.setPixelRatio(Math.min(2, devicePixelRatio));
    this.draw = oncePerPicture(() => this.renderer.render(this.stage.scene, this.camera));
    this.camera = new THREE.PerspectiveCamera(36, 1, 0.05, 60);
    this.camera.up.set(0, 0, 1);
    this.orbit = new OrbitControls(this.camera, canvas);
    this.orbit.addEventListener('change', () => this.draw());
    new ResizeObserver(() => this.resize()).observe(canvas);
    this.resize();
  }

  resize() {
    const { clientWidth, clientHeight } = this.canvas;
    this.renderer.setSize(clientWidth, clientHeight, false);
    this.camera.aspect = clientWidth / Math.max(1, clientHeight);
    this.camera.updateProjectionMatrix();
    this.draw();
  }

  /** A standard view of the point y (m) along the car's travel. */
  look(name, y) {
    this.orbit.target.set(0, y, 0.9);
    this.camera.position.copy(this.orbit.target).add(new THREE.Vector3(...kViews[name]));
    this.orbit.update();
    this.draw();
  }

  /** Moves camera and target together. */
  shift(offset) {
    this.camera.position.add(offset);
    this.orbit.target.add(offset);
    this.orbit.update();
  }
}
