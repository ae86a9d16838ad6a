package lcmslam.spy;

import javax.swing.JComponent;
import lcm.spy.SpyPlugin;
import lcmslam.occupancy_grid_t;
import lcmslam.planar_lidar_t;
import lcmslam.planar_scan_t;
import lcmslam.pose_t;
import lcmslam.pose_xyt_t;
import lcmslam.sdf_tile_t;

/** Map with scan, poses, trails and ground truth in one view; the 3D view for poses of a spatial estimate. */
public final class MapPlugin extends ViewPlugin implements SpyPlugin {
  public MapPlugin() {
    super("Map", planar_scan_t.LCM_FINGERPRINT, planar_lidar_t.LCM_FINGERPRINT, pose_t.LCM_FINGERPRINT,
        pose_xyt_t.LCM_FINGERPRINT, sdf_tile_t.LCM_FINGERPRINT, occupancy_grid_t.LCM_FINGERPRINT);
  }

  @Override
  JComponent makeView(Feed feed, String channel) {
    return SpatialWorld.isEstimate(channel) ? new SpatialView(feed.space) : new MapView(feed.world);
  }
}
