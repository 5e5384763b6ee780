#!/bin/sh
# SPDX-License-Identifier: MIT
# Reads the assembly of the sweeps of sph_ops.h, called with a constant kernel and dimension: nothing but the scans of arguments before the loops, memset and memcpy (of small matrices, once a row) may be called,
# nothing may jump through a table, and square roots must be packed: with plain -O2 (in gcc before version 12 with -fopenmp-simd -DSPH_SIMD=1 only), and in the sweeps with
# many sums with plain -O3, too. x86-64 only.
. tests/check.sh

{
    echo '#include "sph_ops.h"'
    cat << 'END'
SPH_FN sph_elliptic_options sourced(sph_scalars source)
{
    sph_elliptic_options o = {0};
    o.source = source;
    return o;
}
SPH_FN sph_fluid fluid(sph_scalars V, sph_scalars f)
{
    sph_fluid s = {.m = V, .rho = V, .p = f, .c = f, .v = {f, f, f}, .viscosity = SPH_VISCOSITY_MONAGHAN};
    s.alpha = s.eta = sph_kernel_support_ratio(SPH_CUBIC_SPLINE);
    return s;
}
END
    cat << 'END'
SPH_FN sph_matrix_out nine(sph_real *p)
{
    sph_matrix_out m = {{p, p + 1, p + 2, 9}, {p + 3, p + 4, p + 5, 9}, {p + 6, p + 7, p + 8, 9}};
    return m;
}
SPH_FN sph_solid solid(sph_scalars f, sph_points x)
{
    sph_solid s = {.inverse = {{f, f, f}, {f, f, f}, {f, f, f}}, .stress = {{f, f, f}, {f, f, f}, {f, f, f}}, .density = f};
    s.gradient = s.inverse;
    s.modulus = f;
    s.hourglass = SPH_R(1);
    s.x = x;
    return s;
}
SPH_FN sph_diffusion delta(sph_fluid s, sph_scalars f)
{
    sph_diffusion d = {.fluid = s, .delta = SPH_R(0.1), .tait = {.c = SPH_R(10)}, .gradient = {f, f, f}};
    return d;
}
END
    for dim in 1 2 3; do
        for sweep in 'shepard|sph_shepard_sum(SPH_WENDLAND_C2, D, x, sph_scalar_out_array(a, 0))' \
            'interpolate|sph_interpolate_shepard(SPH_WENDLAND_C2, D, x, f, sph_scalar_out_array(a, s))' \
            'difference|sph_gradient_difference(SPH_WENDLAND_C2, D, x, f, sph_vector_out_separate(a, b, c))' \
            'gradient|sph_gradient_cspm(SPH_WENDLAND_C2, D, x, f,
                (sph_derivatives_out){.gx = a, .gy = b, .gz = c, .stride = 1, .status = s})' \
            'brookshaw|sph_laplacian_brookshaw(SPH_WENDLAND_C2, D, x, f, sph_scalar_out_array(a, 0))' \
            'brookshawrows|sph_laplacian_rows_brookshaw(SPH_WENDLAND_C2, D, x, (sph_rows_out){.row = a})' \
            'tilecspm|sph_derivatives_cspm(SPH_WENDLAND_C2, D, x, f, (sph_derivatives_options){0}, out)' \
            'tileicspm|sph_derivatives_icspm(SPH_WENDLAND_C2, D, x, f, (sph_derivatives_options){0}, out)' \
            'tilewls|sph_derivatives_wls(SPH_WENDLAND_C2, D, x, f, (sph_derivatives_options){0}, out)' \
            'msph|sph_elliptic_msph(SPH_CUBIC_SPLINE, D, x, f, sourced(x.volume), f,
                sph_scalar_out_array(a, s))' \
            'msphrows|sph_elliptic_rows_msph(SPH_CUBIC_SPLINE, D, x, f, (sph_elliptic_options){0},
                (sph_rows_out){.row = b})' \
            'diffusion|sph_density_diffusion_antuono(SPH_WENDLAND_C2, D, x, delta(fluid(x.volume, f), f),
                sph_scalar_out_array(a, s))' \
            'shift|sph_shift_displacement(SPH_WENDLAND_C2, D, x, (sph_shift){.strength = f, .tensile = 0.2, .spacing = 0.8}, sph_vector_out_separate(a, b, c))' \
            'fluid|sph_fluid_rates_colagrossi(SPH_WENDLAND_C2, D, x, fluid(x.volume, f), (sph_fluid_out){.acceleration = sph_vector_out_separate(a, b, c), .rate = out.gx, .heating = out.gy})' \
            'riemann|sph_fluid_rates_riemann(SPH_WENDLAND_C2, D, x, fluid(x.volume, f), (sph_riemann_options){0}, (sph_fluid_out){.acceleration = sph_vector_out_separate(a, b, c), .rate = out.gx, .heating = out.gy})' \
            'rkcorrection|sph_rk_correction(SPH_WENDLAND_C2, D, x, (sph_rk_out){.scale = a, .slope = sph_vector_out_separate(b, c, out.gx), .scale_gradient = sph_vector_out_separate(out.gy, out.gz, out.hxx), .slope_gradient = nine(out.hxy)})' \
            'solid|sph_solid_acceleration(SPH_WENDLAND_C2, D, x, solid(f, x.points), sph_vector_out_separate(a, b, c))' \
            'css|sph_tension_css(SPH_WENDLAND_C2, D, x, (sph_tension){.rho = f, .normal = {f, f, f}, .sigma = 1}, sph_vector_out_separate(a, b, c))' \
            'csf|sph_tension_csf(SPH_WENDLAND_C2, D, x, (sph_tension){.rho = f, .normal = {f, f, f}, .sigma = 1}, (sph_tension_out){.acceleration = sph_vector_out_separate(a, b, c)})' \
            'gas|sph_gas_rates(SPH_WENDLAND_C2, D, x, (sph_gas){.medium = {f, f, f}, .p = f, .u = f, .cs = f, .alpha = f, .v = {f, f, f}, .conductivity = SPH_CONDUCTIVITY_PRICE}, (sph_gas_out){.acceleration = sph_vector_out_separate(a, b, c)})' \
            'shock|sph_shock_indicator(SPH_WENDLAND_C2, D, x, (sph_gas){.medium = {f, f, f}, .cs = f, .v = {f, f, f}}, f, (sph_shock_out){.ratio = a})' \
            'velocity|sph_velocity_gradient_cspm(SPH_WENDLAND_C2, D, x, (sph_vectors){f, f, f}, (sph_velocity_gradient_out){.div = a})' \
            'ohmic|sph_resistivity_ohmic(SPH_WENDLAND_C2, D, x, (sph_ohmic){.medium = {f, f, f}, .eta = f, .field = {f, f, f}}, (sph_ohmic_out){.rate_B = sph_vector_out_separate(a, b, c)})' \
            'crk|sph_gas_rates_crk(SPH_WENDLAND_C2, D, x, fluid(f, f), (sph_rk){.scale = f, .slope = {f, f, f}, .scale_gradient = {f, f, f}, .slope_gradient = {{f, f, f}, {f, f, f}, {f, f, f}}}, (sph_corrected_out){.acceleration = sph_vector_out_separate(a, b, c), .rate_u = out.gx})' \
            'iad|sph_gas_rates_iad(SPH_WENDLAND_C2, D, x, fluid(f, f), (sph_matrices){{f, f, f}, {f, f, f}, {f, f, f}}, (sph_corrected_out){.acceleration = sph_vector_out_separate(a, b, c), .rate_u = out.gx})' \
            'wallgradient|sph_wall_gradient(SPH_WENDLAND_C2, D, x, (sph_wall_terms){.gamma = f, .gradient = {f, f, f}, .value = f}, f, sph_vector_out_separate(a, b, c))' \
            'walllaplacian|sph_wall_laplacian(SPH_WENDLAND_C2, D, x, (sph_wall_terms){.gamma = f, .gradient = {f, f, f}, .slope = {f, f, f}}, f, sph_scalar_out_array(a, 0))' \
            'wallrows|sph_wall_laplacian_rows(SPH_WENDLAND_C2, D, x, (sph_wall_terms){.gamma = f, .gradient = {f, f, f}, .slope = {f, f, f}}, (sph_rows_out){.row = a}, sph_scalar_out_array(b, 0))' \
            'dfsph|sph_pressure_factor_dfsph(SPH_WENDLAND_C2, D, x, fluid(x.volume, f), sph_scalars_none(), sph_scalar_out_array(a, s))'; do
            name=sweep_${sweep%%|*}_$dim
            arguments='sph_cloud x, sph_scalars f, sph_real *a, sph_real *b, sph_real *c, unsigned char *s,
                sph_derivatives_out out'
            case $name in sweep_tile*) echo '#ifndef LISTS_ALONE' ;; *) echo '#ifndef TILES_ALONE' ;; esac
            echo "sph_index $name($arguments);"
            echo "sph_index $name($arguments) { (void)f, (void)a, (void)b, (void)c, (void)s, (void)out;"
            echo "return $(printf '%s' "${sweep#*|}" | sed "s/D,/$dim,/"); }"
            echo '#endif'
        done
    done
} > "$scratch/sweeps.c"

