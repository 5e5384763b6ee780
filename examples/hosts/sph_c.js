// SPDX-License-Identifier: MIT
//
// sph_c.js - structs and constants of the headers, for hosts that put structs into the memory of a
// WebAssembly module (host.js). Written by examples/hosts/generate.py from the headers: run it again instead
// of changing this file.
//
// structs: the fields of each struct in their order, as [name, type, how many]; a type is that of C,
// 'pointer', or the name of another struct.

exports.structs = {
    sph_vec: [
        ["x", "sph_real", 1], ["y", "sph_real", 1], ["z", "sph_real", 1],
    ],
    sph_sym: [
        ["xx", "sph_real", 1], ["xy", "sph_real", 1], ["yy", "sph_real", 1], ["xz", "sph_real", 1],
        ["yz", "sph_real", 1], ["zz", "sph_real", 1],
    ],
    sph_points: [
        ["x", "pointer", 1], ["y", "pointer", 1], ["z", "pointer", 1], ["stride", "size_t", 1],
        ["n", "sph_index", 1], ["box", "sph_vec", 1],
    ],
    sph_scalars: [
        ["p", "pointer", 1], ["stride", "size_t", 1],
    ],
    sph_list: [
        ["start", "pointer", 1], ["index", "pointer", 1],
    ],
    sph_vectors: [
        ["x", "sph_scalars", 1], ["y", "sph_scalars", 1], ["z", "sph_scalars", 1],
    ],
    sph_vector_out: [
        ["x", "pointer", 1], ["y", "pointer", 1], ["z", "pointer", 1], ["stride", "size_t", 1],
    ],
    sph_scalar_out: [
        ["p", "pointer", 1], ["stride", "size_t", 1], ["status", "pointer", 1],
    ],
    sph_matrices: [
        ["x", "sph_vectors", 1], ["y", "sph_vectors", 1], ["z", "sph_vectors", 1],
    ],
    sph_matrix_out: [
        ["x", "sph_vector_out", 1], ["y", "sph_vector_out", 1], ["z", "sph_vector_out", 1],
    ],
    sph_cloud: [
        ["points", "sph_points", 1], ["list", "sph_list", 1], ["h", "sph_scalars", 1],
        ["volume", "sph_scalars", 1], ["first", "sph_index", 1], ["last", "sph_index", 1],
        ["checked", "int", 1], ["largest_h", "sph_real", 1],
    ],
    sph_derivatives_out: [
        ["gx", "pointer", 1], ["gy", "pointer", 1], ["gz", "pointer", 1], ["hxx", "pointer", 1],
        ["hxy", "pointer", 1], ["hyy", "pointer", 1], ["hxz", "pointer", 1], ["hyz", "pointer", 1],
        ["hzz", "pointer", 1], ["laplacian", "pointer", 1], ["conditioning", "pointer", 1],
        ["stride", "size_t", 1], ["status", "pointer", 1],
    ],
    sph_rows_out: [
        ["row", "pointer", 1], ["diagonal", "pointer", 1], ["factor", "pointer", 1],
        ["conditioning", "pointer", 1], ["stride", "size_t", 1], ["status", "pointer", 1],
    ],
    sph_correction_out: [
        ["inverse", "sph_matrix_out", 1], ["conditioning", "pointer", 1], ["stride", "size_t", 1],
        ["status", "pointer", 1],
    ],
    sph_gradient_rows_out: [
        ["x", "pointer", 1], ["y", "pointer", 1], ["z", "pointer", 1], ["conditioning", "pointer", 1],
        ["stride", "size_t", 1], ["status", "pointer", 1],
    ],
    sph_density_options: [
        ["list_radius", "sph_scalars", 1], ["eta", "sph_real", 1], ["tolerance", "sph_real", 1],
    ],
    sph_density_out: [
        ["h", "pointer", 1], ["rho", "pointer", 1], ["omega", "pointer", 1], ["stride", "size_t", 1],
        ["status", "pointer", 1],
    ],
    sph_jet: [
        ["gradient", "sph_vec", 1], ["hessian", "sph_sym", 1],
    ],
    sph_derivatives_options: [
        ["conditioning_min", "sph_real", 1], ["fallback_wls", "int", 1],
    ],
    sph_sources: [
        ["points", "sph_points", 1], ["volume", "sph_scalars", 1],
    ],
    sph_interpolation_options: [
        ["conditioning_min", "sph_real", 1],
    ],
    sph_interpolation_out: [
        ["value", "pointer", 1], ["gx", "pointer", 1], ["gy", "pointer", 1], ["gz", "pointer", 1],
        ["conditioning", "pointer", 1], ["stride", "size_t", 1], ["status", "pointer", 1],
    ],
    sph_interpolation_rows_out: [
        ["value", "pointer", 1], ["x", "pointer", 1], ["y", "pointer", 1], ["z", "pointer", 1],
        ["conditioning", "pointer", 1], ["stride", "size_t", 1], ["status", "pointer", 1],
    ],
    sph_elliptic_options: [
        ["gradient", "int", 1], ["mean", "int", 1], ["gamma_star", "int", 1], ["trace", "int", 1],
        ["conditioning_min", "sph_real", 1], ["potential", "sph_scalars", 1], ["source", "sph_scalars", 1],
    ],
    sph_elliptic_report: [
        ["sign_least", "pointer", 1], ["sign_most", "pointer", 1], ["xi", "pointer", 1],
        ["continuity", "pointer", 1], ["n", "pointer", 1], ["n_bound", "pointer", 1],
        ["eigenvalue_least", "pointer", 1], ["eigenvalue_ratio", "pointer", 1], ["stride", "size_t", 1],
        ["status", "pointer", 1],
    ],
    sph_diagonal: [
        ["x", "sph_scalars", 1], ["y", "sph_scalars", 1], ["z", "sph_scalars", 1],
    ],
    sph_boundary: [
        ["normal", "sph_vectors", 1], ["alpha", "sph_scalars", 1], ["beta", "sph_scalars", 1],
    ],
    sph_csr: [
        ["start", "pointer", 1], ["column", "pointer", 1], ["value", "pointer", 1],
        ["capacity", "int64_t", 1],
    ],
    sph_tait: [
        ["rho0", "sph_real", 1], ["c", "sph_real", 1], ["gamma", "sph_real", 1], ["p0", "sph_real", 1],
    ],
    sph_fluid: [
        ["m", "sph_scalars", 1], ["rho", "sph_scalars", 1], ["p", "sph_scalars", 1], ["c", "sph_scalars", 1],
        ["v", "sph_vectors", 1], ["viscosity", "int", 1], ["alpha", "sph_real", 1], ["beta", "sph_real", 1],
        ["eta", "sph_real", 1],
    ],
    sph_fluid_out: [
        ["acceleration", "sph_vector_out", 1], ["rate", "pointer", 1], ["heating", "pointer", 1],
        ["stride", "size_t", 1], ["status", "pointer", 1],
    ],
    sph_shear_bulk: [
        ["shear", "sph_scalars", 1], ["bulk", "sph_scalars", 1],
    ],
    sph_wall: [
        ["share", "sph_scalars", 1], ["rho", "sph_scalars", 1], ["p", "sph_scalars", 1],
        ["v", "sph_vectors", 1], ["velocity", "sph_vectors", 1], ["normal", "sph_vectors", 1],
        ["gravity", "sph_vec", 1],
    ],
    sph_wall_out: [
        ["p", "pointer", 1], ["v", "sph_vector_out", 1], ["stride", "size_t", 1], ["status", "pointer", 1],
    ],
    sph_diffusion: [
        ["fluid", "sph_fluid", 1], ["delta", "sph_real", 1], ["tait", "sph_tait", 1],
        ["share", "sph_scalars", 1], ["gradient", "sph_vectors", 1], ["gravity", "sph_vec", 1],
    ],
    sph_surface_out: [
        ["divergence", "pointer", 1], ["eigenvalue", "pointer", 1], ["normal", "sph_vector_out", 1],
        ["stride", "size_t", 1], ["status", "pointer", 1],
    ],
    sph_shift: [
        ["strength", "sph_scalars", 1], ["tensile", "sph_real", 1], ["spacing", "sph_real", 1],
        ["eigenvalue", "sph_scalars", 1], ["normal", "sph_vectors", 1], ["longest", "sph_real", 1],
    ],
    sph_transport_out: [
        ["background", "sph_vector_out", 1], ["stress", "sph_vector_out", 1], ["status", "pointer", 1],
    ],
    sph_riemann_options: [
        ["limiter", "sph_real", 1], ["gravity", "sph_vec", 1],
    ],
    sph_tension: [
        ["rho", "sph_scalars", 1], ["normal", "sph_vectors", 1], ["sigma", "sph_real", 1],
        ["least", "sph_real", 1],
    ],
    sph_tension_out: [
        ["acceleration", "sph_vector_out", 1], ["curvature", "pointer", 1], ["stride", "size_t", 1],
        ["status", "pointer", 1],
    ],
    sph_wall_elements: [
        ["n", "sph_index", 1], ["a", "sph_vectors", 1], ["b", "sph_vectors", 1], ["c", "sph_vectors", 1],
        ["list", "sph_list", 1],
    ],
    sph_wall_gamma_out: [
        ["gamma", "pointer", 1], ["gradient", "sph_vector_out", 1], ["stride", "size_t", 1],
        ["status", "pointer", 1],
    ],
    sph_wall_terms: [
        ["gamma", "sph_scalars", 1], ["gradient", "sph_vectors", 1], ["value", "sph_scalars", 1],
        ["slope", "sph_vectors", 1],
    ],
    sph_collision: [
        ["distance", "sph_real", 1], ["restitution", "sph_real", 1], ["inverse_mass", "sph_scalars", 1],
    ],
    sph_collision_report: [
        ["collisions", "int64_t", 1], ["coincident", "int64_t", 1], ["energy", "sph_real", 1],
    ],
    sph_medium: [
        ["m", "sph_scalars", 1], ["rho", "sph_scalars", 1], ["omega", "sph_scalars", 1],
    ],
    sph_gas: [
        ["medium", "sph_medium", 1], ["p", "sph_scalars", 1], ["u", "sph_scalars", 1],
        ["cs", "sph_scalars", 1], ["alpha", "sph_scalars", 1], ["v", "sph_vectors", 1],
        ["beta", "sph_real", 1], ["alpha_u", "sph_real", 1], ["conductivity", "int", 1],
    ],
    sph_gas_out: [
        ["acceleration", "sph_vector_out", 1], ["rate_u", "pointer", 1], ["div_v", "pointer", 1],
        ["v_sig", "pointer", 1], ["stride", "size_t", 1], ["status", "pointer", 1],
    ],
    sph_velocity_gradient_out: [
        ["div", "pointer", 1], ["curl", "pointer", 1], ["shear", "pointer", 1], ["square", "pointer", 1],
        ["stride", "size_t", 1], ["x", "sph_vector_out", 1], ["y", "sph_vector_out", 1],
        ["z", "sph_vector_out", 1], ["status", "pointer", 1],
    ],
    sph_shock_out: [
        ["ratio", "pointer", 1], ["v_sig", "pointer", 1], ["stride", "size_t", 1], ["status", "pointer", 1],
    ],
    sph_cleaning: [
        ["medium", "sph_medium", 1], ["field", "sph_vectors", 1], ["psi", "sph_scalars", 1],
        ["div_v", "sph_scalars", 1], ["ch", "sph_real", 1], ["sigma", "sph_real", 1],
    ],
    sph_cleaning_out: [
        ["rate_B", "sph_vector_out", 1], ["rate_psi", "pointer", 1], ["div_B", "pointer", 1],
        ["stride", "size_t", 1], ["status", "pointer", 1],
    ],
    sph_ohmic: [
        ["medium", "sph_medium", 1], ["eta", "sph_scalars", 1], ["field", "sph_vectors", 1],
    ],
    sph_ohmic_out: [
        ["rate_B", "sph_vector_out", 1], ["rate_u", "pointer", 1], ["stride", "size_t", 1],
        ["status", "pointer", 1],
    ],
    sph_mhd: [
        ["medium", "sph_medium", 1], ["p", "sph_scalars", 1], ["u", "sph_scalars", 1],
        ["cs", "sph_scalars", 1], ["alpha", "sph_scalars", 1], ["alpha_B", "sph_scalars", 1],
        ["v", "sph_vectors", 1], ["field", "sph_vectors", 1], ["psi", "sph_scalars", 1],
        ["ch", "sph_real", 1], ["sigma", "sph_real", 1], ["beta", "sph_real", 1], ["alpha_u", "sph_real", 1],
        ["tensile", "sph_real", 1],
    ],
    sph_mhd_out: [
        ["acceleration", "sph_vector_out", 1], ["rate_B", "sph_vector_out", 1], ["rate_u", "pointer", 1],
        ["rate_psi", "pointer", 1], ["div_B", "pointer", 1], ["div_v", "pointer", 1], ["v_sig", "pointer", 1],
        ["stride", "size_t", 1], ["status", "pointer", 1],
    ],
    sph_rk: [
        ["scale", "sph_scalars", 1], ["slope", "sph_vectors", 1], ["scale_gradient", "sph_vectors", 1],
        ["slope_gradient", "sph_matrices", 1],
    ],
    sph_rk_out: [
        ["scale", "pointer", 1], ["conditioning", "pointer", 1], ["stride", "size_t", 1],
        ["slope", "sph_vector_out", 1], ["scale_gradient", "sph_vector_out", 1],
        ["slope_gradient", "sph_matrix_out", 1], ["status", "pointer", 1],
    ],
    sph_corrected_out: [
        ["acceleration", "sph_vector_out", 1], ["rate_u", "pointer", 1], ["stride", "size_t", 1],
        ["status", "pointer", 1],
    ],
    sph_solid: [
        ["inverse", "sph_matrices", 1], ["stress", "sph_matrices", 1], ["density", "sph_scalars", 1],
        ["hourglass", "sph_real", 1], ["x", "sph_points", 1], ["gradient", "sph_matrices", 1],
        ["modulus", "sph_scalars", 1],
    ],
    sph_conserved: [
        ["mass", "sph_real", 1], ["kinetic_energy", "sph_real", 1], ["momentum", "sph_vec", 1],
        ["angular_momentum", "sph_vec", 1],
    ],
    sph_offender: [
        ["particle", "sph_index", 1], ["neighbour", "sph_index", 1], ["ratio", "sph_real", 1],
    ],
    sph_findings: [
        ["set", "unsigned", 1], ["at", "sph_offender", 12], ["sampled", "sph_index", 1],
        ["interior", "sph_index", 1], ["sum_lowest", "sph_real", 1], ["sum_highest", "sph_real", 1],
    ],
    sph_grid: [
        ["n", "sph_index", 1], ["dim", "int", 1], ["hashed", "int", 1], ["levels", "int", 1],
        ["scattered", "int", 1], ["cells", "int64_t", 3], ["held", "int64_t", 3], ["buckets", "size_t", 1],
        ["radius", "sph_real", 1], ["largest", "sph_real", 1], ["low", "sph_vec", 1],
        ["inverse_width", "sph_vec", 1], ["box", "sph_vec", 1], ["first", "pointer", 1],
        ["member", "pointer", 1], ["x", "pointer", 1], ["y", "pointer", 1], ["z", "pointer", 1],
        ["own", "pointer", 1], ["node", "pointer", 1],
    ],
    sph_query: [
        ["targets", "sph_points", 1], ["criterion", "int", 1], ["radius", "sph_scalars", 1],
        ["flags", "int", 1], ["first", "sph_index", 1],
    ],
    sph_neighbors: [
        ["pairs", "int64_t", 1], ["list", "sph_list", 1], ["grid", "sph_grid", 1],
    ],
    sph_part: [
        ["low", "sph_vec", 1], ["high", "sph_vec", 1], ["reach_low", "sph_vec", 1],
        ["reach_high", "sph_vec", 1],
    ],
};

