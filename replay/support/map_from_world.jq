# T_map_world from the JSON that evaluator writes, as gnuplot's variables: translation t1, t2, t3, rotation r11 ... r33.
.alignment.T_world_map
| . as {qw: $w, qx: $x, qy: $y, qz: $z, x_m: $tx, y_m: $ty, z_m: $tz}
# The transposed rotation of T_world_map.
| [[1 - 2 * ($y * $y + $z * $z), 2 * ($x * $y + $w * $z), 2 * ($x * $z - $w * $y)],
   [2 * ($x * $y - $w * $z), 1 - 2 * ($x * $x + $z * $z), 2 * ($y * $z + $w * $x)],
   [2 * ($x * $z + $w * $y), 2 * ($y * $z - $w * $x), 1 - 2 * ($x * $x + $y * $y)]]
| to_entries
| map((.key + 1) as $row | .value as [$a, $b, $c]
      | "t\($row) = \(-($a * $tx + $b * $ty + $c * $tz)); r\($row)1 = \($a); r\($row)2 = \($b); r\($row)3 = \($c)")
| join("; ")
