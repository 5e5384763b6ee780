# SPDX-License-Identifier: MIT
# The figures of the atlas, from the data files in a folder:
#     gnuplot -c examples/atlas/atlas.gp build/figures
# The pages of `make atlas` need no gnuplot.
cd ARG1
set datafile separator ","
set grid linecolor rgb "#dddddd"
there(name) = system(sprintf("test -r %s.csv && echo yes", name)) eq "yes"

# errors of some operators inside lattices, in disorder and at a wall: those of 2D and the first kernel
if (there("atlas_errors")) {
    rows(operator, cloud, region) = sprintf("< awk -F, '$1 == \"%s\" && $2 == 2 && $3 == \"wendland-c2\" && $4 == \"2.00\" && $5 == \"%s\" && $6 == \"%s\"' atlas_errors.csv", operator, cloud, region)
    set terminal pngcairo size 1400,900 font "sans,12"
    set output "atlas_errors.png"
    set multiplot layout 2,3 title "Errors against the spacing: gradients (above) and Laplacians (below), wendland-c2, h = 2 dx, 2D"
    set logscale xy 2
    set logscale y 10
    set format y "10^{%T}"
    set xlabel "dx"
    set xtics ("1/16" 0.0625, "1/32" 0.03125, "1/64" 0.015625, "1/128" 0.0078125, "1/256" 0.00390625, "1/512" 0.001953125) rotate by -45
    set xrange [0.0017:0.07]
    set key top left reverse Left samplen 2 font "sans,10"
    array cloud[3] = ["lattice", "random", "lattice"]
    array region[3] = ["inside", "inside", "wall"]
    array what[3] = ["inside a lattice", "inside, random particles", "at a wall, lattice"]
    do for [k = 1:3] {
        set title what[k]
        if (k > 1) { unset key } else { set key }
        plot for [o in "gradient_difference gradient_symmetric gradient_cspm gradient_iad gradient_rk gradient_wls"] rows(o, cloud[k], region[k]) using 7:8 with linespoints title o[10:*] noenhanced
    }
    do for [k = 1:3] {
        set title what[k]
        if (k > 1) { unset key } else { set key }
        plot for [o in "laplacian_brookshaw laplacian_cspm laplacian_icspm laplacian_fatehi_manzari laplacian_wls"] rows(o, cloud[k], region[k]) using 7:8 with linespoints title o[11:*] noenhanced
    }
    unset multiplot
}
