# SPDX-License-Identifier: MIT
# The figures of the solids, from the data files in a folder:
#     gnuplot -c examples/solids/solids.gp build/figures
cd ARG1
set datafile separator ","
set grid linecolor rgb "#dddddd"
there(name) = system(sprintf("test -r %s.csv && echo yes", name)) eq "yes"
set palette defined (0 "#30123b", 0.15 "#4686fb", 0.35 "#1ae4b6", 0.55 "#a2fc3c", 0.75 "#faba39", 0.9 "#e3440a", 1 "#7a0403")

if (there("solids_rings_5")) {
    set output "solids_rings.png"
    set terminal pngcairo size 1100,560 font "sans,12"
    set multiplot layout 2,3 title "Two rubber rings collide: von Mises' stress / (rho c^2)"
    set size ratio -1
    set xrange [-11:11]
    set yrange [-7:7]
    set cbrange [0:0.06]
    unset key
    array moment[6] = ["0", "25", "50", "80", "120", "199"]
    do for [k = 1:6] {
        set title "t = ".moment[k]
        plot "solids_rings_".(k - 1).".csv" using 1:2:5 every ::1 with points pointtype 7 pointsize 0.3 linecolor palette
    }
    unset multiplot
    set size noratio
    set autoscale
}

if (there("solids_plate_10")) {
    set output "solids_plate.png"
    set terminal pngcairo size 1100,420 font "sans,12"
    set multiplot layout 2,1 title "A plate that is clamped at one end, shortly before it is farthest: von Mises' stress / (rho c^2)"
    set xrange [-0.5:10.5]
    set yrange [-1.2:1.2]
    unset key
    array plate[2] = ["10", "10_bare"]
    array plate_title[2] = ["10 particles of thickness", "the same without hourglass control"]
    do for [k = 1:2] {
        set title plate_title[k]
        plot "solids_plate_".plate[k].".csv" using 1:2:5 every ::1 with points pointtype 7 pointsize 0.5 linecolor palette
    }
    unset multiplot
    set autoscale
}
