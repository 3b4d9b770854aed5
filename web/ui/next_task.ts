/** Ends the present task: the browser answers the user before the rest goes on. */
export function nextTask(): Promise<void> {
  return new Promise((resolve) => setTimeout(resolve));
}
