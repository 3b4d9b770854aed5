import type { Choice } from "./choice.ts";
import type { PartChoice } from "./messages.ts";
import { NOTHING } from "./selecting.ts";

/** A part of the body that is stiffer or softer. */
export interface ChosenPart {
  /** Stays the same when the name changes. */
  readonly key: number;
  readonly name: string;
  /** Ascending. Other parts and handles may have them too; the last part that has a vertex counts. */
  readonly vertices: Int32Array;
  /** How many times as stiff it is. */
  readonly factor: number;
}

/** The range of factors that the server takes. */
export const FACTORS = { min: 1e-4, max: 1e4 };

export function partMessages(parts: readonly ChosenPart[]): PartChoice[] {
  return parts.map(({ name, vertices, factor }) => ({ name, vertices: [...vertices], factor }));
}

/** The selected vertices become a part. */
export function withNewPart(choice: Choice, factor: number): Choice {
  const { selected, parts } = choice;
  const key = 1 + Math.max(-1, ...parts.map((part) => part.key));
  const own = { key, name: freeName(parts, factor), vertices: selected, factor };
  return { ...choice, selected: NOTHING, parts: [...parts, own] };
}

export function changedPart(choice: Choice, key: number, fields: Partial<ChosenPart>): Choice {
  return { ...choice, parts: choice.parts.map((part) => (part.key === key ? { ...part, ...fields } : part)) };
}

export function withoutPart(choice: Choice, key: number): Choice {
  return { ...choice, parts: choice.parts.filter((part) => part.key !== key) };
}

/** Why a name cannot be given to a part; empty if it can. */
export function partNameFault({ parts }: Choice, key: number, name: string): string {
  if (name.trim() === "") return "A part needs a name.";
  const taken = parts.some((part) => part.key !== key && part.name === name.trim());
  return taken ? `There is already a part named ${name.trim()}.` : "";
}

function freeName(parts: readonly ChosenPart[], factor: number): string {
  const names = new Set(parts.map(({ name }) => name));
  const kind = factor < 1 ? "soft" : "stiff";
  let number = 1;
  while (names.has(`${kind} ${number}`)) number++;
  return `${kind} ${number}`;
}
