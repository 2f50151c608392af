"use strict";
// The numbers and images that the report's writer put into the page.

const study = JSON.parse(document.getElementById("study").textContent);

// Value of every half float, by its 16 bits.
const HALF_VALUES = (() => {
  const values = new Float32Array(65536);
  for (let bits = 0; bits < 65536; ++bits) {
    const exponent = (bits >> 10) & 31;
    const fraction = bits & 1023;
    let value;
    if (exponent === 31) {
      value = fraction ? NaN : Infinity;
    } else if (exponent === 0) {
      value = fraction * 2 ** -24;
    } else {
      value = (1 + fraction / 1024) * 2 ** (exponent - 15);
    }
    values[bits] = bits & 0x8000 ? -value : value;
  }
  return values;
})();

function decodeBits(text) {
  const binary = atob(text);
  const bits = new Uint16Array(binary.length / 2);
  for (let i = 0; i < bits.length; ++i) {
    bits[i] = binary.charCodeAt(2 * i) | (binary.charCodeAt(2 * i + 1) << 8);
  }
  return bits;
}

const imageBlocks = new Map();
for (const block of document.querySelectorAll("script.image-data")) {
  imageBlocks.set(JSON.parse(block.dataset.name), block);
}

const decodedImages = new Map();

// {name, width, height, channels, bits} or null: what is named and not there is missing.
function findImage(name) {
  if (typeof name !== "string" || !imageBlocks.has(name)) return null;
  if (!decodedImages.has(name)) {
    const block = imageBlocks.get(name);
    decodedImages.set(name, {
      name,
      width: Number(block.dataset.width),
      height: Number(block.dataset.height),
      channels: Number(block.dataset.channels),
      bits: decodeBits(block.textContent),
    });
  }
  return decodedImages.get(name);
}

function hasImage(name) {
  return typeof name === "string" && imageBlocks.has(name);
}

// Value of channel c (of three; grey images repeat theirs) at the pixel with index i.
function channelAt(image, i, c) {
  const at = image.channels === 1 ? i : i * 3 + c;
  return HALF_VALUES[image.bits[at]];
}
