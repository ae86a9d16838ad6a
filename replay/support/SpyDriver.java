import java.awt.Component;
import java.awt.Container;
import java.awt.Frame;
import java.awt.Point;
import java.awt.Rectangle;
import java.awt.Robot;
import java.awt.event.InputEvent;
import java.io.File;
import java.nio.file.Files;
import java.nio.file.Path;
import java.nio.file.Paths;
import java.util.ArrayList;
import java.util.List;
import java.util.function.Supplier;
import javax.imageio.ImageIO;
import javax.swing.JTable;
import javax.swing.SwingUtilities;

/**
 * A Java agent that works lcm-spy with the mouse, as a person does. Its argument is a folder: it does what the lines of the
 * file `todo` there say, once that appears, writes what it saw beside it, ends lcm-spy, and leaves `done` or `failed`.
 *
 * <pre>
 * table                 writes channels.tsv: the cells of the channel list
 * open CHANNEL NAME     double-clicks the channel; NAME.png is what the window that opens shows
 * wheel NAME            three notches towards the picture
 * drag NAME             drags the left button across
 * close                 closes every window but the list
 * await NAME            waits until there is a file NAME
 * </pre>
 */
public final class SpyDriver {
  private static final int PATIENCE_MS = 30_000, SETTLE_MS = 1_500;

  private final Path folder;
  private final Robot robot;
  private Frame view;

  private SpyDriver(Path folder) throws Exception {
    this.folder = folder;
    robot = new Robot();
    robot.setAutoDelay(30);
  }

  public static void premain(String folder) {
    Thread driver = new Thread(() -> drive(Paths.get(folder)), "driver");
    driver.setDaemon(true);
    driver.start();
  }

  private static void drive(Path folder) {
    try {
      JTable table = await("the channel list", () -> find(JTable.class, Frame.getFrames()));
      Files.createFile(folder.resolve("ready"));
      Path todo = folder.resolve("todo");
      while (!Files.exists(todo)) Thread.sleep(50);
      SpyDriver driver = new SpyDriver(folder);
      for (String line : Files.readAllLines(todo)) driver.obey(table, line.trim().split(" +"));
      Files.createFile(folder.resolve("done"));
    } catch (Throwable error) {
      error.printStackTrace();
      folder.resolve("failed").toFile().mkdir();
    }
    Runtime.getRuntime().halt(0);
  }

  private void obey(JTable table, String[] words) throws Exception {
    switch (words[0]) {
      case "table": write(table); break;
      case "open": open(table, words[1]); capture(words[2]); break;
      case "wheel": robot.mouseWheel(-3); capture(words[1]); break;
      case "drag": drag(); capture(words[1]); break;
      case "await": while (!Files.exists(folder.resolve(words[1]))) Thread.sleep(50); break;
      case "close": close(SwingUtilities.getWindowAncestor(table)); break;
      default: throw new IllegalArgumentException(words[0]);
    }
  }

  private void write(JTable table) throws Exception {
    Files.write(folder.resolve("channels.tsv"), await("the channel list", () -> linesOf(table)));
  }

  /** Null: it is just being changed. */
  private static List<String> linesOf(JTable table) {
    List<String> lines = new ArrayList<>();
    for (int row = 0; row < table.getRowCount(); ++row) {
      StringBuilder line = new StringBuilder();
      for (int column = 0; column < table.getColumnCount(); ++column) {
        Object cell = cell(table, row, column);
        if (cell == null) return null;
        line.append(column > 0 ? "\t" : "").append(cell);
      }
      lines.add(line.toString());
    }
    return lines;
  }

  /** Null: not there any more. lcm-spy changes its list while Swing shows it. */
  private static Object cell(JTable table, int row, int column) {
    try {
      return table.getValueAt(row, column);
    } catch (IndexOutOfBoundsException changed) {
      return null;
    }
  }

  private void open(JTable table, String channel) throws Exception {
    view = null;
    // A channel that comes up meanwhile moves the rows below it: then another one is hit.
    for (long end = System.currentTimeMillis() + PATIENCE_MS; view == null && System.currentTimeMillis() < end;) {
      doubleClick(table, await(channel, () -> rowOf(table, channel)));
      view = within(SETTLE_MS, () -> viewOf(channel));
    }
    if (view == null) throw new IllegalStateException("no view of " + channel);
    view.toFront();
    Thread.sleep(SETTLE_MS);
    Point at = view.getLocationOnScreen();
    robot.mouseMove(at.x + view.getWidth() / 2, at.y + view.getHeight() / 2);
  }

  private void doubleClick(JTable table, int row) {
    SwingUtilities.getWindowAncestor(table).toFront();
    table.scrollRectToVisible(table.getCellRect(row, 0, true));
    robot.waitForIdle();
    Rectangle cell = table.getCellRect(row, 0, true);
    Point corner = table.getLocationOnScreen();
    robot.mouseMove(corner.x + cell.x + 20, corner.y + cell.y + cell.height / 2);
    for (int click = 0; click < 2; ++click) {
      robot.mousePress(InputEvent.BUTTON1_DOWN_MASK);
      robot.mouseRelease(InputEvent.BUTTON1_DOWN_MASK);
    }
  }

  /** Null: there is none. lcm-spy opens a window with the fields as well, which is titled with the channel alone. */
  private static Frame viewOf(String channel) {
    for (Frame frame : Frame.getFrames()) {
      if (frame.isShowing() && frame.getTitle().endsWith(": " + channel)) return frame;
    }
    return null;
  }

  private static void close(Component list) {
    for (Frame frame : Frame.getFrames()) {
      if (frame != list) frame.dispose();
    }
  }

  private static Integer rowOf(JTable table, String channel) {
    for (int row = 0; row < table.getRowCount(); ++row) {
      if (channel.equals(cell(table, row, 0))) return row;
    }
    return null;
  }

  private void drag() {
    Point at = view.getLocationOnScreen();
    int x = at.x + view.getWidth() / 2, y = at.y + view.getHeight() / 2;
    robot.mousePress(InputEvent.BUTTON1_DOWN_MASK);
    for (int i = 1; i <= 10; ++i) robot.mouseMove(x + 12 * i, y + 6 * i);
    robot.mouseRelease(InputEvent.BUTTON1_DOWN_MASK);
  }

  /** What the window shows of itself, without its frame. */
  private void capture(String name) throws Exception {
    view.toFront();  // lcm-spy may have opened its window with the fields since
    robot.waitForIdle();
    Thread.sleep(300);  // a redraw
    Component content = view.getComponent(0);
    Rectangle area = new Rectangle(content.getLocationOnScreen(), content.getSize());
    ImageIO.write(robot.createScreenCapture(area), "png", new File(folder.toFile(), name + ".png"));
  }

  private static <T> T find(Class<T> kind, Component... components) {
    for (Component component : components) {
      if (kind.isInstance(component) && component.isShowing()) return kind.cast(component);
      T found = component instanceof Container ? find(kind, ((Container) component).getComponents()) : null;
      if (found != null) return found;
    }
    return null;
  }

  private static <T> T await(String what, Supplier<T> supplier) throws InterruptedException {
    T found = within(PATIENCE_MS, supplier);
    if (found == null) throw new IllegalStateException(what + ": not there after " + PATIENCE_MS / 1000 + " s");
    return found;
  }

  /** Null: it was not there in so many milliseconds. */
  private static <T> T within(int millis, Supplier<T> supplier) throws InterruptedException {
    for (long end = System.currentTimeMillis() + millis; System.currentTimeMillis() < end; Thread.sleep(50)) {
      T found = supplier.get();
      if (found != null) return found;
    }
    return null;
  }
}
