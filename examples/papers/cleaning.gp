# SPDX-License-Identifier: MIT
# The disc and the drop of the paper on divergence cleaning, from the data files in `dir`:
#     gnuplot -e "dir='build/figures/'" examples/papers/cleaning.gp
set datafile separator ","
set grid linecolor rgb "#dddddd"
there(name) = system(sprintf("test -r %s%s.csv && echo yes", dir, name)) eq "yes"
array color[4] = ["#0072b2", "#d55e00", "#009e73", "#000000"]

if (there("cleaning_fig1")) {
    set output dir."cleaning_fig1.png"
    set terminal pngcairo size 900,900 font "sans,12"
    set multiplot layout 2,1 title "Figure 1: largest div B of the disc with a free boundary, ch = 1"
    set logscale y
    set format y "10^{%L}"
    set xrange [0:10]
    set yrange [1e-4:1e5]
    set xlabel "t"
    set ylabel "max |div B|"
    array form[2] = ["non-conservative", "constrained"]
    array scheme[2] = ["RK4", "Verlet"]
    do for [f = 1:2] {
        set title form[f].", ".scheme[f]
        plot for [s = 1:2] dir."cleaning_fig1.csv" using (strcol(1) eq form[f] && strcol(2) eq scheme[f] && ($3 > 0) == (s == 2) ? $4 : NaN):5 every ::1 \
            with lines linewidth 2 linecolor rgb color[s] title s == 1 ? "hyperbolic" : "hyperbolic/parabolic, sigma = 0.3"
    }
    unset multiplot
    unset logscale
    set format y
    set autoscale
    unset ylabel
}

if (there("cleaning_fig7")) {
    set output dir."cleaning_fig7.png"
    set terminal pngcairo size 1500,1000 font "sans,12"
    set multiplot layout 2,3 title "Figure 7: the drop, cleaned, alpha = 0.01; the line is the ellipse without compressibility; colour: 100 (rho / rho0 - 1)"
    set size ratio -1
    set xrange [-2:2]
    set yrange [-2:2]
    set palette defined (-1 "#0072b2", 0 "#999999", 1 "#d55e00")
    set cbrange [-2:2]
    set trange [0:2*pi]
    unset key
    unset xlabel
    array moment[6] = [0, 0.006, 0.012, 0.018, 0.024, 0.036]
    do for [k = 1:6] {
        ax = 0
        ay = 0
        stats dir."cleaning_fig8.csv" using (strcol(2) eq "ellipse" && abs($3 - moment[k]) < 1e-6 ? (ax = $8, ay = $9, $8) : NaN) every ::1 nooutput
        set title sprintf("t = %g", moment[k])
        set parametric
        plot dir."cleaning_fig7.csv" using (strcol(2) eq "cleaned" && abs($3 - moment[k]) < 1e-6 ? $4 : NaN):5:(100 * $6) every ::1 with points pointtype 7 pointsize 0.4 linecolor palette, \
            ax * cos(t), ay * sin(t) with lines linecolor rgb "black"
        unset parametric
    }
    unset multiplot
    set size noratio
    set autoscale
    set key default
}

# here, because blocks take macros as they are when the block begins
curves = 'for [s = 1:2] dir."cleaning_fig8.csv" using (strcol(1) eq viscosity[a] && strcol(2) eq run[s] ? $3 : NaN):(column(column_of[f])) every ::2 with lines linewidth 2 linecolor rgb color[3 - s] title run[s]'
if (there("cleaning_fig8")) {
    array viscosity[3] = ["0.01", "0", "0.1"]
    array run[2] = ["control", "cleaned"]
    array column_of[3] = [4, 5, 6]
    array title_of[3] = ["Figure 8: mean |div v|", "Figure 9: largest |rho / rho0 - 1|", "Figure 10: kinetic energy"]
    do for [f = 1:3] {
        set output dir.sprintf("cleaning_fig%d.png", f + 7)
        set terminal pngcairo size 1500,520 font "sans,12"
        set multiplot layout 1,3 title title_of[f]." of the drop"
        set xlabel "t"
        set xrange [0:0.1]
        if (f < 3) {
            set logscale y
            set format y "10^{%L}"
        }
        if (f == 1) { set yrange [0.1:1000] }
        if (f == 2) { set yrange [1e-3:0.2] }
        if (f == 3) { set yrange [0:11e6] }
        do for [a = 1:3] {
            set title "alpha = ".viscosity[a]
            if (f < 3) {
                plot @curves
            } else {
                plot @curves, dir."cleaning_fig8.csv" using (strcol(2) eq "ellipse" ? $3 : NaN):6 every ::1 with lines dashtype 2 linecolor rgb "black" title "ellipse without compressibility"
            }
        }
        unset multiplot
        unset logscale
        set format y
        set autoscale
    }
}


