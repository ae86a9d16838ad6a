package lcmslam.spy;

import java.util.ArrayDeque;
import java.util.ArrayList;
import java.util.Deque;
import java.util.HashSet;
import java.util.List;
import java.util.Set;
import lcmslam.point_cloud_chunk_t;

/** The latest sweeps of one lidar, from their chunks; a sweep may lack some. One thread at a time. */
final class SweepCollector {
  private static final int MAX_SWEEPS = 3;
  private static final int MAX_POINTS = 500_000;  // a sweep

  /** Points in the lidar frame, m; only returns. */
  static final class Sweep {
    final long utime;
    private final int number;
    private final Set<Integer> chunks = new HashSet<>();
    private final List<float[]> parts = new ArrayList<>();  // x, y, z by turns
    private int points;

    private Sweep(point_cloud_chunk_t m) {
      utime = m.utime;
      number = m.sweep;
    }

    private void add(point_cloud_chunk_t m) {
      if (points + m.num_points > MAX_POINTS || !chunks.add((int) m.chunk)) return;
      float[] part = new float[3 * m.num_points];
      int n = 0;
      for (int i = 0; i < m.num_points; ++i) {
        if (!Float.isFinite(m.x[i]) || !Float.isFinite(m.y[i]) || !Float.isFinite(m.z[i])) continue;
        part[n++] = m.x[i];
        part[n++] = m.y[i];
        part[n++] = m.z[i];
      }
      parts.add(java.util.Arrays.copyOf(part, n));
      points += n / 3;
    }

    /** Of a sweep whose collector is not touched meanwhile. */
    float[] points() {
      float[] all = new float[3 * points];
      int n = 0;
      for (float[] part : parts) {
        System.arraycopy(part, 0, all, n, part.length);
        n += part.length;
      }
      return all;
    }
  }

  private final Deque<Sweep> sweeps = new ArrayDeque<>();  // oldest first

  void add(point_cloud_chunk_t m) {
    if (m.num_points < 0) return;
    Sweep sweep = find(m);
    if (sweep == null) {
      sweep = new Sweep(m);
      sweeps.addLast(sweep);
      if (sweeps.size() > MAX_SWEEPS) sweeps.removeFirst();
    }
    sweep.add(m);
  }

  private Sweep find(point_cloud_chunk_t m) {
    for (Sweep sweep : sweeps) {
      if (sweep.number == m.sweep && sweep.utime == m.utime) return sweep;
    }
    return null;
  }

  /** The newest that the pose of this time belongs to, else the newest at all; null before the first. */
  Sweep at(long utime) {
    Sweep found = null;
    for (Sweep sweep : sweeps) {
      if (sweep.utime <= utime) found = sweep;
    }
    return found != null ? found : sweeps.peekLast();
  }
}
