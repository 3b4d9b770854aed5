/** A model that cannot be read. The message is for the user: what came, what was needed, the cure. */
export class UnreadableModel extends Error {}
