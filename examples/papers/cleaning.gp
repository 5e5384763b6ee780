# SPDX-License-Identifier: MIT
# The figures of the paper on divergence cleaning, and of what goes beyond it, from the data files in a folder:
#     gnuplot -c examples/papers/cleaning.gp build/figures
cd ARG1
set datafile separator ","
set grid linecolor rgb "#dddddd"
there(name) = system(sprintf("test -r %s.csv && echo yes", name)) eq "yes"
array color[4] = ["#0072b2", "#d55e00", "#009e73", "#000000"]

if (there("cleaning_fig1")) {
    set output "cleaning_fig1.png"
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
        plot for [s = 1:2] "cleaning_fig1.csv" using (strcol(1) eq form[f] && strcol(2) eq scheme[f] && ($3 > 0) == (s == 2) ? $4 : NaN):5 every ::1 \
            with lines linewidth 2 linecolor rgb color[s] title s == 1 ? "hyperbolic" : "hyperbolic/parabolic, sigma = 0.3"
    }
    unset multiplot
    unset logscale
    set format y
    set autoscale
    unset ylabel
}

if (there("cleaning_fig7")) {
    set output "cleaning_fig7.png"
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
        stats "cleaning_fig8.csv" using (strcol(2) eq "ellipse" && abs($3 - moment[k]) < 1e-6 ? (ax = $8, ay = $9, $8) : NaN) every ::1 nooutput
        set title sprintf("t = %g", moment[k])
        set parametric
        plot "cleaning_fig7.csv" using (strcol(2) eq "cleaned" && abs($3 - moment[k]) < 1e-6 ? $4 : NaN):5:(100 * $6) every ::1 with points pointtype 7 pointsize 0.4 linecolor palette, \
            ax * cos(t), ay * sin(t) with lines linecolor rgb "black"
        unset parametric
    }
    unset multiplot
    set size noratio
    set autoscale
    set key default
}

# here, because blocks take macros as they are when the block begins
curves = 'for [s = 1:2] "cleaning_fig8.csv" using (strcol(1) eq viscosity[a] && strcol(2) eq run[s] ? $3 : NaN):(column(column_of[f])) every ::2 with lines linewidth 2 linecolor rgb color[3 - s] title run[s]'
if (there("cleaning_fig8")) {
    array viscosity[3] = ["0.01", "0", "0.1"]
    array run[2] = ["control", "cleaned"]
    array column_of[3] = [4, 5, 6]
    array title_of[3] = ["Figure 8: mean |div v|", "Figure 9: largest |rho / rho0 - 1|", "Figure 10: kinetic energy"]
    do for [f = 1:3] {
        set output sprintf("cleaning_fig%d.png", f + 7)
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
                plot @curves, "cleaning_fig8.csv" using (strcol(2) eq "ellipse" ? $3 : NaN):6 every ::1 with lines dashtype 2 linecolor rgb "black" title "ellipse without compressibility"
            }
        }
        unset multiplot
        unset logscale
        set format y
        set autoscale
    }
}


