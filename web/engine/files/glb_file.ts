import { vertexNormals } from "../vertex_normals.ts";

/** Quaternions x, y, z, w that turn an axis to y, which is up in glTF; as snapspace/gltf/write_glb.py. */
const TO_Y = { x: [0, 0, Math.SQRT1_2, Math.SQRT1_2], y: null, z: [-Math.SQRT1_2, 0, 0, Math.SQRT1_2] };
const [MAGIC, JSON_CHUNK, BINARY_CHUNK] = [0x46546c67, 0x4e4f534a, 0x004e4942];
const [FLOAT, UNSIGNED_INT, ARRAY, ELEMENTS] = [5126, 5125, 34962, 34963];

/** A surface as a binary glTF file, with smooth normals. Coordinates stay as they are; the node turns `up` to y. */
export function glbFile(
  vertices: Float32Array<ArrayBuffer>,
  faces: Uint32Array<ArrayBuffer>,
  up: keyof typeof TO_Y,
  name: string,
): Uint8Array<ArrayBuffer> {
  const normals = vertexNormals(vertices, faces);
  const parts = [vertices, normals, faces];
  const offsets = parts.map((_, i) => parts.slice(0, i).reduce((sum, part) => sum + part.byteLength, 0));
  const size = offsets[2] + faces.byteLength;
  const count = vertices.length / 3;
  const vectors = { componentType: FLOAT, type: "VEC3", count };
  const rotation = TO_Y[up];
  const description = {
    asset: { version: "2.0", generator: "Snapspace" },
    scene: 0,
    scenes: [{ nodes: [0] }],
    nodes: [{ name, mesh: 0, ...(rotation ? { rotation } : {}) }],
    meshes: [{ name, primitives: [{ attributes: { POSITION: 0, NORMAL: 1 }, indices: 2, material: 0 }] }],
    materials: [{ name: "clay", doubleSided: true, pbrMetallicRoughness: CLAY }],
    buffers: [{ byteLength: size }],
    bufferViews: parts.map((part, i) => ({
      buffer: 0,
      byteOffset: offsets[i],
      byteLength: part.byteLength,
      target: i < 2 ? ARRAY : ELEMENTS,
    })),
    accessors: [
      { bufferView: 0, ...vectors, ...bounds(vertices) },
      { bufferView: 1, ...vectors },
      { bufferView: 2, componentType: UNSIGNED_INT, type: "SCALAR", count: faces.length },
    ],
  };
  const text = new TextEncoder().encode(JSON.stringify(description));
  const padded = 4 * Math.ceil(text.length / 4);
  const bytes = new Uint8Array(28 + padded + size);
  const view = new DataView(bytes.buffer);
  const words = [MAGIC, 2, bytes.length, padded, JSON_CHUNK];
  words.forEach((word, i) => view.setUint32(4 * i, word, true));
  bytes.fill(0x20, 20, 20 + padded);
  bytes.set(text, 20);
  view.setUint32(20 + padded, size, true);
  view.setUint32(24 + padded, BINARY_CHUNK, true);
  parts.forEach((part, i) =>
    bytes.set(new Uint8Array(part.buffer, part.byteOffset, part.byteLength), 28 + padded + offsets[i]),
  );
  return bytes;
}

const CLAY = { baseColorFactor: [0.8, 0.76, 0.7, 1], metallicFactor: 0, roughnessFactor: 0.6 };

/** The least and the greatest coordinates, which the format wants. */
function bounds(vertices: Float32Array): { min: number[]; max: number[] } {
  const [min, max] = [Array<number>(3).fill(Infinity), Array<number>(3).fill(-Infinity)];
  vertices.forEach((x, i) => {
    min[i % 3] = Math.min(min[i % 3], x);
    max[i % 3] = Math.max(max[i % 3], x);
  });
  return { min, max };
}
