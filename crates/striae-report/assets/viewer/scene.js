// The three-dimensional view: surfaces, arrows, cut and camera.

const dark = matchMedia("(prefers-color-scheme: dark)");
const INK = { edge: () => (dark.matches ? "#0c0f12" : "#27313a"), arrow: () => (dark.matches ? "#ffd27a" : "#1b2a38") };
const BODY_COLORS = ["#b7c3cd", "#cbbfae", "#b3c7b8", "#c7b6c6", "#c9c6a8", "#aebfd0"];
const RIGID_COLOR = "#a4adb4";
const MOST_ARROWS = 700;

class View {
  constructor(canvas) {
    this.canvas = canvas;
    this.renderer = new THREE.WebGLRenderer({ canvas, antialias: true, alpha: true });
    this.renderer.localClippingEnabled = true;
    this.scene = new THREE.Scene();
    this.camera = new THREE.PerspectiveCamera(28, 1, 0.01, 100);
    this.camera.up.set(0, 0, 1);
    this.controls = new THREE.OrbitControls(this.camera, canvas);
    this.controls.addEventListener("change", () => this.draw());
    this.scene.add(new THREE.HemisphereLight("#ffffff", "#c9ced4", 2.1));
    const lamp = new THREE.DirectionalLight("#ffffff", 1.3);
    lamp.position.set(0.4, 0.7, 1);
    this.camera.add(lamp);
    this.scene.add(this.camera);
    this.cut = new THREE.Plane(new THREE.Vector3(1, 0, 0), 0);
    this.parts = [];
    this.frames = 0;
    this.pending = false;
    this.map = null;
    new ResizeObserver(() => this.resized()).observe(canvas.parentElement);
    dark.addEventListener("change", () => this.recolored());
  }

  /** Reads the surfaces of all parts. */
  async load(heads) {
    for (const [at, head] of heads.entries()) {
      const part = { head, at, visible: true };
      const [triangles, edges, rest] = [await indices(head.triangles, 3), await indices(head.edges, 2), await reals(head.rest)];
      Object.assign(part, { rest, triangles, edges });
      part.follows = head.follows ? await indices(head.follows[1], 1) : null;
      part.color = head.kind === "body" ? BODY_COLORS[at % BODY_COLORS.length] : RIGID_COLOR;
      part.places = new THREE.BufferAttribute(new Float32Array(rest), 3);
      part.colors = new THREE.BufferAttribute(new Float32Array((rest.length / 3) * 2).fill(0.75), 2);
      const surface = new THREE.BufferGeometry();
      surface.setAttribute("position", part.places);
      surface.setAttribute("uv", part.colors);
      surface.setIndex(new THREE.BufferAttribute(triangles.slice(), 1));
      const contact = head.kind === "contact";
      part.material = new THREE.MeshLambertMaterial({
        flatShading: true, side: THREE.DoubleSide, polygonOffset: true,
        polygonOffsetFactor: contact ? 0 : 1, polygonOffsetUnits: contact ? 0 : 2,
      });
      part.mesh = new THREE.Mesh(surface, part.material);
      part.mesh.frustumCulled = false;
      part.mesh.userData.part = part;
      const lines = new THREE.BufferGeometry();
      lines.setAttribute("position", part.places);
      lines.setIndex(new THREE.BufferAttribute(edges.slice(), 1));
      part.ink = new THREE.LineBasicMaterial({ color: INK.edge(), transparent: true, opacity: 0.3 });
      part.lines = new THREE.LineSegments(lines, part.ink);
      part.lines.frustumCulled = false;
      this.scene.add(part.mesh, part.lines);
      this.parts.push(part);
    }
    await this.deform(0, 1);
    this.measure();
  }

  /** The box about the bodies and what contact needs of the rest. */
  measure() {
    const [low, high] = [[Infinity, Infinity, Infinity], [-Infinity, -Infinity, -Infinity]];
    const bodies = this.parts.filter((part) => part.head.kind === "body");
    for (const part of bodies.length ? bodies : this.parts) {
      const places = part.places.array;
      for (let at = 0; at < places.length; at++) {
        low[at % 3] = Math.min(low[at % 3], places[at]);
        high[at % 3] = Math.max(high[at % 3], places[at]);
      }
    }
    this.low = new THREE.Vector3(...low);
    this.high = new THREE.Vector3(...high);
    this.centre = this.low.clone().add(this.high).multiplyScalar(0.5);
    this.size = this.high.clone().sub(this.low).length() || 1;
    this.camera.near = this.size * 1e-3;
    this.camera.far = this.size * 100;
  }

