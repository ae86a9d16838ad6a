package lcmslam.spy;

import java.awt.Color;
import java.awt.FontMetrics;
import java.awt.Graphics;
import java.awt.Graphics2D;
import java.awt.RenderingHints;
import java.util.ArrayList;
import java.util.List;

/** What is written over a picture, on a ground of its own so that it can be read: a legend, a scale bar, a hint. */
final class Overlay {
  private static final Color GROUND = new Color(0xE6F4F4F0, true);
  private static final int MARGIN = 8, PAD = 6, LINE = 18, MAX_BAR = 160;

  private final Graphics2D g;
  private final FontMetrics metrics;
  private final int width, height;
  private final List<Color> colors = new ArrayList<>();
  private final List<String> lines = new ArrayList<>();

  /** For a picture of this size. */
  Overlay(Graphics graphics, int width, int height) {
    g = (Graphics2D) graphics;
    g.setRenderingHint(RenderingHints.KEY_TEXT_ANTIALIASING, RenderingHints.VALUE_TEXT_ANTIALIAS_ON);
    metrics = g.getFontMetrics();
    this.width = width;
    this.height = height;
  }

  /** A line of the legend; null: without a colour. */
  void add(Color color, String line) {
    colors.add(color);
    lines.add(line);
  }

  void drawLegend() {
    int longest = 0;
    for (String line : lines) longest = Math.max(longest, metrics.stringWidth(line));
    if (lines.isEmpty()) return;
    ground(MARGIN, MARGIN, longest + 20 + 2 * PAD, LINE * lines.size() + PAD);
    for (int i = 0; i < lines.size(); ++i) {
      int baseline = MARGIN + PAD / 2 + LINE * i + 14;
      if (colors.get(i) != null) {
        g.setColor(colors.get(i));
        g.fillRect(MARGIN + PAD, baseline - 10, 12, 11);
      }
      g.setColor(Palette.INK);
      g.drawString(lines.get(i), MARGIN + PAD + 20, baseline);
    }
  }

  /** 1, 2 or 5 times a power of ten in metres, as long as fits. */
  void drawScaleBar(double pixelsPerMeter) {
    double meters = roundDown(MAX_BAR / pixelsPerMeter);
    int length = (int) Math.round(meters * pixelsPerMeter), bottom = height - MARGIN;
    ground(MARGIN, bottom - 28, Math.max(length, 40) + 2 * PAD, 28);
    g.setColor(Palette.INK);
    g.fillRect(MARGIN + PAD, bottom - 8, length, 3);
    g.drawString(meters >= 1 ? String.format("%.0f m", meters) : String.format("%.0f cm", 100 * meters), MARGIN + PAD, bottom - 13);
  }

  private static double roundDown(double value) {
    double power = Math.pow(10, Math.floor(Math.log10(value)));
    return value >= 5 * power ? 5 * power : value >= 2 * power ? 2 * power : power;
  }

  void drawHint(String hint) {
    int length = metrics.stringWidth(hint), left = width - MARGIN - length - 2 * PAD;
    ground(left, height - MARGIN - LINE, length + 2 * PAD, LINE);
    g.setColor(Palette.INK);
    g.drawString(hint, left + PAD, height - MARGIN - 5);
  }

  private void ground(int left, int top, int w, int h) {
    g.setColor(GROUND);
    g.fillRoundRect(left, top, w, h, 8, 8);
  }
}
