package lcmslam.spy;

import javax.swing.JComponent;
import lcm.spy.SpyPlugin;
import lcmslam.service_status_t;

/** All services' states at a glance. */
public final class HealthPlugin extends ViewPlugin implements SpyPlugin {
  public HealthPlugin() {
    super("Health", service_status_t.LCM_FINGERPRINT);
  }

  @Override
  JComponent makeView(Feed feed, String channel) {
    return new HealthBoard(feed);
  }
}
