"""The web component <snapspace-viewer>, as its users see it."""
