package lcmslam.spy;

import java.awt.Rectangle;
import java.awt.geom.Rectangle2D;
import java.awt.image.BufferedImage;
import java.util.ArrayDeque;
import java.util.ArrayList;
import java.util.Deque;
import java.util.HashMap;
import java.util.List;
import java.util.Map;
import java.util.TreeMap;
import lcmslam.occupancy_grid_t;
import lcmslam.pose_t;
import lcmslam.pose_xyt_t;
import lcmslam.rigid_transform_t;
import lcmslam.sdf_tile_t;

/** The latest scan, poses with trails, and map, as the map view draws them. Bounded in memory. Any thread. */
final class PlanarWorld {
  /** T_map_body in the plane. */
  static final class Pose {
    final long utime;
    final double x, y, yaw;

    Pose(long utime, double x, double y, double yaw) {
      this.utime = utime;
      this.x = x;
      this.y = y;
      this.yaw = yaw;
    }

    static Pose of(pose_t m) {
      return new Pose(m.utime, m.pos[0], m.pos[1], yaw(m.orientation));
    }

    static Pose of(pose_xyt_t m) {
      return new Pose(m.utime, m.x, m.y, m.theta);
    }

    static double yaw(double[] q) {
      return Math.atan2(2 * (q[0] * q[3] + q[1] * q[2]), 1 - 2 * (q[2] * q[2] + q[3] * q[3]));
    }

    boolean isUsable() {
      return areUsable(x, y, yaw);
    }
  }

  /** Whether these, in m or rad, can be drawn: NaN and places that no robot goes to cannot. */
  static boolean areUsable(double... coordinates) {
    for (double c : coordinates) {
      if (!(Math.abs(c) < MAX_COORDINATE)) return false;
    }
    return true;
  }

  /** A picture of a part of the map; row 0 of the picture is its top. */
  static final class Patch {
    final double left, bottom, width, height;  // m, map frame
    final BufferedImage image;
    /** The part of it where something is known; empty: nowhere. */
    final Rectangle2D known;

    Patch(double left, double bottom, double width, double height, BufferedImage image) {
      this.left = left;
      this.bottom = bottom;
      this.width = width;
      this.height = height;
      this.image = image;
      Rectangle opaque = opaquePart(image);
      double cellWidth = width / image.getWidth(), cellHeight = height / image.getHeight();
      known = new Rectangle2D.Double(left + cellWidth * opaque.x, bottom + height - cellHeight * (opaque.y + opaque.height),
          cellWidth * opaque.width, cellHeight * opaque.height);
    }

    private static Rectangle opaquePart(BufferedImage image) {
      int left = image.getWidth(), top = image.getHeight(), right = -1, bottom = -1;
      for (int v = 0; v < image.getHeight(); ++v) {
        for (int u = 0; u < image.getWidth(); ++u) {
          if (image.getRGB(u, v) >>> 24 == 0) continue;
          left = Math.min(left, u);
          right = Math.max(right, u);
          top = Math.min(top, v);
          bottom = Math.max(bottom, v);
        }
      }
      return right < 0 ? new Rectangle() : new Rectangle(left, top, right - left + 1, bottom - top + 1);
    }
  }

  private static final double MAX_COORDINATE = 1e6;
  private static final String MAIN_LIDAR = "LIDAR_2D";
  private static final int MAX_TILES = 10_000, MAX_SCANS = 8;
  private final Map<Long, Patch> tiles = new HashMap<>();
  private final Map<String, Trail<Pose>> trails = new TreeMap<>();
  private final Map<String, Deque<Scan>> scans = new TreeMap<>();  // newest last
  private final Map<String, double[]> mountings = new TreeMap<>();  // x, y, yaw of T_body_lidar by lidar channel
  private Patch grid;
  private long newestTile = Long.MIN_VALUE;

  synchronized void setScan(String channel, Scan scan) {
    Deque<Scan> latest = scans.computeIfAbsent(channel, c -> new ArrayDeque<>());
    latest.addLast(scan);
    if (latest.size() > MAX_SCANS) latest.removeFirst();
  }

