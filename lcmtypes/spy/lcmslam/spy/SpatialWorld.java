package lcmslam.spy;

import java.util.ArrayList;
import java.util.List;
import java.util.Map;
import java.util.TreeMap;
import lcmslam.point_cloud_chunk_t;
import lcmslam.pose_t;
import lcmslam.rigid_transform_t;
import lcmslam.surfel_chunk_t;

/** The latest sweeps, surfels and the way of the estimate, as the 3D view draws them. Bounded in memory. Any thread. */
final class SpatialWorld {
  private static final String MAIN_LIDAR = "LIDAR_3D";
  private static final String[] ESTIMATES = {"OCTO3D_POSE", "CLOUD3D_POSE"};

  private final Map<String, SweepCollector> sweeps = new TreeMap<>();
  private final Map<String, Pose3> mountings = new TreeMap<>();  // T_body_lidar by lidar channel
  private final Map<String, Trail<Pose3>> ways = new TreeMap<>();
  private final SurfelStore surfels = new SurfelStore();

  /** Whether poses of this channel are drawn here. */
  static boolean isEstimate(String channel) {
    return java.util.Arrays.asList(ESTIMATES).contains(channel);
  }

  synchronized void addChunk(String channel, point_cloud_chunk_t m) {
    sweeps.computeIfAbsent(channel, c -> new SweepCollector()).add(m);
  }

  synchronized void addSurfels(surfel_chunk_t m) {
    surfels.add(m);
  }

  synchronized void setMounting(String channel, rigid_transform_t m) {
    Pose3 mounting = Pose3.of(m);
    if (mounting.isUsable()) mountings.put(channel.replaceAll("_EXTRINSICS$", ""), mounting);
  }

  synchronized void addPose(String channel, pose_t m) {
    Pose3 pose = Pose3.of(m);
    if (isEstimate(channel) && pose.isUsable()) ways.computeIfAbsent(channel, c -> new Trail<>()).add(pose.utime, pose);
  }

  /** What is drawn at one time. */
  static final class Scene {
    /** Whose way it is; "" before the first pose. */
    final String channel;
    /** T_map_body, oldest first. */
    final List<Pose3> way;
    /** Map frame, x, y, z by turns. */
    final float[] sweep;
    final List<SurfelStore.Surfel> surfels;

    private Scene(String channel, List<Pose3> way, float[] sweep, List<SurfelStore.Surfel> surfels) {
      this.channel = channel;
      this.way = way;
      this.sweep = sweep;
      this.surfels = surfels;
    }

    Pose3 body() {
      return way.isEmpty() ? Pose3.identity() : way.get(way.size() - 1);
    }
  }

  synchronized Scene scene() {
    for (String channel : ESTIMATES) {
      Trail<Pose3> way = ways.get(channel);
      if (way != null) return new Scene(channel, way.poses(), sweepAt(way.latest()), surfels.all());
    }
    return new Scene("", new ArrayList<>(), sweepAt(null), surfels.all());
  }

  /** Where the body was at its end. Null: the body's pose is unknown. */
  private float[] sweepAt(Pose3 body) {
    if (sweeps.isEmpty()) return new float[0];
    String lidar = sweeps.containsKey(MAIN_LIDAR) ? MAIN_LIDAR : sweeps.keySet().iterator().next();
    float[] points = sweeps.get(lidar).at(body == null ? Long.MAX_VALUE : body.utime).points();
    points = mountings.getOrDefault(lidar, Pose3.identity()).apply(points);
    return body == null ? points : body.apply(points);
  }
}
