/** A surface as a binary PLY file, little-endian. Vertices keep their numbers. */
export function plyFile(vertices: Float32Array, faces: Uint32Array): Uint8Array<ArrayBuffer> {
  const [vertexCount, faceCount] = [vertices.length / 3, faces.length / 3];
  const header = new TextEncoder().encode(
    `ply
format binary_little_endian 1.0
comment written by Snapspace
element vertex ${vertexCount}
property float x
property float y
property float z
element face ${faceCount}
property list uchar int vertex_indices
end_header
`,
  );
  const bytes = new Uint8Array(header.length + 12 * vertexCount + 13 * faceCount);
  bytes.set(header);
  const view = new DataView(bytes.buffer);
  let at = header.length;
  for (const x of vertices) {
    view.setFloat32(at, x, true);
    at += 4;
  }
  for (let i = 0; i < faces.length; i += 3) {
    view.setUint8(at, 3);
    for (let corner = 0; corner < 3; corner++) view.setInt32(at + 1 + 4 * corner, faces[i + corner], true);
    at += 13;
  }
  return bytes;
}
