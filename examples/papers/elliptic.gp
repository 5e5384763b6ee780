# SPDX-License-Identifier: MIT
# The figures of the paper on the elliptic operator, from the data files in a folder:
#     gnuplot -c examples/papers/elliptic.gp build/figures
cd ARG1
set datafile separator ","
set grid linecolor rgb "#dddddd"
there(name) = system(sprintf("test -r %s.csv && echo yes", name)) eq "yes"
array gradient[4] = ["(15)", "(16)", "(17)", "(18)"]
array color[4] = ["#0072b2", "#d55e00", "#009e73", "#000000"]
array mark[4] = [6, 7, 2, 4]

if (there("elliptic_fig12")) {
    set output "elliptic_fig12.png"
    set terminal pngcairo size 1200,500 font "sans,12"
    set multiplot layout 1,2 title "div grad (x^2 + y^2) along y = 0, 11 x 11 nodes, f = 1"
    set xlabel "x"
    set key bottom center
    set title "Figure 1: Brookshaw"
    plot "elliptic_fig12.csv" using 1:3 every ::1 with linespoints pointtype 6 linecolor rgb color[1] title "(27), grad W", \
        "" using 1:4 every ::1 with linespoints pointtype 7 linecolor rgb color[2] title "(27), grad* W", \
        "" using 1:5 every ::1 with linespoints pointtype 4 linecolor rgb color[3] title "(51)", \
        "" using 1:2 every ::1 with lines linewidth 2 linecolor rgb "black" title "exact"
    set title "Figure 2: Schwaiger"
    plot "elliptic_fig12.csv" using 1:6 every ::1 with linespoints pointtype 6 linecolor rgb color[1] title "(52), grad W", \
        "" using 1:7 every ::1 with linespoints pointtype 7 linecolor rgb color[2] title "(52), grad* W in the first sum", \
        "" using 1:2 every ::1 with lines linewidth 2 linecolor rgb "black" title "exact"
    unset multiplot
}

array patch[2] = ["elliptic_fig3", "elliptic_fig4"]
array patch_title[2] = ["Figure 3: div grad (x^3 + y^3) along y = 2.5, 21 x 21 nodes, f = 1.2", "Figure 4: div((x + y) grad (x + y)) along y = 2.5, 21 x 21 nodes, f = 1.2"]
array scheme_title[4] = ["CB-SPH (51)", "S-SPH (52)", "M-SPH (69), Gamma", "M-SPH (69), Gamma*"]
do for [f = 1:2] {
    if (there(patch[f])) {
        set output patch[f].".png"
        set terminal pngcairo size 1200,900 font "sans,12"
        set multiplot layout 2,2 title patch_title[f]
        set xlabel "x"
        set key bottom center
        do for [s = 1:4] {
            set title scheme_title[s]
            plot for [g = 1:4] patch[f].".csv" using 1:(column(4 * s + g - 2)) every ::1 with linespoints pointtype mark[g] linecolor rgb color[g] title gradient[g], \
                "" using 1:2 every ::1 with lines linewidth 2 linecolor rgb "gray40" title "exact"
        }
        unset multiplot
    }
}

if (there("elliptic_fig5")) {
    set output "elliptic_fig5.png"
    set terminal pngcairo size 1500,950 font "sans,12"
    set multiplot layout 2,3 title "Figure 5: growth factors, 21 x 21 nodes, f = 1.2, tau = dx^2 / 4 (all particles and waves; the circle is |lambda| = 1)"
    set xlabel "Re"
    set ylabel "Im"
    set xrange [-1.15:1.15]
    set yrange [-1.15:1.15]
    set size ratio 1
    set key top left
    set parametric
    set trange [0:2*pi]
    array scheme[3] = ["CB", "S", "M"]
    array layout[2] = ["uniform", "perturbed"]
    do for [l = 1:2] {
        do for [s = 1:3] {
            set title scheme[s]."-SPH, ".layout[l]
            plot for [g = 1:4] "elliptic_fig5.csv" using (strcol(1) eq layout[l] && strcol(2) eq scheme[s] && strcol(3) eq gradient[g] ? $4 : NaN):5 every ::1 \
                with points pointtype mark[g] pointsize 0.5 linecolor rgb color[g] title gradient[g], cos(t), sin(t) with lines linecolor rgb "gray40" notitle
        }
    }
    unset multiplot
    unset parametric
    set size noratio
    set autoscale
    unset ylabel
}

