"use strict";
// From radiance to bytes. Images are half floats, so that a tone curve is a table of 65536
// entries and changing the exposure costs one look-up per value.

function encodeSrgb(x) {
  return x <= 0.0031308 ? 12.92 * x : 1.055 * x ** (1 / 2.4) - 0.055;
}

// Curves from scene values to [0, 1], before the sRGB encoding.
const TONE_CURVES = {
  srgb: { label: "sRGB, clamped", curve: (x) => Math.min(1, x) },
  reinhard: { label: "Reinhard", curve: (x) => x / (1 + x) },
  // A sigmoid over log x (Naka and Rushton): toe, straight middle, soft shoulder; the
  // exponent and the half-way point keep middle grey 0.18 close to where it was.
  filmic: { label: "Filmic", curve: (x) => x ** 1.3 / (x ** 1.3 + 0.514) },
  false: { label: "False colour", curve: null },
};

// As options of a menu.
const TONE_OPTIONS = Object.entries(TONE_CURVES).map(([key, { label }]) => [key, label]);

const FALSE_STOPS = 6; // false colour spans 2^-6 to 2^6 around the exposure

// Colours at equal steps, sRGB bytes.
const SEQUENTIAL = [
  [10, 8, 38],
  [58, 18, 102],
  [128, 32, 118],
  [190, 52, 92],
  [232, 96, 52],
  [248, 164, 40],
  [252, 252, 176],
];
const DIVERGING = [
  [16, 64, 138],
  [62, 132, 196],
  [158, 202, 228],
  [246, 246, 243],
  [248, 188, 144],
  [220, 104, 62],
  [142, 22, 34],
];
const INVALID = [255, 0, 200];

// Bytes of a ramp with 256 entries.
function rampTable(anchors) {
  const table = new Uint8ClampedArray(256 * 3);
  for (let i = 0; i < 256; ++i) {
    const at = (i / 255) * (anchors.length - 1);
    const k = Math.min(anchors.length - 2, Math.floor(at));
    for (let c = 0; c < 3; ++c) {
      table[3 * i + c] = anchors[k][c] + (at - k) * (anchors[k + 1][c] - anchors[k][c]);
    }
  }
  return table;
}

const SEQUENTIAL_TABLE = rampTable(SEQUENTIAL);
const DIVERGING_TABLE = rampTable(DIVERGING);

// x in [0, 1] to an entry; anything else but a number is INVALID.
function putRamp(data, at, table, x) {
  const finite = Number.isFinite(x);
  const i = finite ? 3 * Math.round(255 * Math.max(0, Math.min(1, x))) : 0;
  for (let c = 0; c < 3; ++c) data[at + c] = finite ? table[i + c] : INVALID[c];
  data[at + 3] = 255;
}

// Byte for every half float; NaN has none and is marked by the caller.
function toneTable({ curve, exposure }) {
  const table = new Uint8ClampedArray(65536);
  const gain = 2 ** exposure;
  const apply = TONE_CURVES[curve].curve;
  for (let bits = 0; bits < 32768; ++bits) {
    // negative values stay 0
    const x = HALF_VALUES[bits] * gain;
    if (Number.isFinite(x)) table[bits] = 255 * encodeSrgb(apply(x));
  }
  return table;
}

const lastTable = { key: "", table: null };

function cachedToneTable(tone) {
  const key = `${tone.curve} ${tone.exposure}`;
  if (lastTable.key !== key) Object.assign(lastTable, { key, table: toneTable(tone) });
  return lastTable.table;
}

function luminanceAt(image, i) {
  return (
    0.2126 * channelAt(image, i, 0) +
    0.7152 * channelAt(image, i, 1) +
    0.0722 * channelAt(image, i, 2)
  );
}

function isNanBits(bits) {
  return (bits & 0x7fff) > 0x7c00;
}

function putToned(data, i, image, table) {
  for (let c = 0; c < 3; ++c) {
    const bits = image.bits[image.channels === 1 ? i : 3 * i + c];
    if (isNanBits(bits)) {
      data.set(INVALID, 4 * i);
      break;
    }
    data[4 * i + c] = table[bits];
  }
  data[4 * i + 3] = 255;
}

// The image as the screen shows it, one pixel for a pixel.
function tonedPixels(image, tone) {
  const pixels = new ImageData(image.width, image.height);
  const count = image.width * image.height;
  if (TONE_CURVES[tone.curve].curve === null) {
    for (let i = 0; i < count; ++i) {
      const stops = Math.log2(Math.max(luminanceAt(image, i), 1e-30)) + tone.exposure;
      putRamp(pixels.data, 4 * i, SEQUENTIAL_TABLE, 0.5 + stops / (2 * FALSE_STOPS));
    }
    return pixels;
  }
  const table = cachedToneTable(tone);
  for (let i = 0; i < count; ++i) putToned(pixels.data, i, image, table);
  return pixels;
}

// Pixels of a ramp: valueOfPixel(i) in [0, 1].
function rampPixels(width, height, table, valueOfPixel) {
  const pixels = new ImageData(width, height);
  for (let i = 0; i < width * height; ++i) {
    putRamp(pixels.data, 4 * i, table, valueOfPixel(i));
  }
  return pixels;
}

function channelMean(image, i) {
  return image.channels === 1
    ? channelAt(image, i, 0)
    : (channelAt(image, i, 0) + channelAt(image, i, 1) + channelAt(image, i, 2)) / 3;
}
