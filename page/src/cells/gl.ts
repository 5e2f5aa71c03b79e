// WebGL2: cells as shaded blocks, one instance each, and lines and points over them.

import type { Rgb } from "./colours.ts";
import type { Geometry, Shape } from "./geometry.ts";

const cellShader = `#version 300 es
layout(location = 0) in vec2 x;
layout(location = 1) in vec2 y;
layout(location = 2) in vec2 z;
layout(location = 3) in vec3 colour;
uniform mat4 camera;
uniform mat3 rotation;
uniform vec3 origin;
uniform int shape;
uniform float shrink;
flat out vec3 tint;
flat out int instance;
out vec3 at;
const int corners[36] = int[](0, 1, 3, 0, 3, 2, 4, 6, 7, 4, 7, 5, 0, 4, 5, 0, 5, 1, 2, 3, 7, 2, 7, 6, 0, 2, 6, 0, 6, 4, 1, 5, 7, 1, 7, 3);
void main() {
  int corner = corners[gl_VertexID];
  vec3 share = mix(vec3(0.5), vec3(corner & 1, corner >> 1 & 1, corner >> 2), shrink);
  vec3 p = vec3(mix(x.x, x.y, share.x), mix(y.x, y.y, share.y), mix(z.x, z.y, share.z));
  if (shape == 0) at = vec3(p.xy * p.z, -p.z);
  else if (shape == 1) at = normalize(vec3(p.xy, -1.0)) * p.z;
  else at = rotation * (p - origin);
  tint = colour;
  instance = gl_InstanceID + 1;
  gl_Position = camera * vec4(at, 1.0);
}`;

// The number of the instance for picking, or its colour, darker where it is seen from the side.
const cellPainter = `#version 300 es
precision highp float;
flat in vec3 tint;
flat in highp int instance;
in vec3 at;
uniform bool picks;
uniform vec3 backward;
out vec4 painted;
void main() {
  float facing = abs(dot(normalize(cross(dFdx(at), dFdy(at))), backward));
  painted = vec4(tint * (0.6 + 0.4 * facing), 1.0);
  if (picks) painted = vec4(vec3(ivec3(instance, instance >> 8, instance >> 16) & 255) / 255.0, 1.0);
}`;

const lineShader = `#version 300 es
layout(location = 0) in vec3 at;
uniform mat4 camera;
uniform float size;
void main() {
  gl_Position = camera * vec4(at, 1.0);
  gl_PointSize = size;
}`;

const linePainter = `#version 300 es
precision highp float;
uniform vec4 colour;
uniform bool round;
out vec4 painted;
void main() {
  if (round && distance(gl_PointCoord, vec2(0.5)) > 0.5) discard;
  painted = vec4(colour.rgb * colour.a, colour.a);
}`;

export interface Strokes {
  positions: number[]; // x y z, two by two for lines
  kind: "lines" | "points";
  colour: Rgb;
  opacity: number;
  inFront?: boolean; // of everything
}

const shapes: Record<Shape, number> = { slopes: 0, shells: 1, box: 2 };

function program(gl: WebGL2RenderingContext, vertex: string, fragment: string): WebGLProgram {
  const made = gl.createProgram();
  for (const [type, source] of [
    [gl.VERTEX_SHADER, vertex],
    [gl.FRAGMENT_SHADER, fragment],
  ] as const) {
    const shader = gl.createShader(type)!;
    gl.shaderSource(shader, source);
    gl.compileShader(shader);
    gl.attachShader(made, shader);
  }
  gl.linkProgram(made);
  if (!gl.getProgramParameter(made, gl.LINK_STATUS) && !gl.isContextLost())
    throw new Error(`shader: ${gl.getProgramInfoLog(made)}`);
  return made;
}

// Cells as instances: blocks of six numbers, colours of three.
export interface Cells {
  geometry: Geometry;
  blocks: Float32Array;
  colours: Uint8Array;
  shrink: number;
}

export class Painter {
  private readonly cellProgram: WebGLProgram;
  private readonly lineProgram: WebGLProgram;
  private readonly cellArray: WebGLVertexArrayObject;
  private readonly lineArray: WebGLVertexArrayObject;
  private readonly blocks: WebGLBuffer;
  private readonly colours: WebGLBuffer;
  private readonly positions: WebGLBuffer;
  private cells: Cells | null = null;

  constructor(private readonly gl: WebGL2RenderingContext) {
    this.cellProgram = program(gl, cellShader, cellPainter);
    this.lineProgram = program(gl, lineShader, linePainter);
    this.cellArray = gl.createVertexArray();
    this.lineArray = gl.createVertexArray();
    [this.blocks, this.colours, this.positions] = [gl.createBuffer(), gl.createBuffer(), gl.createBuffer()];
    gl.bindVertexArray(this.cellArray);
    gl.bindBuffer(gl.ARRAY_BUFFER, this.blocks);
    for (const at of [0, 1, 2]) this.attribute(at, 2, gl.FLOAT, 24, 8 * at, 1);
    gl.bindBuffer(gl.ARRAY_BUFFER, this.colours);
    this.attribute(3, 3, gl.UNSIGNED_BYTE, 3, 0, 1);
    gl.bindVertexArray(this.lineArray);
    gl.bindBuffer(gl.ARRAY_BUFFER, this.positions);
    this.attribute(0, 3, gl.FLOAT, 12, 0, 0);
  }

