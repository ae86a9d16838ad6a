package lcmslam.spy;

import java.awt.BorderLayout;
import java.awt.Color;
import java.awt.Component;
import java.awt.Dimension;
import java.awt.Font;
import java.util.ArrayList;
import java.util.List;
import java.util.Map;
import javax.swing.BorderFactory;
import javax.swing.JLabel;
import javax.swing.JPanel;
import javax.swing.JScrollPane;
import javax.swing.JTable;
import javax.swing.table.AbstractTableModel;
import javax.swing.table.DefaultTableCellRenderer;
import lcmslam.service_status_t;

/** One line for every service that publishes a status: state, rate, latency, losses, age. */
final class HealthBoard extends JPanel implements Refreshed {
  private static final long serialVersionUID = 1;
  private static final String[] COLUMNS = {
    "service", "state", "Hz", "p50 ms", "p95 ms", "p99 ms", "real time", "received", "dropped", "refused", "missing", "host lost", "MB", "age s", "says"
  };
  private static final int[] WIDTHS = {150, 70, 50, 60, 60, 60, 70, 80, 65, 60, 60, 65, 45, 45, 320};
  private static final String[] STATES = {"starting", "waiting", "ok", "degraded", "failed"};
  private static final double SILENT_S = 3;  // a status comes once a second

  private final transient Feed feed;
  private final Model model = new Model();
  private final JLabel footer = new JLabel();

  HealthBoard(Feed feed) {
    super(new BorderLayout());
    setPreferredSize(new Dimension(1280, 260));
    this.feed = feed;
    JTable table = new JTable(model);
    table.setDefaultRenderer(Object.class, new Renderer());
    for (int i = 0; i < WIDTHS.length; ++i) table.getColumnModel().getColumn(i).setPreferredWidth(WIDTHS[i]);
    table.setRowHeight(24);
    table.setShowVerticalLines(false);
    table.setGridColor(Palette.FAINT);
    table.setFillsViewportHeight(true);
    table.getTableHeader().setReorderingAllowed(false);
    footer.setFont(footer.getFont().deriveFont(Font.PLAIN));
    footer.setBorder(BorderFactory.createEmptyBorder(6, 8, 6, 8));
    add(new JScrollPane(table), BorderLayout.CENTER);
    add(footer, BorderLayout.SOUTH);
    refresh();
  }

  /** A row with what the rate is computed from. */
  private static final class Row {
    service_status_t status;
    long heardMillis;
    double rateHz;

    double ageSeconds() {
      return (System.currentTimeMillis() - heardMillis) * 1e-3;
    }
  }

  private static final class Model extends AbstractTableModel {
    private static final long serialVersionUID = 1;
    transient Map<String, Row> byChannel = new java.util.TreeMap<>();
    transient List<Row> rows = new ArrayList<>();

    void update(Map<String, Feed.Status> statuses) {
      for (Map.Entry<String, Feed.Status> e : statuses.entrySet()) {
        Row row = byChannel.computeIfAbsent(e.getKey(), c -> new Row());
        Feed.Status heard = e.getValue();
        if (heard.heardMillis == row.heardMillis) continue;
        long millis = heard.heardMillis - row.heardMillis;
        boolean continues = row.status != null && heard.message.processed >= row.status.processed;
        row.rateHz = continues ? (heard.message.processed - row.status.processed) * 1e3 / millis : 0;
        row.status = heard.message;
        row.heardMillis = heard.heardMillis;
      }
      rows = new ArrayList<>(byChannel.values());
      fireTableDataChanged();
    }

    @Override
    public int getRowCount() {
      return rows.size();
    }

    @Override
    public int getColumnCount() {
      return COLUMNS.length;
    }

    @Override
    public String getColumnName(int column) {
      return COLUMNS[column];
    }

    @Override
    public Object getValueAt(int index, int column) {
      Row row = rows.get(index);
      service_status_t s = row.status;
      switch (column) {
        case 0: return s.name;
        case 1: return row.ageSeconds() > SILENT_S ? "silent" : s.state >= 0 && s.state < STATES.length ? STATES[s.state] : "?";
        case 2: return String.format("%.1f", row.rateHz);
        case 3: return String.format("%.2f", s.latency_p50_ms);
        case 4: return String.format("%.2f", s.latency_p95_ms);
        case 5: return String.format("%.2f", s.latency_p99_ms);
        case 6: return String.format("x %.0f", s.real_time_factor);
        case 7: return s.received;
        case 8: return s.dropped;
        case 9: return s.refused;
        case 10: return s.missing;
        case 11: return s.kernel_dropped;
        case 12: return String.format("%.0f", s.rss_mb);
        case 13: return String.format("%.1f", row.ageSeconds());
        default: return s.text;
      }
    }
  }

  /** Colours the state, and every loss that is not zero. */
  private static final class Renderer extends DefaultTableCellRenderer {
    private static final long serialVersionUID = 1;

    Renderer() {
      putClientProperty("html.disable", true);  // texts are shown as they come from the bus
    }

    @Override
    public Component getTableCellRendererComponent(JTable table, Object value, boolean selected, boolean focus, int row, int column) {
      Component cell = super.getTableCellRendererComponent(table, value, selected, focus, row, column);
      Color color = Palette.INK;
      if (column == 1) color = "ok".equals(value) ? Palette.GOOD : "waiting".equals(value) || "starting".equals(value) ? Palette.WARNING : Palette.BAD;
      if (column >= 8 && column <= 11 && !Long.valueOf(0).equals(value)) color = Palette.BAD;
      cell.setForeground(color);
      setBorder(BorderFactory.createEmptyBorder(0, 6, 0, 6));
      setHorizontalAlignment(column >= 2 && column < COLUMNS.length - 1 ? RIGHT : LEFT);
      return cell;
    }
  }

  @Override
  public void refresh() {
    model.update(feed.statuses());
    footer.setText("dropped: the service's queue was full   refused: malformed   missing: by the sender's stamps   "
        + "host lost: receive buffers were full, of any program   malformed messages seen here: " + feed.refused());
  }
}
