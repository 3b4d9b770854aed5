/** Mean value coordinates of a point in a convex polygon (Floater 2003): weights, not negative, that sum to one and
 * whose combination of the corners is the point. At a corner or on an edge they are the linear ones. */
export function meanValueCoordinates(
  corners: readonly (readonly [number, number])[],
  x: number,
  y: number,
): number[] {
  const count = corners.length;
  const away = corners.map(([cx, cy]) => [cx - x, cy - y] as const);
  const lengths = away.map(([ax, ay]) => Math.hypot(ax, ay));
  const near = lengths.findIndex((length) => length < 1e-9);
  if (near >= 0) return corners.map((_, i) => (i === near ? 1 : 0));
  const halves: number[] = []; // tangents of half the angle that each edge is seen under
  for (let i = 0; i < count; i++) {
    const j = (i + 1) % count;
    const cross = away[i][0] * away[j][1] - away[i][1] * away[j][0];
    const dot = away[i][0] * away[j][0] + away[i][1] * away[j][1];
    if (Math.abs(cross) < 1e-9 * lengths[i] * lengths[j] && dot < 0) {
      const total = lengths[i] + lengths[j];
      return corners.map((_, k) => (k === i ? lengths[j] / total : k === j ? lengths[i] / total : 0));
    }
    halves.push(cross / (lengths[i] * lengths[j] + dot));
  }
  const weights = lengths.map((length, i) => (halves[(i + count - 1) % count] + halves[i]) / length);
  return normalised(weights.map((w) => Math.max(w, 0)));
}

/** Divided by their sum. */
export function normalised(weights: readonly number[]): number[] {
  const total = weights.reduce((sum, w) => sum + w, 0);
  return weights.map((w) => w / total);
}

/** Weights with one of them changed and the others scaled so that the sum stays one; they may be negative. */
export function withWeight(weights: readonly number[], changed: number, value: number): number[] {
  const others = 1 - weights[changed];
  const left = 1 - value;
  return normalised(
    weights.map((w, i) =>
      i === changed ? value : Math.abs(others) > 1e-9 ? (w * left) / others : left / (weights.length - 1),
    ),
  );
}

/** Corners of a regular polygon in the unit circle, the first at the top, clockwise on a screen; two lie on a line. */
export function regularPolygon(count: number): [number, number][] {
  if (count === 2)
    return [
      [-1, 0],
      [1, 0],
    ];
  return Array.from({ length: count }, (_, i) => {
    const angle = (2 * Math.PI * i) / count - Math.PI / 2;
    return [Math.cos(angle), Math.sin(angle)];
  });
}

/** The point of a convex polygon (corners clockwise on a screen) that is closest to one. */
export function clampedInto(
  corners: readonly (readonly [number, number])[],
  x: number,
  y: number,
): [number, number] {
  let best: [number, number] = [x, y];
  let least = Infinity;
  let inside = corners.length > 2;
  corners.forEach(([ax, ay], i) => {
    const [bx, by] = corners[(i + 1) % corners.length];
    const [ex, ey] = [bx - ax, by - ay];
    if (ex * (y - ay) - ey * (x - ax) < 0) inside = false;
    const t = Math.min(Math.max(((x - ax) * ex + (y - ay) * ey) / (ex * ex + ey * ey), 0), 1);
    const point: [number, number] = [ax + t * ex, ay + t * ey];
    const away = Math.hypot(point[0] - x, point[1] - y);
    if (away < least) [best, least] = [point, away];
  });
  return inside ? [x, y] : best;
}
