import { mark, toggle } from "../ui/dom.ts";

/** The button of a timeline; no button without one. */
export function playButton(
  playing: { readonly isPossible: boolean; readonly isOn: boolean },
  play: (on: boolean) => void,
): { elements: HTMLElement[]; update(): void } {
  if (!playing.isPossible) return { elements: [], update: () => {} };
  const button = toggle("Play", "Plays the timeline", playing.isOn, play);
  return { elements: [button], update: () => void mark(button, "aria-pressed", playing.isOn) };
}