  synchronized void addPose(String channel, Pose pose) {
    if (pose.isUsable()) trails.computeIfAbsent(channel, c -> new Trail<>()).add(pose.utime, pose);
  }

  synchronized void setMounting(String channel, rigid_transform_t m) {
    String lidar = channel.replaceAll("_EXTRINSICS$", "");
    mountings.put(lidar, new double[] {m.trans[0], m.trans[1], Pose.yaw(m.quat)});
  }

  synchronized void setTile(sdf_tile_t m) {
    int side = m.cells_per_side;
    double size = side * m.meters_per_cell, half = 0.5 * m.meters_per_cell;
    if (side < 1 || m.num_cells != side * side || !(size > 0) || !areUsable(m.tile_x * size, m.tile_y * size, size)) return;
    if (m.utime < newestTile || tiles.size() >= MAX_TILES) tiles.clear();  // the service began a new map
    newestTile = m.utime;
    BufferedImage image = new BufferedImage(side, side, BufferedImage.TYPE_INT_ARGB);
    for (int y = 0; y < side; ++y) {
      for (int x = 0; x < side; ++x) {
        int i = y * side + x;
        double cells = m.distance[i] * m.meters_per_unit / m.meters_per_cell;
        image.setRGB(x, side - 1 - y, m.weight[i] == 0 ? 0 : Palette.distance(cells));
      }
    }
    tiles.put(((long) m.tile_x << 32) ^ (m.tile_y & 0xffffffffL),
        new Patch(m.tile_x * size - half, m.tile_y * size - half, size, size, image));
  }

  synchronized void setGrid(occupancy_grid_t m) {
    if (m.width < 1 || m.height < 1 || (long) m.width * m.height != m.num_cells) return;
    double width = m.width * m.meters_per_cell, height = m.height * m.meters_per_cell;
    if (!(width > 0) || !areUsable(m.origin_x, m.origin_y, width, height)) return;
    BufferedImage image = new BufferedImage(m.width, m.height, BufferedImage.TYPE_INT_ARGB);
    for (int y = 0; y < m.height; ++y) {
      for (int x = 0; x < m.width; ++x) image.setRGB(x, m.height - 1 - y, Palette.occupancy(m.cells[y * m.width + x]));
    }
    grid = new Patch(m.origin_x, m.origin_y, width, height, image);
  }

  /** In the order of drawing. */
  synchronized List<Patch> map() {
    List<Patch> map = new ArrayList<>();
    if (grid != null) map.add(grid);
    map.addAll(tiles.values());
    return map;
  }

  /** What is drawn of one pose channel. */
  static final class Way {
    final String channel;
    final Pose latest;
    final List<Pose> poses;

    Way(String channel, Trail<Pose> trail) {
      this.channel = channel;
      latest = trail.latest();
      poses = trail.poses();
    }
  }

  synchronized List<Way> ways() {
    List<Way> ways = new ArrayList<>();
    for (Map.Entry<String, Trail<Pose>> e : trails.entrySet()) ways.add(new Way(e.getKey(), e.getValue()));
    return ways;
  }

  /** The scan that the pose of this time stems from, as far as known; null before the first. */
  synchronized Scan scanAt(long utime) {
    Scan newest = null;
    for (Scan scan : scans.getOrDefault(lidar(), new ArrayDeque<>())) {
      if (newest == null || scan.utime <= utime) newest = scan;  // a scan comes before its pose
    }
    return newest;
  }

  /** Whose scans the estimate uses: channels LIDAR_2D_... are further lidars. */
  private String lidar() {
    for (String channel : scans.keySet()) {
      if (!scans.containsKey(MAIN_LIDAR) && !channel.startsWith(MAIN_LIDAR)) return channel;
    }
    return MAIN_LIDAR;
  }

  /** Of that lidar, T_body_lidar: x, y, yaw. Zeros where nothing is known. */
  synchronized double[] mounting() {
    return mountings.getOrDefault(lidar(), new double[3]).clone();
  }
}
