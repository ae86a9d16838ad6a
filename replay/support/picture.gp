# Called by replay/picture, which sets: map, estimate, picture; width, height, header, cell_m, x0_m, y0_m of the map's PGM;
# and where there is ground truth: truth, caption, and T_map_world as t1, t2, t3 and r11 ... r33.
has_truth = exists('truth')
set terminal pngcairo size 900, 900 * height / width + 60 font 'sans,11' linewidth 1
set output picture
set size ratio -1
set palette defined (0 '#26323a', 205 '#e4e7e9', 254 '#ffffff')
set cbrange [0:254]
unset colorbox
set xlabel 'x in m'
set ylabel 'y in m'
set xrange [x0_m : x0_m + width * cell_m]
set yrange [y0_m : y0_m + height * cell_m]
set tics out nomirror
set key horizontal outside top center
in_map_x(x, y) = t1 + r11 * x + r12 * y
in_map_y(x, y) = t2 + r21 * x + r22 * y
set style line 1 linecolor '#e69f00' linewidth 5
set style line 2 linecolor '#0072b2' linewidth 1.6
if (has_truth) {
  plot map binary array=(width, height) skip=header format='%uchar' flipy dx=cell_m dy=cell_m \
         origin=(x0_m + cell_m / 2, y0_m + cell_m / 2) with image notitle, \
       truth using (in_map_x($2, $3)):(in_map_y($2, $3)) with lines linestyle 1 title 'ground truth', \
       estimate using 2:3 with lines linestyle 2 title 'estimate, ' . caption
} else {
  plot map binary array=(width, height) skip=header format='%uchar' flipy dx=cell_m dy=cell_m \
         origin=(x0_m + cell_m / 2, y0_m + cell_m / 2) with image notitle, \
       estimate using 2:3 with lines linestyle 2 title 'estimate'
}
