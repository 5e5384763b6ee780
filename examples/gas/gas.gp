# SPDX-License-Identifier: MIT
# The figures of gas, from the data files in a folder:
#     gnuplot -c examples/gas/gas.gp build/figures
cd ARG1
set datafile separator ","
set grid linecolor rgb "#dddddd"
there(name) = system(sprintf("test -r %s.csv && echo yes", name)) eq "yes"

if (there("gas_sod_none")) {
    set output "gas_sod.png"
    set terminal pngcairo size 1500,900 font "sans,12"
    set multiplot layout 2,3 title "Sod's tube at t = 0.2: pressure"
    set xrange [-0.1:0.4]
    set yrange [0.05:0.4]
    unset key
    array sod[6] = ["none", "price", "w", "morris", "cullen", "phantom"]
    array sod_title[6] = ["no conductivity", "Price", "|w|", "Price, Morris \\& Monaghan", "Price, Cullen \\& Dehnen", "Price, Phantom"]
    do for [k = 1:6] {
        set title sod_title[k]
        plot "gas_sod_".sod[k].".csv" using 1:4 every ::1 with points pointtype 7 pointsize 0.4, "" using 1:8 every ::1 with lines linecolor rgb "black"
    }
    unset multiplot
}

if (there("gas_waves")) {
    reset
    set datafile separator ","
    set output "gas_waves.png"
    set terminal pngcairo size 700,500 font "sans,12"
    set title "Error of the speed of linear waves"
    set logscale xy
    set grid linecolor rgb "#dddddd"
    set xlabel "particles a wavelength"
    set xrange [12:160]
    set key bottom left
    plot for [w in "sound Alfven fast slow"] "gas_waves.csv" using (strcol(1) eq w ? $2 : 1/0):3 every ::1 with linespoints pointtype 7 title w, \
        10 / x**2 with lines dashtype 2 linecolor rgb "black" title "N^{-2}"
}
