package lcmslam.spy;

import java.awt.image.BufferedImage;
import java.awt.image.DataBufferInt;
import java.util.Arrays;

/** A picture of points, lines and discs in space; what is nearer hides what is behind. */
final class Raster {
  private final Camera camera;
  private final int width, height;
  private final BufferedImage image;
  private final int[] pixels;
  private final float[] depths;
  private final double[] at = new double[3], to = new double[3];

  Raster(Camera camera, int width, int height) {
    this.camera = camera;
    this.width = width;
    this.height = height;
    image = new BufferedImage(width, height, BufferedImage.TYPE_INT_RGB);
    pixels = ((DataBufferInt) image.getRaster().getDataBuffer()).getData();
    depths = new float[width * height];
  }

  boolean hasSize(int w, int h) {
    return w == width && h == height;
  }

  void clear(int color) {
    camera.aim(width, height);
    Arrays.fill(pixels, color);
    Arrays.fill(depths, Float.MAX_VALUE);
  }

  BufferedImage image() {
    return image;
  }

  /** A square of so many pixels. */
  void point(double x, double y, double z, int size, int color) {
    if (camera.project(x, y, z, at)) square(at[0], at[1], at[2], size, color);
  }

  private void square(double column, double row, double depth, int size, int color) {
    int left = (int) Math.round(column - size / 2.0), top = (int) Math.round(row - size / 2.0);
    for (int v = Math.max(0, top); v < Math.min(height, top + size); ++v) {
      for (int u = Math.max(0, left); u < Math.min(width, left + size); ++u) put(u, v, depth, color);
    }
  }

  private void put(int u, int v, double depth, int color) {
    int i = v * width + u;
    if (depth >= depths[i]) return;
    depths[i] = (float) depth;
    pixels[i] = color;
  }

  void line(double x1, double y1, double z1, double x2, double y2, double z2, int size, int color) {
    if (!camera.project(x1, y1, z1, at) || !camera.project(x2, y2, z2, to)) return;
    double length = Math.max(Math.abs(to[0] - at[0]), Math.abs(to[1] - at[1]));
    if (length > 4.0 * (width + height)) return;  // grazes the eye
    int steps = Math.max(1, (int) Math.ceil(length));
    for (int i = 0; i <= steps; ++i) {
      double t = (double) i / steps;
      square(at[0] + t * (to[0] - at[0]), at[1] + t * (to[1] - at[1]), at[2] + t * (to[2] - at[2]), size, color);
    }
  }

  /** A disc across a unit normal, seen only from where the normal points: one looks through walls into a room. */
  void disc(double x, double y, double z, double nx, double ny, double nz, double radius, int color) {
    if (!camera.sees(x, y, z, nx, ny, nz) || !camera.project(x, y, z, at)) return;
    double scale = camera.pixelsPerMeter(at[2]), reach = radius * scale;
    if (at[0] + reach < 0 || at[0] - reach >= width || at[1] + reach < 0 || at[1] - reach >= height || reach > width) return;
    if (reach < 1) {
      square(at[0], at[1], at[2], 1, color);
      return;
    }
    double[] n = camera.turn(nx, ny, nz);
    double facing = Math.abs(n[2]) < 0.05 ? Math.copySign(0.05, n[2]) : n[2];  // edge-on a disc would vanish
    for (int v = (int) Math.max(0, at[1] - reach); v <= Math.min(height - 1, at[1] + reach); ++v) {
      for (int u = (int) Math.max(0, at[0] - reach); u <= Math.min(width - 1, at[0] + reach); ++u) {
        double right = (u - at[0]) / scale, up = (at[1] - v) / scale, forward = -(n[0] * right + n[1] * up) / facing;
        if (right * right + up * up + forward * forward <= radius * radius) put(u, v, at[2] + forward, color);
      }
    }
  }
}