  /** Area of a part at rest. */
  area(part) {
    const corners = part.triangles;
    const place = (corner) => new THREE.Vector3().fromArray(part.rest, 3 * corner);
    let area = 0;
    for (let at = 0; at < corners.length; at += 3) {
      const [a, b, c] = [0, 1, 2].map((next) => place(corners[at + next]));
      area += 0.5 * b.sub(a).cross(c.sub(a)).length();
    }
    return area;
  }

  /** Looks at the bodies from a direction. */
  lookFrom(direction) {
    const from = new THREE.Vector3(...direction).normalize();
    // Straight down or up, y points upwards on the screen.
    if (Math.abs(from.z) > 0.999) from.set(0, -1e-3 * Math.sign(from.z) || -1e-3, from.z).normalize();
    this.measure();
    const half = Math.tan((this.camera.fov * Math.PI) / 360) * Math.min(1, this.camera.aspect);
    const distance = (0.56 * this.size) / half;
    this.controls.target.copy(this.centre);
    this.camera.position.copy(this.centre).addScaledVector(from, distance);
    this.controls.update();
    this.draw();
  }

  /** Moves all points to where they are at a time, displacements magnified. */
  async deform(time, scale) {
    for (const part of this.parts.filter((part) => !part.follows)) {
      const moved = await components(part.head.fields[part.head.motion], time);
      const places = part.places.array;
      part.known = moved !== null;
      for (let at = 0; at < places.length; at++) {
        const way = moved ? moved[at % 3][(at - (at % 3)) / 3] : 0;
        places[at] = part.rest[at] + scale * (Number.isFinite(way) ? way : 0);
      }
      part.places.needsUpdate = true;
    }
    for (const part of this.parts.filter((part) => part.follows)) {
      const [own, body] = [part.places.array, this.parts[part.head.follows[0]].places.array];
      part.follows.forEach((node, at) => {
        for (let axis = 0; axis < 3; axis++) own[3 * at + axis] = body[3 * node + axis];
      });
      part.known = true;
      part.places.needsUpdate = true;
    }
  }

  /** Colours parts by values, one array a part or null. */
  color(values, colors, bands) {
    this.map?.dispose();
    this.map = colors ? colorTexture(colors, colors.bands ?? (bands ? BANDS : 0)) : null;
    for (const part of this.parts) {
      const own = values[part.at];
      part.values = own;
      part.colored = own !== null && own !== undefined;
      const uv = part.colors.array;
      for (let node = 0; node < uv.length / 2; node++) {
        const value = part.colored ? own[node] : NaN;
        const span = colors && colors.high > colors.low ? colors.high - colors.low : 1;
        const share = colors ? (value - colors.low) / span : 0;
        uv[2 * node] = Number.isFinite(share) ? Math.min(1, Math.max(0, share)) : 0;
        uv[2 * node + 1] = Number.isFinite(value) ? 0.25 : 0.75;
      }
      part.colors.needsUpdate = true;
    }
    this.recolored();
  }

  /** Leaves out where sides of pairs do not touch, by the pressures at their nodes; shows whole
   * sides if none of those that are shown touches, or there are no pressures. */
  restrict(pressures) {
    const touches = (part) => pressures[part.at]?.some((pressure) => pressure > 0);
    const restricted = this.parts.some((part) => part.visible && touches(part));
    for (const part of this.parts.filter((part) => part.head.kind === "contact")) {
      const pressed = restricted && pressures[part.at];
      const [triangles, edges] = pressed ? touching(part, pressed) : [part.triangles, part.edges];
      select(part.mesh.geometry, triangles);
      select(part.lines.geometry, edges);
    }
  }

