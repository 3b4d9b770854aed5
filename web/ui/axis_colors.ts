/** Colours of the model's axes x, y and z: red, green, blue. */
export const AXIS_COLORS = ["#e8402f", "#3fae3a", "#2f74e8"] as const;
