// Draws the views of the page: bodies and joints swept round the axis, deformed, coloured, by increment; and curves.
// The amplitudes of the harmonics are summed here, on as many planes as are drawn.
"use strict";
(() => {
const SECTORS = 72;
// Bodies before and behind joints
const GHOST = 0.15;
const PARTS = { "half": [0, 180], "three quarters": [0, 270], "whole": [0, 360] };
const STATE_COLOURS = ["#4c78a8", "#f2a33a", "#c8c8c8"];
const LENGTH = "size of the displacement", MISES = "von Mises stress";

const bytes = text => Uint8Array.from(atob(text), letter => letter.charCodeAt(0));
const reals = packed => {
   const whole = new Int16Array(bytes(packed.data).buffer), values = new Float32Array(whole.length);
   for (let k = 0; k < whole.length; ++k) values[k] = whole[k]*packed.scale;
   return values;
};
const floats = text => new Float32Array(bytes(text).buffer);
const whole = text => new Uint32Array(bytes(text).buffer);
const radians = degrees => degrees*Math.PI/180;

// Total of amplitudes (modes, points, size) of one point at an angle: u, v of the symmetric family, and the first
// four stresses, go with the cosine, the others with the sine; of the antisymmetric family with sine and -cosine
function total(data, amplitude, size, point, angle, out) {
   const split = size === 3 ? 2 : 4;
   out.fill(0);
   for (let mode = 0; mode < data.harmonic.length; ++mode) {
      const turn = data.harmonic[mode]*radians(angle), symmetric = data.family[mode] === 1;
      const first = symmetric ? Math.cos(turn) : Math.sin(turn), other = symmetric ? Math.sin(turn) : -Math.cos(turn);
      const at = (mode*(amplitude.length/data.harmonic.length/size) + point)*size;
      for (let k = 0; k < size; ++k) out[k] += amplitude[at + k]*(k < split ? first : other);
   }
   return out;
}

function placed(r, z, angle, move, factor) {
   const c = Math.cos(radians(angle)), s = Math.sin(radians(angle));
   return [(r + factor*move[0])*c - factor*move[2]*s, (r + factor*move[0])*s + factor*move[2]*c, z + factor*move[1]];
}

function value(name, data, move, stress) {
   if (name === LENGTH) return Math.hypot(...move);
   const k = ["u", "v", "w"].indexOf(name);
   if (k >= 0) return move[k];
   if (!stress) return NaN;
   if (name === MISES) {
      const [r, z, t, a, b, c] = stress;
      return Math.sqrt(((r - z)**2 + (z - t)**2 + (t - r)**2)/2 + 3*(a*a + b*b + c*c));
   }
   return stress[data.stresses.indexOf(name)];
}

// A body: its outlines swept from plane to plane, and the section on the planes where it is cut open
function bodyMesh(data, body, position, u, s, colour, part, factor) {
   const [begin, end] = PARTS[part], edges = whole(body.edges), cells = whole(body.cells);
   const sectors = Math.round(SECTORS*(end - begin)/360);
   const mesh = { x: [], y: [], z: [], i: [], j: [], k: [], intensity: [] };
   const move = new Float64Array(3), stress = new Float64Array(6);
   const plane = (points, angle) => {
      const start = mesh.x.length;
      for (const point of points) {
         total(data, u, 3, point, angle, move);
         const [x, y, z] = placed(position[2*point], position[2*point + 1], angle, move, factor);
         mesh.x.push(x); mesh.y.push(y); mesh.z.push(z);
         mesh.intensity.push(value(colour, data, move, s && total(data, s, 6, point, angle, stress)));
      }
      return start;
   };
   const face = (a, b, c) => { mesh.i.push(a); mesh.j.push(b); mesh.k.push(c); };
   const outline = [...new Set(edges)], place = new Map(outline.map((point, k) => [point, k]));
   let last = plane(outline, begin);
   for (let sector = 1; sector <= sectors; ++sector) {
      const next = plane(outline, begin + (end - begin)*sector/sectors);
      for (let k = 0; k < edges.length; k += 2) {
         const a = place.get(edges[k]), b = place.get(edges[k + 1]);
         face(last + a, last + b, next + b);
         face(last + a, next + b, next + a);
      }
      last = next;
   }
   if (end - begin < 360) {
      const inside = [...new Set(cells)], within = new Map(inside.map((point, k) => [point, k]));
      for (const angle of [begin, end]) {
         const start = plane(inside, angle);
         for (let k = 0; k < cells.length; k += 3)
            face(start + within.get(cells[k]), start + within.get(cells[k + 1]), start + within.get(cells[k + 2]));
      }
   }
   return mesh;
}

// Joints: a cell for each joint point and plane, half-way to its neighbours; the value is that of the cell
function jointMesh(data, position, u, values, part, factor) {
   const joints = data.joints, [begin, end] = PARTS[part];
   const mesh = { x: [], y: [], z: [], i: [], j: [], k: [], intensity: [] };
   const middles = joints.planes, move = new Float64Array(3), count = joints.points.reduce((sum, n) => sum + n, 0);
   const bounds = middles.map((angle, k) => {
      const wrap = middles[middles.length - 1] - 360;
      const before = k ? middles[k - 1] : joints.mirrored ? angle : wrap;
      const after = k + 1 < middles.length ? middles[k + 1] : joints.mirrored ? angle : middles[0] + 360;
      return [(before + angle)/2, (angle + after)/2];
   });
   const cell = (joint, from, to, first, last, shown) => {
      first = Math.max(first, begin); last = Math.min(last, end);
      if (last - first < 1e-9) return;
      const pieces = Math.max(1, Math.ceil((last - first)*SECTORS/360));
      for (let piece = 0; piece < pieces; ++piece) {
         const start = mesh.x.length;
         for (const angle of [first + (last - first)*piece/pieces, first + (last - first)*(piece + 1)/pieces])
            for (const share of [from, to]) {
               const ends = [2*joint, 2*joint + 1], mean = [0, 0, 0];
               let r = 0, z = 0;
               ends.forEach((point, k) => {
                  const weight = k ? share : 1 - share;
                  total(data, u, 3, point, angle, move);
                  move.forEach((one, c) => { mean[c] += weight*one; });
                  r += weight*position[2*point]; z += weight*position[2*point + 1];
               });
               const [x, y, height] = placed(r, z, angle, mean, factor);
               mesh.x.push(x); mesh.y.push(y); mesh.z.push(height);
            }
         mesh.i.push(start, start + 1); mesh.j.push(start + 1, start + 3); mesh.k.push(start + 2, start + 2);
         mesh.intensity.push(shown, shown);
      }
   };
   let point = 0;
   joints.points.forEach((n, joint) => {
      for (let k = 0; k < n; ++k, ++point)
         bounds.forEach(([first, last], plane) => {
            const shown = values[plane*count + point];
            const low = k/n, high = (k + 1)/n;
            cell(joint, low, high, first, last, shown);
            if (joints.mirrored) cell(joint, low, high, 360 - last, 360 - first, shown);
            else if (first < 0) cell(joint, low, high, first + 360, 360, shown);
            else if (last > 360) cell(joint, low, high, 0, last - 360, shown);
         });
   });
   return mesh;
}

function option(text) {
   const found = document.createElement("option");
   found.textContent = text;
   return found;
}

function control(parent, name, input) {
   const label = document.createElement("label");
   label.append(`${name} `, input);
   parent.append(label);
   return input;
}

function choice(parent, name, words) {
   const select = document.createElement("select");
   select.append(...words.map(option));
   return control(parent, name, select);
}

function slider(parent, name, most) {
   const input = document.createElement("input");
   Object.assign(input, { type: "range", min: 0, max: most, step: 1, value: most });
   return control(parent, name, input);
}

function largest(values) {
   return values.reduce((most, one) => Math.max(most, Math.abs(one)), 0);
}

// Where the scene is looked at from: plotly makes the mean of its sides 1, so that a tall one needs more distance
function eye(traces, narrow) {
   const sides = ["x", "y", "z"].map(axis => {
      const values = traces.flatMap(trace => trace[axis]);
      return values.reduce((a, b) => Math.max(a, b), -Infinity) - values.reduce((a, b) => Math.min(a, b), Infinity);
   });
   const mean = Math.cbrt(sides[0]*sides[1]*sides[2]) || 1;
   const far = Math.max(1, Math.max(...sides)/mean/1.7)*(narrow ? 1.35 : 1);
   return { x: 0.35*far, y: -1.9*far, z: 0.75*far };
}

class View {
   constructor(place) {
      this.place = place;
      this.data = JSON.parse(document.getElementById(place.dataset.view).textContent);
      this.position = floats(this.data.position);
      this.factors = new Map();
      this.controls();
      this.scene = document.createElement("div");
      this.scene.className = "scene";
      this.curves = document.createElement("div");
      this.curves.className = "curves";
      place.append(this.scene, this.curves);
      this.plots = this.data.curves.map(() => {
         const plot = document.createElement("div");
         plot.className = "curve";
         this.curves.append(plot);
         return plot;
      });
      this.show();
   }

   controls() {
      const data = this.data, bar = document.createElement("div");
      bar.className = "controls";
      this.place.append(bar);
      this.when = slider(bar, "Increment", data.increments.length - 1);
      this.told = document.createElement("output");
      this.when.after(this.told);
      if (data.increments.length < 2) this.when.disabled = true;
      this.enlarge = slider(bar, "Enlargement", 100);
      this.enlarge.value = 50;
      this.times = document.createElement("output");
      this.enlarge.after(this.times);
      this.colour = choice(bar, "Bodies", [LENGTH, "u", "v", "w", MISES, ...data.stresses]);
      if (data.joints) this.joint = choice(bar, "Joints", ["not shown", ...data.joints.names]);
      this.part = choice(bar, "Part", Object.keys(PARTS));
      this.shown = data.bodies.map(body => {
         const box = document.createElement("input");
         Object.assign(box, { type: "checkbox", checked: true });
         return control(bar, `Body ${body.body}`, box);
      });
      for (const input of bar.querySelectorAll("input, select")) input.addEventListener("change", () => this.show());
      this.when.addEventListener("input", () => this.tell());
      this.enlarge.addEventListener("input", () => this.tell());
   }

   get row() { return Number(this.when.value); }

   // The slider's middle enlarges the largest displacement of all increments to 1/20 of the extent
   get factor() {
      if (!this.natural) {
         const extent = largest(this.position) || 1, most = Math.max(...this.data.u.map(one => one.scale*32767)) || 1;
         this.natural = Math.max(extent/20/most, 1e-12);
      }
      const place = Number(this.enlarge.value);
      const exact = place ? this.natural*10**((place - 50)/25) : 0;
      return Number(exact.toPrecision(2));
   }

   tell() {
      const data = this.data, load = data.factors[this.row];
      this.told.textContent = `${data.increments[this.row]}` + (load === null ? "" : `, load factor ${Number(load.toPrecision(6))}`);
      this.times.textContent = `${this.factor} times`;
   }

   range(traces, cmin, cmax) { for (const trace of traces) Object.assign(trace, { cmin, cmax }); }

   show() {
      const data = this.data, row = this.row, part = this.part.value, colour = this.colour.value, factor = this.factor;
      this.tell();
      const u = reals(data.u[row]), s = data.s[row] && reals(data.s[row]);
      const isStress = ![LENGTH, "u", "v", "w"].includes(colour);
      const unit = isStress ? data.units.stress : data.units.length, traces = [];
      const missing = isStress && !s, joints = data.joints && this.joint.selectedIndex > 0 && data.joints.values[row];
      data.bodies.forEach((body, k) => {
         if (!this.shown[k].checked) return;
         const mesh = bodyMesh(data, body, this.position, u, s, missing ? LENGTH : colour, part, factor);
         traces.push({ type: "mesh3d", name: `body ${body.body}`, ...mesh, colorscale: "Viridis", flatshading: false,
            showscale: false, hovertemplate: `body ${body.body}<br>%{intensity:.4g} ${unit}<extra></extra>`,
            lighting: { ambient: 0.75, diffuse: 0.5, specular: 0.05 }, opacity: joints ? GHOST : 1 });
      });
      const values = traces.flatMap(trace => trace.intensity);
      const low = values.reduce((a, b) => Math.min(a, b), Infinity), high = values.reduce((a, b) => Math.max(a, b), -Infinity);
      this.range(traces, low, high > low ? high : low + 1);
      if (traces.length) {
         traces[0].showscale = true;
         const title = missing ? "stresses of this increment are not kept" : colour + (unit ? ` [${unit}]` : "");
         traces[0].colorbar = { title: { text: title, side: "right" }, x: 1, len: 0.8, thickness: 14 };
      }
      this.addJoints(traces, row, part, factor);
      const narrow = this.scene.clientWidth < 600;
      for (const trace of traces) if (trace.colorbar && narrow)
         Object.assign(trace.colorbar, { orientation: "h", x: 0.5, y: trace.joints ? -0.2 : 0, len: 0.95, thickness: 10, yanchor: "top",
            title: { text: trace.colorbar.title.text, side: "top" } });
      const layout = { margin: { l: 0, r: 0, t: 0, b: narrow ? 110 : 0 }, paper_bgcolor: "white", uirevision: "kept",
         scene: { aspectmode: "data", uirevision: "kept", camera: { eye: eye(traces, narrow) },
            xaxis: { title: { text: "x" } }, yaxis: { title: { text: "y" } }, zaxis: { title: { text: "z" } } } };
      const settings = { responsive: true, displaylogo: false, modeBarButtons: [["toImage", "resetCameraDefault3d"]] };
      this.place.dataset.vertices = traces.reduce((sum, trace) => sum + trace.x.length, 0);
      this.place.dataset.faults = traces.reduce((sum, trace) => sum + [trace.x, trace.y, trace.z, trace.intensity]
         .flat().filter(one => !Number.isFinite(one)).length, 0);
      Plotly.react(this.scene, traces, layout, settings).then(() => { this.place.dataset.drawn = "1"; });
      this.plots.forEach((plot, k) => this.curve(plot, data.curves[k]));
   }

   addJoints(traces, row, part, factor) {
      const joints = this.data.joints;
      if (!joints || this.joint.selectedIndex < 1) return;
      const kept = joints.values[row];
      if (!kept) return;
      const what = this.joint.selectedIndex - 1;
      const mesh = jointMesh(this.data, floats(joints.position), reals(joints.u[row]), reals(kept[what]), part, factor);
      const unit = ["", this.data.units.stress, this.data.units.stress, this.data.units.length, this.data.units.length][what];
      const trace = { type: "mesh3d", name: "joints", joints: true, ...mesh, intensitymode: "cell", showscale: true,
         lighting: { ambient: 0.9, diffuse: 0.3, specular: 0 },
         colorbar: { title: { text: `joints: ${joints.names[what]}` + (unit ? ` [${unit}]` : ""), side: "right" }, x: 1.12, len: 0.8,
            thickness: 14 } };
      if (what === 0) {
         const n = joints.states.length;
         trace.colorscale = STATE_COLOURS.flatMap((colour, k) => [[k/n, colour], [(k + 1)/n, colour]]);
         trace.intensity = trace.intensity.map(one => Math.round(one));
         Object.assign(trace, { cmin: -0.5, cmax: n - 0.5 });
         Object.assign(trace.colorbar, { tickvals: joints.states.map((_, k) => k), ticktext: joints.states });
      } else {
         const most = Math.max(...trace.intensity);
         Object.assign(trace, { colorscale: "YlOrRd", reversescale: true, cmin: 0, cmax: most > 0 ? most : 1 });
      }
      traces.push(trace);
   }

   curve(plot, told) {
      const row = this.row, increment = this.data.increments[row], styles = ["solid", "dash", "dot", "dashdot"];
      const traces = [];
      told.lines.forEach((line, k) => {
         const style = { color: "#111", dash: styles[k % styles.length] };
         if (told.kind === "profile") {
            line.x.forEach((x, other) => other !== row && traces.push({ x, y: line.y, mode: "lines", hoverinfo: "skip",
               showlegend: false, line: { color: "#ccc", width: 1 } }));
            traces.push({ x: line.x[row], y: line.y, mode: "lines", name: line.name, line: style });
            return;
         }
         const at = told.increments.indexOf(increment);
         traces.push({ x: line.x, y: line.y, mode: "lines+markers", name: line.name, line: style, marker: { size: 4, color: "#111" } });
         if (at >= 0) traces.push({ x: [line.x[at]], y: [line.y[at]], mode: "markers", showlegend: false, hoverinfo: "skip",
            marker: { size: 11, color: "#fff", line: { color: "#111", width: 2 } } });
      });
      const several = told.lines.length > 1;
      const layout = { title: { text: told.title, font: { size: 14 } }, margin: { l: 60, r: 10, t: 34, b: several ? 70 : 44 },
         xaxis: { title: { text: told.x } }, yaxis: { title: { text: told.y } }, showlegend: several,
         legend: { orientation: "h", y: -0.25 }, paper_bgcolor: "white", plot_bgcolor: "white", font: { color: "#111" } };
      for (const axis of [layout.xaxis, layout.yaxis])
         Object.assign(axis, { showline: true, linecolor: "#111", gridcolor: "#e4e4e4", zerolinecolor: "#888", ticks: "outside" });
      Plotly.react(plot, traces, layout, { responsive: true, displayModeBar: false });
   }
}

addEventListener("load", () => {
   for (const place of document.querySelectorAll(".view")) {
      try {
         new View(place);
      } catch (error) {
         place.dataset.failed = String(error);
         place.append(`The view could not be drawn: ${error}`);
      }
   }
});
})();