  /** Materials after a change of colours, opacity or cut. */
  recolored() {
    const clipped = this.clipping ? [this.cut] : [];
    for (const part of this.parts) {
      const { head, material, mesh, lines, ink } = part;
      const solid = head.kind === "contact" || (part.colored && !this.contactColored) || this.opacity >= 1;
      material.map = part.colored ? this.map : null;
      material.color.set(part.colored ? "#ffffff" : part.color);
      material.transparent = !solid;
      material.opacity = solid ? 1 : this.opacity;
      material.depthWrite = solid;
      material.clippingPlanes = ink.clippingPlanes = clipped;
      material.needsUpdate = true;
      mesh.renderOrder = solid ? 0 : 2;
      ink.color.set(INK.edge());
      ink.opacity = solid ? 0.32 : 0.1;
      // A side of a pair is seen where it is coloured; otherwise its body is.
      mesh.visible = part.visible && part.known && (head.kind !== "contact" || part.colored);
      lines.visible = mesh.visible && this.edged && (head.kind !== "contact" || this.opacity < 1);
    }
    for (const group of this.arrows ?? []) {
      group.material.color.set(INK.arrow());
      group.material.clippingPlanes = clipped;
    }
    this.draw();
  }

  /** Arrows at nodes of parts: vectors by part, and the length of the longest. */
  drawArrows(vectors, size) {
    for (const group of this.arrows ?? []) {
      this.scene.remove(group);
      group.dispose();
    }
    this.arrows = [];
    let longest = 0;
    for (const own of vectors) {
      for (let node = 0; own && node < own[0].length; node++) {
        const length = Math.hypot(own[0][node], own[1][node], own[2][node]);
        if (length > longest) longest = length;
      }
    }
    if (!(longest > 0)) return this.draw();
    const long = size * 0.07 * this.size;
    const matrices = [];
    for (const part of this.parts.filter((part) => vectors[part.at] && part.visible)) {
      matrices.push(...this.arrowsOf(part, vectors[part.at], long / longest, longest));
    }
    const material = new THREE.MeshLambertMaterial({ color: INK.arrow() });
    for (const shape of arrowShapes()) {
      const group = new THREE.InstancedMesh(shape, material, matrices.length);
      matrices.forEach((matrix, at) => group.setMatrixAt(at, matrix));
      group.frustumCulled = false;
      group.renderOrder = 1;
      this.arrows.push(group);
      this.scene.add(group);
    }
    this.recolored();
  }

  arrowsOf(part, vectors, scale, longest) {
    const places = part.places.array;
    const [turn, up, along, at] = [new THREE.Quaternion(), new THREE.Vector3(0, 0, 1), new THREE.Vector3(), new THREE.Vector3()];
    const matrices = [];
    for (const node of this.spread(part)) {
      along.set(vectors[0][node], vectors[1][node], vectors[2][node]);
      const length = along.length();
      if (!(length > 0.004 * longest)) continue;
      turn.setFromUnitVectors(up, along.clone().divideScalar(length));
      at.fromArray(places, 3 * node);
      const long = length * scale;
      // Short arrows keep some of their width, so that they are seen.
      const wide = Math.sqrt(length / longest) * longest * scale;
      matrices.push(new THREE.Matrix4().compose(at, turn, new THREE.Vector3(wide, wide, long)));
    }
    return matrices;
  }

  /** Nodes of a part, thinned to what an eye can tell apart. */
  spread(part) {
    if (part.spread) return part.spread;
    const count = part.rest.length / 3;
    let nodes = Array.from({ length: count }, (_, at) => at);
    for (let cell = this.size / 60; nodes.length > MOST_ARROWS; cell *= 1.25) {
      const taken = new Set();
      nodes = nodes.filter((node) => {
        const key = [0, 1, 2].map((axis) => Math.floor(part.rest[3 * node + axis] / cell)).join();
        return !taken.has(key) && taken.add(key);
      });
    }
    return (part.spread = nodes);
  }

