# SPDX-License-Identifier: MIT
# The figures of the paper on particle clustering, from the data files in `dir`:
#     gnuplot -e "dir='build/figures/'" examples/papers/clustering.gp
set datafile separator ","
set grid linecolor rgb "#dddddd"
there(name) = system(sprintf("test -r %s%s.csv && echo yes", dir, name)) eq "yes"
array color[4] = ["#000000", "#d55e00", "#0072b2", "#009e73"]

if (there("clustering_fig2")) {
    set output dir."clustering_fig2.png"
    set terminal pngcairo size 800,520 font "sans,12"
    set title "Figure 2: kernels (solid) and their gradients (dashed), one dimension, h = 1"
    set xlabel "R"
    set key top right
    array kernel[3] = ["quartic", "(1.1)", "convex (3.9)"]
    plot for [k = 1:3] dir."clustering_fig2.csv" using 1:(column(k + 1)) every ::1 with lines linewidth 2 linecolor rgb color[k] title kernel[k], \
        for [k = 1:3] "" using 1:(column(k + 4)) every ::1 with lines linewidth 2 dashtype 2 linecolor rgb color[k] notitle
}

# Figures 1 and 3: a row for each background pressure
if (there("clustering_box_collisions_p0")) {
    set output dir."clustering_box.png"
    set terminal pngcairo size 1600,840 font "sans,12"
    set multiplot layout 2,4 title "Figures 1 and 3: the box at the start and at t = 2"
    set size ratio 1
    set xrange [0:1]
    set yrange [0:1]
    unset xlabel
    unset key
    array run[3] = ["untreated", "convex", "collisions"]
    array run_title[3] = ["Figure 1: (1.1)", "Figure 3: convex (3.9)", "Figure 3: (1.1) and collisions"]
    do for [p = 1:2] {
        end = p == 1 ? "_0" : "_p0"
        what = p == 1 ? "p0 = 0" : "p0 = rho0 c^2"
        set title "Figure 1: initial"
        plot dir."clustering_box_initial.csv" using 1:2 every ::1 with points pointtype 7 pointsize 0.5 linecolor rgb "black"
        do for [a = 1:3] {
            set title run_title[a].", ".what
            plot dir."clustering_box_".run[a].end.".csv" using 1:2 every ::1 with points pointtype 7 pointsize 0.5 linecolor rgb "black"
        }
    }
    unset multiplot
    set size noratio
    set autoscale
    set key
}

if (there("clustering_fig5")) {
    set output dir."clustering_fig5.png"
    set terminal pngcairo size 900,560 font "sans,12"
    set title "Figure 5: error of the pressure gradient of a column of water"
    set xlabel "t [s]"
    set ylabel "error [%]"
    set yrange [-1:7]
    set key top right
    array method[3] = ["particle collisions h = 1.5 dref", "convex kernel (3.9) h = 1.5 dref", "convex kernel (3.9) h = 2 dref"]
    array method_title[3] = ["(1.1), with and without collisions, h = 1.5 dref", "convex (3.9), h = 1.5 dref", "convex (3.9), h = 2 dref"]
    array method_color[3] = ["#0072b2", "#d55e00", "#56b4e9"]
    plot for [k = 2:3] dir."clustering_fig5.csv" using (strcol(1) eq method[k] ? $2 : NaN):3 every ::1 with lines linecolor rgb method_color[k] title method_title[k], \
        "" using (strcol(1) eq method[1] ? $2 : NaN):3 every ::1 with lines linecolor rgb method_color[1] title method_title[1]
    unset ylabel
    set autoscale
}
