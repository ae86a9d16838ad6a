package lcmslam.spy;

import java.util.ArrayList;
import java.util.List;

/** The way of one pose channel. When it grows too long every second pose goes. One thread at a time. */
final class Trail<P> {
  private static final int MAX_POSES = 20_000;

  private final List<P> poses = new ArrayList<>();
  private P latest;
  private long latestUtime;
  private int stride = 1, skipped;

  void add(long utime, P pose) {
    if (latest != null && utime < latestUtime) restart();  // a service that began again
    latest = pose;
    latestUtime = utime;
    if (++skipped < stride) return;
    skipped = 0;
    poses.add(pose);
    if (poses.size() == MAX_POSES) thinOut();
  }

  private void restart() {
    poses.clear();
    stride = 1;
    skipped = 0;
  }

  private void thinOut() {
    List<P> kept = new ArrayList<>();
    for (int i = 0; i < poses.size(); i += 2) kept.add(poses.get(i));
    poses.clear();
    poses.addAll(kept);
    stride *= 2;
  }

  /** Oldest first, the newest among them; a copy. */
  List<P> poses() {
    List<P> all = new ArrayList<>(poses);
    if (skipped > 0) all.add(latest);
    return all;
  }

  /** Null before the first. */
  P latest() {
    return latest;
  }
}