# name, calls other than memset, memcpy and the scans of arguments, jumps through a table, packed square roots
count() {
    awk '/^sweep_[a-z_0-9]*:/ { name = $1; sub(/:/, "", name); names[name] = 1 }
        $1 ~ /^callq?$/ && $2 !~ /memset|memcpy|sphi_scan_/ { calls[name]++ }
        ($1 ~ /^jmpq?$/ && $2 ~ /^\*/) || ($1 == "notrack") { jumps[name]++ }
        $1 ~ /^v?sqrtpd$/ { packed[name]++ }
        END { for (n in names) print n, calls[n] + 0, jumps[n] + 0, packed[n] + 0 }' "$1" | sort
}
# every function obeys: awk condition on $2, $3, $4
obeys() { awk "!($2) { print; bad = 1 } END { exit bad || NR == 0 }" "$1"; }

cat > "$scratch/control.c" << 'END'
#include "sph_ops.h"
sph_real sweep_control(sph_kernel k, const sph_real *r, int n);
sph_real sweep_control(sph_kernel k, const sph_real *r, int n)
{
    sph_real s = 0;
    int i;
    for (i = 0; i < n; i++) s += sph_kernel_f(k, 3, r[i], 1);
    return s;
}
END

older= # a gcc that makes vectors with a flag only
[ "$(gcc -dumpversion 2> /dev/null | cut -d. -f1)" -lt 12 ] 2> /dev/null && older=1
for cc in gcc ${older:+"gcc -DLISTS_ALONE -fopenmp-simd -DSPH_SIMD=1"} clang; do
    case $cc in *LISTS*) sweeps=78 ;; *) sweeps=87 ;; esac
    usable "assembly of the sweeps by $cc" "$empty" '' "$cc -std=c99 -O2" || continue
    if [ "$($cc -dumpmachine | cut -d- -f1)" != x86_64 ]; then
        skip "assembly of the sweeps by $cc" "not for x86-64"
        continue
    fi
    check "$cc" $cc -std=c99 -O2 -Wall -Wextra -Wno-pass-failed -Werror -I. -S "$scratch/sweeps.c" -o "$scratch/sweeps.s"
    count "$scratch/sweeps.s" > "$scratch/counts"
    check "$cc: $sweeps sweeps" test "$(wc -l < "$scratch/counts")" -eq $sweeps
    check "$cc: no call" obeys "$scratch/counts" '$2 == 0'
    check "$cc: no jump table" obeys "$scratch/counts" '$3 == 0'
    grep -v -e _1 "$scratch/counts" > "$scratch/counts_nd" # |x| needs no square root in 1D
    if [ "$cc" = gcc ] && [ $older ]; then
        skip "packed square roots by gcc without a flag" "it is older than version 12"
    else
        check "$cc: packed square roots" obeys "$scratch/counts_nd" '$4 > 0'
    fi
    [ "$cc" = gcc ] || continue
    check "gcc -O3" gcc -std=c99 -O3 -DTILES_ALONE -I. -S "$scratch/sweeps.c" -o "$scratch/sweeps.s"
    count "$scratch/sweeps.s" | grep _tile > "$scratch/counts"
    check "gcc -O3: packed square roots of the tiles" obeys "$scratch/counts" '$4 > 0'
    # the detector sees what it must object to: a kernel that is not constant
    check "control" gcc -std=c99 -O2 -I. -S "$scratch/control.c" -o "$scratch/control.s"
    count "$scratch/control.s" > "$scratch/counts"
    check "the control jumps" obeys "$scratch/counts" '$2 + $3 > 0'
done
finish sweeps
