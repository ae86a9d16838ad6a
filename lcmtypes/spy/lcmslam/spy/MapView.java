package lcmslam.spy;

import java.awt.BasicStroke;
import java.awt.Color;
import java.awt.Dimension;
import java.awt.Graphics;
import java.awt.Graphics2D;
import java.awt.RenderingHints;
import java.awt.event.MouseAdapter;
import java.awt.event.MouseEvent;
import java.awt.event.MouseWheelEvent;
import java.awt.geom.AffineTransform;
import java.awt.geom.Ellipse2D;
import java.awt.geom.Line2D;
import java.awt.geom.Path2D;
import java.awt.geom.Point2D;
import java.util.List;
import java.util.Map;
import javax.swing.JPanel;

/** Map, scan, poses with trails, ground truth laid over the estimate. Wheel zooms, drag pans, double click follows the estimate again. */
final class MapView extends JPanel {
  private static final long serialVersionUID = 1;
  private static final double MIN_SCALE = 0.5, MAX_SCALE = 2000;  // pixels a metre

  private final transient PlanarWorld world;
  private double scale = 60, centerX, centerY;
  private boolean following = true;

  MapView(PlanarWorld world) {
    this.world = world;
    setBackground(Palette.BACKGROUND);
    setPreferredSize(new Dimension(760, 620));
    Mouse mouse = new Mouse();
    addMouseListener(mouse);
    addMouseMotionListener(mouse);
    addMouseWheelListener(mouse);
  }

  private final class Mouse extends MouseAdapter {
    private Point2D grip;

    @Override
    public void mousePressed(MouseEvent e) {
      grip = e.getPoint();
      if (e.getClickCount() == 2) following = true;
      repaint();
    }

    @Override
    public void mouseDragged(MouseEvent e) {
      following = false;
      centerX -= (e.getX() - grip.getX()) / scale;
      centerY += (e.getY() - grip.getY()) / scale;
      grip = e.getPoint();
      repaint();
    }

    @Override
    public void mouseWheelMoved(MouseWheelEvent e) {
      double before = scale;
      scale = Math.max(MIN_SCALE, Math.min(MAX_SCALE, scale * Math.pow(1.2, -e.getPreciseWheelRotation())));
      double dx = e.getX() - getWidth() / 2.0, dy = getHeight() / 2.0 - e.getY();  // what is under the pointer stays there
      centerX += dx / before - dx / scale;
      centerY += dy / before - dy / scale;
      repaint();
    }
  }

  @Override
  protected void paintComponent(Graphics graphics) {
    super.paintComponent(graphics);
    Graphics2D g = (Graphics2D) graphics.create();
    g.setRenderingHint(RenderingHints.KEY_ANTIALIASING, RenderingHints.VALUE_ANTIALIAS_ON);
    List<PlanarWorld.Way> ways = world.ways();
    PlanarWorld.Way estimate = estimateOf(ways);
    if (following && estimate != null) {
      centerX = estimate.latest.x;
      centerY = estimate.latest.y;
    }
    AffineTransform screen = g.getTransform();
    g.translate(getWidth() / 2.0, getHeight() / 2.0);
    g.scale(scale, -scale);
    g.translate(-centerX, -centerY);
    drawMap(g);
    drawWays(g, ways, estimate);
    if (estimate != null) drawScans(g, estimate.latest);
    g.setTransform(screen);
    drawLegend(g, ways);
    g.dispose();
  }

  /** The pose that the scan is drawn at: a SLAM system's, else any but ground truth and odometry. */
  static PlanarWorld.Way estimateOf(List<PlanarWorld.Way> ways) {
    PlanarWorld.Way found = null;
    for (PlanarWorld.Way way : ways) {
      if (way.channel.equals("SDF2D_POSE")) return way;
      if (isGroundTruth(way.channel) || way.channel.equals("ODOMETRY")) continue;
      if (found == null || way.channel.endsWith("_POSE")) found = way;
    }
    return found;
  }

  static boolean isGroundTruth(String channel) {
    return channel.equals("GROUND_TRUTH") || channel.equals("TRUE_POSE");
  }

