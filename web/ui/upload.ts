/** Sends a file. Resolves once the server has all of it, and rejects with the server's words. */
export function sendFile(
  address: URL,
  file: File,
  onProgress: (done: number, total: number) => void,
  signal: AbortSignal,
): Promise<void> {
  return new Promise((resolve, reject) => {
    const request = new XMLHttpRequest(); // fetch does not report the progress of uploads
    request.open("POST", address);
    request.upload.onprogress = ({ loaded, total }) => onProgress(loaded, total);
    request.onload = () =>
      request.status < 400
        ? resolve()
        : reject(new Error(request.responseText || `status ${request.status}`));
    request.onerror = () => reject(new Error(`${file.name} could not be sent: the server does not answer.`));
    request.onabort = () => resolve();
    signal.addEventListener("abort", () => request.abort());
    request.send(file);
  });
}
