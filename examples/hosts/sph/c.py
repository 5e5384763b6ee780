# SPDX-License-Identifier: MIT
"""Structs, constants and prototypes of sph_shim.h, for ctypes.
Written by examples/hosts/generate.py from the headers: run it again instead of changing this file."""

from ctypes import Structure, c_char_p, c_double, c_int, c_int32, c_int64, c_size_t, c_ubyte, c_uint, c_void_p

VERSION = 200

# sph_kernel
CUBIC_SPLINE = 0  # cubic-spline
QUARTIC_SPLINE = 1  # quartic-spline
QUINTIC_SPLINE = 2  # quintic-spline
WENDLAND_C2 = 3  # wendland-c2
WENDLAND_C4 = 4  # wendland-c4
WENDLAND_C6 = 5  # wendland-c6
WENDLAND_C2_1D = 6  # wendland-c2-1d
WENDLAND_C4_1D = 7  # wendland-c4-1d
WENDLAND_C6_1D = 8  # wendland-c6-1d
GAUSSIAN = 9  # gaussian
SUPER_GAUSSIAN = 10  # super-gaussian
LIU_QUARTIC = 11  # liu-quartic
HERMITE = 12  # hermite
SCHUESSLER_SCHMITT = 13  # schuessler-schmitt
JOHNSON_BEISSEL = 14  # johnson-beissel
CONVEX = 15  # convex
CONVEX_CUBIC_SPLINE = 16  # convex-cubic-spline
CONVEX_WENDLAND_C2 = 17  # convex-wendland-c2
CONVEX_WENDLAND_C4 = 18  # convex-wendland-c4
CORE_TRIANGLE = 19  # core-triangle
SEXTIC_SPLINE = 20  # sextic-spline
HEPTIC_SPLINE = 21  # heptic-spline
POLY6 = 22  # poly6
SPIKY = 23  # spiky
KERNEL_COUNT = 24
LUCY = 6  # the same function

# sph_error
ERROR_NULL = -1  # a pointer is null
ERROR_DIM = -2  # dim is not 1, 2 or 3, or not that of the grid
ERROR_KERNEL = -3  # no such kernel, or none for this function (gravity)
ERROR_COUNT = -4  # a number of particles that cannot be; a stride or number of bins below 1
ERROR_RANGE = -5  # not 0 <= first <= last <= n; an end or a target that is not a particle
ERROR_H = -6  # h, a radius or a distance is not finite and positive, or extreme
ERROR_POSITION = -7
ERROR_VALUE = -8  # a value, parameter or option is not finite, or not allowed
ERROR_LIST = -9  # list rows do not ascend, or an entry is not a particle
ERROR_SELF = -10  # a row holds its own particle
ERROR_CAPACITY = -11  # the caller's memory is too small: see the function for what is needed
ERROR_BOX = -12  # a box length that cannot be; a support beyond half of it; far positions
ERROR_PAIRS = -13  # more pairs than sph_index can count, or memory can hold

# sph_status
OK = 0
TOO_FEW = 1  # fewer neighbours inside the support than unknowns, or too little weight
SINGULAR = 2  # the neighbours (collinear, coincident, ...) do not determine the answer
ILL_CONDITIONED = 3  # computed, but the conditioning is below the caller's limit; or no h fits
FELL_BACK = 4  # computed by the fallback that the caller allowed
NOT_AVAILABLE = 5  # the operator is not defined at this particle
NOT_FINITE = 6  # the result overflowed
LIST_TOO_SHORT = 7  # the list is too short for the answer; the operator says what it returns

# sph_elliptic_gradient
GRADIENT_DIFFUSE = 0  # (15) grad W
GRADIENT_FULL = 1  # (16) grad (W / nu). Best for M-SPH at boundaries
GRADIENT_SHEPARD_DIFFUSE = 2  # (17) (grad W) / nu
GRADIENT_SHEPARD_FULL = 3  # (18) grad_j (W / nu): of nu, only the neighbour's part varies

# sph_mobility_mean
MOBILITY_ARITHMETIC = 0  # (m_i + m_j) / 2: as published
MOBILITY_HARMONIC = 1  # 2 m_i m_j / (m_i + m_j): keeps the flux through a jump of m
MOBILITY_UPWIND = 2  # m of the particle with the higher potential; m_i if they are equal

# sph_viscosity
VISCOSITY_NONE = 0
VISCOSITY_MONAGHAN = 1  # sph_viscosity_pair_monaghan: pairs that approach
VISCOSITY_LINEAR = 2  # sph_viscosity_pair_linear: all pairs
VISCOSITY_SIGNAL = 3  # sph_viscosity_pair_signal: pairs that approach, by the signal speed

# sph_surface
SURFACE_INSIDE = 0  # lambda > 0.75
SURFACE_BAND = 1  # look closer
SURFACE_SPLASH = 2  # lambda < 0.2: at the surface, or outside

# sph_conductivity
CONDUCTIVITY_NONE = 0
CONDUCTIVITY_PRICE = 1  # sph_conductivity_speed: differences of pressure
CONDUCTIVITY_WADSLEY = 2  # |w|: nothing at rest, so that it may be used with gravity

# sph_finding
FINDING_LIST_SHORT = 0  # every row ends before the support does
FINDING_LIST_SUPPORT = 1  # every row ends at h: h and the support are mixed up
FINDING_LIST_HALF = 2  # each pair is in one of its two rows only
FINDING_LIST_ONE_SIDED = 3  # pairs are missing that are inside the support of one particle only
FINDING_LIST_STALE = 4  # rows lack particles that are nearer than others they hold: an old list
FINDING_LIST_FROM_ONE = 5  # indices or starts count from 1
FINDING_BOX = 6  # positions and list do not have the same periodic box
FINDING_VOLUME_ZERO = 7  # a volume is negative, or more than half of them are 0
FINDING_VOLUME_SUM = 8  # sum_j V_j W_ij in the interior is far from 1: perhaps masses were given
FINDING_DIM_HIGH = 9  # a coordinate is the same for all particles: dim is too high
FINDING_DIM_LOW = 10  # particles differ in a coordinate beyond dim: dim is too low
FINDING_STRIDE = 11  # the stride of positions is in bytes, or two components share memory
FINDING_COUNT = 12

# sph_criterion
GATHER = 0  # r < R_i
SCATTER = 1  # r < R_j
LARGER = 2  # r < max(R_i, R_j)
MEAN = 3  # r < (R_i + R_j) / 2

# sph_list_flags
LIST_SELF = 1  # a row also holds its own particle
LIST_HALF = 2  # each pair once: only j > i (for a symmetric criterion)
LIST_SORTED = 4  # each row in ascending order of j
LIST_FOREIGN = 8  # target i has nothing to do with source i (not together with SELF or HALF)


class sph_vec(Structure):
    _fields_ = [
        ("x", c_double),
        ("y", c_double),
        ("z", c_double),
    ]


class sph_sym(Structure):
    _fields_ = [
        ("xx", c_double),
        ("xy", c_double),
        ("yy", c_double),
        ("xz", c_double),
        ("yz", c_double),
        ("zz", c_double),
    ]


class sph_points(Structure):
    _fields_ = [
        ("x", c_void_p),
        ("y", c_void_p),
        ("z", c_void_p),
        ("stride", c_size_t),
        ("n", c_int32),
        ("box", sph_vec),
    ]


class sph_scalars(Structure):
    _fields_ = [
        ("p", c_void_p),
        ("stride", c_size_t),
    ]


class sph_list(Structure):
    _fields_ = [
        ("start", c_void_p),
        ("index", c_void_p),
    ]


class sph_vectors(Structure):
    _fields_ = [
        ("x", sph_scalars),
        ("y", sph_scalars),
        ("z", sph_scalars),
    ]


class sph_vector_out(Structure):
    _fields_ = [
        ("x", c_void_p),
        ("y", c_void_p),
        ("z", c_void_p),
        ("stride", c_size_t),
    ]


