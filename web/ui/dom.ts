/** Makes an element: h("button", { type: "button", onclick: act }, "Undo"). Keys with a dash are attributes. */
export function h<K extends keyof HTMLElementTagNameMap>(
  tag: K,
  properties: Record<string, unknown> = {},
  ...children: (Node | string)[]
): HTMLElementTagNameMap[K] {
  const element = document.createElement(tag);
  for (const [key, value] of Object.entries(properties)) {
    if (key.includes("-") || key === "role" || key === "for") element.setAttribute(key, String(value));
    else Object.assign(element, { [key]: value });
  }
  element.append(...children);
  return element;
}

/** Sets the text of an element that has no other content, and says whether it has changed. Costs nothing if it has not;
 * otherwise only the line is laid out, and no style is computed as for a new node. */
export function setText(element: HTMLElement, text: string): boolean {
  const { firstChild } = element;
  if (!(firstChild instanceof Text)) {
    element.textContent = text;
    return true;
  }
  if (firstChild.data === text) return false;
  firstChild.data = text;
  return true;
}

/** Sets an attribute and says whether it has changed. Unchanged ones are not set, because that would compute the
 * element's style. */
export function mark(element: HTMLElement, attribute: string, value: unknown): boolean {
  if (element.getAttribute(attribute) === String(value)) return false;
  element.setAttribute(attribute, String(value));
  return true;
}

/** Enables or disables a button, and says whether that has changed. */
export function enable(button: HTMLButtonElement, on: boolean): boolean {
  if (button.disabled !== on) return false;
  button.disabled = !on;
  return true;
}

/** A group of a panel with a heading. */
export function section(title: string, ...children: (Node | string)[]): HTMLElement {
  return h("section", {}, h("h2", {}, title), ...children);
}

/** A row with the button that leads from a model to its handles; empty where that is not possible. */
export function chooser(choose: (() => void) | undefined): HTMLElement[] {
  if (!choose) return [];
  return [h("div", { className: "row" }, h("button", { type: "button", onclick: choose }, "Choose handles"))];
}

/** A toggle button. */
export function toggle(label: string, title: string, pressed: boolean, act: (pressed: boolean) => void) {
  const button = h("button", { type: "button", title, "aria-pressed": pressed }, label);
  button.addEventListener("click", () => {
    const next = button.getAttribute("aria-pressed") !== "true";
    button.setAttribute("aria-pressed", String(next));
    act(next);
  });
  return button;
}

/** A group of radio buttons; `act` gets the chosen value. */
export function choice<T extends string>(
  label: string,
  options: readonly (readonly [T, string])[],
  chosen: T,
  act: (value: T) => void,
) {
  const buttons = options.map(([value, text]) =>
    h(
      "button",
      { type: "button", role: "radio", "aria-checked": value === chosen, onclick: () => set(value, true) },
      text,
    ),
  );
  const set = (value: T, notify = false) => {
    const marked = options.map(([own], i) => mark(buttons[i], "aria-checked", own === value));
    if (notify) act(value);
    return marked.includes(true);
  };
  return {
    element: h("div", { className: "choice", role: "radiogroup", "aria-label": label }, ...buttons),
    set,
  };
}

/** A range with its label and its value beside it. */
export function slider(
  label: string,
  range: { min: number; max: number; step: number; value: number },
  shown: (value: number) => string,
  act: (value: number) => void,
) {
  const text = h("output", {});
  const input = h("input", {
    type: "range",
    min: range.min,
    max: range.max,
    step: range.step,
    "aria-label": label,
  });
  const show = (value: number) => (text.textContent = input.ariaValueText = shown(value));
  const set = (value: number) => {
    input.value = String(value);
    show(value);
  };
  set(range.value);
  input.addEventListener("input", () => {
    show(input.valueAsNumber);
    act(input.valueAsNumber);
  });
  const element = h("label", { className: "slider" }, h("span", {}, label), text, input);
  return { element, input, set };
}

/** Whether the page is used with a mouse, and so most likely has a keyboard. */
export function hasMouse(): boolean {
  return matchMedia("(hover: hover)").matches;
}

export function vertexCount(count: number): string {
  return `${count.toLocaleString("en")} ${count === 1 ? "vertex" : "vertices"}`;
}

/** A button that asks for a file. `accept` is that of an input. */
export function filePicker(label: string, accept: string, act: (file: File) => void): HTMLElement {
  const input = h("input", { type: "file", accept, hidden: true });
  input.addEventListener("change", () => {
    const file = input.files?.[0];
    input.value = ""; // the same file can be taken again
    if (file) act(file);
  });
  return h("div", {}, h("button", { type: "button", onclick: () => input.click() }, label), input);
}
