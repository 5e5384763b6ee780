# SPDX-License-Identifier: MIT
# The pictures of the gallery, from the tables that the examples write with -o:
#     gnuplot -c examples/gallery.gp build/gallery          (make gallery does it all)
cd ARG1
set datafile separator ","
set palette defined (0 "#352a87", 0.25 "#0f7ec9", 0.5 "#1fb5a3", 0.75 "#d5ba58", 1 "#f9fb0e")
there(name) = system(sprintf("test -r %s.csv && echo yes", name)) eq "yes"
csv(name) = name.".csv"
set style data points
unset key
dots = 7

if (there("hello_kernel")) {
    set terminal pngcairo size 600,360 font "sans,10"
    set output "hello_kernel.png"
    set key top right
    set xlabel "r / h"
    set grid linecolor rgb "#dddddd"
    set multiplot layout 1,2
    array kernel[4] = ["cubic-spline", "quintic-spline", "wendland-c2", "wendland-c6"]
    array color[4] = ["#0072b2", "#d55e00", "#009e73", "#000000"]
    do for [q = 3:4] {
        set title q == 3 ? "W in 2D, h = 1" : "-dW/dr"
        plot for [k = 1:4] csv("hello_kernel") using (strcol(1) eq kernel[k] ? $2 : NaN):q every ::1 with lines linewidth 2 linecolor rgb color[k] title kernel[k]
    }
    unset multiplot
    unset key
    unset grid
    unset xlabel
}

# from here on, pictures of particles
set tics format ""
set tics scale 0
set border linecolor rgb "#888888"

if (there("first_cloud")) {
    set terminal pngcairo size 600,440 font "sans,10"
    set output "first_cloud.png"
    array cloud[6] = ["right", "lists as long as h", "the support as h", "masses as volumes", "box forgotten", "old lists"]
    set xrange [0:1]
    set yrange [0:1]
    set size ratio -1
    set cbrange [0.4:1.2]
    set format cb "%g"
    set colorbox user origin 0.93,0.3 size 0.015,0.4
    set multiplot layout 2,3 margins 0.02,0.9,0.03,0.86 spacing 0.03,0.08 title "sum of V W: 1 in a right cloud"
    do for [k = 0:5] {
        set title cloud[k + 1]
        plot csv("first_cloud") using ($1 == k ? $2 : NaN):3:5 every ::1 pointtype dots pointsize 0.4 palette
    }
    unset multiplot
    unset title
    set colorbox default

    # one particle, its support, and its neighbours
    set terminal pngcairo size 600,330 font "sans,10"
    set output "first_cloud_needs.png"
    set xrange [*:*]
    set yrange [*:*]
    set style textbox opaque noborder
    stats csv("first_cloud") using ($1 == 0 ? ($0 == 435 ? $2 : NaN) : NaN) every ::1 nooutput
    px = STATS_mean
    stats csv("first_cloud") using ($1 == 0 ? ($0 == 435 ? $3 : NaN) : NaN) every ::1 nooutput
    py = STATS_mean
    stats csv("first_cloud") using ($1 == 0 ? $4 : NaN) every ::1 nooutput
    h = STATS_mean
    set xrange [px-0.16:px+0.2]
    set yrange [py-0.11:py+0.105]
    near(a, b) = (a - px)**2 + (b - py)**2 < 4 * h**2
    set object 1 circle at px,py size 2*h fillcolor rgb "#dcebf7" fillstyle solid border linecolor rgb "#0072b2" behind
    set object 2 circle at px,py size h fillstyle empty border linecolor rgb "#0072b2" dashtype 2
    set arrow 1 from px,py to px+h,py linecolor rgb "#0072b2" linewidth 2
    set arrow 2 from px,py to px-2*h*cos(0.7),py+2*h*sin(0.7) linecolor rgb "#0072b2" linewidth 2
    set label 1 "h" at px+0.6*h,py-0.006 center textcolor rgb "#0072b2" boxed
    set label 2 "support" at px-1.2*h*cos(0.7),py+1.2*h*sin(0.7) center textcolor rgb "#0072b2" boxed
    set label 3 "a particle: x, V, f" at px+0.004,py+0.009 boxed
    set label 4 "its list: all inside the support" at px,py-2*h-0.008 center textcolor rgb "#009e73" boxed
    set label 5 "V: the area\nthat it stands for" at px+2.3*h,py+0.9*h center
    set object 3 rectangle center px+2.3*h,py+1.6*h size 1./30,1./30 fillcolor rgb "#f0e0c0" fillstyle solid border linecolor rgb "#d55e00"
    plot csv("first_cloud") using ($1 == 0 ? $2 : NaN):3 every ::1 pointtype dots pointsize 0.7 linecolor rgb "#777777", \
        csv("first_cloud") using ($1 == 0 && near($2, $3) ? $2 : NaN):3 every ::1 pointtype dots pointsize 1.1 linecolor rgb "#009e73", \
        "+" using (px):(py) every ::0::0 pointtype dots pointsize 1.5 linecolor rgb "#d55e00"
    unset object
    unset arrow
    unset label
}

