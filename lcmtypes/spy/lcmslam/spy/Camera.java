package lcmslam.spy;

/** Looks at a point from a distance, from any side; z is up. Perspective. */
final class Camera {
  private static final double MIN_DISTANCE = 0.3, MAX_DISTANCE = 500, NEAR = 0.05, FOCAL = 1.1;  // focal length over image height

  double targetX, targetY, targetZ;
  private double azimuth = Math.toRadians(-125), elevation = Math.toRadians(40), distance = 12;  // of the eye, seen from the target
  private int width, height;
  private double[] right, up, forward;
  private double eyeX, eyeY, eyeZ;

  void orbit(double dAzimuth, double dElevation) {
    azimuth += dAzimuth;
    elevation = Math.max(Math.toRadians(-89), Math.min(Math.toRadians(89), elevation + dElevation));
  }

  void zoom(double factor) {
    moveTo(distance * factor);
  }

  /** So far (m) from the target. */
  void moveTo(double newDistance) {
    distance = Math.max(MIN_DISTANCE, Math.min(MAX_DISTANCE, newDistance));
  }

  double distance() {
    return distance;
  }

  /** So many pixels right and down. */
  void pan(double dx, double dy) {
    double meters = distance / (FOCAL * height);
    targetX += (-right[0] * dx + up[0] * dy) * meters;
    targetY += (-right[1] * dx + up[1] * dy) * meters;
    targetZ += (-right[2] * dx + up[2] * dy) * meters;
  }

  /** Before a picture of this size is drawn. */
  void aim(int imageWidth, int imageHeight) {
    width = imageWidth;
    height = imageHeight;
    double ca = Math.cos(azimuth), sa = Math.sin(azimuth), ce = Math.cos(elevation), se = Math.sin(elevation);
    forward = new double[] {-ca * ce, -sa * ce, -se};
    right = new double[] {-sa, ca, 0};
    up = new double[] {-ca * se, -sa * se, ce};
    eyeX = targetX - distance * forward[0];
    eyeY = targetY - distance * forward[1];
    eyeZ = targetZ - distance * forward[2];
  }

  /** Pixel column, row and depth (m) into `to`; false when behind the eye. */
  boolean project(double x, double y, double z, double[] to) {
    double dx = x - eyeX, dy = y - eyeY, dz = z - eyeZ;
    double depth = dot(forward, dx, dy, dz);
    if (depth < NEAR) return false;
    double scale = pixelsPerMeter(depth);
    to[0] = width / 2.0 + scale * dot(right, dx, dy, dz);
    to[1] = height / 2.0 - scale * dot(up, dx, dy, dz);
    to[2] = depth;
    return true;
  }

  /** Whether the eye is on the side of a plane that its normal points to. */
  boolean sees(double x, double y, double z, double nx, double ny, double nz) {
    return (eyeX - x) * nx + (eyeY - y) * ny + (eyeZ - z) * nz > 0;
  }

  double pixelsPerMeter(double depth) {
    return FOCAL * height / depth;
  }

  /** A direction of the map as right, up, forward. */
  double[] turn(double x, double y, double z) {
    return new double[] {dot(right, x, y, z), dot(up, x, y, z), dot(forward, x, y, z)};
  }

  private static double dot(double[] a, double x, double y, double z) {
    return a[0] * x + a[1] * y + a[2] * z;
  }
}
