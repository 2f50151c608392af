"use strict";
// What the graphics card does: half floats to what is seen.

const VERTEX_SHADER = `#version 300 es
void main() {
  vec2 corner = vec2(gl_VertexID & 1, gl_VertexID >> 1);
  gl_Position = vec4(4.0 * corner - 1.0, 0.0, 1.0);
}`;

// "full": colour, and samples in its alpha, 0 where there are none yet; then "coarse" is
// seen, a whole picture of fewer pixels. "over" is a layer; where it is not known yet, as
// while the camera moves, one sees the picture in grey.
const FRAGMENT_SHADER = `#version 300 es
precision highp float;
uniform sampler2D full, coarse, over, ramp;
uniform vec2 pane, corner, middle, size;
uniform float zoom, gain, low, high;
uniform int curve, layer;
uniform vec3 around;
out vec4 seen;

vec3 encode(vec3 x) {
  x = clamp(x, 0.0, 1.0);
  return mix(12.92 * x, 1.055 * pow(x, vec3(1.0 / 2.4)) - 0.055, step(0.0031308, x));
}
vec3 onRamp(float t) {
  return texture(ramp, vec2((clamp(t, 0.0, 1.0) * 255.0 + 0.5) / 256.0, 0.5)).rgb;
}
vec3 toned(vec3 light) {
  vec3 x = max(light * gain, 0.0);
  if (curve == 1) x = x / (1.0 + x);
  if (curve == 2) { vec3 p = pow(x, vec3(1.3)); x = p / (p + 0.514); }
  return x;
}
float brightness(vec3 x) { return dot(x, vec3(0.2126, 0.7152, 0.0722)); }

void main() {
  vec2 here = vec2(gl_FragCoord.x, gl_FragCoord.y) - corner;
  vec2 at = middle + vec2(here.x - 0.5 * pane.x, 0.5 * pane.y - here.y) / zoom;
  if (at.x < 0.0 || at.y < 0.0 || at.x >= size.x || at.y >= size.y) {
    seen = vec4(around, 1.0);
    return;
  }
  ivec2 texel = ivec2(at);
  vec4 light = texelFetch(full, texel, 0);
  bool sampled = light.a > 0.0;
  float x = layer == 1 ? light.a : texelFetch(over, texel, 0).r;
  if (!sampled) light = texture(coarse, at / size);
  if (layer > 0) {
    bool known = sampled && x == x;
    float t = x > 0.0 ? (log2(x) - low) / max(high - low, 0.001) : 0.0;
    seen = vec4(known ? onRamp(t) : encode(vec3(brightness(toned(light.rgb)))), 1.0);
    return;
  }
  if (!(light.r == light.r && light.g == light.g && light.b == light.b)) {
    seen = vec4(1.0, 0.0, 0.78, 1.0);
    return;
  }
  vec3 shown = toned(light.rgb);
  if (curve == 3) {
    seen = vec4(onRamp((log2(max(brightness(shown), 1e-9)) + 6.0) / 12.0), 1.0);
    return;
  }
  seen = vec4(encode(shown), 1.0);
}`;

function compileShader(gl, type, text) {
  const shader = gl.createShader(type);
  gl.shaderSource(shader, text);
  gl.compileShader(shader);
  if (!gl.getShaderParameter(shader, gl.COMPILE_STATUS)) {
    throw new Error(gl.getShaderInfoLog(shader) || "the graphics driver does not respond");
  }
  return shader;
}

// {use(): the program is in use, set(name, values...)}.
function makeProgram(gl) {
  const program = gl.createProgram();
  gl.attachShader(program, compileShader(gl, gl.VERTEX_SHADER, VERTEX_SHADER));
  gl.attachShader(program, compileShader(gl, gl.FRAGMENT_SHADER, FRAGMENT_SHADER));
  gl.linkProgram(program);
  if (!gl.getProgramParameter(program, gl.LINK_STATUS)) {
    throw new Error(gl.getProgramInfoLog(program) || "the graphics driver does not respond");
  }
  const place = (name) => gl.getUniformLocation(program, name);
  return {
    use: () => gl.useProgram(program),
    number: (name, x) => gl.uniform1f(place(name), x),
    whole: (name, x) => gl.uniform1i(place(name), x),
    pair: (name, x, y) => gl.uniform2f(place(name), x, y),
    color: (name, [r, g, b]) => gl.uniform3f(place(name), r, g, b),
  };
}