if (there("density_cloud")) {
    set terminal pngcairo size 600,440 font "sans,10"
    set output "density_cloud.png"
    set title "density of 6000 particles drawn from a Gaussian"
    set logscale cb
    set cbrange [0.001:0.16]
    set format cb "%g"
    set xrange [-4.2:4.2]
    set yrange [-3:3]
    set size ratio -1
    plot csv("density_cloud") using 1:2:4 every ::1 pointtype dots pointsize 0.35 palette
    unset logscale cb
}

if (there("gradient_correction")) {
    set terminal pngcairo size 600,330 font "sans,10"
    set output "gradient_correction.png"
    set multiplot layout 1,2 title "error of the gradient of sin(2 pi x) cos(pi y), per cent of its largest value"
    set xrange [0:1]
    set yrange [0:1]
    set logscale cb
    set cbrange [0.3:60]
    set format cb "%g"
    do for [q = 4:5] {
        set title q == 4 ? "without correction" : "with correction (CSPM)"
        plot csv("gradient_correction") using 1:2:(100 * column(q) / (2 * pi)) every ::1 pointtype 5 pointsize 0.7 palette
    }
    unset multiplot
    unset logscale cb
}

unset colorbox
if (there("dam_break")) {
    set terminal pngcairo size 600,400 font "sans,10"
    set output "dam_break.png"
    set multiplot layout 2,2 title "a column of water collapses; colour: speed"
    set xrange [-0.2:5.2]
    set yrange [-0.2:3]
    set cbrange [0:2.5]
    do for [k = 0:3] {
        set title sprintf("t = %.1f sqrt(A / g)", 1.2 * k)
        plot csv("dam_break") using (abs($1 - 1.2 * k) < 0.1 && $7 < 0.5 ? $2 : NaN):3 every ::1 pointtype dots pointsize 0.2 linecolor rgb "#888888", \
            "" using (abs($1 - 1.2 * k) < 0.1 && $7 > 0.5 ? $2 : NaN):3:(sqrt($4**2 + $5**2)) every ::1 pointtype dots pointsize 0.35 palette
    }
    unset multiplot
}

if (there("delta_dam")) {
    set terminal pngcairo size 600,400 font "sans,10"
    set output "delta_dam.png"
    set multiplot layout 2,2 title "the pressure of a dam that breaks: plain, and with density diffusion and shifting"
    set xrange [-0.3:4.3]
    set yrange [-0.3:2.2]
    set cbrange [0:1.5]
    do for [s = 0:1] {
        do for [k = 1:2] {
            set title sprintf("%s, t = %.1f sqrt(A / g)", s ? "smooth" : "plain", 1.2 * k)
            plot csv("delta_dam") using ($1 == s && abs($2 - 1.2 * k) < 0.1 && $8 < 0.5 ? $3 : NaN):4 every ::1 pointtype dots pointsize 0.2 linecolor rgb "#888888", \
                "" using ($1 == s && abs($2 - 1.2 * k) < 0.1 && $8 > 0.5 ? $3 : NaN):4:($7 < 0 ? 0 : $7) every ::1 pointtype dots pointsize 0.45 palette
        }
    }
    unset multiplot
}

if (there("heat_plate")) {
    set terminal pngcairo size 600,250 font "sans,10"
    set output "heat_plate.png"
    set multiplot layout 1,3 title "temperature of a plate with a hot left edge"
    set xrange [0:1]
    set yrange [0:1]
    set cbrange [0:1]
    do for [k = 1:3] {
        at = k == 1 ? 0.002 : k == 2 ? 0.02 : 0.2
        set title sprintf("t = %g", at)
        plot csv("heat_plate") using (abs($1 - at) < 1e-6 ? $2 : NaN):3:4 every ::1 pointtype 5 pointsize 0.6 palette
    }
    unset multiplot
}

if (there("poisson_scattered")) {
    set terminal pngcairo size 600,420 font "sans,10"
    set output "poisson_scattered.png"
    set title "lap u = f on 1089 scattered points"
    set xrange [0:1]
    set yrange [0:1]
    set zrange [-1:1]
    set cbrange [-1:1]
    set view 55,30
    set size noratio
    splot csv("poisson_scattered") using 1:2:3 every ::1 pointtype dots pointsize 0.7 palette
    set size ratio -1
}

if (there("clean_field")) {
    set terminal pngcairo size 600,250 font "sans,10"
    set output "clean_field.png"
    set multiplot layout 1,3 title "h div B: carried away as waves, and damped"
    set xrange [0:1]
    set yrange [0:1]
    set palette defined (-1 "#2166ac", 0 "#f7f7f7", 1 "#b2182b")
    set cbrange [-0.03:0.03]
    do for [k = 1:3] {
        at = k == 1 ? 0 : k == 2 ? 0.2 : 1
        set title sprintf("t = %g", at)
        plot csv("clean_field") using (abs($1 - at) < 1e-6 ? $2 : NaN):3:6 every ::1 pointtype 5 pointsize 0.42 palette
    }
    unset multiplot
}