if (there("elliptic_fig6")) {
    set output "elliptic_fig6.png"
    set terminal pngcairo size 1200,500 font "sans,12"
    set multiplot layout 1,2 title "Figure 6: |xi| of 50 random neighbourhoods in the unit disc"
    set logscale xy
    set xlabel "neighbours"
    set key top right
    array smoothing[2] = ["1", "0.5005"]
    array quantity[2] = ["mean", "deviation"]
    do for [q = 1:2] {
        set title quantity[q]
        plot for [a = 1:2] "elliptic_fig6.csv" using (strcol(1) eq smoothing[a] ? $2 : NaN):(column(2 + q)) every ::1 with linespoints pointtype mark[a] linecolor rgb color[a] \
            title "h = ".smoothing[a], (q == 1 ? 2.6 : 1.3) / sqrt(x) with lines dashtype 2 linecolor rgb "gray40" title "slope -1/2"
    }
    unset multiplot
    unset logscale
}

if (there("elliptic_table1")) {
    set output "elliptic_table1.png"
    set terminal pngcairo size 900,560 font "sans,12"
    set title "Table 1: error of the flow through a slit, explicit steps, nu = dt / dx^2"
    set xlabel "t"
    set ylabel "log10 E"
    set key bottom left
    set xrange [0:10]
    array nu[4] = ["0.1", "0.2", "0.25", "0.26"]
    plot for [a = 1:4] "elliptic_table1.csv" using (strcol(1) eq nu[a] && $2 < 0.9 ? $3 : NaN):4 every ::2 with lines linewidth 2 linecolor rgb color[a] title "nu = ".nu[a].", five points", \
        "" using (strcol(1) eq "0.26" && $2 > 0.9 ? $3 : NaN):4 every ::2 with lines linewidth 2 dashtype 2 linecolor rgb "#d55e00" title "nu = 0.26, nine points"
    unset ylabel
}

# figures 7, 8: solutions on 40 x 40
do for [f = 7:8] {
    name = sprintf("elliptic_fig%d", f)
    if (there(name)) {
        reset
        set datafile separator ","
        set output name.".png"
        set terminal pngcairo size 1200,1000 font "sans,12"
        set multiplot layout 2,2 title sprintf("Figure %d: Laplace's equation, %s conditions, 40 x 40, f = 1.001", f, f == 7 ? "Dirichlet" : "mixed")
        set size ratio -1
    set autoscale fix
        set palette rgbformulae 33,13,10
        array panel[4] = ["exact", "TPFA = MPFA", "mimetic", "M-SPH"]
        do for [p = 1:4] {
            set title panel[p]
            plot name.".csv" using 1:2:2+p every ::1 with image notitle
        }
        unset multiplot
    }
}

# figures 9, 10: permeability, solution, relative error
maps = system("ls elliptic_fig10_*.csv 2> /dev/null")
do for [file in maps] {
    reset
    set datafile separator ","
    set output file[1:strlen(file) - 4].".png"
    set terminal pngcairo size 1500,520 font "sans,12"
    set multiplot layout 1,3 title "Figures 9, 10: ".file[16:strlen(file) - 4]." (a layer of the block in 3D), M-SPH, f = 1.001, arithmetic means" noenhanced
    set size ratio -1
    set autoscale fix
    set palette rgbformulae 33,13,10
    set title "log10 of the permeability"
    plot file using 1:2:3 every ::1 with image notitle
    set title "u"
    plot file using 1:2:4 every ::1 with image notitle
    set title "|u - TPFA| / |TPFA|, logarithm"
    set logscale cb
    plot file using 1:2:($5 > 1e-8 ? $5 : 1e-8) every ::1 with image notitle
    unset multiplot
}

# figures 11, 12: residuals of GMRES
curves = system("ls elliptic_fig11_*.csv elliptic_fig12_*.csv 2> /dev/null")
do for [file in curves] {
    reset
    set datafile separator ","
    set output file[1:strlen(file) - 4].".png"
    set terminal pngcairo size 900,560 font "sans,12"
    set title sprintf("Figure %s: GMRES without restarts, rows scaled to a diagonal of 1 (%s)", file[13:14], file[16:strlen(file) - 4]) noenhanced
    set logscale y
    set format y "10^{%L}"
    set xlabel "iteration"
    set ylabel "residual"
    set grid linecolor rgb "#dddddd"
    array curve[6] = ["TPFA", "TPFA, Jacobi", "TPFA, ILU(0)", "M-SPH = Schwaiger", "M-SPH = Schwaiger, Jacobi", "M-SPH = Schwaiger, ILU(0)"]
    plot for [c = 1:6] file using 1:(column(c + 1)) every ::1 with lines linewidth (c > 3 ? 3 : 1) title curve[c]
}