  /** What lies under a place of the canvas: part, point and value. */
  under(x, y) {
    const box = this.canvas.getBoundingClientRect();
    const place = new THREE.Vector2(((x - box.left) / box.width) * 2 - 1, 1 - ((y - box.top) / box.height) * 2);
    const ray = new THREE.Raycaster();
    ray.setFromCamera(place, this.camera);
    const shownParts = this.parts.filter((part) => part.mesh.visible && (part.colored || part.material.opacity === 1));
    shownParts.forEach((part) => {
      part.mesh.geometry.boundingSphere = new THREE.Sphere(this.centre, this.size * 10);
    });
    const hits = ray.intersectObjects(shownParts.map((part) => part.mesh), false);
    const hit = hits.find((hit) => !this.clipping || this.cut.distanceToPoint(hit.point) >= 0);
    if (!hit) return null;
    const part = hit.object.userData.part;
    const corners = [hit.face.a, hit.face.b, hit.face.c];
    const far = (node) => new THREE.Vector3().fromArray(part.places.array, 3 * node).distanceTo(hit.point);
    const node = corners.reduce((best, other) => (far(other) < far(best) ? other : best));
    return { part, node, at: [...part.places.array.subarray(3 * node, 3 * node + 3)] };
  }

  resized() {
    const { clientWidth: width, clientHeight: height } = this.canvas.parentElement;
    this.renderer.setPixelRatio(Math.min(devicePixelRatio, 2));
    this.renderer.setSize(width, height, false);
    this.camera.aspect = width / height;
    this.camera.updateProjectionMatrix();
    this.draw();
  }

  draw() {
    if (this.pending) return;
    this.pending = true;
    requestAnimationFrame(() => {
      this.pending = false;
      this.now();
    });
  }

  now() {
    this.renderer.render(this.scene, this.camera);
    drawTriad(this.camera);
    this.canvas.dataset.frames = ++this.frames;
  }
}

/** Triangles of a part of which a corner is pressed, and the edges between their corners. */
function touching({ triangles, edges }, pressed) {
  const groups = (entries, size, keeps) => {
    const kept = [];
    for (let at = 0; at < entries.length; at += size) {
      const group = entries.subarray(at, at + size);
      if (keeps(group)) kept.push(...group);
    }
    return kept;
  };
  const kept = groups(triangles, 3, (corners) => corners.some((node) => pressed[node] > 0));
  const nodes = new Set(kept);
  return [kept, groups(edges, 2, (ends) => ends.every((node) => nodes.has(node)))];
}

/** Draws only some entries of the index of a geometry. */
function select(geometry, entries) {
  geometry.index.array.set(entries);
  geometry.index.needsUpdate = true;
  geometry.setDrawRange(0, entries.length);
}

let shapesOfArrow;

/** A shaft and a head along z, together of length 1. */
function arrowShapes() {
  if (!shapesOfArrow) {
    const shaft = new THREE.CylinderGeometry(0.03, 0.03, 0.68, 8).rotateX(Math.PI / 2).translate(0, 0, 0.34);
    const head = new THREE.ConeGeometry(0.1, 0.32, 12).rotateX(Math.PI / 2).translate(0, 0, 0.84);
    shapesOfArrow = [shaft, head];
  }
  return shapesOfArrow;
}

/** The coordinate axes as the camera sees them. */
function drawTriad(camera) {
  const axes = [["x", "#c4473a"], ["y", "#3f9150"], ["z", "#3a72c4"]].map(([name, color], axis) => {
    const e = new THREE.Vector3().setComponent(axis, 1).applyQuaternion(camera.quaternion.clone().invert());
    return { name, color, x: 37 + 25 * e.x, y: 37 - 25 * e.y, z: e.z };
  });
  axes.sort((a, b) => a.z - b.z);
  const drawn = axes.map(({ name, color, x, y }) => {
    const [tx, ty] = [37 + (x - 37) * 1.3, 37 + (y - 37) * 1.3 + 4];
    return `<line x1="37" y1="37" x2="${x}" y2="${y}" stroke="${color}" stroke-width="2.5" stroke-linecap="round"/>` +
      `<text x="${tx}" y="${ty}" fill="${color}" font-size="12" font-weight="600" text-anchor="middle">${name}</text>`;
  });
  byId("triad").innerHTML = `<svg viewBox="0 0 74 74" width="74" height="74">${drawn.join("")}</svg>`;
}
