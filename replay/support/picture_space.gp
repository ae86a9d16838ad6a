# Called by replay/picture for a map in space, which sets: map, header, vertices and vertex of the map's PLY (bytes before the
# first vertex, their number, their format: position, normal, and perhaps a radius); estimate, picture; and where there is
# ground truth: truth, caption, and T_map_world as t1, t2, t3 and r11 ... r33.
# Above the plan, below a view along the y axis. A surfel is drawn as what is seen of a disc from its edge; those that face the
# eye, as the ceiling's, would hide the rest and are left out.
has_truth = exists('truth')
stats map binary skip=(header) record=(vertices) format=vertex using 1:2 name 'plan' nooutput
stats map binary skip=(header) record=(vertices) format=vertex using 3 name 'height' nooutput

# Both views at one scale, one above the other; lengths in pixels.
edge_m = 0.5
x_min = plan_min_x - edge_m; x_max = plan_max_x + edge_m
y_min = plan_min_y - edge_m; y_max = plan_max_y + edge_m
z_min = height_min - edge_m; z_max = height_max + edge_m
wide = 900.0; left = 70.0; right = 10.0; top = 35.0; between = 35.0; bottom = 60.0
pixels_per_m = (wide - left - right) / (x_max - x_min)
plan_tall = (y_max - y_min) * pixels_per_m
side_tall = (z_max - z_min) * pixels_per_m
tall = top + plan_tall + between + side_tall + bottom

set terminal pngcairo size wide, tall font 'sans,11' linewidth 1
set output picture
set multiplot
set lmargin at screen left / wide
set rmargin at screen 1 - right / wide
set tics out nomirror
set xrange [x_min : x_max]
set style line 1 linecolor '#e69f00' linewidth 5
set style line 2 linecolor '#0072b2' linewidth 1.6
set style line 3 linecolor '#26323a' linewidth 1.2
radius_column = has_radius ? 7 : 1 # one that the format has
radius(value) = has_radius ? value : 0.02
# A disc of radius r whose normal has the components n and m in the view and o towards the eye: half of its edge, along the
# axis of m.
half(r, n, m, o) = abs(o) < 0.7 ? r * n / sqrt(n * n + m * m) : NaN
world(x, y, z, t, rx, ry, rz) = t + rx * x + ry * y + rz * z

set bmargin at screen (bottom + side_tall + between) / tall
set tmargin at screen 1 - top / tall
set ylabel 'y in m'
set yrange [y_min : y_max]
set key horizontal outside top left
if (has_truth) {
  plot truth using (world($2, $3, $4, t1, r11, r12, r13)):(world($2, $3, $4, t2, r21, r22, r23)) with lines linestyle 1 \
         title 'ground truth'
}
set key right
plot map binary skip=(header) record=(vertices) format=vertex \
       using ($1 - half(radius(column(radius_column)), $5, $4, $6)):($2 + half(radius(column(radius_column)), $4, $5, $6)): \
             (2 * half(radius(column(radius_column)), $5, $4, $6)):(-2 * half(radius(column(radius_column)), $4, $5, $6)) \
       with vectors nohead linestyle 3 notitle, \
     estimate using 2:3 with lines linestyle 2 title 'estimate' . (has_truth ? ', ' . caption : '')

set bmargin at screen bottom / tall
set tmargin at screen (bottom + side_tall) / tall
set xlabel 'x in m'
set ylabel 'z in m'
set yrange [z_min : z_max]
unset key
if (has_truth) {
  plot truth using (world($2, $3, $4, t1, r11, r12, r13)):(world($2, $3, $4, t3, r31, r32, r33)) with lines linestyle 1
}
plot map binary skip=(header) record=(vertices) format=vertex \
       using ($1 - half(radius(column(radius_column)), $6, $4, $5)):($3 + half(radius(column(radius_column)), $4, $6, $5)): \
             (2 * half(radius(column(radius_column)), $6, $4, $5)):(-2 * half(radius(column(radius_column)), $4, $6, $5)) \
       with vectors nohead linestyle 3, \
     estimate using 2:4 with lines linestyle 2
