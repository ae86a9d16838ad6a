import java.awt.image.BufferedImage;
import java.io.File;
import javax.imageio.ImageIO;

/**
 * Numbers of pixels.
 *
 * <pre>
 * count PNG COLOR                 of that colour (RRGGBB), nearly
 * near PNG COLOR OTHER RADIUS     percent of them that have one of the other colour within so many pixels
 * rows PNG COLOR                  stretches of lines that have it: rows of a table
 * wide PNG COLOR                  columns from the first to the last one
 * differ PNG PNG                  that differ
 * </pre>
 */
public final class Pixels {
  private static final int TOLERANCE = 12;  // of each of red, green and blue

  private Pixels() {}

  public static void main(String[] a) throws Exception {
    BufferedImage image = ImageIO.read(new File(a[1]));
    switch (a[0]) {
      case "count": System.out.println(count(mask(image, a[2]))); break;
      case "near": System.out.println(near(mask(image, a[2]), mask(image, a[3]), Integer.parseInt(a[4]))); break;
      case "rows": System.out.println(rows(mask(image, a[2]))); break;
      case "wide": System.out.println(wide(mask(image, a[2]))); break;
      case "differ": System.out.println(differ(image, ImageIO.read(new File(a[2])))); break;
      default: throw new IllegalArgumentException(a[0]);
    }
  }

  private static boolean[][] mask(BufferedImage image, String color) {
    int want = Integer.parseInt(color, 16);
    boolean[][] mask = new boolean[image.getHeight()][image.getWidth()];
    for (int y = 0; y < image.getHeight(); ++y) {
      for (int x = 0; x < image.getWidth(); ++x) mask[y][x] = isNear(image.getRGB(x, y), want);
    }
    return mask;
  }

  private static boolean isNear(int a, int b) {
    for (int shift = 0; shift <= 16; shift += 8) {
      if (Math.abs((a >> shift & 0xFF) - (b >> shift & 0xFF)) > TOLERANCE) return false;
    }
    return true;
  }

  private static int count(boolean[][] mask) {
    int n = 0;
    for (boolean[] line : mask) {
      for (boolean set : line) n += set ? 1 : 0;
    }
    return n;
  }

  private static int near(boolean[][] mask, boolean[][] other, int radius) {
    int n = 0, close = 0;
    for (int y = 0; y < mask.length; ++y) {
      for (int x = 0; x < mask[y].length; ++x) {
        if (!mask[y][x]) continue;
        ++n;
        close += any(other, x, y, radius) ? 1 : 0;
      }
    }
    return n == 0 ? 0 : 100 * close / n;
  }

  private static boolean any(boolean[][] mask, int x, int y, int radius) {
    for (int v = Math.max(0, y - radius); v <= Math.min(mask.length - 1, y + radius); ++v) {
      for (int u = Math.max(0, x - radius); u <= Math.min(mask[v].length - 1, x + radius); ++u) {
        if (mask[v][u]) return true;
      }
    }
    return false;
  }

  private static int rows(boolean[][] mask) {
    int rows = 0;
    boolean before = false;
    for (boolean[] line : mask) {
      boolean now = count(new boolean[][] {line}) > 0;
      rows += now && !before ? 1 : 0;
      before = now;
    }
    return rows;
  }

  private static int wide(boolean[][] mask) {
    int first = Integer.MAX_VALUE, last = -1;
    for (boolean[] line : mask) {
      for (int x = 0; x < line.length; ++x) {
        if (!line[x]) continue;
        first = Math.min(first, x);
        last = Math.max(last, x);
      }
    }
    return last < 0 ? 0 : last - first + 1;
  }

  private static int differ(BufferedImage a, BufferedImage b) {
    int n = 0;
    for (int y = 0; y < Math.min(a.getHeight(), b.getHeight()); ++y) {
      for (int x = 0; x < Math.min(a.getWidth(), b.getWidth()); ++x) n += a.getRGB(x, y) == b.getRGB(x, y) ? 0 : 1;
    }
    return n;
  }
}