# the Orszag-Tang vortex: figure 2 (fields at the end) and figure 3 (errors over time)
vortices = system("ls cleaning_orszag_tang_fig2_*.csv 2> /dev/null")
do for [file in vortices] {
    # with the four cases of figure 2, and to their ends
    if (system(sprintf("cut -d, -f1 '%s' | sort -u | grep -c -x -e '\"control\"' -e '\"resistivity\"' -e '\"Euler potentials\"' -e '\"cleaning\"'", file)) + 0 == 4) {
        reset
        set datafile separator ","
        columns = file[27:strlen(file) - 4] + 0
        set output file[1:strlen(file) - 4].".png"
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
                plot file using (strcol(1) eq vortex[c] ? $2 : NaN):3:(column(3 + q)) every ::1 with points pointtype 7 pointsize (60.0 / columns) linecolor palette
            }
        }
        unset multiplot
    }
}
if (there("cleaning_orszag_tang_fig3")) {
    reset
    set datafile separator ","
    history = "cleaning_orszag_tang_fig3.csv"
    sizes = system(sprintf("tail -n +2 '%s' | cut -d, -f1 | sort -u -n", history))
    set output "cleaning_orszag_tang_fig3.png"
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

# beyond the paper: the shock tube of Brio & Wu, the finest run in 2D and in 3D and the one without cleaning
if (there("cleaning_shocktube_profiles")) {
    reset
    set datafile separator ","
    tube = "cleaning_shocktube_profiles.csv"
    finest(dim) = system(sprintf("grep '^\"cleaning\",%d' '%s' | cut -d, -f3 | sort -n | tail -1", dim, tube)) + 0
    flat = finest(2)
    solid = finest(3)
    set output "cleaning_shocktube.png"
    set terminal pngcairo size 1500,900 font "sans,12"
    set multiplot layout 2,3 title "the shock tube of Brio and Wu at t = 0.1"
    set grid linecolor rgb "#dddddd"
    set xrange [-0.3:0.45]
    set xlabel "x"
    array quantity[6] = ["density", "v_x", "v_y", "B_y", "pressure", "B_x"]
    do for [q = 1:6] {
        set title quantity[q]
        if (q == 1) { set key top right font ",8" samplen 1 } else { unset key }
        plot tube using (strcol(1) eq "cleaning" && $2 == 3 && $3 == solid ? $4 : NaN):(column(4 + q)) every ::1 with points pointtype 7 pointsize 0.2 linecolor rgb "#cccccc" title sprintf("3D, dx = 1/%d", solid), \
            tube using (strcol(1) eq "cleaning" && $2 == 2 && $3 == flat ? $4 : NaN):(column(4 + q)) every ::1 with points pointtype 7 pointsize 0.3 linecolor rgb "#d55e00" title sprintf("2D, dx = 1/%d", flat), \
            tube using (strcol(1) eq "neither resistivity nor cleaning" ? $4 : NaN):(column(4 + q)) every ::1 with points pointtype 7 pointsize 0.3 linecolor rgb "#0072b2" title "1/200, neither resistivity nor cleaning", \
            tube using (strcol(1) eq "volumes" ? $4 : NaN):(column(4 + q)) every ::1 with lines linecolor rgb "black" title "finite volumes"
    }
    unset multiplot
}

# beyond the paper: a peak of div B in a stream
if (there("cleaning_projection_sweeps")) {
    reset
    set datafile separator ","
    set output "cleaning_projection.png"
    set terminal pngcairo size 700,500 font "sans,12"
    set title "D B that hyperbolic cleaning leaves; a projection leaves 1e-10 after some 500 sweeps"
    set grid linecolor rgb "#dddddd"
    set logscale y
    set format y "10^{%L}"
    set xlabel "sweeps"
    plot for [c in "lattice jittered"] "cleaning_projection_sweeps.csv" using (strcol(1) eq c ? $3 : NaN):4 every ::1 with lines linewidth 2 title c
}

if (there("cleaning_advection_history")) {
    reset
    set datafile separator ","
    stream = "cleaning_advection_history.csv"
    set output "cleaning_advection.png"
    set terminal pngcairo size 1500,560 font "sans,12"
    set multiplot layout 1,3 title "A peak of div B in a stream, 50 x 50 particles"
    set grid linecolor rgb "#dddddd"
    set xrange [0:1]
    set xlabel "t"
    array name[7] = ["control", "sigma = 0", "sigma = 0.1", "sigma = 0.3", "sigma = 1", "sigma = 0.3, 2 c_h", "sigma = 0.3, 4 c_h"]
    array run[7] = ["control", "cleaning", "cleaning", "cleaning", "cleaning", "cleaning", "cleaning"]
    array damping[7] = [0, 0, 0.1, 0.3, 1, 0.3, 0.3]
    array speed[7] = [1, 1, 1, 1, 1, 2, 4]
    array stroke[7] = ["#000000", "#999999", "#56b4e9", "#d55e00", "#0072b2", "#d55e00", "#d55e00"]
    array dashes[7] = [1, 1, 1, 1, 1, 2, 3]
    array quantity[3] = ["mean h |div B| / |B|", "largest h |div B| / |B|", "magnetic and psi energy, change in units of the peak's"]
    array where[3] = [5, 6, 9]
    do for [q = 1:3] {
        set title quantity[q]
        if (q < 3) {
            set logscale y
            set format y "10^{%L}"
            unset key
        } else {
            unset logscale
            set format y
            set key center right
        }
        plot for [c = 1:7] stream using (strcol(1) eq run[c] && abs($2 - damping[c]) < 1e-9 && abs($3 - speed[c]) < 1e-9 ? $4 : NaN):(column(where[q])) every ::1 \
            with lines linewidth 2 dashtype dashes[c] linecolor rgb stroke[c] title name[c]
    }
    unset multiplot
}

# beyond the paper: Euler potentials where a field is wound up
if (there("cleaning_euler_potentials_windings")) {
    reset
    set datafile separator ","
    windings = "cleaning_euler_potentials_windings.csv"
    set output "cleaning_euler_potentials.png"
    set terminal pngcairo size 1200,520 font "sans,12"
    set multiplot layout 1,2 title "A field wound up by rotation, with the potentials and with the induction equation"
    set grid linecolor rgb "#dddddd"
    set xlabel "windings"
    set yrange [-0.1:1.4]
    array way[2] = ["Euler potentials", "induction equation"]
    array title_of[2] = ["part of the exact field that is left", "error, of the exact field"]
    sizes = system(sprintf("tail -n +2 '%s' | cut -d, -f2 | sort -u -n", windings))
    do for [q = 1:2] {
        set title title_of[q]
        if (q == 1) { set key top right } else { unset key }
        plot for [w = 1:2] for [s = 1:words(sizes)] windings using (strcol(1) eq way[w] && $2 == word(sizes, s) + 0 ? $3 : NaN):(column(3 + q)) every ::1 \
            with linespoints pointtype 7 pointsize 0.5 linewidth 2 dashtype s linecolor rgb (w == 1 ? "#0072b2" : "#d55e00") title way[w].", ".word(sizes, s)." layers"
    }
    unset multiplot
}

# the collapse of a cloud core: figure 4 (column density along y), the velocity along the axis there, figures 5 and 6
if (there("cleaning_collapse_fig5")) {
    reset
    set datafile separator ","
    history = "cleaning_collapse_fig5.csv"
    clouds = system(sprintf("tail -n +2 '%s' | cut -d, -f1 | sort -u -n", history))
    array resistivity[3] = ["", "_with_alpha_B___0_1_everywhere", "_with_alpha_B___0"]
    do for [cloud in clouds] { do for [v = 1:3] {
        columns(k) = sprintf("cleaning_collapse_fig4_%s_%s%s%s", cloud, k == 1 ? "control" : "cleaned", resistivity[v], k == 3 ? "_end" : "")
        if (there(columns(1)) && there(columns(2))) {
            do for [q = 1:2] {
                set output sprintf("cleaning_collapse_%s_%s.png", q == 1 ? "fig4" : "jet", cloud.resistivity[v])
                panels = there(columns(3)) ? 3 : 2
                set terminal pngcairo size (650 * panels),1200 font "sans,12"
                set multiplot layout 2,panels title (q == 1 ? "Figure 4: column density along y, log_{10} g/cm^2, " : "Mean velocity along the axis, km/s, ").cloud." particles in the sphere".(v == 1 ? "" : v == 2 ? ", {/Symbol a}_B = 0.1 everywhere" : ", {/Symbol a}_B = 0")
                unset key
                set size ratio 1
                if (q == 1) { set palette defined (0 "#000000", 1 "#3b0f70", 2 "#b73779", 3 "#fc8961", 4 "#fcfdbf") } else { set palette defined (-1 "#0072b2", 0 "#ffffff", 1 "#d55e00") }
                do for [w = 0:1] {
                    do for [k = 1:panels] {
                        file = columns(k).".csv"
                        set title sprintf("%s, t = %.4f t_{ff}", k == 1 ? "control" : "cleaned", system(sprintf("sed -n 2p '%s' | cut -d, -f2", file)) + 0)
                        set xlabel "x [10^{16} cm]"
                        set ylabel "z [10^{16} cm]"
                        half = w == 0 ? 0.25 : 5
                        set xrange [-half:half]
                        set yrange [-half:half]
                        if (q == 1) { if (w == 0) { set cbrange [0:4] } else { set cbrange [-2:2] } } else { set cbrange [-3:3] }
                        plot file every ::(1 + 14400 * w)::(14400 * (w + 1)) using 3:4:(q == 1 ? log10($5 + 1e-9) : $6) with image
                    }
                }
                unset multiplot
                set autoscale
                set size noratio
            }
        }
    } }
    array figure[2] = ["fig5", "fig6"]
    array what[2] = ["Figure 5: mean of h |div B| / |B|", "Figure 6: linear momentum made, |P - P_0| [10^5 cm/s solar masses]"]
    array stroke[6] = ["#000000", "#d55e00", "#999999", "#e69f00", "#0072b2", "#cc79a7"]
    array runs[6] = ["control", "cleaned", "control with alpha_B = 0", "cleaned with alpha_B = 0", "control with alpha_B = 0.1 everywhere", "cleaned with alpha_B = 0.1 everywhere"]
    has(cloud, k) = system(sprintf("grep -c '^%s,\"%s\",' '%s'", cloud, runs[k], history)) + 0 > 0
    do for [q = 1:2] {
        set output sprintf("cleaning_collapse_%s.png", figure[q])
        set terminal pngcairo size (words(clouds) > 1 ? 700 * words(clouds) : 950),1000 font "sans,12"
        set multiplot layout 2,words(clouds) title what[q]." in the collapse of a cloud core"
        set grid linecolor rgb "#dddddd"
        set logscale y
        set format y "10^{%L}"
        set xlabel "t / t_{ff}"
        unset ylabel
        set key top left noenhanced
        if (q == 1) { set yrange [1e-3:2] } else { set yrange [1e-7:10] }
        do for [near_peak = 0:1] { do for [cloud in clouds] {
            if (near_peak) { set xrange [0.86:*] } else { set xrange [0:*] }
            set title cloud." particles in the sphere"
            here = ""
            do for [k = 1:6] { if (has(cloud, k)) { here = here." ".k } }
            plot for [k in here] history using ($1 == (cloud + 0) && strcol(2) eq runs[k + 0] ? $3 : NaN):(q == 1 ? $6 : $9 * 1.152) every ::1 with lines linewidth 2 \
                linecolor rgb stroke[k + 0] title runs[k + 0]
        } }
        unset multiplot
    }
}
