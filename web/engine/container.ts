import { UnreadableModel } from "./errors.ts";

/** The container of model files: safetensors layout, a JSON header and raw little-endian arrays. */

interface Entry {
  dtype: string;
  shape: number[];
  data_offsets: [number, number];
}

const ITEM_BYTES: Record<string, number> = { F64: 8, F32: 4, I32: 4, I16: 2, U8: 1 };

function isObject(value: unknown): value is Record<string, unknown> {
  return typeof value === "object" && value !== null && !Array.isArray(value);
}

/** Whether this is the entry of an array whose size is that of its type and shape. */
function isEntry(value: unknown): value is Entry {
  if (!isObject(value)) return false;
  const { dtype, shape, data_offsets: ends } = value;
  const counts = (list: unknown): list is number[] =>
    Array.isArray(list) && list.every((n) => Number.isSafeInteger(n) && n >= 0);
  if (typeof dtype !== "string" || !counts(shape) || !counts(ends) || ends.length !== 2) return false;
  return ends[1] - ends[0] === shape.reduce((product, n) => product * n, 1) * (ITEM_BYTES[dtype] ?? NaN);
}

/** Arrays and header of a file. */
export class Container {
  readonly header: Record<string, string>;
  readonly #bytes: ArrayBuffer;
  readonly #start: number;
  readonly #entries: Map<string, Entry>;

  /** Throws UnreadableModel if these bytes are not a complete container. */
  constructor(bytes: ArrayBuffer) {
    const broken = (why: string) =>
      new UnreadableModel(`This is not a complete Snapspace model (${why}). Copy or build it again.`);
    if (bytes.byteLength < 8) throw broken("it has fewer than 8 bytes");
    const size = Number(new DataView(bytes).getBigUint64(0, true));
    if (size > bytes.byteLength - 8) throw broken("its header is cut off or is none");
    let parsed: Record<string, unknown>;
    try {
      const text = new TextDecoder("utf-8", { fatal: true }).decode(new Uint8Array(bytes, 8, size));
      parsed = JSON.parse(text) as Record<string, unknown>;
    } catch {
      throw broken("its header is not JSON");
    }
    if (!isObject(parsed)) throw broken("its header is not an object");
    const metadata = parsed["__metadata__"] ?? {};
    if (!isObject(metadata)) throw broken("its metadata is not an object");
    this.header = metadata as Record<string, string>;
    this.#bytes = bytes;
    this.#start = 8 + size;
    this.#entries = new Map();
    for (const [name, entry] of Object.entries(parsed)) {
      if (name === "__metadata__") continue;
      if (!isEntry(entry) || this.#start + entry.data_offsets[1] > bytes.byteLength)
        throw broken(`the array '${name}' is cut off or of an unknown type`);
      this.#entries.set(name, entry);
    }
  }

  has(name: string): boolean {
    return this.#entries.has(name);
  }

  /** The shape of an array; `axes` is how many it must have. */
  shape(name: string, axes: number): number[] {
    const { shape } = this.#entry(name);
    if (shape.length !== axes)
      throw new UnreadableModel(`The model's array '${name}' has ${shape.length} axes and not ${axes}.`);
    return shape;
  }

  /** Numbers of an array in double precision, whichever it is stored in; `shape` is what it must be. */
  doubles(name: string, ...shape: number[]): Float64Array<ArrayBuffer> {
    const entry = this.#checked(name, shape, ["F64", "F32"]);
    return entry.dtype === "F64"
      ? this.#view(entry, Float64Array)
      : Float64Array.from(this.#view(entry, Float32Array));
  }

  floats(name: string, ...shape: number[]): Float32Array<ArrayBuffer> {
    return this.#view(this.#checked(name, shape, ["F32"]), Float32Array);
  }

  shorts(name: string, ...shape: number[]): Int16Array<ArrayBuffer> {
    return this.#view(this.#checked(name, shape, ["I16"]), Int16Array);
  }

  /** Bytes of an array; without a shape it must have one axis. */
  bytes(name: string, ...shape: number[]): Uint8Array<ArrayBuffer> {
    const asked = shape.length > 0 ? shape : this.shape(name, 1);
    return this.#view(this.#checked(name, asked, ["U8"]), Uint8Array);
  }

  /** Indices, which must be at least `lowest` and below `count`. */
  indices(name: string, count: number, shape: number[], lowest = 0): Int32Array<ArrayBuffer> {
    const values = this.#view(this.#checked(name, shape, ["I32"]), Int32Array);
    const bad = values.findIndex((value) => value < lowest || value >= count);
    if (bad >= 0)
      throw new UnreadableModel(
        `The model's array '${name}' has ${values[bad]} at ${bad}, but it must be below ${count}. Build it again.`,
      );
    return values;
  }

  #entry(name: string): Entry {
    const entry = this.#entries.get(name);
    if (!entry) throw new UnreadableModel(`The model's array '${name}' is missing. Build it again.`);
    return entry;
  }

  #checked(name: string, shape: number[], dtypes: string[]): Entry {
    const entry = this.#entry(name);
    if (String(entry.shape) !== String(shape) || !dtypes.includes(entry.dtype))
      throw new UnreadableModel(
        `The model's array '${name}' is ${entry.dtype} (${entry.shape}), not ${dtypes[0]} (${shape}). Build it again.`,
      );
    return entry;
  }

  #view<T>(entry: Entry, type: { new (bytes: ArrayBuffer): T }): T {
    // a copy: views need addresses that are multiples of the item
    return new type(
      this.#bytes.slice(this.#start + entry.data_offsets[0], this.#start + entry.data_offsets[1]),
    );
  }
}
