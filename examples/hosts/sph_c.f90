! SPDX-License-Identifier: MIT
!
! sph_c.f90 - what sph_shim.h exports, for Fortran (2008): structs, constants and functions under the names
! that they have in the headers, which say what they do. The module sph (sph.f90) adds what makes them
! comfortable. Written by examples/hosts/generate.py from the headers: run it again instead of changing this
! file.
!
! Components of structs are zero and null until they are set, as options and outputs want it. Addresses are of
! type(c_ptr), strides count numbers, and particles, starts and list entries count from 0. Two kinds of names
! differ: functions that take or answer a text of C begin with c_, because the module sph has them with
! characters; and Fortran knows no capitals, so that a function with the name of a constant ends with _of.
! For a shim that is compiled with -DSPH_SINGLE=1 or another SPH_INDEX change the kinds below.

module sph_c
    use, intrinsic :: iso_c_binding
    implicit none
    public

    integer, parameter :: sph_real = c_double, sph_index = c_int32_t
    integer, parameter :: sph_state = c_signed_char ! of a sph_status in an array, one byte each

    ! the headers that this was written from
    integer(c_int), parameter :: SPH_VERSION = 200

    ! sph_kernel
    integer(c_int), parameter :: SPH_CUBIC_SPLINE = 0 ! cubic-spline
    integer(c_int), parameter :: SPH_QUARTIC_SPLINE = 1 ! quartic-spline
    integer(c_int), parameter :: SPH_QUINTIC_SPLINE = 2 ! quintic-spline
    integer(c_int), parameter :: SPH_WENDLAND_C2 = 3 ! wendland-c2
    integer(c_int), parameter :: SPH_WENDLAND_C4 = 4 ! wendland-c4
    integer(c_int), parameter :: SPH_WENDLAND_C6 = 5 ! wendland-c6
    integer(c_int), parameter :: SPH_WENDLAND_C2_1D = 6 ! wendland-c2-1d
    integer(c_int), parameter :: SPH_WENDLAND_C4_1D = 7 ! wendland-c4-1d
    integer(c_int), parameter :: SPH_WENDLAND_C6_1D = 8 ! wendland-c6-1d
    integer(c_int), parameter :: SPH_GAUSSIAN = 9 ! gaussian
    integer(c_int), parameter :: SPH_SUPER_GAUSSIAN = 10 ! super-gaussian
    integer(c_int), parameter :: SPH_LIU_QUARTIC = 11 ! liu-quartic
    integer(c_int), parameter :: SPH_HERMITE = 12 ! hermite
    integer(c_int), parameter :: SPH_SCHUESSLER_SCHMITT = 13 ! schuessler-schmitt
    integer(c_int), parameter :: SPH_JOHNSON_BEISSEL = 14 ! johnson-beissel
    integer(c_int), parameter :: SPH_CONVEX = 15 ! convex
    integer(c_int), parameter :: SPH_CONVEX_CUBIC_SPLINE = 16 ! convex-cubic-spline
    integer(c_int), parameter :: SPH_CONVEX_WENDLAND_C2 = 17 ! convex-wendland-c2
    integer(c_int), parameter :: SPH_CONVEX_WENDLAND_C4 = 18 ! convex-wendland-c4
    integer(c_int), parameter :: SPH_CORE_TRIANGLE = 19 ! core-triangle
    integer(c_int), parameter :: SPH_SEXTIC_SPLINE = 20 ! sextic-spline
    integer(c_int), parameter :: SPH_HEPTIC_SPLINE = 21 ! heptic-spline
    integer(c_int), parameter :: SPH_POLY6 = 22 ! poly6
    integer(c_int), parameter :: SPH_SPIKY = 23 ! spiky
    integer(c_int), parameter :: SPH_KERNEL_COUNT = 24
    integer(c_int), parameter :: SPH_LUCY = 6 ! the same function

    ! sph_error: What array-level functions answer: 0, or the number of particles that are not ok, or one of
    ! these codes. After one of these codes nothing was written.
    integer(c_int), parameter :: SPH_ERROR_NULL = -1 ! a pointer is null
    integer(c_int), parameter :: SPH_ERROR_DIM = -2 ! dim is not 1, 2 or 3, or not that of the grid
    integer(c_int), parameter :: SPH_ERROR_KERNEL = -3 ! no such kernel, or none for this function (gravity)
    ! a number of particles that cannot be; a stride or number of bins below 1
    integer(c_int), parameter :: SPH_ERROR_COUNT = -4
    ! not 0 <= first <= last <= n; an end or a target that is not a particle
    integer(c_int), parameter :: SPH_ERROR_RANGE = -5
    ! h, a radius or a distance is not finite and positive, or extreme
    integer(c_int), parameter :: SPH_ERROR_H = -6
    ! a position is not finite, or so large that the difference of two may not be; ends in the wrong order
    integer(c_int), parameter :: SPH_ERROR_POSITION = -7
    ! a value, parameter or option is not finite, or not allowed
    integer(c_int), parameter :: SPH_ERROR_VALUE = -8
    integer(c_int), parameter :: SPH_ERROR_LIST = -9 ! list rows do not ascend, or an entry is not a particle
    integer(c_int), parameter :: SPH_ERROR_SELF = -10 ! a row holds its own particle
    ! the caller's memory is too small: see the function for what is needed
    integer(c_int), parameter :: SPH_ERROR_CAPACITY = -11
    ! a box length that cannot be; a support beyond half of it; far positions
    integer(c_int), parameter :: SPH_ERROR_BOX = -12
    ! more pairs than sph_index can count, or memory can hold
    integer(c_int), parameter :: SPH_ERROR_PAIRS = -13

    ! sph_status: What they answer for each particle, where an array of such answers is asked for. The outputs
    ! of a particle are 0 if it is SPH_TOO_FEW, SPH_SINGULAR, SPH_NOT_AVAILABLE or SPH_NOT_FINITE.
    integer(c_int), parameter :: SPH_OK = 0
    ! fewer neighbours inside the support than unknowns, or too little weight
    integer(c_int), parameter :: SPH_TOO_FEW = 1
    ! the neighbours (collinear, coincident, ...) do not determine the answer
    integer(c_int), parameter :: SPH_SINGULAR = 2
    ! computed, but the conditioning is below the caller's limit; or no h fits
    integer(c_int), parameter :: SPH_ILL_CONDITIONED = 3
    integer(c_int), parameter :: SPH_FELL_BACK = 4 ! computed by the fallback that the caller allowed
    integer(c_int), parameter :: SPH_NOT_AVAILABLE = 5 ! the operator is not defined at this particle
    integer(c_int), parameter :: SPH_NOT_FINITE = 6 ! the result overflowed
    ! the list is too short for the answer; the operator says what it returns
    integer(c_int), parameter :: SPH_LIST_TOO_SHORT = 7

    ! sph_elliptic_gradient: The gradient of the kernel that is taken for g. nu_i = sum_j V_j W_ij, with the
    ! particle itself. All but SPH_GRADIENT_FULL are radial, that is, parallel to e.
    integer(c_int), parameter :: SPH_GRADIENT_DIFFUSE = 0 ! (15) grad W
    integer(c_int), parameter :: SPH_GRADIENT_FULL = 1 ! (16) grad (W / nu). Best for M-SPH at boundaries
    integer(c_int), parameter :: SPH_GRADIENT_SHEPARD_DIFFUSE = 2 ! (17) (grad W) / nu
    ! (18) grad_j (W / nu): of nu, only the neighbour's part varies
    integer(c_int), parameter :: SPH_GRADIENT_SHEPARD_FULL = 3

    ! sph_mobility_mean: The mean of two mobilities.
    integer(c_int), parameter :: SPH_MOBILITY_ARITHMETIC = 0 ! (m_i + m_j) / 2: as published
    ! 2 m_i m_j / (m_i + m_j): keeps the flux through a jump of m
    integer(c_int), parameter :: SPH_MOBILITY_HARMONIC = 1
    ! m of the particle with the higher potential; m_i if they are equal
    integer(c_int), parameter :: SPH_MOBILITY_UPWIND = 2

    ! sph_viscosity: Which artificial viscosity Pi_ij.
    integer(c_int), parameter :: SPH_VISCOSITY_NONE = 0
    integer(c_int), parameter :: SPH_VISCOSITY_MONAGHAN = 1 ! sph_viscosity_pair_monaghan: pairs that approach
    integer(c_int), parameter :: SPH_VISCOSITY_LINEAR = 2 ! sph_viscosity_pair_linear: all pairs
    ! sph_viscosity_pair_signal: pairs that approach, by the signal speed
    integer(c_int), parameter :: SPH_VISCOSITY_SIGNAL = 3

    ! sph_surface: What lambda says of a particle.
    integer(c_int), parameter :: SPH_SURFACE_INSIDE = 0 ! lambda > 0.75
    integer(c_int), parameter :: SPH_SURFACE_BAND = 1 ! look closer
    integer(c_int), parameter :: SPH_SURFACE_SPLASH = 2 ! lambda < 0.2: at the surface, or outside

    ! sph_conductivity: Which speed v_u conducts heat, alpha_u v_u (u_i - u_j) / rho.
    integer(c_int), parameter :: SPH_CONDUCTIVITY_NONE = 0
    integer(c_int), parameter :: SPH_CONDUCTIVITY_PRICE = 1 ! sph_conductivity_speed: differences of pressure
    ! |w|: nothing at rest, so that it may be used with gravity
    integer(c_int), parameter :: SPH_CONDUCTIVITY_WADSLEY = 2

    ! sph_finding: What may be wrong. sph_finding_text explains each in words.
    integer(c_int), parameter :: SPH_FINDING_LIST_SHORT = 0 ! every row ends before the support does
    ! every row ends at h: h and the support are mixed up
    integer(c_int), parameter :: SPH_FINDING_LIST_SUPPORT = 1
    integer(c_int), parameter :: SPH_FINDING_LIST_HALF = 2 ! each pair is in one of its two rows only
    ! pairs are missing that are inside the support of one particle only
    integer(c_int), parameter :: SPH_FINDING_LIST_ONE_SIDED = 3
    ! rows lack particles that are nearer than others they hold: an old list
    integer(c_int), parameter :: SPH_FINDING_LIST_STALE = 4
    integer(c_int), parameter :: SPH_FINDING_LIST_FROM_ONE = 5 ! indices or starts count from 1
    integer(c_int), parameter :: SPH_FINDING_BOX = 6 ! positions and list do not have the same periodic box
    ! a volume is negative, or more than half of them are 0
    integer(c_int), parameter :: SPH_FINDING_VOLUME_ZERO = 7
    ! sum_j V_j W_ij in the interior is far from 1: perhaps masses were given
    integer(c_int), parameter :: SPH_FINDING_VOLUME_SUM = 8
    ! a coordinate is the same for all particles: dim is too high
    integer(c_int), parameter :: SPH_FINDING_DIM_HIGH = 9
    ! particles differ in a coordinate beyond dim: dim is too low
    integer(c_int), parameter :: SPH_FINDING_DIM_LOW = 10
    ! the stride of positions is in bytes, or two components share memory
    integer(c_int), parameter :: SPH_FINDING_STRIDE = 11
    integer(c_int), parameter :: SPH_FINDING_COUNT = 12

    ! sph_criterion: Which pairs at the distance r are neighbours; R_i and R_j are their support radii. The
    ! operators of sph_ops.h need a gather list. Pair-symmetric operators need the larger of both radii.
    integer(c_int), parameter :: SPH_GATHER = 0 ! r < R_i
    integer(c_int), parameter :: SPH_SCATTER = 1 ! r < R_j
    integer(c_int), parameter :: SPH_LARGER = 2 ! r < max(R_i, R_j)
    integer(c_int), parameter :: SPH_MEAN = 3 ! r < (R_i + R_j) / 2

    ! sph_list_flags: ================================================================ the grid
    integer(c_int), parameter :: SPH_LIST_SELF = 1 ! a row also holds its own particle
    integer(c_int), parameter :: SPH_LIST_HALF = 2 ! each pair once: only j > i (for a symmetric criterion)
    integer(c_int), parameter :: SPH_LIST_SORTED = 4 ! each row in ascending order of j
    ! target i has nothing to do with source i (not together with SELF or HALF)
    integer(c_int), parameter :: SPH_LIST_FOREIGN = 8

    ! ================================================================ vectors  Vectors and symmetric tensors
    ! are passed by value. The functions use their first dim components.
    type, bind(c) :: sph_vec
        ! components beyond dim are 0
        real(sph_real) :: x = 0.0_sph_real, y = 0.0_sph_real, z = 0.0_sph_real
    end type

    ! A symmetric tensor. Components beyond dim are not read.
    type, bind(c) :: sph_sym
        real(sph_real) :: xx = 0.0_sph_real, xy = 0.0_sph_real, yy = 0.0_sph_real, xz = 0.0_sph_real, yz = &
            0.0_sph_real, zz = 0.0_sph_real
    end type

    ! Positions: the coordinates of particle i are x[i * stride], y[i * stride] and z[i * stride].
    type, bind(c) :: sph_points
        ! y is read in 2D and 3D only, z in 3D only
        type(c_ptr) :: x = c_null_ptr, y = c_null_ptr, z = c_null_ptr
        ! from one particle to the next, in sph_real; at least 1
        integer(c_size_t) :: stride = 0
        ! number of particles; all of them are sources
        integer(sph_index) :: n = 0
        ! periodic lengths of the first dim axes; 0: the axis is open
        type(sph_vec) :: box
    end type

    ! One number for each particle: that of particle i is p[i * stride].
    type, bind(c) :: sph_scalars
        type(c_ptr) :: p = c_null_ptr
        ! 0: one value for all
        integer(c_size_t) :: stride = 0
    end type

    ! Neighbour lists in CSR form: the neighbours of target i are index[start[i]] ... index[start[i + 1] - 1].
    type, bind(c) :: sph_list
        type(c_ptr) :: start = c_null_ptr, index = c_null_ptr
    end type

    ! One vector for each particle. Only the first dim components are read.
    type, bind(c) :: sph_vectors
        type(sph_scalars) :: x, y, z
    end type

    ! Where results go: separate arrays, or members of structs that are `stride` numbers apart. A stride of 0
    ! counts as 1. Where that makes sense, a null pointer says that a result is not wanted. status holds an
    ! sph_status for each target, and is contiguous.
    type, bind(c) :: sph_vector_out
        type(c_ptr) :: x = c_null_ptr, y = c_null_ptr, z = c_null_ptr
        integer(c_size_t) :: stride = 0
    end type

    type, bind(c) :: sph_scalar_out
        type(c_ptr) :: p = c_null_ptr
        integer(c_size_t) :: stride = 0
        type(c_ptr) :: status = c_null_ptr
    end type

    ! One matrix for each particle, by its rows. Only the first dim rows and columns are read.
    type, bind(c) :: sph_matrices
        type(sph_vectors) :: x, y, z
    end type

    ! Where matrices go, by their rows. Only the first dim rows and columns are written.
    type, bind(c) :: sph_matrix_out
        type(sph_vector_out) :: x, y, z
    end type

    ! Who interacts: the sources with their volumes m / rho (areas in 2D, lengths in 1D), the targets first
    ! ... last - 1 among them, and the smoothing length and the neighbours of each target. A cloud is passed
    ! by value, as one argument, and owns nothing.
    type, bind(c) :: sph_cloud
        type(sph_points) :: points
        type(sph_list) :: list
        type(sph_scalars) :: h, volume
        integer(sph_index) :: first = 0, last = 0
        ! 0: every sweep scans what it reads. 1: sph_cloud_checked has scanned the cloud, and set largest_h.
        ! Negative: sph_cloud_checked found this sph_error, and every sweep answers it.
        integer(c_int) :: checked = 0
        real(sph_real) :: largest_h = 0.0_sph_real
    end type

    ! Where derivatives go: the gradient (gx, gy, gz), the Hessian (hxx ... hzz), its trace (laplacian), and
    ! the conditioning of the system (1 good, 0 singular). What is null is not wanted; components beyond dim
    ! are not written.
    type, bind(c) :: sph_derivatives_out
        type(c_ptr) :: gx = c_null_ptr, gy = c_null_ptr, gz = c_null_ptr, hxx = c_null_ptr, hxy = &
            c_null_ptr, hyy = c_null_ptr, hxz = c_null_ptr, hyz = c_null_ptr, hzz = c_null_ptr, laplacian = &
            c_null_ptr, conditioning = c_null_ptr
        integer(c_size_t) :: stride = 0
        ! sph_status, contiguous
        type(c_ptr) :: status = c_null_ptr
    end type

    ! Where rows go. The row of target i has one weight for each entry p = start[i] ... start[i + 1] - 1 of
    ! its list, so that for an operator D factor[i] D f_i = diagonal[i] f_i + sum_p row[p] f_index[p],
    ! diagonal[i] = -sum_p row[p]. All pointers but row may be null. The stride is that of diagonal, factor
    ! and conditioning, which have one number for each target; row is contiguous.
    type, bind(c) :: sph_rows_out
        type(c_ptr) :: row = c_null_ptr, diagonal = c_null_ptr, factor = c_null_ptr, conditioning = &
            c_null_ptr
        integer(c_size_t) :: stride = 0
        type(c_ptr) :: status = c_null_ptr
    end type

    ! Where the matrices go that correct a gradient, and the conditioning of each (1 good, 0 singular).
    ! conditioning and status may be null. The stride is that of conditioning.
    type, bind(c) :: sph_correction_out
        type(sph_matrix_out) :: inverse
        type(c_ptr) :: conditioning = c_null_ptr
        integer(c_size_t) :: stride = 0
        type(c_ptr) :: status = c_null_ptr
    end type

    ! Where the rows of a gradient go: one weight for each entry of the list and each component, contiguous.
    ! conditioning and status may be null. The stride is that of conditioning.
    type, bind(c) :: sph_gradient_rows_out
        type(c_ptr) :: x = c_null_ptr, y = c_null_ptr, z = c_null_ptr, conditioning = c_null_ptr
        integer(c_size_t) :: stride = 0
        type(c_ptr) :: status = c_null_ptr
    end type

    type, bind(c) :: sph_density_options
        ! of the targets: list i holds all sources with r < list_radius_i; no default
        type(sph_scalars) :: list_radius
        ! h = eta (m / rho)^(1/dim); 0: sph_kernel_h_over_dx(k)
        real(sph_real) :: eta = 0.0_sph_real
        ! relative, of h, below 1; 0: 1e-3. At least 64 unit round-offs are used
        real(sph_real) :: tolerance = 0.0_sph_real
    end type

    ! h holds the guess, and then the answer. omega and status may be null. The stride is that of h, rho and
    ! omega.
    type, bind(c) :: sph_density_out
        type(c_ptr) :: h = c_null_ptr, rho = c_null_ptr, omega = c_null_ptr
        integer(c_size_t) :: stride = 0
        type(c_ptr) :: status = c_null_ptr
    end type

    ! First and second derivatives. As a result, these are the derivatives of f. As an operator, they are the
    ! coefficients of D f = sum_a gradient_a d_a f + sum_{a <= b} hessian_ab d_a d_b f, where each mixed
    ! derivative counts once. The Laplacian has hessian.xx = hessian.yy = hessian.zz = 1, and all else is 0.
    type, bind(c) :: sph_jet
        type(sph_vec) :: gradient
        type(sph_sym) :: hessian
    end type

    ! Options of the sweeps for derivatives. Zeros are the defaults.
    type, bind(c) :: sph_derivatives_options
        ! A target whose |conditioning| is smaller is SPH_ILL_CONDITIONED; >= 0. 0: no target is.
        real(sph_real) :: conditioning_min = 0.0_sph_real
        ! For ICSPM and Fatehi-Manzari. 1: targets that are singular or ill-conditioned get the values of WLS.
        integer(c_int) :: fallback_wls = 0
    end type

    ! The sources of a fit: points, and the volumes that weigh them.
    type, bind(c) :: sph_sources
        type(sph_points) :: points
        type(sph_scalars) :: volume
    end type

    type, bind(c) :: sph_interpolation_options
        ! A target whose conditioning is smaller gets Shepard's mean; >= 0. 0: only singular ones do. 0.001
        ! keeps a fit from extrapolating far with neighbours that are nearly on a line.
        real(sph_real) :: conditioning_min = 0.0_sph_real
    end type

    ! Where value and gradient go. What is null is not wanted. status holds an sph_status of each target, and
    ! is contiguous.
    type, bind(c) :: sph_interpolation_out
        type(c_ptr) :: value = c_null_ptr, gx = c_null_ptr, gy = c_null_ptr, gz = c_null_ptr, conditioning = &
            c_null_ptr
        integer(c_size_t) :: stride = 0
        type(c_ptr) :: status = c_null_ptr
    end type

    ! Where rows go: one weight for each entry of the list, for the value and for each component of the
    ! gradient, contiguous: f = sum_p value[p] f_j, grad f = sum_p (x[p], y[p], z[p]) f_j. What is null is not
    ! wanted. The stride is that of conditioning.
    type, bind(c) :: sph_interpolation_rows_out
        type(c_ptr) :: value = c_null_ptr, x = c_null_ptr, y = c_null_ptr, z = c_null_ptr, conditioning = &
            c_null_ptr
        integer(c_size_t) :: stride = 0
        type(c_ptr) :: status = c_null_ptr
    end type

    ! Options of the elliptic sweeps. All zeros are the defaults: gradient (15), arithmetic means, Gamma.
    type, bind(c) :: sph_elliptic_options
        ! an sph_elliptic_gradient
        integer(c_int) :: gradient = 0
        ! an sph_mobility_mean
        integer(c_int) :: mean = 0
        ! For M-SPH only. 1: Gamma* (71) where it is definite, else Gamma and SPH_FELL_BACK.
        integer(c_int) :: gamma_star = 0
        ! For Schwaiger and M-SPH. 1: scale = dim / tr Gamma* where tr Gamma* is large enough, else
        ! SPH_FELL_BACK. It takes the place of gamma_star. See the sweeps below.
        integer(c_int) :: trace = 0
        ! Particles with a lower conditioning are SPH_ILL_CONDITIONED, but they are computed.
        real(sph_real) :: conditioning_min = 0.0_sph_real
        ! read for SPH_MOBILITY_UPWIND only
        type(sph_scalars) :: potential
        ! of the targets; is added to the result, if it is there; rows do not contain it
        type(sph_scalars) :: source
    end type

    ! What the neighbourhood of a particle promises for M-SPH with the gradient of the options. Each array has
    ! one number a particle; null pointers are not written.
    type, bind(c) :: sph_elliptic_report
        ! The least and the largest T_ij / (scale V_j mu t_ij) = 1 - xi . e of the neighbours inside the
        ! support. (92): if both have the same sign, all weights have one sign. (93): if both are positive, so
        ! are all weights of the row.
        type(c_ptr) :: sign_least = c_null_ptr, sign_most = c_null_ptr
        ! |xi| = |N~ C|, figure 6 of the paper; unit 1/length
        type(c_ptr) :: xi = c_null_ptr
        ! The largest V_j e . g / dim. The SPH continuity condition (21) asks for at most 1.
        type(c_ptr) :: continuity = c_null_ptr
        ! |N| and its bound sum V_j |g|, (22), which is a constant / h
        type(c_ptr) :: n = c_null_ptr, n_bound = c_null_ptr
        ! The smallest eigenvalue of K = C^-1 (of its symmetric part). It is near 1 in the interior, and
        ! smaller towards a free surface: Marrone et al. 2010, JCP 229, 3652, with gradient (17).
        type(c_ptr) :: eigenvalue_least = c_null_ptr
        ! of Gamma: largest / smallest; 0 if the smallest is <= 0
        type(c_ptr) :: eigenvalue_ratio = c_null_ptr
        ! of all arrays but status, in sph_real; 0 counts as 1
        integer(c_size_t) :: stride = 0
        ! contiguous; as for sph_elliptic_msph with the same options
        type(c_ptr) :: status = c_null_ptr
    end type

    ! The mobilities of the axes.
    type, bind(c) :: sph_diagonal
        ! y, z are not read below dim 2, 3
        type(sph_scalars) :: x, y, z
    end type

    ! What holds at a boundary particle: alpha u + beta m n . grad u is given. alpha = beta = 0 means that the
    ! particle is not on a boundary. All of the targets; so is the m of the sweep.
    type, bind(c) :: sph_boundary
        ! n, which points out of the domain
        type(sph_vectors) :: normal
        ! of u, and of m n . grad u
        type(sph_scalars) :: alpha, beta
    end type

    ! A matrix in CSR form, in the caller's memory. start has one place for each target and one more; column
    ! and value have `capacity` places each.
    type, bind(c) :: sph_csr
        type(c_ptr) :: start = c_null_ptr, column = c_null_ptr, value = c_null_ptr
        integer(c_int64_t) :: capacity = 0
    end type

    ! Tait's equation of state: the density rho0 at the pressure p0, the sound speed c at this density, and
    ! the exponent gamma.
    type, bind(c) :: sph_tait
        real(sph_real) :: rho0 = 0.0_sph_real, c = 0.0_sph_real, gamma = 0.0_sph_real, p0 = 0.0_sph_real
    end type

    ! The state of a fluid, one number for each particle, all sources. A pair uses (h_i + h_j) / 2: lists by
    ! SPH_MEAN, or by any criterion if all particles have the same h.
    type, bind(c) :: sph_fluid
        ! mass, density, pressure, sound speed >= 0 (for artificial viscosity)
        type(sph_scalars) :: m, rho, p, c
        ! velocity
        type(sph_vectors) :: v
        ! the artificial viscosity: an sph_viscosity
        integer(c_int) :: viscosity = 0
        ! its coefficients, pure numbers
        real(sph_real) :: alpha = 0.0_sph_real, beta = 0.0_sph_real
        ! softens r^2 to r^2 + eta^2 h^2; 0 means the usual 0.1, a negative number none
        real(sph_real) :: eta = 0.0_sph_real
    end type

    ! Where rates go. rate, heating and status may be null. The stride is that of rate and heating, in
    ! sph_real.
    type, bind(c) :: sph_fluid_out
        type(sph_vector_out) :: acceleration
        ! drho/dt, and du/dt by viscosity (u: thermal energy per mass)
        type(c_ptr) :: rate = c_null_ptr, heating = c_null_ptr
        integer(c_size_t) :: stride = 0
        type(c_ptr) :: status = c_null_ptr
    end type

    ! Dynamic viscosities of each particle, neither negative: mu (shear) and zeta (bulk).
    type, bind(c) :: sph_shear_bulk
        type(sph_scalars) :: shear, bulk
    end type

    ! The fluid and the wall. One number for each particle, all sources; velocity and normal: of the targets.
    type, bind(c) :: sph_wall
        ! share: 1 for fluid particles, 0 for all others. rho and p: density and pressure of the fluid.
        type(sph_scalars) :: share, rho, p
        ! v: velocity of the fluid. velocity: the wall's own velocity u. normal: normal of the wall, of any
        ! length, for free slip; null arrays mean no slip.
        type(sph_vectors) :: v, velocity, normal
        ! g - a_w: gravity less the acceleration of the wall
        type(sph_vec) :: gravity
    end type

    ! Where pressure and velocity of the wall particles go.
    type, bind(c) :: sph_wall_out
        type(c_ptr) :: p = c_null_ptr
        type(sph_vector_out) :: v
        ! of p
        integer(c_size_t) :: stride = 0
        ! may be null
        type(c_ptr) :: status = c_null_ptr
    end type

    ! What density diffusion needs to know.
    type, bind(c) :: sph_diffusion
        ! rho is read, and v; where v is null there is no density rate beside the diffusion
        type(sph_fluid) :: fluid
        ! its strength; 0 means the usual 0.1, a negative number none
        real(sph_real) :: delta = 0.0_sph_real
        ! of the liquid: c >= 0 is read, and by fourtakas rho0
        type(sph_tait) :: tait
        ! A pair has the factor share_i share_j: 1 for the liquid, 0 for walls and other fluids. Null: all
        ! take part.
        type(sph_scalars) :: share
        ! of the density, from sph_gradient_cspm: antuono only
        type(sph_vectors) :: gradient
        ! fourtakas only
        type(sph_vec) :: gravity
    end type

    ! Where what is known of the surface goes. divergence, lambda and status may be null. The stride is that
    ! of divergence and lambda.
    type, bind(c) :: sph_surface_out
        ! div r and lambda, pure numbers
        type(c_ptr) :: divergence = c_null_ptr, eigenvalue = c_null_ptr
        ! outward, of length 1 or 0
        type(sph_vector_out) :: normal
        integer(c_size_t) :: stride = 0
        type(c_ptr) :: status = c_null_ptr
    end type

    ! How particles are shifted. Zeros are the defaults where nothing else is said. Arrays are of the targets.
    type, bind(c) :: sph_shift
        ! an area, of each particle or of all. There is no default
        type(sph_scalars) :: strength
        ! R; 0: no such term
        real(sph_real) :: tensile = 0.0_sph_real
        ! dx / h, of the particles as they should lie; is read if R is not 0
        real(sph_real) :: spacing = 0.0_sph_real
        ! lambda of sph_free_surface. Null: there is no free surface
        type(sph_scalars) :: eigenvalue
        ! of sph_free_surface; is read with lambda
        type(sph_vectors) :: normal
        ! the longest shift, a length; 0 means 0.2 h, a negative number no limit
        real(sph_real) :: longest = 0.0_sph_real
    end type

    ! Where the accelerations of the transport velocity go.
    type, bind(c) :: sph_transport_out
        type(sph_vector_out) :: background, stress
        type(c_ptr) :: status = c_null_ptr
    end type

    ! limiter: 0 means the usual 3; a negative number means beta = 1, the whole acoustic solver. gravity: the
    ! acceleration g, less that of the frame; 0 leaves the hydrostatic part in the jump.
    type, bind(c) :: sph_riemann_options
        real(sph_real) :: limiter = 0.0_sph_real
        type(sph_vec) :: gravity
    end type

    ! Density of the targets, and normal of all sources.
    type, bind(c) :: sph_tension
        type(sph_scalars) :: rho
        ! grad c, in 1 / length, and not of unit length
        type(sph_vectors) :: normal
        ! tension, force / length
        real(sph_real) :: sigma = 0.0_sph_real
        ! CSF: normals shorter than least / h do not count. 0 means the usual 0.01, a negative number 0.
        real(sph_real) :: least = 0.0_sph_real
    end type

    ! Where CSF's results go. curvature and status may be null; the stride is that of curvature.
    type, bind(c) :: sph_tension_out
        type(sph_vector_out) :: acceleration
        type(c_ptr) :: curvature = c_null_ptr
        integer(c_size_t) :: stride = 0
        type(c_ptr) :: status = c_null_ptr
    end type

    ! Flat elements, in order: a point a with b anywhere behind it (1D), a segment from a to b with the fluid
    ! on its left (2D), a triangle a, b, c whose normal (b - a) x (c - a) points out of the fluid (3D).
    ! Together they close the fluid, at least where supports reach.
    type, bind(c) :: sph_wall_elements
        integer(sph_index) :: n = 0
        ! one corner of each element; c is read in 3D only
        type(sph_vectors) :: a, b, c
        ! the elements near each target; null: all are looked at
        type(sph_list) :: list
    end type

    ! Where gamma and its gradient go. The stride is that of gamma; status may be null.
    type, bind(c) :: sph_wall_gamma_out
        type(c_ptr) :: gamma = c_null_ptr
        type(sph_vector_out) :: gradient
        integer(c_size_t) :: stride = 0
        type(c_ptr) :: status = c_null_ptr
    end type

    ! What an operator reads of the wall, all of the targets: gamma and its gradient; f_w (`value`, for
    ! sph_wall_gradient) or g_w (`slope`, for sph_wall_laplacian).
    type, bind(c) :: sph_wall_terms
        type(sph_scalars) :: gamma
        type(sph_vectors) :: gradient
        type(sph_scalars) :: value
        type(sph_vectors) :: slope
    end type

    ! Which particles collide, and how. Lists must reach as far as the collision distance. Walls may be mere
    ! sources, not targets.
    type, bind(c) :: sph_collision
        ! Particles that approach within `distance` collide. restitution: C_R (0 inelastic, 1 elastic).
        real(sph_real) :: distance = 0.0_sph_real, restitution = 0.0_sph_real
        ! 1/m of each particle; 0 for walls
        type(sph_scalars) :: inverse_mass
    end type

    ! What happened in a sequence of collisions.
    type, bind(c) :: sph_collision_report
        ! numbers of pairs; coincident pairs exchange nothing
        integer(c_int64_t) :: collisions = 0, coincident = 0
        ! change of the kinetic energy (walls have none); <= 0 for restitution <= 1
        real(sph_real) :: energy = 0.0_sph_real
    end type

    ! Mass, density and Omega of all sources. Difference forms and sph_shock_indicator read the last two of
    ! the targets.
    type, bind(c) :: sph_medium
        type(sph_scalars) :: m, rho, omega
    end type

    ! The state of a gas, one number or vector for each particle, all sources.
    type, bind(c) :: sph_gas
        type(sph_medium) :: medium
        ! pressure, thermal energy per mass, sound speed >= 0
        type(sph_scalars) :: p, u, cs
        ! coefficient of viscosity, 0 (none) to 1 or more. A pair takes the mean
        type(sph_scalars) :: alpha
        type(sph_vectors) :: v
        ! of signal speed and conductivity; 2 and 1 are usual
        real(sph_real) :: beta = 0.0_sph_real, alpha_u = 0.0_sph_real
        ! which: an sph_conductivity. With SPH_CONDUCTIVITY_NONE alpha_u is not read
        integer(c_int) :: conductivity = 0
    end type

    ! Where rates go. acceleration must be there; the other pointers may be null.
    type, bind(c) :: sph_gas_out
        type(sph_vector_out) :: acceleration
        ! du/dt, div v in difference form, largest signal speed
        type(c_ptr) :: rate_u = c_null_ptr, div_v = c_null_ptr, v_sig = c_null_ptr
        ! of these three, in sph_real; 0 counts as 1
        integer(c_size_t) :: stride = 0
        type(c_ptr) :: status = c_null_ptr
    end type

    ! Where the gradient of the velocity goes, and what a switch needs of it (see sph_flow). Every pointer may
    ! be null: x, y and z are the gradients of v_x, v_y and v_z, and not wanted where their first array is
    ! null.
    type, bind(c) :: sph_velocity_gradient_out
        type(c_ptr) :: div = c_null_ptr, curl = c_null_ptr, shear = c_null_ptr, square = c_null_ptr
        ! of these four, in sph_real; 0 counts as 1
        integer(c_size_t) :: stride = 0
        type(sph_vector_out) :: x, y, z
        type(c_ptr) :: status = c_null_ptr
    end type

    ! Where the indicator of shocks goes. Each pointer may be null.
    type, bind(c) :: sph_shock_out
        ! R, and the signal speed of the switch
        type(c_ptr) :: ratio = c_null_ptr, v_sig = c_null_ptr
        ! of these two, in sph_real; 0 counts as 1
        integer(c_size_t) :: stride = 0
        type(c_ptr) :: status = c_null_ptr
    end type

    ! The state of divergence cleaning, one number or vector for each particle, all sources.
    type, bind(c) :: sph_cleaning
        type(sph_medium) :: medium
        ! B, of dim components
        type(sph_vectors) :: field
        ! div_v: of the targets; sph_scalars_none(): div v = 0
        type(sph_scalars) :: psi, div_v
        ! speed and damping of the cleaning waves; see sph_cleaning_sigma
        real(sph_real) :: ch = 0.0_sph_real, sigma = 0.0_sph_real
    end type

    ! Where the rates of cleaning go.
    type, bind(c) :: sph_cleaning_out
        type(sph_vector_out) :: rate_B
        ! div_B may be null
        type(c_ptr) :: rate_psi = c_null_ptr, div_B = c_null_ptr
        ! of these two
        integer(c_size_t) :: stride = 0
        ! may be null
        type(c_ptr) :: status = c_null_ptr
    end type

    ! The state of a resistive medium, one number or vector for each particle, all sources.
    type, bind(c) :: sph_ohmic
        type(sph_medium) :: medium
        ! resistivity >= 0 in length^2 / time, with mu_0 = 1: 1 / conductivity
        type(sph_scalars) :: eta
        ! B: three components if field.z has an array, else dim
        type(sph_vectors) :: field
    end type

    ! Where its rates go. rate_u and status may be null.
    type, bind(c) :: sph_ohmic_out
        type(sph_vector_out) :: rate_B
        type(c_ptr) :: rate_u = c_null_ptr
        ! of rate_u, in sph_real; 0 counts as 1
        integer(c_size_t) :: stride = 0
        type(c_ptr) :: status = c_null_ptr
    end type

    ! The state of a magnetised gas, one number or vector for each particle, all sources.
    type, bind(c) :: sph_mhd
        type(sph_medium) :: medium
        ! pressure, thermal energy per mass, sound speed
        type(sph_scalars) :: p, u, cs
        ! Coefficients of viscosity and resistivity of each particle, 0 (none) to 1. A pair takes the mean.
        type(sph_scalars) :: alpha, alpha_B
        ! velocity and B: three components each if v.z has an array, else dim
        type(sph_vectors) :: v, field
        ! sph_scalars_none(): no cleaning
        type(sph_scalars) :: psi
        ! speed and damping of the cleaning waves; see sph_cleaning_rates
        real(sph_real) :: ch = 0.0_sph_real, sigma = 0.0_sph_real
        ! of signal speed and conductivity; 2 and 1 are usual; alpha_u = 0: none
        real(sph_real) :: beta = 0.0_sph_real, alpha_u = 0.0_sph_real
        ! The part of (9) that is subtracted. 1: all of it. 0: none; momentum is then conserved, but particles
        ! attract each other and form pairs where B^2/2 > P.
        real(sph_real) :: tensile = 0.0_sph_real
    end type

    ! Where rates go. acceleration and rate_B must be there; the other pointers may be null.
    type, bind(c) :: sph_mhd_out
        type(sph_vector_out) :: acceleration, rate_B
        ! du/dt, dpsi/dt, div B and div v in difference form, and the largest signal speed
        type(c_ptr) :: rate_u = c_null_ptr, rate_psi = c_null_ptr, div_B = c_null_ptr, div_v = c_null_ptr, &
            v_sig = c_null_ptr
        ! of these five, in sph_real; 0 counts as 1
        integer(c_size_t) :: stride = 0
        type(c_ptr) :: status = c_null_ptr
    end type

    ! A, B and their gradients of all sources: what sph_rk_correction wrote. Interpolation and gradients read
    ! those of the targets.
    type, bind(c) :: sph_rk
        type(sph_scalars) :: scale
        type(sph_vectors) :: slope, scale_gradient
        type(sph_matrices) :: slope_gradient
    end type

    ! Where they go. conditioning and status may be null. The stride is that of scale and conditioning.
    type, bind(c) :: sph_rk_out
        type(c_ptr) :: scale = c_null_ptr, conditioning = c_null_ptr
        integer(c_size_t) :: stride = 0
        type(sph_vector_out) :: slope, scale_gradient
        ! the row of each component of B: its gradient
        type(sph_matrix_out) :: slope_gradient
        type(c_ptr) :: status = c_null_ptr
    end type

    ! Where the rates of a gas go: the acceleration, and du/dt by pressure and viscosity (u: thermal energy
    ! per mass). rate_u and status may be null.
    type, bind(c) :: sph_corrected_out
        type(sph_vector_out) :: acceleration
        type(c_ptr) :: rate_u = c_null_ptr
        ! of rate_u
        integer(c_size_t) :: stride = 0
        type(c_ptr) :: status = c_null_ptr
    end type

    ! The state of a solid, one value for each particle, all sources.
    type, bind(c) :: sph_solid
        ! L of sph_gradient_correction_cspm, and P
        type(sph_matrices) :: inverse, stress
        ! of the reference state, of the targets
        type(sph_scalars) :: density
        ! For hourglass control: its coefficient alpha (0: none; 1 is usual), and what else it reads: the
        ! current positions, F, and Young's modulus, not negative.
        real(sph_real) :: hourglass = 0.0_sph_real
        type(sph_points) :: x
        type(sph_matrices) :: gradient
        type(sph_scalars) :: modulus
    end type

    ! Mass, momentum, angular momentum about the origin and kinetic energy of the targets.
    type, bind(c) :: sph_conserved
        real(sph_real) :: mass = 0.0_sph_real, kinetic_energy = 0.0_sph_real
        ! of the second, only z is not 0 in 2D, and none in 1D
        type(sph_vec) :: momentum, angular_momentum
    end type

    ! The first place where a mistake shows: a particle, a neighbour (-1: none), and a number, `ratio`:
    ! LIST_*, BOX    distance / support, with the support that decides for this pair LIST_FROM_ONE  0;
    ! neighbour is the entry as it is in the list VOLUME_ZERO    the volume VOLUME_SUM     the sum DIM_HIGH
    ! 0 DIM_LOW        the difference of the coordinates of the two particles / support STRIDE         if two
    ! components share memory, the distance of their pointers in sph_real; else the given stride / the likely
    ! stride
    type, bind(c) :: sph_offender
        integer(sph_index) :: particle = 0, neighbour = 0
        real(sph_real) :: ratio = 0.0_sph_real
    end type

    ! All findings.
    type, bind(c) :: sph_findings
        ! has the bit 1u << finding for each finding
        integer(c_int) :: set = 0
        ! particle = -1 where there is no finding
        type(sph_offender) :: at(12)
        ! number of targets that were compared with all particles
        integer(sph_index) :: sampled = 0
        ! how many of them have particles on all sides; 0 without volumes
        integer(sph_index) :: interior = 0
        ! The least and the largest sum_j V_j W_ij of the latter: near 1 in a healthy cloud, and 0 if interior
        ! is 0.
        real(sph_real) :: sum_lowest = 0.0_sph_real, sum_highest = 0.0_sph_real
    end type

    ! The sources, sorted into slots such that those of near slots are near each other, in one of three ways.
    ! CELLS: the grid's radius is the width of a cell in y and z, and that of SPHI_FINE cells in x. Cells that
    ! follow each other in x follow each other in memory, so that the neighbours of a particle are a few
    ! contiguous runs of slots. If the bounding box has no more than 2 n cells, each has its own bucket.
    ! HASHED CELLS: if it has more (most of them empty), cells are hashed into about n buckets; a row along x
    ! is still contiguous. A TREE, where radii differ so much that no width of a cell suits all of them: the
    ! slots are halved at the median of the longer axis, and so are the halves, down to leaves of at most
    ! SPHI_LEAF slots. Node 1 is the root, and the halves of node k are the nodes 2 k and 2 k + 1. The fields
    ! are for the functions below.
    type, bind(c) :: sph_grid
        integer(sph_index) :: n = 0
        ! levels: of the tree; 0 if there are cells
        integer(c_int) :: dim = 0, hashed = 0, levels = 0
        ! 1 if many particles that follow each other are not near each other
        integer(c_int) :: scattered = 0
        ! along each axis; around the box, if the axis is periodic
        integer(c_int64_t) :: cells(3) = 0
        ! of these the first ones, which may hold particles: the others are empty
        integer(c_int64_t) :: held(3) = 0
        ! a power of two if hashed
        integer(c_size_t) :: buckets = 0
        ! of all sources, or their mean
        real(sph_real) :: radius = 0.0_sph_real
        ! radius of a source
        real(sph_real) :: largest = 0.0_sph_real
        type(sph_vec) :: low, inverse_width, box
        ! first slot of each bucket; particle of each slot
        type(c_ptr) :: first = c_null_ptr, member = c_null_ptr
        ! coordinates of each slot, inside the box along periodic axes
        type(c_ptr) :: x = c_null_ptr, y = c_null_ptr, z = c_null_ptr
        ! radius of each slot, or null if all sources have the same
        type(c_ptr) :: own = c_null_ptr
        ! of each node of a tree: centre and half lengths of its box, largest radius
        type(c_ptr) :: node = c_null_ptr
    end type

    ! What is looked for: the neighbours of these targets, by this criterion, in lists with these flags.
    ! radius: the support radius R_i of each target, or one for all (sph_scalars_same); SPH_SCATTER does not
    ! read it. Those of the sources, R_j, are the grid's.
    type, bind(c) :: sph_query
        type(sph_points) :: targets
        ! an sph_criterion
        integer(c_int) :: criterion = 0
        type(sph_scalars) :: radius
        ! of sph_list_flags, added up
        integer(c_int) :: flags = 0
        ! target 0 is this source, target 1 the next, and so on; not with SPH_LIST_FOREIGN
        integer(sph_index) :: first = 0
    end type

    ! What a search finds. list and grid lie in the block of memory that the search was given, and may be used
    ! as long as it exists: for a cloud, for sph_grid_permutation, and for sph_grid_lists of other targets.
    type, bind(c) :: sph_neighbors
        ! entries of the list; after SPH_ERROR_CAPACITY, how many there must be room for
        integer(c_int64_t) :: pairs = 0
        ! null pointers where there is none
        type(sph_list) :: list
        ! empty where there is none
        type(sph_grid) :: grid
    end type

    ! Where the points of a part are, and how far their radii reach: two boxes along the axes. low > high if
    ! the part is empty. Numbers only, so that it can be sent to other machines.
    type, bind(c) :: sph_part
        type(sph_vec) :: low, high, reach_low, reach_high
    end type

    interface
        ! what the library was compiled as
        pure function sph_version_of() bind(c, name='sph_shim_version') result(answer)
            import
            integer(c_int) :: answer
        end function
        pure function sph_real_size() bind(c, name='sph_shim_real_size') result(answer)
            import
            integer(c_int) :: answer
        end function
        pure function sph_index_size() bind(c, name='sph_shim_index_size') result(answer)
            import
            integer(c_int) :: answer
        end function
        pure function c_struct_size(name) bind(c, name='sph_shim_struct_size') result(answer)
            import
            character(kind=c_char), intent(in) :: name(*)
            integer(c_size_t) :: answer
        end function
        ! the argument that was refused last with this error, and the first particle at fault (-1: none)
        function c_refused(error, particle) bind(c, name='sph_shim_refused') result(answer)
            import
            integer(c_int), value :: error
            integer(sph_index), intent(inout) :: particle
            type(c_ptr) :: answer
        end function
        ! W and F = (1/r) dW/dr of n distances
        function c_kernel_wf(kernel, dim, n, r, h, w, f) bind(c, name='sph_shim_kernel_wf') result(answer)
            import
            integer(c_int), value :: kernel, dim
            integer(sph_index), value :: n
            real(sph_real), intent(in) :: r(*)
            real(sph_real), value :: h
            real(sph_real), intent(inout) :: w(*), f(*)
            integer(c_int) :: answer
        end function
        ! scanned once, and marked
        function sph_cloud_checked(dim, cloud) bind(c, name='sph_shim_cloud_checked') result(answer)
            import
            integer(c_int), value :: dim
            type(sph_cloud), intent(inout) :: cloud
            integer(c_int) :: answer
        end function
        ! other targets: first ... last - 1, counted from 0
        subroutine sph_cloud_range(cloud, first, last) bind(c, name='sph_shim_cloud_range')
            import
            type(sph_cloud), intent(inout) :: cloud
            integer(sph_index), value :: first, last
        end subroutine
        ! support radius / h
        pure function sph_kernel_support_ratio(kernel) &
            bind(c, name='sph_shim_kernel_support_ratio') result(answer)
            import
            integer(c_int), value :: kernel
            real(sph_real) :: answer
        end function
        ! recommended h / particle spacing
        pure function sph_kernel_h_over_dx(kernel) bind(c, name='sph_shim_kernel_h_over_dx') result(answer)
            import
            integer(c_int), value :: kernel
            real(sph_real) :: answer
        end function
        ! the h of a kernel whose support has this radius
        pure function sph_kernel_h_from_support(kernel, support) &
            bind(c, name='sph_shim_kernel_h_from_support') result(answer)
            import
            integer(c_int), value :: kernel
            real(sph_real), value :: support
            real(sph_real) :: answer
        end function
        ! support radius
        pure function sph_kernel_support(kernel, h) bind(c, name='sph_shim_kernel_support') result(answer)
            import
            integer(c_int), value :: kernel
            real(sph_real), value :: h
            real(sph_real) :: answer
        end function
        ! normalisation
        pure function sph_kernel_sigma(kernel, dim) bind(c, name='sph_shim_kernel_sigma') result(answer)
            import
            integer(c_int), value :: kernel, dim
            real(sph_real) :: answer
        end function
        ! w(q) = W h^dim / sigma
        pure function sph_kernel_shape(kernel, dim, q) bind(c, name='sph_shim_kernel_shape') result(answer)
            import
            integer(c_int), value :: kernel, dim
            real(sph_real), value :: q
            real(sph_real) :: answer
        end function
        ! (1/q) dw/dq
        pure function sph_kernel_shape_f(kernel, dim, q) &
            bind(c, name='sph_shim_kernel_shape_f') result(answer)
            import
            integer(c_int), value :: kernel, dim
            real(sph_real), value :: q
            real(sph_real) :: answer
        end function
        ! d2w/dq2
        pure function sph_kernel_shape_d2(kernel, dim, q) &
            bind(c, name='sph_shim_kernel_shape_d2') result(answer)
            import
            integer(c_int), value :: kernel, dim
            real(sph_real), value :: q
            real(sph_real) :: answer
        end function
        ! W
        pure function sph_kernel_w(kernel, dim, r, h) bind(c, name='sph_shim_kernel_w') result(answer)
            import
            integer(c_int), value :: kernel, dim
            real(sph_real), value :: r, h
            real(sph_real) :: answer
        end function
        ! F = (1/r) dW/dr. At r = 0: its limit where that is finite, else 0
        pure function sph_kernel_f(kernel, dim, r, h) bind(c, name='sph_shim_kernel_f') result(answer)
            import
            integer(c_int), value :: kernel, dim
            real(sph_real), value :: r, h
            real(sph_real) :: answer
        end function
        ! dW/dr
        pure function sph_kernel_dwdr(kernel, dim, r, h) bind(c, name='sph_shim_kernel_dwdr') result(answer)
            import
            integer(c_int), value :: kernel, dim
            real(sph_real), value :: r, h
            real(sph_real) :: answer
        end function
        ! d2W/dr2
        pure function sph_kernel_d2wdr2(kernel, dim, r, h) &
            bind(c, name='sph_shim_kernel_d2wdr2') result(answer)
            import
            integer(c_int), value :: kernel, dim
            real(sph_real), value :: r, h
            real(sph_real) :: answer
        end function
        ! dW/dh at fixed r
        pure function sph_kernel_dwdh(kernel, dim, r, h) bind(c, name='sph_shim_kernel_dwdh') result(answer)
            import
            integer(c_int), value :: kernel, dim
            real(sph_real), value :: r, h
            real(sph_real) :: answer
        end function
        ! 1 if the slope at the origin is not 0 (F = 0 there, by convention)
        pure function sph_kernel_has_cusp(kernel) bind(c, name='sph_shim_kernel_has_cusp') result(answer)
            import
            integer(c_int), value :: kernel
            integer(c_int) :: answer
        end function
        ! 1 if W >= 0 and W' <= 0, so that the integral of its tail is a convex kernel
        pure function sph_kernel_may_convexify(kernel, dim) &
            bind(c, name='sph_shim_kernel_may_convexify') result(answer)
            import
            integer(c_int), value :: kernel, dim
            integer(c_int) :: answer
        end function
        ! C(r): pushes apart below 0.27 support, pulls beyond it
        pure function sph_cohesion_kernel_akinci(r, support) &
            bind(c, name='sph_shim_cohesion_kernel_akinci') result(answer)
            import
            real(sph_real), value :: r, support
            real(sph_real) :: answer
        end function
        ! A(r): pulls towards a wall beyond half of the support
        pure function sph_adhesion_kernel_akinci(r, support) &
            bind(c, name='sph_shim_adhesion_kernel_akinci') result(answer)
            import
            real(sph_real), value :: r, support
            real(sph_real) :: answer
        end function
        ! 1 for the kernels that the following functions know
        pure function sph_kernel_has_gravity(kernel) &
            bind(c, name='sph_shim_kernel_has_gravity') result(answer)
            import
            integer(c_int), value :: kernel
            integer(c_int) :: answer
        end function
        ! h^3 (1/r) dphi/dr
        pure function sph_gravity_shape_f(kernel, q) bind(c, name='sph_shim_gravity_shape_f') result(answer)
            import
            integer(c_int), value :: kernel
            real(sph_real), value :: q
            real(sph_real) :: answer
        end function
        ! h phi
        pure function sph_gravity_shape(kernel, q) bind(c, name='sph_shim_gravity_shape') result(answer)
            import
            integer(c_int), value :: kernel
            real(sph_real), value :: q
            real(sph_real) :: answer
        end function
        ! phi of a unit mass that is spread out like the kernel, with G = 1 in 3D; it is -1/r beyond the
        ! support
        pure function sph_gravity_potential(kernel, r, h) &
            bind(c, name='sph_shim_gravity_potential') result(answer)
            import
            integer(c_int), value :: kernel
            real(sph_real), value :: r, h
            real(sph_real) :: answer
        end function
        ! (1/r) dphi/dr: the acceleration is -G m x_ij times it
        pure function sph_gravity_force(kernel, r, h) bind(c, name='sph_shim_gravity_force') result(answer)
            import
            integer(c_int), value :: kernel
            real(sph_real), value :: r, h
            real(sph_real) :: answer
        end function
        ! dphi/dh at fixed r
        pure function sph_gravity_dphidh(kernel, r, h) bind(c, name='sph_shim_gravity_dphidh') result(answer)
            import
            integer(c_int), value :: kernel
            real(sph_real), value :: r, h
            real(sph_real) :: answer
        end function
        ! "wendland-c2"
        function c_kernel_name(kernel) bind(c, name='sph_shim_kernel_name') result(answer)
            import
            integer(c_int), value :: kernel
            type(c_ptr) :: answer
        end function
        ! the kernel, or -1. It also knows aliases (m4, cubic, w2, lucy, ...) and the names of other codes
        function c_kernel_from_name(name) bind(c, name='sph_shim_kernel_from_name') result(answer)
            import
            character(kind=c_char), intent(in) :: name(*)
            integer(c_int) :: answer
        end function
        ! the meaning of an error or status, in words
        function c_status_text(status) bind(c, name='sph_shim_status_text') result(answer)
            import
            integer(c_int), value :: status
            type(c_ptr) :: answer
        end function
        ! gamma_i = sum_j V_j W_ij, with itself
        function sph_shepard_sum(kernel, dim, cloud, out) bind(c, name='sph_shim_shepard_sum') result(answer)
            import
            integer(c_int), value :: kernel, dim
            type(sph_cloud), intent(in) :: cloud
            type(sph_scalar_out), intent(in) :: out
            integer(sph_index) :: answer
        end function
        ! sum_j V_j f_j W_ij / gamma_i
        function sph_interpolate_shepard(kernel, dim, cloud, f, out) &
            bind(c, name='sph_shim_interpolate_shepard') result(answer)
            import
            integer(c_int), value :: kernel, dim
            type(sph_cloud), intent(in) :: cloud
            type(sph_scalars), intent(in) :: f
            type(sph_scalar_out), intent(in) :: out
            integer(sph_index) :: answer
        end function
        ! sum_j m_j W_ij, with itself
        function sph_density_summation(kernel, dim, cloud, m, out) &
            bind(c, name='sph_shim_density_summation') result(answer)
            import
            integer(c_int), value :: kernel, dim
            type(sph_cloud), intent(in) :: cloud
            type(sph_scalars), intent(in) :: m
            type(sph_scalar_out), intent(in) :: out
            integer(sph_index) :: answer
        end function
        ! with the h that belongs to it, and Omega
        function sph_density_adaptive(kernel, dim, cloud, m, options, out) &
            bind(c, name='sph_shim_density_adaptive') result(answer)
            import
            integer(c_int), value :: kernel, dim
            type(sph_cloud), intent(in) :: cloud
            type(sph_scalars), intent(in) :: m
            type(sph_density_options), intent(in) :: options
            type(sph_density_out), intent(in) :: out
            integer(sph_index) :: answer
        end function
        pure function sph_laplacian_weight_brookshaw(kernel, dim, r, h, V_j) &
            bind(c, name='sph_shim_laplacian_weight_brookshaw') result(answer)
            import
            integer(c_int), value :: kernel, dim
            real(sph_real), value :: r, h, V_j
            real(sph_real) :: answer
        end function
        pure function sph_moment_weight_gradient(kernel, dim, r, h, V_j) &
            bind(c, name='sph_shim_moment_weight_gradient') result(answer)
            import
            integer(c_int), value :: kernel, dim
            real(sph_real), value :: r, h, V_j
            real(sph_real) :: answer
        end function
        pure function sph_moment_weight_iad(kernel, dim, r, h, V_j) &
            bind(c, name='sph_shim_moment_weight_iad') result(answer)
            import
            integer(c_int), value :: kernel, dim
            real(sph_real), value :: r, h, V_j
            real(sph_real) :: answer
        end function
        ! sum_j V_j (f_j - f_i) grad_i W_ij
        function sph_gradient_difference(kernel, dim, cloud, f, out) &
            bind(c, name='sph_shim_gradient_difference') result(answer)
            import
            integer(c_int), value :: kernel, dim
            type(sph_cloud), intent(in) :: cloud
            type(sph_scalars), intent(in) :: f
            type(sph_vector_out), intent(in) :: out
            integer(sph_index) :: answer
        end function
        ! corrected: exact for linear fields
        function sph_gradient_cspm(kernel, dim, cloud, f, out) &
            bind(c, name='sph_shim_gradient_cspm') result(answer)
            import
            integer(c_int), value :: kernel, dim
            type(sph_cloud), intent(in) :: cloud
            type(sph_scalars), intent(in) :: f
            type(sph_derivatives_out), intent(in) :: out
            integer(sph_index) :: answer
        end function
        ! likewise, without derivatives of W
        function sph_gradient_iad(kernel, dim, cloud, f, out) &
            bind(c, name='sph_shim_gradient_iad') result(answer)
            import
            integer(c_int), value :: kernel, dim
            type(sph_cloud), intent(in) :: cloud
            type(sph_scalars), intent(in) :: f
            type(sph_derivatives_out), intent(in) :: out
            integer(sph_index) :: answer
        end function
        ! the same as rows
        function sph_gradient_rows_cspm(kernel, dim, cloud, out) &
            bind(c, name='sph_shim_gradient_rows_cspm') result(answer)
            import
            integer(c_int), value :: kernel, dim
            type(sph_cloud), intent(in) :: cloud
            type(sph_gradient_rows_out), intent(in) :: out
            integer(sph_index) :: answer
        end function
        function sph_gradient_rows_iad(kernel, dim, cloud, out) &
            bind(c, name='sph_shim_gradient_rows_iad') result(answer)
            import
            integer(c_int), value :: kernel, dim
            type(sph_cloud), intent(in) :: cloud
            type(sph_gradient_rows_out), intent(in) :: out
            integer(sph_index) :: answer
        end function
        ! the matrices that correct
        function sph_gradient_correction_cspm(kernel, dim, cloud, out) &
            bind(c, name='sph_shim_gradient_correction_cspm') result(answer)
            import
            integer(c_int), value :: kernel, dim
            type(sph_cloud), intent(in) :: cloud
            type(sph_correction_out), intent(in) :: out
            integer(sph_index) :: answer
        end function
        function sph_gradient_correction_iad(kernel, dim, cloud, out) &
            bind(c, name='sph_shim_gradient_correction_iad') result(answer)
            import
            integer(c_int), value :: kernel, dim
            type(sph_cloud), intent(in) :: cloud
            type(sph_correction_out), intent(in) :: out
            integer(sph_index) :: answer
        end function
        ! sum_j 2 V_j (f_i - f_j) F_ij
        function sph_laplacian_brookshaw(kernel, dim, cloud, f, out) &
            bind(c, name='sph_shim_laplacian_brookshaw') result(answer)
            import
            integer(c_int), value :: kernel, dim
            type(sph_cloud), intent(in) :: cloud
            type(sph_scalars), intent(in) :: f
            type(sph_scalar_out), intent(in) :: out
            integer(sph_index) :: answer
        end function
        function sph_laplacian_rows_brookshaw(kernel, dim, cloud, out) &
            bind(c, name='sph_shim_laplacian_rows_brookshaw') result(answer)
            import
            integer(c_int), value :: kernel, dim
            type(sph_cloud), intent(in) :: cloud
            type(sph_rows_out), intent(in) :: out
            integer(sph_index) :: answer
        end function
        ! gradient, Hessian, Laplacian
        function sph_derivatives_cspm(kernel, dim, cloud, f, options, out) &
            bind(c, name='sph_shim_derivatives_cspm') result(answer)
            import
            integer(c_int), value :: kernel, dim
            type(sph_cloud), intent(in) :: cloud
            type(sph_scalars), intent(in) :: f
            type(sph_derivatives_options), intent(in) :: options
            type(sph_derivatives_out), intent(in) :: out
            integer(sph_index) :: answer
        end function
        ! exact for quadratics
        function sph_derivatives_icspm(kernel, dim, cloud, f, options, out) &
            bind(c, name='sph_shim_derivatives_icspm') result(answer)
            import
            integer(c_int), value :: kernel, dim
            type(sph_cloud), intent(in) :: cloud
            type(sph_scalars), intent(in) :: f
            type(sph_derivatives_options), intent(in) :: options
            type(sph_derivatives_out), intent(in) :: out
            integer(sph_index) :: answer
        end function
        ! likewise; keeps signs
        function sph_derivatives_fatehi_manzari(kernel, dim, cloud, f, options, out) &
            bind(c, name='sph_shim_derivatives_fatehi_manzari') result(answer)
            import
            integer(c_int), value :: kernel, dim
            type(sph_cloud), intent(in) :: cloud
            type(sph_scalars), intent(in) :: f
            type(sph_derivatives_options), intent(in) :: options
            type(sph_derivatives_out), intent(in) :: out
            integer(sph_index) :: answer
        end function
        ! likewise, by least squares: robust
        function sph_derivatives_wls(kernel, dim, cloud, f, options, out) &
            bind(c, name='sph_shim_derivatives_wls') result(answer)
            import
            integer(c_int), value :: kernel, dim
            type(sph_cloud), intent(in) :: cloud
            type(sph_scalars), intent(in) :: f
            type(sph_derivatives_options), intent(in) :: options
            type(sph_derivatives_out), intent(in) :: out
            integer(sph_index) :: answer
        end function
        ! rows of a combination d of derivatives
        function sph_derivatives_rows_cspm(kernel, dim, cloud, d, out) &
            bind(c, name='sph_shim_derivatives_rows_cspm') result(answer)
            import
            integer(c_int), value :: kernel, dim
            type(sph_cloud), intent(in) :: cloud
            type(sph_jet), intent(in) :: d
            type(sph_rows_out), intent(in) :: out
            integer(sph_index) :: answer
        end function
        ! with the factor kappa
        function sph_derivatives_rows_icspm(kernel, dim, cloud, d, out) &
            bind(c, name='sph_shim_derivatives_rows_icspm') result(answer)
            import
            integer(c_int), value :: kernel, dim
            type(sph_cloud), intent(in) :: cloud
            type(sph_jet), intent(in) :: d
            type(sph_rows_out), intent(in) :: out
            integer(sph_index) :: answer
        end function
        function sph_derivatives_rows_fatehi_manzari(kernel, dim, cloud, d, out) &
            bind(c, name='sph_shim_derivatives_rows_fatehi_manzari') result(answer)
            import
            integer(c_int), value :: kernel, dim
            type(sph_cloud), intent(in) :: cloud
            type(sph_jet), intent(in) :: d
            type(sph_rows_out), intent(in) :: out
            integer(sph_index) :: answer
        end function
        function sph_derivatives_rows_wls(kernel, dim, cloud, d, out) &
            bind(c, name='sph_shim_derivatives_rows_wls') result(answer)
            import
            integer(c_int), value :: kernel, dim
            type(sph_cloud), intent(in) :: cloud
            type(sph_jet), intent(in) :: d
            type(sph_rows_out), intent(in) :: out
            integer(sph_index) :: answer
        end function
        pure function sph_boundary_weight_bim(kernel, e, normal, h) &
            bind(c, name='sph_shim_boundary_weight_bim') result(answer)
            import
            integer(c_int), value :: kernel
            real(sph_real), value :: e, normal, h
            real(sph_real) :: answer
        end function
        ! 1D, with boundary integrals
        function sph_second_derivative_bim(kernel, cloud, f, left, right, out) &
            bind(c, name='sph_shim_second_derivative_bim') result(answer)
            import
            integer(c_int), value :: kernel
            type(sph_cloud), intent(in) :: cloud
            type(sph_scalars), intent(in) :: f
            integer(sph_index), value :: left, right
            type(sph_scalar_out), intent(in) :: out
            integer(sph_index) :: answer
        end function
        function sph_second_derivative_rows_bim(kernel, cloud, left, right, out) &
            bind(c, name='sph_shim_second_derivative_rows_bim') result(answer)
            import
            integer(c_int), value :: kernel
            type(sph_cloud), intent(in) :: cloud
            integer(sph_index), value :: left, right
            type(sph_rows_out), intent(in) :: out
            integer(sph_index) :: answer
        end function
        ! moving least squares: exact for linear fields
        function sph_interpolate_mls(kernel, dim, targets_of, sources, f, options, out) &
            bind(c, name='sph_shim_interpolate_mls') result(answer)
            import
            integer(c_int), value :: kernel, dim
            type(sph_cloud), intent(in) :: targets_of
            type(sph_sources), intent(in) :: sources
            type(sph_scalars), intent(in) :: f
            type(sph_interpolation_options), intent(in) :: options
            type(sph_interpolation_out), intent(in) :: out
            integer(sph_index) :: answer
        end function
        ! of mDBC walls
        function sph_interpolate_liu(kernel, dim, targets_of, sources, f, options, out) &
            bind(c, name='sph_shim_interpolate_liu') result(answer)
            import
            integer(c_int), value :: kernel, dim
            type(sph_cloud), intent(in) :: targets_of
            type(sph_sources), intent(in) :: sources
            type(sph_scalars), intent(in) :: f
            type(sph_interpolation_options), intent(in) :: options
            type(sph_interpolation_out), intent(in) :: out
            integer(sph_index) :: answer
        end function
        ! the same as rows
        function sph_interpolate_rows_mls(kernel, dim, targets_of, sources, options, out) &
            bind(c, name='sph_shim_interpolate_rows_mls') result(answer)
            import
            integer(c_int), value :: kernel, dim
            type(sph_cloud), intent(in) :: targets_of
            type(sph_sources), intent(in) :: sources
            type(sph_interpolation_options), intent(in) :: options
            type(sph_interpolation_rows_out), intent(in) :: out
            integer(sph_index) :: answer
        end function
        function sph_interpolate_rows_liu(kernel, dim, targets_of, sources, options, out) &
            bind(c, name='sph_shim_interpolate_rows_liu') result(answer)
            import
            integer(c_int), value :: kernel, dim
            type(sph_cloud), intent(in) :: targets_of
            type(sph_sources), intent(in) :: sources
            type(sph_interpolation_options), intent(in) :: options
            type(sph_interpolation_rows_out), intent(in) :: out
            integer(sph_index) :: answer
        end function
        pure function sph_mobility_pair(mean, m_i, m_j, upstream) &
            bind(c, name='sph_shim_mobility_pair') result(answer)
            import
            integer(c_int), value :: mean
            real(sph_real), value :: m_i, m_j, upstream
            real(sph_real) :: answer
        end function
        ! sum_j V_j (m_i + m_j) (u_i - u_j) F_ij
        function sph_elliptic_brookshaw(kernel, dim, cloud, m, options, u, out) &
            bind(c, name='sph_shim_elliptic_brookshaw') result(answer)
            import
            integer(c_int), value :: kernel, dim
            type(sph_cloud), intent(in) :: cloud
            type(sph_scalars), intent(in) :: m
            type(sph_elliptic_options), intent(in) :: options
            type(sph_scalars), intent(in) :: u
            type(sph_scalar_out), intent(in) :: out
            integer(sph_index) :: answer
        end function
        ! times tr C / dim
        function sph_elliptic_brookshaw_corrected(kernel, dim, cloud, m, options, u, out) &
            bind(c, name='sph_shim_elliptic_brookshaw_corrected') result(answer)
            import
            integer(c_int), value :: kernel, dim
            type(sph_cloud), intent(in) :: cloud
            type(sph_scalars), intent(in) :: m
            type(sph_elliptic_options), intent(in) :: options
            type(sph_scalars), intent(in) :: u
            type(sph_scalar_out), intent(in) :: out
            integer(sph_index) :: answer
        end function
        ! exact for linear u and constant m
        function sph_elliptic_schwaiger(kernel, dim, cloud, m, options, u, out) &
            bind(c, name='sph_shim_elliptic_schwaiger') result(answer)
            import
            integer(c_int), value :: kernel, dim
            type(sph_cloud), intent(in) :: cloud
            type(sph_scalars), intent(in) :: m
            type(sph_elliptic_options), intent(in) :: options
            type(sph_scalars), intent(in) :: u
            type(sph_scalar_out), intent(in) :: out
            integer(sph_index) :: answer
        end function
        ! the same numbers for radial gradients
        function sph_elliptic_msph(kernel, dim, cloud, m, options, u, out) &
            bind(c, name='sph_shim_elliptic_msph') result(answer)
            import
            integer(c_int), value :: kernel, dim
            type(sph_cloud), intent(in) :: cloud
            type(sph_scalars), intent(in) :: m
            type(sph_elliptic_options), intent(in) :: options
            type(sph_scalars), intent(in) :: u
            type(sph_scalar_out), intent(in) :: out
            integer(sph_index) :: answer
        end function
        ! without derivatives of the kernel; exact for |x|^2
        function sph_elliptic_basic_degiuli_ban(kernel, dim, cloud, m, options, u, out) &
            bind(c, name='sph_shim_elliptic_basic_degiuli_ban') result(answer)
            import
            integer(c_int), value :: kernel, dim
            type(sph_cloud), intent(in) :: cloud
            type(sph_scalars), intent(in) :: m
            type(sph_elliptic_options), intent(in) :: options
            type(sph_scalars), intent(in) :: u
            type(sph_scalar_out), intent(in) :: out
            integer(sph_index) :: answer
        end function
        ! rows (meshless transmissibilities)
        function sph_elliptic_rows_brookshaw(kernel, dim, cloud, m, options, out) &
            bind(c, name='sph_shim_elliptic_rows_brookshaw') result(answer)
            import
            integer(c_int), value :: kernel, dim
            type(sph_cloud), intent(in) :: cloud
            type(sph_scalars), intent(in) :: m
            type(sph_elliptic_options), intent(in) :: options
            type(sph_rows_out), intent(in) :: out
            integer(sph_index) :: answer
        end function
        function sph_elliptic_rows_brookshaw_corrected(kernel, dim, cloud, m, options, out) &
            bind(c, name='sph_shim_elliptic_rows_brookshaw_corrected') result(answer)
            import
            integer(c_int), value :: kernel, dim
            type(sph_cloud), intent(in) :: cloud
            type(sph_scalars), intent(in) :: m
            type(sph_elliptic_options), intent(in) :: options
            type(sph_rows_out), intent(in) :: out
            integer(sph_index) :: answer
        end function
        function sph_elliptic_rows_schwaiger(kernel, dim, cloud, m, options, out) &
            bind(c, name='sph_shim_elliptic_rows_schwaiger') result(answer)
            import
            integer(c_int), value :: kernel, dim
            type(sph_cloud), intent(in) :: cloud
            type(sph_scalars), intent(in) :: m
            type(sph_elliptic_options), intent(in) :: options
            type(sph_rows_out), intent(in) :: out
            integer(sph_index) :: answer
        end function
        function sph_elliptic_rows_msph(kernel, dim, cloud, m, options, out) &
            bind(c, name='sph_shim_elliptic_rows_msph') result(answer)
            import
            integer(c_int), value :: kernel, dim
            type(sph_cloud), intent(in) :: cloud
            type(sph_scalars), intent(in) :: m
            type(sph_elliptic_options), intent(in) :: options
            type(sph_rows_out), intent(in) :: out
            integer(sph_index) :: answer
        end function
        function sph_elliptic_rows_basic_degiuli_ban(kernel, dim, cloud, m, options, out) &
            bind(c, name='sph_shim_elliptic_rows_basic_degiuli_ban') result(answer)
            import
            integer(c_int), value :: kernel, dim
            type(sph_cloud), intent(in) :: cloud
            type(sph_scalars), intent(in) :: m
            type(sph_elliptic_options), intent(in) :: options
            type(sph_rows_out), intent(in) :: out
            integer(sph_index) :: answer
        end function
        ! signs, moments, free-surface indicator
        function sph_elliptic_diagnose(kernel, dim, cloud, options, out) &
            bind(c, name='sph_shim_elliptic_diagnose') result(answer)
            import
            integer(c_int), value :: kernel, dim
            type(sph_cloud), intent(in) :: cloud
            type(sph_elliptic_options), intent(in) :: options
            type(sph_elliptic_report), intent(in) :: out
            integer(sph_index) :: answer
        end function
        ! div(M grad u), M diagonal
        function sph_elliptic_rows_anisotropic(kernel, dim, cloud, mobility, out) &
            bind(c, name='sph_shim_elliptic_rows_anisotropic') result(answer)
            import
            integer(c_int), value :: kernel, dim
            type(sph_cloud), intent(in) :: cloud
            type(sph_diagonal), intent(in) :: mobility
            type(sph_rows_out), intent(in) :: out
            integer(sph_index) :: answer
        end function
        ! div(M grad u) for any symmetric M
        function sph_elliptic_tensor(kernel, dim, cloud, mobility, u, out) &
            bind(c, name='sph_shim_elliptic_tensor') result(answer)
            import
            integer(c_int), value :: kernel, dim
            type(sph_cloud), intent(in) :: cloud
            type(sph_matrices), intent(in) :: mobility
            type(sph_scalars), intent(in) :: u
            type(sph_scalar_out), intent(in) :: out
            integer(sph_index) :: answer
        end function
        function sph_elliptic_rows_tensor(kernel, dim, cloud, mobility, out) &
            bind(c, name='sph_shim_elliptic_rows_tensor') result(answer)
            import
            integer(c_int), value :: kernel, dim
            type(sph_cloud), intent(in) :: cloud
            type(sph_matrices), intent(in) :: mobility
            type(sph_rows_out), intent(in) :: out
            integer(sph_index) :: answer
        end function
        ! Dirichlet, Neumann, Robin
        function sph_elliptic_rows_boundary(kernel, dim, cloud, m, options, boundary, out) &
            bind(c, name='sph_shim_elliptic_rows_boundary') result(answer)
            import
            integer(c_int), value :: kernel, dim
            type(sph_cloud), intent(in) :: cloud
            type(sph_scalars), intent(in) :: m
            type(sph_elliptic_options), intent(in) :: options
            type(sph_boundary), intent(in) :: boundary
            type(sph_rows_out), intent(in) :: out
            integer(sph_index) :: answer
        end function
        ! sum_p row[p] (u_j - u_i)
        function sph_rows_apply(cloud, row, diagonal, u, out) &
            bind(c, name='sph_shim_rows_apply') result(answer)
            import
            type(sph_cloud), intent(in) :: cloud
            real(sph_real), intent(in) :: row(*)
            type(sph_scalars), intent(in) :: diagonal, u
            type(sph_scalar_out), intent(in) :: out
            integer(sph_index) :: answer
        end function
        ! how many rows are not of an M-matrix
        function sph_rows_monotone(cloud, row, diagonal, monotone) &
            bind(c, name='sph_shim_rows_monotone') result(answer)
            import
            type(sph_cloud), intent(in) :: cloud
            real(sph_real), intent(in) :: row(*)
            type(sph_scalars), intent(in) :: diagonal
            integer(sph_state), intent(inout) :: monotone(*)
            integer(sph_index) :: answer
        end function
        ! longest stable explicit step
        function sph_rows_time_step(cloud, row, dt) bind(c, name='sph_shim_rows_time_step') result(answer)
            import
            type(sph_cloud), intent(in) :: cloud
            real(sph_real), intent(in) :: row(*)
            real(sph_real), intent(inout) :: dt(*)
            integer(sph_index) :: answer
        end function
        ! von Neumann's growth factor
        function sph_rows_growth(dim, cloud, row, tau, wave, re, im) &
            bind(c, name='sph_shim_rows_growth') result(answer)
            import
            integer(c_int), value :: dim
            type(sph_cloud), intent(in) :: cloud
            real(sph_real), intent(in) :: row(*)
            real(sph_real), value :: tau
            type(sph_vec), intent(in) :: wave
            real(sph_real), intent(inout) :: re(*), im(*)
            integer(sph_index) :: answer
        end function
        ! entries of the matrix, at most
        function sph_csr_size(cloud) bind(c, name='sph_shim_csr_size') result(answer)
            import
            type(sph_cloud), intent(in) :: cloud
            integer(c_int64_t) :: answer
        end function
        function sph_csr_assemble(cloud, row, diagonal, drop_zeros, out, entries) &
            bind(c, name='sph_shim_csr_assemble') result(answer)
            import
            type(sph_cloud), intent(in) :: cloud
            real(sph_real), intent(in) :: row(*)
            type(sph_scalars), intent(in) :: diagonal
            integer(c_int), value :: drop_zeros
            type(sph_csr), intent(in) :: out
            integer(c_int64_t), intent(inout) :: entries
            integer(sph_index) :: answer
        end function
        pure function sph_signal_speed(c_i, c_j, beta_w) bind(c, name='sph_shim_signal_speed') result(answer)
            import
            real(sph_real), value :: c_i, c_j, beta_w
            real(sph_real) :: answer
        end function
        pure function sph_viscosity_signal_of(alpha_speed, w, per_rho) &
            bind(c, name='sph_shim_viscosity_signal') result(answer)
            import
            real(sph_real), value :: alpha_speed, w, per_rho
            real(sph_real) :: answer
        end function
        pure function sph_kernel_f_apart(kernel, dim, r, h) &
            bind(c, name='sph_shim_kernel_f_apart') result(answer)
            import
            integer(c_int), value :: kernel, dim
            real(sph_real), value :: r, h
            real(sph_real) :: answer
        end function
        pure function sph_time_step_sound(h, c, speed) bind(c, name='sph_shim_time_step_sound') result(answer)
            import
            real(sph_real), value :: h, c, speed
            real(sph_real) :: answer
        end function
        pure function sph_time_step_force(h, acceleration) &
            bind(c, name='sph_shim_time_step_force') result(answer)
            import
            real(sph_real), value :: h, acceleration
            real(sph_real) :: answer
        end function
        pure function sph_time_step_viscous_nu(h, nu) &
            bind(c, name='sph_shim_time_step_viscous_nu') result(answer)
            import
            real(sph_real), value :: h, nu
            real(sph_real) :: answer
        end function
        ! m_i sum_j W_ij
        function sph_density_number(kernel, dim, cloud, m, out) &
            bind(c, name='sph_shim_density_number') result(answer)
            import
            integer(c_int), value :: kernel, dim
            type(sph_cloud), intent(in) :: cloud
            type(sph_scalars), intent(in) :: m
            type(sph_scalar_out), intent(in) :: out
            integer(sph_index) :: answer
        end function
        ! acceleration, density, heating
        function sph_fluid_rates_monaghan(kernel, dim, cloud, fluid, out) &
            bind(c, name='sph_shim_fluid_rates_monaghan') result(answer)
            import
            integer(c_int), value :: kernel, dim
            type(sph_cloud), intent(in) :: cloud
            type(sph_fluid), intent(in) :: fluid
            type(sph_fluid_out), intent(in) :: out
            integer(sph_index) :: answer
        end function
        function sph_fluid_rates_colagrossi(kernel, dim, cloud, fluid, out) &
            bind(c, name='sph_shim_fluid_rates_colagrossi') result(answer)
            import
            integer(c_int), value :: kernel, dim
            type(sph_cloud), intent(in) :: cloud
            type(sph_fluid), intent(in) :: fluid
            type(sph_fluid_out), intent(in) :: out
            integer(sph_index) :: answer
        end function
        function sph_fluid_rates_hu_adams(kernel, dim, cloud, fluid, out) &
            bind(c, name='sph_shim_fluid_rates_hu_adams') result(answer)
            import
            integer(c_int), value :: kernel, dim
            type(sph_cloud), intent(in) :: cloud
            type(sph_fluid), intent(in) :: fluid
            type(sph_fluid_out), intent(in) :: out
            integer(sph_index) :: answer
        end function
        ! physical viscosity
        function sph_viscosity_mu_morris(kernel, dim, cloud, fluid, mu, acceleration) &
            bind(c, name='sph_shim_viscosity_mu_morris') result(answer)
            import
            integer(c_int), value :: kernel, dim
            type(sph_cloud), intent(in) :: cloud
            type(sph_fluid), intent(in) :: fluid
            type(sph_scalars), intent(in) :: mu
            type(sph_vector_out), intent(in) :: acceleration
            integer(sph_index) :: answer
        end function
        function sph_viscosity_mu_monaghan_cleary(kernel, dim, cloud, fluid, mu, acceleration) &
            bind(c, name='sph_shim_viscosity_mu_monaghan_cleary') result(answer)
            import
            integer(c_int), value :: kernel, dim
            type(sph_cloud), intent(in) :: cloud
            type(sph_fluid), intent(in) :: fluid
            type(sph_scalars), intent(in) :: mu
            type(sph_vector_out), intent(in) :: acceleration
            integer(sph_index) :: answer
        end function
        ! with shear and bulk viscosity
        function sph_viscosity_mu_espanol_revenga(kernel, dim, cloud, fluid, mu, acceleration) &
            bind(c, name='sph_shim_viscosity_mu_espanol_revenga') result(answer)
            import
            integer(c_int), value :: kernel, dim
            type(sph_cloud), intent(in) :: cloud
            type(sph_fluid), intent(in) :: fluid
            type(sph_shear_bulk), intent(in) :: mu
            type(sph_vector_out), intent(in) :: acceleration
            integer(sph_index) :: answer
        end function
        function sph_velocity_xsph(kernel, dim, cloud, fluid, epsilon, change) &
            bind(c, name='sph_shim_velocity_xsph') result(answer)
            import
            integer(c_int), value :: kernel, dim
            type(sph_cloud), intent(in) :: cloud
            type(sph_fluid), intent(in) :: fluid
            real(sph_real), value :: epsilon
            type(sph_vector_out), intent(in) :: change
            integer(sph_index) :: answer
        end function
        ! pressure and velocity of wall particles
        function sph_wall_adami(kernel, dim, cloud, wall, out) &
            bind(c, name='sph_shim_wall_adami') result(answer)
            import
            integer(c_int), value :: kernel, dim
            type(sph_cloud), intent(in) :: cloud
            type(sph_wall), intent(in) :: wall
            type(sph_wall_out), intent(in) :: out
            integer(sph_index) :: answer
        end function
        ! the same pressure as rows of a matrix
        function sph_wall_rows_adami(kernel, dim, cloud, wall, out, source) &
            bind(c, name='sph_shim_wall_rows_adami') result(answer)
            import
            integer(c_int), value :: kernel, dim
            type(sph_cloud), intent(in) :: cloud
            type(sph_wall), intent(in) :: wall
            type(sph_rows_out), intent(in) :: out
            type(sph_scalar_out), intent(in) :: source
            integer(sph_index) :: answer
        end function
        ! rows of the fluid without unknowns of the wall
        function sph_wall_rows_eliminate(dim, cloud, wall, rows, source) &
            bind(c, name='sph_shim_wall_rows_eliminate') result(answer)
            import
            integer(c_int), value :: dim
            type(sph_cloud), intent(in) :: cloud
            type(sph_wall), intent(in) :: wall
            type(sph_rows_out), intent(in) :: rows
            type(sph_scalar_out), intent(in) :: source
            integer(sph_index) :: answer
        end function
        pure function sph_density_diffusion_weight(V_j, strength, f_ij) &
            bind(c, name='sph_shim_density_diffusion_weight') result(answer)
            import
            real(sph_real), value :: V_j, strength, f_ij
            real(sph_real) :: answer
        end function
        pure function sph_time_step_density_diffusion(kernel, dim, h, delta, c) &
            bind(c, name='sph_shim_time_step_density_diffusion') result(answer)
            import
            integer(c_int), value :: kernel, dim
            real(sph_real), value :: h, delta, c
            real(sph_real) :: answer
        end function
        ! density rate with density diffusion
        function sph_density_diffusion_molteni(kernel, dim, cloud, diffusion, out) &
            bind(c, name='sph_shim_density_diffusion_molteni') result(answer)
            import
            integer(c_int), value :: kernel, dim
            type(sph_cloud), intent(in) :: cloud
            type(sph_diffusion), intent(in) :: diffusion
            type(sph_scalar_out), intent(in) :: out
            integer(sph_index) :: answer
        end function
        ! delta-SPH
        function sph_density_diffusion_antuono(kernel, dim, cloud, diffusion, out) &
            bind(c, name='sph_shim_density_diffusion_antuono') result(answer)
            import
            integer(c_int), value :: kernel, dim
            type(sph_cloud), intent(in) :: cloud
            type(sph_diffusion), intent(in) :: diffusion
            type(sph_scalar_out), intent(in) :: out
            integer(sph_index) :: answer
        end function
        function sph_density_diffusion_fourtakas(kernel, dim, cloud, diffusion, out) &
            bind(c, name='sph_shim_density_diffusion_fourtakas') result(answer)
            import
            integer(c_int), value :: kernel, dim
            type(sph_cloud), intent(in) :: cloud
            type(sph_diffusion), intent(in) :: diffusion
            type(sph_scalar_out), intent(in) :: out
            integer(sph_index) :: answer
        end function
        function sph_density_diffusion_rows_molteni(kernel, dim, cloud, diffusion, out) &
            bind(c, name='sph_shim_density_diffusion_rows_molteni') result(answer)
            import
            integer(c_int), value :: kernel, dim
            type(sph_cloud), intent(in) :: cloud
            type(sph_diffusion), intent(in) :: diffusion
            type(sph_rows_out), intent(in) :: out
            integer(sph_index) :: answer
        end function
        ! div r, lambda, normal
        function sph_free_surface(kernel, dim, cloud, out) &
            bind(c, name='sph_shim_free_surface') result(answer)
            import
            integer(c_int), value :: kernel, dim
            type(sph_cloud), intent(in) :: cloud
            type(sph_surface_out), intent(in) :: out
            integer(sph_index) :: answer
        end function
        ! which particles are the surface
        function sph_free_surface_cone(dim, cloud, eigenvalue, normal, flag) &
            bind(c, name='sph_shim_free_surface_cone') result(answer)
            import
            integer(c_int), value :: dim
            type(sph_cloud), intent(in) :: cloud
            type(sph_scalars), intent(in) :: eigenvalue
            type(sph_vectors), intent(in) :: normal
            integer(sph_state), intent(inout) :: flag(*)
            integer(sph_index) :: answer
        end function
        pure function sph_shift_strength_skillen(factor, h, path) &
            bind(c, name='sph_shim_shift_strength_skillen') result(answer)
            import
            real(sph_real), value :: factor, h, path
            real(sph_real) :: answer
        end function
        pure function sph_shift_strength_sun(h, path, length) &
            bind(c, name='sph_shim_shift_strength_sun') result(answer)
            import
            real(sph_real), value :: h, path, length
            real(sph_real) :: answer
        end function
        ! keeps particles even
        function sph_shift_displacement(kernel, dim, cloud, shift, out) &
            bind(c, name='sph_shim_shift_displacement') result(answer)
            import
            integer(c_int), value :: kernel, dim
            type(sph_cloud), intent(in) :: cloud
            type(sph_shift), intent(in) :: shift
            type(sph_vector_out), intent(in) :: out
            integer(sph_index) :: answer
        end function
        ! what particles that are shifted carry
        function sph_shift_rates(kernel, dim, cloud, fluid, shift, out) &
            bind(c, name='sph_shim_shift_rates') result(answer)
            import
            integer(c_int), value :: kernel, dim
            type(sph_cloud), intent(in) :: cloud
            type(sph_fluid), intent(in) :: fluid
            type(sph_vectors), intent(in) :: shift
            type(sph_fluid_out), intent(in) :: out
            integer(sph_index) :: answer
        end function
        function sph_transport_adami(kernel, dim, cloud, fluid, transport, background, out) &
            bind(c, name='sph_shim_transport_adami') result(answer)
            import
            integer(c_int), value :: kernel, dim
            type(sph_cloud), intent(in) :: cloud
            type(sph_fluid), intent(in) :: fluid
            type(sph_vectors), intent(in) :: transport
            real(sph_real), value :: background
            type(sph_transport_out), intent(in) :: out
            integer(sph_index) :: answer
        end function
        ! alpha of DFSPH
        function sph_pressure_factor_dfsph(kernel, dim, cloud, fluid, moves, out) &
            bind(c, name='sph_shim_pressure_factor_dfsph') result(answer)
            import
            integer(c_int), value :: kernel, dim
            type(sph_cloud), intent(in) :: cloud
            type(sph_fluid), intent(in) :: fluid
            type(sph_scalars), intent(in) :: moves
            type(sph_scalar_out), intent(in) :: out
            integer(sph_index) :: answer
        end function
        ! fluid rates with the dissipation of a Riemann solver
        function sph_fluid_rates_riemann(kernel, dim, cloud, fluid, options, out) &
            bind(c, name='sph_shim_fluid_rates_riemann') result(answer)
            import
            integer(c_int), value :: kernel, dim
            type(sph_cloud), intent(in) :: cloud
            type(sph_fluid), intent(in) :: fluid
            type(sph_riemann_options), intent(in) :: options
            type(sph_fluid_out), intent(in) :: out
            integer(sph_index) :: answer
        end function
        ! by the stress: keeps momentum
        function sph_tension_css(kernel, dim, cloud, tension, acceleration) &
            bind(c, name='sph_shim_tension_css') result(answer)
            import
            integer(c_int), value :: kernel, dim
            type(sph_cloud), intent(in) :: cloud
            type(sph_tension), intent(in) :: tension
            type(sph_vector_out), intent(in) :: acceleration
            integer(sph_index) :: answer
        end function
        ! by the curvature, and the curvature
        function sph_tension_csf(kernel, dim, cloud, tension, out) &
            bind(c, name='sph_shim_tension_csf') result(answer)
            import
            integer(c_int), value :: kernel, dim
            type(sph_cloud), intent(in) :: cloud
            type(sph_tension), intent(in) :: tension
            type(sph_tension_out), intent(in) :: out
            integer(sph_index) :: answer
        end function
        ! gamma and grad gamma, exact
        function sph_wall_gamma(kernel, dim, cloud, elements, out) &
            bind(c, name='sph_shim_wall_gamma') result(answer)
            import
            integer(c_int), value :: kernel, dim
            type(sph_cloud), intent(in) :: cloud
            type(sph_wall_elements), intent(in) :: elements
            type(sph_wall_gamma_out), intent(in) :: out
            integer(sph_index) :: answer
        end function
        ! in sum form
        function sph_wall_gradient(kernel, dim, cloud, wall, f, out) &
            bind(c, name='sph_shim_wall_gradient') result(answer)
            import
            integer(c_int), value :: kernel, dim
            type(sph_cloud), intent(in) :: cloud
            type(sph_wall_terms), intent(in) :: wall
            type(sph_scalars), intent(in) :: f
            type(sph_vector_out), intent(in) :: out
            integer(sph_index) :: answer
        end function
        ! the same as rows
        function sph_wall_gradient_rows(kernel, dim, cloud, wall, out, source) &
            bind(c, name='sph_shim_wall_gradient_rows') result(answer)
            import
            integer(c_int), value :: kernel, dim
            type(sph_cloud), intent(in) :: cloud
            type(sph_wall_terms), intent(in) :: wall
            type(sph_gradient_rows_out), intent(in) :: out
            type(sph_vector_out), intent(in) :: source
            integer(sph_index) :: answer
        end function
        ! BIM in more than one dimension
        function sph_wall_laplacian(kernel, dim, cloud, wall, f, out) &
            bind(c, name='sph_shim_wall_laplacian') result(answer)
            import
            integer(c_int), value :: kernel, dim
            type(sph_cloud), intent(in) :: cloud
            type(sph_wall_terms), intent(in) :: wall
            type(sph_scalars), intent(in) :: f
            type(sph_scalar_out), intent(in) :: out
            integer(sph_index) :: answer
        end function
        function sph_wall_laplacian_rows(kernel, dim, cloud, wall, out, source) &
            bind(c, name='sph_shim_wall_laplacian_rows') result(answer)
            import
            integer(c_int), value :: kernel, dim
            type(sph_cloud), intent(in) :: cloud
            type(sph_wall_terms), intent(in) :: wall
            type(sph_rows_out), intent(in) :: out
            type(sph_scalar_out), intent(in) :: source
            integer(sph_index) :: answer
        end function
        function sph_collision_sequential(dim, cloud, collision, velocity, out) &
            bind(c, name='sph_shim_collision_sequential') result(answer)
            import
            integer(c_int), value :: dim
            type(sph_cloud), intent(in) :: cloud
            type(sph_collision), intent(in) :: collision
            type(sph_vector_out), intent(in) :: velocity
            type(sph_collision_report), intent(inout) :: out
            integer(sph_index) :: answer
        end function
        function sph_collision_count(dim, cloud, collision, v, count) &
            bind(c, name='sph_shim_collision_count') result(answer)
            import
            integer(c_int), value :: dim
            type(sph_cloud), intent(in) :: cloud
            type(sph_collision), intent(in) :: collision
            type(sph_vectors), intent(in) :: v
            integer(sph_index), intent(inout) :: count(*)
            integer(sph_index) :: answer
        end function
        function sph_collision_change_weighted(dim, cloud, collision, v, count, change) &
            bind(c, name='sph_shim_collision_change_weighted') result(answer)
            import
            integer(c_int), value :: dim
            type(sph_cloud), intent(in) :: cloud
            type(sph_collision), intent(in) :: collision
            type(sph_vectors), intent(in) :: v
            integer(sph_index), intent(in) :: count(*)
            type(sph_vector_out), intent(in) :: change
            integer(sph_index) :: answer
        end function
        pure function sph_conductivity_speed(P_i, P_j, per_rho) &
            bind(c, name='sph_shim_conductivity_speed') result(answer)
            import
            real(sph_real), value :: P_i, P_j, per_rho
            real(sph_real) :: answer
        end function
        pure function sph_shock_pair(m_j, div_j, w_ij) bind(c, name='sph_shim_shock_pair') result(answer)
            import
            real(sph_real), value :: m_j, div_j, w_ij
            real(sph_real) :: answer
        end function
        pure function sph_shock_value(sum, rho) bind(c, name='sph_shim_shock_value') result(answer)
            import
            real(sph_real), value :: sum, rho
            real(sph_real) :: answer
        end function
        ! momentum, energy, div v, v_sig
        function sph_gas_rates(kernel, dim, cloud, state, out) &
            bind(c, name='sph_shim_gas_rates') result(answer)
            import
            integer(c_int), value :: kernel, dim
            type(sph_cloud), intent(in) :: cloud
            type(sph_gas), intent(in) :: state
            type(sph_gas_out), intent(in) :: out
            integer(sph_index) :: answer
        end function
        ! div v, |curl v|, shear
        function sph_velocity_gradient_difference(kernel, dim, cloud, medium, v, out) &
            bind(c, name='sph_shim_velocity_gradient_difference') result(answer)
            import
            integer(c_int), value :: kernel, dim
            type(sph_cloud), intent(in) :: cloud
            type(sph_medium), intent(in) :: medium
            type(sph_vectors), intent(in) :: v
            type(sph_velocity_gradient_out), intent(in) :: out
            integer(sph_index) :: answer
        end function
        ! the same, exact for linear v
        function sph_velocity_gradient_cspm(kernel, dim, cloud, v, out) &
            bind(c, name='sph_shim_velocity_gradient_cspm') result(answer)
            import
            integer(c_int), value :: kernel, dim
            type(sph_cloud), intent(in) :: cloud
            type(sph_vectors), intent(in) :: v
            type(sph_velocity_gradient_out), intent(in) :: out
            integer(sph_index) :: answer
        end function
        ! for switches of viscosity
        function sph_shock_indicator(kernel, dim, cloud, state, div_v, out) &
            bind(c, name='sph_shim_shock_indicator') result(answer)
            import
            integer(c_int), value :: kernel, dim
            type(sph_cloud), intent(in) :: cloud
            type(sph_gas), intent(in) :: state
            type(sph_scalars), intent(in) :: div_v
            type(sph_shock_out), intent(in) :: out
            integer(sph_index) :: answer
        end function
        pure function sph_cleaning_sigma(dim) bind(c, name='sph_shim_cleaning_sigma') result(answer)
            import
            integer(c_int), value :: dim
            real(sph_real) :: answer
        end function
        pure function sph_resistivity_switch(h, change, strength) &
            bind(c, name='sph_shim_resistivity_switch') result(answer)
            import
            real(sph_real), value :: h, change, strength
            real(sph_real) :: answer
        end function
        pure function sph_resistivity_pair(weight, alpha_speed, per_rho) &
            bind(c, name='sph_shim_resistivity_pair') result(answer)
            import
            real(sph_real), value :: weight, alpha_speed, per_rho
            real(sph_real) :: answer
        end function
        pure function sph_time_step_resistivity(h, eta) &
            bind(c, name='sph_shim_time_step_resistivity') result(answer)
            import
            real(sph_real), value :: h, eta
            real(sph_real) :: answer
        end function
        function sph_divergence_difference(kernel, dim, cloud, medium, field, out) &
            bind(c, name='sph_shim_divergence_difference') result(answer)
            import
            integer(c_int), value :: kernel, dim
            type(sph_cloud), intent(in) :: cloud
            type(sph_medium), intent(in) :: medium
            type(sph_vectors), intent(in) :: field
            type(sph_scalar_out), intent(in) :: out
            integer(sph_index) :: answer
        end function
        function sph_divergence_symmetric(kernel, dim, cloud, medium, field, out) &
            bind(c, name='sph_shim_divergence_symmetric') result(answer)
            import
            integer(c_int), value :: kernel, dim
            type(sph_cloud), intent(in) :: cloud
            type(sph_medium), intent(in) :: medium
            type(sph_vectors), intent(in) :: field
            type(sph_scalar_out), intent(in) :: out
            integer(sph_index) :: answer
        end function
        function sph_gradient_symmetric(kernel, dim, cloud, medium, f, out) &
            bind(c, name='sph_shim_gradient_symmetric') result(answer)
            import
            integer(c_int), value :: kernel, dim
            type(sph_cloud), intent(in) :: cloud
            type(sph_medium), intent(in) :: medium
            type(sph_scalars), intent(in) :: f
            type(sph_vector_out), intent(in) :: out
            integer(sph_index) :: answer
        end function
        function sph_curl_difference(kernel, dim, cloud, medium, field, out) &
            bind(c, name='sph_shim_curl_difference') result(answer)
            import
            integer(c_int), value :: kernel, dim
            type(sph_cloud), intent(in) :: cloud
            type(sph_medium), intent(in) :: medium
            type(sph_vectors), intent(in) :: field
            type(sph_vector_out), intent(in) :: out
            integer(sph_index) :: answer
        end function
        ! conservative cleaning of B alone
        function sph_cleaning_rates(kernel, dim, cloud, state, out) &
            bind(c, name='sph_shim_cleaning_rates') result(answer)
            import
            integer(c_int), value :: kernel, dim
            type(sph_cloud), intent(in) :: cloud
            type(sph_cleaning), intent(in) :: state
            type(sph_cleaning_out), intent(in) :: out
            integer(sph_index) :: answer
        end function
        ! physical resistivity, with its heat
        function sph_resistivity_ohmic(kernel, dim, cloud, state, out) &
            bind(c, name='sph_shim_resistivity_ohmic') result(answer)
            import
            integer(c_int), value :: kernel, dim
            type(sph_cloud), intent(in) :: cloud
            type(sph_ohmic), intent(in) :: state
            type(sph_ohmic_out), intent(in) :: out
            integer(sph_index) :: answer
        end function
        ! momentum, induction, energy, psi, div B, v_sig
        function sph_mhd_rates(kernel, dim, cloud, state, out) &
            bind(c, name='sph_shim_mhd_rates') result(answer)
            import
            integer(c_int), value :: kernel, dim
            type(sph_cloud), intent(in) :: cloud
            type(sph_mhd), intent(in) :: state
            type(sph_mhd_out), intent(in) :: out
            integer(sph_index) :: answer
        end function
        ! makes kernels exact
        function sph_rk_correction(kernel, dim, cloud, out) &
            bind(c, name='sph_shim_rk_correction') result(answer)
            import
            integer(c_int), value :: kernel, dim
            type(sph_cloud), intent(in) :: cloud
            type(sph_rk_out), intent(in) :: out
            integer(sph_index) :: answer
        end function
        ! for linear fields, everywhere
        function sph_interpolate_rk(kernel, dim, cloud, rk, f, out) &
            bind(c, name='sph_shim_interpolate_rk') result(answer)
            import
            integer(c_int), value :: kernel, dim
            type(sph_cloud), intent(in) :: cloud
            type(sph_rk), intent(in) :: rk
            type(sph_scalars), intent(in) :: f
            type(sph_scalar_out), intent(in) :: out
            integer(sph_index) :: answer
        end function
        function sph_interpolate_rows_rk(kernel, dim, cloud, rk, out) &
            bind(c, name='sph_shim_interpolate_rows_rk') result(answer)
            import
            integer(c_int), value :: kernel, dim
            type(sph_cloud), intent(in) :: cloud
            type(sph_rk), intent(in) :: rk
            type(sph_rows_out), intent(in) :: out
            integer(sph_index) :: answer
        end function
        ! likewise
        function sph_gradient_rk(kernel, dim, cloud, rk, f, out) &
            bind(c, name='sph_shim_gradient_rk') result(answer)
            import
            integer(c_int), value :: kernel, dim
            type(sph_cloud), intent(in) :: cloud
            type(sph_rk), intent(in) :: rk
            type(sph_scalars), intent(in) :: f
            type(sph_vector_out), intent(in) :: out
            integer(sph_index) :: answer
        end function
        function sph_gradient_rows_rk(kernel, dim, cloud, rk, out) &
            bind(c, name='sph_shim_gradient_rows_rk') result(answer)
            import
            integer(c_int), value :: kernel, dim
            type(sph_cloud), intent(in) :: cloud
            type(sph_rk), intent(in) :: rk
            type(sph_gradient_rows_out), intent(in) :: out
            integer(sph_index) :: answer
        end function
        ! forces that conserve (CRKSPH)
        function sph_gas_rates_crk(kernel, dim, cloud, fluid, rk, out) &
            bind(c, name='sph_shim_gas_rates_crk') result(answer)
            import
            integer(c_int), value :: kernel, dim
            type(sph_cloud), intent(in) :: cloud
            type(sph_fluid), intent(in) :: fluid
            type(sph_rk), intent(in) :: rk
            type(sph_corrected_out), intent(in) :: out
            integer(sph_index) :: answer
        end function
        ! by the integral approach
        function sph_gas_rates_iad(kernel, dim, cloud, fluid, inverse, out) &
            bind(c, name='sph_shim_gas_rates_iad') result(answer)
            import
            integer(c_int), value :: kernel, dim
            type(sph_cloud), intent(in) :: cloud
            type(sph_fluid), intent(in) :: fluid
            type(sph_matrices), intent(in) :: inverse
            type(sph_corrected_out), intent(in) :: out
            integer(sph_index) :: answer
        end function
        pure function sph_gravity_pair(kernel, r, h_i, h_j) &
            bind(c, name='sph_shim_gravity_pair') result(answer)
            import
            integer(c_int), value :: kernel
            real(sph_real), value :: r, h_i, h_j
            real(sph_real) :: answer
        end function
        pure function sph_gravity_zeta_value(h, rho, sum) &
            bind(c, name='sph_shim_gravity_zeta_value') result(answer)
            import
            real(sph_real), value :: h, rho, sum
            real(sph_real) :: answer
        end function
        ! all pairs
        function sph_gravity_direct(kernel, cloud, m, newton, acceleration, potential) &
            bind(c, name='sph_shim_gravity_direct') result(answer)
            import
            integer(c_int), value :: kernel
            type(sph_cloud), intent(in) :: cloud
            type(sph_scalars), intent(in) :: m
            real(sph_real), value :: newton
            type(sph_vector_out), intent(in) :: acceleration
            type(sph_scalar_out), intent(in) :: potential
            integer(sph_index) :: answer
        end function
        function sph_gravity_zeta(kernel, cloud, m, rho, out) &
            bind(c, name='sph_shim_gravity_zeta') result(answer)
            import
            integer(c_int), value :: kernel
            type(sph_cloud), intent(in) :: cloud
            type(sph_scalars), intent(in) :: m, rho
            type(sph_scalar_out), intent(in) :: out
            integer(sph_index) :: answer
        end function
        ! where h follows the density
        function sph_gravity_correction(kernel, cloud, medium, zeta, newton, acceleration) &
            bind(c, name='sph_shim_gravity_correction') result(answer)
            import
            integer(c_int), value :: kernel
            type(sph_cloud), intent(in) :: cloud
            type(sph_medium), intent(in) :: medium
            type(sph_scalars), intent(in) :: zeta
            real(sph_real), value :: newton
            type(sph_vector_out), intent(in) :: acceleration
            integer(sph_index) :: answer
        end function
        ! exact for affine maps
        function sph_deformation_gradient(kernel, dim, cloud, x, inverse, out) &
            bind(c, name='sph_shim_deformation_gradient') result(answer)
            import
            integer(c_int), value :: kernel, dim
            type(sph_cloud), intent(in) :: cloud
            type(sph_points), intent(in) :: x
            type(sph_matrices), intent(in) :: inverse
            type(sph_matrix_out), intent(in) :: out
            integer(sph_index) :: answer
        end function
        ! by stress and hourglass control: keeps both momenta
        function sph_solid_acceleration(kernel, dim, cloud, solid, acceleration) &
            bind(c, name='sph_shim_solid_acceleration') result(answer)
            import
            integer(c_int), value :: kernel, dim
            type(sph_cloud), intent(in) :: cloud
            type(sph_solid), intent(in) :: solid
            type(sph_vector_out), intent(in) :: acceleration
            integer(sph_index) :: answer
        end function
        function sph_nearest_distance(dim, targets_of, sources, out) &
            bind(c, name='sph_shim_nearest_distance') result(answer)
            import
            integer(c_int), value :: dim
            type(sph_cloud), intent(in) :: targets_of
            type(sph_points), intent(in) :: sources
            type(sph_scalar_out), intent(in) :: out
            integer(sph_index) :: answer
        end function
        function sph_hexatic_order(cloud, out) bind(c, name='sph_shim_hexatic_order') result(answer)
            import
            type(sph_cloud), intent(in) :: cloud
            type(sph_scalar_out), intent(in) :: out
            integer(sph_index) :: answer
        end function
        function sph_radial_distribution(dim, cloud, farthest, number_density, bins, g) &
            bind(c, name='sph_shim_radial_distribution') result(answer)
            import
            integer(c_int), value :: dim
            type(sph_cloud), intent(in) :: cloud
            real(sph_real), value :: farthest, number_density
            integer(c_int), value :: bins
            real(sph_real), intent(inout) :: g(*)
            integer(sph_index) :: answer
        end function
        function sph_coincident_count(dim, cloud, distance) &
            bind(c, name='sph_shim_coincident_count') result(answer)
            import
            integer(c_int), value :: dim
            type(sph_cloud), intent(in) :: cloud
            real(sph_real), value :: distance
            integer(sph_index) :: answer
        end function
        function sph_coincident_separate(dim, cloud, within, distance, position) &
            bind(c, name='sph_shim_coincident_separate') result(answer)
            import
            integer(c_int), value :: dim
            type(sph_cloud), intent(in) :: cloud
            real(sph_real), value :: within, distance
            type(sph_vector_out), intent(in) :: position
            integer(sph_index) :: answer
        end function
        ! mass, momentum, angular momentum, kinetic energy
        function sph_conserved_sums(dim, cloud, m, v, out) &
            bind(c, name='sph_shim_conserved_sums') result(answer)
            import
            integer(c_int), value :: dim
            type(sph_cloud), intent(in) :: cloud
            type(sph_scalars), intent(in) :: m
            type(sph_vectors), intent(in) :: v
            type(sph_conserved), intent(inout) :: out
            integer(sph_index) :: answer
        end function
        ! call it once on a new cloud
        function sph_cloud_examine(kernel, dim, cloud, both_sides, samples, out) &
            bind(c, name='sph_shim_cloud_examine') result(answer)
            import
            integer(c_int), value :: kernel, dim
            type(sph_cloud), intent(in) :: cloud
            integer(c_int), value :: both_sides
            integer(sph_index), value :: samples
            type(sph_findings), intent(inout) :: out
            integer(sph_index) :: answer
        end function
        function c_finding_text(finding) bind(c, name='sph_shim_finding_text') result(answer)
            import
            integer(c_int), value :: finding
            type(c_ptr) :: answer
        end function
        ! below which a pair is a neighbour
        pure function sph_grid_pair_radius(criterion, R_i, R_j) &
            bind(c, name='sph_shim_grid_pair_radius') result(answer)
            import
            integer(c_int), value :: criterion
            real(sph_real), value :: R_i, R_j
            real(sph_real) :: answer
        end function
        ! x moved into a box
        pure function sph_grid_wrap(x, low, length) bind(c, name='sph_shim_grid_wrap') result(answer)
            import
            real(sph_real), value :: x, low, length
            real(sph_real) :: answer
        end function
        ! bytes of workspace for n sources, or 0
        pure function sph_grid_workspace(dim, n) bind(c, name='sph_shim_grid_workspace') result(answer)
            import
            integer(c_int), value :: dim
            integer(sph_index), value :: n
            integer(c_size_t) :: answer
        end function
        ! sorts the sources
        function sph_grid_build(dim, sources, radius, work, work_size, grid) &
            bind(c, name='sph_shim_grid_build') result(answer)
            import
            integer(c_int), value :: dim
            type(sph_points), intent(in) :: sources
            type(sph_scalars), intent(in) :: radius
            type(c_ptr), value :: work
            integer(c_size_t), value :: work_size
            type(sph_grid), intent(inout) :: grid
            integer(sph_index) :: answer
        end function
        ! order[slot] = particle: into the grid's order
        function sph_grid_permutation(grid) bind(c, name='sph_shim_grid_permutation') result(answer)
            import
            type(sph_grid), intent(in) :: grid
            type(c_ptr) :: answer
        end function
        ! the same for the first n particles alone,
        function sph_grid_permutation_own(grid, n, permutation) &
            bind(c, name='sph_shim_grid_permutation_own') result(answer)
            import
            type(sph_grid), intent(in) :: grid
            integer(sph_index), value :: n
            integer(sph_index), intent(inout) :: permutation(*)
            integer(sph_index) :: answer
        end function
        ! where the others stay behind them
        function sph_grid_renumber_own(grid, n) bind(c, name='sph_shim_grid_renumber_own') result(answer)
            import
            type(sph_grid), intent(inout) :: grid
            integer(sph_index), value :: n
            integer(sph_index) :: answer
        end function
        ! tells the grid that the arrays have been permuted
        function sph_grid_renumber(grid) bind(c, name='sph_shim_grid_renumber') result(answer)
            import
            type(sph_grid), intent(inout) :: grid
            integer(sph_index) :: answer
        end function
        ! the neighbour lists
        function sph_grid_lists(dim, grid, query, start, index, capacity, pairs) &
            bind(c, name='sph_shim_grid_lists') result(answer)
            import
            integer(c_int), value :: dim
            type(sph_grid), intent(in) :: grid
            type(sph_query), intent(in) :: query
            integer(sph_index), intent(inout) :: start(*), index(*)
            integer(c_int64_t), value :: capacity
            integer(c_int64_t), intent(inout) :: pairs
            integer(sph_index) :: answer
        end function
        ! only the lengths of the lists
        function sph_grid_count(dim, grid, query, start, pairs) &
            bind(c, name='sph_shim_grid_count') result(answer)
            import
            integer(c_int), value :: dim
            type(sph_grid), intent(in) :: grid
            type(sph_query), intent(in) :: query
            integer(sph_index), intent(inout) :: start(*)
            integer(c_int64_t), intent(inout) :: pairs
            integer(sph_index) :: answer
        end function
        ! bytes of that block, or 0
        pure function sph_search_size(dim, n, pairs) bind(c, name='sph_shim_search_size') result(answer)
            import
            integer(c_int), value :: dim
            integer(sph_index), value :: n
            integer(c_int64_t), value :: pairs
            integer(c_size_t) :: answer
        end function
        ! neighbours, in one block of memory
        function sph_search(dim, points, radius, criterion, memory, size, found) &
            bind(c, name='sph_shim_search') result(answer)
            import
            integer(c_int), value :: dim
            type(sph_points), intent(in) :: points
            type(sph_scalars), intent(in) :: radius
            integer(c_int), value :: criterion
            type(c_ptr), value :: memory
            integer(c_size_t), value :: size
            type(sph_neighbors), intent(inout) :: found
            integer(sph_index) :: answer
        end function
        ! several machines: where particles are, and how far they reach
        function sph_part_of(dim, points, radius, part) bind(c, name='sph_shim_part_of') result(answer)
            import
            integer(c_int), value :: dim
            type(sph_points), intent(in) :: points
            type(sph_scalars), intent(in) :: radius
            type(sph_part), intent(inout) :: part
            integer(sph_index) :: answer
        end function
        ! which of them another machine needs
        function sph_select_near(dim, points, radius, criterion, part, chosen, count) &
            bind(c, name='sph_shim_select_near') result(answer)
            import
            integer(c_int), value :: dim
            type(sph_points), intent(in) :: points
            type(sph_scalars), intent(in) :: radius
            integer(c_int), value :: criterion
            type(sph_part), intent(in) :: part
            integer(sph_index), intent(inout) :: chosen(*)
            integer(c_int64_t), intent(inout) :: count
            integer(sph_index) :: answer
        end function
        ! without the sources that no row names
        function sph_list_prune(n, n_total, start, index, kept, count) &
            bind(c, name='sph_shim_list_prune') result(answer)
            import
            integer(sph_index), value :: n, n_total
            integer(sph_index), intent(in) :: start(*)
            integer(sph_index), intent(inout) :: index(*), kept(*)
            integer(c_int64_t), intent(inout) :: count
            integer(sph_index) :: answer
        end function
        ! rows in the order of the host's keys
        function sph_list_sort(n, n_total, start, index, key) &
            bind(c, name='sph_shim_list_sort') result(answer)
            import
            integer(sph_index), value :: n, n_total
            integer(sph_index), intent(in) :: start(*)
            integer(sph_index), intent(inout) :: index(*)
            integer(c_int64_t), intent(in) :: key(*)
            integer(sph_index) :: answer
        end function
        ! out[slot] = in[order[slot]], for each array
        function sph_permute(n, permutation, in, stride, out) bind(c, name='sph_shim_permute') result(answer)
            import
            integer(sph_index), value :: n
            integer(sph_index), intent(in) :: permutation(*)
            real(sph_real), intent(in) :: in(*)
            integer(c_size_t), value :: stride
            real(sph_real), intent(inout) :: out(*)
            integer(sph_index) :: answer
        end function
        ! inverse[order[slot]] = slot
        function sph_permute_inverse(n, permutation, inverse) &
            bind(c, name='sph_shim_permute_inverse') result(answer)
            import
            integer(sph_index), value :: n
            integer(sph_index), intent(in) :: permutation(*)
            integer(sph_index), intent(inout) :: inverse(*)
            integer(sph_index) :: answer
        end function
        ! 1 if a particle moved by more than skin / 2
        function sph_rebuild_due(dim, now, then, skin) bind(c, name='sph_shim_rebuild_due') result(answer)
            import
            integer(c_int), value :: dim
            type(sph_points), intent(in) :: now, then
            real(sph_real), value :: skin
            integer(c_int) :: answer
        end function
    end interface