if (there("spread_cloud")) {
    set terminal pngcairo size 600,250 font "sans,10"
    set output "spread_cloud.png"
    set multiplot layout 1,3 title "clumps of four particles fly about"
    set xrange [0:1]
    set yrange [0:1]
    array state[3] = ["at first", "without collisions", "with collisions"]
    do for [k = 0:2] {
        set title state[k + 1]
        plot csv("spread_cloud") using ($1 == k ? $2 : NaN):3 every ::1 pointtype dots pointsize 0.3 linecolor rgb "#0072b2"
    }
    unset multiplot
}

if (there("host_structs")) {
    set terminal pngcairo size 600,440 font "sans,10"
    set output "host_structs.png"
    set title "a hill: Laplacian of its height (colour), and where water runs"
    set xrange [0:1]
    set yrange [0:1]
    set cbrange [-35:35]
    set colorbox
    plot csv("host_structs") using 1:2:6 every ::1 pointtype 5 pointsize 1 palette, \
        "" using 1:2:(-0.012 * $4):(-0.012 * $5) every 11::1 with vectors head size 0.008,20 linecolor rgb "black"
}

if (there("host_lists")) {
    set terminal pngcairo size 600,440 font "sans,10"
    set output "host_lists.png"
    set title "a hot spot bursts: pressure (colour) and acceleration"
    set xrange [0:1]
    set yrange [0:1]
    set cbrange [0:11]
    set palette defined (0 "#f7f7f7", 0.3 "#fdd49e", 0.7 "#fc8d59", 1 "#b30000")
    plot csv("host_lists") using 1:2:3 every ::1 pointtype 5 pointsize 1.1 palette, \
        "" using 1:2:(0.0008 * $4):(0.0008 * $5) every 2::1 with vectors head size 0.008,20 linecolor rgb "black"
}

unset colorbox
set palette defined (0 "#0f7ec9", 0.5 "#1fb5a3", 1 "#d5ba58")
if (there("drop_3d")) {
    set terminal pngcairo size 600,250 font "sans,10"
    set output "drop_3d.png"
    set multiplot layout 1,3 title "a drop is squeezed flat: pressure on the plane y = 0, and the exact outline"
    set xrange [-1.7:1.7]
    set yrange [-1.1:1.1]
    set cbrange [0:1]
    set trange [0:2*pi]
    do for [k = 0:2] {
        at = 0.2 * k
        stats [*:*] [*:*] csv("drop_3d") using (abs($1 - at) < 1e-6 ? $6 : NaN) every ::1 nooutput
        A = STATS_mean
        set parametric
        set title sprintf("t = %.1f", at)
        plot csv("drop_3d") using (abs($1 - at) < 1e-6 && abs($3) < 0.1 ? $2 : NaN):4:5 every ::1 pointtype dots pointsize 0.6 palette, \
            A * cos(t), sin(t) / A**2 with lines linecolor rgb "black"
        unset parametric
    }
    unset multiplot
}

if (there("embedded_loop")) {
    set terminal pngcairo size 600,190 font "sans,10"
    set output "embedded_loop.png"
    set multiplot layout 1,4 title "16 x 16 lights: water runs to wherever is down; colour: pressure"
    set xrange [0:16]
    set yrange [0:16]
    set cbrange [0:8]
    array down[4] = ["down", "right", "up", "left"]
    do for [k = 0:3] {
        set title down[k + 1]
        plot csv("embedded_loop") using ($1 == k ? $2 : NaN):3:4 every ::1 pointtype dots pointsize 0.6 palette
    }
    unset multiplot
}

if (there("probes")) {
    set terminal pngcairo size 600,330 font "sans,10"
    set output "probes.png"
    set multiplot layout 1,2 title "a vortex in a tank, at points that are no particles"
    set xrange [0:1]
    set yrange [0:1]
    set size ratio -1
    set cbrange [0:2 * pi]
    set colorbox
    set format cb "%g"
    set title "vorticity"
    plot csv("probes") using ($8 < 0.5 ? $1 : NaN):2:4 every ::1 pointtype 5 pointsize 1.1 palette
    unset colorbox
    set title "pressure along the floor"
    set size noratio
    set yrange [2.9:3.75]
    set tics format "%g"
    set key top center
    plot csv("probes") using ($8 > 0.5 ? $1 : NaN):6 every ::1 with lines linewidth 2 linecolor rgb "#888888" title "exact", \
        "" using ($8 > 0.5 ? $1 : NaN):7 every ::1 pointtype 6 pointsize 0.7 linecolor rgb "#d55e00" title "mean of the neighbours", \
        "" using ($8 > 0.5 ? $1 : NaN):5 every ::1 pointtype dots pointsize 0.7 linecolor rgb "#0072b2" title "moving least squares"
    unset multiplot
    unset key
}