class sph_scalar_out(Structure):
    _fields_ = [
        ("p", c_void_p),
        ("stride", c_size_t),
        ("status", c_void_p),
    ]


class sph_matrices(Structure):
    _fields_ = [
        ("x", sph_vectors),
        ("y", sph_vectors),
        ("z", sph_vectors),
    ]


class sph_matrix_out(Structure):
    _fields_ = [
        ("x", sph_vector_out),
        ("y", sph_vector_out),
        ("z", sph_vector_out),
    ]


class sph_cloud(Structure):
    _fields_ = [
        ("points", sph_points),
        ("list", sph_list),
        ("h", sph_scalars),
        ("volume", sph_scalars),
        ("first", c_int32),
        ("last", c_int32),
        ("checked", c_int),
        ("largest_h", c_double),
    ]


class sph_derivatives_out(Structure):
    _fields_ = [
        ("gx", c_void_p),
        ("gy", c_void_p),
        ("gz", c_void_p),
        ("hxx", c_void_p),
        ("hxy", c_void_p),
        ("hyy", c_void_p),
        ("hxz", c_void_p),
        ("hyz", c_void_p),
        ("hzz", c_void_p),
        ("laplacian", c_void_p),
        ("conditioning", c_void_p),
        ("stride", c_size_t),
        ("status", c_void_p),
    ]


class sph_rows_out(Structure):
    _fields_ = [
        ("row", c_void_p),
        ("diagonal", c_void_p),
        ("factor", c_void_p),
        ("conditioning", c_void_p),
        ("stride", c_size_t),
        ("status", c_void_p),
    ]


class sph_correction_out(Structure):
    _fields_ = [
        ("inverse", sph_matrix_out),
        ("conditioning", c_void_p),
        ("stride", c_size_t),
        ("status", c_void_p),
    ]


class sph_gradient_rows_out(Structure):
    _fields_ = [
        ("x", c_void_p),
        ("y", c_void_p),
        ("z", c_void_p),
        ("conditioning", c_void_p),
        ("stride", c_size_t),
        ("status", c_void_p),
    ]


class sph_density_options(Structure):
    _fields_ = [
        ("list_radius", sph_scalars),
        ("eta", c_double),
        ("tolerance", c_double),
    ]


class sph_density_out(Structure):
    _fields_ = [
        ("h", c_void_p),
        ("rho", c_void_p),
        ("omega", c_void_p),
        ("stride", c_size_t),
        ("status", c_void_p),
    ]


class sph_jet(Structure):
    _fields_ = [
        ("gradient", sph_vec),
        ("hessian", sph_sym),
    ]


class sph_derivatives_options(Structure):
    _fields_ = [
        ("conditioning_min", c_double),
        ("fallback_wls", c_int),
    ]


class sph_sources(Structure):
    _fields_ = [
        ("points", sph_points),
        ("volume", sph_scalars),
    ]


class sph_interpolation_options(Structure):
    _fields_ = [
        ("conditioning_min", c_double),
    ]


class sph_interpolation_out(Structure):
    _fields_ = [
        ("value", c_void_p),
        ("gx", c_void_p),
        ("gy", c_void_p),
        ("gz", c_void_p),
        ("conditioning", c_void_p),
        ("stride", c_size_t),
        ("status", c_void_p),
    ]


class sph_interpolation_rows_out(Structure):
    _fields_ = [
        ("value", c_void_p),
        ("x", c_void_p),
        ("y", c_void_p),
        ("z", c_void_p),
        ("conditioning", c_void_p),
        ("stride", c_size_t),
        ("status", c_void_p),
    ]


class sph_elliptic_options(Structure):
    _fields_ = [
        ("gradient", c_int),
        ("mean", c_int),
        ("gamma_star", c_int),
        ("trace", c_int),
        ("conditioning_min", c_double),
        ("potential", sph_scalars),
        ("source", sph_scalars),
    ]


class sph_elliptic_report(Structure):
    _fields_ = [
        ("sign_least", c_void_p),
        ("sign_most", c_void_p),
        ("xi", c_void_p),
        ("continuity", c_void_p),
        ("n", c_void_p),
        ("n_bound", c_void_p),
        ("eigenvalue_least", c_void_p),
        ("eigenvalue_ratio", c_void_p),
        ("stride", c_size_t),
        ("status", c_void_p),
    ]


class sph_diagonal(Structure):
    _fields_ = [
        ("x", sph_scalars),
        ("y", sph_scalars),
        ("z", sph_scalars),
    ]


class sph_boundary(Structure):
    _fields_ = [
        ("normal", sph_vectors),
        ("alpha", sph_scalars),
        ("beta", sph_scalars),
    ]


class sph_csr(Structure):
    _fields_ = [
        ("start", c_void_p),
        ("column", c_void_p),
        ("value", c_void_p),
        ("capacity", c_int64),
    ]


class sph_tait(Structure):
    _fields_ = [
        ("rho0", c_double),
        ("c", c_double),
        ("gamma", c_double),
        ("p0", c_double),
    ]


class sph_fluid(Structure):
    _fields_ = [
        ("m", sph_scalars),
        ("rho", sph_scalars),
        ("p", sph_scalars),
        ("c", sph_scalars),
        ("v", sph_vectors),
        ("viscosity", c_int),
        ("alpha", c_double),
        ("beta", c_double),
        ("eta", c_double),
    ]


class sph_fluid_out(Structure):
    _fields_ = [
        ("acceleration", sph_vector_out),
        ("rate", c_void_p),
        ("heating", c_void_p),
        ("stride", c_size_t),
        ("status", c_void_p),
    ]


class sph_shear_bulk(Structure):
    _fields_ = [
        ("shear", sph_scalars),
        ("bulk", sph_scalars),
    ]


class sph_wall(Structure):
    _fields_ = [
        ("share", sph_scalars),
        ("rho", sph_scalars),
        ("p", sph_scalars),
        ("v", sph_vectors),
        ("velocity", sph_vectors),
        ("normal", sph_vectors),
        ("gravity", sph_vec),
    ]


class sph_wall_out(Structure):
    _fields_ = [
        ("p", c_void_p),
        ("v", sph_vector_out),
        ("stride", c_size_t),
        ("status", c_void_p),
    ]


class sph_diffusion(Structure):
    _fields_ = [
        ("fluid", sph_fluid),
        ("delta", c_double),
        ("tait", sph_tait),
        ("share", sph_scalars),
        ("gradient", sph_vectors),
        ("gravity", sph_vec),
    ]


class sph_surface_out(Structure):
    _fields_ = [
        ("divergence", c_void_p),
        ("eigenvalue", c_void_p),
        ("normal", sph_vector_out),
        ("stride", c_size_t),
        ("status", c_void_p),
    ]


class sph_shift(Structure):
    _fields_ = [
        ("strength", sph_scalars),
        ("tensile", c_double),
        ("spacing", c_double),
        ("eigenvalue", sph_scalars),
        ("normal", sph_vectors),
        ("longest", c_double),
    ]


class sph_transport_out(Structure):
    _fields_ = [
        ("background", sph_vector_out),
        ("stress", sph_vector_out),
        ("status", c_void_p),
    ]


class sph_riemann_options(Structure):
    _fields_ = [
        ("limiter", c_double),
        ("gravity", sph_vec),
    ]


class sph_tension(Structure):
    _fields_ = [
        ("rho", sph_scalars),
        ("normal", sph_vectors),
        ("sigma", c_double),
        ("least", c_double),
    ]


class sph_tension_out(Structure):
    _fields_ = [
        ("acceleration", sph_vector_out),
        ("curvature", c_void_p),
        ("stride", c_size_t),
        ("status", c_void_p),
    ]


class sph_wall_elements(Structure):
    _fields_ = [
        ("n", c_int32),
        ("a", sph_vectors),
        ("b", sph_vectors),
        ("c", sph_vectors),
        ("list", sph_list),
    ]


