package lcmslam.spy;

import java.util.ArrayList;
import java.util.List;
import lcmslam.evaluation_t;

/** What an evaluator said over time: at most a few thousand points, the newest always among them. */
final class ErrorHistory {
  static final int MAX_POINTS = 4000;

  /** Times in s since the first message, errors in m. */
  final List<double[]> points = new ArrayList<>();  // time, mean, latest
  evaluation_t latest;
  private long start;

  /** Errors that are no numbers cannot be drawn, and are passed over. */
  void add(evaluation_t m) {
    if (!PlanarWorld.areUsable(m.ate_mean, m.latest_error)) return;
    if (latest == null || m.utime < latest.utime) {  // the evaluator began again
      points.clear();
      start = m.utime;
    }
    latest = m;
    points.add(new double[] {(m.utime - start) * 1e-6, m.ate_mean, m.latest_error});
    if (points.size() < MAX_POINTS) return;
    List<double[]> kept = new ArrayList<>();
    for (int i = 0; i < points.size(); i += 2) kept.add(points.get(i));
    points.clear();
    points.addAll(kept);
  }

  ErrorHistory copy() {
    ErrorHistory other = new ErrorHistory();
    other.points.addAll(points);
    other.latest = latest;
    other.start = start;
    return other;
  }
}
