package lcmslam.spy;

import java.awt.geom.AffineTransform;
import java.util.List;

/** Lays ground truth, which lives in a frame of its own, over an estimate: planar least squares over poses of equal time. */
final class Alignment {
  private static final long MAX_APART_US = 100_000;

  private Alignment() {}

  /** T_estimate_truth; the identity where fewer than two poses match. */
  static AffineTransform of(List<PlanarWorld.Pose> truth, List<PlanarWorld.Pose> estimate) {
    double n = 0, tx = 0, ty = 0, ex = 0, ey = 0, dot = 0, cross = 0;
    int i = 0;
    for (PlanarWorld.Pose e : estimate) {
      while (i + 1 < truth.size() && Math.abs(truth.get(i + 1).utime - e.utime) <= Math.abs(truth.get(i).utime - e.utime)) ++i;
      if (truth.isEmpty() || Math.abs(truth.get(i).utime - e.utime) > MAX_APART_US) continue;
      PlanarWorld.Pose t = truth.get(i);
      ++n;
      tx += t.x;
      ty += t.y;
      ex += e.x;
      ey += e.y;
      dot += t.x * e.x + t.y * e.y;
      cross += t.x * e.y - t.y * e.x;
    }
    AffineTransform alignment = new AffineTransform();
    if (n < 2) return alignment;
    alignment.translate(ex / n, ey / n);
    alignment.rotate(Math.atan2(cross - (tx * ey - ty * ex) / n, dot - (tx * ex + ty * ey) / n));
    alignment.translate(-tx / n, -ty / n);
    return alignment;
  }
}
