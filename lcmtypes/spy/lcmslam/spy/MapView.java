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
import java.awt.geom.Rectangle2D;
import java.util.List;
import javax.swing.JPanel;
import javax.swing.SwingUtilities;

/**
 * Map, scan, poses with trails, ground truth laid over the estimate. Shows all of it until the wheel zooms or a drag pans; double
 * click follows the estimate, right click shows all again.
 */
final class MapView extends JPanel {
  private static final long serialVersionUID = 1;
  private static final double MIN_SCALE = 0.5, MAX_SCALE = 2000;  // pixels a metre
  private static final double MAX_FITTED_SCALE = 150, MIN_SHOWN_M = 2, FILLED = 0.9;

  private enum Mode { WHOLE, FOLLOWING, FREE }

  private final transient PlanarWorld world;
  private double scale = MAX_FITTED_SCALE, centerX, centerY;
  private Mode mode = Mode.WHOLE;

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
      if (SwingUtilities.isRightMouseButton(e)) mode = Mode.WHOLE;
      else if (e.getClickCount() == 2) mode = Mode.FOLLOWING;
      repaint();
    }

    @Override
    public void mouseDragged(MouseEvent e) {
      mode = Mode.FREE;
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
      if (mode == Mode.WHOLE) mode = Mode.FREE;
      repaint();
    }
  }

  @Override
  protected void paintComponent(Graphics graphics) {
    super.paintComponent(graphics);
    Graphics2D g = (Graphics2D) graphics.create();
    g.setRenderingHint(RenderingHints.KEY_ANTIALIASING, RenderingHints.VALUE_ANTIALIAS_ON);
    List<PlanarWorld.Way> ways = world.ways();
    List<PlanarWorld.Patch> map = world.map();
    PlanarWorld.Way estimate = estimateOf(ways);
    aim(map, ways, estimate);
    AffineTransform screen = g.getTransform();
    g.translate(getWidth() / 2.0, getHeight() / 2.0);
    g.scale(scale, -scale);
    g.translate(-centerX, -centerY);
    for (PlanarWorld.Patch patch : map) draw(g, patch);
    drawWays(g, ways, estimate);
    Scan scan = estimate == null ? null : world.scanAt(estimate.latest.utime);
    if (scan != null) drawScan(g, scan, estimate.latest);
    g.setTransform(screen);
    drawOverlay(g, ways, estimate, scan != null);
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

  private void aim(List<PlanarWorld.Patch> map, List<PlanarWorld.Way> ways, PlanarWorld.Way estimate) {
    if (mode == Mode.WHOLE) showAll(boundsOf(map, ways, estimate));
    if (mode != Mode.FOLLOWING || estimate == null) return;
    centerX = estimate.latest.x;
    centerY = estimate.latest.y;
  }

  /** Of the map and the estimate; without these of what else there is. */
  private static Rectangle2D boundsOf(List<PlanarWorld.Patch> map, List<PlanarWorld.Way> ways, PlanarWorld.Way estimate) {
    Path2D all = new Path2D.Double();
    for (PlanarWorld.Patch patch : map) {
      if (!patch.known.isEmpty()) all.append(patch.known, false);
    }
    for (PlanarWorld.Way way : ways) {
      if (way == estimate || estimate == null) all.append(pathOf(way), false);
    }
    return all.getBounds2D();
  }

  private static Path2D pathOf(PlanarWorld.Way way) {
    Path2D path = new Path2D.Double();
    for (PlanarWorld.Pose p : way.poses) {
      if (path.getCurrentPoint() == null) path.moveTo(p.x, p.y);
      else path.lineTo(p.x, p.y);
    }
    return path;
  }

  private void showAll(Rectangle2D bounds) {
    double fitting = Math.min(getWidth() / Math.max(MIN_SHOWN_M, bounds.getWidth()), getHeight() / Math.max(MIN_SHOWN_M, bounds.getHeight()));
    scale = Math.max(MIN_SCALE, Math.min(MAX_FITTED_SCALE, FILLED * fitting));
    centerX = bounds.getCenterX();
    centerY = bounds.getCenterY();
  }

  private static void draw(Graphics2D g, PlanarWorld.Patch p) {
    AffineTransform toMap = new AffineTransform();
    toMap.translate(p.left, p.bottom + p.height);
    toMap.scale(p.width / p.image.getWidth(), -p.height / p.image.getHeight());
    g.drawImage(p.image, toMap, null);
  }

  /** The estimate has the same in every view. */
  private static Color colorOf(List<PlanarWorld.Way> ways, PlanarWorld.Way way, PlanarWorld.Way estimate) {
    if (isGroundTruth(way.channel)) return Palette.GROUND_TRUTH;
    return way == estimate ? Palette.series(0) : Palette.series(1 + ways.indexOf(way));
  }

  private void drawWays(Graphics2D g, List<PlanarWorld.Way> ways, PlanarWorld.Way estimate) {
    AffineTransform map = g.getTransform();
    for (PlanarWorld.Way way : ways) {
      boolean isTruth = isGroundTruth(way.channel);
      g.setTransform(map);
      if (isTruth && estimate != null) g.transform(Alignment.of(way.poses, estimate.poses));
      g.setColor(colorOf(ways, way, estimate));
      g.setStroke(new BasicStroke((float) ((isTruth ? 6 : 2) / scale)));  // truth is seen on both sides of an estimate that lies on it
      g.draw(pathOf(way));
      PlanarWorld.Pose at = way.latest;
      double r = 9 / scale;
      g.fill(new Ellipse2D.Double(at.x - r / 2, at.y - r / 2, r, r));
      g.draw(new Line2D.Double(at.x, at.y, at.x + 2 * r * Math.cos(at.yaw), at.y + 2 * r * Math.sin(at.yaw)));
    }
    g.setTransform(map);
  }

  private void drawScan(Graphics2D g, Scan scan, PlanarWorld.Pose body) {
    double dot = 3 / scale;
    double[] mounting = world.mounting();
    AffineTransform toMap = AffineTransform.getTranslateInstance(body.x, body.y);
    toMap.rotate(body.yaw);
    toMap.translate(mounting[0], mounting[1]);
    toMap.rotate(mounting[2]);
    g.setColor(Palette.SCAN);
    Point2D p = new Point2D.Double();
    for (int i = 0; i < scan.x.length; ++i) {
      toMap.transform(new Point2D.Double(scan.x[i], scan.y[i]), p);
      g.fill(new Ellipse2D.Double(p.getX() - dot / 2, p.getY() - dot / 2, dot, dot));
    }
  }

  private void drawOverlay(Graphics2D g, List<PlanarWorld.Way> ways, PlanarWorld.Way estimate, boolean hasScan) {
    Overlay overlay = new Overlay(g, getWidth(), getHeight());
    for (PlanarWorld.Way way : ways) {
      PlanarWorld.Pose at = way.latest;
      String moved = isGroundTruth(way.channel) && estimate != null ? "  (laid over the estimate)" : "";
      overlay.add(colorOf(ways, way, estimate), String.format("%s  %.3f, %.3f m  %.1f\u00b0%s", way.channel, at.x, at.y, Math.toDegrees(at.yaw), moved));
    }
    if (hasScan) overlay.add(Palette.SCAN, "scan");
    overlay.drawLegend();
    overlay.drawScaleBar(scale);
    if (mode == Mode.FREE) overlay.drawHint("double click: follow   right click: show all");
  }
}
