import type { Container } from "./container.ts";
import { UnreadableModel } from "./errors.ts";
import type { Cubature } from "./model.ts";

const MOST = 2 ** 31 - 1;

/** Rows of local coordinates (LocalRows of the Python package); null if a cubature has none. */
export function readLocalRows(
  container: Container,
  tets: number,
  dimension: number,
): Pick<Cubature, "rows" | "clusters"> | null {
  if (!container.has("cubature_clusters")) return null;
  const [count] = container.shape("cubature_clusters", 2);
  const sizes = container.indices("cubature_clusters", MOST, [count, 2], 1);
  let [own, ranks, numbers] = [0, 0, 0];
  for (let c = 0; c < sizes.length; c += 2) {
    own += sizes[c];
    ranks += sizes[c + 1];
    numbers += 9 * sizes[c] * sizes[c + 1];
  }
  if (own !== tets) throw new UnreadableModel("The model's clusters do not fit its tets. Build it again.");
  return {
    rows: container.floats("cubature_local_rows", numbers),
    clusters: { sizes, modes: container.floats("cubature_local_modes", ranks, dimension) },
  };
}