exports.SPH_CUBIC_SPLINE = 0;
exports.SPH_QUARTIC_SPLINE = 1;
exports.SPH_QUINTIC_SPLINE = 2;
exports.SPH_WENDLAND_C2 = 3;
exports.SPH_WENDLAND_C4 = 4;
exports.SPH_WENDLAND_C6 = 5;
exports.SPH_WENDLAND_C2_1D = 6;
exports.SPH_WENDLAND_C4_1D = 7;
exports.SPH_WENDLAND_C6_1D = 8;
exports.SPH_GAUSSIAN = 9;
exports.SPH_SUPER_GAUSSIAN = 10;
exports.SPH_LIU_QUARTIC = 11;
exports.SPH_HERMITE = 12;
exports.SPH_SCHUESSLER_SCHMITT = 13;
exports.SPH_JOHNSON_BEISSEL = 14;
exports.SPH_CONVEX = 15;
exports.SPH_CONVEX_CUBIC_SPLINE = 16;
exports.SPH_CONVEX_WENDLAND_C2 = 17;
exports.SPH_CONVEX_WENDLAND_C4 = 18;
exports.SPH_CORE_TRIANGLE = 19;
exports.SPH_SEXTIC_SPLINE = 20;
exports.SPH_HEPTIC_SPLINE = 21;
exports.SPH_POLY6 = 22;
exports.SPH_SPIKY = 23;
exports.SPH_KERNEL_COUNT = 24;
exports.SPH_LUCY = 6;
exports.SPH_ERROR_NULL = -1;
exports.SPH_ERROR_DIM = -2;
exports.SPH_ERROR_KERNEL = -3;
exports.SPH_ERROR_COUNT = -4;
exports.SPH_ERROR_RANGE = -5;
exports.SPH_ERROR_H = -6;
exports.SPH_ERROR_POSITION = -7;
exports.SPH_ERROR_VALUE = -8;
exports.SPH_ERROR_LIST = -9;
exports.SPH_ERROR_SELF = -10;
exports.SPH_ERROR_CAPACITY = -11;
exports.SPH_ERROR_BOX = -12;
exports.SPH_ERROR_PAIRS = -13;
exports.SPH_OK = 0;
exports.SPH_TOO_FEW = 1;
exports.SPH_SINGULAR = 2;
exports.SPH_ILL_CONDITIONED = 3;
exports.SPH_FELL_BACK = 4;
exports.SPH_NOT_AVAILABLE = 5;
exports.SPH_NOT_FINITE = 6;
exports.SPH_LIST_TOO_SHORT = 7;
exports.SPH_GRADIENT_DIFFUSE = 0;
exports.SPH_GRADIENT_FULL = 1;
exports.SPH_GRADIENT_SHEPARD_DIFFUSE = 2;
exports.SPH_GRADIENT_SHEPARD_FULL = 3;
exports.SPH_MOBILITY_ARITHMETIC = 0;
exports.SPH_MOBILITY_HARMONIC = 1;
exports.SPH_MOBILITY_UPWIND = 2;
exports.SPH_VISCOSITY_NONE = 0;
exports.SPH_VISCOSITY_MONAGHAN = 1;
exports.SPH_VISCOSITY_LINEAR = 2;
exports.SPH_VISCOSITY_SIGNAL = 3;
exports.SPH_SURFACE_INSIDE = 0;
exports.SPH_SURFACE_BAND = 1;
exports.SPH_SURFACE_SPLASH = 2;
exports.SPH_CONDUCTIVITY_NONE = 0;
exports.SPH_CONDUCTIVITY_PRICE = 1;
exports.SPH_CONDUCTIVITY_WADSLEY = 2;
exports.SPH_FINDING_LIST_SHORT = 0;
exports.SPH_FINDING_LIST_SUPPORT = 1;
exports.SPH_FINDING_LIST_HALF = 2;
exports.SPH_FINDING_LIST_ONE_SIDED = 3;
exports.SPH_FINDING_LIST_STALE = 4;
exports.SPH_FINDING_LIST_FROM_ONE = 5;
exports.SPH_FINDING_BOX = 6;
exports.SPH_FINDING_VOLUME_ZERO = 7;
exports.SPH_FINDING_VOLUME_SUM = 8;
exports.SPH_FINDING_DIM_HIGH = 9;
exports.SPH_FINDING_DIM_LOW = 10;
exports.SPH_FINDING_STRIDE = 11;
exports.SPH_FINDING_COUNT = 12;
exports.SPH_GATHER = 0;
exports.SPH_SCATTER = 1;
exports.SPH_LARGER = 2;
exports.SPH_MEAN = 3;
exports.SPH_LIST_SELF = 1;
exports.SPH_LIST_HALF = 2;
exports.SPH_LIST_SORTED = 4;
exports.SPH_LIST_FOREIGN = 8;
