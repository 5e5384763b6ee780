# SPDX-License-Identifier: MIT
# Figures 2, 4, 5 of the ICSPM paper and the convergence in 2D and 3D, from the data files in a folder:
#     gnuplot -c examples/papers/icspm.gp build/figures
cd ARG1
set terminal pngcairo size 900,560 font "sans,12"
set datafile separator ","
set key left top
set grid linecolor rgb "#dddddd"
set xlabel "x"

array name[4] = ["icspm_fig2", "icspm_fig4_c2", "icspm_fig4_c3", "icspm_fig5"]
array title[4] = ["Figure 2: f'' on uniform particles, N = 41, h = 1/20", "Figure 4, top: f'' on random particles, N = 41, c = 2", \
    "Figure 4, bottom: f'' on random particles, N = 41, c = 3", "Figure 5: solutions of the boundary value problem, random particles, N = 41, c = 2"]
do for [i = 1:4] {
    if (system(sprintf("test -r %s.csv && echo yes", name[i])) eq "yes") {
        set output name[i].".png"
        set title title[i]
        set ylabel i < 4 ? "f''" : "u"
        if (i < 4) { set yrange [-20:20] } else { set yrange [*:*] }
        plot name[i].".csv" using 1:3 every ::1 with linespoints pointtype 6 linecolor rgb "#d55e00" title "CSPM", \
            "" using 1:4 every ::1 with linespoints pointtype 4 linecolor rgb "#0072b2" title "BIM", \
            "" using 1:5 every ::1 with linespoints pointtype 7 linecolor rgb "#009e73" title "ICSPM", \
            "" using 1:2 every ::1 with lines linewidth 2 linecolor rgb "black" title "exact"
    }
}

if (system("test -r icspm_convergence.csv && echo yes") eq "yes") {
    set output "icspm_convergence.png"
    set terminal pngcairo size 1200,560 font "sans,12"
    set multiplot layout 1,2 title "Maximum error of the Hessian, boundaries and corners included (jittered particles)"
    set logscale xy
    set yrange [*:*]
    set key left bottom
    set xlabel "particles per side"
    set ylabel "max |Hessian - exact|"
    do for [d = 2:3] {
        set title sprintf("%dD", d)
        set xrange [(d == 2 ? 9 : 8):(d == 2 ? 200 : 40)]
        array method[4] = ["CSPM", "ICSPM", "ICSPM or WLS", "WLS"]
        plot for [m = 1:4] "icspm_convergence.csv" using ($1 == d && $2 > 0 && strcol(3) eq method[m] ? $4 : NaN):6 every ::1 with linespoints pointtype 7 title method[m]
    }
    unset multiplot
}
