import type { CoreExports, Layout } from "./core_exports.ts";
import { UnreadableModel } from "./errors.ts";

type Numbers = Float64Array | Float32Array | Int32Array;
type Fields<L extends Layout> = Readonly<Record<keyof L["fields"], number>>;

/** Arguments in the memory of a core. */
export class CoreMemory {
  readonly #exports: CoreExports;
  #taken: number[] = [];

  constructor(exports: CoreExports) {
    this.#exports = exports;
  }

  /** Allocates bytes; throws UnreadableModel if the memory is used up. */
  take(bytes: number): number {
    const pointer = this.#exports.malloc(Math.max(bytes, 8));
    if (pointer === 0) throw new UnreadableModel("The browser does not have enough memory for this model.");
    this.#taken.push(pointer);
    return pointer;
  }

  /** A copy of an array. */
  numbers(values: Numbers): number {
    const pointer = this.take(values.byteLength);
    const { buffer, byteOffset, byteLength } = values;
    new Uint8Array(this.#exports.memory.buffer, pointer, byteLength).set(
      new Uint8Array(buffer, byteOffset, byteLength),
    );
    return pointer;
  }

  /** A text as a C string. */
  text(value: string): number {
    const bytes = new TextEncoder().encode(`${value}\0`);
    const pointer = this.take(bytes.length);
    new Uint8Array(this.#exports.memory.buffer, pointer, bytes.length).set(bytes);
    return pointer;
  }

  /** A text of the core. */
  readText(pointer: number): string {
    const bytes = new Uint8Array(this.#exports.memory.buffer, pointer);
    return new TextDecoder().decode(bytes.subarray(0, bytes.indexOf(0)));
  }

  struct<L extends Layout>(layout: L, values: Fields<L>): number {
    const pointer = this.take(layout.size);
    this.write(layout, pointer, values);
    return pointer;
  }

  write<L extends Layout>(layout: L, pointer: number, values: Fields<L>): void {
    const view = new DataView(this.#exports.memory.buffer, pointer, layout.size);
    for (const [name, [type, offset]] of Object.entries(layout.fields)) {
      const value = values[name as keyof L["fields"]];
      if (type === "int") view.setInt32(offset, value, true);
      else view.setFloat64(offset, value, true);
    }
  }

  read<L extends Layout>(layout: L, pointer: number): Fields<L> {
    const view = new DataView(this.#exports.memory.buffer, pointer, layout.size);
    const entries = Object.entries(layout.fields).map(([name, [type, offset]]) => [
      name,
      type === "int" ? view.getInt32(offset, true) : view.getFloat64(offset, true),
    ]);
    return Object.fromEntries(entries) as Fields<L>;
  }

  doubles(pointer: number, count: number): Float64Array {
    return new Float64Array(this.#exports.memory.buffer, pointer, count).slice();
  }

  /** Frees all that was allocated. */
  free(): void {
    this.#taken.forEach((pointer) => this.#exports.free(pointer));
    this.#taken = [];
  }
}
