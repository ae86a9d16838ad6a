package lcmslam.spy;

import javax.swing.JComponent;
import lcm.spy.SpyPlugin;
import lcmslam.point_cloud_chunk_t;
import lcmslam.surfel_chunk_t;

/** Sweep and surfels in space. The poses that go with them are of the same type as the map's: see MapPlugin. */
public final class SpatialPlugin extends ViewPlugin implements SpyPlugin {
  public SpatialPlugin() {
    super("3D", point_cloud_chunk_t.LCM_FINGERPRINT, surfel_chunk_t.LCM_FINGERPRINT);
  }

  @Override
  JComponent makeView(Feed feed, String channel) {
    return new SpatialView(feed.space);
  }
}
