# SPDX-License-Identifier: MIT
# The figures of the paper on particle clustering, from the data files in a folder:
#     gnuplot -c examples/papers/clustering.gp build/figures
cd ARG1
set datafile separator ","
set grid linecolor rgb "#dddddd"
there(name) = system(sprintf("test -r %s.csv && echo yes", name)) eq "yes"
array color[4] = ["#000000", "#d55e00", "#0072b2", "#009e73"]

if (there("clustering_fig2")) {
    set output "clustering_fig2.png"
    set terminal pngcairo size 800,520 font "sans,12"
    set title "Figure 2: kernels (solid) and their gradients (dashed), one dimension, h = 1"
    set xlabel "R"
    set key top right
    array kernel[3] = ["quartic", "(1.1)", "convex (3.9)"]
    plot for [k = 1:3] "clustering_fig2.csv" using 1:(column(k + 1)) every ::1 with lines linewidth 2 linecolor rgb color[k] title kernel[k], \
        for [k = 1:3] "" using 1:(column(k + 4)) every ::1 with lines linewidth 2 dashtype 2 linecolor rgb color[k] notitle
}

# Figures 1 and 3: a row for each background pressure
if (there("clustering_box_collisions_p0")) {
    set output "clustering_box.png"
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
        plot "clustering_box_initial.csv" using 1:2 every ::1 with points pointtype 7 pointsize 0.5 linecolor rgb "black"
        do for [a = 1:3] {
            set title run_title[a].", ".what
            plot "clustering_box_".run[a].end.".csv" using 1:2 every ::1 with points pointtype 7 pointsize 0.5 linecolor rgb "black"
        }
    }
    unset multiplot
    set size noratio
    set autoscale
    set key
}

if (there("clustering_fig5")) {
    set output "clustering_fig5.png"
    set terminal pngcairo size 900,560 font "sans,12"
    set title "Figure 5: error of the pressure gradient of a column of water"
    set xlabel "t [s]"
    set ylabel "error [%]"
    set yrange [-1:7]
    set key top right
    array method[3] = ["particle collisions h = 1.5 dref", "convex kernel (3.9) h = 1.5 dref", "convex kernel (3.9) h = 2 dref"]
    array method_title[3] = ["(1.1), with and without collisions, h = 1.5 dref", "convex (3.9), h = 1.5 dref", "convex (3.9), h = 2 dref"]
    array method_color[3] = ["#0072b2", "#d55e00", "#56b4e9"]
    plot for [k = 2:3] "clustering_fig5.csv" using (strcol(1) eq method[k] ? $2 : NaN):3 every ::1 with lines linecolor rgb method_color[k] title method_title[k], \
        "" using (strcol(1) eq method[1] ? $2 : NaN):3 every ::1 with lines linecolor rgb method_color[1] title method_title[1]
    unset ylabel
    set autoscale
}

if (there("clustering_fig6_collisions")) {
    set output "clustering_fig6.png"
    set terminal pngcairo size 1200,1260 font "sans,12"
    set multiplot layout 2,2 title "Figure 6: air between a rotating shaft and a wall, t = 0.5"
    set size ratio 1
    set xrange [-0.115:0.115]
    set yrange [-0.115:0.115]
    unset xlabel
    unset key
    array shaft[4] = ["hermite", "wendland", "convex", "collisions"]
    array shaft_title[4] = ["(3.7), as the caption says", "(1.1), as elsewhere", "convex (3.9)", "(1.1) and collisions"]
    do for [k = 1:4] {
        set title shaft_title[k]
        plot "clustering_fig6_".shaft[k].".csv" using ($8 == 1 ? $1 : NaN):2 every ::1 with points pointtype 7 pointsize 0.6 linecolor rgb "#b0b0b0", \
            "" using ($8 == 0 ? $1 : NaN):2 every ::1 with points pointtype 7 pointsize 0.6 linecolor rgb "black"
    }
    unset multiplot
    set size noratio
    set autoscale
    set key
}