  private void drawMap(Graphics2D g) {
    List<PlanarWorld.Patch> tiles = world.tiles();
    PlanarWorld.Patch grid = world.grid();
    if (grid != null) draw(g, grid);
    for (PlanarWorld.Patch tile : tiles) draw(g, tile);
  }

  private static void draw(Graphics2D g, PlanarWorld.Patch p) {
    AffineTransform toMap = new AffineTransform();
    toMap.translate(p.left, p.bottom + p.height);
    toMap.scale(p.width / p.image.getWidth(), -p.height / p.image.getHeight());
    g.drawImage(p.image, toMap, null);
  }

  private Color colorOf(String channel, int i) {
    return isGroundTruth(channel) ? Palette.GROUND_TRUTH : Palette.series(i);
  }

  private void drawWays(Graphics2D g, List<PlanarWorld.Way> ways, PlanarWorld.Way estimate) {
    AffineTransform map = g.getTransform();
    int i = 0;
    for (PlanarWorld.Way way : ways) {
      g.setTransform(map);
      if (isGroundTruth(way.channel) && estimate != null) g.transform(Alignment.of(way.poses, estimate.poses));
      g.setColor(colorOf(way.channel, i++));
      float width = isGroundTruth(way.channel) ? 6 : 2;  // seen on both sides of an estimate that lies on it
      g.setStroke(new BasicStroke((float) (width / scale)));
      Path2D path = new Path2D.Double();
      for (PlanarWorld.Pose p : way.poses) {
        if (path.getCurrentPoint() == null) path.moveTo(p.x, p.y);
        else path.lineTo(p.x, p.y);
      }
      g.draw(path);
      PlanarWorld.Pose at = way.latest;
      double r = 9 / scale;
      g.fill(new Ellipse2D.Double(at.x - r / 2, at.y - r / 2, r, r));
      g.draw(new Line2D.Double(at.x, at.y, at.x + 2 * r * Math.cos(at.yaw), at.y + 2 * r * Math.sin(at.yaw)));
    }
    g.setTransform(map);
  }

  private void drawScans(Graphics2D g, PlanarWorld.Pose body) {
    double dot = 3 / scale;
    g.setColor(Palette.SCAN);
    for (Map.Entry<String, PlanarWorld.Scan> e : world.scansAt(body.utime).entrySet()) {
      if (e.getKey().startsWith("LIDAR_2D_")) continue;  // a further lidar, which the estimate does not use
      double[] mounting = world.mounting(e.getKey());
      AffineTransform toMap = AffineTransform.getTranslateInstance(body.x, body.y);
      toMap.rotate(body.yaw);
      toMap.translate(mounting[0], mounting[1]);
      toMap.rotate(mounting[2]);
      Point2D p = new Point2D.Double();
      PlanarWorld.Scan scan = e.getValue();
      for (int i = 0; i < scan.x.length; ++i) {
        toMap.transform(new Point2D.Double(scan.x[i], scan.y[i]), p);
        g.fill(new Ellipse2D.Double(p.getX() - dot / 2, p.getY() - dot / 2, dot, dot));
      }
    }
  }

  private void drawLegend(Graphics2D g, List<PlanarWorld.Way> ways) {
    int y = 20, i = 0;
    for (PlanarWorld.Way way : ways) {
      g.setColor(colorOf(way.channel, i++));
      g.fillRect(10, y - 9, 14, 10);
      g.setColor(Palette.INK);
      g.drawString(String.format("%s  %.3f, %.3f m  %.1f deg", way.channel, way.latest.x, way.latest.y, Math.toDegrees(way.latest.yaw)), 30, y);
      y += 18;
    }
    double meters = Math.pow(10, Math.floor(Math.log10(160 / scale)));
    int bottom = getHeight() - 14, length = (int) Math.round(meters * scale);
    g.setColor(Palette.INK);
    g.fillRect(10, bottom, length, 3);
    g.drawString(meters >= 1 ? String.format("%.0f m", meters) : String.format("%.0f cm", 100 * meters), 10, bottom - 5);
    if (!following) g.drawString("double click: follow", getWidth() - 140, bottom);
  }
}