  private attribute(at: number, count: number, type: number, stride: number, offset: number, divisor: number): void {
    const { gl } = this;
    gl.enableVertexAttribArray(at);
    gl.vertexAttribPointer(at, count, type, type === gl.UNSIGNED_BYTE, stride, offset);
    gl.vertexAttribDivisor(at, divisor);
  }

  setCells(cells: Cells): void {
    const { gl } = this;
    this.cells = cells;
    gl.bindBuffer(gl.ARRAY_BUFFER, this.blocks);
    gl.bufferData(gl.ARRAY_BUFFER, cells.blocks, gl.STATIC_DRAW);
    gl.bindBuffer(gl.ARRAY_BUFFER, this.colours);
    gl.bufferData(gl.ARRAY_BUFFER, cells.colours, gl.STATIC_DRAW);
  }

  private paintCells(camera: Float32Array, backward: number[], picks: boolean): void {
    if (!this.cells) return;
    const { gl, cellProgram: used, cells } = this;
    const { geometry } = cells;
    const uniform = (name: string) => gl.getUniformLocation(used, name);
    gl.useProgram(used);
    gl.uniformMatrix4fv(uniform("camera"), false, camera);
    gl.uniformMatrix3fv(uniform("rotation"), true, geometry.rotation.flat());
    gl.uniform3fv(uniform("origin"), geometry.origin);
    gl.uniform3fv(uniform("backward"), backward);
    gl.uniform1i(uniform("shape"), shapes[geometry.shape]);
    gl.uniform1f(uniform("shrink"), cells.shrink);
    gl.uniform1i(uniform("picks"), Number(picks));
    gl.bindVertexArray(this.cellArray);
    gl.drawArraysInstanced(gl.TRIANGLES, 0, 36, cells.blocks.length / 6);
  }

  private paintStrokes(camera: Float32Array, strokes: Strokes, pixels: number): void {
    const { gl, lineProgram: used } = this;
    const uniform = (name: string) => gl.getUniformLocation(used, name);
    gl.useProgram(used);
    gl.uniformMatrix4fv(uniform("camera"), false, camera);
    gl.uniform4fv(uniform("colour"), [...strokes.colour.map((channel) => channel / 255), strokes.opacity]);
    gl.uniform1f(uniform("size"), 5 * pixels);
    gl.uniform1i(uniform("round"), Number(strokes.kind === "points"));
    gl.bindVertexArray(this.lineArray);
    gl.bindBuffer(gl.ARRAY_BUFFER, this.positions);
    gl.bufferData(gl.ARRAY_BUFFER, new Float32Array(strokes.positions), gl.STREAM_DRAW);
    gl.drawArrays(strokes.kind === "points" ? gl.POINTS : gl.LINES, 0, strokes.positions.length / 3);
  }

  private begin(): void {
    const { gl } = this;
    gl.viewport(0, 0, gl.drawingBufferWidth, gl.drawingBufferHeight);
    gl.clearColor(0, 0, 0, 0);
    gl.enable(gl.DEPTH_TEST);
    gl.clear(gl.COLOR_BUFFER_BIT | gl.DEPTH_BUFFER_BIT);
  }

  // `pixels`: device pixels per CSS pixel.
  paint(camera: Float32Array, backward: number[], strokes: Strokes[], pixels: number): void {
    const { gl } = this;
    this.begin();
    gl.disable(gl.BLEND);
    this.paintCells(camera, backward, false);
    gl.enable(gl.BLEND);
    gl.blendFunc(gl.ONE, gl.ONE_MINUS_SRC_ALPHA);
    for (const stroke of strokes) {
      if (stroke.inFront) gl.disable(gl.DEPTH_TEST);
      this.paintStrokes(camera, stroke, pixels);
      gl.enable(gl.DEPTH_TEST);
    }
  }

  // Which of the cells is seen at a pixel from the bottom left; -1: none. Leaves the picture to be painted again.
  pick(camera: Float32Array, x: number, y: number): number {
    const { gl } = this;
    this.begin();
    gl.disable(gl.BLEND);
    this.paintCells(camera, [0, 0, 1], true);
    const seen = new Uint8Array(4);
    gl.readPixels(x, y, 1, 1, gl.RGBA, gl.UNSIGNED_BYTE, seen);
    return seen[0]! + (seen[1]! << 8) + (seen[2]! << 16) - 1;
  }
}
