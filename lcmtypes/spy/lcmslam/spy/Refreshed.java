package lcmslam.spy;

/** A view that is redrawn a few times a second, on the Swing thread. */
interface Refreshed {
  void refresh();
}
