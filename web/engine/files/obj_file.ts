/** Digits of a coordinate: those of single precision. */
const DIGITS = 7;

/** A surface as the text of a Wavefront OBJ file. Vertices keep their numbers. */
export function objFile(vertices: Float32Array, faces: Uint32Array): string {
  const lines = ["# written by Snapspace"];
  for (let i = 0; i < vertices.length; i += 3)
    lines.push(`v ${short(vertices[i])} ${short(vertices[i + 1])} ${short(vertices[i + 2])}`);
  for (let i = 0; i < faces.length; i += 3)
    lines.push(`f ${faces[i] + 1} ${faces[i + 1] + 1} ${faces[i + 2] + 1}`);
  return `${lines.join("\n")}\n`;
}

const short = (x: number) => String(Number(x.toPrecision(DIGITS)));
