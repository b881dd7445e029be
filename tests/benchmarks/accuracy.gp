# gnuplot -e "data='accuracy.txt'" tests/benchmarks/accuracy.gp > docs/pictures/accuracy.png
set terminal pngcairo size 640,440 font "Sans,11"
set logscale xy
set xlabel "samples"
set ylabel "deviation from the true surface, in spacings"
set format x "10^{%L}"
set format y "10^{%L}"
set xrange [5e4:5e6]
set grid
set key below maxrows 2 width -2
rows(method, column) = sprintf("<awk '$4==\"%s\" { print $2, $%d }' %s", method, column, data)
plot rows("linear", 8) with linespoints lc rgb "#d55e00" dt 2 pt 6 title "linear, largest", \
     rows("linear", 6) with linespoints lc rgb "#d55e00" pt 7 title "linear, mean", \
     rows("marching_cubes", 8) with linespoints lc rgb "#555555" dt 2 pt 4 title "marching cubes, largest", \
     rows("marching_cubes", 6) with linespoints lc rgb "#555555" pt 5 title "marching cubes, mean", \
     rows("smooth", 8) with linespoints lc rgb "#0072b2" dt 2 pt 6 title "smooth, largest", \
     rows("smooth", 6) with linespoints lc rgb "#0072b2" pt 7 title "smooth, mean"
