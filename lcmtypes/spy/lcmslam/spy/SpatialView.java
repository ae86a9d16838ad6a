package lcmslam.spy;

import java.awt.Dimension;
import java.awt.Graphics;
import java.awt.event.MouseAdapter;
import java.awt.event.MouseEvent;
import java.awt.event.MouseWheelEvent;
import javax.swing.JPanel;
import javax.swing.SwingUtilities;

/** Sweep, surfels and the way of the estimate in space. Drag orbits, right drag pans, wheel zooms, double click follows again. */
final class SpatialView extends JPanel {
  private static final long serialVersionUID = 1;
  private static final double RADIANS_A_PIXEL = 0.008, AXIS_M = 0.5;
  private static final double DISC_IN_CELLS = 0.65;  // radius; neighbours then touch

  private final transient SpatialWorld world;
  private final transient Camera camera = new Camera();
  private transient Raster raster;
  private boolean following = true;

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
      camera.zoom(Math.pow(1.15, e.getPreciseWheelRotation()));
      repaint();
    }
  }

  @Override
  protected void paintComponent(Graphics g) {
    SpatialWorld.Scene scene = world.scene();
    if (raster == null || !raster.hasSize(getWidth(), getHeight())) raster = new Raster(camera, getWidth(), getHeight());
    if (following) lookAt(scene.body());
    raster.clear(Palette.BACKGROUND.getRGB());
    drawSurfels(scene);
    drawSweep(scene);
    drawWay(scene);
    g.drawImage(raster.image(), 0, 0, null);
    drawLegend(g, scene);
  }

  private void lookAt(Pose3 body) {
    camera.targetX = body.x;
    camera.targetY = body.y;
    camera.targetZ = body.z;
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
    for (int i = 0; i + 2 < p.length; i += 3) raster.point(p[i], p[i + 1], p[i + 2], 2, color);
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

  private void drawLegend(Graphics g, SpatialWorld.Scene scene) {
    Pose3 body = scene.body();
    g.setColor(Palette.INK);
    g.drawString(String.format("%.3f, %.3f, %.3f m   %d points   %d surfels", body.x, body.y, body.z, scene.sweep.length / 3, scene.surfels.size()), 10, 20);
    if (!following) g.drawString("double click: follow", getWidth() - 140, getHeight() - 14);
  }
}
