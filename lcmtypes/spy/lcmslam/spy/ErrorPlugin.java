package lcmslam.spy;

import javax.swing.JComponent;
import lcm.spy.SpyPlugin;
import lcmslam.evaluation_t;

/** The error of an estimate as it grows. */
public final class ErrorPlugin extends ViewPlugin implements SpyPlugin {
  public ErrorPlugin() {
    super("Error", evaluation_t.LCM_FINGERPRINT);
  }

  @Override
  JComponent makeView(Feed feed, String channel) {
    return new ErrorPlot(feed, channel);
  }
}
