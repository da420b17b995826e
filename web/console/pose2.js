// Poses in the plane: {x_m, y_m, yaw_rad}. T_a_b takes coordinates in b to a, as in the program.

export const kIdentity = { x_m: 0, y_m: 0, yaw_rad: 0 };

/** The coordinates of a point [x, y] in frame a. */
export function moved(T, [x, y]) {
  const cos = Math.cos(T.yaw_rad), sin = Math.sin(T.yaw_rad);
  return [T.x_m + cos * x - sin * y, T.y_m + sin * x + cos * y];
}

/** T_a_c from T_a_b and T_b_c. */
export function composed(a, b) {
  const [x_m, y_m] = moved(a, [b.x_m, b.y_m]);
  return { x_m, y_m, yaw_rad: a.yaw_rad + b.yaw_rad };
}

/** T_b_a from T_a_b. */
export function inverse(T) {
  const [x_m, y_m] = moved({ x_m: 0, y_m: 0, yaw_rad: -T.yaw_rad }, [-T.x_m, -T.y_m]);
  return { x_m, y_m, yaw_rad: -T.yaw_rad };
}
