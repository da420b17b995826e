// Four by four matrices for WebGL: arrays of 16 numbers, column by column. Poses are {position: [x, y, z], quaternion:
// [x, y, z, w]}, as the server sends them.

export function product(a, b) {
  const m = new Float32Array(16);
  for (let column = 0; column < 4; ++column)
    for (let row = 0; row < 4; ++row)
      for (let k = 0; k < 4; ++k) m[4 * column + row] += a[4 * k + row] * b[4 * column + k];
  return m;
}

/** Looks along -z, as WebGL does; the field of view is given by the tangents of its halves. */
export function perspective(across, up, near, far) {
  const m = new Float32Array(16);
  m[0] = 1 / across;
  m[5] = 1 / up;
  m[10] = (near + far) / (near - far);
  m[11] = -1;
  m[14] = (2 * near * far) / (near - far);
  return m;
}

const minus = (a, b) => [a[0] - b[0], a[1] - b[1], a[2] - b[2]];
const dot = (a, b) => a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
const cross = (a, b) => [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]];
const unit = (a) => a.map((value) => value / Math.hypot(...a));

/** From the map to an eye that looks at the target, with z of the map upwards in the picture. */
export function lookAt(eye, target) {
  const back = unit(minus(eye, target)), right = unit(cross([0, 0, 1], back)), up = cross(back, right);
  const m = new Float32Array(16);
  [right, up, back].forEach((axis, row) => {
    for (let column = 0; column < 3; ++column) m[4 * column + row] = axis[column];
    m[12 + row] = -dot(axis, eye);
  });
  m[15] = 1;
  return m;
}

export function poseMatrix({ position, quaternion: [x, y, z, w] }) {
  return new Float32Array([
    1 - 2 * (y * y + z * z), 2 * (x * y + w * z), 2 * (x * z - w * y), 0,
    2 * (x * y - w * z), 1 - 2 * (x * x + z * z), 2 * (y * z + w * x), 0,
    2 * (x * z + w * y), 2 * (y * z - w * x), 1 - 2 * (x * x + y * y), 0,
    ...position, 1]);
}

/** Of a pose in the plane, {x_m, y_m, yaw_rad}. */
export const planarMatrix = ({ x_m, y_m, yaw_rad }) =>
  poseMatrix({ position: [x_m, y_m, 0], quaternion: quaternionFrom(0, 0, yaw_rad) });

/** Of a point in the frame of the matrix. */
export function transformed(m, [x, y, z]) {
  return [0, 1, 2].map((row) => m[row] * x + m[4 + row] * y + m[8 + row] * z + m[12 + row]);
}

/** Takes a point of the map to the frame of the pose's matrix. */
export function inFrame(m, point) {
  const [x, y, z] = minus(point, [m[12], m[13], m[14]]);
  return [0, 1, 2].map((column) => m[4 * column] * x + m[4 * column + 1] * y + m[4 * column + 2] * z);
}

/** From roll, pitch and yaw, as the state gives them. */
export function quaternionFrom(roll, pitch, yaw) {
  const [cr, sr, cp, sp, cy, sy] = [roll, pitch, yaw].flatMap((angle) => [Math.cos(angle / 2), Math.sin(angle / 2)]);
  return [sr * cp * cy - cr * sp * sy, cr * sp * cy + sr * cp * sy, cr * cp * sy - sr * sp * cy, cr * cp * cy + sr * sp * sy];
}
