# SPDX-License-Identifier: MIT
# The figures of the liquids, from the data files in a folder:
#     gnuplot -c examples/fluids/fluids.gp build/figures
cd ARG1
set datafile separator ","
set grid linecolor rgb "#dddddd"
there(name) = system(sprintf("test -r %s.csv && echo yes", name)) eq "yes"
set palette defined (0 "#30123b", 0.15 "#4686fb", 0.35 "#1ae4b6", 0.55 "#a2fc3c", 0.75 "#faba39", 0.9 "#e3440a", 1 "#7a0403")

# particles at the end of each run, by pressure: name of the case, then names and titles of the methods
if (there("fluids_patch_inviscid")) {
    set output "fluids_patch.png"
    set terminal pngcairo size 1500,980 font "sans,12"
    set multiplot layout 2,3 title "A square that has turned by 86 degrees: pressure / rho omega^2"
    set size ratio -1
    set xrange [-0.8:0.8]
    set yrange [-0.8:0.8]
    set cbrange [-0.15:0.05]
    unset key
    array patch[6] = ["inviscid", "antuono_inviscid", "antuono", "sun", "riemann", "riemann_sun"]
    array patch_title[6] = ["plain, alpha = 0", "Antuono, alpha = 0", "Antuono", "Antuono, Sun 2017", "Riemann", "Riemann, Sun 2017"]
    do for [k = 1:6] {
        set title patch_title[k]
        plot "fluids_patch_".patch[k].".csv" using 1:2:6 every ::1 with points pointtype 7 pointsize 0.5 linecolor palette
    }
    unset multiplot
    set size noratio
    set autoscale
}

if (there("fluids_vortices_30_plain")) {
    set output "fluids_vortices.png"
    set terminal pngcairo size 1400,480 font "sans,12"
    set multiplot layout 1,3 title "Vortices of Taylor and Green, t = 1.2, 30 x 30 particles from a lattice: speed"
    set size ratio -1
    set xrange [0:1]
    set yrange [0:1]
    set cbrange [0:0.4]
    unset key
    array vortex[3] = ["plain", "antuono", "sun"]
    array vortex_title[3] = ["plain", "Antuono", "Antuono, Sun 2017"]
    do for [k = 1:3] {
        set title vortex_title[k]
        plot "fluids_vortices_30_".vortex[k].".csv" using 1:2:(sqrt($3**2 + $4**2)) every ::1 with points pointtype 7 pointsize 0.9 linecolor palette
    }
    unset multiplot
    set size noratio
    set autoscale
}

if (there("fluids_tank_plain")) {
    set output "fluids_tank.png"
    set terminal pngcairo size 1500,900 font "sans,12"
    set multiplot layout 2,3 title "A tank at rest, t = 10: pressure / rho g H over height / H"
    set xrange [-0.05:1.1]
    set yrange [-0.1:1.1]
    unset key
    array tank[6] = ["plain", "molteni", "antuono", "sun", "riemann", "riemann_gravity"]
    array tank_title[6] = ["plain", "Molteni & Colagrossi", "Antuono", "Antuono, Sun 2017", "Riemann", "Riemann, gravity out of the jump"]
    do for [k = 1:6] {
        set title tank_title[k] noenhanced
        plot "fluids_tank_".tank[k].".csv" using ($8 == 0 ? $2 : NaN):6 every ::1 with points pointtype 6 pointsize 0.6 linecolor rgb "#0072b2", \
            1 - x with lines linecolor rgb "#d55e00"
    }
    unset multiplot
    set autoscale
}

if (there("fluids_dam_plain")) {
    set output "fluids_dam.png"
    set terminal pngcairo size 1500,1300 font "sans,12"
    set multiplot layout 3,2
    set size ratio -1
    set xrange [-0.1:4.1]
    set yrange [-0.1:2.1]
    set cbrange [0:2]
    unset key
    array dam[4] = ["plain", "antuono", "sun", "riemann"]
    array dam_title[4] = ["plain", "Antuono", "Antuono, Sun 2017", "Riemann"]
    do for [k = 1:4] {
        set title "t = 2.4, pressure / rho g A: ".dam_title[k]
        plot "fluids_dam_".dam[k].".csv" using ($8 == 0 ? $1 : NaN):2:6 every ::1 with points pointtype 7 pointsize 0.6 linecolor palette
    }
    set size noratio
    set autoscale
    set key top left
    set title "The front"
    set xlabel "T = t sqrt(2 g / A)"
    set ylabel "Z = x / A"
    set xrange [0:3.4]
    set yrange [1:4.2]
    array front[4] = ["martin_moyce", "koshizuka_oka", "plain", "antuono"]
    array front_title[4] = ["Martin & Moyce 1952", "Koshizuka & Oka 1996", "plain", "Antuono"]
    plot for [k = 1:2] "fluids_dam_front.csv" using (strcol(1) eq front[k] ? $2 : NaN):3 every ::1 with points pointtype (k == 1 ? 6 : 4) pointsize 1.3 title front_title[k] noenhanced, \
        for [k = 3:4] "" using (strcol(1) eq front[k] ? $2 : NaN):3 every ::1 with lines linewidth 2 title front_title[k] noenhanced
    set title "A gauge in the wall"
    set xlabel "t sqrt(g / H)"
    set ylabel "p / rho g H"
    set autoscale
    set yrange [-0.5:2]
    plot "fluids_dam_gauge.csv" using (strcol(1) eq "fourtakas" ? $2 : NaN):3 every ::1 with lines title "Fourtakas", \
        "" using (strcol(1) eq "buchner" ? $2 : NaN):3 every ::1 with points pointtype 7 linecolor rgb "black" title "Buchner 2002"
    unset multiplot
    unset xlabel
    unset ylabel
    set autoscale
}

if (there("fluids_drop_square_css")) {
    set output "fluids_drop.png"
    set terminal pngcairo size 1000,520 font "sans,12"
    set multiplot layout 1,2 title "From a square, t = 0.6: pressure"
    set size ratio -1
    set xrange [0:1]
    set yrange [0:1]
    set autoscale cb
    unset key
    array drop[2] = ["css", "csf"]
    array drop_title[2] = ["by the stress (CSS)", "by the curvature (CSF)"]
    do for [k = 1:2] {
        set title drop_title[k]
        plot "fluids_drop_square_".drop[k].".csv" using 1:2:6 every ::1 with points pointtype 7 pointsize 1 linecolor palette
    }
    unset multiplot
    set size noratio
    set autoscale
}
