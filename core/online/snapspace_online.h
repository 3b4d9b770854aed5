#pragma once
/* The live solve of a reduced model, for programs in C or in languages that can call C.
 *
 * A session is made from the arrays of a .snapspace file (safetensors layout). It takes new handle
 * positions or pose weights, solves, and returns coordinates and vertices. No function throws,
 * prints, reads files or starts threads. Only the functions that create a session or set its probe,
 * and the first step in time, allocate memory; if there is none left, they end the program as C++
 * does. A session may be used by one thread at a time.
 *
 * All numbers are doubles unless declared otherwise, and all arrays are row-major. Functions return
 * 0, or one of the errors below; after an error the session is unchanged.
 */

#ifdef __cplusplus
extern "C" {
#endif

enum snapspace_error {
  SNAPSPACE_OK = 0,
  SNAPSPACE_BAD_ARGUMENT = -1,    /* a null pointer, a size or an option out of range */
  SNAPSPACE_NOT_FINITE = -2,      /* a number is NaN or infinite */
  SNAPSPACE_NOT_DEFINITE = -3,    /* the Hessian at tau is not definite: the model is damaged */
  SNAPSPACE_WRONG_KIND = -4,      /* offsets for a blending session, or weights for a posing one */
  SNAPSPACE_UNKNOWN_MATERIAL = -5 /* no density has this name */
};

enum snapspace_method { SNAPSPACE_NEWTON = 0, SNAPSPACE_BFGS = 1 };

enum snapspace_status {
  SNAPSPACE_CONVERGED = 0,
  SNAPSPACE_MAX_ITERATIONS = 1,
  SNAPSPACE_LINE_SEARCH_FAILED = 2, /* rounding does not resolve the tolerance */
  SNAPSPACE_ENERGY_NOT_FINITE = 3,  /* handles too far away for finite energies; q is unchanged */
  SNAPSPACE_MAX_EVALUATIONS = 4
};

typedef struct snapspace_session snapspace_session;

/* The basis of the shapes tau + sum_i q_i modes_i. It is read in place, so the arrays must outlive
 * the session. With vertices = 0 the session has coordinates only, and the pointers may be null. */
typedef struct snapspace_basis {
  int vertices;
  const double* tau;   /* 3 vertices */
  const double* modes; /* dimension x 3 vertices */
} snapspace_basis;

typedef struct snapspace_options {
  enum snapspace_method method;
  double tolerance;        /* of the termination tests; 1e-7 for posing, 1e-9 for blending */
  double value_scale;      /* unit of energy: 0.01 times the sum of mu * volume */
  double coordinate_scale; /* unit of q: 0.1 * diagonal * sqrt(volume) */
  int max_iterations;      /* limit for one solve, such as 300 */
  int max_evaluations;     /* limit for one solve, such as 500 */
} snapspace_options;

typedef struct snapspace_report {
  enum snapspace_status status;
  int iterations;
  int evaluations;
  double value;         /* reduced objective */
  double gradient_norm; /* of the gradient with respect to q */
} snapspace_report;

/* A posing session, at rest. Copies quartic (C(dimension + 4, 4)), K (dimension x dimension), L
 * (handles x dimension x 12) and S (handles x 4 x 4): the arrays quartic, handle_K, handle_L and
 * handle_S of a file. Returns null on an error, and sets *error to its code. */
snapspace_session* snapspace_create_posing(int dimension, int handles, const double* quartic,
                                           const double* K, const double* L, const double* S,
                                           const snapspace_basis* basis, int* error);

/* The material of tets. Moduli are energies per volume, and not negative. The elements of a shell,
 * triangles and hinges, count as tets; rows of their moduli are followed by numbers of the rest
 * shape, see core/material/shell.h, and core/material/shell_arap.h for the stars of an
 * as-rigid-as-possible surface. */
typedef struct snapspace_material {
  const char* kind;     /* name of the density, such as "stable-neo-hookean" */
  int count;            /* rows of moduli: 1 if all tets share them, or one per tet; for a shell,
                           one per element */
  const double* moduli; /* count x number of the density's moduli, in its order */
} snapspace_material;

/* Number of moduli of a density, or SNAPSPACE_UNKNOWN_MATERIAL. */
int snapspace_moduli(const char* kind);

/* Name of a modulus, counted from 0; null if there is none. */
const char* snapspace_modulus_name(const char* kind, int modulus);

/* The unit of energy of a body of tets with these volumes, for snapspace_options. */
int snapspace_value_scale(const snapspace_material* material, int tets, const double* volumes,
                          double* value_scale);

/* Clusters of a cubature's tets, one after the other, each with its own few coordinates: modes
 * times the coordinates of the session. An evaluation reads less memory with them. */
typedef struct snapspace_clusters {
  int count;          /* 0: there are none, and the pointers may be null */
  const int* sizes;   /* count x 2: numbers of tets, multiples of 8 except the last, and of local
                         coordinates (rank) */
  const float* modes; /* one cluster after the other, rank x dimension */
} snapspace_clusters;

/* The elastic energy as a weighted sum over few tets (cubature). rows (tets x 9 x dimension) map
 * coordinates to displacement gradients; entry 3 a + b of the second index is d u_a / d x_b. With
 * clusters they map local coordinates, one cluster after the other, tets x 9 x rank. weights (tets)
 * are the volumes that the tets represent. */
typedef struct snapspace_cubature {
  int tets;
  const float* rows;
  const double* weights;
  snapspace_material material;
  snapspace_clusters clusters;
} snapspace_cubature;

/* Computes the rows of a cubature of tets. points (tets x 4 x 3) are the corners of its tets at
 * rest, no tet without volume, and modes (tets x 4 x 3 x dimension) the displacements of the
 * corners. shell_moduli is null; or, for the elements of a shell, as below. */
int snapspace_displacement_rows(int tets, int dimension, const double* points, const double* modes,
                                const double* shell_moduli, float* rows);

/* Computes the rows of moduli of a shell's elements, with the numbers of their rest shapes:
 * elements x number of the density's moduli. points (elements x 4 x 3) are the corners at rest: for
 * a triangle, its corners with the last one twice; for a hinge, the ends of its edge and the other
 * corners of the triangles to its left and right. shell_moduli (elements x 3) are mu > 0 and lam of
 * plane stress, times thickness, and 0 for a triangle; 0, 0 and the bending stiffness for a hinge.
 * area_products is null; or, for a blend, it has for each hinge the geometric mean over all poses
 * of four times the product of both triangles' areas (elements), and points are those of pose 0. */
int snapspace_shell_moduli(const char* kind, int elements, const double* points,
                           const double* shell_moduli, const double* area_products, double* moduli);

/* A posing session with a cubature instead of a quartic; copies its arrays too. Its solves are
 * fastest with SNAPSPACE_BFGS, which continues a drag with the last frame's inverse Hessian. */
snapspace_session* snapspace_create_posing_cubature(int dimension, int handles,
                                                    const snapspace_cubature* cubature,
                                                    const double* K, const double* L,
                                                    const double* S, const snapspace_basis* basis,
                                                    int* error);

/* A blending session, at the mean shape. Reads quartics (poses x C(dimension + 4, 4)) in place, so
 * the array must outlive the session. */
snapspace_session* snapspace_create_blending(int dimension, int poses, const double* quartics,
                                             const snapspace_basis* basis, int* error);

/* A blending session with a cubature of tets, or of a shell's triangles and hinges, instead of
 * quartics; copies its arrays. rows and weights are those of pose 0. corners (poses x tets x 4 x 3)
 * are the cubature's tets in each pose, no tet without volume, and tau (tets x 4 x 3) are its tets
 * at the mean shape. If the sum of the density over poses collapses, as for stable neo-Hookean,
 * many poses are as fast as two. */
snapspace_session* snapspace_create_blending_cubature(int dimension, int poses,
                                                      const snapspace_cubature* cubature,
                                                      const double* corners, const double* tau,
                                                      const snapspace_basis* basis, int* error);

/* The blended energy of an as-rigid-as-possible surface, as a weighted sum over the stars of few
 * vertices, the same in all poses. In every pose a star has its own moduli and nine numbers: rows
 * times coordinates, added to origins, those at the mean shape. forms are symmetric matrices M for
 * what the stars leave of the energy of each pose, (q, 1)^T M (q, 1). */
typedef struct snapspace_stars {
  int poses;
  int stars;
  const float* rows;           /* poses x stars x 9 x dimension */
  const double* weights;       /* stars, the areas in pose 0 that they represent */
  snapspace_material material; /* "shell-arap", of poses x stars rows */
  const double* origins;       /* poses x stars x 9 */
  const double* forms;         /* poses x (dimension + 1) x (dimension + 1) */
} snapspace_stars;

/* A blending session of an as-rigid-as-possible surface; copies its arrays. Its solves are
 * fastest with SNAPSPACE_BFGS. */
snapspace_session* snapspace_create_blending_stars(int dimension, const snapspace_stars* stars,
                                                   const snapspace_basis* basis, int* error);

void snapspace_destroy(snapspace_session* session);

/* Sets the offsets [A - I | t] of all handles (handles x 3 x 4) about their centroids at rest.
 * Costs O(dimension * handles). */
int snapspace_set_offsets(snapspace_session* session, const double* offsets);

/* Sets the weights (poses) of a blending session. */
int snapspace_set_weights(snapspace_session* session, const double* weights);

/* Restricts solves to the first coordinates, 1 <= dimension <= that of the model. Leading
 * coordinates are kept; added ones are zero. */
int snapspace_set_dimension(snapspace_session* session, int dimension);
int snapspace_dimension(const snapspace_session* session);

/* Solves from the present coordinates. */
int snapspace_solve(snapspace_session* session, const snapspace_options* options,
                    snapspace_report* report);

/* The smallest curvature of the reduced objective at rest, or at the mean shape for equal weights.
 * The softest motion vibrates with frequency sqrt(curvature / density) / (2 pi). The first call
 * allocates memory. */
int snapspace_softest(snapspace_session* session, double* curvature);

/* A step in time of length dt, by implicit Euler: minimises the reduced objective + weight / 2
 * |q - target|^2, with weight = density / dt^2 > 0. target (dimension) are the coordinates that the
 * body would reach without forces: q + dt * velocity. report->value is the objective without the
 * last term, and *before is that at the coordinates before the step. The first call allocates
 * memory. */
int snapspace_step(snapspace_session* session, double weight, const double* target,
                   const snapspace_options* options, snapspace_report* report, double* before);

/* The reduced objective at coordinates q (dimension), for the current offsets or weights. The
 * session is unchanged. */
int snapspace_value(snapspace_session* session, const double* q, double* value);

/* Coordinates of the present shape (dimension). */
int snapspace_get_q(const snapspace_session* session, double* q);
int snapspace_set_q(snapspace_session* session, const double* q);

/* The present shape, x0 y0 z0 x1 ... (3 vertices). */
int snapspace_get_vertices(const snapspace_session* session, double* vertices);

/* The tets around some sampled vertices of the body. Their corners are numbered from 0; all arrays
 * of corners are in that order. */
typedef struct snapspace_probe {
  int corners;
  int tets;
  int rests; /* 1, or the number of poses of a blending session */
  int samples;
  int pins;                    /* number of sampled corners in handles; 0 for blending */
  const double* tau;           /* corners x 3 */
  const double* modes;         /* dimension x 3 corners */
  const double* rest_shapes;   /* rests x corners x 3, no tet without volume */
  const int* tet_corners;      /* tets x 4 */
  snapspace_material material; /* of these tets */
  const int* sampled;          /* samples */
  const double* weights;       /* samples, weights of the squared residuals there */
  const int* pinned;           /* pins */
  const int* pin_handles;      /* pins */
  const double* pulls;         /* pins, twice the weights of their springs */
  const double* arms;          /* pins x 3, from the centroid of the handle at rest */
} snapspace_probe;

/* The same for an as-rigid-as-possible surface, whose elements are stars. The gradient at a
 * sampled vertex is a linear function of the shape plus stress times vector, for each star around
 * it; with the nine numbers of each star and the linear functions in that order, a pose has
 * 9 stars + 3 samples numbers. */
typedef struct snapspace_star_probe {
  int stars;
  int rests; /* 1, or the number of poses of a blending session */
  int samples;
  int parts;                   /* pairs of a star and a sampled vertex */
  int pins;                    /* number of sampled vertices in handles; 0 for blending */
  const double* origins;       /* rests x numbers, at tau */
  const float* modes;          /* rests x dimension x numbers */
  snapspace_material material; /* "shell-arap", of rests x stars */
  const int* part_stars;       /* parts */
  const int* part_samples;     /* parts */
  const double* part_vectors;  /* rests x parts x 3 */
  const double* weights;       /* samples, weights of the squared residuals there */
  const int* pinned;           /* pins, which samples; the linear functions have their springs */
  const int* pin_handles;      /* pins */
  const double* pulls;         /* pins, twice the weights of their springs */
  const double* arms;          /* pins x 3, from the centroid of the handle at rest */
} snapspace_star_probe;

/* Set the data that snapspace_residual needs. They copy all arrays and allocate memory. */
int snapspace_set_probe(snapspace_session* session, const snapspace_probe* probe);
int snapspace_set_star_probe(snapspace_session* session, const snapspace_star_probe* probe);

/* sqrt(sum_v weight_v |g_v|^2) over the sampled vertices v, with the gradient g of the full
 * objective at the present shape, for the current offsets or weights. SNAPSPACE_WRONG_KIND before a
 * probe is set. */
int snapspace_residual(snapspace_session* session, double* residual);

#ifdef __cplusplus
}
#endif
