"use strict";
// Moving the camera. An eye is {position, target, up, fov, lens, focus} in the units of
// the scene file; functions make new ones.

const vec = {
  add: (a, b) => a.map((x, i) => x + b[i]),
  sub: (a, b) => a.map((x, i) => x - b[i]),
  scale: (a, s) => a.map((x) => x * s),
  dot: (a, b) => a.reduce((sum, x, i) => sum + x * b[i], 0),
  cross: (a, b) => [
    a[1] * b[2] - a[2] * b[1],
    a[2] * b[0] - a[0] * b[2],
    a[0] * b[1] - a[1] * b[0],
  ],
  length: (a) => Math.hypot(...a),
  unit: (a) => vec.scale(a, 1 / Math.hypot(...a)),
};

// v about the unit vector `axis` (Rodrigues 1840).
function turned(v, axis, angle) {
  const c = Math.cos(angle),
    s = Math.sin(angle);
  return vec.add(
    vec.add(vec.scale(v, c), vec.scale(vec.cross(axis, v), s)),
    vec.scale(axis, vec.dot(axis, v) * (1 - c)),
  );
}

// Unit vectors to the right and up in the picture, and ahead.
function axesOf(eye, mirrored) {
  const ahead = vec.unit(vec.sub(eye.target, eye.position));
  const right = vec.unit(vec.cross(eye.up, ahead));
  return {
    ahead,
    right: mirrored ? vec.scale(right, -1) : right,
    up: vec.cross(ahead, right),
  };
}

const STEEPEST = 0.02; // radians that are left between the line of sight and up

// Turns the camera about its target, by angles in radians: the scene follows the mouse.
function orbited(eye, mirrored, across, along) {
  const up = vec.unit(eye.up);
  const { right } = axesOf(eye, false);
  const sign = mirrored ? -1 : 1;
  let arm = vec.sub(eye.position, eye.target);
  const height = Math.acos(Math.max(-1, Math.min(1, vec.dot(vec.unit(arm), up))));
  const tilt = Math.max(STEEPEST, Math.min(Math.PI - STEEPEST, height - along)) - height;
  arm = turned(arm, right, -tilt);
  arm = turned(arm, up, across * sign);
  return { ...eye, position: vec.add(eye.target, arm) };
}

// Nearer to the target (factor < 1) or away from it; what is sharp stays sharp.
function dollied(eye, factor) {
  const arm = vec.scale(vec.sub(eye.position, eye.target), factor);
  return { ...eye, position: vec.add(eye.target, arm) };
}

// Moves camera and target: by shares of the distance between them.
function tracked(eye, mirrored, across, along) {
  const { right, up } = axesOf(eye, mirrored);
  const size = vec.length(vec.sub(eye.target, eye.position));
  const by = vec.add(vec.scale(right, across * size), vec.scale(up, along * size));
  return {
    ...eye,
    position: vec.add(eye.position, by),
    target: vec.add(eye.target, by),
  };
}

// Sends eyes one at a time: the next one goes when the picture of the last one has come,
// so that the mouse never runs ahead of the renderer.
class EyeSender {
  constructor(socket, patience = 500) {
    Object.assign(this, { socket, patience, waiting: null, sent: 0, latency: [] });
  }

  move(eye) {
    this.waiting = eye;
    if (this.sent === 0 || performance.now() - this.sent > this.patience) this.flush();
  }

  flush() {
    if (!this.waiting) return;
    this.sent = performance.now();
    this.socket.send({ do: "camera", eye: this.waiting });
    this.waiting = null;
  }

  // The picture of the last eye has been drawn.
  arrived() {
    if (this.sent === 0) return;
    this.latency.push(performance.now() - this.sent);
    if (this.latency.length > 200) this.latency.shift();
    this.sent = 0;
    this.flush();
  }
}
