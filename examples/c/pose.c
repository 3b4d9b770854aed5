/* Poses a Snapspace model without Python: moves its last handle and prints the vertices.
 *
 *   pose creature.arrays 0.1 0 0.2
 */
#include <stdio.h>
#include <stdlib.h>

#include "online/snapspace_online.h"

static double* read_doubles(FILE* file, size_t count) {
  double* values = malloc(count * sizeof *values);
  if (!values || fread(values, sizeof *values, count, file) != count) {
    fprintf(stderr, "pose: the file of arrays is incomplete\n");
    exit(2);
  }
  return values;
}

int main(int argc, char** argv) {
  if (argc != 5) {
    fprintf(stderr, "usage: pose FILE.arrays X Y Z\n");
    return 2;
  }
  FILE* file = fopen(argv[1], "rb");
  int sizes[3]; /* dimension, handles, vertices */
  if (!file || fread(sizes, sizeof *sizes, 3, file) != 3) {
    fprintf(stderr, "pose: %s cannot be read; export_arrays.py writes it\n", argv[1]);
    return 2;
  }
  const size_t d = sizes[0], handles = sizes[1], n = sizes[2];
  const size_t terms = (d + 1) * (d + 2) * (d + 3) * (d + 4) / 24;
  double* scales = read_doubles(file, 2);
  double* quartic = read_doubles(file, terms);
  double* K = read_doubles(file, d * d);
  double* L = read_doubles(file, handles * d * 12);
  double* S = read_doubles(file, handles * 16);
  double* tau = read_doubles(file, 3 * n);
  double* modes = read_doubles(file, d * 3 * n);
  fclose(file);

  /* The session reads tau and modes in place, and copies the other arrays. */
  const snapspace_basis basis = {sizes[2], tau, modes};
  int error = 0;
  snapspace_session* session =
      snapspace_create_posing(sizes[0], sizes[1], quartic, K, L, S, &basis, &error);
  if (!session) {
    fprintf(stderr, "pose: the model was rejected with error %d\n", error);
    return 2;
  }

  /* Offsets [R - I | t], 3 x 4 for each handle: here only a translation of the last one. */
  double* offsets = calloc(12 * handles, sizeof *offsets);
  for (int axis = 0; axis < 3; ++axis)
    offsets[12 * (handles - 1) + 4 * axis + 3] = atof(argv[2 + axis]);
  const snapspace_options options = {SNAPSPACE_NEWTON, 1e-7, scales[0], scales[1], 300, 500};
  snapspace_report report;
  if (snapspace_set_offsets(session, offsets) || snapspace_solve(session, &options, &report) ||
      report.status != SNAPSPACE_CONVERGED) {
    fprintf(stderr, "pose: the solve did not converge\n");
    return 1;
  }

  double* vertices = malloc(3 * n * sizeof *vertices);
  snapspace_get_vertices(session, vertices);
  for (size_t i = 0; i < n; ++i)
    printf("v %.17g %.17g %.17g\n", vertices[3 * i], vertices[3 * i + 1], vertices[3 * i + 2]);

  snapspace_destroy(session);
  free(vertices), free(offsets), free(modes), free(tau), free(S), free(L), free(K);
  free(quartic), free(scales);
  return 0;
}
