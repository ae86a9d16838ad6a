package lcmslam.spy;

import info.monitorenter.gui.chart.Chart2D;
import info.monitorenter.gui.chart.ITrace2D;
import info.monitorenter.gui.chart.IAxis.AxisTitle;
import info.monitorenter.gui.chart.rangepolicies.RangePolicyMinimumViewport;
import info.monitorenter.gui.chart.traces.Trace2DSimple;
import info.monitorenter.util.Range;
import java.awt.BorderLayout;
import java.awt.Dimension;
import java.awt.GridLayout;
import javax.swing.BorderFactory;
import javax.swing.JLabel;
import javax.swing.JPanel;
import lcmslam.evaluation_t;

/** The error of an estimate over time, as the evaluator publishes it. */
final class ErrorPlot extends JPanel implements Refreshed {
  private static final long serialVersionUID = 1;

  private final transient Feed feed;
  private final String channel;
  private final JLabel what = new JLabel("no evaluation yet"), summary = new JLabel();
  private final transient ITrace2D mean = trace("mean so far", 0), latest = trace("latest pose", 1);

  ErrorPlot(Feed feed, String channel) {
    super(new BorderLayout());
    setPreferredSize(new Dimension(820, 420));
    this.feed = feed;
    this.channel = channel;
    Chart2D chart = new Chart2D();
    chart.getAxisX().setAxisTitle(new AxisTitle("s"));
    chart.getAxisY().setAxisTitle(new AxisTitle("position error, m"));
    chart.getAxisY().setRangePolicy(new RangePolicyMinimumViewport(new Range(0, 0.001)));
    chart.addTrace(latest);
    chart.addTrace(mean);
    what.putClientProperty("html.disable", true);  // it is shown as it comes from the bus
    JPanel heading = new JPanel(new GridLayout(2, 1));
    heading.setBorder(BorderFactory.createEmptyBorder(6, 8, 6, 8));
    heading.add(what);
    heading.add(summary);
    add(heading, BorderLayout.NORTH);
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
    evaluation_t m = history.latest;
    what.setText(String.format("%s against %s, %s alignment, %d poses, %.1f %% covered  %s", m.estimate_channel, m.reference_channel,
        m.alignment, m.matched, 100 * m.coverage, m.text));
    summary.setText(String.format("mean %.4f m, rmse %.4f m, max %.4f m", m.ate_mean, m.ate_rmse, m.ate_max));
  }
}
