// Draws the 3D map by WebGL: the points of each submap from a buffer that is filled once, and lines. Throws where WebGL
// or its memory fails.
import { inFrame, poseMatrix, product } from './matrices.js';

/** Bridges the distance of neighbours in a map of 2 cm; as in rendering/surface_layer.cpp. */
const kDisc = { diameter_m: 0.035, most_px: 32 };
/** Noisy points are four times as far apart. */
const kNoisyDisc = { diameter_m: 0.14, most_px: 128 };

const kPointVertex = `
attribute vec3 steps, normal, color;
uniform mat4 clip_from_submap, map_from_submap;
uniform vec3 eye;
uniform float step, disc_px, most_px, by_normal;
varying vec3 shown;
void main() {
  vec3 position = step * steps;
  gl_Position = clip_from_submap * vec4(position, 1.0);
  gl_PointSize = clamp(disc_px / gl_Position.w, 1.0, most_px);
  shown = mix(color, 0.5 + 0.5 * mat3(map_from_submap) * normal, by_normal);
  if (dot(position - eye, normal) > 0.0) gl_Position = vec4(2.0, 2.0, 2.0, 1.0);
}`;
const kPointFragment = `
precision mediump float;
varying vec3 shown;
void main() {
  vec2 from = gl_PointCoord - 0.5;
  if (dot(from, from) > 0.27) discard;
  gl_FragColor = vec4(shown, 1.0);
}`;
const kLineVertex = `
attribute vec3 position;
uniform mat4 clip_from_map;
void main() { gl_Position = clip_from_map * vec4(position, 1.0); }`;
const kLineFragment = `
precision mediump float;
uniform vec4 color;
void main() { gl_FragColor = color; }`;

function program(gl, vertex, fragment) {
  const made = gl.createProgram();
  for (const [type, source] of [[gl.VERTEX_SHADER, vertex], [gl.FRAGMENT_SHADER, fragment]]) {
    const shader = gl.createShader(type);
    gl.shaderSource(shader, source);
    gl.compileShader(shader);
    gl.attachShader(made, shader);
  }
  gl.linkProgram(made);
  if (!gl.getProgramParameter(made, gl.LINK_STATUS)) throw new Error(`WebGL: ${gl.getProgramInfoLog(made)}`);
  const names = (count, get, locate) => Object.fromEntries(Array.from({ length: gl.getProgramParameter(made, count) },
    (_, i) => get.call(gl, made, i).name).map((name) => [name, locate.call(gl, made, name)]));
  return {
    made,
    at: names(gl.ACTIVE_ATTRIBUTES, gl.getActiveAttrib, gl.getAttribLocation),
    uniform: names(gl.ACTIVE_UNIFORMS, gl.getActiveUniform, gl.getUniformLocation),
  };
}

export class Map3dGl {
  constructor(canvas) {
    const gl = canvas.getContext('webgl', { antialias: false, alpha: false, powerPreference: 'low-power' });
    if (!gl) throw new Error('there is no WebGL');
    Object.assign(this, { gl, canvas, buffers: new Map() });
    this.points = program(gl, kPointVertex, kPointFragment);
    this.lines = program(gl, kLineVertex, kLineFragment);
    this.lineBuffer = gl.createBuffer();
    gl.enable(gl.DEPTH_TEST);
    gl.blendFunc(gl.SRC_ALPHA, gl.ONE_MINUS_SRC_ALPHA);
  }

  /** Copies the points of a submap from `first` on to the graphics memory. */
  upload(number, submap, first) {
    const { gl } = this;
    const known = this.buffers.get(number) ?? { buffer: gl.createBuffer(), bytes: 0 };
    this.buffers.set(number, known);
    gl.bindBuffer(gl.ARRAY_BUFFER, known.buffer);
    if (known.bytes < submap.bytes.length || first === 0) {
      gl.bufferData(gl.ARRAY_BUFFER, submap.bytes, gl.STATIC_DRAW);
      known.bytes = submap.bytes.length;
    } else {
      gl.bufferSubData(gl.ARRAY_BUFFER, first * 12, submap.bytes.subarray(first * 12, submap.count * 12));
    }
    if (gl.getError() === gl.OUT_OF_MEMORY) throw new Error('the graphics memory is full');
  }