# Figures 7, 8, 9: water black, air blue, ghosts grey
array dam[5] = ["clustering_fig7", "clustering_dam_wendland_100", "clustering_dam_convex_100", "clustering_dam_collisions_100", ""]
array dam_title[5] = ["Figure 7: at the start", "Figure 8: t = 0.1, (1.1)", "Figure 8: t = 0.1, convex (3.9)", "Figure 8: t = 0.1, (1.1) and collisions", ""]
array late[3] = ["clustering_dam_single_700", "clustering_dam_wendland_700", "clustering_dam_collisions_700"]
array late_title[3] = ["Figure 9: t = 0.7, (1.1), water only", "Figure 9: t = 0.7 (or the last picture before it blew up), (1.1)", "Figure 9: t = 0.7, (1.1) and collisions"]
if (there("clustering_dam_collisions_100")) {
    unset xlabel
    unset key
    set xrange [-0.03:1.03]
    set yrange [-0.03:0.53]
    set size ratio -1
    set output "clustering_fig8.png"
    set terminal pngcairo size 1600,960 font "sans,12"
    set multiplot layout 2,2
    do for [k = 1:4] {
        set title dam_title[k]
        plot dam[k].".csv" using ($8 == 1 ? $1 : NaN):2 every ::1 with points pointtype 7 pointsize 0.45 linecolor rgb "#b0b0b0", \
            "" using ($8 == 0 && $7 == 1 ? $1 : NaN):2 every ::1 with points pointtype 7 pointsize 0.45 linecolor rgb "#56a0e9", \
            "" using ($8 == 0 && $7 == 0 ? $1 : NaN):2 every ::1 with points pointtype 7 pointsize 0.45 linecolor rgb "black"
    }
    unset multiplot
    if (there("clustering_dam_collisions_700")) {
        set output "clustering_fig9.png"
        set terminal pngcairo size 1000,1590 font "sans,12"
        stats late[3].".csv" every ::1 using 1 nooutput
        dot = STATS_records > 10000 ? 0.4 : 0.7
        set multiplot layout 3,1
        do for [k = 1:3] {
            set title late_title[k]
            plot late[k].".csv" using ($8 == 1 ? $1 : NaN):2 every ::1 with points pointtype 7 pointsize dot linecolor rgb "#b0b0b0", \
                "" using ($8 == 0 && $7 == 1 ? $1 : NaN):2 every ::1 with points pointtype 7 pointsize dot linecolor rgb "#56a0e9", \
                "" using ($8 == 0 && $7 == 0 ? $1 : NaN):2 every ::1 with points pointtype 7 pointsize dot linecolor rgb "black"
        }
        unset multiplot
    }
    # the same by speed and by pressure
    set palette defined (0 "#30123b", 0.15 "#4686fb", 0.35 "#1ae4b6", 0.55 "#a2fc3c", 0.75 "#faba39", 0.9 "#e3440a", 1 "#7a0403")
    set output "clustering_dam.png"
    set terminal pngcairo size 1700,1260 font "sans,12"
    set multiplot layout 3,2 title "Water and air with collisions"
    do for [k = 1:3] {
        dam_file = sprintf("clustering_dam_collisions_%d00", k)
        set title sprintf("speed [m/s], t = %.1f s", 0.1 * k)
        set cbrange [0:2.2]
        plot dam_file.".csv" using ($8 == 0 && $7 == 1 ? $1 : NaN):2 every ::1 with points pointtype 7 pointsize 0.3 linecolor rgb "#c8d8e8", \
            "" using ($8 == 0 && $7 == 0 ? $1 : NaN):2:(sqrt($3**2 + $4**2)) every ::1 with points pointtype 7 pointsize 0.55 linecolor palette
        set title sprintf("pressure [kPa], t = %.1f s", 0.1 * k)
        set cbrange [-0.5:2]
        plot dam_file.".csv" using ($8 == 0 ? $1 : NaN):2:($6 / 1000) every ::1 with points pointtype 7 pointsize 0.5 linecolor palette
    }
    unset multiplot
    set size noratio
    set autoscale
    set key
}