# the Orszag-Tang vortex: figure 2 (fields at the end) and figure 3 (errors over time)
vortices = system(sprintf("cd '%s' && ls cleaning_orszag_tang_fig2_*.csv 2> /dev/null", dir))
do for [file in vortices] {
    # with the four cases of figure 2, and to their ends
    if (system(sprintf("cut -d, -f1 '%s%s' | sort -u | grep -c -x -e '\"control\"' -e '\"resistivity\"' -e '\"Euler potentials\"' -e '\"cleaning\"'", dir, file)) + 0 == 4) {
        reset
        set datafile separator ","
        columns = file[27:strlen(file) - 4] + 0
        set output dir.file[1:strlen(file) - 4].".png"
        set terminal pngcairo size 1800,1320 font "sans,12"
        set multiplot layout 3,4 title sprintf("Figure 2: the Orszag-Tang vortex, %d columns of particles", columns)
        set size ratio 1
        set xrange [0:1]
        set yrange [0:1]
        unset key
        unset xtics
        unset ytics
        array vortex[4] = ["control", "resistivity", "Euler potentials", "cleaning"]
        array quantity[3] = ["density", "magnetic pressure", "div B"]
        array low[3] = [0.05, 0, -5]
        array high[3] = [0.4, 0.3, 5]
        do for [q = 1:3] {
            if (q < 3) { set palette rgbformulae 33,13,10 } else { set palette defined (-1 "#0072b2", 0 "#ffffff", 1 "#d55e00") }
            set cbrange [low[q]:high[q]]
            do for [c = 1:4] {
                set title vortex[c].", ".quantity[q]
                plot dir.file using (strcol(1) eq vortex[c] ? $2 : NaN):3:(column(3 + q)) every ::1 with points pointtype 7 pointsize (60.0 / columns) linecolor palette
            }
        }
        unset multiplot
    }
}
if (there("cleaning_orszag_tang_fig3")) {
    reset
    set datafile separator ","
    history = dir."cleaning_orszag_tang_fig3.csv"
    sizes = system(sprintf("tail -n +2 '%s' | cut -d, -f1 | sort -u -n", history))
    set output dir."cleaning_orszag_tang_fig3.png"
    set terminal pngcairo size 1500,(560 * ((words(sizes) + 1) / 2)) font "sans,12"
    down = (words(sizes) + 1) / 2
    set multiplot layout down,2 title "Figure 3: the Orszag-Tang vortex, mean of h |div B| / |B|"
    set logscale y
    set format y "10^{%L}"
    set xrange [0:1]
    set yrange [1e-4:1]
    set xlabel "t"
    set grid linecolor rgb "#dddddd"
    set key bottom right
    array vortex[7] = ["control", "resistivity", "Euler potentials", "Euler potentials with dissipation", "cleaning", "cleaning with resistivity", "non-conservative cleaning"]
    array stroke[7] = ["#000000", "#0072b2", "#009e73", "#009e73", "#d55e00", "#cc79a7", "#999999"]
    array dashes[7] = [1, 1, 1, 2, 1, 1, 1]
    do for [size in sizes] {
        set title size." columns"
        plot for [c = 1:7] history using ($1 == (size + 0) && strcol(2) eq vortex[c] && $3 > 0 ? $3 : NaN):4 every ::1 with lines linewidth 2 \
            dashtype dashes[c] linecolor rgb stroke[c] title vortex[c]
    }
    unset multiplot
}
