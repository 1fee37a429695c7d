// Cursors on the plots of a report: A and B with their difference, and a fundamental with its harmonics and side lines.
(() => {
  "use strict";
  const REACH = 7; // pixels of the screen from which a line is grabbed
  const MOST = 400; // harmonics over a whole plot, for the least fundamental
  const SIDES = [-2, -1, 1, 2];

  const drawn = (name, attributes, text) => {
    const made = document.createElementNS("http://www.w3.org/2000/svg", name);
    for (const [key, value] of Object.entries(attributes)) made.setAttribute(key, value);
    if (text !== undefined) made.textContent = text;
    return made;
  };
  const row = (kind, cells) => {
    const made = document.createElement("tr");
    for (const text of cells) made.append(Object.assign(document.createElement(kind), { textContent: text }));
    return made;
  };
  const signed = (n) => (n < 0 ? `−${-n}` : `+${n}`);

  class Cursors {
    constructor(figure) {
      this.plot = figure.plot;
      this.svg = this.plot.svg;
      const tools = figure.querySelector(".cursors");
      this.button = tools.querySelector("button");
      this.select = tools.querySelector("select");
      this.check = tools.querySelector("input[type=checkbox]");
      this.fields = [...tools.querySelectorAll("input[type=number]")];
      this.keys = tools.querySelector(".keys");
      this.readings = figure.querySelector(".readings");
      this.status = this.readings.querySelector("p");
      this.titles = [...this.svg.querySelectorAll("text.title")].map((title) => title.textContent);
      this.marks = this.svg.insertBefore(drawn("g", { class: "marks" }), this.svg.querySelector(".frame"));
      this.pair = null; // places of A and B
      this.family = null;
      this.held = null; // what the arrow keys move: 0, 1, or "harmonics"
      this.harmonic = 1; // which harmonic is held
      this.svg.setAttribute("role", "application");
      this.svg.setAttribute("aria-describedby", figure.querySelector(".hint").id);
      this.plot.changed = () => this.update();
      this.listen(tools);
    }

    // Whatever is asked for, within the plot.
    place(x) { const { low, high } = this.plot.data.x; return Math.min(high, Math.max(low, x)); }
    fundamental(f) { const { high } = this.plot.data.x; return Math.min(high, Math.max(high / MOST, f)); }

    // Abscissas of harmonics in view, or no farther from it than `beyond`, with the number of each.
    harmonics(beyond = 0) {
      const { low, high } = this.plot.x, found = [];
      for (let k = Math.max(1, Math.ceil((low - beyond) / this.at - 1e-9)); k * this.at <= (high + beyond) * (1 + 1e-9); k += 1) found.push([k, k * this.at]);
      return found;
    }

    sides() { return this.family?.sides && this.check.checked ? SIDES : []; }

    choose(value) {
      this.family = value === "" ? null : this.plot.data.families[Number(value)];
      this.at = this.family && this.fundamental(this.family.at);
      this.harmonic = 1;
      this.held = this.family ? "harmonics" : this.pair && 0;
      if (this.check) {
        this.check.checked = false;
        this.check.nextElementSibling.textContent = this.family?.sides ? `side lines at ±1 and ±2 x ${this.family.sides.name}` : "";
      }
      this.update();
    }

    togglePair() {
      const { plot } = this;
      this.pair = this.pair ? null : [1 / 3, 2 / 3].map((part) => plot.value(plot.x, part));
      this.held = this.pair ? 0 : this.family && "harmonics";
      this.update();
    }

    move(mark, to) {
      if (mark === "harmonics") this.at = this.fundamental(to); else this.pair[mark] = this.place(to);
      this.held = mark;
      this.update();
    }

    // By pixels of the picture; of a harmonic by its own pixels.
    step(mark, pixels) {
      const { plot } = this, { left, right } = plot.data;
      const from = mark === "harmonics" ? this.harmonic * this.at : this.pair[mark];
      const to = plot.value(plot.x, plot.part(plot.x, from) + pixels / (right - left));
      this.move(mark, mark === "harmonics" ? to / this.harmonic : to);
    }

    // The line at the pointer: which mark, and which harmonic.
    grabbed(at) {
      const { plot } = this, reach = REACH * plot.data.width / this.svg.getBoundingClientRect().width;
      let best = reach, found = null;
      const look = (x, mark, harmonic) => {
        const far = Math.abs(plot.xPixel(x) - at.x);
        if (at.inside && far < best) { best = far; found = { mark, harmonic }; }
      };
      this.pair?.forEach((x, k) => look(x, k, 1));
      if (this.family) for (const [k, x] of this.harmonics()) look(x, "harmonics", k);
      return found;
    }

    // The curve that is read: the one last dragged over, else the first.
    read() {
      const shown = this.plot.data.curves.filter((c) => c.visible && c.rising && c.y.length);
      return shown.includes(this.curve) ? this.curve : shown[0];
    }

    amplitude(x) {
      const curve = this.read(), y = curve ? this.plot.between(curve, x) : NaN;
      return Number.isFinite(y) ? y : null;
    }

    line(x, look, name) {
      const { plot } = this, { left, right, top, bottom } = plot.data, at = plot.xPixel(x), y = this.amplitude(x);
      if (!(at >= left - 0.5 && at <= right + 0.5)) return false;
      const line = drawn("g", { class: `mark ${look}` });
      line.append(drawn("title", {}, name), drawn("line", { x1: at, x2: at, y1: top, y2: bottom }));
      const height = y === null ? NaN : plot.yPixel(y);
      if (height >= top && height <= bottom) line.append(drawn("circle", { cx: at, cy: height, r: 2.6 }));
      this.marks.append(line);
      return at;
    }

    draw() {
      const { top, character } = this.plot.data, labels = [];
      this.marks.replaceChildren();
      if (this.family) {
        const name = this.select.selectedOptions[0].textContent, look = `m${this.family.colour}`, sides = this.sides();
        let end = -Infinity;
        for (const [k, x] of this.harmonics(sides.length && 2 * this.family.sides.spacing)) {
          const label = `${k}×`, half = 0.5 * character * label.length;
          for (const m of sides) this.line(x + m * this.family.sides.spacing, `${look} side`, `${label} ${name} ${signed(m)}× ${this.family.sides.name}`);
          const at = this.line(x, look, `${label} ${name}`);
          if (at === false || at - half < end + 4) continue;
          labels.push(drawn("text", { class: `mark ${look}`, x: at, y: top - 4, "text-anchor": "middle" }, label));
          end = at + half;
        }
      }
      this.pair?.forEach((x, k) => {
        const at = this.line(x, "pair", "AB"[k]);
        if (at !== false) labels.push(drawn("text", { class: "mark pair", x: at + 4, y: top + 13 }, "AB"[k]));
      });
      this.marks.append(...labels);
      this.svg.classList.toggle("marked", this.family !== null);
    }

    point(x) {
      const { plot } = this, y = this.amplitude(x);
      return `(${plot.number(plot.x, x)}; ${y === null ? "–" : plot.number(plot.y, y)})`;
    }

    pairText() {
      const { plot } = this, { x, y, curves } = plot.data, [a, b] = this.pair, dx = b - a, ya = this.amplitude(a), yb = this.amplitude(b);
      const curve = curves.length > 1 ? this.read() : null, parts = curve ? [`${curve.name}: `] : [];
      parts.push(`A ${this.point(a)}, B ${this.point(b)}, Δx = ${`${plot.number(plot.x, dx)} ${x.unit}`.trim()}`);
      if (x.reciprocal && dx !== 0) parts.push(`, 1/Δx = ${plot.digits(x.reciprocal.factor / dx)} ${x.reciprocal.unit}`);
      if (ya !== null && yb !== null) parts.push(`, Δy = ${`${plot.number(plot.y, yb - ya)} ${y.unit}`.trim()}`);
      return parts.join("");
    }

    table() {
      const { plot } = this, sides = this.sides(), of = (x) => { const y = this.amplitude(x); return y === null ? "–" : plot.digits(y); };
      const made = document.createElement("table"), [x, y] = this.titles, spacing = this.family.sides?.spacing;
      made.createCaption().textContent = `Harmonics of ${this.select.selectedOptions[0].textContent} in view`;
      made.createTHead().append(row("th", ["Harmonic", x, y, ...sides.map((m) => `at ${signed(m)}× ${this.family.sides.name}`)]));
      made.createTBody().append(...this.harmonics().map(([k, at]) =>
        row("td", [`${k}×`, plot.digits(at, 5), of(at), ...sides.map((m) => of(at + m * spacing))])));
      return made;
    }

    update() {
      const { family, pair, plot } = this, texts = [];
      this.draw();
      if (pair) texts.push(this.pairText());
      if (family) texts.push(`${this.select.selectedOptions[0].textContent}: ${plot.digits(this.at, 5)} ${plot.data.x.unit}`.trim());
      this.status.textContent = texts.join("; ");
      this.readings.querySelector(".scroll")?.remove();
      if (family) {
        const box = Object.assign(document.createElement("div"), { className: "scroll", tabIndex: 0 });
        box.append(this.table());
        this.readings.append(box);
      }
      this.readings.hidden = this.keys.hidden = !(pair || family);
      this.button.setAttribute("aria-pressed", String(pair !== null));
      for (const field of this.fields) {
        const value = field.dataset.mark === "harmonics" ? family && this.at : pair && pair[Number(field.dataset.mark)];
        field.parentElement.hidden = value === null;
        if (value !== null && !(document.activeElement === field && Number(field.value) === value)) field.value = Number(value.toPrecision(7));
      }
      if (this.check) this.check.parentElement.hidden = !family?.sides;
    }

    listen(tools) {
      const { svg, plot } = this;
      let drag = null;
      this.button.addEventListener("click", () => this.togglePair());
      this.select?.addEventListener("change", () => this.choose(this.select.value));
      this.check?.addEventListener("change", () => this.update());
      for (const field of this.fields) {
        const mark = field.dataset.mark === "harmonics" ? "harmonics" : Number(field.dataset.mark);
        const hold = () => { this.held = mark; this.harmonic = 1; };
        field.addEventListener("focus", hold);
        field.addEventListener("change", () => { hold(); if (field.value !== "") this.move(mark, Number(field.value)); });
        field.addEventListener("keydown", (event) => {
          const by = { ArrowUp: 1, ArrowDown: -1 }[event.key];
          if (!by) return;
          event.preventDefault();
          this.step(mark, event.shiftKey ? 10 * by : by);
        });
      }
      // Before the listeners that zoom: what is grabbed is moved.
      const first = { capture: true };
      svg.addEventListener("pointerdown", (event) => {
        const at = plot.pointer(event), found = event.button === 0 ? this.grabbed(at) : null;
        if (!found) return;
        event.stopImmediatePropagation();
        svg.setPointerCapture(event.pointerId);
        drag = found.mark;
        this.held = found.mark;
        this.harmonic = found.harmonic;
      }, first);
      svg.addEventListener("pointermove", (event) => {
        const at = plot.pointer(event);
        svg.classList.toggle("grab", drag !== null || this.grabbed(at) !== null);
        if (drag === null) return;
        event.stopImmediatePropagation();
        this.curve = plot.nearest(at)?.curve ?? this.curve;
        this.move(drag, plot.value(plot.x, at.part) / (drag === "harmonics" ? this.harmonic : 1));
      }, first);
      for (const end of ["pointerup", "pointercancel"]) {
        svg.addEventListener(end, (event) => {
          if (drag === null) return;
          event.stopImmediatePropagation();
          drag = null;
        }, first);
      }
      svg.addEventListener("keydown", (event) => {
        const by = { ArrowLeft: -1, ArrowRight: 1 }[event.key];
        if (this.held === null) return;
        if (event.key === "Escape") this.held = null;
        else if (by) this.step(this.held, event.shiftKey ? 10 * by : by);
        else return;
        event.preventDefault();
        event.stopImmediatePropagation();
      }, first);
    }
  }

  for (const figure of document.querySelectorAll("figure.plot")) figure.cursors = new Cursors(figure);
})();
