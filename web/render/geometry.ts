import type { Graphics } from "./graphics.ts";

/** The attributes that shaders may read. Each has the same place in all programs. */
export const ATTRIBUTES = ["position", "vertexColor", "uv", "ownVertex", "ownRing"] as const;
export type AttributeName = (typeof ATTRIBUTES)[number];

/** Numbers of all vertices; whole numbers stay whole. */
export interface Attribute {
  data: Float32Array<ArrayBuffer> | Int32Array<ArrayBuffer>;
  /** Numbers of a vertex. */
  readonly size: number;
}

/** Vertices with attributes, and which of them are drawn in which order. */
export class Geometry {
  readonly attributes: Readonly<Partial<Record<AttributeName, Attribute>>>;
  readonly indices: Uint32Array<ArrayBuffer>;
  #graphics: Graphics | null = null;
  #generation = -1;
  #vertices: WebGLVertexArrayObject | null = null;
  readonly #buffers = new Map<string, WebGLBuffer>();
  readonly #changed = new Set<AttributeName>();

  constructor(attributes: Partial<Record<AttributeName, Attribute>>, indices: Uint32Array<ArrayBuffer>) {
    [this.attributes, this.indices] = [attributes, indices];
  }

  /** Sends an attribute again before the next picture. */
  changed(name: AttributeName): void {
    this.#changed.add(name);
  }

  /** Binds it, and sends what has changed. */
  bind(graphics: Graphics): void {
    const { gl } = graphics;
    if (this.#generation !== graphics.generation) return this.#make(graphics);
    gl.bindVertexArray(this.#vertices);
    for (const name of this.#changed) this.#send(gl, name);
    this.#changed.clear();
  }

  dispose(): void {
    const { gl, generation } = this.#graphics ?? {};
    if (gl && this.#generation === generation) {
      gl.deleteVertexArray(this.#vertices);
      for (const buffer of this.#buffers.values()) gl.deleteBuffer(buffer);
    }
    this.#generation = -1;
  }

  #make(graphics: Graphics): void {
    const { gl } = graphics;
    [this.#graphics, this.#generation] = [graphics, graphics.generation];
    this.#vertices = gl.createVertexArray();
    this.#buffers.clear();
    this.#changed.clear();
    gl.bindVertexArray(this.#vertices);
    ATTRIBUTES.forEach((name, place) => {
      const attribute = this.attributes[name];
      if (!attribute) return;
      this.#send(gl, name);
      gl.enableVertexAttribArray(place);
      if (attribute.data instanceof Int32Array) gl.vertexAttribIPointer(place, attribute.size, gl.INT, 0, 0);
      else gl.vertexAttribPointer(place, attribute.size, gl.FLOAT, false, 0, 0);
    });
    gl.bindBuffer(gl.ELEMENT_ARRAY_BUFFER, this.#bufferOf(gl, "indices"));
    gl.bufferData(gl.ELEMENT_ARRAY_BUFFER, this.indices, gl.STATIC_DRAW);
  }

  #send(gl: WebGL2RenderingContext, name: AttributeName): void {
    gl.bindBuffer(gl.ARRAY_BUFFER, this.#bufferOf(gl, name));
    gl.bufferData(gl.ARRAY_BUFFER, this.attributes[name]!.data, gl.STATIC_DRAW);
  }

  #bufferOf(gl: WebGL2RenderingContext, name: string): WebGLBuffer {
    let buffer = this.#buffers.get(name);
    if (!buffer) this.#buffers.set(name, (buffer = gl.createBuffer()));
    return buffer;
  }
}
