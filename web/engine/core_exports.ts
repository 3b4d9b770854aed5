/** What web/generated/core.wasm exports: the functions of core/online/snapspace_online.h; pointers are numbers. */
export interface CoreExports {
  memory: WebAssembly.Memory;
  _initialize(): void;
  malloc(bytes: number): number;
  free(pointer: number): void;
  snapspace_create_posing(
    dimension: number,
    handles: number,
    quartic: number,
    K: number,
    L: number,
    S: number,
    basis: number,
    error: number,
  ): number;
  snapspace_create_posing_cubature(
    dimension: number,
    handles: number,
    cubature: number,
    K: number,
    L: number,
    S: number,
    basis: number,
    error: number,
  ): number;
  snapspace_create_blending(
    dimension: number,
    poses: number,
    quartics: number,
    basis: number,
    error: number,
  ): number;
  snapspace_destroy(session: number): void;
  snapspace_set_offsets(session: number, offsets: number): number;
  snapspace_set_weights(session: number, weights: number): number;
  snapspace_set_dimension(session: number, dimension: number): number;
  snapspace_dimension(session: number): number;
  snapspace_solve(session: number, options: number, report: number): number;
  snapspace_value(session: number, q: number, value: number): number;
  snapspace_get_q(session: number, q: number): number;
  snapspace_set_q(session: number, q: number): number;
}
