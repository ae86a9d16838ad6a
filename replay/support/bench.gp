# Called by replay/reproduce, which sets name and size: NAME.csv as Google Benchmark writes it becomes NAME.svg, a line for each function,
# its time over its first argument, the size.
set terminal svg size 560, 400 font 'sans-serif,12' background "white"
set output name . '.svg'
set datafile separator ','
set logscale x
set format x '10^{%L}'
set xlabel size noenhanced
set ylabel 'CPU time [ms]'
set yrange [0:]
set key below
set grid
rows = "< sed -n 's|^\"\\([A-Za-z0-9_]*\\)/\\([0-9]*\\)[^\"]*\"|\\1,\\2|p' " . name . '.csv'
functions = system("sed -n 's|^\"\\([A-Za-z0-9_]*\\)/.*|\\1|p' " . name . '.csv | uniq')
plot for [f in functions] rows using (strcol(1) eq f ? $2 : NaN):5 with linespoints pointtype 7 title f noenhanced
