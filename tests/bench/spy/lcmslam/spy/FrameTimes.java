package lcmslam.spy;

import java.awt.image.BufferedImage;
import java.io.File;
import java.lang.management.ManagementFactory;
import java.lang.management.ThreadMXBean;
import java.util.Arrays;
import java.util.Random;
import javax.imageio.ImageIO;
import lcmslam.point_cloud_chunk_t;
import lcmslam.pose_t;
import lcmslam.surfel_chunk_t;

/** Draws 30000 points and about 20000 surfels of a 12 x 8 x 3 m room from 300 sides; prints the time of a frame. An argument: a PNG of the last. */
final class FrameTimes {
  private static final int POINTS = 30_000, SURFELS = 24_000, FRAMES = 300, WIDTH = 1280, HEIGHT = 800;
  private static final float CELL_M = 0.05f;
  private static final ThreadMXBean CLOCK = ManagementFactory.getThreadMXBean();  // of this thread, so that other programs do not count
  private static final Random RANDOM = new Random(1);

  private FrameTimes() {}

  public static void main(String[] arguments) throws Exception {
    SpatialWorld world = new SpatialWorld();
    fill(world);
    SpatialWorld.Scene scene = world.scene();
    System.out.printf("%d points, %d surfels, %d x %d pixels%n", scene.sweep.length / 3, scene.surfels.size(), WIDTH, HEIGHT);
    SpatialView view = new SpatialView(world);
    view.setSize(WIDTH, HEIGHT);
    BufferedImage screen = new BufferedImage(WIDTH, HEIGHT, BufferedImage.TYPE_INT_RGB);
    double[] millis = new double[FRAMES];
    for (int i = 0; i < FRAMES; ++i) {
      long start = CLOCK.getCurrentThreadCpuTime();
      view.paintComponent(screen.getGraphics());
      millis[i] = (CLOCK.getCurrentThreadCpuTime() - start) * 1e-6;
      view.camera().orbit(2 * Math.PI / FRAMES, 0);
    }
    Arrays.sort(millis);
    System.out.printf("frame, on one core: median %.1f ms, p95 %.1f ms, max %.1f ms%n", millis[FRAMES / 2], millis[FRAMES * 95 / 100], millis[FRAMES - 1]);
    if (arguments.length > 0) ImageIO.write(screen, "png", new File(arguments[0]));
  }

  private static void fill(SpatialWorld world) {
    point_cloud_chunk_t sweep = new point_cloud_chunk_t();
    sweep.utime = 1;
    sweep.num_chunks = 1;
    sweep.num_points = POINTS;
    sweep.x = new float[POINTS];
    sweep.y = new float[POINTS];
    sweep.z = new float[POINTS];
    surfel_chunk_t map = new surfel_chunk_t();
    map.num_surfels = SURFELS;
    map.x = new float[SURFELS];
    map.y = new float[SURFELS];
    map.z = new float[SURFELS];
    map.normal_x = new float[SURFELS];
    map.normal_y = new float[SURFELS];
    map.normal_z = new float[SURFELS];
    map.cell_size = new float[SURFELS];
    Arrays.fill(map.cell_size, CELL_M);
    for (int i = 0; i < POINTS; ++i) {
      float[] p = onWall();
      sweep.x[i] = p[0];
      sweep.y[i] = p[1];
      sweep.z[i] = p[2];
    }
    for (int i = 0; i < SURFELS; ++i) {
      float[] p = onWall();
      map.x[i] = p[0];
      map.y[i] = p[1];
      map.z[i] = p[2];
      map.normal_x[i] = p[3];
      map.normal_y[i] = p[4];
      map.normal_z[i] = p[5];
    }
    world.addChunk("LIDAR_3D", sweep);
    world.addSurfels(map);
    pose_t pose = new pose_t();
    pose.utime = 1;
    pose.orientation[0] = 1;
    world.addPose("OCTO3D_POSE", pose);
  }

  /** A point of the floor or a wall, with its normal. */
  private static float[] onWall() {
    float x = 12 * RANDOM.nextFloat() - 6, y = 8 * RANDOM.nextFloat() - 4, z = 3 * RANDOM.nextFloat() - 1;
    switch (RANDOM.nextInt(4)) {
      case 0: return new float[] {x, 4.02f, z, 0, -1, 0};
      case 1: return new float[] {-6.02f, y, z, 1, 0, 0};
      default: return new float[] {x, y, -1.02f, 0, 0, 1};
    }
  }
}
