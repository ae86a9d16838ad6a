package lcmslam.spy;

import java.awt.Color;

/** Colours of all views; the series are Okabe and Ito's, which colour-blind people can tell apart. */
final class Palette {
  static final Color BACKGROUND = new Color(0xF4F4F0);
  static final Color INK = new Color(0x202020);
  static final Color FAINT = new Color(0xC8C8C4);
  static final Color GOOD = new Color(0x009E73);
  static final Color WARNING = new Color(0xE69F00);
  static final Color BAD = new Color(0xD55E00);
  static final Color GROUND_TRUTH = new Color(0x009E73);
  static final Color SCAN = new Color(0xD55E00);
  private static final Color[] SERIES = {
    new Color(0x0072B2), new Color(0xCC79A7), new Color(0xE69F00), new Color(0x56B4E9), new Color(0x7A5C00)
  };

  private Palette() {}

  static Color series(int i) {
    return SERIES[i % SERIES.length];
  }

  /** Signed distance in cells: dark at the surface, white in front of it, blue behind. */
  static int distance(double cells) {
    int shade = (int) Math.round(255 * Math.min(1.0, 0.15 + Math.abs(cells) / 2.0));
    return cells >= -0.5 ? 0xFF000000 | shade << 16 | shade << 8 | shade : 0xFF000000 | (shade * 3 / 4) << 16 | (shade * 5 / 6) << 8 | shade;
  }

  /** By the side that a surface shows: floors and ceilings light, walls darker by their direction. */
  static int surfel(double nx, double ny, double nz) {
    double shade = 0.45 + 0.12 * nx + 0.08 * ny + 0.30 * Math.abs(nz);
    int red = (int) (200 * shade), green = (int) (225 * shade), blue = (int) Math.min(255, 265 * shade);
    return 0xFF000000 | red << 16 | green << 8 | blue;
  }

  static int occupancy(byte cell) {
    if (cell == 0) return 0;
    int shade = cell > 0 ? 90 - Math.min(90, (int) cell) : 225 + Math.min(30, -cell / 4);
    return 0xFF000000 | shade << 16 | shade << 8 | shade;
  }
}