class sph_wall_gamma_out(Structure):
    _fields_ = [
        ("gamma", c_void_p),
        ("gradient", sph_vector_out),
        ("stride", c_size_t),
        ("status", c_void_p),
    ]


class sph_wall_terms(Structure):
    _fields_ = [
        ("gamma", sph_scalars),
        ("gradient", sph_vectors),
        ("value", sph_scalars),
        ("slope", sph_vectors),
    ]


class sph_collision(Structure):
    _fields_ = [
        ("distance", c_double),
        ("restitution", c_double),
        ("inverse_mass", sph_scalars),
    ]


class sph_collision_report(Structure):
    _fields_ = [
        ("collisions", c_int64),
        ("coincident", c_int64),
        ("energy", c_double),
    ]


class sph_medium(Structure):
    _fields_ = [
        ("m", sph_scalars),
        ("rho", sph_scalars),
        ("omega", sph_scalars),
    ]


class sph_gas(Structure):
    _fields_ = [
        ("medium", sph_medium),
        ("p", sph_scalars),
        ("u", sph_scalars),
        ("cs", sph_scalars),
        ("alpha", sph_scalars),
        ("v", sph_vectors),
        ("beta", c_double),
        ("alpha_u", c_double),
        ("conductivity", c_int),
    ]


class sph_gas_out(Structure):
    _fields_ = [
        ("acceleration", sph_vector_out),
        ("rate_u", c_void_p),
        ("div_v", c_void_p),
        ("v_sig", c_void_p),
        ("stride", c_size_t),
        ("status", c_void_p),
    ]


class sph_velocity_gradient_out(Structure):
    _fields_ = [
        ("div", c_void_p),
        ("curl", c_void_p),
        ("shear", c_void_p),
        ("square", c_void_p),
        ("stride", c_size_t),
        ("x", sph_vector_out),
        ("y", sph_vector_out),
        ("z", sph_vector_out),
        ("status", c_void_p),
    ]


class sph_shock_out(Structure):
    _fields_ = [
        ("ratio", c_void_p),
        ("v_sig", c_void_p),
        ("stride", c_size_t),
        ("status", c_void_p),
    ]


class sph_cleaning(Structure):
    _fields_ = [
        ("medium", sph_medium),
        ("field", sph_vectors),
        ("psi", sph_scalars),
        ("div_v", sph_scalars),
        ("ch", c_double),
        ("sigma", c_double),
    ]


class sph_cleaning_out(Structure):
    _fields_ = [
        ("rate_B", sph_vector_out),
        ("rate_psi", c_void_p),
        ("div_B", c_void_p),
        ("stride", c_size_t),
        ("status", c_void_p),
    ]


class sph_ohmic(Structure):
    _fields_ = [
        ("medium", sph_medium),
        ("eta", sph_scalars),
        ("field", sph_vectors),
    ]


class sph_ohmic_out(Structure):
    _fields_ = [
        ("rate_B", sph_vector_out),
        ("rate_u", c_void_p),
        ("stride", c_size_t),
        ("status", c_void_p),
    ]


class sph_mhd(Structure):
    _fields_ = [
        ("medium", sph_medium),
        ("p", sph_scalars),
        ("u", sph_scalars),
        ("cs", sph_scalars),
        ("alpha", sph_scalars),
        ("alpha_B", sph_scalars),
        ("v", sph_vectors),
        ("field", sph_vectors),
        ("psi", sph_scalars),
        ("ch", c_double),
        ("sigma", c_double),
        ("beta", c_double),
        ("alpha_u", c_double),
        ("tensile", c_double),
    ]


class sph_mhd_out(Structure):
    _fields_ = [
        ("acceleration", sph_vector_out),
        ("rate_B", sph_vector_out),
        ("rate_u", c_void_p),
        ("rate_psi", c_void_p),
        ("div_B", c_void_p),
        ("div_v", c_void_p),
        ("v_sig", c_void_p),
        ("stride", c_size_t),
        ("status", c_void_p),
    ]


class sph_rk(Structure):
    _fields_ = [
        ("scale", sph_scalars),
        ("slope", sph_vectors),
        ("scale_gradient", sph_vectors),
        ("slope_gradient", sph_matrices),
    ]


class sph_rk_out(Structure):
    _fields_ = [
        ("scale", c_void_p),
        ("conditioning", c_void_p),
        ("stride", c_size_t),
        ("slope", sph_vector_out),
        ("scale_gradient", sph_vector_out),
        ("slope_gradient", sph_matrix_out),
        ("status", c_void_p),
    ]


class sph_corrected_out(Structure):
    _fields_ = [
        ("acceleration", sph_vector_out),
        ("rate_u", c_void_p),
        ("stride", c_size_t),
        ("status", c_void_p),
    ]


class sph_solid(Structure):
    _fields_ = [
        ("inverse", sph_matrices),
        ("stress", sph_matrices),
        ("density", sph_scalars),
        ("hourglass", c_double),
        ("x", sph_points),
        ("gradient", sph_matrices),
        ("modulus", sph_scalars),
    ]


class sph_conserved(Structure):
    _fields_ = [
        ("mass", c_double),
        ("kinetic_energy", c_double),
        ("momentum", sph_vec),
        ("angular_momentum", sph_vec),
    ]


class sph_offender(Structure):
    _fields_ = [
        ("particle", c_int32),
        ("neighbour", c_int32),
        ("ratio", c_double),
    ]


class sph_findings(Structure):
    _fields_ = [
        ("set", c_uint),
        ("at", sph_offender * 12),
        ("sampled", c_int32),
        ("interior", c_int32),
        ("sum_lowest", c_double),
        ("sum_highest", c_double),
    ]


class sph_grid(Structure):
    _fields_ = [
        ("n", c_int32),
        ("dim", c_int),
        ("hashed", c_int),
        ("levels", c_int),
        ("scattered", c_int),
        ("cells", c_int64 * 3),
        ("held", c_int64 * 3),
        ("buckets", c_size_t),
        ("radius", c_double),
        ("largest", c_double),
        ("low", sph_vec),
        ("inverse_width", sph_vec),
        ("box", sph_vec),
        ("first", c_void_p),
        ("member", c_void_p),
        ("x", c_void_p),
        ("y", c_void_p),
        ("z", c_void_p),
        ("own", c_void_p),
        ("node", c_void_p),
    ]


class sph_query(Structure):
    _fields_ = [
        ("targets", sph_points),
        ("criterion", c_int),
        ("radius", sph_scalars),
        ("flags", c_int),
        ("first", c_int32),
    ]


class sph_neighbors(Structure):
    _fields_ = [
        ("pairs", c_int64),
        ("list", sph_list),
        ("grid", sph_grid),
    ]


class sph_part(Structure):
    _fields_ = [
        ("low", sph_vec),
        ("high", sph_vec),
        ("reach_low", sph_vec),
        ("reach_high", sph_vec),
    ]


STRUCTS = [
    sph_vec,
    sph_sym,
    sph_points,
    sph_scalars,
    sph_list,
    sph_vectors,
    sph_vector_out,
    sph_scalar_out,
    sph_matrices,
    sph_matrix_out,
    sph_cloud,
    sph_derivatives_out,
    sph_rows_out,
    sph_correction_out,
    sph_gradient_rows_out,
    sph_density_options,
    sph_density_out,
    sph_jet,
    sph_derivatives_options,
    sph_sources,
    sph_interpolation_options,
    sph_interpolation_out,
    sph_interpolation_rows_out,
    sph_elliptic_options,
    sph_elliptic_report,
    sph_diagonal,
    sph_boundary,
    sph_csr,
    sph_tait,
    sph_fluid,
    sph_fluid_out,
    sph_shear_bulk,
    sph_wall,
    sph_wall_out,
    sph_diffusion,
    sph_surface_out,
    sph_shift,
    sph_transport_out,
    sph_riemann_options,
    sph_tension,
    sph_tension_out,
    sph_wall_elements,
    sph_wall_gamma_out,
    sph_wall_terms,
    sph_collision,
    sph_collision_report,
    sph_medium,
    sph_gas,
    sph_gas_out,
    sph_velocity_gradient_out,
    sph_shock_out,
    sph_cleaning,
    sph_cleaning_out,
    sph_ohmic,
    sph_ohmic_out,
    sph_mhd,
    sph_mhd_out,
    sph_rk,
    sph_rk_out,
    sph_corrected_out,
    sph_solid,
    sph_conserved,
    sph_offender,
    sph_findings,
    sph_grid,
    sph_query,
    sph_neighbors,
    sph_part,
]

