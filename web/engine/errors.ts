/** A model that cannot be read. The message is for the user: what came, what was needed, the cure.
 *
 * It is one line: control characters, which a file may have in its names, are shown as spaces. */
export class UnreadableModel extends Error {
  constructor(message: string) {
    super(message.replace(/[\p{Cc}\u2028\u2029]+/gu, " "));
  }
}
