/** Keys, while no field has the focus: Space plays, / searches the poses, F, W and J as in posing. */
export function listenToBlendingKeys(
  play: HTMLButtonElement,
  search: HTMLInputElement | null,
  signal: AbortSignal,
): void {
  const act = (event: KeyboardEvent) => {
    const { target } = event;
    if (event.ctrlKey || event.metaKey || event.altKey) return;
    if (target instanceof HTMLInputElement && target.type !== "range") return;
    const key = event.key.toLowerCase();
    if (key === " " && !(target instanceof HTMLElement && target.matches("button, summary, input")))
      play.click();
    else if (key === "/" && search) search.focus();
    else if (key === "f") document.getElementById("frame")?.click();
    else if (key === "w") document.getElementById("wires")?.click();
    else if (key === "j") document.getElementById("jiggle")?.click();
    else return;
    event.preventDefault();
  };
  document.addEventListener("keydown", act, { signal });
}
