import {
  DoubleSide,
  MeshBasicMaterial,
  MeshDepthMaterial,
  MeshStandardMaterial,
  RGBADepthPacking,
} from "three";

/** Clay in the colours of the vertices. */
export function clay(): MeshStandardMaterial {
  return new MeshStandardMaterial({ vertexColors: true, roughness: 0.58, metalness: 0, side: DoubleSide });
}

/** What shadows are made with. */
export function depths(): MeshDepthMaterial {
  return new MeshDepthMaterial({ depthPacking: RGBADepthPacking, side: DoubleSide });
}

/** The edges of faces, in front of them. */
export function wires(): MeshBasicMaterial {
  const material = new MeshBasicMaterial({
    wireframe: true,
    color: 0x10141c,
    transparent: true,
    opacity: 0.22,
  });
  material.polygonOffset = true;
  material.polygonOffsetFactor = -1;
  return material;
}
