import { crc32, UnreadableModel } from "../engine/index.ts";

export interface Source {
  bytes: ArrayBuffer;
  name: string;
}

/** The model that comes with the page: embedded in it, or at the address that it names; null without one. */
export async function ownModel(): Promise<Source | null> {
  const embedded = document.getElementById("model");
  if (embedded?.textContent) {
    const bytes = decoded(embedded.textContent);
    // pages of earlier versions have none
    const written = embedded.dataset["crc32"];
    if (written !== undefined && written !== crc32(new Uint8Array(bytes))) throw damaged();
    return { bytes, name: document.title };
  }
  const named = document.querySelector<HTMLMetaElement>('meta[name="snapspace-model"]')?.content;
  const address = named ?? new URLSearchParams(location.search).get("model");
  return address ? fetched(address) : null;
}

/** The model at an address of the page's own server. */
async function fetched(address: string): Promise<Source> {
  const url = new URL(address, location.href);
  if (url.origin !== location.origin)
    throw new UnreadableModel("A model must come from the page's own server.");
  const answer = await fetch(url).catch(() => null);
  if (!answer?.ok)
    throw new UnreadableModel(
      `There is no model at ${url.pathname} (${answer ? `status ${answer.status}` : "no answer"}).`,
    );
  return { bytes: await answer.arrayBuffer(), name: nameOf(url.pathname) };
}

/** A file that the user gave. */
export async function fromFile(file: File): Promise<Source> {
  return { bytes: await file.arrayBuffer(), name: nameOf(file.name) };
}

/** The name of the model at a path. */
export function nameOf(path: string): string {
  return path.replace(/^.*\/|\.snapspace$/g, "");
}

function damaged(): UnreadableModel {
  return new UnreadableModel("The model in this page is damaged. Export the page again.");
}

function decoded(base64: string): ArrayBuffer {
  let text: string;
  try {
    text = atob(base64.trim());
  } catch {
    throw damaged();
  }
  const bytes = new Uint8Array(text.length);
  for (let i = 0; i < text.length; i++) bytes[i] = text.charCodeAt(i);
  return bytes.buffer;
}
