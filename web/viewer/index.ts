export { SnapspaceViewer } from "./snapspace_viewer.ts";
