import { readAppearance, type Appearance } from "./appearance.ts";
import { Container } from "./container.ts";
import { UnreadableModel } from "./errors.ts";

/** A mesh to choose handles on. */
export interface RestMesh {
  readonly name: string;
  /** Axis that points up at first. */
  readonly up: "x" | "y" | "z";
  readonly diagonal: number;
  /** Vertices to choose from: of the user's surface, or all of the tets, those inside too. x0 y0 z0 x1 ... */
  readonly shape: Float32Array<ArrayBuffer>;
  /** Triangles of the surface, outward. */
  readonly faces: Uint32Array<ArrayBuffer>;
  /** The user's own materials; null for tets, and for surfaces without any. */
  readonly appearance: Appearance | null;
}

/** Reads what the server sends of a mesh; UnreadableModel for anything else. */
export function readMesh(bytes: ArrayBuffer): RestMesh {
  const container = new Container(bytes);
  if (container.header["kind"] !== "mesh")
    throw new UnreadableModel("The server sent something that is not a mesh. Load the page again.");
  const about = JSON.parse(container.header["about"]);
  const [count] = container.shape("vertices", 2);
  const [faceCount] = container.shape("faces", 2);
  return {
    name: String(about.name),
    up: about.up,
    diagonal: Number(about.diagonal),
    shape: container.floats("vertices", count, 3),
    faces: Uint32Array.from(container.indices("faces", count, [faceCount, 3])),
    appearance: readAppearance(container, about.appearance, count),
  };
}
