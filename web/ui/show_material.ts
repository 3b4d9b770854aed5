import type { Stage } from "./stage.ts";
import type { Surface } from "./surface.ts";

/** Shows surfaces in the user's own materials once their textures are there, unless they show a number by then. The list may
 * change meanwhile. */
export async function showMaterial(stage: Stage, surfaces: readonly Surface[]): Promise<boolean> {
  const { look } = surfaces[0];
  if (!look) return false;
  await look.ready;
  if (surfaces[0].colors !== "own" || !surfaces[0].object.parent) return false;
  for (const surface of surfaces) surface.colors = "material";
  stage.draw();
  return true;
}
