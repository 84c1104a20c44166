"use strict";
// Shows the designs that the page holds. All numbers were computed before; see docs/explorer.md.

const MISSING = 0xffff;
const INVERSE = { linear: (u) => u, log: Math.exp, asinh: Math.sinh };

async function inflated(text) {
  const bytes = Uint8Array.from(atob(text), (letter) => letter.charCodeAt(0));
  const stream = new Blob([bytes]).stream().pipeThrough(new DecompressionStream("deflate"));
  return new Uint8Array(await new Response(stream).arrayBuffer());
}

// The inverse of tramdva.report.packed_arrays.pack: numbers in their order, the last dimension fastest.
async function unpacked(packed) {
  const planes = await inflated(packed.data);
  const count = planes.length / 2;
  const whole = new Uint16Array(count);
  for (let k = 0; k < count; k++) {
    const folded = planes[k] | (planes[count + k] << 8);
    whole[k] = (folded >>> 1) ^ -(folded & 1);
  }
  for (const axis of [...packed.differences].reverse()) {
    const stride = packed.shape.slice(axis + 1).reduce((a, b) => a * b, 1);
    for (let k = 0; k < count; k++) {
      if (Math.floor(k / stride) % packed.shape[axis] > 0) whole[k] += whole[k - stride];
    }
  }
  const plain = INVERSE[packed.kind];
  return Float32Array.from(whole, (q) =>
    q === MISSING ? NaN : packed.scale * plain((q + packed.lowest) * packed.step));
}

// Fill an image with signed roots of a growth rate (c_R, c_A), finer than it was computed.
function drawMap(image, growth, columns, rows, finer, end) {
  const width = finer * (columns - 1) + 1;
  for (let y = 0; y < finer * (rows - 1) + 1; y++) {
    const a = Math.min(Math.floor(y / finer), rows - 2);
    const v = y / finer - a;
    for (let x = 0; x < width; x++) {
      const r = Math.min(Math.floor(x / finer), columns - 2);
      const u = x / finer - r;
      const near = r * rows + a;
      const value = (1 - u) * ((1 - v) * growth[near] + v * growth[near + 1])
        + u * ((1 - v) * growth[near + rows] + v * growth[near + rows + 1]);
      const root = Math.sqrt(Math.abs(value) / end);
      image[y * width + x] = Math.sign(value) * Math.min(root, 1);
    }
  }
}

class Model {
  constructor(name, data) {
    this.data = data;
    this.section = document.getElementById(name);
    this.plots = {};
  }

  find(name) {
    return this.section.querySelector(`.${name}`);
  }

  async show() {
    for (const part of [...this.data.curves, ...this.data.images]) {
      part.values = await unpacked(part.array);
    }
    for (const [name, item] of Object.entries(this.data.plots)) {
      const views = await Bokeh.embed.embed_item(item, name);
      this.plots[name] = views.get_by_id(item.root_id).model.document;
    }
    this.fillTable();
    this.listen();
    this.select(...this.data.own);
  }

  fillTable() {
    const [i, j] = this.data.own;
    for (const row of this.data.rows) {
      const line = this.section.querySelector("tbody").insertRow();
      const head = line.appendChild(document.createElement("th"));
      head.scope = "row";
      head.append(row.name, " ");
      head.appendChild(document.createElement("small")).textContent = row.unit;
      row.cell = line.insertCell();
      row.cell.className = "now";
      line.insertCell().textContent = row.cells[i][j];
      line.insertCell().textContent = row.none;
    }
  }

  listen() {
    const [stiffness, damping] = [this.find("c_T"), this.find("d_T")];
    stiffness.max = this.data.x.length - 1;
    damping.max = this.data.y.length - 1;
    const moved = () => this.select(Number(damping.value), Number(stiffness.value));
    for (const slider of [stiffness, damping]) slider.addEventListener("input", moved);
    this.find("own").addEventListener("click", () => this.select(...this.data.own));
    this.find("best").disabled = this.data.best === null;
    this.find("best").addEventListener("click", () => this.select(...this.data.best));
    for (const plot of Object.values(this.plots)) {
      const designs = plot.get_model_by_name("designs");
      designs?.selected.properties.indices.change.connect(() => {
        const [cell] = designs.selected.indices;
        if (cell === undefined) return;
        const columns = this.data.x.length;
        this.select(Math.floor(cell / columns), cell % columns);
        designs.selected.indices = [];
      });
    }
  }

  // Design i of the damping and j of the stiffness.
  select(i, j) {
    this.design = [i, j];
    const data = this.data;
    this.find("d_T").value = i;
    this.find("c_T").value = j;
    this.find("stiffness").textContent = data.stiffness[j];
    this.find("tuned").textContent = data.tuned[j];
    this.find("damping").textContent = data.damping[i];
    this.find("ratio").textContent = data.ratio[i][j];
    this.find("c_T").setAttribute("aria-valuetext", `${data.stiffness[j]}, ${data.tuned[j]}`);
    this.find("d_T").setAttribute("aria-valuetext", `${data.damping[i]}, ${data.ratio[i][j]}`);
    const [tone, words] = data.verdicts[data.verdict[i][j]];
    this.find("verdict").className = `verdict ${tone}`;
    this.find("verdict").textContent = words;
    this.find("note").textContent = data.notes[data.note[i][j]];
    for (const row of data.rows) row.cell.textContent = row.cells[i][j];
    this.draw(i * data.x.length + j);
  }

  draw(number) {
    const [i, j] = this.design;
    for (const plot of Object.values(this.plots)) {
      const place = plot.get_model_by_name("place");
      if (place) place.data = { x: [this.data.x[j]], y: [this.data.y[i]] };
    }
    for (const { plot, values, array } of this.data.curves) {
      const size = array.shape[2];
      const source = this.plots[plot].get_model_by_name("now");
      const y = values.slice(number * size, (number + 1) * size);
      source.data = { x: source.data.x, y };
    }
    for (const { plot, values, array, finer, end } of this.data.images) {
      const [columns, rows] = array.shape.slice(2);
      const size = columns * rows;
      const source = this.plots[plot].get_model_by_name("now");
      const growth = values.subarray(number * size, (number + 1) * size);
      drawMap(source.data.image[0], growth, columns, rows, finer, end);
      source.change.emit();
    }
  }
}

async function start() {
  const packed = JSON.parse(document.getElementById("packed").textContent);
  const text = async (name) => new TextDecoder().decode(await inflated(packed[name]));
  const library = document.createElement("script");
  library.textContent = await text("library");
  document.head.appendChild(library);
  Bokeh.logger.set_level("warn");
  window.explorer = {};
  for (const [name, data] of Object.entries(JSON.parse(await text("data")))) {
    window.explorer[name] = new Model(name, data);
    await window.explorer[name].show();
  }
  document.getElementById("fault").remove();
  document.body.dataset.ready = "true";
}

start().catch((error) => {
  document.getElementById("fault").textContent =
    `This page cannot be shown (${error.message}). It needs a browser of 2023 or later.`;
  throw error;
});
