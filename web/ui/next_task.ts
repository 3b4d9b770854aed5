/** Ends the present task, so that the browser answers the user before the rest continues. */
export function nextTask(): Promise<void> {
  return new Promise((resolve) => setTimeout(resolve));
}
