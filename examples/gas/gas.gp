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

if (there("gas_gresho_constant_32")) {
    set output "gas_gresho.png"
    set terminal pngcairo size 1500,900 font "sans,12"
    set multiplot layout 2,3 title "Gresho's vortex at t = 1, 32 x 32 particles: v along the circles"
    set xrange [0:0.5]
    set yrange [-0.2:1.1]
    unset key
    array vortex[6] = ["constant", "none", "balsara", "morris", "cullen", "phantom"]
    array vortex_title[6] = ["alpha = 1", "no viscosity", "Balsara", "Morris \\& Monaghan", "Cullen \\& Dehnen", "Phantom"]
    do for [k = 1:6] {
        set title vortex_title[k]
        plot "gas_gresho_".vortex[k]."_32.csv" using 1:2 every ::1 with points pointtype 7 pointsize 0.4, (x < 0.2 ? 5 * x : x < 0.4 ? 2 - 5 * x : 0) with lines linecolor rgb "black"
    }
    unset multiplot
}

if (there("gas_waves_errors")) {
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
    plot for [w in "sound Alfven fast slow 'slow, half of (9)'"] "gas_waves_errors.csv" using (strcol(1) eq w ? $2 : 1/0):3 every ::1 with linespoints pointtype 7 title w, \
        10 / x**2 with lines dashtype 2 linecolor rgb "black" title "N^{-2}"
}

if (there("gas_noh_1d")) {
    reset
    set datafile separator ","
    set output "gas_noh.png"
    set terminal pngcairo size 1500,500 font "sans,12"
    set multiplot layout 1,3 title "Noh's implosion at t = 0.6: rho"
    set grid linecolor rgb "#dddddd"
    set xrange [0:0.4]
    unset key
    array noh[3] = ["1d", "2d_none", "2d"]
    array noh_title[3] = ["line, Price", "disc, no conductivity", "disc, Price"]
    do for [k = 1:3] {
        set title noh_title[k]
        plot "gas_noh_".noh[k].".csv" using 1:2 every ::1 with points pointtype 7 pointsize 0.3, "" using 1:5 every ::1 with points pointtype 7 pointsize 0.2 linecolor rgb "black"
    }
    unset multiplot
}

if (there("gas_kh_growth")) {
    reset
    set datafile separator ","
    set output "gas_kh.png"
    set terminal pngcairo size 700,500 font "sans,12"
    set title "Kelvin-Helmholtz instability: amplitude of the mode"
    set logscale y
    set grid linecolor rgb "#dddddd"
    set xlabel "t"
    set key bottom left
    array growth[4] = ["32 x 32", "32 x 32, alpha = 1", "64 x 64", "128 x 128"]
    finest = system("head -n 1 gas_kh_growth.csv | grep -c 128") + 3
    plot "gas_kh_growth.csv" using 1:2 every ::1 with lines linecolor rgb "black" title "linear equations", \
        for [k = 1:finest] "" using 1:(column(k + 2)) every ::1 with linespoints pointtype 7 title growth[k]
}

if (there("gas_rotor_cleaned")) {
    reset
    set datafile separator ","
    set output "gas_rotor.png"
    set terminal pngcairo size 900,760 font "sans,12"
    set multiplot layout 2,2 title "MHD rotor at t = 0.15: B^2 / 2, and h div B / |B|; not cleaned, cleaned"
    set size ratio 1
    set xrange [0:1]
    set yrange [0:1]
    unset key
    array rotor[2] = ["not", "cleaned"]
    do for [c = 5:6] {
        do for [k = 1:2] {
            if (c == 5) { set cbrange [0:2.6]; set palette defined (0 "#2c7bb6", 1 "#ffffbf", 2 "#d7191c") }
            if (c == 6) { set cbrange [-0.2:0.2]; set palette defined (-1 "#2c7bb6", 0 "#f7f7f7", 1 "#d7191c") }
            plot "gas_rotor_".rotor[k].".csv" using 1:2:c every ::1 with points pointtype 7 pointsize 0.4 linecolor palette
        }
    }
    unset multiplot
}

if (there("gas_evrard_particles")) {
    reset
    set datafile separator ","
    set output "gas_evrard.png"
    set terminal pngcairo size 700,500 font "sans,12"
    set title "Evrard's collapse: energies of particles (points) and shells (lines)"
    set grid linecolor rgb "#dddddd"
    set xlabel "t"
    set key bottom left
    array energy[4] = ["kinetic", "thermal", "gravity", "total"]
    plot for [k = 1:4] "gas_evrard_shells.csv" using 1:(column(k + 1)) every ::1 with lines linecolor k title energy[k], \
        for [k = 1:4] "gas_evrard_particles.csv" using 1:(column(k + 1)) every ::1 with points pointtype 7 linecolor k notitle
}

if (there("gas_polytrope_profile")) {
    reset
    set datafile separator ","
    set output "gas_polytrope.png"
    set terminal pngcairo size 700,500 font "sans,12"
    set title "Polytrope of index 1: rho"
    set grid linecolor rgb "#dddddd"
    set xlabel "r"
    plot "gas_polytrope_profile.csv" using 1:2 every ::1 with points pointtype 7 pointsize 0.4 title "particles", \
        (x < 1 ? sin(pi * x) / (4 * x) : 0) with lines linecolor rgb "black" title "exact"
}