# name: (result, arguments). A struct is passed by its address; (type, const) is an array or the address of
# a result, c_void_p any memory.
FUNCTIONS = {
    "kernel_support_ratio": (c_double, [("kernel", c_int)]),
    "kernel_h_over_dx": (c_double, [("kernel", c_int)]),
    "kernel_h_from_support": (c_double, [("kernel", c_int), ("support", c_double)]),
    "kernel_support": (c_double, [("kernel", c_int), ("h", c_double)]),
    "kernel_sigma": (c_double, [("kernel", c_int), ("dim", c_int)]),
    "kernel_shape": (c_double, [("kernel", c_int), ("dim", c_int), ("q", c_double)]),
    "kernel_shape_f": (c_double, [("kernel", c_int), ("dim", c_int), ("q", c_double)]),
    "kernel_shape_d2": (c_double, [("kernel", c_int), ("dim", c_int), ("q", c_double)]),
    "kernel_w": (c_double, [("kernel", c_int), ("dim", c_int), ("r", c_double), ("h", c_double)]),
    "kernel_f": (c_double, [("kernel", c_int), ("dim", c_int), ("r", c_double), ("h", c_double)]),
    "kernel_dwdr": (c_double, [("kernel", c_int), ("dim", c_int), ("r", c_double), ("h", c_double)]),
    "kernel_d2wdr2": (c_double, [("kernel", c_int), ("dim", c_int), ("r", c_double), ("h", c_double)]),
    "kernel_dwdh": (c_double, [("kernel", c_int), ("dim", c_int), ("r", c_double), ("h", c_double)]),
    "kernel_has_cusp": (c_int, [("kernel", c_int)]),
    "kernel_may_convexify": (c_int, [("kernel", c_int), ("dim", c_int)]),
    "cohesion_kernel_akinci": (c_double, [("r", c_double), ("support", c_double)]),
    "adhesion_kernel_akinci": (c_double, [("r", c_double), ("support", c_double)]),
    "kernel_has_gravity": (c_int, [("kernel", c_int)]),
    "gravity_shape_f": (c_double, [("kernel", c_int), ("q", c_double)]),
    "gravity_shape": (c_double, [("kernel", c_int), ("q", c_double)]),
    "gravity_potential": (c_double, [("kernel", c_int), ("r", c_double), ("h", c_double)]),
    "gravity_force": (c_double, [("kernel", c_int), ("r", c_double), ("h", c_double)]),
    "gravity_dphidh": (c_double, [("kernel", c_int), ("r", c_double), ("h", c_double)]),
    "kernel_name": (c_char_p, [("kernel", c_int)]),
    "kernel_from_name": (c_int, [("name", c_char_p)]),
    "status_text": (c_char_p, [("status", c_int)]),
    "shepard_sum": (c_int32, [
        ("kernel", c_int),
        ("dim", c_int),
        ("cloud", sph_cloud),
        ("out", sph_scalar_out),
    ]),
    "interpolate_shepard": (c_int32, [
        ("kernel", c_int),
        ("dim", c_int),
        ("cloud", sph_cloud),
        ("f", sph_scalars),
        ("out", sph_scalar_out),
    ]),
    "density_summation": (c_int32, [
        ("kernel", c_int),
        ("dim", c_int),
        ("cloud", sph_cloud),
        ("m", sph_scalars),
        ("out", sph_scalar_out),
    ]),
    "density_adaptive": (c_int32, [
        ("kernel", c_int),
        ("dim", c_int),
        ("cloud", sph_cloud),
        ("m", sph_scalars),
        ("options", sph_density_options),
        ("out", sph_density_out),
    ]),
    "laplacian_weight_brookshaw": (c_double, [
        ("kernel", c_int),
        ("dim", c_int),
        ("r", c_double),
        ("h", c_double),
        ("V_j", c_double),
    ]),
    "moment_weight_gradient": (c_double, [
        ("kernel", c_int),
        ("dim", c_int),
        ("r", c_double),
        ("h", c_double),
        ("V_j", c_double),
    ]),
    "moment_weight_iad": (c_double, [
        ("kernel", c_int),
        ("dim", c_int),
        ("r", c_double),
        ("h", c_double),
        ("V_j", c_double),
    ]),
    "gradient_difference": (c_int32, [
        ("kernel", c_int),
        ("dim", c_int),
        ("cloud", sph_cloud),
        ("f", sph_scalars),
        ("out", sph_vector_out),
    ]),
    "gradient_cspm": (c_int32, [
        ("kernel", c_int),
        ("dim", c_int),
        ("cloud", sph_cloud),
        ("f", sph_scalars),
        ("out", sph_derivatives_out),
    ]),
    "gradient_iad": (c_int32, [
        ("kernel", c_int),
        ("dim", c_int),
        ("cloud", sph_cloud),
        ("f", sph_scalars),
        ("out", sph_derivatives_out),
    ]),
    "gradient_rows_cspm": (c_int32, [
        ("kernel", c_int),
        ("dim", c_int),
        ("cloud", sph_cloud),
        ("out", sph_gradient_rows_out),
    ]),
    "gradient_rows_iad": (c_int32, [
        ("kernel", c_int),
        ("dim", c_int),
        ("cloud", sph_cloud),
        ("out", sph_gradient_rows_out),
    ]),
    "gradient_correction_cspm": (c_int32, [
        ("kernel", c_int),
        ("dim", c_int),
        ("cloud", sph_cloud),
        ("out", sph_correction_out),
    ]),
    "gradient_correction_iad": (c_int32, [
        ("kernel", c_int),
        ("dim", c_int),
        ("cloud", sph_cloud),
        ("out", sph_correction_out),
    ]),
    "laplacian_brookshaw": (c_int32, [
        ("kernel", c_int),
        ("dim", c_int),
        ("cloud", sph_cloud),
        ("f", sph_scalars),
        ("out", sph_scalar_out),
    ]),
    "laplacian_rows_brookshaw": (c_int32, [
        ("kernel", c_int),
        ("dim", c_int),
        ("cloud", sph_cloud),
        ("out", sph_rows_out),
    ]),
    "derivatives_cspm": (c_int32, [
        ("kernel", c_int),
        ("dim", c_int),
        ("cloud", sph_cloud),
        ("f", sph_scalars),
        ("options", sph_derivatives_options),
        ("out", sph_derivatives_out),
    ]),
    "derivatives_icspm": (c_int32, [
        ("kernel", c_int),
        ("dim", c_int),
        ("cloud", sph_cloud),
        ("f", sph_scalars),
        ("options", sph_derivatives_options),
        ("out", sph_derivatives_out),
    ]),
    "derivatives_fatehi_manzari": (c_int32, [
        ("kernel", c_int),
        ("dim", c_int),
        ("cloud", sph_cloud),
        ("f", sph_scalars),
        ("options", sph_derivatives_options),
        ("out", sph_derivatives_out),
    ]),
    "derivatives_wls": (c_int32, [
        ("kernel", c_int),
        ("dim", c_int),
        ("cloud", sph_cloud),
        ("f", sph_scalars),
        ("options", sph_derivatives_options),
        ("out", sph_derivatives_out),
    ]),
    "derivatives_rows_cspm": (c_int32, [
        ("kernel", c_int),
        ("dim", c_int),
        ("cloud", sph_cloud),
        ("d", sph_jet),
        ("out", sph_rows_out),
    ]),
    "derivatives_rows_icspm": (c_int32, [
        ("kernel", c_int),
        ("dim", c_int),
        ("cloud", sph_cloud),
        ("d", sph_jet),
        ("out", sph_rows_out),
    ]),
    "derivatives_rows_fatehi_manzari": (c_int32, [
        ("kernel", c_int),
        ("dim", c_int),
        ("cloud", sph_cloud),
        ("d", sph_jet),
        ("out", sph_rows_out),
    ]),
    "derivatives_rows_wls": (c_int32, [
        ("kernel", c_int),
        ("dim", c_int),
        ("cloud", sph_cloud),
        ("d", sph_jet),
        ("out", sph_rows_out),
    ]),
    "boundary_weight_bim": (c_double, [
        ("kernel", c_int),
        ("e", c_double),
        ("normal", c_double),
        ("h", c_double),
    ]),
    "second_derivative_bim": (c_int32, [
        ("kernel", c_int),
        ("cloud", sph_cloud),
        ("f", sph_scalars),
        ("left", c_int32),
        ("right", c_int32),
        ("out", sph_scalar_out),
    ]),
    "second_derivative_rows_bim": (c_int32, [
        ("kernel", c_int),
        ("cloud", sph_cloud),
        ("left", c_int32),
        ("right", c_int32),
        ("out", sph_rows_out),
    ]),
    "interpolate_mls": (c_int32, [
        ("kernel", c_int),
        ("dim", c_int),
        ("targets_of", sph_cloud),
        ("sources", sph_sources),
        ("f", sph_scalars),
        ("options", sph_interpolation_options),
        ("out", sph_interpolation_out),
    ]),
    "interpolate_liu": (c_int32, [
        ("kernel", c_int),
        ("dim", c_int),
        ("targets_of", sph_cloud),
        ("sources", sph_sources),
        ("f", sph_scalars),
        ("options", sph_interpolation_options),
        ("out", sph_interpolation_out),
    ]),
    "interpolate_rows_mls": (c_int32, [
        ("kernel", c_int),
        ("dim", c_int),
        ("targets_of", sph_cloud),
        ("sources", sph_sources),
        ("options", sph_interpolation_options),
        ("out", sph_interpolation_rows_out),
    ]),
    "interpolate_rows_liu": (c_int32, [
        ("kernel", c_int),
        ("dim", c_int),
        ("targets_of", sph_cloud),
        ("sources", sph_sources),
        ("options", sph_interpolation_options),
        ("out", sph_interpolation_rows_out),
    ]),
    "mobility_pair": (c_double, [
        ("mean", c_int),
        ("m_i", c_double),
        ("m_j", c_double),
        ("upstream", c_double),
    ]),
    "elliptic_brookshaw": (c_int32, [
        ("kernel", c_int),
        ("dim", c_int),
        ("cloud", sph_cloud),
        ("m", sph_scalars),
        ("options", sph_elliptic_options),
        ("u", sph_scalars),
        ("out", sph_scalar_out),
    ]),
    "elliptic_brookshaw_corrected": (c_int32, [
        ("kernel", c_int),
        ("dim", c_int),
        ("cloud", sph_cloud),
        ("m", sph_scalars),
        ("options", sph_elliptic_options),
        ("u", sph_scalars),
        ("out", sph_scalar_out),
    ]),
    "elliptic_schwaiger": (c_int32, [
        ("kernel", c_int),
        ("dim", c_int),
        ("cloud", sph_cloud),
        ("m", sph_scalars),
        ("options", sph_elliptic_options),
        ("u", sph_scalars),
        ("out", sph_scalar_out),
    ]),
    "elliptic_msph": (c_int32, [
        ("kernel", c_int),
        ("dim", c_int),
        ("cloud", sph_cloud),
        ("m", sph_scalars),
        ("options", sph_elliptic_options),
        ("u", sph_scalars),
        ("out", sph_scalar_out),
    ]),
    "elliptic_basic_degiuli_ban": (c_int32, [
        ("kernel", c_int),
        ("dim", c_int),
        ("cloud", sph_cloud),
        ("m", sph_scalars),
        ("options", sph_elliptic_options),
        ("u", sph_scalars),
        ("out", sph_scalar_out),
    ]),
    "elliptic_rows_brookshaw": (c_int32, [
        ("kernel", c_int),
        ("dim", c_int),
        ("cloud", sph_cloud),
        ("m", sph_scalars),
        ("options", sph_elliptic_options),
        ("out", sph_rows_out),
    ]),
    "elliptic_rows_brookshaw_corrected": (c_int32, [
        ("kernel", c_int),
        ("dim", c_int),
        ("cloud", sph_cloud),
        ("m", sph_scalars),
        ("options", sph_elliptic_options),
        ("out", sph_rows_out),
    ]),
    "elliptic_rows_schwaiger": (c_int32, [
        ("kernel", c_int),
        ("dim", c_int),
        ("cloud", sph_cloud),
        ("m", sph_scalars),
        ("options", sph_elliptic_options),
        ("out", sph_rows_out),
    ]),
    "elliptic_rows_msph": (c_int32, [
        ("kernel", c_int),
        ("dim", c_int),
        ("cloud", sph_cloud),
        ("m", sph_scalars),
        ("options", sph_elliptic_options),
        ("out", sph_rows_out),
    ]),
    "elliptic_rows_basic_degiuli_ban": (c_int32, [
        ("kernel", c_int),
        ("dim", c_int),
        ("cloud", sph_cloud),
        ("m", sph_scalars),
        ("options", sph_elliptic_options),
        ("out", sph_rows_out),
    ]),
    "elliptic_diagnose": (c_int32, [
        ("kernel", c_int),
        ("dim", c_int),
        ("cloud", sph_cloud),
        ("options", sph_elliptic_options),
        ("out", sph_elliptic_report),
    ]),
    "elliptic_rows_anisotropic": (c_int32, [
        ("kernel", c_int),
        ("dim", c_int),
        ("cloud", sph_cloud),
        ("mobility", sph_diagonal),
        ("out", sph_rows_out),
    ]),
    "elliptic_tensor": (c_int32, [
        ("kernel", c_int),
        ("dim", c_int),
        ("cloud", sph_cloud),
        ("mobility", sph_matrices),
        ("u", sph_scalars),
        ("out", sph_scalar_out),
    ]),
    "elliptic_rows_tensor": (c_int32, [
        ("kernel", c_int),
        ("dim", c_int),
        ("cloud", sph_cloud),
        ("mobility", sph_matrices),
        ("out", sph_rows_out),
    ]),
    "elliptic_rows_boundary": (c_int32, [
        ("kernel", c_int),
        ("dim", c_int),
        ("cloud", sph_cloud),
        ("m", sph_scalars),
        ("options", sph_elliptic_options),
        ("boundary", sph_boundary),
        ("out", sph_rows_out),
    ]),
    "rows_apply": (c_int32, [
        ("cloud", sph_cloud),
        ("row", (c_double, True)),
        ("diagonal", sph_scalars),
        ("u", sph_scalars),
        ("out", sph_scalar_out),
    ]),
    "rows_monotone": (c_int32, [
        ("cloud", sph_cloud),
        ("row", (c_double, True)),
        ("diagonal", sph_scalars),
        ("monotone", (c_ubyte, False)),
    ]),
    "rows_time_step": (c_int32, [("cloud", sph_cloud), ("row", (c_double, True)), ("dt", (c_double, False))]),
    "rows_growth": (c_int32, [
        ("dim", c_int),
        ("cloud", sph_cloud),
        ("row", (c_double, True)),
        ("tau", c_double),
        ("wave", sph_vec),
        ("re", (c_double, False)),
        ("im", (c_double, False)),
    ]),
    "csr_size": (c_int64, [("cloud", sph_cloud)]),
    "csr_assemble": (c_int32, [
        ("cloud", sph_cloud),
        ("row", (c_double, True)),
        ("diagonal", sph_scalars),
        ("drop_zeros", c_int),
        ("out", sph_csr),
        ("entries", (c_int64, False)),
    ]),
    "signal_speed": (c_double, [("c_i", c_double), ("c_j", c_double), ("beta_w", c_double)]),
    "viscosity_signal": (c_double, [("alpha_speed", c_double), ("w", c_double), ("per_rho", c_double)]),
    "kernel_f_apart": (c_double, [("kernel", c_int), ("dim", c_int), ("r", c_double), ("h", c_double)]),
    "time_step_sound": (c_double, [("h", c_double), ("c", c_double), ("speed", c_double)]),
    "time_step_force": (c_double, [("h", c_double), ("acceleration", c_double)]),
    "time_step_viscous_nu": (c_double, [("h", c_double), ("nu", c_double)]),
    "density_number": (c_int32, [
        ("kernel", c_int),
        ("dim", c_int),
        ("cloud", sph_cloud),
        ("m", sph_scalars),
        ("out", sph_scalar_out),
    ]),
    "fluid_rates_monaghan": (c_int32, [
        ("kernel", c_int),
        ("dim", c_int),
        ("cloud", sph_cloud),
        ("fluid", sph_fluid),
        ("out", sph_fluid_out),
    ]),
    "fluid_rates_colagrossi": (c_int32, [
        ("kernel", c_int),
        ("dim", c_int),
        ("cloud", sph_cloud),
        ("fluid", sph_fluid),
        ("out", sph_fluid_out),
    ]),
    "fluid_rates_hu_adams": (c_int32, [
        ("kernel", c_int),
        ("dim", c_int),
        ("cloud", sph_cloud),
        ("fluid", sph_fluid),
        ("out", sph_fluid_out),
    ]),
    "viscosity_mu_morris": (c_int32, [
        ("kernel", c_int),
        ("dim", c_int),
        ("cloud", sph_cloud),
        ("fluid", sph_fluid),
        ("mu", sph_scalars),
        ("acceleration", sph_vector_out),
    ]),
    "viscosity_mu_monaghan_cleary": (c_int32, [
        ("kernel", c_int),
        ("dim", c_int),
        ("cloud", sph_cloud),
        ("fluid", sph_fluid),
        ("mu", sph_scalars),
        ("acceleration", sph_vector_out),
    ]),
    "viscosity_mu_espanol_revenga": (c_int32, [
        ("kernel", c_int),
        ("dim", c_int),
        ("cloud", sph_cloud),
        ("fluid", sph_fluid),
        ("mu", sph_shear_bulk),
        ("acceleration", sph_vector_out),
    ]),
    "velocity_xsph": (c_int32, [
        ("kernel", c_int),
        ("dim", c_int),
        ("cloud", sph_cloud),
        ("fluid", sph_fluid),
        ("epsilon", c_double),
        ("change", sph_vector_out),
    ]),
    "wall_adami": (c_int32, [
        ("kernel", c_int),
        ("dim", c_int),
        ("cloud", sph_cloud),
        ("wall", sph_wall),
        ("out", sph_wall_out),
    ]),
    "wall_rows_adami": (c_int32, [
        ("kernel", c_int),
        ("dim", c_int),
        ("cloud", sph_cloud),
        ("wall", sph_wall),
        ("out", sph_rows_out),
        ("source", sph_scalar_out),
    ]),
    "wall_rows_eliminate": (c_int32, [
        ("dim", c_int),
        ("cloud", sph_cloud),
        ("wall", sph_wall),
        ("rows", sph_rows_out),
        ("source", sph_scalar_out),
    ]),
    "density_diffusion_weight": (c_double, [("V_j", c_double), ("strength", c_double), ("f_ij", c_double)]),
    "time_step_density_diffusion": (c_double, [
        ("kernel", c_int),
        ("dim", c_int),
        ("h", c_double),
        ("delta", c_double),
        ("c", c_double),
    ]),
    "density_diffusion_molteni": (c_int32, [
        ("kernel", c_int),
        ("dim", c_int),
        ("cloud", sph_cloud),
        ("diffusion", sph_diffusion),
        ("out", sph_scalar_out),
    ]),
    "density_diffusion_antuono": (c_int32, [
        ("kernel", c_int),
        ("dim", c_int),
        ("cloud", sph_cloud),
        ("diffusion", sph_diffusion),
        ("out", sph_scalar_out),
    ]),
    "density_diffusion_fourtakas": (c_int32, [
        ("kernel", c_int),
        ("dim", c_int),
        ("cloud", sph_cloud),
        ("diffusion", sph_diffusion),
        ("out", sph_scalar_out),
    ]),
    "density_diffusion_rows_molteni": (c_int32, [
        ("kernel", c_int),
        ("dim", c_int),
        ("cloud", sph_cloud),
        ("diffusion", sph_diffusion),
        ("out", sph_rows_out),
    ]),
    "free_surface": (c_int32, [
        ("kernel", c_int),
        ("dim", c_int),
        ("cloud", sph_cloud),
        ("out", sph_surface_out),
    ]),
    "free_surface_cone": (c_int32, [
        ("dim", c_int),
        ("cloud", sph_cloud),
        ("eigenvalue", sph_scalars),
        ("normal", sph_vectors),
        ("flag", (c_ubyte, False)),
    ]),
    "shift_strength_skillen": (c_double, [("factor", c_double), ("h", c_double), ("path", c_double)]),
    "shift_strength_sun": (c_double, [("h", c_double), ("path", c_double), ("length", c_double)]),
    "shift_displacement": (c_int32, [
        ("kernel", c_int),
        ("dim", c_int),
        ("cloud", sph_cloud),
        ("shift", sph_shift),
        ("out", sph_vector_out),
    ]),
    "shift_rates": (c_int32, [
        ("kernel", c_int),
        ("dim", c_int),
        ("cloud", sph_cloud),
        ("fluid", sph_fluid),
        ("shift", sph_vectors),
        ("out", sph_fluid_out),
    ]),
    "transport_adami": (c_int32, [
        ("kernel", c_int),
        ("dim", c_int),
        ("cloud", sph_cloud),
        ("fluid", sph_fluid),
        ("transport", sph_vectors),
        ("background", c_double),
        ("out", sph_transport_out),
    ]),
    "pressure_factor_dfsph": (c_int32, [
        ("kernel", c_int),
        ("dim", c_int),
        ("cloud", sph_cloud),
        ("fluid", sph_fluid),
        ("moves", sph_scalars),
        ("out", sph_scalar_out),
    ]),
    "fluid_rates_riemann": (c_int32, [
        ("kernel", c_int),
        ("dim", c_int),
        ("cloud", sph_cloud),
        ("fluid", sph_fluid),
        ("options", sph_riemann_options),
        ("out", sph_fluid_out),
    ]),
    "tension_css": (c_int32, [
        ("kernel", c_int),
        ("dim", c_int),
        ("cloud", sph_cloud),
        ("tension", sph_tension),
        ("acceleration", sph_vector_out),
    ]),
    "tension_csf": (c_int32, [
        ("kernel", c_int),
        ("dim", c_int),
        ("cloud", sph_cloud),
        ("tension", sph_tension),
        ("out", sph_tension_out),
    ]),
    "wall_gamma": (c_int32, [
        ("kernel", c_int),
        ("dim", c_int),
        ("cloud", sph_cloud),
        ("elements", sph_wall_elements),
        ("out", sph_wall_gamma_out),
    ]),
    "wall_gradient": (c_int32, [
        ("kernel", c_int),
        ("dim", c_int),
        ("cloud", sph_cloud),
        ("wall", sph_wall_terms),
        ("f", sph_scalars),
        ("out", sph_vector_out),
    ]),
    "wall_gradient_rows": (c_int32, [
        ("kernel", c_int),
        ("dim", c_int),
        ("cloud", sph_cloud),
        ("wall", sph_wall_terms),
        ("out", sph_gradient_rows_out),
        ("source", sph_vector_out),
    ]),
    "wall_laplacian": (c_int32, [
        ("kernel", c_int),
        ("dim", c_int),
        ("cloud", sph_cloud),
        ("wall", sph_wall_terms),
        ("f", sph_scalars),
        ("out", sph_scalar_out),
    ]),
    "wall_laplacian_rows": (c_int32, [
        ("kernel", c_int),
        ("dim", c_int),
        ("cloud", sph_cloud),
        ("wall", sph_wall_terms),
        ("out", sph_rows_out),
        ("source", sph_scalar_out),
    ]),
    "collision_sequential": (c_int32, [
        ("dim", c_int),
        ("cloud", sph_cloud),
        ("collision", sph_collision),
        ("velocity", sph_vector_out),
        ("out", sph_collision_report),
    ]),
    "collision_count": (c_int32, [
        ("dim", c_int),
        ("cloud", sph_cloud),
        ("collision", sph_collision),
        ("v", sph_vectors),
        ("count", (c_int32, False)),
    ]),
    "collision_change_weighted": (c_int32, [
        ("dim", c_int),
        ("cloud", sph_cloud),
        ("collision", sph_collision),
        ("v", sph_vectors),
        ("count", (c_int32, True)),
        ("change", sph_vector_out),
    ]),
    "conductivity_speed": (c_double, [("P_i", c_double), ("P_j", c_double), ("per_rho", c_double)]),
    "shock_pair": (c_double, [("m_j", c_double), ("div_j", c_double), ("w_ij", c_double)]),
    "shock_value": (c_double, [("sum", c_double), ("rho", c_double)]),
    "gas_rates": (c_int32, [
        ("kernel", c_int),
        ("dim", c_int),
        ("cloud", sph_cloud),
        ("state", sph_gas),
        ("out", sph_gas_out),
    ]),
    "velocity_gradient_difference": (c_int32, [
        ("kernel", c_int),
        ("dim", c_int),
        ("cloud", sph_cloud),
        ("medium", sph_medium),
        ("v", sph_vectors),
        ("out", sph_velocity_gradient_out),
    ]),
    "velocity_gradient_cspm": (c_int32, [
        ("kernel", c_int),
        ("dim", c_int),
        ("cloud", sph_cloud),
        ("v", sph_vectors),
        ("out", sph_velocity_gradient_out),
    ]),
    "shock_indicator": (c_int32, [
        ("kernel", c_int),
        ("dim", c_int),
        ("cloud", sph_cloud),
        ("state", sph_gas),
        ("div_v", sph_scalars),
        ("out", sph_shock_out),
    ]),
    "cleaning_sigma": (c_double, [("dim", c_int)]),
    "resistivity_switch": (c_double, [("h", c_double), ("change", c_double), ("strength", c_double)]),
    "resistivity_pair": (c_double, [("weight", c_double), ("alpha_speed", c_double), ("per_rho", c_double)]),
    "time_step_resistivity": (c_double, [("h", c_double), ("eta", c_double)]),
    "divergence_difference": (c_int32, [
        ("kernel", c_int),
        ("dim", c_int),
        ("cloud", sph_cloud),
        ("medium", sph_medium),
        ("field", sph_vectors),
        ("out", sph_scalar_out),
    ]),
    "divergence_symmetric": (c_int32, [
        ("kernel", c_int),
        ("dim", c_int),
        ("cloud", sph_cloud),
        ("medium", sph_medium),
        ("field", sph_vectors),
        ("out", sph_scalar_out),
    ]),
    "gradient_symmetric": (c_int32, [
        ("kernel", c_int),
        ("dim", c_int),
        ("cloud", sph_cloud),
        ("medium", sph_medium),
        ("f", sph_scalars),
        ("out", sph_vector_out),
    ]),
    "curl_difference": (c_int32, [
        ("kernel", c_int),
        ("dim", c_int),
        ("cloud", sph_cloud),
        ("medium", sph_medium),
        ("field", sph_vectors),
        ("out", sph_vector_out),
    ]),
    "cleaning_rates": (c_int32, [
        ("kernel", c_int),
        ("dim", c_int),
        ("cloud", sph_cloud),
        ("state", sph_cleaning),
        ("out", sph_cleaning_out),
    ]),
    "resistivity_ohmic": (c_int32, [
        ("kernel", c_int),
        ("dim", c_int),
        ("cloud", sph_cloud),
        ("state", sph_ohmic),
        ("out", sph_ohmic_out),
    ]),
    "mhd_rates": (c_int32, [
        ("kernel", c_int),
        ("dim", c_int),
        ("cloud", sph_cloud),
        ("state", sph_mhd),
        ("out", sph_mhd_out),
    ]),
    "rk_correction": (c_int32, [
        ("kernel", c_int),
        ("dim", c_int),
        ("cloud", sph_cloud),
        ("out", sph_rk_out),
    ]),
    "interpolate_rk": (c_int32, [
        ("kernel", c_int),
        ("dim", c_int),
        ("cloud", sph_cloud),
        ("rk", sph_rk),
        ("f", sph_scalars),
        ("out", sph_scalar_out),
    ]),
    "interpolate_rows_rk": (c_int32, [
        ("kernel", c_int),
        ("dim", c_int),
        ("cloud", sph_cloud),
        ("rk", sph_rk),
        ("out", sph_rows_out),
    ]),
    "gradient_rk": (c_int32, [
        ("kernel", c_int),
        ("dim", c_int),
        ("cloud", sph_cloud),
        ("rk", sph_rk),
        ("f", sph_scalars),
        ("out", sph_vector_out),
    ]),
    "gradient_rows_rk": (c_int32, [
        ("kernel", c_int),
        ("dim", c_int),
        ("cloud", sph_cloud),
        ("rk", sph_rk),
        ("out", sph_gradient_rows_out),
    ]),
    "gas_rates_crk": (c_int32, [
        ("kernel", c_int),
        ("dim", c_int),
        ("cloud", sph_cloud),
        ("fluid", sph_fluid),
        ("rk", sph_rk),
        ("out", sph_corrected_out),
    ]),
    "gas_rates_iad": (c_int32, [
        ("kernel", c_int),
        ("dim", c_int),
        ("cloud", sph_cloud),
        ("fluid", sph_fluid),
        ("inverse", sph_matrices),
        ("out", sph_corrected_out),
    ]),
    "gravity_pair": (c_double, [("kernel", c_int), ("r", c_double), ("h_i", c_double), ("h_j", c_double)]),
    "gravity_zeta_value": (c_double, [("h", c_double), ("rho", c_double), ("sum", c_double)]),
    "gravity_direct": (c_int32, [
        ("kernel", c_int),
        ("cloud", sph_cloud),
        ("m", sph_scalars),
        ("newton", c_double),
        ("acceleration", sph_vector_out),
        ("potential", sph_scalar_out),
    ]),
    "gravity_zeta": (c_int32, [
        ("kernel", c_int),
        ("cloud", sph_cloud),
        ("m", sph_scalars),
        ("rho", sph_scalars),
        ("out", sph_scalar_out),
    ]),
    "gravity_correction": (c_int32, [
        ("kernel", c_int),
        ("cloud", sph_cloud),
        ("medium", sph_medium),
        ("zeta", sph_scalars),
        ("newton", c_double),
        ("acceleration", sph_vector_out),
    ]),
    "deformation_gradient": (c_int32, [
        ("kernel", c_int),
        ("dim", c_int),
        ("cloud", sph_cloud),
        ("x", sph_points),
        ("inverse", sph_matrices),
        ("out", sph_matrix_out),
    ]),
    "solid_acceleration": (c_int32, [
        ("kernel", c_int),
        ("dim", c_int),
        ("cloud", sph_cloud),
        ("solid", sph_solid),
        ("acceleration", sph_vector_out),
    ]),
    "nearest_distance": (c_int32, [
        ("dim", c_int),
        ("targets_of", sph_cloud),
        ("sources", sph_points),
        ("out", sph_scalar_out),
    ]),
    "hexatic_order": (c_int32, [("cloud", sph_cloud), ("out", sph_scalar_out)]),
    "radial_distribution": (c_int32, [
        ("dim", c_int),
        ("cloud", sph_cloud),
        ("farthest", c_double),
        ("number_density", c_double),
        ("bins", c_int),
        ("g", (c_double, False)),
    ]),
    "coincident_count": (c_int32, [("dim", c_int), ("cloud", sph_cloud), ("distance", c_double)]),
    "coincident_separate": (c_int32, [
        ("dim", c_int),
        ("cloud", sph_cloud),
        ("within", c_double),
        ("distance", c_double),
        ("position", sph_vector_out),
    ]),
    "conserved_sums": (c_int32, [
        ("dim", c_int),
        ("cloud", sph_cloud),
        ("m", sph_scalars),
        ("v", sph_vectors),
        ("out", sph_conserved),
    ]),
    "cloud_examine": (c_int32, [
        ("kernel", c_int),
        ("dim", c_int),
        ("cloud", sph_cloud),
        ("both_sides", c_int),
        ("samples", c_int32),
        ("out", sph_findings),
    ]),
    "finding_text": (c_char_p, [("finding", c_int)]),
    "grid_pair_radius": (c_double, [("criterion", c_int), ("R_i", c_double), ("R_j", c_double)]),
    "grid_wrap": (c_double, [("x", c_double), ("low", c_double), ("length", c_double)]),
    "grid_workspace": (c_size_t, [("dim", c_int), ("n", c_int32)]),
    "grid_build": (c_int32, [
        ("dim", c_int),
        ("sources", sph_points),
        ("radius", sph_scalars),
        ("work", c_void_p),
        ("work_size", c_size_t),
        ("grid", sph_grid),
    ]),
    "grid_permutation": (c_void_p, [("grid", sph_grid)]),
    "grid_permutation_own": (c_int32, [
        ("grid", sph_grid),
        ("n", c_int32),
        ("permutation", (c_int32, False)),
    ]),
    "grid_renumber_own": (c_int32, [("grid", sph_grid), ("n", c_int32)]),
    "grid_renumber": (c_int32, [("grid", sph_grid)]),
    "grid_lists": (c_int32, [
        ("dim", c_int),
        ("grid", sph_grid),
        ("query", sph_query),
        ("start", (c_int32, False)),
        ("index", (c_int32, False)),
        ("capacity", c_int64),
        ("pairs", (c_int64, False)),
    ]),
    "grid_count": (c_int32, [
        ("dim", c_int),
        ("grid", sph_grid),
        ("query", sph_query),
        ("start", (c_int32, False)),
        ("pairs", (c_int64, False)),
    ]),
    "search_size": (c_size_t, [("dim", c_int), ("n", c_int32), ("pairs", c_int64)]),
    "search": (c_int32, [
        ("dim", c_int),
        ("points", sph_points),
        ("radius", sph_scalars),
        ("criterion", c_int),
        ("memory", c_void_p),
        ("size", c_size_t),
        ("found", sph_neighbors),
    ]),
    "part_of": (c_int32, [
        ("dim", c_int),
        ("points", sph_points),
        ("radius", sph_scalars),
        ("part", sph_part),
    ]),
    "select_near": (c_int32, [
        ("dim", c_int),
        ("points", sph_points),
        ("radius", sph_scalars),
        ("criterion", c_int),
        ("part", sph_part),
        ("chosen", (c_int32, False)),
        ("count", (c_int64, False)),
    ]),
    "list_prune": (c_int32, [
        ("n", c_int32),
        ("n_total", c_int32),
        ("start", (c_int32, True)),
        ("index", (c_int32, False)),
        ("kept", (c_int32, False)),
        ("count", (c_int64, False)),
    ]),
    "list_sort": (c_int32, [
        ("n", c_int32),
        ("n_total", c_int32),
        ("start", (c_int32, True)),
        ("index", (c_int32, False)),
        ("key", (c_int64, True)),
    ]),
    "permute": (c_int32, [
        ("n", c_int32),
        ("permutation", (c_int32, True)),
        ("in", (c_double, True)),
        ("stride", c_size_t),
        ("out", (c_double, False)),
    ]),
    "permute_inverse": (c_int32, [
        ("n", c_int32),
        ("permutation", (c_int32, True)),
        ("inverse", (c_int32, False)),
    ]),
    "rebuild_due": (c_int, [("dim", c_int), ("now", sph_points), ("then", sph_points), ("skin", c_double)]),
}

