/** three.js by its sources: a module that nobody imports is left out. From the file that three.js is built into, bundlers
 * keep all that might have side effects. */
export const threeSources = { find: /^three$/, replacement: "three/src/Three.Core.js" };
