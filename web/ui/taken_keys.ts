/** Whether a key goes to the field that has the focus, and so is no shortcut: fields are typed in, ranges move with arrows,
 * and drop-downs take every key except those with Ctrl, such as undo. */
export function isTaken({ target, key, ctrlKey, metaKey }: KeyboardEvent): boolean {
  if (target instanceof HTMLSelectElement) return !ctrlKey && !metaKey;
  return target instanceof HTMLInputElement && (target.type !== "range" || key.startsWith("Arrow"));
}