if (there("elliptic_clouds_errors")) {
    set output "elliptic_clouds_errors.png"
    set terminal pngcairo size 1500,560 font "sans,12"
    set multiplot layout 1,3 title "div(m grad u) = s in the unit square, smooth, Dirichlet, h = 1.2 spacings: error against particles per side"
    set logscale xy
    set xlabel "N"
    set ylabel "relative L2 error"
    set xrange [8:100]
    set yrange [1e-5:1]
    set format y "10^{%L}"
    set key bottom left
    array state[3] = ["uniform", "jitter 25 %", "graded discs"]
    array method[4] = ["CB", "M", "M (16)", "M / trace"]
    do for [c = 1:3] {
        set title state[c]
        plot for [m = 1:4] "elliptic_clouds_errors.csv" using ($1 == 2 && strcol(2) eq state[c] && strcol(3) eq "smooth" && strcol(4) eq method[m] ? $5 : NaN):6 every ::1 \
            with points pointtype mark[m] pointsize 1.5 linecolor rgb color[m] title method[m], 0.2 / x**2 with lines dashtype 2 linecolor rgb "gray40" title "slope -2"
    }
    unset multiplot
    unset logscale
    set format y
    set autoscale
    unset ylabel
}

if (there("elliptic_uses_projection")) {
    set output "elliptic_uses_projection.png"
    set terminal pngcairo size 1200,560 font "sans,12"
    set multiplot layout 1,2 title "Divergence before and after one projection, 40 x 40 particles, jitter 25 %"
    set size ratio 1
    set xlabel "x"
    set ylabel "y"
    set xrange [0:1]
    set yrange [0:1]
    unset key
    unset grid
    set palette defined (-1 "#0072b2", 0 "#ffffff", 1 "#d55e00")
    array largest[2] = [12.6, 0.6]
    array moment[2] = ["before", "after (another scale)"]
    do for [k = 1:2] {
        set title moment[k]
        set cbrange [-largest[k]:largest[k]]
        plot "elliptic_uses_projection.csv" using 1:2:(column(2 + k)) every ::1 with points pointtype 7 pointsize 1.1 linecolor palette
    }
    unset multiplot
    set size noratio
    set autoscale
    set key default
    set grid linecolor rgb "#dddddd"
    unset ylabel
}

if (there("elliptic_uses_disc")) {
    set output "elliptic_uses_disc.png"
    set terminal pngcairo size 1500,520 font "sans,12"
    set multiplot layout 1,3 title "Robin conditions on a circle: lattice of 1/20, cut"
    set size ratio 1
    set xlabel "x"
    set xrange [-1.05:1.05]
    set yrange [-1.05:1.05]
    unset key
    unset grid
    set palette defined (-1 "#0072b2", 0 "#ffffff", 1 "#d55e00")
    set cbrange [-2:2]
    set title "u, M-SPH"
    plot "elliptic_uses_disc.csv" using 1:2:4 every ::1 with points pointtype 7 pointsize 0.8 linecolor palette
    set cbrange [-0.1:0.1]
    set title "error, M-SPH"
    plot "elliptic_uses_disc.csv" using 1:2:($4 - $3) every ::1 with points pointtype 7 pointsize 0.8 linecolor palette
    set cbrange [-0.005:0.005]
    set title "error, least squares (another scale)"
    plot "elliptic_uses_disc.csv" using 1:2:($5 - $3) every ::1 with points pointtype 7 pointsize 0.8 linecolor palette
    unset multiplot
    set size noratio
    set autoscale
    set key default
    set grid linecolor rgb "#dddddd"
}

if (there("elliptic_uses_slab")) {
    set output "elliptic_uses_slab.png"
    set terminal pngcairo size 1200,500 font "sans,12"
    set multiplot layout 1,2 title "Heat through a jump of the conductivity at x = 0, t = 0.04, 22 columns, h = 0.5005 dx, implicit Euler steps"
    set xlabel "x"
    set xrange [-0.6:1]
    set yrange [-0.05:1.05]
    set key top right
    array ratio[2] = [10, 1000]
    do for [q = 1:2] {
        set title sprintf("ratio %d", ratio[q])
        plot "elliptic_uses_slab.csv" using ($1 == ratio[q] ? $2 : NaN):4 every ::1 with linespoints pointtype mark[1] linecolor rgb color[1] title "arithmetic means", \
            "" using ($1 == ratio[q] ? $2 : NaN):5 every ::1 with points pointtype mark[2] linecolor rgb color[2] title "harmonic means", \
            "" using ($1 == ratio[q] ? $2 : NaN):3 every ::1 with lines linecolor rgb "black" title "exact"
    }
    unset multiplot
    set autoscale
}
