/** Poses whose names begin alike. */
export interface PoseGroup {
  /** What the names begin with; empty for poses that are alone with theirs. */
  readonly name: string;
  readonly poses: readonly number[];
}

/** Poses by the beginnings of their names, in the order of their first poses; those that are alone come last. */
export function poseGroups(names: readonly string[]): PoseGroup[] {
  const byPrefix = new Map<string, number[]>();
  const alone: number[] = [];
  names.forEach((name, pose) => {
    const prefix = prefixOf(name);
    byPrefix.set(prefix, [...(byPrefix.get(prefix) ?? []), pose]);
  });
  const groups: PoseGroup[] = [];
  for (const [name, poses] of byPrefix)
    if (name !== "" && poses.length > 1) groups.push({ name, poses });
    else alone.push(...poses);
  if (alone.length > 0) groups.push({ name: "", poses: alone.sort((a, b) => a - b) });
  return groups;
}

/** What stands before the digits at the end, or else before the last dash or underscore: lion of lion-01, lion_run
 * and lion7. Empty if there is nothing such. */
export function prefixOf(name: string): string {
  const number = /^(.*?)[-_ .]*\d+$/.exec(name);
  const word = /^(.*)[-_][^-_]*$/.exec(name);
  return (number ?? word)?.[1] ?? "";
}

/** What a name adds to that of its group: 01 of lion-01. */
export function nameInGroup(name: string, group: PoseGroup): string {
  return name.slice(group.name.length).replace(/^[-_ .]+/, "") || name;
}

/** Whether a name has all the words of a search, in any order and case. */
export function isFound(name: string, search: string): boolean {
  const lower = name.toLowerCase();
  return search
    .toLowerCase()
    .split(/\s+/)
    .every((word) => lower.includes(word));
}
