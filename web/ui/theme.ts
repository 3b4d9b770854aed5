import { toggle } from "./dom.ts";

const KEPT = "snapspace-theme";

/** Follows the system's dark or light theme until the button is used; that choice outlives a reload. Calls `act` now and
 * after every change. */
export function followTheme(act: (dark: boolean) => void): void {
  const system = matchMedia("(prefers-color-scheme: dark)");
  let chosen = kept();
  const apply = () => {
    const dark = chosen ?? system.matches;
    document.documentElement.dataset["theme"] = dark ? "dark" : "light";
    button.setAttribute("aria-pressed", String(dark));
    act(dark);
  };
  const button = toggle("Dark", "Dark or light", chosen ?? system.matches, (dark) => {
    chosen = dark;
    keep(dark);
    apply();
  });
  system.addEventListener("change", apply);
  document.querySelector("#panel footer")!.append(button);
  apply();
}

/** Whether dark was chosen in this tab; null if nothing was. Sandboxed frames, as in notebooks, may keep nothing. */
function kept(): boolean | null {
  try {
    const theme = sessionStorage.getItem(KEPT);
    return theme === null ? null : theme === "dark";
  } catch {
    return null;
  }
}

function keep(dark: boolean): void {
  try {
    sessionStorage.setItem(KEPT, dark ? "dark" : "light");
  } catch {
    // only until the next reload
  }
}
