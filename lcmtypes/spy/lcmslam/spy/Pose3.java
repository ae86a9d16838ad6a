package lcmslam.spy;

import lcmslam.pose_t;
import lcmslam.rigid_transform_t;

/** A pose in space: where a frame is in another. */
final class Pose3 {
  final long utime;
  final double x, y, z;
  private final double[] r;  // rotation matrix, row by row

  Pose3(long utime, double[] pos, double[] q) {
    this.utime = utime;
    x = pos[0];
    y = pos[1];
    z = pos[2];
    double n = q[0] * q[0] + q[1] * q[1] + q[2] * q[2] + q[3] * q[3], s = n > 0 ? 2 / n : 0;
    r = new double[] {
      1 - s * (q[2] * q[2] + q[3] * q[3]), s * (q[1] * q[2] - q[0] * q[3]), s * (q[1] * q[3] + q[0] * q[2]),
      s * (q[1] * q[2] + q[0] * q[3]), 1 - s * (q[1] * q[1] + q[3] * q[3]), s * (q[2] * q[3] - q[0] * q[1]),
      s * (q[1] * q[3] - q[0] * q[2]), s * (q[2] * q[3] + q[0] * q[1]), 1 - s * (q[1] * q[1] + q[2] * q[2])
    };
  }

  static Pose3 identity() {
    return new Pose3(0, new double[3], new double[] {1, 0, 0, 0});
  }

  static Pose3 of(pose_t m) {
    return new Pose3(m.utime, m.pos, m.orientation);
  }

  static Pose3 of(rigid_transform_t m) {
    return new Pose3(m.utime, m.trans, m.quat);
  }

  boolean isUsable() {
    return PlanarWorld.areUsable(x, y, z) && PlanarWorld.areUsable(r);
  }

  /** Points x, y, z by turns, moved out of this frame. */
  float[] apply(float[] points) {
    float[] moved = new float[points.length];
    for (int i = 0; i + 2 < points.length; i += 3) {
      double px = points[i], py = points[i + 1], pz = points[i + 2];
      moved[i] = (float) (x + r[0] * px + r[1] * py + r[2] * pz);
      moved[i + 1] = (float) (y + r[3] * px + r[4] * py + r[5] * pz);
      moved[i + 2] = (float) (z + r[6] * px + r[7] * py + r[8] * pz);
    }
    return moved;
  }
}
