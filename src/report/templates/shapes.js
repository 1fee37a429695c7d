// Shows mode shapes in space: unpacks the data beside each figure, draws them by three.js, which the page carries too.
// Without WebGL the still pictures stay. No network.
(() => {
  "use strict";

  async function inflate(text) {
    const packed = atob(text);
    const bytes = new Uint8Array(packed.length);
    for (let k = 0; k < bytes.length; k += 1) bytes[k] = packed.charCodeAt(k);
    const stream = new Blob([bytes]).stream().pipeThrough(new DecompressionStream("deflate"));
    return new Uint8Array(await new Response(stream).arrayBuffer());
  }

  // Differences to the number `stride` places before, folded to positive ones, bytes of equal weight together.
  async function numbers(text, stride) {
    const bytes = await inflate(text);
    const count = bytes.length / 4;
    const values = new Int32Array(count);
    for (let k = 0; k < count; k += 1) {
      const folded = bytes[k] | (bytes[count + k] << 8) | (bytes[2 * count + k] << 16) | (bytes[3 * count + k] << 24);
      values[k] = ((folded >>> 1) ^ -(folded & 1)) + (k < stride ? 0 : values[k - stride]);
    }
    return values;
  }

  // A wheel that is scrolling the page past a view goes on scrolling.
  let scrolledAt = -1000;
  addEventListener("scroll", () => { scrolledAt = performance.now(); }, { passive: true });

  let library = null;
  function three() {
    library ??= inflate(document.getElementById("three").textContent).then((code) => {
      const address = URL.createObjectURL(new Blob([code], { type: "text/javascript" }));
      return import(address).finally(() => URL.revokeObjectURL(address));
    });
    return library;
  }

  const SURFACE = {
    vertexShader: `
      attribute vec3 shape; uniform float amount; varying vec3 seen; varying float far;
      void main() {
        vec4 place = modelViewMatrix * vec4(position + amount * shape, 1.0);
        seen = place.xyz; far = length(shape); gl_Position = projectionMatrix * place;
      }`,
    // Faces are lit as they stand, deformed, by the derivative of their place.
    fragmentShader: `
      uniform sampler2D colours; uniform vec3 plain; uniform float coloured; varying vec3 seen; varying float far;
      void main() {
        vec3 normal = normalize(cross(dFdx(seen), dFdy(seen)));
        vec3 colour = mix(plain, texture2D(colours, vec2(far * 0.9375 + 0.03125, 0.5)).rgb, coloured);
        gl_FragColor = vec4(colour * (0.66 + 0.34 * max(0.0, dot(normal, vec3(0.32, 0.55, 0.77)))), 1.0);
      }`,
  };
  const LINES = {
    vertexShader: `
      attribute vec3 shape; uniform float amount;
      void main() { gl_Position = projectionMatrix * modelViewMatrix * vec4(position + amount * shape, 1.0); }`,
    fragmentShader: "uniform vec4 plain; void main() { gl_FragColor = plain; }",
  };
  // A line as wide as wanted: both sides of each piece, moved apart on the screen.
  const RIBBON = {
    vertexShader: `
      attribute vec3 shape, other, otherShape; attribute float side;
      uniform float amount, width; uniform vec2 pixels;
      void main() {
        // A little in front of the surface on which it lies.
        vec4 near = vec4(0.0, 0.0, 0.004, 0.0);
        vec4 a = projectionMatrix * (modelViewMatrix * vec4(position + amount * shape, 1.0) + near);
        vec4 b = projectionMatrix * (modelViewMatrix * vec4(other + amount * otherShape, 1.0) + near);
        vec2 along = normalize((b.xy / b.w - a.xy / a.w) * pixels + 1e-9);
        a.xy += (side * vec2(-along.y, along.x) - 0.4 * along) * width / pixels * a.w;
        gl_Position = a;
      }`,
    fragmentShader: LINES.fragmentShader,
  };

  class Shapes {
    constructor(figure, data, THREE, context) {
      Object.assign(this, { figure, data, THREE });
      this.canvas = figure.querySelector("canvas");
      this.renderer = new THREE.WebGLRenderer({ canvas: this.canvas, context, alpha: true });
      this.renderer.setClearColor(0, 0);
      this.scene = new THREE.Scene();
      this.target = new THREE.Vector3();
      this.turn = new THREE.Quaternion();
      this.half = 1;
      this.cameras = [new THREE.OrthographicCamera(), new THREE.PerspectiveCamera(26)];
      this.amplitude = data.amplitude;
      this.speed = 0.7;
      this.phase = Math.PI / 2;
      this.playing = !matchMedia("(prefers-reduced-motion: reduce)").matches;
      this.inView = true;
      this.amount = { value: 0 };
      this.coloured = { value: 1 };
      this.pixels = { value: new THREE.Vector2(1, 1) };
    }

    find(selector) { return this.figure.querySelector(selector); }

    async build() {
      const { THREE, data } = this;
      const [points, triangles, edges, outline] = await Promise.all([
        numbers(data.points, 3), numbers(data.triangles, 3), numbers(data.edges, 2), numbers(data.outline, 2)]);
      const high = [0, 1, 2].map((k) => points.reduce((most, v, i) => (i % 3 === k && v > most ? v : most), 0));
      // The size of the structure is 1, its middle the origin.
      this.points = Float32Array.from(points, (v, i) => ((v - high[i % 3] / 2) * data.step) / data.size);
      const position = new THREE.BufferAttribute(this.points, 3);
      this.shape = new THREE.BufferAttribute(new Float32Array(points.length), 3);
      const geometry = (index) => {
        const part = new THREE.BufferGeometry();
        part.setAttribute("position", position);
        part.setAttribute("shape", this.shape);
        part.setIndex(new THREE.BufferAttribute(Uint32Array.from(index), 1));
        return part;
      };
      const add = (object) => {
        // The shader moves the points: what the library knows of their bounds is not what is seen.
        object.frustumCulled = false;
        this.scene.add(object);
        return object;
      };
      const rgb = (hex) => [1, 3, 5].map((k) => parseInt(hex.slice(k, k + 2), 16) / 255);
      const palette = Uint8Array.from(data.palette.flatMap((colour) => [...colour, 255]));
      const colours = new THREE.DataTexture(palette, data.palette.length, 1);
      Object.assign(colours, { magFilter: THREE.LinearFilter, minFilter: THREE.LinearFilter, needsUpdate: true });
      const { amount, coloured } = this;
      this.parts = data.starts.slice(1).map((end, group) => {
        const plain = { value: new THREE.Vector3(...rgb(data.legend[group].colour)) };
        const uniforms = { amount, coloured, plain, colours: { value: colours } };
        const offset = { polygonOffset: true, polygonOffsetFactor: 1, polygonOffsetUnits: 1 };
        const material = new THREE.ShaderMaterial({ ...SURFACE, uniforms, side: THREE.DoubleSide, ...offset });
        return add(new THREE.Mesh(geometry(triangles.subarray(3 * data.starts[group], 3 * end)), material));
      });
      const lines = (index, colour, moves) => {
        const uniforms = { amount: moves ? amount : { value: 0 }, plain: { value: new THREE.Vector4(...colour) } };
        return add(new THREE.LineSegments(geometry(index), new THREE.ShaderMaterial({ ...LINES, uniforms, transparent: true })));
      };
      // Close edges would make the faces dark: the shorter they are, the fainter.
      let length = 0;
      for (let k = 0; k < edges.length; k += 2) length += Math.hypot(...[0, 1, 2].map((i) => this.points[3 * edges[k] + i] - this.points[3 * edges[k + 1] + i]));
      const faint = Math.min(1, (80 * length) / edges.length);
      this.edges = [lines(edges, [0.1, 0.14, 0.18, 0.24 * faint], true), lines(outline, [0.1, 0.14, 0.18, 1], true)];
      this.ghost = lines(outline, [0.42, 0.48, 0.54, 0.75], false);
      this.ribbons = data.lines.map((line, k) => add(this.ribbon(line, rgb(data.legend[data.starts.length - 1 + k].colour))));
      this.parts.push(...this.ribbons);
      await this.select(0);
      this.wire();
      this.look(data.views[data.start].name);
    }

    ribbon(line, colour) {
      const { THREE } = this;
      const ends = line.points.map((a, k) => [a, line.points[(k + 1) % line.points.length]]);
      if (!line.closed) ends.pop();
      const geometry = new THREE.BufferGeometry();
      // Of each piece: both ends, each on both sides.
      const own = ends.flatMap(([a, b]) => [a, a, b, b]);
      const far = ends.flatMap(([a, b]) => [b, b, a, a]);
      const pick = (from, index) => new THREE.BufferAttribute(Float32Array.from(index.flatMap((k) => [...from.subarray(3 * k, 3 * k + 3)])), 3);
      const follow = () => {
        geometry.setAttribute("shape", pick(this.shape.array, own));
        geometry.setAttribute("otherShape", pick(this.shape.array, far));
      };
      geometry.setAttribute("position", pick(this.points, own));
      geometry.setAttribute("other", pick(this.points, far));
      geometry.setAttribute("side", new THREE.BufferAttribute(Float32Array.from(ends.flatMap(() => [1, -1, -1, 1])), 1));
      geometry.setIndex(ends.flatMap((_, k) => [0, 1, 2, 1, 3, 2].map((corner) => 4 * k + corner)));
      const uniforms = { amount: this.amount, width: { value: 2 }, pixels: this.pixels, plain: { value: new THREE.Vector4(...colour, 1) } };
      const mesh = new THREE.Mesh(geometry, new THREE.ShaderMaterial({ ...RIBBON, uniforms, side: THREE.DoubleSide }));
      mesh.follow = follow;
      follow();
      return mesh;
    }

    async select(mode) {
      this.mode = mode;
      const { displacement, label, frequency, note } = this.data.modes[mode];
      const steps = await numbers(displacement, 3);
      // Another mode may have been asked for meanwhile.
      if (mode !== this.mode) return;
      steps.forEach((v, k) => { this.shape.array[k] = v / this.data.displacement_steps; });
      this.shape.needsUpdate = true;
      this.ribbons.forEach((ribbon) => ribbon.follow());
      this.find(".now").textContent = `Mode ${label} · ${frequency}${note ? ` · ${note}` : ""}`;
      const input = this.find(`.modes input[value="${mode}"]`);
      input.checked = true;
      const list = this.find(".modes"), row = input.parentElement;
      const top = row.offsetTop - list.offsetTop;
      if (top < list.scrollTop || top + row.offsetHeight > list.scrollTop + list.clientHeight) list.scrollTop = top - 40;
      document.querySelectorAll("tr[data-mode]").forEach((tr) => tr.classList.toggle("current", +tr.dataset.mode === mode));
      this.refresh();
    }

    step(by) { this.select((this.mode + by + this.data.modes.length) % this.data.modes.length); }

    // A standard view, the structure filling the stage.
    look(name) {
      const { THREE } = this;
      const view = this.data.views.find((v) => v.name === name);
      if (view) {
        const axes = [view.right, view.up, view.back].map((axis) => new THREE.Vector3(...axis));
        this.turn.setFromRotationMatrix(new THREE.Matrix4().makeBasis(...axes));
      }
      const back = this.turn.clone().invert();
      const box = new THREE.Box3(), place = new THREE.Vector3();
      for (let k = 0; k < this.points.length; k += 3) box.expandByPoint(place.fromArray(this.points, k).applyQuaternion(back));
      const size = box.getSize(new THREE.Vector3());
      box.getCenter(this.target).applyQuaternion(this.turn);
      const aspect = this.canvas.clientWidth / Math.max(1, this.canvas.clientHeight);
      this.half = 0.54 * Math.max(size.y, size.x / aspect) + this.amplitude;
      this.refresh();
    }

    rotate(across, down) {
      const { THREE } = this;
      const about = (x, y, angle) => new THREE.Quaternion().setFromAxisAngle(new THREE.Vector3(x, y, 0), angle);
      this.turn.multiply(about(0, 1, -across)).multiply(about(1, 0, -down)).normalize();
      this.refresh();
    }

    // By pixels.
    pan(right, down) {
      const metre = (2 * this.half) / Math.max(1, this.canvas.clientHeight);
      this.target.add(new this.THREE.Vector3(-right * metre, down * metre, 0).applyQuaternion(this.turn));
      this.refresh();
    }

    // Keeps what is under the pointer (pixels from the middle) where it is.
    zoom(factor, x = 0, y = 0) {
      const before = this.half;
      this.half = Math.min(20, Math.max(0.002, this.half * factor));
      const part = this.half / before;
      this.pan(x * (1 - 1 / part), y * (1 - 1 / part));
    }

    refresh() {
      if (!this.frame) this.frame = requestAnimationFrame((now) => this.draw(now));
    }

    draw(now) {
      this.frame = 0;
      if (!this.inView) return;
      if (this.playing) this.phase += Math.min(0.1, (now - (this.last ?? now)) / 1000) * this.speed * 2 * Math.PI;
      this.last = now;
      this.amount.value = this.amplitude * Math.sin(this.phase);
      const width = this.canvas.clientWidth, height = Math.max(1, this.canvas.clientHeight);
      const camera = this.cameras[this.find(".perspective").checked ? 1 : 0];
      const away = camera.isPerspectiveCamera ? this.half / Math.tan((camera.fov * Math.PI) / 360) : 10 + this.half;
      camera.quaternion.copy(this.turn);
      camera.position.set(0, 0, away).applyQuaternion(this.turn).add(this.target);
      const wide = (this.half * width) / height;
      Object.assign(camera, camera.isPerspectiveCamera ? { aspect: width / height, near: Math.max(0.01, away - 2), far: away + 4 }
        : { left: -wide, right: wide, top: this.half, bottom: -this.half, near: 0.01, far: away + 10 });
      camera.updateProjectionMatrix();
      this.pixels.value.set(width / 2, height / 2);
      this.renderer.render(this.scene, camera);
      if (this.playing) this.refresh();
    }

    play(on) {
      this.playing = on;
      this.last = undefined;
      const button = this.find(".play");
      button.textContent = on ? "Pause" : "Play";
      button.setAttribute("aria-pressed", String(on));
      this.refresh();
    }

    wire() {
      const on = (selector, event, act) => this.find(selector).addEventListener(event, (e) => { act(e.target, e); this.refresh(); });
      this.play(this.playing);
      on(".play", "click", () => this.play(!this.playing));
      on(".amplitude", "input", (input) => { this.amplitude = input.value / 100; });
      on(".speed", "input", (input) => { this.speed = +input.value; });
      on(".colour", "change", (input) => {
        this.coloured.value = input.value === "displacement" ? 1 : 0;
        this.find(".scale-of-colours").style.display = this.coloured.value ? "" : "none";
      });
      on(".edges", "change", (input) => { this.edges.forEach((lines) => { lines.visible = input.checked; }); });
      on(".ghost", "change", (input) => { this.ghost.visible = input.checked; });
      on(".perspective", "change", () => {});
      on(".modes", "change", (input) => this.select(+input.value));
      on(".views", "click", (button) => { if (button.dataset.view) this.look(button.dataset.view); });
      on(".live > .groups", "change", (input) => { this.parts[+input.value].visible = input.checked; });
      const bar = this.data.palette.map((colour) => `rgb(${colour})`).join(",");
      this.find(".scale-of-colours i").style.background = `linear-gradient(90deg,${bar})`;
      this.pointers();
      const keys = {
        ArrowLeft: [-1, 0], ArrowRight: [1, 0], ArrowUp: [0, -1], ArrowDown: [0, 1],
        "+": () => this.zoom(0.87), "=": () => this.zoom(0.87), "-": () => this.zoom(1.15), " ": () => this.play(!this.playing),
        f: () => this.look("fit"), n: () => this.step(1), p: () => this.step(-1),
      };
      this.canvas.addEventListener("keydown", (event) => {
        const act = keys[event.key.length === 1 ? event.key.toLowerCase() : event.key];
        if (!act || event.ctrlKey || event.altKey || event.metaKey) return;
        event.preventDefault();
        if (typeof act === "function") act();
        else if (event.shiftKey) this.pan(24 * act[0], 24 * act[1]);
        else this.rotate(0.12 * act[0], 0.12 * act[1]);
      });
      new ResizeObserver(() => {
        this.renderer.setPixelRatio(Math.min(2, devicePixelRatio));
        this.renderer.setSize(this.canvas.parentElement.clientWidth, this.canvas.parentElement.clientHeight, false);
        this.refresh();
      }).observe(this.canvas.parentElement);
      new IntersectionObserver(([entry]) => {
        this.inView = entry.isIntersecting;
        this.last = undefined;
        this.refresh();
      }).observe(this.canvas);
    }

    pointers() {
      const held = new Map(), { canvas } = this;
      const middle = () => {
        const all = [...held.values()], mean = (axis) => all.reduce((sum, p) => sum + p[axis], 0) / all.length;
        return { x: mean("x"), y: mean("y"), apart: all.length > 1 ? Math.hypot(all[0].x - all[1].x, all[0].y - all[1].y) : 0 };
      };
      canvas.addEventListener("contextmenu", (event) => event.preventDefault());
      canvas.addEventListener("pointerdown", (event) => {
        canvas.setPointerCapture(event.pointerId);
        held.set(event.pointerId, { x: event.clientX, y: event.clientY });
      });
      canvas.addEventListener("pointermove", (event) => {
        if (!held.has(event.pointerId)) return;
        const before = middle();
        held.set(event.pointerId, { x: event.clientX, y: event.clientY });
        const after = middle(), across = after.x - before.x, down = after.y - before.y;
        if (held.size > 1) {
          if (before.apart > 0 && after.apart > 0) this.zoom(before.apart / after.apart);
          this.pan(across, down);
        } else if (event.shiftKey || event.buttons & 6) this.pan(across, down);
        else this.rotate(across * 0.008, down * 0.008);
      });
      for (const end of ["pointerup", "pointercancel"]) canvas.addEventListener(end, (event) => held.delete(event.pointerId));
      canvas.addEventListener("dblclick", () => this.look("fit"));
      canvas.addEventListener("wheel", (event) => {
        if (performance.now() - scrolledAt < 400) return;
        event.preventDefault();
        const box = canvas.getBoundingClientRect();
        this.zoom(Math.exp(Math.sign(event.deltaY) * 0.12), event.clientX - box.left - box.width / 2, event.clientY - box.top - box.height / 2);
      }, { passive: false });
    }
  }

  const shown = [];
  async function start(figure) {
    const canvas = figure.querySelector("canvas");
    const context = canvas.getContext("webgl2", { alpha: true, antialias: true, depth: true });
    if (!context || typeof DecompressionStream === "undefined") return;
    const data = JSON.parse(figure.querySelector("script").textContent);
    const view = new Shapes(figure, data, await three(), context);
    figure.querySelector(".live").hidden = false;
    figure.classList.add("is-live");
    try {
      await view.build();
      shown.push(view);
    } catch (error) {
      // The pictures are as good a page as there was before.
      figure.classList.remove("is-live");
      figure.querySelector(".live").hidden = true;
      throw error;
    }
  }

  document.querySelectorAll("figure.shapes").forEach((figure) => {
    const soon = new IntersectionObserver((entries) => {
      if (!entries.some((entry) => entry.isIntersecting)) return;
      soon.disconnect();
      start(figure);
    }, { rootMargin: "1200px" });
    soon.observe(figure);
  });

  document.addEventListener("click", (event) => {
    const row = event.target.closest("tr[data-mode]");
    const view = row && shown.find((v) => +row.dataset.mode < v.data.modes.length);
    if (!view) return;
    event.preventDefault();
    view.select(+row.dataset.mode);
    view.figure.scrollIntoView({ block: "center", behavior: "smooth" });
    if (event.target.closest("a.mode")) view.canvas.focus({ preventScroll: true });
  });
})();
