package lcmslam.spy;

import java.util.Arrays;
import lcmslam.planar_lidar_t;
import lcmslam.planar_scan_t;

/** A planar scan: its returns in the lidar frame, m. */
final class Scan {
  private static final double FULL_TURN = Math.toRadians(300);  // what a turn with a few lost beams still covers

  final long utime;
  final float[] x, y;

  private interface Angle {
    double at(int beam);
  }

  private Scan(long utime, float[] ranges, Angle angle) {
    this.utime = utime;
    float[] px = new float[ranges.length], py = new float[ranges.length];
    int n = 0;
    for (int i = 0; i < ranges.length; ++i) {
      if (!(ranges[i] > 0) || Float.isInfinite(ranges[i])) continue;
      px[n] = (float) (ranges[i] * Math.cos(angle.at(i)));
      py[n++] = (float) (ranges[i] * Math.sin(angle.at(i)));
    }
    x = Arrays.copyOf(px, n);
    y = Arrays.copyOf(py, n);
  }

  static Scan of(planar_scan_t m) {
    int sense = isClockwise(m) ? -1 : 1;
    return new Scan(m.utime, m.ranges, i -> sense * m.thetas[i]);
  }

  static Scan of(planar_lidar_t m) {
    return new Scan(m.utime, m.ranges, i -> m.rad0 + i * m.radstep);
  }

  /** An MBot's RPLidar, by the marks that lib/lidar/angle_sense.h gives. */
  private static boolean isClockwise(planar_scan_t m) {
    int last = m.times.length - 1;
    if (last < 0 || m.times[0] != m.utime || m.times[last] <= m.utime) return false;
    double turned = 0;
    for (int i = 1; i <= last; ++i) {
      double step = Math.IEEEremainder(m.thetas[i] - m.thetas[i - 1], 2 * Math.PI);
      if (!Double.isNaN(step)) turned += step;
    }
    return turned > FULL_TURN;
  }
}
