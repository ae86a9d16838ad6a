package lcmslam.spy;

import java.awt.Color;
import java.awt.Dimension;
import java.awt.Graphics;
import java.awt.event.MouseAdapter;
import java.awt.event.MouseEvent;
import java.awt.event.MouseWheelEvent;
import java.util.Arrays;
import javax.swing.JPanel;
import javax.swing.SwingUtilities;

/**
 * Sweep, surfels and the way of the estimate in space. Drag orbits, right drag pans, wheel zooms, double click follows again. Until
 * the wheel zooms, it stands as far away as the sweep is wide.
 */
final class SpatialView extends JPanel {
  private static final long serialVersionUID = 1;
  private static final double RADIANS_A_PIXEL = 0.008, AXIS_M = 0.5;
  private static final double DISC_IN_CELLS = 0.65;  // radius; neighbours then touch
  private static final double DISTANCES_AWAY = 3.5;  // times the sweep's median range
  private static final double NEAREST_M = 4, FARTHEST_M = 60;
  private static final int MANY_POINTS = 40_000;

  private final transient SpatialWorld world;
  private final transient Camera camera = new Camera();
  private transient Raster raster;
  private boolean following = true, zoomed;

  SpatialView(SpatialWorld world) {
    this.world = world;
    setPreferredSize(new Dimension(820, 640));
    Mouse mouse = new Mouse();
    addMouseListener(mouse);
    addMouseMotionListener(mouse);
    addMouseWheelListener(mouse);
  }

  Camera camera() {
    return camera;
  }

  private final class Mouse extends MouseAdapter {
    private int x, y;

    @Override
    public void mousePressed(MouseEvent e) {
      x = e.getX();
      y = e.getY();
      if (e.getClickCount() == 2) following = true;
      repaint();
    }

    @Override
    public void mouseDragged(MouseEvent e) {
      int dx = e.getX() - x, dy = e.getY() - y;
      if (SwingUtilities.isLeftMouseButton(e)) {
        camera.orbit(-dx * RADIANS_A_PIXEL, dy * RADIANS_A_PIXEL);
      } else {
        following = false;
        camera.pan(dx, dy);
      }
      x = e.getX();
      y = e.getY();
      repaint();
    }

    @Override
    public void mouseWheelMoved(MouseWheelEvent e) {
      zoomed = true;
      camera.zoom(Math.pow(1.15, e.getPreciseWheelRotation()));
      repaint();
    }
  }

  @Override
  protected void paintComponent(Graphics g) {
    SpatialWorld.Scene scene = world.scene();
    if (raster == null || !raster.hasSize(getWidth(), getHeight())) raster = new Raster(camera, getWidth(), getHeight());
    if (following) lookAt(scene.body());
    if (!zoomed) standBack(scene);
    raster.clear(Palette.BACKGROUND.getRGB());
    drawSurfels(scene);
    drawSweep(scene);
    drawWay(scene);
    g.drawImage(raster.image(), 0, 0, null);
    drawOverlay(g, scene);
  }

  private void lookAt(Pose3 body) {
    camera.targetX = body.x;
    camera.targetY = body.y;
    camera.targetZ = body.z;
  }

  /** Moves when the surroundings have become much wider or narrower, so that the picture stands still in between. */
  private void standBack(SpatialWorld.Scene scene) {
    if (scene.sweep.length == 0) return;
    double wanted = Math.max(NEAREST_M, Math.min(FARTHEST_M, DISTANCES_AWAY * medianRange(scene)));
    if (Math.abs(Math.log(wanted / camera.distance())) > Math.log(1.5)) camera.moveTo(wanted);
  }

  private static double medianRange(SpatialWorld.Scene scene) {
    Pose3 body = scene.body();
    int n = scene.sweep.length / 3;
    double[] squares = new double[n];
    for (int i = 0; i < n; ++i) {
      double dx = scene.sweep[3 * i] - body.x, dy = scene.sweep[3 * i + 1] - body.y, dz = scene.sweep[3 * i + 2] - body.z;
      squares[i] = dx * dx + dy * dy + dz * dz;
    }
    Arrays.sort(squares);
    return Math.sqrt(squares[n / 2]);
  }

  private void drawSurfels(SpatialWorld.Scene scene) {
    for (SurfelStore.Surfel s : scene.surfels) {
      int color = Palette.surfel(s.normalX, s.normalY, s.normalZ);
      raster.disc(s.x, s.y, s.z, s.normalX, s.normalY, s.normalZ, DISC_IN_CELLS * s.cellSize, color);
    }
  }

  private void drawSweep(SpatialWorld.Scene scene) {
    int color = Palette.SCAN.getRGB();
    float[] p = scene.sweep;
    int size = p.length / 3 > MANY_POINTS ? 1 : 2;
    for (int i = 0; i + 2 < p.length; i += 3) raster.point(p[i], p[i + 1], p[i + 2], size, color);
  }

  /** With the body's axes, x red, y green, z blue, at its end. */
  private void drawWay(SpatialWorld.Scene scene) {
    for (int i = 1; i < scene.way.size(); ++i) {
      Pose3 from = scene.way.get(i - 1), to = scene.way.get(i);
      raster.line(from.x, from.y, from.z, to.x, to.y, to.z, 3, Palette.series(0).getRGB());
    }
    Pose3 body = scene.body();
    float length = (float) AXIS_M;
    float[] tips = body.apply(new float[] {length, 0, 0, 0, length, 0, 0, 0, length});
    for (int i = 0; i < 3; ++i) raster.line(body.x, body.y, body.z, tips[3 * i], tips[3 * i + 1], tips[3 * i + 2], 3, 0xFF << 8 * (2 - i));
  }

  private void drawOverlay(Graphics g, SpatialWorld.Scene scene) {
    Overlay overlay = new Overlay(g, getWidth(), getHeight());
    Pose3 body = scene.body();
    if (!scene.way.isEmpty()) overlay.add(Palette.series(0), String.format("%s  %.3f, %.3f, %.3f m", scene.channel, body.x, body.y, body.z));
    overlay.add(Palette.SCAN, String.format("sweep  %d points", scene.sweep.length / 3));
    if (!scene.surfels.isEmpty()) overlay.add(new Color(Palette.surfel(0, 0, 1)), String.format("map  %d surfels", scene.surfels.size()));
    overlay.drawLegend();
    overlay.drawScaleBar(camera.pixelsPerMeter(camera.distance()));
    if (!following) overlay.drawHint("double click: follow");
  }
}
