/** The style of the shadow tree. What the host page may set: size, background, color-scheme, and the variables. */
export const STYLE = `
:host {
  --snapspace-ink: light-dark(#1b2430, #eef1f5);
  --snapspace-card: light-dark(rgba(255, 255, 255, 0.86), rgba(28, 33, 42, 0.86));
  --snapspace-line: light-dark(rgba(27, 36, 48, 0.14), rgba(238, 241, 245, 0.16));
  --snapspace-focus: light-dark(#2563c9, #8ab4ff);
  display: block;
  position: relative;
  width: 100%;
  aspect-ratio: 4 / 3;
  overflow: hidden;
  color: var(--snapspace-ink);
  font: 14px/1.45 system-ui, sans-serif;
}
* { box-sizing: border-box; }
:host([hidden]), [hidden] { display: none !important; }
.stage, .poster { position: absolute; inset: 0; }
.poster { width: 100%; height: 100%; object-fit: contain; pointer-events: none; }
canvas { display: block; width: 100%; height: 100%; touch-action: none; outline: none; }
canvas:focus-visible { outline: 2px solid var(--snapspace-focus); outline-offset: -2px; }
.message, .bar {
  position: absolute; inset: auto 0 0; margin: 0; padding: 8px 12px;
  background: var(--snapspace-card);
}
.message { text-align: center; }
.bar {
  max-height: 45%; overflow-y: auto; border-top: 1px solid var(--snapspace-line);
  display: flex; flex-wrap: wrap; gap: 6px 14px; align-items: center; justify-content: center;
}
button {
  font: inherit; color: inherit; min-height: 34px; padding: 4px 12px; cursor: pointer;
  border: 1px solid var(--snapspace-line); border-radius: 8px; background: transparent;
}
button:focus-visible, input:focus-visible { outline: 2px solid var(--snapspace-focus); outline-offset: 2px; }
button[aria-pressed="true"], button[aria-checked="true"] {
  background: var(--snapspace-ink); color: light-dark(#ffffff, #171b22);
}
.swatch { display: inline-block; width: 10px; height: 10px; margin-right: 7px; border-radius: 50%; }
.choice { display: inline-flex; gap: 4px; }
.slider { display: grid; grid-template-columns: 1fr auto; flex: 1 1 150px; max-width: 260px; gap: 0 8px; }
.slider input { grid-column: 1 / -1; width: 100%; accent-color: var(--snapspace-focus); }
.slider output { font-variant-numeric: tabular-nums; }
`;
