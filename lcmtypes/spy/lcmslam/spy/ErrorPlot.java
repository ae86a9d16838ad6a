package lcmslam.spy;

import info.monitorenter.gui.chart.Chart2D;
import info.monitorenter.gui.chart.ITrace2D;
import info.monitorenter.gui.chart.IAxis.AxisTitle;
import info.monitorenter.gui.chart.traces.Trace2DSimple;
import java.awt.BorderLayout;
import java.awt.Dimension;
import javax.swing.BorderFactory;
import javax.swing.JLabel;
import javax.swing.JPanel;

/** The error of an estimate over time, as the evaluator publishes it. */
final class ErrorPlot extends JPanel implements Refreshed {
  private static final long serialVersionUID = 1;

  private final transient Feed feed;
  private final String channel;
  private final JLabel summary = new JLabel("no evaluation yet");
  private final transient ITrace2D mean = trace("mean so far", 0), latest = trace("latest pose", 1);

  ErrorPlot(Feed feed, String channel) {
    super(new BorderLayout());
    setPreferredSize(new Dimension(820, 420));
    this.feed = feed;
    this.channel = channel;
    Chart2D chart = new Chart2D();
    chart.getAxisX().setAxisTitle(new AxisTitle("s"));
    chart.getAxisY().setAxisTitle(new AxisTitle("position error, m"));
    chart.addTrace(latest);
    chart.addTrace(mean);
    summary.setBorder(BorderFactory.createEmptyBorder(6, 8, 6, 8));
    add(summary, BorderLayout.NORTH);
    add(chart, BorderLayout.CENTER);
    refresh();
  }

  private static ITrace2D trace(String name, int series) {
    ITrace2D trace = new Trace2DSimple(name);
    trace.setColor(Palette.series(series));
    return trace;
  }

  @Override
  public void refresh() {
    ErrorHistory history = feed.errors(channel);
    if (history == null) return;
    mean.removeAllPoints();
    latest.removeAllPoints();
    for (double[] p : history.points) {
      mean.addPoint(p[0], p[1]);
      latest.addPoint(p[0], p[2]);
    }
    summary.setText(String.format("%s against %s, %s alignment: mean %.4f m, rmse %.4f m, max %.4f m; %d poses, %.1f %% covered  %s",
        history.latest.estimate_channel, history.latest.reference_channel, history.latest.alignment, history.latest.ate_mean,
        history.latest.ate_rmse, history.latest.ate_max, history.latest.matched, 100 * history.latest.coverage, history.latest.text));
  }
}