  /** The background as [r, g, b, a] from 0 to 1. */
  begin(background) {
    const { gl, canvas } = this;
    gl.viewport(0, 0, canvas.width, canvas.height);
    gl.clearColor(...background);
    gl.clear(gl.COLOR_BUFFER_BIT | gl.DEPTH_BUFFER_BIT);
  }

  /** `focal_px` in pixels of the canvas. */
  drawSubmaps(store, clipFromMap, eye, focal_px, byNormal) {
    const { gl, points: { made, at, uniform } } = this;
    gl.useProgram(made);
    gl.uniform1f(uniform.by_normal, byNormal ? 1 : 0);
    for (const name of ['steps', 'normal', 'color']) gl.enableVertexAttribArray(at[name]);
    for (const [number, submap] of store.submaps) {
      const pose = store.poses[number];
      if (!pose || submap.count === 0 || !this.buffers.has(number)) continue;
      const mapFromSubmap = poseMatrix(pose);
      gl.uniformMatrix4fv(uniform.clip_from_submap, false, product(clipFromMap, mapFromSubmap));
      gl.uniformMatrix4fv(uniform.map_from_submap, false, mapFromSubmap);
      gl.uniform3fv(uniform.eye, inFrame(mapFromSubmap, eye));
      gl.uniform1f(uniform.step, submap.step);
      const disc = number % 2 === 0 ? kDisc : kNoisyDisc;
      gl.uniform1f(uniform.disc_px, disc.diameter_m * focal_px);
      gl.uniform1f(uniform.most_px, disc.most_px);
      gl.bindBuffer(gl.ARRAY_BUFFER, this.buffers.get(number).buffer);
      gl.vertexAttribPointer(at.steps, 3, gl.SHORT, false, 12, 0);
      gl.vertexAttribPointer(at.normal, 3, gl.BYTE, true, 12, 6);
      gl.vertexAttribPointer(at.color, 3, gl.UNSIGNED_BYTE, true, 12, 9);
      gl.drawArrays(gl.POINTS, 0, submap.count);
    }
    for (const name of ['normal', 'color']) gl.disableVertexAttribArray(at[name]);
  }

  /** Draws [{points: flat x y z in the map, color: [r, g, b, a], pairs}]; what a surface hides is faint. */
  drawLines(lines, clipFromMap) {
    const { gl, lines: { made, at, uniform } } = this;
    gl.useProgram(made);
    gl.uniformMatrix4fv(uniform.clip_from_map, false, clipFromMap);
    gl.bindBuffer(gl.ARRAY_BUFFER, this.lineBuffer);
    gl.enableVertexAttribArray(at.position);
    gl.vertexAttribPointer(at.position, 3, gl.FLOAT, false, 0, 0);
    gl.enable(gl.BLEND);
    gl.depthMask(false);
    for (const { points, color: [red, green, blue, alpha], pairs } of lines) {
      gl.bufferData(gl.ARRAY_BUFFER, new Float32Array(points), gl.DYNAMIC_DRAW);
      for (const [depth, share] of [[gl.LEQUAL, 1], [gl.GREATER, 0.25]]) {
        gl.depthFunc(depth);
        gl.uniform4f(uniform.color, red, green, blue, alpha * share);
        gl.drawArrays(pairs ? gl.LINES : gl.LINE_STRIP, 0, points.length / 3);
      }
    }
    gl.depthFunc(gl.LEQUAL);
    gl.depthMask(true);
    gl.disable(gl.BLEND);
  }

  /** Returns when the picture is drawn. Reading a pixel waits for it; browsers let WebGL's own `finish` return at once. */
  finish() {
    const { gl } = this;
    gl.readPixels(0, 0, 1, 1, gl.RGBA, gl.UNSIGNED_BYTE, new Uint8Array(4));
  }

  /** Frees the memory at once instead of when the page collects it. */
  dispose() {
    for (const { buffer } of this.buffers.values()) this.gl.deleteBuffer(buffer);
    this.gl.getExtension('WEBGL_lose_context')?.loseContext();
  }
}