if (there("clustering_front")) {
    set output "clustering_front.png"
    set terminal pngcairo size 900,560 font "sans,12"
    set title "The front of the water (Ritter: x = 0.5 + 2 t sqrt(gH))"
    set xlabel "t [s]"
    set ylabel "x [m]"
    set xrange [0:0.3]
    set yrange [0.5:1]
    set key top left
    array front[4] = ["wendland", "collisions", "single", "single_collisions"]
    array front_title[4] = ["(1.1), t = 0.1 only in quick runs", "(1.1) and collisions", "(1.1), water only", "(1.1) and collisions, water only"]
    array front_dash[4] = [1, 1, 2, 2]
    array front_color[4] = ["#000000", "#d55e00", "#000000", "#d55e00"]
    plot for [k = 1:4] "clustering_front.csv" using (strcol(1) eq front[k] ? $2 : NaN):3 every 8::1 with lines linewidth 2 dashtype front_dash[k] linecolor rgb front_color[k] title front_title[k], \
        0.5 + 2 * sqrt(9.81 * 0.2) * x with lines linecolor rgb "gray50" title "Ritter"
    unset ylabel
    set autoscale
}

if (there("clustering_column")) {
    set output "clustering_column.png"
    set terminal pngcairo size 900,560 font "sans,12"
    set title "Front of a column of a x 2a: experiments and water only"
    set xlabel "T = t sqrt(2 g / a)"
    set ylabel "Z = x / a"
    set xrange [0:3.4]
    set yrange [1:4.5]
    set key top left
    array column_run[4] = ["martin_moyce", "koshizuka_oka", "single", "single_collisions"]
    array column_title[4] = ["Martin & Moyce 1952", "Koshizuka & Oka 1996", "(1.1)", "(1.1) and collisions"]
    array column_color[4] = ["#0072b2", "#009e73", "#000000", "#d55e00"]
    plot for [k = 1:2] "clustering_column.csv" using (strcol(1) eq column_run[k] ? $2 : NaN):3 every ::1 with points pointtype (k == 1 ? 6 : 4) pointsize 1.3 linecolor rgb column_color[k] title column_title[k] noenhanced, \
        for [k = 3:4] "" using (strcol(1) eq column_run[k] ? $2 : NaN):3 every ::1 with lines linewidth 2 linecolor rgb column_color[k] title column_title[k]
    unset ylabel
    set autoscale
}

if (there("clustering_taylor_green")) {
    set output "clustering_flows.png"
    set terminal pngcairo size 1700,520 font "sans,12"
    set multiplot layout 1,3
    set title "Vortices of Taylor and Green, Re = 100, 40 columns, h = 1.5 dref"
    set xlabel "t"
    set ylabel "energy / energy at the start"
    set logscale y
    set key bottom left
    array vortex[5] = ["(1.1)", "(3.9)", "(1.1) + collisions", "Wendland C2", "(1.1) with p0 = 3.2"]
    array vortex_color[5] = ["#000000", "#0072b2", "#d55e00", "#009e73", "#999999"]
    plot for [k = 1:5] "clustering_taylor_green.csv" using (strcol(1) eq vortex[k] && $2 == 1.5 && $3 == 40 ? $4 : NaN):5 every ::1 with lines linewidth 2 linecolor rgb vortex_color[k] title vortex[k], \
        exp(-16 * pi**2 * 0.01 * x) with lines dashtype 2 linecolor rgb "black" title "exact"
    unset logscale
    unset key
    set xlabel "speed"
    set ylabel "y"
    array plates[2] = ["Poiseuille", "Couette"]
    do for [k = 1:2] {
        set title plates[k]." flow, Re = 1, 20 rows, t = 0.02, 0.1, 1"
        plot "clustering_plates.csv" using (strcol(1) eq plates[k] ? $5 : NaN):3 with lines linecolor rgb "#d55e00", \
            "" using (strcol(1) eq plates[k] ? $4 : NaN):3 with points pointtype 6 linecolor rgb "black"
    }
    unset multiplot
    unset ylabel
    set key
}