contains

    ! True if the library was compiled from the same headers, and with the same kinds of numbers.
    function sph_agrees() result(agrees)
        logical :: agrees
        type(sph_vec) :: sph_vec_here
        type(sph_sym) :: sph_sym_here
        type(sph_points) :: sph_points_here
        type(sph_scalars) :: sph_scalars_here
        type(sph_list) :: sph_list_here
        type(sph_vectors) :: sph_vectors_here
        type(sph_vector_out) :: sph_vector_out_here
        type(sph_scalar_out) :: sph_scalar_out_here
        type(sph_matrices) :: sph_matrices_here
        type(sph_matrix_out) :: sph_matrix_out_here
        type(sph_cloud) :: sph_cloud_here
        type(sph_derivatives_out) :: sph_derivatives_out_here
        type(sph_rows_out) :: sph_rows_out_here
        type(sph_correction_out) :: sph_correction_out_here
        type(sph_gradient_rows_out) :: sph_gradient_rows_out_here
        type(sph_density_options) :: sph_density_options_here
        type(sph_density_out) :: sph_density_out_here
        type(sph_jet) :: sph_jet_here
        type(sph_derivatives_options) :: sph_derivatives_options_here
        type(sph_sources) :: sph_sources_here
        type(sph_interpolation_options) :: sph_interpolation_options_here
        type(sph_interpolation_out) :: sph_interpolation_out_here
        type(sph_interpolation_rows_out) :: sph_interpolation_rows_out_here
        type(sph_elliptic_options) :: sph_elliptic_options_here
        type(sph_elliptic_report) :: sph_elliptic_report_here
        type(sph_diagonal) :: sph_diagonal_here
        type(sph_boundary) :: sph_boundary_here
        type(sph_csr) :: sph_csr_here
        type(sph_tait) :: sph_tait_here
        type(sph_fluid) :: sph_fluid_here
        type(sph_fluid_out) :: sph_fluid_out_here
        type(sph_shear_bulk) :: sph_shear_bulk_here
        type(sph_wall) :: sph_wall_here
        type(sph_wall_out) :: sph_wall_out_here
        type(sph_diffusion) :: sph_diffusion_here
        type(sph_surface_out) :: sph_surface_out_here
        type(sph_shift) :: sph_shift_here
        type(sph_transport_out) :: sph_transport_out_here
        type(sph_riemann_options) :: sph_riemann_options_here
        type(sph_tension) :: sph_tension_here
        type(sph_tension_out) :: sph_tension_out_here
        type(sph_wall_elements) :: sph_wall_elements_here
        type(sph_wall_gamma_out) :: sph_wall_gamma_out_here
        type(sph_wall_terms) :: sph_wall_terms_here
        type(sph_collision) :: sph_collision_here
        type(sph_collision_report) :: sph_collision_report_here
        type(sph_medium) :: sph_medium_here
        type(sph_gas) :: sph_gas_here
        type(sph_gas_out) :: sph_gas_out_here
        type(sph_velocity_gradient_out) :: sph_velocity_gradient_out_here
        type(sph_shock_out) :: sph_shock_out_here
        type(sph_cleaning) :: sph_cleaning_here
        type(sph_cleaning_out) :: sph_cleaning_out_here
        type(sph_ohmic) :: sph_ohmic_here
        type(sph_ohmic_out) :: sph_ohmic_out_here
        type(sph_mhd) :: sph_mhd_here
        type(sph_mhd_out) :: sph_mhd_out_here
        type(sph_rk) :: sph_rk_here
        type(sph_rk_out) :: sph_rk_out_here
        type(sph_corrected_out) :: sph_corrected_out_here
        type(sph_solid) :: sph_solid_here
        type(sph_conserved) :: sph_conserved_here
        type(sph_offender) :: sph_offender_here
        type(sph_findings) :: sph_findings_here
        type(sph_grid) :: sph_grid_here
        type(sph_query) :: sph_query_here
        type(sph_neighbors) :: sph_neighbors_here
        type(sph_part) :: sph_part_here
        agrees = sph_version_of() == SPH_VERSION .and. &
            sph_real_size() == c_sizeof(0.0_sph_real) .and. &
            sph_index_size() == c_sizeof(0_sph_index)
        agrees = agrees .and. c_sizeof(sph_vec_here) == &
            c_struct_size('sph_vec'//c_null_char)
        agrees = agrees .and. c_sizeof(sph_sym_here) == &
            c_struct_size('sph_sym'//c_null_char)
        agrees = agrees .and. c_sizeof(sph_points_here) == &
            c_struct_size('sph_points'//c_null_char)
        agrees = agrees .and. c_sizeof(sph_scalars_here) == &
            c_struct_size('sph_scalars'//c_null_char)
        agrees = agrees .and. c_sizeof(sph_list_here) == &
            c_struct_size('sph_list'//c_null_char)
        agrees = agrees .and. c_sizeof(sph_vectors_here) == &
            c_struct_size('sph_vectors'//c_null_char)
        agrees = agrees .and. c_sizeof(sph_vector_out_here) == &
            c_struct_size('sph_vector_out'//c_null_char)
        agrees = agrees .and. c_sizeof(sph_scalar_out_here) == &
            c_struct_size('sph_scalar_out'//c_null_char)
        agrees = agrees .and. c_sizeof(sph_matrices_here) == &
            c_struct_size('sph_matrices'//c_null_char)
        agrees = agrees .and. c_sizeof(sph_matrix_out_here) == &
            c_struct_size('sph_matrix_out'//c_null_char)
        agrees = agrees .and. c_sizeof(sph_cloud_here) == &
            c_struct_size('sph_cloud'//c_null_char)
        agrees = agrees .and. c_sizeof(sph_derivatives_out_here) == &
            c_struct_size('sph_derivatives_out'//c_null_char)
        agrees = agrees .and. c_sizeof(sph_rows_out_here) == &
            c_struct_size('sph_rows_out'//c_null_char)
        agrees = agrees .and. c_sizeof(sph_correction_out_here) == &
            c_struct_size('sph_correction_out'//c_null_char)
        agrees = agrees .and. c_sizeof(sph_gradient_rows_out_here) == &
            c_struct_size('sph_gradient_rows_out'//c_null_char)
        agrees = agrees .and. c_sizeof(sph_density_options_here) == &
            c_struct_size('sph_density_options'//c_null_char)
        agrees = agrees .and. c_sizeof(sph_density_out_here) == &
            c_struct_size('sph_density_out'//c_null_char)
        agrees = agrees .and. c_sizeof(sph_jet_here) == &
            c_struct_size('sph_jet'//c_null_char)
        agrees = agrees .and. c_sizeof(sph_derivatives_options_here) == &
            c_struct_size('sph_derivatives_options'//c_null_char)
        agrees = agrees .and. c_sizeof(sph_sources_here) == &
            c_struct_size('sph_sources'//c_null_char)
        agrees = agrees .and. c_sizeof(sph_interpolation_options_here) == &
            c_struct_size('sph_interpolation_options'//c_null_char)
        agrees = agrees .and. c_sizeof(sph_interpolation_out_here) == &
            c_struct_size('sph_interpolation_out'//c_null_char)
        agrees = agrees .and. c_sizeof(sph_interpolation_rows_out_here) == &
            c_struct_size('sph_interpolation_rows_out'//c_null_char)
        agrees = agrees .and. c_sizeof(sph_elliptic_options_here) == &
            c_struct_size('sph_elliptic_options'//c_null_char)
        agrees = agrees .and. c_sizeof(sph_elliptic_report_here) == &
            c_struct_size('sph_elliptic_report'//c_null_char)
        agrees = agrees .and. c_sizeof(sph_diagonal_here) == &
            c_struct_size('sph_diagonal'//c_null_char)
        agrees = agrees .and. c_sizeof(sph_boundary_here) == &
            c_struct_size('sph_boundary'//c_null_char)
        agrees = agrees .and. c_sizeof(sph_csr_here) == &
            c_struct_size('sph_csr'//c_null_char)
        agrees = agrees .and. c_sizeof(sph_tait_here) == &
            c_struct_size('sph_tait'//c_null_char)
        agrees = agrees .and. c_sizeof(sph_fluid_here) == &
            c_struct_size('sph_fluid'//c_null_char)
        agrees = agrees .and. c_sizeof(sph_fluid_out_here) == &
            c_struct_size('sph_fluid_out'//c_null_char)
        agrees = agrees .and. c_sizeof(sph_shear_bulk_here) == &
            c_struct_size('sph_shear_bulk'//c_null_char)
        agrees = agrees .and. c_sizeof(sph_wall_here) == &
            c_struct_size('sph_wall'//c_null_char)
        agrees = agrees .and. c_sizeof(sph_wall_out_here) == &
            c_struct_size('sph_wall_out'//c_null_char)
        agrees = agrees .and. c_sizeof(sph_diffusion_here) == &
            c_struct_size('sph_diffusion'//c_null_char)
        agrees = agrees .and. c_sizeof(sph_surface_out_here) == &
            c_struct_size('sph_surface_out'//c_null_char)
        agrees = agrees .and. c_sizeof(sph_shift_here) == &
            c_struct_size('sph_shift'//c_null_char)
        agrees = agrees .and. c_sizeof(sph_transport_out_here) == &
            c_struct_size('sph_transport_out'//c_null_char)
        agrees = agrees .and. c_sizeof(sph_riemann_options_here) == &
            c_struct_size('sph_riemann_options'//c_null_char)
        agrees = agrees .and. c_sizeof(sph_tension_here) == &
            c_struct_size('sph_tension'//c_null_char)
        agrees = agrees .and. c_sizeof(sph_tension_out_here) == &
            c_struct_size('sph_tension_out'//c_null_char)
        agrees = agrees .and. c_sizeof(sph_wall_elements_here) == &
            c_struct_size('sph_wall_elements'//c_null_char)
        agrees = agrees .and. c_sizeof(sph_wall_gamma_out_here) == &
            c_struct_size('sph_wall_gamma_out'//c_null_char)
        agrees = agrees .and. c_sizeof(sph_wall_terms_here) == &
            c_struct_size('sph_wall_terms'//c_null_char)
        agrees = agrees .and. c_sizeof(sph_collision_here) == &
            c_struct_size('sph_collision'//c_null_char)
        agrees = agrees .and. c_sizeof(sph_collision_report_here) == &
            c_struct_size('sph_collision_report'//c_null_char)
        agrees = agrees .and. c_sizeof(sph_medium_here) == &
            c_struct_size('sph_medium'//c_null_char)
        agrees = agrees .and. c_sizeof(sph_gas_here) == &
            c_struct_size('sph_gas'//c_null_char)
        agrees = agrees .and. c_sizeof(sph_gas_out_here) == &
            c_struct_size('sph_gas_out'//c_null_char)
        agrees = agrees .and. c_sizeof(sph_velocity_gradient_out_here) == &
            c_struct_size('sph_velocity_gradient_out'//c_null_char)
        agrees = agrees .and. c_sizeof(sph_shock_out_here) == &
            c_struct_size('sph_shock_out'//c_null_char)
        agrees = agrees .and. c_sizeof(sph_cleaning_here) == &
            c_struct_size('sph_cleaning'//c_null_char)
        agrees = agrees .and. c_sizeof(sph_cleaning_out_here) == &
            c_struct_size('sph_cleaning_out'//c_null_char)
        agrees = agrees .and. c_sizeof(sph_ohmic_here) == &
            c_struct_size('sph_ohmic'//c_null_char)
        agrees = agrees .and. c_sizeof(sph_ohmic_out_here) == &
            c_struct_size('sph_ohmic_out'//c_null_char)
        agrees = agrees .and. c_sizeof(sph_mhd_here) == &
            c_struct_size('sph_mhd'//c_null_char)
        agrees = agrees .and. c_sizeof(sph_mhd_out_here) == &
            c_struct_size('sph_mhd_out'//c_null_char)
        agrees = agrees .and. c_sizeof(sph_rk_here) == &
            c_struct_size('sph_rk'//c_null_char)
        agrees = agrees .and. c_sizeof(sph_rk_out_here) == &
            c_struct_size('sph_rk_out'//c_null_char)
        agrees = agrees .and. c_sizeof(sph_corrected_out_here) == &
            c_struct_size('sph_corrected_out'//c_null_char)
        agrees = agrees .and. c_sizeof(sph_solid_here) == &
            c_struct_size('sph_solid'//c_null_char)
        agrees = agrees .and. c_sizeof(sph_conserved_here) == &
            c_struct_size('sph_conserved'//c_null_char)
        agrees = agrees .and. c_sizeof(sph_offender_here) == &
            c_struct_size('sph_offender'//c_null_char)
        agrees = agrees .and. c_sizeof(sph_findings_here) == &
            c_struct_size('sph_findings'//c_null_char)
        agrees = agrees .and. c_sizeof(sph_grid_here) == &
            c_struct_size('sph_grid'//c_null_char)
        agrees = agrees .and. c_sizeof(sph_query_here) == &
            c_struct_size('sph_query'//c_null_char)
        agrees = agrees .and. c_sizeof(sph_neighbors_here) == &
            c_struct_size('sph_neighbors'//c_null_char)
        agrees = agrees .and. c_sizeof(sph_part_here) == &
            c_struct_size('sph_part'//c_null_char)
    end function
end module
