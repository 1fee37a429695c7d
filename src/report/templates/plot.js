// Zooms and reads the plots of a report: draws them again from the data beside each picture. No library, no network.
(() => {
  "use strict";
  document.documentElement.classList.add("scripted");
  let scrolledAt = 0;
  addEventListener("scroll", () => { scrolledAt = performance.now(); }, { passive: true });

  const bytes = (text) => Uint8Array.from(atob(text), (c) => c.charCodeAt(0)).buffer;
  const escape = (text) => text.replace(/[&<>"']/g, (c) => `&#${c.charCodeAt(0)};`);
  const RAISED = { "-": "⁻", 0: "⁰", 1: "¹", 2: "²", 3: "³", 4: "⁴", 5: "⁵", 6: "⁶", 7: "⁷", 8: "⁸", 9: "⁹" };
  const raise = (n) => [...String(n)].map((c) => RAISED[c]).join("");
  const tenth = (v) => Math.round(v * 10) / 10;

  function fixed(value, decimals) {
    const text = Math.abs(value).toFixed(Math.min(decimals, 20));
    let [whole, fraction] = text.split(".");
    if (whole.length > 4) whole = whole.replace(/\B(?=(\d{3})+$)/g, "\u202f");
    return (value < 0 && /[1-9]/.test(text) ? "−" : "") + whole + (fraction ? "." + fraction : "");
  }

  function linearTicks(low, high, wanted) {
    const rough = (high - low) / wanted;
    const power = 10 ** Math.floor(Math.log10(rough));
    const step = [1, 2, 5, 10].map((n) => n * power).find((s) => s >= 0.999 * rough) || 10 * power;
    const decimals = Math.max(0, -Math.floor(Math.log10(step) + 1e-9));
    const ticks = [];
    for (let k = Math.ceil(low / step - 1e-9); k <= Math.floor(high / step + 1e-9) && ticks.length < 1000; k += 1) {
      ticks.push({ at: k * step, label: fixed(k * step, decimals) });
    }
    return ticks;
  }

  function logTicks(low, high, wanted) {
    const decades = Math.log10(high / low);
    if (decades < 1) return linearTicks(low, high, Math.min(wanted, 5));
    const stride = Math.max(1, Math.ceil(decades / wanted));
    const ticks = [];
    for (let e = Math.floor(Math.log10(low) - 1e-9); e <= Math.floor(Math.log10(high) + 1e-9); e += 1) {
      for (let d = 1; d < 10; d += 1) {
        const at = d * 10 ** e;
        if ((stride > 1 && d > 1) || at < low * (1 - 1e-9) || at > high * (1 + 1e-9)) continue;
        const numbered = d === 1 ? e % stride === 0 : (d === 2 || d === 5) && decades < 3;
        const label = e >= -3 && e <= 4 ? fixed(at, Math.max(0, -e)) : (d === 1 ? "10" : `${d}·10`) + raise(e);
        ticks.push({ at, label: numbered ? label : null });
      }
    }
    return ticks;
  }

  // Digits that tell neighbouring pixels apart.
  const shown = (value, width) => fixed(value, Math.max(0, Math.min(12, 3 - Math.floor(Math.log10(width || 1)))));

  class Plot {
    constructor(figure) {
      this.data = JSON.parse(figure.querySelector("script").textContent);
      this.svg = figure.querySelector("svg.plot");
      this.view = this.svg.querySelector(".view");
      this.whole = this.view.innerHTML;
      this.clip = this.svg.querySelector("clipPath").id;
      this.output = figure.querySelector("output");
      this.picture = this.view.querySelector("image.raster")?.getAttribute("href");
      for (const curve of this.data.curves) {
        curve.y = new Float32Array(bytes(curve.y));
        if (curve.x !== undefined) curve.x = new Float64Array(bytes(curve.x));
        curve.at = curve.x ? (k) => curve.x[k] : (k) => curve.start + k * curve.step;
        curve.rising = !curve.x || curve.x.every((x, k) => k === 0 || curve.x[k - 1] <= x);
        curve.visible = true;
      }
      this.reset();
      this.listen(figure);
    }

    reset() {
      this.x = { ...this.data.x };
      this.y = { ...this.data.y };
      this.zoomed = false;
      if (!this.data.curves.every((c) => c.visible)) { this.draw(); return; }
      this.view.innerHTML = this.whole;
      this.changed?.();
    }

    // Values to pixels and back; a logarithmic axis is even in the logarithm.
    part(axis, v) { return axis.log ? Math.log(v / axis.low) / Math.log(axis.high / axis.low) : (v - axis.low) / (axis.high - axis.low); }
    value(axis, p) { return axis.log ? axis.low * (axis.high / axis.low) ** p : axis.low + p * (axis.high - axis.low); }
    xPixel(v) { const d = this.data; return d.left + this.part(this.x, v) * (d.right - d.left); }
    yPixel(v) { const d = this.data; return d.bottom - this.part(this.y, v) * (d.bottom - d.top); }

    // A number with the digits that an axis can show; one of any size with so many digits.
    number(axis, v) { return shown(v, axis.log ? Math.abs(v) : axis.high - axis.low); }
    digits(v, count = 4) { return shown(v, Math.abs(v) * 10 ** (4 - count)); }

    // First point for which x > v (or >= v).
    find(curve, v, inclusive) {
      let low = 0, high = curve.y.length;
      while (low < high) {
        const middle = (low + high) >> 1, x = curve.at(middle);
        if (x < v || (!inclusive && x === v)) low = middle + 1; else high = middle;
      }
      return low;
    }

    range(curve) {
      if (!curve.rising) return [0, curve.y.length];
      return [Math.max(0, this.find(curve, this.x.low, true) - 1), Math.min(curve.y.length, this.find(curve, this.x.high, false) + 1)];
    }

    zoom(low, high) {
      const whole = this.data.x, log = whole.log;
      if (log ? high / low < 1 + 1e-9 : high - low < 1e-9 * (whole.high - whole.low)) return;
      const before = log ? Math.log(high / low) : high - low;
      if (before >= (log ? Math.log(whole.high / whole.low) : whole.high - whole.low) * (1 - 1e-9)) { this.reset(); return; }
      if (low < whole.low) { high = log ? high * whole.low / low : high + whole.low - low; low = whole.low; }
      if (high > whole.high) { low = log ? low * whole.high / high : low - (high - whole.high); high = whole.high; }
      this.x = { log, low, high };
      this.zoomed = true;
      this.fitY();
      this.draw();
    }

    // The vertical range that the curves in view need, as the first picture has it.
    fitY() {
      if (this.data.raster) return;
      const log = this.data.y.log;
      let low = Infinity, high = -Infinity;
      for (const curve of this.data.curves.filter((c) => c.visible)) {
        const [first, end] = this.range(curve);
        for (let k = first; k < end; k += 1) {
          const y = curve.y[k], x = curve.at(k);
          if (x < this.x.low || x > this.x.high || !Number.isFinite(y) || (log && y <= 0)) continue;
          if (y < low) low = y;
          if (y > high) high = y;
        }
      }
      if (!(low <= high)) { this.y = { ...this.data.y }; return; }
      if (log) {
        const room = high > low * (1 + 1e-9) ? (high / low) ** 0.06 : 2;
        this.y = { log, low: low / room, high: high * room };
      } else if (high - low <= 1e-9 * Math.max(Math.abs(low), Math.abs(high))) {
        const half = Math.abs(high) > 0 ? 0.1 * Math.abs(high) : 1;
        this.y = { log, low: low - half, high: high + half };
      } else {
        const room = 0.06 * (high - low);
        this.y = { log, low: low >= 0 && low < 0.3 * high ? 0 : low - room, high: high + room };
      }
    }

    draw() {
      const d = this.data, out = [];
      if (d.raster) {
        const [left, right] = d.raster.x.map((v) => this.xPixel(v)), [bottom, top] = d.raster.y.map((v) => this.yPixel(v));
        out.push(`<g clip-path="url(#${this.clip})"><image class="raster" x="${tenth(left)}" y="${tenth(top)}" width="${tenth(right - left)}" height="${tenth(bottom - top)}" preserveAspectRatio="none" href="${this.picture}"/></g>`);
      }
      const look = d.raster ? ' stroke-opacity="0.2"' : "";
      const line = (tick, x1, y1, x2, y2) => out.push(`<line class="${tick.label === null ? "fine" : "grid"}"${look} x1="${x1}" y1="${y1}" x2="${x2}" y2="${y2}"/>`);
      for (const tick of (this.x.log ? logTicks : linearTicks)(this.x.low, this.x.high, d.ticks[0])) {
        const x = tenth(this.xPixel(tick.at));
        line(tick, x, d.top, x, d.bottom);
        if (tick.label !== null) out.push(`<text class="tick" x="${x}" y="${d.bottom + 16}" text-anchor="middle">${tick.label}</text>`);
      }
      for (const tick of (this.y.log ? logTicks : linearTicks)(this.y.low, this.y.high, d.ticks[1])) {
        const y = tenth(this.yPixel(tick.at));
        line(tick, d.left, y, d.right, y);
        if (tick.label !== null) out.push(`<text class="tick" x="${d.left - 7}" y="${y + 4}" text-anchor="end">${tick.label}</text>`);
      }
      this.drawMarkers(out);
      for (const level of d.levels) {
        const y = tenth(this.yPixel(level.at));
        if (!(y >= d.top && y <= d.bottom)) continue;
        out.push(`<g class="level"><line x1="${d.left}" y1="${y}" x2="${d.right}" y2="${y}"/><text x="${d.left + 6}" y="${y - 4}">${escape(level.label)}</text></g>`);
      }
      out.push(`<g clip-path="url(#${this.clip})">`);
      for (const curve of d.curves) if (curve.visible) this.drawCurve(out, curve);
      out.push("</g>");
      this.view.innerHTML = out.join("");
      this.changed?.();
    }

    drawMarkers(out) {
      const d = this.data, ends = [], labels = [];
      for (const marker of [...d.markers].sort((a, b) => a.at - b.at)) {
        const part = this.part(this.x, marker.at);
        if (!(part >= 0 && part <= 1)) continue;
        const x = d.left + part * (d.right - d.left), half = 0.5 * d.character * [...marker.label].length;
        const centre = Math.min(Math.max(x, d.left + half), d.right - half);
        let row = ends.findIndex((end) => centre - half > end + 6);
        if (row < 0 && ends.length < d.rows) row = ends.push(-Infinity) - 1;
        const top = d.top - d.row * Math.max(row, 0), name = escape(marker.label);
        out.push(`<g class="marker m${marker.colour}"><title>${name}</title><line x1="${tenth(x)}" y1="${top}" x2="${tenth(x)}" y2="${d.bottom}"/></g>`);
        if (row < 0) continue;
        ends[row] = centre + half;
        labels.push(`<g class="marker m${marker.colour}"><text x="${tenth(centre)}" y="${top - 4}" text-anchor="middle">${name}</text></g>`);
      }
      out.push(...labels);
    }

    drawCurve(out, curve) {
      const [first, end] = this.range(curve);
      const pixel = (k) => [this.xPixel(curve.at(k)), Math.min(3000, Math.max(-2000, this.yPixel(curve.y[k])))];
      if (curve.style === "points") {
        out.push(`<g class="dots c${curve.colour}${curve.open ? " open" : ""}">`);
        for (let k = first; k < end; k += 1) {
          const [x, y] = pixel(k), label = curve.labels?.[k];
          if (!Number.isFinite(x) || !Number.isFinite(y)) continue;
          const title = label === undefined ? "" : `<title>${escape(label)}</title>`;
          out.push(`<path transform="translate(${tenth(x)} ${tenth(y)})" d="${curve.symbol}">${title}</path>`);
        }
        out.push("</g>");
        return;
      }
      // Two points a pixel column: the lowest and the highest, so that spikes survive.
      const bucket = Math.max(1, Math.ceil((end - first) / this.data.width)), path = [];
      let pen = false;
      const go = (k) => {
        const [x, y] = pixel(k);
        if (!(Number.isFinite(x) && Number.isFinite(y))) { pen = false; return; }
        path.push(`${pen ? "L" : "M"}${tenth(x)} ${tenth(y)}`);
        pen = true;
      };
      for (let start = first; start < end; start += bucket) {
        if (bucket === 1) { go(start); continue; }
        let low = -1, high = -1, gap = false;
        for (let k = start; k < Math.min(end, start + bucket); k += 1) {
          const y = curve.y[k];
          if (!Number.isFinite(y)) { gap = true; continue; }
          if (low < 0 || y < curve.y[low]) low = k;
          if (high < 0 || y > curve.y[high]) high = k;
        }
        if (low >= 0) { go(Math.min(low, high)); if (low !== high) go(Math.max(low, high)); }
        if (gap) pen = false;
      }
      out.push(`<path class="curve c${curve.colour}${curve.style === "dashed" ? " dashed" : ""}" d="${path.join("")}"/>`);
    }

    // Where the pointer is, as a part of the plotting area.
    pointer(event) {
      const d = this.data, box = this.svg.getBoundingClientRect();
      const x = (event.clientX - box.left) * d.width / box.width, y = (event.clientY - box.top) * d.height / box.height;
      return { x, y, part: (x - d.left) / (d.right - d.left), inside: x >= d.left && x <= d.right && y >= d.top && y <= d.bottom };
    }

    overlay(html) {
      if (!this.cover) {
        this.cover = document.createElementNS("http://www.w3.org/2000/svg", "g");
        this.svg.append(this.cover);
      }
      this.cover.innerHTML = html;
    }

    // The point nearest to the pointer, by its height, among those under it; of curves without any there the next one aside.
    nearest(at) {
      const d = this.data, pixel = 1 / (d.right - d.left), v = this.value(this.x, at.part);
      let best = Infinity, found = null;
      for (const curve of d.curves) {
        if (!curve.visible || !curve.rising || !curve.y.length) continue;
        let first = this.find(curve, this.value(this.x, at.part - pixel), true), end = this.find(curve, this.value(this.x, at.part + pixel), false);
        if (first === end) {
          first = Math.min(first, curve.y.length - 1);
          if (first > 0 && Math.abs(curve.at(first - 1) - v) < Math.abs(curve.at(first) - v)) first -= 1;
          end = first + 1;
        }
        for (let k = first; k < end; k += 1) {
          const far = Math.abs(this.yPixel(curve.y[k]) - at.y);
          if (far < best) { best = far; found = { curve, k }; }
        }
      }
      return found;
    }

    // What a curve has at an abscissa, straight between its points; NaN outside.
    between(curve, x) {
      const k = this.find(curve, x, true);
      if (k === curve.y.length || curve.at(k) === x) return k < curve.y.length ? curve.y[k] : NaN;
      if (k === 0) return NaN;
      const from = curve.at(k - 1);
      return curve.y[k - 1] + (x - from) / (curve.at(k) - from) * (curve.y[k] - curve.y[k - 1]);
    }

    // The nearest labelled point within reach of the pointer.
    named(at) {
      const d = this.data;
      let best = 400, found = null;
      for (const curve of d.curves) {
        if (!curve.visible || !curve.labels) continue;
        const [first, end] = this.range(curve);
        for (let k = first; k < end; k += 1) {
          const x = this.xPixel(curve.at(k)), y = this.yPixel(curve.y[k]), far = (x - at.x) ** 2 + (y - at.y) ** 2;
          if (far < best) { best = far; found = { x, y, text: curve.labels[k] }; }
        }
      }
      this.overlay(found ? `<circle class="spot" cx="${found.x}" cy="${found.y}" r="3"/>` : "");
      this.output.textContent = found ? found.text : "";
    }

    // The point nearest to the pointer; of plots with labelled points the nearest of these.
    read(at) {
      if (this.data.curves.some((c) => c.labels)) { this.named(at); return; }
      const d = this.data, found = at.inside ? this.nearest(at) : null;
      if (!found) { this.overlay(""); this.output.textContent = ""; return; }
      const { curve, k } = found, x = this.xPixel(curve.at(k)), y = this.yPixel(curve.y[k]);
      if (!(Number.isFinite(x) && Number.isFinite(y)) || x < d.left - 1 || x > d.right + 1) return;
      const spot = y >= d.top && y <= d.bottom ? `<circle class="spot" cx="${x}" cy="${y}" r="3"/>` : "";
      this.overlay(`<line class="hair" x1="${x}" y1="${d.top}" x2="${x}" y2="${d.bottom}"/>${spot}`);
      this.output.textContent = `${d.curves.length > 1 ? curve.name + ": " : ""}(${this.number(this.x, curve.at(k))}; ${this.number(this.y, curve.y[k])})`;
    }

    listen(figure) {
      const d = this.data;
      let drag = null;
      this.svg.addEventListener("wheel", (event) => {
        const at = this.pointer(event), outwards = event.deltaY > 0;
        // A page that is being scrolled goes on scrolling, and so does one that cannot zoom out further.
        if (!at.inside || event.deltaY === 0 || performance.now() - scrolledAt < 250 || (outwards && !this.zoomed)) return;
        event.preventDefault();
        const factor = outwards ? 1.25 : 0.8, axis = { ...this.x };
        this.zoom(this.value(axis, at.part * (1 - factor)), this.value(axis, at.part + (1 - at.part) * factor));
        this.read(at);
      }, { passive: false });
      this.svg.addEventListener("pointerdown", (event) => {
        const at = this.pointer(event);
        if (!at.inside || event.button !== 0) return;
        this.svg.setPointerCapture(event.pointerId);
        drag = { from: at, axis: { ...this.x }, move: event.shiftKey };
      });
      this.svg.addEventListener("pointermove", (event) => {
        const at = this.pointer(event);
        if (!drag) { this.read(at); return; }
        if (drag.move) {
          const shift = drag.from.part - at.part;
          if (this.zoomed) this.zoom(this.value(drag.axis, shift), this.value(drag.axis, 1 + shift));
          return;
        }
        const x = Math.min(d.right, Math.max(d.left, at.x)), left = Math.min(x, drag.from.x);
        this.overlay(`<rect class="select" x="${left}" y="${d.top}" width="${Math.abs(x - drag.from.x)}" height="${d.bottom - d.top}"/>`);
      });
      const stop = (event) => {
        if (!drag) return;
        const at = this.pointer(event), { from, axis, move } = drag;
        drag = null;
        this.overlay("");
        if (move || event.type === "pointercancel" || Math.abs(at.x - from.x) < 5) return;
        const parts = [from.part, Math.min(1, Math.max(0, at.part))].sort((a, b) => a - b);
        this.zoom(this.value(axis, parts[0]), this.value(axis, parts[1]));
      };
      this.svg.addEventListener("pointerup", stop);
      this.svg.addEventListener("pointercancel", stop);
      this.svg.addEventListener("pointerleave", () => { if (!drag) { this.overlay(""); this.output.textContent = ""; } });
      this.svg.addEventListener("dblclick", (event) => { event.preventDefault(); this.reset(); });
      this.svg.addEventListener("keydown", (event) => {
        const steps = { ArrowLeft: [-0.2, 0.8], ArrowRight: [0.2, 1.2], "+": [0.1, 0.9], "-": [-0.125, 1.125] }[event.key];
        if (event.key === "Escape" || event.key === "Home") this.reset();
        else if (steps && (this.zoomed || event.key === "+")) this.zoom(this.value(this.x, steps[0]), this.value(this.x, steps[1]));
        else return;
        event.preventDefault();
      });
      figure.querySelectorAll(".legend button").forEach((button, k) => {
        button.addEventListener("click", () => {
          d.curves[k].visible = !d.curves[k].visible;
          button.setAttribute("aria-pressed", String(d.curves[k].visible));
          if (this.zoomed) { this.fitY(); this.draw(); } else this.reset();
        });
      });
      addEventListener("beforeprint", () => this.overlay(""));
    }
  }

  for (const figure of document.querySelectorAll("figure.plot")) figure.plot = new Plot(figure);
})();