# beyond the paper: three dimensions, the cavity
if (there("clustering_column3d")) {
    set output "clustering_column3d.png"
    set terminal pngcairo size 1500,560 font "sans,12"
    set multiplot layout 1,2
    set title "Front of a column of a x 2a x a, walls at the sides"
    set xlabel "T = t sqrt(2 g / a)"
    set ylabel "Z = x / a"
    set xrange [0:3.4]
    set yrange [1:4.5]
    set key top left
    array column3d[4] = ["martin_moyce", "koshizuka_oka", "plane", "space"]
    array column3d_title[4] = ["Martin & Moyce 1952", "Koshizuka & Oka 1996", "two dimensions", "three dimensions"]
    plot for [k = 1:2] "clustering_column3d.csv" using (strcol(1) eq column3d[k] ? $2 : NaN):3 every ::1 with points pointtype (k == 1 ? 6 : 4) pointsize 1.3 linecolor rgb column_color[k] title column3d_title[k] noenhanced, \
        for [k = 3:4] "" using (strcol(1) eq column3d[k] ? $2 : NaN):3 every ::1 with lines linewidth 2 linecolor rgb color[k == 3 ? 1 : 2] title column3d_title[k]
    set title "Speed [m/s] at T = 3.4"
    unset key
    set view 62, 18, 2.2
    set view equal xyz
    set autoscale
    set cbrange [0:2]
    unset tics
    unset grid
    unset border
    unset xlabel
    unset ylabel
    splot "clustering_dam3d_box.csv" using 1:3:2:(sqrt($4**2 + $5**2 + $6**2)) every ::1 with points pointtype 7 pointsize 0.5 linecolor palette
    unset multiplot
    unset view
    set key
    set tics
    set border
    set grid linecolor rgb "#dddddd"
}

if (there("clustering_cavity_profiles")) {
    set output "clustering_cavity.png"
    set terminal pngcairo size 1700,600 font "sans,12"
    set multiplot layout 1,3
    set key bottom right
    set title "Lid-driven cavity, Re = 100: u on x = 1/2"
    set xlabel "u"
    set ylabel "y"
    array cavity[2] = ["plain 32", "cleaned 32"]
    plot for [k = 1:2] "clustering_cavity_profiles.csv" using (strcol(1) eq cavity[k] && strcol(2) eq "u" ? $4 : NaN):3 every ::1 with lines linewidth 2 dashtype k linecolor rgb color[k] title (k == 1 ? "32 x 32" : "32 x 32, cleaned"), \
        "" using (strcol(1) eq "ghia" && strcol(2) eq "u" ? $4 : NaN):3 every ::1 with points pointtype 6 pointsize 1.3 linecolor rgb color[3] title "Ghia, Ghia & Shin 1982" noenhanced
    set key bottom left
    set title "v on y = 1/2"
    set xlabel "x"
    set ylabel "v"
    plot for [k = 1:2] "clustering_cavity_profiles.csv" using (strcol(1) eq cavity[k] && strcol(2) eq "v" ? $3 : NaN):4 every ::1 with lines linewidth 2 dashtype k linecolor rgb color[k] title (k == 1 ? "32 x 32" : "32 x 32, cleaned"), \
        "" using (strcol(1) eq "ghia" && strcol(2) eq "v" ? $3 : NaN):4 every ::1 with points pointtype 6 pointsize 1.3 linecolor rgb color[3] title "Ghia, Ghia & Shin 1982" noenhanced
    set title "Particles by speed at t = 12, cleaned"
    unset key
    unset xlabel
    unset ylabel
    set size ratio -1
    set xrange [0:1]
    set yrange [0:1]
    set cbrange [0:1]
    plot "clustering_cavity_cleaned_32.csv" using ($8 == 0 ? $1 : NaN):2:(sqrt($3**2 + $4**2)) every ::1 with points pointtype 7 pointsize 1 linecolor palette
    unset multiplot
    set size noratio
    set autoscale
    set key
}