__all__ = [
    "CUBIC_SPLINE",
    "QUARTIC_SPLINE",
    "QUINTIC_SPLINE",
    "WENDLAND_C2",
    "WENDLAND_C4",
    "WENDLAND_C6",
    "WENDLAND_C2_1D",
    "WENDLAND_C4_1D",
    "WENDLAND_C6_1D",
    "GAUSSIAN",
    "SUPER_GAUSSIAN",
    "LIU_QUARTIC",
    "HERMITE",
    "SCHUESSLER_SCHMITT",
    "JOHNSON_BEISSEL",
    "CONVEX",
    "CONVEX_CUBIC_SPLINE",
    "CONVEX_WENDLAND_C2",
    "CONVEX_WENDLAND_C4",
    "CORE_TRIANGLE",
    "SEXTIC_SPLINE",
    "HEPTIC_SPLINE",
    "POLY6",
    "SPIKY",
    "KERNEL_COUNT",
    "LUCY",
    "ERROR_NULL",
    "ERROR_DIM",
    "ERROR_KERNEL",
    "ERROR_COUNT",
    "ERROR_RANGE",
    "ERROR_H",
    "ERROR_POSITION",
    "ERROR_VALUE",
    "ERROR_LIST",
    "ERROR_SELF",
    "ERROR_CAPACITY",
    "ERROR_BOX",
    "ERROR_PAIRS",
    "OK",
    "TOO_FEW",
    "SINGULAR",
    "ILL_CONDITIONED",
    "FELL_BACK",
    "NOT_AVAILABLE",
    "NOT_FINITE",
    "LIST_TOO_SHORT",
    "GRADIENT_DIFFUSE",
    "GRADIENT_FULL",
    "GRADIENT_SHEPARD_DIFFUSE",
    "GRADIENT_SHEPARD_FULL",
    "MOBILITY_ARITHMETIC",
    "MOBILITY_HARMONIC",
    "MOBILITY_UPWIND",
    "VISCOSITY_NONE",
    "VISCOSITY_MONAGHAN",
    "VISCOSITY_LINEAR",
    "VISCOSITY_SIGNAL",
    "SURFACE_INSIDE",
    "SURFACE_BAND",
    "SURFACE_SPLASH",
    "CONDUCTIVITY_NONE",
    "CONDUCTIVITY_PRICE",
    "CONDUCTIVITY_WADSLEY",
    "FINDING_LIST_SHORT",
    "FINDING_LIST_SUPPORT",
    "FINDING_LIST_HALF",
    "FINDING_LIST_ONE_SIDED",
    "FINDING_LIST_STALE",
    "FINDING_LIST_FROM_ONE",
    "FINDING_BOX",
    "FINDING_VOLUME_ZERO",
    "FINDING_VOLUME_SUM",
    "FINDING_DIM_HIGH",
    "FINDING_DIM_LOW",
    "FINDING_STRIDE",
    "FINDING_COUNT",
    "GATHER",
    "SCATTER",
    "LARGER",
    "MEAN",
    "LIST_SELF",
    "LIST_HALF",
    "LIST_SORTED",
    "LIST_FOREIGN",
]
