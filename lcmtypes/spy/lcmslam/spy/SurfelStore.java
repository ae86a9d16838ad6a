package lcmslam.spy;

import java.util.ArrayList;
import java.util.Iterator;
import java.util.LinkedHashMap;
import java.util.List;
import java.util.Map;
import java.util.Set;
import java.util.TreeSet;
import lcmslam.surfel_chunk_t;

/** The surfels of a map as it changes, by the rules of surfel_chunk_t; of too many the oldest go. One thread at a time. */
final class SurfelStore {
  private static final int MAX_SURFELS = 300_000;
  private static final int MAX_SIZES = 16;  // an octree's depth

  /** A piece of surface, map frame, m; the normal has length one. */
  static final class Surfel {
    final float x, y, z, normalX, normalY, normalZ, cellSize;

    private Surfel(surfel_chunk_t m, int i) {
      x = m.x[i];
      y = m.y[i];
      z = m.z[i];
      normalX = m.normal_x[i];
      normalY = m.normal_y[i];
      normalZ = m.normal_z[i];
      cellSize = m.cell_size[i];
    }

    private boolean isUsable() {
      return Float.isFinite(x + y + z + normalX + normalY + normalZ) && Float.isFinite(cellSize) && cellSize > 0;
    }
  }

  /** A cube of space whose corners lie at whole multiples of its edge. */
  private static final class Cell {
    final float size;
    final long x, y, z;

    private Cell(float size, long x, long y, long z) {
      this.size = size;
      this.x = x;
      this.y = y;
      this.z = z;
    }

    static Cell around(Surfel s, float size) {
      return new Cell(size, floor(s.x / size), floor(s.y / size), floor(s.z / size));
    }

    /** The larger cell that this one lies in. */
    Cell within(float larger) {
      double ratio = size / (double) larger;
      return new Cell(larger, floor((x + 0.5) * ratio), floor((y + 0.5) * ratio), floor((z + 0.5) * ratio));
    }

    private static long floor(double value) {
      return (long) Math.floor(value);
    }

    @Override
    public boolean equals(Object other) {
      if (!(other instanceof Cell)) return false;
      Cell cell = (Cell) other;
      return size == cell.size && x == cell.x && y == cell.y && z == cell.z;
    }

    @Override
    public int hashCode() {
      return Float.hashCode(size) + (int) (73856093 * x ^ 19349663 * y ^ 83492791 * z);
    }
  }

  private final Map<Cell, Surfel> surfels = new LinkedHashMap<>();  // oldest first
  private final TreeSet<Float> sizes = new TreeSet<>();
  private int epoch;

  void add(surfel_chunk_t m) {
    if (m.epoch != epoch) clear();
    epoch = m.epoch;
    if (sizes.size() >= MAX_SIZES) clear();  // no map has as many; what is real comes again
    Map<Cell, Surfel> changed = new LinkedHashMap<>();
    for (int i = 0; i < m.num_surfels; ++i) {
      Surfel surfel = new Surfel(m, i);
      if (!surfel.isUsable() || !(sizes.contains(surfel.cellSize) || sizes.size() < MAX_SIZES)) continue;
      sizes.add(surfel.cellSize);
      changed.put(Cell.around(surfel, surfel.cellSize), surfel);
    }
    makeRoom(changed.keySet());
    surfels.putAll(changed);
    forgetOldest();
  }

  /** Removes what is in the same place: cells that are, hold, or lie in one of these. */
  private void makeRoom(Set<Cell> cells) {
    Set<Float> newSizes = new TreeSet<>();
    for (Cell cell : cells) {
      newSizes.add(cell.size);
      surfels.remove(cell);
      for (float larger : sizes.tailSet(cell.size, false)) surfels.remove(cell.within(larger));
    }
    if (cells.isEmpty()) return;
    newSizes.remove(sizes.first());  // in the smallest lies none
    if (newSizes.isEmpty()) return;
    surfels.keySet().removeIf(old -> newSizes.stream().anyMatch(size -> size > old.size && cells.contains(old.within(size))));
  }

  private void forgetOldest() {
    Iterator<Cell> oldest = surfels.keySet().iterator();
    while (surfels.size() > MAX_SURFELS) {
      oldest.next();
      oldest.remove();
    }
  }

  void clear() {
    surfels.clear();
    sizes.clear();
  }

  List<Surfel> all() {
    return new ArrayList<>(surfels.values());
  }
}
