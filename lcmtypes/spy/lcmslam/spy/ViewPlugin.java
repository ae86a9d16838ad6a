package lcmslam.spy;

import java.awt.BorderLayout;
import java.awt.event.ActionEvent;
import java.awt.event.WindowAdapter;
import java.awt.event.WindowEvent;
import java.util.HashSet;
import java.util.Set;
import javax.swing.AbstractAction;
import javax.swing.Action;
import javax.swing.JComponent;
import javax.swing.JDesktopPane;
import javax.swing.JFrame;
import javax.swing.Timer;
import javax.swing.WindowConstants;
import lcm.spy.ChannelData;

/**
 * What our lcm-spy plugins share: types by fingerprint, a window of its own, ten redraws a second. The plugins themselves
 * name SpyPlugin, because lcm-spy makes an object of every class that does so directly.
 */
abstract class ViewPlugin {
  private static final int REDRAW_MILLIS = 100;
  private final String title;
  private final Set<Long> types = new HashSet<>();

  ViewPlugin(String title, long... fingerprints) {
    this.title = title;
    for (long fingerprint : fingerprints) types.add(fingerprint);
    Feed.get();  // from now on, so that a window opened late shows what came before
  }

  abstract JComponent makeView(Feed feed, String channel);

  public boolean canHandle(long fingerprint) {
    return types.contains(fingerprint);
  }

  public Action getAction(JDesktopPane desktop, ChannelData channel) {
    return new AbstractAction(title) {
      private static final long serialVersionUID = 1;

      @Override
      public void actionPerformed(ActionEvent e) {
        open(channel.name);
      }
    };
  }

  private void open(String channel) {
    JComponent view = makeView(Feed.get(), channel);
    JFrame frame = new JFrame(title + ": " + channel);
    frame.setDefaultCloseOperation(WindowConstants.DISPOSE_ON_CLOSE);
    frame.setLayout(new BorderLayout());
    frame.add(view, BorderLayout.CENTER);
    frame.setSize(view.getPreferredSize());
    Timer redraw = new Timer(REDRAW_MILLIS, tick -> {
      if (view instanceof Refreshed) ((Refreshed) view).refresh();
      view.repaint();
    });
    frame.addWindowListener(new WindowAdapter() {
      @Override
      public void windowClosed(WindowEvent e) {
        redraw.stop();
      }
    });
    frame.setVisible(true);
    redraw.start();
  }
}
