"use strict";
// Pictures of the two slots as textures, and drawing them.

// What lies over the colours; "samples" the page has already, the others are asked for.
const COLOUR = "colour",
  RELATIVE = "relative",
  SAMPLES = "samples";
const CURVES = { srgb: 0, reinhard: 1, filmic: 2, false: 3 };

function floatTexture(gl, filter) {
  const texture = gl.createTexture();
  gl.bindTexture(gl.TEXTURE_2D, texture);
  for (const name of [gl.TEXTURE_MIN_FILTER, gl.TEXTURE_MAG_FILTER]) {
    gl.texParameteri(gl.TEXTURE_2D, name, filter);
  }
  for (const name of [gl.TEXTURE_WRAP_S, gl.TEXTURE_WRAP_T]) {
    gl.texParameteri(gl.TEXTURE_2D, name, gl.CLAMP_TO_EDGE);
  }
  return texture;
}

const FOUR = ["RGBA16F", "RGBA"],
  ONE = ["R16F", "RED"];

class Screen {
  // Throws Error where WebGL 2 is missing.
  constructor(canvas) {
    const gl = canvas.getContext("webgl2", { antialias: false });
    if (!gl) throw new Error("WebGL 2 is missing or disabled in this browser");
    Object.assign(this, { canvas, gl, program: makeProgram(gl), slots: [] });
    gl.pixelStorei(gl.UNPACK_ALIGNMENT, 2);
    this.ramp = floatTexture(gl, gl.NEAREST);
    gl.texImage2D(
      gl.TEXTURE_2D, 0, gl.RGB, 256, 1, 0, gl.RGB, gl.UNSIGNED_BYTE,
      new Uint8Array(SEQUENTIAL_TABLE),
    );
  }

  // Textures of so many pixels, empty.
  reset(size) {
    this.size = size;
    for (const slot of this.slots) {
      for (const name of ["full", "coarse", "over"]) this.gl.deleteTexture(slot[name]);
    }
    this.slots = [0, 1].map(() => this.makeSlot(size));
  }

  makeSlot(size) {
    const { gl } = this;
    const slot = {
      full: floatTexture(gl, gl.NEAREST),
      coarse: floatTexture(gl, gl.LINEAR),
      over: floatTexture(gl, gl.NEAREST),
      view: -1,
      layer: COLOUR,
      values: new LayerValues(size),
      most: 0,
      shown: false,
    };
    this.allocate(slot.full, size, FOUR);
    this.allocate(slot.coarse, { width: 1, height: 1 }, FOUR);
    this.allocate(slot.over, size, ONE);
    return slot;
  }

  allocate(texture, { width, height }, [inner, format]) {
    const { gl } = this;
    gl.bindTexture(gl.TEXTURE_2D, texture);
    gl.texImage2D(
      gl.TEXTURE_2D, 0, gl[inner], width, height, 0, gl[format], gl.HALF_FLOAT, null,
    );
  }

  clear(slot) {
    this.allocate(slot.full, this.size, FOUR);
  }

  // A slot shows something else from now on: nothing, until it comes.
  forget(index) {
    const slot = this.slots[index];
    this.clear(slot);
    this.allocate(slot.coarse, { width: 1, height: 1 }, FOUR);
    slot.values.clear();
    Object.assign(slot, { view: -1, most: 0, shown: false });
  }

  // Takes a message of "kind": "picture".
  take(head, buffer, at) {
    const slot = this.slots[head.slot];
    const fresh = head.view !== slot.view || !slot.shown;
    if (fresh || head.layer !== slot.layer) {
      slot.values.clear();
      if (fresh) this.clear(slot);
    }
    if (fresh) slot.most = 0;
    Object.assign(slot, { view: head.view, layer: head.layer, shown: true });
    slot.most = Math.max(slot.most, head.spp);
    if (head.factor > 1) return this.takeCoarse(slot, head, buffer, at);
    const has = head.layer !== COLOUR;
    for (const [x, y, width, height] of head.squares) {
      const count = width * height;
      this.put(slot.full, x, y, width, height, FOUR, new Uint16Array(buffer, at, 4 * count));
      at += 8 * count;
      if (!has) continue;
      const values = new Uint16Array(buffer, at, count);
      this.put(slot.over, x, y, width, height, ONE, values);
      slot.values.put(x, y, width, height, values);
      at += 2 * count;
    }
  }

  takeCoarse(slot, head, buffer, at) {
    this.allocate(slot.coarse, head, FOUR);
    for (const [x, y, width, height] of head.squares) {
      const count = 4 * width * height;
      this.put(slot.coarse, x, y, width, height, FOUR, new Uint16Array(buffer, at, count));
      at += 2 * count + (head.layer === COLOUR ? 0 : 2 * width * height);
    }
  }

  put(texture, x, y, width, height, [, format], values) {
    const { gl } = this;
    gl.bindTexture(gl.TEXTURE_2D, texture);
    gl.texSubImage2D(
      gl.TEXTURE_2D, 0, x, y, width, height, gl[format], gl.HALF_FLOAT, values,
    );
  }

  // look: {place: {x, y, zoom in canvas pixels per image pixel}, exposure, curve, layer}.
  // parts: [{slot, pane: [x, y, width, height], clip: the same}] in canvas pixels from
  // the lower left corner.
  draw(look, parts) {
    const { gl, canvas, program } = this;
    gl.viewport(0, 0, canvas.width, canvas.height);
    const around = colorNumbers(theme.color("--ghost"));
    gl.disable(gl.SCISSOR_TEST);
    gl.clearColor(...around, 1);
    gl.clear(gl.COLOR_BUFFER_BIT);
    gl.enable(gl.SCISSOR_TEST);
    program.use();
    program.color("around", around);
    program.number("gain", 2 ** look.exposure);
    program.whole("curve", CURVES[look.curve]);
    program.pair("middle", look.place.x, look.place.y);
    program.number("zoom", look.place.zoom);
    program.pair("size", this.size.width, this.size.height);
    for (const part of parts) this.drawPart(look, part);
  }

  drawPart(look, { slot: index, pane, clip }) {
    const { gl, program } = this;
    const slot = this.slots[index];
    const textures = { full: slot.full, coarse: slot.coarse, over: slot.over, ramp: this.ramp };
    Object.entries(textures).forEach(([name, texture], unit) => {
      gl.activeTexture(gl.TEXTURE0 + unit);
      gl.bindTexture(gl.TEXTURE_2D, texture);
      program.whole(name, unit);
    });
    const [low, high] = look.range;
    program.number("low", Math.log2(low));
    program.number("high", Math.log2(high));
    program.whole("layer", look.layer === COLOUR ? 0 : look.layer === SAMPLES ? 1 : 2);
    program.pair("corner", pane[0], pane[1]);
    program.pair("pane", pane[2], pane[3]);
    gl.scissor(...clip.map(Math.round));
    gl.drawArrays(gl.TRIANGLES, 0, 3);
  }
}

// A colour of style as three numbers from 0 to 1.
function colorNumbers(text) {
  return [1, 3, 5].map((at) => parseInt(text.slice(at, at + 2), 16) / 255);
}
