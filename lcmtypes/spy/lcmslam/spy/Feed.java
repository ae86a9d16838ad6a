package lcmslam.spy;

import java.io.IOException;
import java.util.Map;
import java.util.TreeMap;
import lcm.lcm.LCM;
import lcm.lcm.LCMDataInputStream;
import lcm.lcm.LCMSubscriber;
import lcmslam.evaluation_t;
import lcmslam.occupancy_grid_t;
import lcmslam.planar_lidar_t;
import lcmslam.planar_scan_t;
import lcmslam.point_cloud_chunk_t;
import lcmslam.pose_t;
import lcmslam.pose_xyt_t;
import lcmslam.rigid_transform_t;
import lcmslam.sdf_tile_t;
import lcmslam.service_status_t;
import lcmslam.surfel_chunk_t;

/** Hears everything on the bus and keeps what the views show. Types are told apart by fingerprint; bad messages are counted. */
final class Feed implements LCMSubscriber {
  private static Feed instance;

  final PlanarWorld world = new PlanarWorld();
  final SpatialWorld space = new SpatialWorld();
  /** By channel. */
  final Map<String, Status> statuses = new TreeMap<>();
  final Map<String, ErrorHistory> errors = new TreeMap<>();
  private long refused;

  /** A status with the time it was heard. */
  static final class Status {
    final service_status_t message;
    final long heardMillis;

    Status(service_status_t message, long heardMillis) {
      this.message = message;
      this.heardMillis = heardMillis;
    }
  }

  /** One for all views. Listens where LCM_DEFAULT_URL says, as replay/spy sets it. */
  static synchronized Feed get() {
    if (instance == null) {
      instance = new Feed();
      LCM.getSingleton().subscribeAll(instance);
    }
    return instance;
  }

  synchronized long refused() {
    return refused;
  }

  @Override
  public void messageReceived(LCM lcm, String channel, LCMDataInputStream in) {
    try {
      take(channel, in);
    } catch (IOException | RuntimeException | OutOfMemoryError malformed) {
      synchronized (this) {
        ++refused;
      }
    }
  }

  /** Passes over types that no view shows. */
  private void take(String channel, LCMDataInputStream in) throws IOException {
    long type = in.readLong();
    in.reset();
    if (type == planar_scan_t.LCM_FINGERPRINT) world.setScan(channel, Scan.of(new planar_scan_t(in)));
    else if (type == planar_lidar_t.LCM_FINGERPRINT) world.setScan(channel, Scan.of(new planar_lidar_t(in)));
    else if (type == pose_t.LCM_FINGERPRINT) addPose(channel, new pose_t(in));
    else if (type == pose_xyt_t.LCM_FINGERPRINT) world.addPose(channel, PlanarWorld.Pose.of(new pose_xyt_t(in)));
    else if (type == rigid_transform_t.LCM_FINGERPRINT) setMounting(channel, new rigid_transform_t(in));
    else if (type == sdf_tile_t.LCM_FINGERPRINT) world.setTile(new sdf_tile_t(in));
    else if (type == occupancy_grid_t.LCM_FINGERPRINT) world.setGrid(new occupancy_grid_t(in));
    else if (type == point_cloud_chunk_t.LCM_FINGERPRINT) space.addChunk(channel, new point_cloud_chunk_t(in));
    else if (type == surfel_chunk_t.LCM_FINGERPRINT) space.addSurfels(new surfel_chunk_t(in));
    else if (type == service_status_t.LCM_FINGERPRINT) setStatus(channel, new service_status_t(in));
    else if (type == evaluation_t.LCM_FINGERPRINT) addEvaluation(channel, new evaluation_t(in));
  }

  private void addPose(String channel, pose_t message) {
    world.addPose(channel, PlanarWorld.Pose.of(message));
    space.addPose(channel, message);
  }

  private void setMounting(String channel, rigid_transform_t message) {
    world.setMounting(channel, message);
    space.setMounting(channel, message);
  }

  private synchronized void setStatus(String channel, service_status_t message) {
    statuses.put(channel, new Status(message, System.currentTimeMillis()));
  }

  private synchronized void addEvaluation(String channel, evaluation_t message) {
    errors.computeIfAbsent(channel, c -> new ErrorHistory()).add(message);
  }

  synchronized Map<String, Status> statuses() {
    return new TreeMap<>(statuses);
  }

  /** Null when nothing was heard on the channel. */
  synchronized ErrorHistory errors(String channel) {
    ErrorHistory history = errors.get(channel);
    return history == null ? null : history.copy();
  }
}
