"use strict";
// Numbers as people read them. What is not known is an en dash, never "null" or "NaN".

const UNKNOWN = "–";
const MINUS = "−";
const SUPERSCRIPTS = "⁰¹²³⁴⁵⁶⁷⁸⁹";

function capitalised(text) {
  return text.charAt(0).toUpperCase() + text.slice(1);
}

// The first letter of a title inside a sentence; abbreviations such as SIMD stay.
function lowered(title) {
  return /^[A-Z][a-z]/.test(title) ? title.charAt(0).toLowerCase() + title.slice(1) : title;
}

function known(x) {
  return typeof x === "number" && Number.isFinite(x);
}

function hasBounds(interval) {
  return Boolean(interval) && known(interval.low) && known(interval.high);
}

function valueOf(interval) {
  return interval && known(interval.value) ? interval.value : null;
}

function typographic(text) {
  return text.replace("-", MINUS);
}

function superscript(whole) {
  return [...String(Math.abs(whole))].map((d) => SUPERSCRIPTS[d]).join("");
}

function powerOfTen(exponent) {
  return `10${exponent < 0 ? "⁻" : ""}${superscript(exponent)}`;
}

function exponentOf(x) {
  return x === 0 ? 0 : Math.floor(Math.log10(Math.abs(x)) + 1e-12);
}

// Digits after the point that leave `digits` significant ones.
function decimals(x, digits) {
  return Math.max(0, Math.min(6, digits - 1 - exponentOf(x)));
}

function plainRange(x) {
  return x === 0 || (Math.abs(x) >= 1e-3 && Math.abs(x) < 1e5);
}

function fmt(x, digits = 3) {
  if (!known(x)) return UNKNOWN;
  if (plainRange(x)) return typographic(x.toFixed(decimals(x, digits)));
  const exponent = exponentOf(x);
  const factor = (x / 10 ** exponent).toFixed(digits - 1);
  return typographic(`${factor} × ${powerOfTen(exponent)}`);
}

// Without the zeros that say nothing: what somebody chose, not what was measured.
function fmtShort(x, digits = 3) {
  const text = fmt(x, digits);
  return /^[^×]*\.[0-9]+$/.test(text) ? text.replace(/\.?0+$/, "") : text;
}

function fmtSigned(x, digits = 3) {
  return known(x) && x > 0 ? `+${fmt(x, digits)}` : fmt(x, digits);
}

// "AMD EPYC, 2 cores, 7.8 GiB, load 0.42"; of several, one after the other.
function machinesText(machines) {
  return (machines || []).map((machine) => machine.text).join("; ");
}

// 1 234 567 with thin spaces.
function fmtCount(x) {
  if (!known(x)) return UNKNOWN;
  if (Math.abs(x) >= 1e12) return fmt(x);
  return typographic(String(Math.round(x))).replace(/\B(?=(\d{3})+(?!\d))/g, "\u202f");
}

function fmtPercent(x, digits = 3) {
  if (!known(x)) return UNKNOWN;
  const percent = x * 100;
  const places =
    Math.abs(percent) >= 99.95 ? 0 : Math.min(2, decimals(percent || 1, digits));
  return `${typographic(percent.toFixed(places))} %`;
}

function fmtShortPercent(x) {
  return known(x) ? `${fmtShort(x * 100)} %` : UNKNOWN;
}

function fmtSignedPercent(x, digits = 2) {
  return known(x) && x > 0 ? `+${fmtPercent(x, digits)}` : fmtPercent(x, digits);
}

function fmtP(p) {
  if (!known(p)) return UNKNOWN;
  return p < 0.001 ? "< 0.001" : p.toFixed(p < 0.1 ? 3 : 2);
}

const TIME_UNITS = [
  [1e-6, "µs"],
  [1e-3, "ms"],
  [1, "s"],
  [60, "min"],
  [3600, "h"],
  [86400, "days"],
];

// [factor, name] of the unit in which `seconds` reads best.
function timeUnit(seconds) {
  let unit = TIME_UNITS[0];
  for (const candidate of TIME_UNITS) {
    const least = candidate[0] >= 60 ? 2 * candidate[0] : candidate[0];
    if (Math.abs(seconds) >= least) unit = candidate;
  }
  return unit;
}

function fmtSeconds(seconds, digits = 3) {
  if (!known(seconds)) return UNKNOWN;
  if (seconds === 0) return "0 s";
  const [factor, name] = timeUnit(seconds);
  return `${fmt(seconds / factor, digits)} ${name}`;
}

// Highway names AVX-512 differently.
function instructionSet(target) {
  return target.startsWith("AVX3") ? `${target} (AVX-512)` : target;
}

// Value and bounds with a common power of ten or unit: {value, bounds}; bounds may be "".
function intervalTexts(interval, scale = 1, suffix = "", signed = false) {
  const x = valueOf(interval);
  if (x === null) return { value: UNKNOWN, bounds: "" };
  let factor = scale,
    unit = suffix;
  if (scale === 1 && suffix === "" && !plainRange(x)) {
    const exponent = exponentOf(x);
    factor = 10 ** exponent;
    unit = ` × ${powerOfTen(exponent)}`;
  }
  const places = decimals(x / factor || (interval.high || 1) / factor, 3);
  const text = (y) => typographic((y / factor).toFixed(places));
  const sign = signed && x > 0 ? "+" : "";
  const bounds = hasBounds(interval)
    ? `[${text(interval.low)}, ${text(interval.high)}]`
    : "";
  return { value: `${sign}${text(x)}${unit}`, bounds };
}

function secondsTexts(interval) {
  const x = valueOf(interval);
  if (x === null) return { value: UNKNOWN, bounds: "" };
  const [factor, name] = timeUnit(x || 1);
  return intervalTexts(interval, factor, ` ${name}`);
}

// A factor that suits all of a column's values: {scale, unit}; null where they differ so
// much that each needs its own.
function commonScale(values) {
  const sizes = values
    .filter((x) => known(x) && x !== 0)
    .map(Math.abs)
    .sort((a, b) => a - b);
  if (sizes.length === 0 || sizes[sizes.length - 1] > 1e4 * sizes[0]) return null;
  const middle = sizes[sizes.length >> 1];
  if (sizes[0] >= 0.01 && middle < 1e4) return { scale: 1, unit: "" };
  const exponent = exponentOf(middle);
  return { scale: 10 ** exponent, unit: `× ${powerOfTen(exponent)}` };
}

// The same for seconds.
function commonTime(values) {
  const sizes = values.filter((x) => known(x) && x > 0).sort((a, b) => a - b);
  if (sizes.length === 0 || sizes[sizes.length - 1] > 1e3 * sizes[0]) return null;
  const [scale, unit] = timeUnit(sizes[sizes.length >> 1]);
  return { scale, unit };
}

function percentTexts(interval, signed = false) {
  return intervalTexts(interval, 0.01, " %", signed);
}

function joined({ value, bounds }) {
  return bounds ? `${value} ${bounds}` : value;
}

// The first of 1, 2, 5, 10, ... that is not below `least`.
function niceStep(least) {
  const power = 10 ** Math.floor(Math.log10(least));
  return [1, 2, 5, 10].map((f) => f * power).find((step) => step >= least * 0.999);
}
