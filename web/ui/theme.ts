import { toggle } from "./dom.ts";

/** Follows the system's dark or light theme until the button is used. Calls `act` now and after every change. */
export function followTheme(act: (dark: boolean) => void): void {
  const system = matchMedia("(prefers-color-scheme: dark)");
  let chosen: boolean | null = null;
  const apply = () => {
    const dark = chosen ?? system.matches;
    document.documentElement.dataset["theme"] = dark ? "dark" : "light";
    button.setAttribute("aria-pressed", String(dark));
    act(dark);
  };
  const button = toggle("Dark", "Dark or light", system.matches, (dark) => {
    chosen = dark;
    apply();
  });
  system.addEventListener("change", apply);
  document.querySelector("#panel footer")!.append(button);
  apply();
}
