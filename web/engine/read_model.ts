import { Container } from "./container.ts";
import { UnreadableModel } from "./errors.ts";
import type { Model } from "./model.ts";
import { readFile } from "./read_file.ts";
import { readPacked } from "./read_packed.ts";

const FILE_VERSIONS = ["1", "2", "3", "4"];
const PAGE_VERSIONS = ["2"];

/** Reads a .snapspace file, or the model of an exported page.
 *
 * Throws UnreadableModel, whose message the user can read, for anything else. */
export function readModel(bytes: ArrayBuffer, name: string): Model {
  const container = new Container(bytes);
  const { format, version } = container.header;
  if (format !== "snapspace-model" && format !== "snapspace-page")
    throw new UnreadableModel("This is not a Snapspace model. `snapspace build` makes one.");
  const known = format === "snapspace-page" ? PAGE_VERSIONS : FILE_VERSIONS;
  if (!known.includes(version))
    throw new UnreadableModel(
      `This model has version ${version}, and this page reads version ${known.join(" and ")}. Open it with the version of Snapspace that wrote it.`,
    );
  try {
    return format === "snapspace-page" ? readPacked(container) : readFile(container, name);
  } catch (error) {
    if (error instanceof UnreadableModel) throw error;
    throw new UnreadableModel(`The model does not fit together (${String(error)}). Build it again.`);
  }
}
