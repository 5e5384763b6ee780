# SPDX-License-Identifier: MIT
"""A method for every operator of the headers, and a function for every number.
Written by examples/hosts/generate.py from the headers: run it again instead of changing this file."""

from typing import Any, Sequence, Union

Array = Any  # numpy's, or of the module array
Scalars = Union[float, Array, None]  # one number for all, or one for each particle
Vectors = Union[Array, Sequence[Array], None]  # of shape (n, dim), or one array for each component
Matrices = Union[Array, None]  # of shape (n, dim, dim), or one list of arrays for each row
Indices = Array


class Operators:
    """The sweeps, as methods of Cloud. Outputs are new arrays."""

    def _call(self, name: str, values: dict) -> Any:
        raise NotImplementedError

    def shepard_sum(self) -> Array:
        """sph_shepard_sum: gamma_i = sum_j V_j W_ij, with itself

        gamma_i = sum_j V_j W_ij, the particle itself included. It is 1 in the interior of a regular cloud,
        and about 1/2 at a plane boundary. Sources: Shepard 1968; (4.10) of the ICSPM paper (see second
        derivatives). Where the sum overflows, the result is 0 and SPH_NOT_FINITE.
        """
        return self._call("shepard_sum", locals())

    def interpolate_shepard(self, f: Scalars) -> Array:
        """sph_interpolate_shepard: sum_j V_j f_j W_ij / gamma_i

        f_i = sum_j V_j f_j W_ij / sum_j V_j W_ij, the particle itself included. It is exact for constants;
        the error is O(h^2) in the interior of a regular cloud, and O(h) in disorder and at a boundary.
        Shepard 1968. A target of volume 0 is a probe. The result is 0 where the sum of weights is not
        positive (SPH_TOO_FEW) or a sum overflows (SPH_NOT_FINITE). Atlas: value exact for constants, inside
        lattices for linear fields; order 2 inside lattices, 1 in disorder, 1 at boundaries.
        """
        return self._call("interpolate_shepard", locals())

    def density_summation(self, m: Scalars) -> Array:
        """sph_density_summation: sum_j m_j W_ij, with itself

        rho_i = sum_j m_j W_ij(h_i), the particle itself included (a probe has the mass 0). The error is
        O(h^2) in the interior of a regular cloud, down to what h / dx leaves (0.1 % for wendland-c2 and h = 2
        dx in 2D), and about rho / 2 at a free surface. h is given here; sph_density_adaptive finds an h that
        follows rho. Where the sum overflows, the result is 0 and SPH_NOT_FINITE. Atlas: value exact for
        nothing; order 0 inside lattices, 0 in disorder, 0 at boundaries.
        """
        return self._call("density_summation", locals())

    def density_adaptive(
        self,
        m: Scalars,
        h: Scalars,
        list_radius: Scalars = None,
        eta: float = 0.0,
        tolerance: float = 0.0,
    ) -> Any:
        """sph_density_adaptive: with the h that belongs to it, and Omega

        Density and smoothing length that belong together, and the factor Omega of the equations of motion
        with that h (sources: see the beginning of this chapter). The particle itself is in all sums: h_i
        = eta (m_i / rho_i)^(1/dim)   to   |eta (m_i / rho_i)^(1/dim) / h_i - 1| <= tolerance, rho_i   = sum_j
        m_j W_ij(h_i), Omega_i = 1 + h_i / (dim rho_i) sum_j m_j dW_ij/dh_i. On a lattice of spacing dx, h is
        eta dx, but for the error of the kernel there. The method never diverges, and with a good guess makes
        two or three passes over the list. list_radius  h_i is never made longer than list_radius_i / support
        ratio. A list_radius is at most half a periodic length. h            Before the call: a guess for each
        target (any positive number). After it: the result. The status of a target that is not SPH_OK:
        SPH_LIST_TOO_SHORT   h would have to be longer. h[i] is the one to try next (at most twice the longest
        that was allowed); rho and omega are those at list_radius_i / support ratio. Build a list that is
        longer where h[i] * support ratio exceeds list_radius_i, and call again. Or stop at the longest h that
        makes sense, and keep rho and omega. SPH_TOO_FEW          No h is long enough, because all sources (in
        a periodic box: all within half of it) have too little mass. A particle alone is such a case: its rho
        h^dim is a constant, so that every h fits or none. h[i] is list_radius_i / support ratio; rho and
        omega are 0. SPH_SINGULAR         No h is short enough, because at any h the particle, with those that
        coincide with it, has more mass than eta^dim allows: eta is too small, or particles have clumped in
        one point. rho and omega are 0. h[i] is too short to reach any particle elsewhere; it is the guess, if
        that was so short. SPH_NOT_AVAILABLE    m_i is not positive. rho and omega are 0; h[i] is as it was.
        SPH_ILL_CONDITIONED  rho jumps across the solution. This happens with kernels that are cut off at
        their edge (the Gaussians). h[i] is the place of the jump; rho and omega are those there.
        SPH_NOT_FINITE       The sums overflowed. rho and omega are 0; h[i] is where that happened. Errors,
        besides those of all sweeps: SPH_ERROR_H for a guess or a list_radius that is not finite and positive,
        SPH_ERROR_VALUE for eta or tolerance out of range, SPH_ERROR_BOX for a list_radius beyond half the
        box. Ranges of targets may run in parallel, because a range reads only its own entries of h. Atlas:
        value exact for nothing; order 0 inside lattices, 0 in disorder, 0 at boundaries.

        h: first guess of h
        list_radius: of the targets: list i holds all sources with r < list_radius_i; no default
        eta: h = eta (m / rho)^(1/dim); 0: sph_kernel_h_over_dx(k)
        tolerance: relative, of h, below 1; 0: 1e-3. At least 64 unit round-offs are used
        """
        return self._call("density_adaptive", locals())

    def gradient_difference(self, f: Scalars) -> Array:
        """sph_gradient_difference: sum_j V_j (f_j - f_i) grad_i W_ij

        grad f_i = sum_j V_j (f_j - f_i) grad_i W_ij, without correction. Exact for constants; for source and
        errors see sph_gradient_pair_difference. Where a component overflows, the gradient is 0 and the target
        counts as failed. Atlas: gradient exact for constants; order 0 inside lattices, 0 in disorder, 0 at
        boundaries.
        """
        return self._call("gradient_difference", locals())

    def gradient_cspm(self, f: Scalars) -> Any:
        """sph_gradient_cspm: corrected: exact for linear fields

        grad f_i = K^-1 sum_j V_j (-F_ij) e (f_j - f_i) with K = sum_j V_j (-F_ij) e e^T and e = x_j - x_i. It
        is exact for linear fields at any particle; the error is O(h^2) in the interior of a regular cloud,
        and O(h) in disorder and at a boundary. Sources: Randles & Libersky 1996, CMAME 139, 375; in 1D CSPM,
        (3.5) of the ICSPM paper (with W', where its list under (5.17) prints W). Of out, gx (with gy and gz
        as dim needs them) is filled, and conditioning and status if they are not null. conditioning is the
        smallest pivot of K scaled to a unit diagonal, in [0, 1]. A target needs dim neighbours inside its
        support; in 2D not all may be on one line with it, in 3D not all in one plane with it. Else the
        gradient is 0, with SPH_TOO_FEW or SPH_SINGULAR. Where a component overflows, it is 0 with
        SPH_NOT_FINITE. Atlas: gradient exact for linear fields, inside lattices for quadratic fields; order 2
        inside lattices, 1 in disorder, 1 at boundaries.
        """
        return self._call("gradient_cspm", locals())

    def gradient_iad(self, f: Scalars) -> Any:
        """sph_gradient_iad: likewise, without derivatives of W

        grad f_i = C sum_j V_j W_ij e (f_j - f_i) with C^-1 = sum_j V_j W_ij e e^T and e = x_j - x_i: the
        integral approach to derivatives (IAD). Exact for linear fields at any particle, and of the errors of
        sph_gradient_cspm; it needs no derivative of the kernel, and near neighbours count less. Garcia-Senz,
        Cabezon & Escartin 2012, A&A 538, A9. Outputs and statuses are those of sph_gradient_cspm. Atlas:
        gradient exact for linear fields, inside lattices for quadratic fields; order 2 inside lattices, 1 in
        disorder, 1 at boundaries.
        """
        return self._call("gradient_iad", locals())

    def gradient_rows_cspm(self) -> Any:
        """sph_gradient_rows_cspm: the same as rows

        The same gradient as rows: grad f_i = sum_p (x[p], y[p], z[p]) (f_j - f_i), where p runs along the
        list of i and j = index[p]. The rows of a target that is not SPH_OK are 0.

        (What is the same: see gradient_iad.)
        """
        return self._call("gradient_rows_cspm", locals())

    def gradient_rows_iad(self) -> Any:
        """sph_gradient_rows_iad.

        Those of sph_gradient_iad.
        """
        return self._call("gradient_rows_iad", locals())

    def gradient_correction_cspm(self) -> Any:
        """sph_gradient_correction_cspm: the matrices that correct

        K^-1 of sph_gradient_cspm, a symmetric matrix without unit: grad f_i = K^-1 sum_j V_j (f_j - f_i)
        grad_i W_ij. It is what solids need of their reference state. The matrix of a target that is
        SPH_TOO_FEW, SPH_SINGULAR or SPH_NOT_FINITE is 0.
        """
        return self._call("gradient_correction_cspm", locals())

    def gradient_correction_iad(self) -> Any:
        """sph_gradient_correction_iad.

        C of sph_gradient_iad, a symmetric matrix of the unit 1 / length^2. It is what sph_gas_rates_iad
        needs.
        """
        return self._call("gradient_correction_iad", locals())

    def laplacian_brookshaw(self, f: Scalars) -> Array:
        """sph_laplacian_brookshaw: sum_j 2 V_j (f_i - f_j) F_ij

        L f_i = sum_j 2 V_j (f_i - f_j) F_ij. For source and errors see sph_laplacian_weight_brookshaw. Where
        the sum overflows, the result is 0 and SPH_NOT_FINITE. Atlas: Laplacian exact for constants, inside
        lattices for linear fields; order 0 inside lattices, -1 in disorder, -1 at boundaries.
        """
        return self._call("laplacian_brookshaw", locals())

    def laplacian_rows_brookshaw(self) -> Any:
        """sph_laplacian_rows_brookshaw.

        The same Laplacian as rows: L f_i = sum_p row[p] (f_j - f_i) with row[p] = -2 V_j F_ij >= 0, factor 1
        and conditioning 1. A row that overflows is 0, with SPH_NOT_FINITE.

        (What is the same: see laplacian_brookshaw.)
        """
        return self._call("laplacian_rows_brookshaw", locals())

    def derivatives_cspm(self, f: Scalars, conditioning_min: float = 0.0, fallback_wls: int = 0) -> Any:
        """sph_derivatives_cspm: gradient, Hessian, Laplacian

        Gradient, Hessian and Laplacian (the trace of the Hessian) by CSPM: h grad f = K^-1 sum g e df,   h^2
        hess = M^-1 (sum w e e df - A h grad f), in 1D (3.5) and (5.15) of the ICSPM paper. The gradient is
        exact for linear fields, the Hessian for quadratic fields in the interior of symmetric clouds only.
        The Hessian has an error O(1) at boundaries: in 1D it is kappa f'' instead of f''. conditioning is the
        smallest pivot of the scaled matrices, in [0, 1]. A target below conditioning_min is
        SPH_ILL_CONDITIONED and keeps its values. All values are 0 where the neighbours do not determine them
        (SPH_TOO_FEW if the support holds fewer than 1, 3 or 6 neighbours in 1D, 2D or 3D, else SPH_SINGULAR),
        and where one overflows (SPH_NOT_FINITE). Atlas: Laplacian exact for linear fields, inside lattices
        for cubic fields; order 2 inside lattices, 0 in disorder, 0 at boundaries. Atlas: Hessian exact for
        linear fields, inside lattices for cubic fields; order 2 inside lattices, 0 in disorder, 0 at
        boundaries.

        conditioning_min: A target whose |conditioning| is smaller is SPH_ILL_CONDITIONED; >= 0. 0: no target
        is.
        fallback_wls: For ICSPM and Fatehi-Manzari. 1: targets that are singular or ill-conditioned get the
        values of WLS.
        """
        return self._call("derivatives_cspm", locals())

    def derivatives_icspm(self, f: Scalars, conditioning_min: float = 0.0, fallback_wls: int = 0) -> Any:
        """sph_derivatives_icspm: exact for quadratics

        Gradient, Hessian and Laplacian by ICSPM, the solution of the whole system: (5.17) of the ICSPM paper
        in 1D. They are exact for quadratic fields wherever the system is not singular. conditioning is kappa
        in 1D, and sign(det kappa) / |kappa^-1| in general. A target whose |conditioning| is below
        conditioning_min is SPH_ILL_CONDITIONED and keeps its values. Where there are boundaries and disorder,
        0.2 is a good conditioning_min in 1D, and 0.02 in 2D and 3D; 0 is the published method. With
        fallback_wls = 1, targets that are ill-conditioned or singular get the values of WLS and are
        SPH_FELL_BACK. Where there is no answer, the values and the status are as for CSPM, but with 2, 5 or 9
        neighbours. Atlas: gradient exact for quadratic fields; order 2 inside lattices, 2 in disorder, 2 at
        boundaries. Atlas: Laplacian exact for quadratic fields, inside lattices for cubic fields; order 2
        inside lattices, 1 in disorder, 1 at boundaries. Atlas: Hessian exact for quadratic fields, inside
        lattices for cubic fields; order 2 inside lattices, 1 in disorder, 1 at boundaries.

        conditioning_min: A target whose |conditioning| is smaller is SPH_ILL_CONDITIONED; >= 0. 0: no target
        is.
        fallback_wls: For ICSPM and Fatehi-Manzari. 1: targets that are singular or ill-conditioned get the
        values of WLS.
        """
        return self._call("derivatives_icspm", locals())

    def derivatives_fatehi_manzari(
        self,
        f: Scalars,
        conditioning_min: float = 0.0,
        fallback_wls: int = 0,
    ) -> Any:
        """sph_derivatives_fatehi_manzari: likewise; keeps signs

        Gradient, Hessian and Laplacian by Fatehi & Manzari 2011, Comput. Math. Appl. 61, 482: with B = -(sum
        V_j x_ij grad W)^-1 and <grad f> = sum V_j (f_j - f_i) B grad W, <lap f>_i = Bh : sum_j 2 V_j e grad W
        ((f_i - f_j) / r - e . <grad f>),   e = x_ij / r, Bh : [sum V_j r e e e grad W + (sum V_j e e grad W)
        . B . (sum V_j x_ij x_ij grad W)] = -1 (unit matrix), computed as the trace of the Hessian of the
        block system (see the chapter's opening; the paper has the Laplacian only). Exact for quadratic
        fields. In disordered clouds it is as accurate in the interior as WLS and keeps the signs of the
        weights, which ICSPM does not; at a boundary single particles come near det(kappa) = 0. conditioning,
        conditioning_min, fallback_wls and the status are as for ICSPM: with conditioning_min = 0 a particle
        with a large error there is SPH_OK. Atlas: Laplacian exact for quadratic fields, inside lattices for
        cubic fields; order 2 inside lattices, 1 in disorder, 1 at boundaries. Atlas: Hessian exact for
        quadratic fields, inside lattices for cubic fields; order 2 inside lattices, 1 in disorder, 1 at
        boundaries.

        conditioning_min: A target whose |conditioning| is smaller is SPH_ILL_CONDITIONED; >= 0. 0: no target
        is.
        fallback_wls: For ICSPM and Fatehi-Manzari. 1: targets that are singular or ill-conditioned get the
        values of WLS.
        """
        return self._call("derivatives_fatehi_manzari", locals())

    def derivatives_wls(self, f: Scalars, conditioning_min: float = 0.0, fallback_wls: int = 0) -> Any:
        """sph_derivatives_wls: likewise, by least squares: robust

        Gradient, Hessian and Laplacian by weighted least squares, the robust sibling of ICSPM. They are exact
        for quadratic fields. Where kernel and volumes are not negative, the matrix is definite wherever the
        neighbours determine a quadratic field, and conditioning, which is that of ICSPM, is in [0, 1].
        conditioning_min, and the values and the status where there is no answer, are as for ICSPM; there is
        no fallback. Atlas: gradient exact for quadratic fields; order 2 inside lattices, 2 in disorder, 2 at
        boundaries. Atlas: Laplacian exact for quadratic fields, inside lattices for cubic fields; order 2
        inside lattices, 1 in disorder, 1 at boundaries. Atlas: Hessian exact for quadratic fields, inside
        lattices for cubic fields; order 2 inside lattices, 1 in disorder, 1 at boundaries.

        conditioning_min: A target whose |conditioning| is smaller is SPH_ILL_CONDITIONED; >= 0. 0: no target
        is.
        fallback_wls: For ICSPM and Fatehi-Manzari. 1: targets that are singular or ill-conditioned get the
        values of WLS.
        """
        return self._call("derivatives_wls", locals())

    def derivatives_rows_cspm(self, gradient: Sequence[float] = (), hessian: Sequence[float] = ()) -> Any:
        """sph_derivatives_rows_cspm: rows of a combination d of derivatives

        Rows of the operator d (see sph_jet) by CSPM: sum_p row[p] (f_j - f_i) = factor[i] D f_i with factor
        1. It is exact for what sph_derivatives_cspm is exact for. The row of a target that is not SPH_OK is
        0, and so is its factor. SPH_ERROR_VALUE for a d that is not finite.
        """
        return self._call("derivatives_rows_cspm", locals())

    def derivatives_rows_icspm(self, gradient: Sequence[float] = (), hessian: Sequence[float] = ()) -> Any:
        """sph_derivatives_rows_icspm: with the factor kappa

        The same by ICSPM: sum_p row[p] (f_j - f_i) = factor[i] D f_i, exact for quadratic fields. The factor
        is the kappa of the paper. In 1D the rows are those of CSPM, and a boundary value problem u'' = b
        becomes sum_p row[p] (u_j - u_i) = kappa_i b(x_i). Nothing is ever divided by kappa, so that a target
        where kappa is 0 is SPH_OK here.

        (What is the same: see derivatives_rows_cspm.)
        """
        return self._call("derivatives_rows_icspm", locals())

    def derivatives_rows_fatehi_manzari(
        self,
        gradient: Sequence[float] = (),
        hessian: Sequence[float] = (),
    ) -> Any:
        """sph_derivatives_rows_fatehi_manzari.

        The same by Fatehi & Manzari, exact for quadratic fields, with a factor as for ICSPM: the row of the
        paper is row[p] / factor[i].

        (What is the same: see derivatives_rows_cspm.)
        """
        return self._call("derivatives_rows_fatehi_manzari", locals())

    def derivatives_rows_wls(self, gradient: Sequence[float] = (), hessian: Sequence[float] = ()) -> Any:
        """sph_derivatives_rows_wls.

        The same by WLS, exact for quadratic fields, with factor 1.

        (What is the same: see derivatives_rows_cspm.)
        """
        return self._call("derivatives_rows_wls", locals())

    def second_derivative_bim(self, f: Scalars, left: int, right: int) -> Array:
        """sph_second_derivative_bim: 1D, with boundary integrals

        The second derivative in 1D by boundary integrals, where `left` and `right` are the particles at the
        ends: f''_i = (1/gamma_i) { sum_j 2 V_j (f_i - f_j) F_ij + sum_b weight_b (f_b - f_i) }, with the
        Shepard sum gamma_i, b = left, right, and weight_b from sph_boundary_weight_bim. Source: (5.16) of the
        ICSPM paper. It is exact for constants. Near a boundary the error is of first order if h grows
        relative to the spacing, as the integrals require. The result is 0 at and beyond the ends
        (SPH_NOT_AVAILABLE), without a neighbour inside the support (SPH_TOO_FEW), and where it overflows
        (SPH_NOT_FINITE). SPH_ERROR_BOX for a periodic axis, SPH_ERROR_RANGE if an end is not a particle,
        SPH_ERROR_POSITION if left is not to the left of right.
        """
        return self._call("second_derivative_bim", locals())

    def second_derivative_rows_bim(self, left: int, right: int) -> Any:
        """sph_second_derivative_rows_bim.

        The same as rows: f''_i = sum_p row[p] (f_j - f_i), with factor 1. The ends left and right must be in
        the lists of the targets whose support reaches them. The row of a target that is not SPH_OK is 0.

        (What is the same: see second_derivative_bim.)
        """
        return self._call("second_derivative_rows_bim", locals())

    def interpolate_mls(
        self,
        f: Scalars,
        points: Vectors = None,
        volume: Scalars = None,
        conditioning_min: float = 0.0,
    ) -> Any:
        """sph_interpolate_mls: moving least squares: exact for linear fields

        Value and gradient of f at the targets of another cloud, by moving least squares (see the chapter's
        opening): exact for linear fields, error O(h^2), any cloud. Of targets_of, the points, lists, h and
        range are read: lists hold every source with r < support of the target (SPH_GATHER with
        SPH_LIST_FOREIGN). f has one value for each source. The box is that of the sources. conditioning is
        that of sph_solve_fit. The states of targets are SPH_OK, SPH_FELL_BACK (Shepard's mean, gradient 0),
        SPH_TOO_FEW (nothing inside the support) and SPH_NOT_FINITE; for the last two all is 0. Returns the
        number of targets that are not SPH_OK, or a negative sph_error. Atlas: value exact for linear fields;
        order 2 inside lattices, 2 in disorder, 2 at boundaries. Atlas: gradient exact for linear fields,
        inside lattices for quadratic fields; order 2 inside lattices, 1 in disorder, 1 at boundaries.

        conditioning_min: A target whose conditioning is smaller gets Shepard's mean; >= 0. 0: only singular
        ones do. 0.001 keeps a fit from extrapolating far with neighbours that are nearly on a line.
        """
        return self._call("interpolate_mls", locals())

    def interpolate_liu(
        self,
        f: Scalars,
        points: Vectors = None,
        volume: Scalars = None,
        conditioning_min: float = 0.0,
    ) -> Any:
        """sph_interpolate_liu: of mDBC walls

        The same by Liu & Liu's test functions W and grad W, as walls by mirror points (mDBC) do it: the
        targets are the mirror points, and sph_fit_extend carries value and gradient from there to the wall
        particles. mDBC falls back where the determinant is below 0.001: its conditioning_min. Atlas: value
        exact for linear fields; order 2 inside lattices, 2 in disorder, 2 at boundaries.

        (What is the same: see interpolate_mls.)

        conditioning_min: A target whose conditioning is smaller gets Shepard's mean; >= 0. 0: only singular
        ones do. 0.001 keeps a fit from extrapolating far with neighbours that are nearly on a line.
        """
        return self._call("interpolate_liu", locals())

    def interpolate_rows_mls(
        self,
        points: Vectors = None,
        volume: Scalars = None,
        conditioning_min: float = 0.0,
    ) -> Any:
        """sph_interpolate_rows_mls: the same as rows

        The value and gradient of sph_interpolate_mls as rows, for many fields of the same particles, and for
        matrices: f = sum_p value[p] f_j, grad f = sum_p (x[p], y[p], z[p]) f_j, p along the list of the
        target. The rows of the value have the sum 1, those of the gradient 0. The rows of a target that is
        SPH_TOO_FEW or SPH_NOT_FINITE are 0.

        conditioning_min: A target whose conditioning is smaller gets Shepard's mean; >= 0. 0: only singular
        ones do. 0.001 keeps a fit from extrapolating far with neighbours that are nearly on a line.
        """
        return self._call("interpolate_rows_mls", locals())

    def interpolate_rows_liu(
        self,
        points: Vectors = None,
        volume: Scalars = None,
        conditioning_min: float = 0.0,
    ) -> Any:
        """sph_interpolate_rows_liu.

        Those of sph_interpolate_liu.

        conditioning_min: A target whose conditioning is smaller gets Shepard's mean; >= 0. 0: only singular
        ones do. 0.001 keeps a fit from extrapolating far with neighbours that are nearly on a line.
        """
        return self._call("interpolate_rows_liu", locals())

    def elliptic_brookshaw(
        self,
        m: Scalars,
        u: Scalars,
        gradient: int = 0,
        mean: int = 0,
        gamma_star: int = 0,
        trace: int = 0,
        conditioning_min: float = 0.0,
        potential: Scalars = None,
        source: Scalars = None,
    ) -> Array:
        """sph_elliptic_brookshaw: sum_j V_j (m_i + m_j) (u_i - u_j) F_ij

        div(m grad u)_i + source_i by the five schemes. The chapter's opening has formulas, sources and
        exactness. h        one for all particles, or one for each. A pair uses (h_i + h_j) / 2, so that the
        list must hold every j with r < support ratio * (h_i + h_j) / 2 (SPH_MEAN). m        the mobility, not
        negative. options  all zeros are the defaults. options.source = sph_scalars_none() adds no source.
        rows     div(m grad u)_i = diagonal[i] u_i + sum_p row[p] u_j, p along the list; factor[i] = 1. For a
        vector unknown compute the rows once, and call sph_rows_apply for each component. trace    In disorder
        tr Gamma^-1 / dim is not the right factor, because tr Gamma tr Gamma^-1 >= dim^2. On jittered clouds
        the rows of Schwaiger's scheme and M-SPH are 0.3 to 0.7 % too large, at any resolution, and solutions
        with a source do not converge. With options.trace = 1 the factor is dim / tr Gamma*. Then sum_j T_ij
        |e|^2 = 2 dim m where m is constant: the result is exact for |x|^2 at any particle. Signs do not
        change, because the weights of a row keep their ratios. This factor is an addition of this toolkit;
        examples/papers/elliptic_clouds.c has the orders of convergence. At most boundary particles it is not
        available, because tr Gamma* is small or negative there. Returns the number of targets that are not
        SPH_OK, or a negative sph_error. The states are: SPH_TOO_FEW, SPH_SINGULAR  the neighbours are too
        few, or lie on a line or in a plane; result and row are 0. Brookshaw's scheme does not have these
        states. SPH_FELL_BACK              computed with Gamma, because Gamma* is not definite (or its trace
        is too small). SPH_ILL_CONDITIONED        computed, but the conditioning is below conditioning_min. It
        is the smallest pivot of the scaled Gamma (1 good, 0 singular). Coincident neighbours have the radial
        weight of r = 0. Atlas: div(m grad u) exact for constants, inside lattices for linear fields; order 0
        inside lattices, -1 in disorder, -1 at boundaries.

        gradient: an sph_elliptic_gradient
        mean: an sph_mobility_mean
        gamma_star: For M-SPH only. 1: Gamma* (71) where it is definite, else Gamma and SPH_FELL_BACK.
        trace: For Schwaiger and M-SPH. 1: scale = dim / tr Gamma* where tr Gamma* is large enough, else
        SPH_FELL_BACK. It takes the place of gamma_star. See the sweeps below.
        conditioning_min: Particles with a lower conditioning are SPH_ILL_CONDITIONED, but they are computed.
        potential: read for SPH_MOBILITY_UPWIND only
        source: of the targets; is added to the result, if it is there; rows do not contain it
        """
        return self._call("elliptic_brookshaw", locals())

    def elliptic_brookshaw_corrected(
        self,
        m: Scalars,
        u: Scalars,
        gradient: int = 0,
        mean: int = 0,
        gamma_star: int = 0,
        trace: int = 0,
        conditioning_min: float = 0.0,
        potential: Scalars = None,
        source: Scalars = None,
    ) -> Array:
        """sph_elliptic_brookshaw_corrected: times tr C / dim

        The same by (51): Brookshaw's scheme times tr K^-1 / dim. Atlas: div(m grad u) exact for constants,
        inside lattices for cubic fields; order 2 inside lattices, -1 in disorder, -1 at boundaries.

        (What is the same: see elliptic_brookshaw.)

        gradient: an sph_elliptic_gradient
        mean: an sph_mobility_mean
        gamma_star: For M-SPH only. 1: Gamma* (71) where it is definite, else Gamma and SPH_FELL_BACK.
        trace: For Schwaiger and M-SPH. 1: scale = dim / tr Gamma* where tr Gamma* is large enough, else
        SPH_FELL_BACK. It takes the place of gamma_star. See the sweeps below.
        conditioning_min: Particles with a lower conditioning are SPH_ILL_CONDITIONED, but they are computed.
        potential: read for SPH_MOBILITY_UPWIND only
        source: of the targets; is added to the result, if it is there; rows do not contain it
        """
        return self._call("elliptic_brookshaw_corrected", locals())

    def elliptic_schwaiger(
        self,
        m: Scalars,
        u: Scalars,
        gradient: int = 0,
        mean: int = 0,
        gamma_star: int = 0,
        trace: int = 0,
        conditioning_min: float = 0.0,
        potential: Scalars = None,
        source: Scalars = None,
    ) -> Array:
        """sph_elliptic_schwaiger: exact for linear u and constant m

        The same by (52), Schwaiger's scheme: exact for linear u where m is constant. Atlas: div(m grad u)
        exact for linear fields, inside lattices for cubic fields; order 2 inside lattices, 0 in disorder, 0
        at boundaries.

        (What is the same: see elliptic_brookshaw.)

        gradient: an sph_elliptic_gradient
        mean: an sph_mobility_mean
        gamma_star: For M-SPH only. 1: Gamma* (71) where it is definite, else Gamma and SPH_FELL_BACK.
        trace: For Schwaiger and M-SPH. 1: scale = dim / tr Gamma* where tr Gamma* is large enough, else
        SPH_FELL_BACK. It takes the place of gamma_star. See the sweeps below.
        conditioning_min: Particles with a lower conditioning are SPH_ILL_CONDITIONED, but they are computed.
        potential: read for SPH_MOBILITY_UPWIND only
        source: of the targets; is added to the result, if it is there; rows do not contain it
        """
        return self._call("elliptic_schwaiger", locals())

    def elliptic_msph(
        self,
        m: Scalars,
        u: Scalars,
        gradient: int = 0,
        mean: int = 0,
        gamma_star: int = 0,
        trace: int = 0,
        conditioning_min: float = 0.0,
        potential: Scalars = None,
        source: Scalars = None,
    ) -> Array:
        """sph_elliptic_msph: the same numbers for radial gradients

        The same by (69), M-SPH: for radial gradients the same numbers as Schwaiger's scheme. Atlas: div(m
        grad u) exact for linear fields, inside lattices for cubic fields; order 2 inside lattices, 0 in
        disorder, 0 at boundaries.

        (What is the same: see elliptic_brookshaw.)

        gradient: an sph_elliptic_gradient
        mean: an sph_mobility_mean
        gamma_star: For M-SPH only. 1: Gamma* (71) where it is definite, else Gamma and SPH_FELL_BACK.
        trace: For Schwaiger and M-SPH. 1: scale = dim / tr Gamma* where tr Gamma* is large enough, else
        SPH_FELL_BACK. It takes the place of gamma_star. See the sweeps below.
        conditioning_min: Particles with a lower conditioning are SPH_ILL_CONDITIONED, but they are computed.
        potential: read for SPH_MOBILITY_UPWIND only
        source: of the targets; is added to the result, if it is there; rows do not contain it
        """
        return self._call("elliptic_msph", locals())

    def elliptic_basic_degiuli_ban(
        self,
        m: Scalars,
        u: Scalars,
        gradient: int = 0,
        mean: int = 0,
        gamma_star: int = 0,
        trace: int = 0,
        conditioning_min: float = 0.0,
        potential: Scalars = None,
        source: Scalars = None,
    ) -> Array:
        """sph_elliptic_basic_degiuli_ban: without derivatives of the kernel; exact for |x|^2

        The same by Basic, Degiuli & Ban 2018, JCP 354, 269: exact for linear u and for |x|^2 where m is
        constant, and for no other quadratic field at a boundary. It needs no derivative of the kernel.
        options.gradient, gamma_star and trace are not read: the scale is always dim / tr Gamma*. Where tr
        Gamma* is below a tenth of tr Gamma, as at one-sided particles, their denominator is small or
        negative; the scale is then tr Gamma^-1 / dim, and the particle is SPH_FELL_BACK. Atlas: div(m grad u)
        exact for linear fields, inside lattices for cubic fields; order 2 inside lattices, 0 in disorder, 0
        at boundaries.

        (What is the same: see elliptic_brookshaw.)

        gradient: an sph_elliptic_gradient
        mean: an sph_mobility_mean
        gamma_star: For M-SPH only. 1: Gamma* (71) where it is definite, else Gamma and SPH_FELL_BACK.
        trace: For Schwaiger and M-SPH. 1: scale = dim / tr Gamma* where tr Gamma* is large enough, else
        SPH_FELL_BACK. It takes the place of gamma_star. See the sweeps below.
        conditioning_min: Particles with a lower conditioning are SPH_ILL_CONDITIONED, but they are computed.
        potential: read for SPH_MOBILITY_UPWIND only
        source: of the targets; is added to the result, if it is there; rows do not contain it
        """
        return self._call("elliptic_basic_degiuli_ban", locals())

    def elliptic_rows_brookshaw(
        self,
        m: Scalars,
        gradient: int = 0,
        mean: int = 0,
        gamma_star: int = 0,
        trace: int = 0,
        conditioning_min: float = 0.0,
        potential: Scalars = None,
        source: Scalars = None,
    ) -> Any:
        """sph_elliptic_rows_brookshaw: rows (meshless transmissibilities)

        The rows of sph_elliptic_brookshaw (meshless transmissibilities), without its source.

        gradient: an sph_elliptic_gradient
        mean: an sph_mobility_mean
        gamma_star: For M-SPH only. 1: Gamma* (71) where it is definite, else Gamma and SPH_FELL_BACK.
        trace: For Schwaiger and M-SPH. 1: scale = dim / tr Gamma* where tr Gamma* is large enough, else
        SPH_FELL_BACK. It takes the place of gamma_star. See the sweeps below.
        conditioning_min: Particles with a lower conditioning are SPH_ILL_CONDITIONED, but they are computed.
        potential: read for SPH_MOBILITY_UPWIND only
        source: of the targets; is added to the result, if it is there; rows do not contain it
        """
        return self._call("elliptic_rows_brookshaw", locals())

    def elliptic_rows_brookshaw_corrected(
        self,
        m: Scalars,
        gradient: int = 0,
        mean: int = 0,
        gamma_star: int = 0,
        trace: int = 0,
        conditioning_min: float = 0.0,
        potential: Scalars = None,
        source: Scalars = None,
    ) -> Any:
        """sph_elliptic_rows_brookshaw_corrected.

        The rows of sph_elliptic_brookshaw_corrected.

        gradient: an sph_elliptic_gradient
        mean: an sph_mobility_mean
        gamma_star: For M-SPH only. 1: Gamma* (71) where it is definite, else Gamma and SPH_FELL_BACK.
        trace: For Schwaiger and M-SPH. 1: scale = dim / tr Gamma* where tr Gamma* is large enough, else
        SPH_FELL_BACK. It takes the place of gamma_star. See the sweeps below.
        conditioning_min: Particles with a lower conditioning are SPH_ILL_CONDITIONED, but they are computed.
        potential: read for SPH_MOBILITY_UPWIND only
        source: of the targets; is added to the result, if it is there; rows do not contain it
        """
        return self._call("elliptic_rows_brookshaw_corrected", locals())

    def elliptic_rows_schwaiger(
        self,
        m: Scalars,
        gradient: int = 0,
        mean: int = 0,
        gamma_star: int = 0,
        trace: int = 0,
        conditioning_min: float = 0.0,
        potential: Scalars = None,
        source: Scalars = None,
    ) -> Any:
        """sph_elliptic_rows_schwaiger.

        The rows of sph_elliptic_schwaiger.

        gradient: an sph_elliptic_gradient
        mean: an sph_mobility_mean
        gamma_star: For M-SPH only. 1: Gamma* (71) where it is definite, else Gamma and SPH_FELL_BACK.
        trace: For Schwaiger and M-SPH. 1: scale = dim / tr Gamma* where tr Gamma* is large enough, else
        SPH_FELL_BACK. It takes the place of gamma_star. See the sweeps below.
        conditioning_min: Particles with a lower conditioning are SPH_ILL_CONDITIONED, but they are computed.
        potential: read for SPH_MOBILITY_UPWIND only
        source: of the targets; is added to the result, if it is there; rows do not contain it
        """
        return self._call("elliptic_rows_schwaiger", locals())

    def elliptic_rows_msph(
        self,
        m: Scalars,
        gradient: int = 0,
        mean: int = 0,
        gamma_star: int = 0,
        trace: int = 0,
        conditioning_min: float = 0.0,
        potential: Scalars = None,
        source: Scalars = None,
    ) -> Any:
        """sph_elliptic_rows_msph.

        The rows of sph_elliptic_msph.

        gradient: an sph_elliptic_gradient
        mean: an sph_mobility_mean
        gamma_star: For M-SPH only. 1: Gamma* (71) where it is definite, else Gamma and SPH_FELL_BACK.
        trace: For Schwaiger and M-SPH. 1: scale = dim / tr Gamma* where tr Gamma* is large enough, else
        SPH_FELL_BACK. It takes the place of gamma_star. See the sweeps below.
        conditioning_min: Particles with a lower conditioning are SPH_ILL_CONDITIONED, but they are computed.
        potential: read for SPH_MOBILITY_UPWIND only
        source: of the targets; is added to the result, if it is there; rows do not contain it
        """
        return self._call("elliptic_rows_msph", locals())

    def elliptic_rows_basic_degiuli_ban(
        self,
        m: Scalars,
        gradient: int = 0,
        mean: int = 0,
        gamma_star: int = 0,
        trace: int = 0,
        conditioning_min: float = 0.0,
        potential: Scalars = None,
        source: Scalars = None,
    ) -> Any:
        """sph_elliptic_rows_basic_degiuli_ban.

        The rows of sph_elliptic_basic_degiuli_ban.

        gradient: an sph_elliptic_gradient
        mean: an sph_mobility_mean
        gamma_star: For M-SPH only. 1: Gamma* (71) where it is definite, else Gamma and SPH_FELL_BACK.
        trace: For Schwaiger and M-SPH. 1: scale = dim / tr Gamma* where tr Gamma* is large enough, else
        SPH_FELL_BACK. It takes the place of gamma_star. See the sweeps below.
        conditioning_min: Particles with a lower conditioning are SPH_ILL_CONDITIONED, but they are computed.
        potential: read for SPH_MOBILITY_UPWIND only
        source: of the targets; is added to the result, if it is there; rows do not contain it
        """
        return self._call("elliptic_rows_basic_degiuli_ban", locals())

    def elliptic_diagnose(
        self,
        gradient: int = 0,
        mean: int = 0,
        gamma_star: int = 0,
        trace: int = 0,
        conditioning_min: float = 0.0,
        potential: Scalars = None,
        source: Scalars = None,
    ) -> Any:
        """sph_elliptic_diagnose: signs, moments, free-surface indicator

        Fills an sph_elliptic_report for each target. Lists as for the elliptic sweeps; mobilities do not
        matter. Where the status is SPH_TOO_FEW or SPH_SINGULAR, sign_least, sign_most and xi are 0; the other
        numbers are computed. Returns the number of targets that are not SPH_OK, or a negative sph_error.

        gradient: an sph_elliptic_gradient
        mean: an sph_mobility_mean
        gamma_star: For M-SPH only. 1: Gamma* (71) where it is definite, else Gamma and SPH_FELL_BACK.
        trace: For Schwaiger and M-SPH. 1: scale = dim / tr Gamma* where tr Gamma* is large enough, else
        SPH_FELL_BACK. It takes the place of gamma_star. See the sweeps below.
        conditioning_min: Particles with a lower conditioning are SPH_ILL_CONDITIONED, but they are computed.
        potential: read for SPH_MOBILITY_UPWIND only
        source: of the targets; is added to the result, if it is there; rows do not contain it
        """
        return self._call("elliptic_diagnose", locals())

    def elliptic_rows_anisotropic(self, mobility: Vectors) -> Any:
        """sph_elliptic_rows_anisotropic: div(M grad u), M diagonal

        Rows of div(M grad u) for a diagonal M that are consistent on full supports. (69) is not, because of
        the fourth moment: sum_j V_j G e_a e_b sum_c M_c e_c^2 / |e|^2 with G = -F_ij is not M_a delta_ab. It
        is, if M is replaced by S = T^-1 M with T_ac = sum V_j G e_a^2 e_c^2 / |e|^2. The rows are row = V_j G
        sum_c S(M_i + M_j)_c (e_c^2 / |e|^2 - (K^-1 N_c) . e), N_c = sum V_j G e e_c^2 / |e|^2,   K = sum V_j
        G e e^T. In the continuum S = ((dim + 2) M - tr M) / 2. If all neighbours lie on the axes, T is
        diagonal and the rows are those of M-SPH; so they are for isotropic M where T is isotropic. This form
        is an addition of this toolkit. Exact for linear fields (M constant) at every particle, and for xx,
        yy, zz in the interior of lattices; elsewhere the error is O(disorder). Signs: S may be negative if
        M_x / M_y is beyond 3 (2D). Weights then have both signs, and maximum principles are lost. The
        gradient is (15), means are arithmetic, a pair uses (h_i + h_j) / 2 (lists by SPH_MEAN). A row is 0
        where the state is SPH_TOO_FEW or SPH_SINGULAR: K or T is singular. T is so where neighbours lie in
        fewer directions than there are axes. Returns the number of targets that are not SPH_OK, or a negative
        sph_error. Atlas: div(m grad u) exact for linear fields, inside lattices for cubic fields; order 2
        inside lattices, 0 in disorder, 0 at boundaries.
        """
        return self._call("elliptic_rows_anisotropic", locals())

    def elliptic_tensor(self, mobility: Matrices, u: Scalars) -> Array:
        """sph_elliptic_tensor: div(M grad u) for any symmetric M

        div(M grad u) for a full symmetric tensor M of each particle, at any orientation of its axes: L u_i =
        sum_j V_j G sum_s S(M_i + M_j)_s (q_s / |e|^2 - (K^-1 N_s) . e) (u_j - u_i) with G = -F_ij, e = x_j -
        x_i, the products q_s of the components of e (xx, xy, yy, ...), and S(M) = T^-1 M,   T_rs = sum_j V_j
        G q_r (q_s / |e|^2 - (K^-1 N_s) . e), N_s = sum_j V_j G e q_s / |e|^2,   K = sum_j V_j G e e^T. It is
        the form of sph_elliptic_rows_anisotropic with all products in the place of the squares, and with
        third moments in T. An addition of this toolkit. Exact for linear and quadratic u (M constant), and
        for products of a linear M and a linear u, at every particle that is SPH_OK: also in disorder, and
        where the support is cut off, if enough neighbours are left. The error is O(h^2) in the interior of
        lattices, and O(h) elsewhere. M is the symmetric part of the matrices; it should be positive
        semidefinite, of which the diagonal is checked. Signs: weights have both signs where M is far from
        isotropic (in 2D and on the axes, beyond a ratio of 3), and in disorder; maximum principles are lost
        then. The gradient is (15), means are arithmetic, a pair uses (h_i + h_j) / 2 (lists by SPH_MEAN). The
        result is 0 where the state is SPH_TOO_FEW or SPH_SINGULAR: K or T is singular, as it is where the
        neighbours lie in fewer directions than a quadratic form has coefficients (four neighbours on the axes
        do not see xy). Returns the number of targets that are not SPH_OK, or a negative sph_error. Atlas:
        div(m grad u) exact for quadratic fields, inside lattices for cubic fields; order 2 inside lattices, 1
        in disorder, 1 at boundaries.
        """
        return self._call("elliptic_tensor", locals())

    def elliptic_rows_tensor(self, mobility: Matrices) -> Any:
        """sph_elliptic_rows_tensor.

        The same as rows, with the factor 1. conditioning is the smallest pivot of K (scaled to a unit
        diagonal) and T / tr K.

        (What is the same: see elliptic_tensor.)
        """
        return self._call("elliptic_rows_tensor", locals())

    def elliptic_rows_boundary(
        self,
        m: Scalars,
        gradient: int = 0,
        mean: int = 0,
        gamma_star: int = 0,
        trace: int = 0,
        conditioning_min: float = 0.0,
        potential: Scalars = None,
        source: Scalars = None,
        normal: Vectors = None,
        alpha: Scalars = None,
        beta: Scalars = None,
    ) -> Any:
        """sph_elliptic_rows_boundary: Dirichlet, Neumann, Robin

        Rows of alpha_i u_i + beta_i m_i n_i . grad u for the targets where alpha or beta is not 0. The rows
        of the others are left as they are: write the rows of the operator first, then these over them.
        Dirichlet  alpha = 1, beta = 0. Neumann    alpha = 0, beta = 1: m n . grad u, the flux into the domain
        through a boundary with the outer normal n. Robin      both are not 0. (100) of Lukyanov & Vuik 2020
        with the corrected gradient grad u = K^-T sum V_j g (u_j - u_i). Exact for linear fields, error O(h).
        The length of n counts: it multiplies beta. out.diagonal must not be null. A row with the state
        SPH_TOO_FEW or SPH_SINGULAR is 0, with its diagonal. Returns the number of boundary targets that are
        not SPH_OK, or a negative sph_error.

        gradient: an sph_elliptic_gradient
        mean: an sph_mobility_mean
        gamma_star: For M-SPH only. 1: Gamma* (71) where it is definite, else Gamma and SPH_FELL_BACK.
        trace: For Schwaiger and M-SPH. 1: scale = dim / tr Gamma* where tr Gamma* is large enough, else
        SPH_FELL_BACK. It takes the place of gamma_star. See the sweeps below.
        conditioning_min: Particles with a lower conditioning are SPH_ILL_CONDITIONED, but they are computed.
        potential: read for SPH_MOBILITY_UPWIND only
        source: of the targets; is added to the result, if it is there; rows do not contain it
        normal: n, which points out of the domain
        alpha: of u, and of m n . grad u
        beta: of u, and of m n . grad u
        """
        return self._call("elliptic_rows_boundary", locals())

    def rows_apply(self, row: Scalars, diagonal: Scalars, u: Scalars) -> Array:
        """sph_rows_apply: sum_p row[p] (u_j - u_i)

        out_i = sum_p row[p] (u_j - u_i), which is exactly 0 for constants. If diagonal is given, out_i =
        diagonal[i] u_i + sum_p row[p] u_j. Rows with a factor give factor[i] times the operator. Returns the
        number of targets whose result overflowed (it is 0 then), or a negative sph_error.
        """
        return self._call("rows_apply", locals())

    def rows_monotone(self, row: Scalars, diagonal: Scalars) -> Any:
        """sph_rows_monotone: how many rows are not of an M-matrix

        Counts the rows that are not rows of an M-matrix. A row is one if its off-diagonal weights do not
        differ in sign, and the diagonal has the other sign and at least the size of their sum: Lukyanov &
        Vuik 2020, Definition 7. The dominance need not be strict, because the rows of an operator have the
        sum 0. A connected matrix of such rows, of which one is a Dirichlet row, is monotone: the solution has
        no maximum in the interior. Weights below the rounding error of the largest weight of a row do not
        count. monotone[i] (the pointer may be null) is 1 for rows of an M-matrix, else 0. Returns the number
        of the others, or a negative sph_error.
        """
        return self._call("rows_monotone", locals())

    def rows_time_step(self, row: Scalars) -> Any:
        """sph_rows_time_step: longest stable explicit step

        The longest stable step of du/dt = L u for the explicit Euler method, by Gershgorin's circles: dt = 2
        / max_i (|sum_p row| + sum_p |row|). It is certain where all weights are >= 0; it then also keeps
        maxima from growing. Half of it also keeps every mode from changing its sign from step to step. On a
        uniform lattice with the 2 dim nearest neighbours it is dx^2 / (2 dim m). *dt = 1/SPHI_TINY if nothing
        limits the step. Returns 0 or a negative sph_error.
        """
        return self._call("rows_time_step", locals())

    def rows_growth(self, row: Scalars, tau: float, wave: Sequence[float]) -> Any:
        """sph_rows_growth: von Neumann's growth factor

        The growth factor lambda = 1 + tau sum_p row[p] (exp(i k . e) - 1) of a wave with the wave vector k
        (`wave`) at the first target, for the step u + tau L u (von Neumann). It is stable if |lambda| <= 1.
        (83) of Lukyanov & Vuik 2020. *re and *im are the real and the imaginary part. Returns 0; or 1 if they
        are not finite; or a negative sph_error. It writes nothing with the last two, and without targets.
        """
        return self._call("rows_growth", locals())

    def density_number(self, m: Scalars) -> Array:
        """sph_density_number: m_i sum_j W_ij

        rho_i = m_i sum_j W_ij(h_i) with the particle itself: the number density times the particle's own
        mass, so that a light particle beside heavy ones keeps its density. V_i = m_i / rho_i is then 1 /
        sum_j W_ij. Hu & Adams 2006, JCP 213, 844, (15). Only the m of the targets is read. Returns the number
        of targets whose density overflowed (it is 0 then), or a negative sph_error. Atlas: value exact for
        nothing; order 0 inside lattices, 0 in disorder, 0 at boundaries.
        """
        return self._call("density_number", locals())

    def fluid_rates_monaghan(
        self,
        m: Scalars = None,
        rho: Scalars = None,
        p: Scalars = None,
        c: Scalars = None,
        v: Vectors = None,
        viscosity: int = 0,
        alpha: float = 0.0,
        beta: float = 0.0,
        eta: float = 0.0,
    ) -> Any:
        """sph_fluid_rates_monaghan: acceleration, density, heating

        Acceleration, density rate and viscous heating of the targets, in one pass: a_i      = -sum_j m_j
        (P_ij + Pi_ij) grad_i W_ij, du_i/dt  = sum_j m_j Pi_ij v_ij . grad_i W_ij / 2, drho_i/dt by
        sph_density_rate_pair_mass or sph_density_rate_pair_volume. monaghan    (2.2), (2.3): drho_i/dt =
        sum_j m_j v_ij . grad_i W_ij. colagrossi  (5.23), (5.24): drho_i/dt = rho_i sum_j m_j / rho_j v_ij .
        grad_i W_ij. hu_adams    weighted by volumes. The density comes from sph_density_number, or from the
        rate (5.23), which is the one that this sweep writes. Signs: F <= 0, so that pressure pushes particles
        apart. Gravity and the work of the pressure on u are not contained. out.rate is that of the velocities
        given: see the order of a step above. out.rate and out.heating may be null. Pairs closer than 1e-12 h
        exert no force on each other (sph_coincident_count finds them). Returns the number of targets of which
        a result overflowed (it is 0 then), or a negative sph_error: SPH_ERROR_VALUE also for densities and
        masses that are not positive, and sound speeds that are negative. Atlas: gradient exact for nothing,
        inside lattices for constants; order 0 inside lattices, -1 in disorder, -1 at boundaries. Atlas: keeps
        momentum and angular momentum; energy never grows.

        m: mass, density, pressure, sound speed >= 0 (for artificial viscosity)
        rho: mass, density, pressure, sound speed >= 0 (for artificial viscosity)
        p: mass, density, pressure, sound speed >= 0 (for artificial viscosity)
        c: mass, density, pressure, sound speed >= 0 (for artificial viscosity)
        v: velocity
        viscosity: the artificial viscosity: an sph_viscosity
        alpha: its coefficients, pure numbers
        beta: its coefficients, pure numbers
        eta: softens r^2 to r^2 + eta^2 h^2; 0 means the usual 0.1, a negative number none
        """
        return self._call("fluid_rates_monaghan", locals())

    def fluid_rates_colagrossi(
        self,
        m: Scalars = None,
        rho: Scalars = None,
        p: Scalars = None,
        c: Scalars = None,
        v: Vectors = None,
        viscosity: int = 0,
        alpha: float = 0.0,
        beta: float = 0.0,
        eta: float = 0.0,
    ) -> Any:
        """sph_fluid_rates_colagrossi.

        The same by Colagrossi & Landrini, (5.23), (5.24): for densities that jump.

        (What is the same: see fluid_rates_monaghan.)

        m: mass, density, pressure, sound speed >= 0 (for artificial viscosity)
        rho: mass, density, pressure, sound speed >= 0 (for artificial viscosity)
        p: mass, density, pressure, sound speed >= 0 (for artificial viscosity)
        c: mass, density, pressure, sound speed >= 0 (for artificial viscosity)
        v: velocity
        viscosity: the artificial viscosity: an sph_viscosity
        alpha: its coefficients, pure numbers
        beta: its coefficients, pure numbers
        eta: softens r^2 to r^2 + eta^2 h^2; 0 means the usual 0.1, a negative number none
        """
        return self._call("fluid_rates_colagrossi", locals())

    def fluid_rates_hu_adams(
        self,
        m: Scalars = None,
        rho: Scalars = None,
        p: Scalars = None,
        c: Scalars = None,
        v: Vectors = None,
        viscosity: int = 0,
        alpha: float = 0.0,
        beta: float = 0.0,
        eta: float = 0.0,
    ) -> Any:
        """sph_fluid_rates_hu_adams.

        The same by Hu & Adams, weighted by volumes: for densities that jump.

        (What is the same: see fluid_rates_monaghan.)

        m: mass, density, pressure, sound speed >= 0 (for artificial viscosity)
        rho: mass, density, pressure, sound speed >= 0 (for artificial viscosity)
        p: mass, density, pressure, sound speed >= 0 (for artificial viscosity)
        c: mass, density, pressure, sound speed >= 0 (for artificial viscosity)
        v: velocity
        viscosity: the artificial viscosity: an sph_viscosity
        alpha: its coefficients, pure numbers
        beta: its coefficients, pure numbers
        eta: softens r^2 to r^2 + eta^2 h^2; 0 means the usual 0.1, a negative number none
        """
        return self._call("fluid_rates_hu_adams", locals())

    def viscosity_mu_morris(
        self,
        mu: Scalars,
        m: Scalars = None,
        rho: Scalars = None,
        p: Scalars = None,
        c: Scalars = None,
        v: Vectors = None,
        viscosity: int = 0,
        alpha: float = 0.0,
        beta: float = 0.0,
        eta: float = 0.0,
    ) -> Array:
        """sph_viscosity_mu_morris: physical viscosity

        a_i = (1 / rho) div(mu grad v), physical viscosity by sph_viscosity_mu_pair_morris. mu is the dynamic
        viscosity (nu rho) of each particle, and not negative. Of fluid, the members m, rho, v and eta are
        read. Pairs closer than 1e-12 h exert no force on each other. Returns the number of targets whose
        result overflowed (it is 0 then), or a negative sph_error. Atlas: Laplacian exact for constants,
        inside lattices for linear fields; order 0 inside lattices, -1 in disorder, -1 at boundaries.

        m: mass, density, pressure, sound speed >= 0 (for artificial viscosity)
        rho: mass, density, pressure, sound speed >= 0 (for artificial viscosity)
        p: mass, density, pressure, sound speed >= 0 (for artificial viscosity)
        c: mass, density, pressure, sound speed >= 0 (for artificial viscosity)
        v: velocity
        viscosity: the artificial viscosity: an sph_viscosity
        alpha: its coefficients, pure numbers
        beta: its coefficients, pure numbers
        eta: softens r^2 to r^2 + eta^2 h^2; 0 means the usual 0.1, a negative number none
        """
        return self._call("viscosity_mu_morris", locals())

    def viscosity_mu_monaghan_cleary(
        self,
        mu: Scalars,
        m: Scalars = None,
        rho: Scalars = None,
        p: Scalars = None,
        c: Scalars = None,
        v: Vectors = None,
        viscosity: int = 0,
        alpha: float = 0.0,
        beta: float = 0.0,
        eta: float = 0.0,
    ) -> Array:
        """sph_viscosity_mu_monaghan_cleary.

        The same by sph_viscosity_mu_pair_monaghan_cleary. It also conserves angular momentum. But on a square
        lattice that nothing has disturbed it depends on the direction: with the cubic spline and h = 1.2 dx a
        shear wave is damped as by 0.79 mu along an axis and 1.17 mu along the diagonal, where Morris's form
        has 0.98 mu. A longer h and disorder make the difference smaller, and a hexagonal lattice has none:
        see the table of examples/OPERATORS.md. Atlas: Laplacian exact for constants, inside lattices for
        linear fields; order 0 inside lattices, -1 in disorder, -1 at boundaries.

        (What is the same: see viscosity_mu_morris.)

        m: mass, density, pressure, sound speed >= 0 (for artificial viscosity)
        rho: mass, density, pressure, sound speed >= 0 (for artificial viscosity)
        p: mass, density, pressure, sound speed >= 0 (for artificial viscosity)
        c: mass, density, pressure, sound speed >= 0 (for artificial viscosity)
        v: velocity
        viscosity: the artificial viscosity: an sph_viscosity
        alpha: its coefficients, pure numbers
        beta: its coefficients, pure numbers
        eta: softens r^2 to r^2 + eta^2 h^2; 0 means the usual 0.1, a negative number none
        """
        return self._call("viscosity_mu_monaghan_cleary", locals())

    def viscosity_mu_espanol_revenga(
        self,
        m: Scalars = None,
        rho: Scalars = None,
        p: Scalars = None,
        c: Scalars = None,
        v: Vectors = None,
        viscosity: int = 0,
        alpha: float = 0.0,
        beta: float = 0.0,
        eta: float = 0.0,
        shear: Scalars = None,
        bulk: Scalars = None,
    ) -> Array:
        """sph_viscosity_mu_espanol_revenga: with shear and bulk viscosity

        The acceleration by shear and bulk viscosity, by sph_viscosity_mu_pair_espanol_revenga: see there for
        the stress tensor, and for which zeta the kinetic energy can only fall. Else as the two above. Atlas:
        Laplacian exact for constants, inside lattices for linear fields; order 0 inside lattices, -1 in
        disorder, -1 at boundaries.

        m: mass, density, pressure, sound speed >= 0 (for artificial viscosity)
        rho: mass, density, pressure, sound speed >= 0 (for artificial viscosity)
        p: mass, density, pressure, sound speed >= 0 (for artificial viscosity)
        c: mass, density, pressure, sound speed >= 0 (for artificial viscosity)
        v: velocity
        viscosity: the artificial viscosity: an sph_viscosity
        alpha: its coefficients, pure numbers
        beta: its coefficients, pure numbers
        eta: softens r^2 to r^2 + eta^2 h^2; 0 means the usual 0.1, a negative number none
        """
        return self._call("viscosity_mu_espanol_revenga", locals())

    def velocity_xsph(
        self,
        epsilon: float,
        m: Scalars = None,
        rho: Scalars = None,
        p: Scalars = None,
        c: Scalars = None,
        v: Vectors = None,
        viscosity: int = 0,
        alpha: float = 0.0,
        beta: float = 0.0,
        eta: float = 0.0,
    ) -> Array:
        """sph_velocity_xsph.

        What XSPH adds to the velocity that moves a particle: epsilon sum_j 2 m_j / (rho_i + rho_j) (v_j -
        v_i) W_ij. Monaghan 1989, JCP 82, 1. epsilon = 0.5 is usual. It conserves linear momentum, and also
        angular momentum if it moves particles only: do not add it to the velocity that a particle keeps. Of
        fluid, the members m, rho and v are read. Returns the number of targets whose result overflowed (it is
        0 then), or a negative sph_error.

        m: mass, density, pressure, sound speed >= 0 (for artificial viscosity)
        rho: mass, density, pressure, sound speed >= 0 (for artificial viscosity)
        p: mass, density, pressure, sound speed >= 0 (for artificial viscosity)
        c: mass, density, pressure, sound speed >= 0 (for artificial viscosity)
        v: velocity
        viscosity: the artificial viscosity: an sph_viscosity
        alpha: its coefficients, pure numbers
        beta: its coefficients, pure numbers
        eta: softens r^2 to r^2 + eta^2 h^2; 0 means the usual 0.1, a negative number none
        """
        return self._call("velocity_xsph", locals())

    def wall_adami(
        self,
        share: Scalars = None,
        rho: Scalars = None,
        p: Scalars = None,
        v: Vectors = None,
        velocity: Vectors = None,
        normal: Vectors = None,
        gravity: Sequence[float] = (),
    ) -> Any:
        """sph_wall_adami: pressure and velocity of wall particles

        Pressure and velocity of wall particles from the fluid in front of them, so that walls push and drag
        as a fluid would. The targets are the wall particles w; the sums run over their neighbours j that are
        fluid (share[j] = 1): p_w = sum (p_j + rho_j (g - a_w) . x_wj) W / sum W, v_w = 2 u_w - sum v_j W /
        sum W   for no slip. For free slip only the part along the normal is reversed
        (sph_wall_velocity_free_slip). u_w and a_w are the wall's own velocity and acceleration. Adami, Hu &
        Adams 2012, JCP 231, 7057, (22), (23), (27). A pair uses (h_i + h_j) / 2 (lists by SPH_MEAN). Without
        fluid inside the support the answer is p = 0, v = u and SPH_TOO_FEW; such a particle pushes nothing.
        Returns the number of targets that are not SPH_OK, or a negative sph_error.

        share: share: 1 for fluid particles, 0 for all others. rho and p: density and pressure of the fluid.
        rho: share: 1 for fluid particles, 0 for all others. rho and p: density and pressure of the fluid.
        p: share: 1 for fluid particles, 0 for all others. rho and p: density and pressure of the fluid.
        v: v: velocity of the fluid. velocity: the wall's own velocity u. normal: normal of the wall, of any
        length, for free slip; null arrays mean no slip.
        velocity: v: velocity of the fluid. velocity: the wall's own velocity u. normal: normal of the wall,
        of any length, for free slip; null arrays mean no slip.
        normal: v: velocity of the fluid. velocity: the wall's own velocity u. normal: normal of the wall, of
        any length, for free slip; null arrays mean no slip.
        gravity: g - a_w: gravity less the acceleration of the wall
        """
        return self._call("wall_adami", locals())

    def wall_rows_adami(
        self,
        share: Scalars = None,
        rho: Scalars = None,
        p: Scalars = None,
        v: Vectors = None,
        velocity: Vectors = None,
        normal: Vectors = None,
        gravity: Sequence[float] = (),
    ) -> Any:
        """sph_wall_rows_adami: the same pressure as rows of a matrix

        The pressure of sph_wall_adami as rows of a matrix for pressures that are not known yet (projection).
        The targets are the wall particles w: p_w - sum p_j W / sum W = sum rho_j (g - a_w) . x_wj W / sum W,
        row[p] = -W / sum W for neighbours that are fluid and 0 for others, diagonal = 1, and the right-hand
        side is source. These rows are exact where p - rho g . x is constant, thus for fluid at rest. Of wall,
        share, rho and gravity are read. Without fluid inside the support the row is p_w = 0, with
        SPH_TOO_FEW. A pair uses (h_i + h_j) / 2 (lists by SPH_MEAN). Adami, Hu & Adams 2012, JCP 231, 7057,
        (27). The status of out is written, that of source is not. Returns the number of targets that are not
        SPH_OK, or a negative sph_error.

        share: share: 1 for fluid particles, 0 for all others. rho and p: density and pressure of the fluid.
        rho: share: 1 for fluid particles, 0 for all others. rho and p: density and pressure of the fluid.
        p: share: 1 for fluid particles, 0 for all others. rho and p: density and pressure of the fluid.
        v: v: velocity of the fluid. velocity: the wall's own velocity u. normal: normal of the wall, of any
        length, for free slip; null arrays mean no slip.
        velocity: v: velocity of the fluid. velocity: the wall's own velocity u. normal: normal of the wall,
        of any length, for free slip; null arrays mean no slip.
        normal: v: velocity of the fluid. velocity: the wall's own velocity u. normal: normal of the wall, of
        any length, for free slip; null arrays mean no slip.
        gravity: g - a_w: gravity less the acceleration of the wall
        """
        return self._call("wall_rows_adami", locals())

    def wall_rows_eliminate(
        self,
        share: Scalars = None,
        rho: Scalars = None,
        p: Scalars = None,
        v: Vectors = None,
        velocity: Vectors = None,
        normal: Vectors = None,
        gravity: Sequence[float] = (),
    ) -> Any:
        """sph_wall_rows_eliminate: rows of the fluid without unknowns of the wall

        Takes the unknowns of the wall out of the rows of the fluid, sum_p row[p] (p_j - p_i) = b_i. The
        pressure of each wall neighbour w (share = 0) is that of the condition at the wall, dp/dn = rho (g -
        a_w) . n, from the particle i itself: p_w = p_i + rho_i (g - a_w) . x_wi, the formula of
        sph_wall_adami for i alone. So sum over fluid of row[p] (p_j - p_i) = b_i + source_i, source_i = -sum
        over wall of row[p] (p_w - p_i). rows.row is read and written: entries of wall neighbours become 0.
        rows.diagonal, if it is there, becomes -sum_p row[p] again. rows.factor, conditioning and status stay
        as they are. Exact for fluid at rest, if the rows are exact for linear fields; the signs of the rows,
        and so their monotony, are kept. Any other condition dp/dn is passed as gravity with rho = 1. Of wall,
        share, rho and gravity are read. A row whose result is not finite becomes 0. rho is of the targets.
        Returns the number of such rows, or a negative sph_error.

        share: share: 1 for fluid particles, 0 for all others. rho and p: density and pressure of the fluid.
        rho: share: 1 for fluid particles, 0 for all others. rho and p: density and pressure of the fluid.
        p: share: 1 for fluid particles, 0 for all others. rho and p: density and pressure of the fluid.
        v: v: velocity of the fluid. velocity: the wall's own velocity u. normal: normal of the wall, of any
        length, for free slip; null arrays mean no slip.
        velocity: v: velocity of the fluid. velocity: the wall's own velocity u. normal: normal of the wall,
        of any length, for free slip; null arrays mean no slip.
        normal: v: velocity of the fluid. velocity: the wall's own velocity u. normal: normal of the wall, of
        any length, for free slip; null arrays mean no slip.
        gravity: g - a_w: gravity less the acceleration of the wall
        """
        return self._call("wall_rows_eliminate", locals())

    def density_diffusion_molteni(
        self,
        m: Scalars = None,
        rho: Scalars = None,
        p: Scalars = None,
        c: Scalars = None,
        v: Vectors = None,
        viscosity: int = 0,
        alpha: float = 0.0,
        beta: float = 0.0,
        eta: float = 0.0,
        delta: float = 0.0,
        rho0: float = 0.0,
        tait_c: float = 0.0,
        gamma: float = 0.0,
        p0: float = 0.0,
        share: Scalars = None,
        gradient: Vectors = None,
        gravity: Sequence[float] = (),
    ) -> Array:
        """sph_density_diffusion_molteni: density rate with density diffusion

        drho_i/dt = rho_i sum_j V_j v_ij . grad_i W_ij + D_i: the density rate of the liquid with the density
        diffusion of Molteni & Colagrossi. V is the volume of the cloud, m / rho of the same moment. Where
        diffusion.fluid.v is null, the answer is D_i alone. Take the new velocities, as the order of a step in
        the chapter of fluids says. A pair uses (h_i + h_j) / 2: lists by SPH_MEAN, or by any criterion if all
        particles have the same h. D      is delta c h times sph_laplacian_brookshaw of the density, if all
        have the same h. It conserves sum_i V_i rho_i to round-off, and is dissipative: sum_i V_i rho_i D_i <=
        0. It is 0 for constants only: it takes the density of a column at rest for noise. Across a jump of
        rho0 diffuse rho / rho0 instead, or give the other fluid the share 0. Where the sum overflows, the
        result is 0 and SPH_NOT_FINITE. Returns the number of these targets, or a negative sph_error. Sources
        stand at the head of the chapter.

        m: mass, density, pressure, sound speed >= 0 (for artificial viscosity)
        rho: mass, density, pressure, sound speed >= 0 (for artificial viscosity)
        p: mass, density, pressure, sound speed >= 0 (for artificial viscosity)
        c: mass, density, pressure, sound speed >= 0 (for artificial viscosity)
        v: velocity
        viscosity: the artificial viscosity: an sph_viscosity
        alpha: its coefficients, pure numbers
        beta: its coefficients, pure numbers
        eta: softens r^2 to r^2 + eta^2 h^2; 0 means the usual 0.1, a negative number none
        delta: its strength; 0 means the usual 0.1, a negative number none
        share: A pair has the factor share_i share_j: 1 for the liquid, 0 for walls and other fluids. Null:
        all take part.
        gradient: of the density, from sph_gradient_cspm: antuono only
        gravity: fourtakas only
        """
        return self._call("density_diffusion_molteni", locals())

    def density_diffusion_antuono(
        self,
        m: Scalars = None,
        rho: Scalars = None,
        p: Scalars = None,
        c: Scalars = None,
        v: Vectors = None,
        viscosity: int = 0,
        alpha: float = 0.0,
        beta: float = 0.0,
        eta: float = 0.0,
        delta: float = 0.0,
        rho0: float = 0.0,
        tait_c: float = 0.0,
        gamma: float = 0.0,
        p0: float = 0.0,
        share: Scalars = None,
        gradient: Vectors = None,
        gravity: Sequence[float] = (),
    ) -> Array:
        """sph_density_diffusion_antuono: delta-SPH

        The same with the density diffusion of Antuono et al. (delta-SPH): D = 0 to round-off for a linear
        density at any particle, also at a boundary, if diffusion.gradient comes from sph_gradient_cspm.

        (What is the same: see density_diffusion_molteni.)

        m: mass, density, pressure, sound speed >= 0 (for artificial viscosity)
        rho: mass, density, pressure, sound speed >= 0 (for artificial viscosity)
        p: mass, density, pressure, sound speed >= 0 (for artificial viscosity)
        c: mass, density, pressure, sound speed >= 0 (for artificial viscosity)
        v: velocity
        viscosity: the artificial viscosity: an sph_viscosity
        alpha: its coefficients, pure numbers
        beta: its coefficients, pure numbers
        eta: softens r^2 to r^2 + eta^2 h^2; 0 means the usual 0.1, a negative number none
        delta: its strength; 0 means the usual 0.1, a negative number none
        share: A pair has the factor share_i share_j: 1 for the liquid, 0 for walls and other fluids. Null:
        all take part.
        gradient: of the density, from sph_gradient_cspm: antuono only
        gravity: fourtakas only
        """
        return self._call("density_diffusion_antuono", locals())

    def density_diffusion_fourtakas(
        self,
        m: Scalars = None,
        rho: Scalars = None,
        p: Scalars = None,
        c: Scalars = None,
        v: Vectors = None,
        viscosity: int = 0,
        alpha: float = 0.0,
        beta: float = 0.0,
        eta: float = 0.0,
        delta: float = 0.0,
        rho0: float = 0.0,
        tait_c: float = 0.0,
        gamma: float = 0.0,
        p0: float = 0.0,
        share: Scalars = None,
        gradient: Vectors = None,
        gravity: Sequence[float] = (),
    ) -> Array:
        """sph_density_diffusion_fourtakas.

        The same with the density diffusion of Fourtakas et al.: D = 0 to round-off for a density of the slope
        rho0 gravity / c^2 (sph_density_slope) at any particle.

        (What is the same: see density_diffusion_molteni.)

        m: mass, density, pressure, sound speed >= 0 (for artificial viscosity)
        rho: mass, density, pressure, sound speed >= 0 (for artificial viscosity)
        p: mass, density, pressure, sound speed >= 0 (for artificial viscosity)
        c: mass, density, pressure, sound speed >= 0 (for artificial viscosity)
        v: velocity
        viscosity: the artificial viscosity: an sph_viscosity
        alpha: its coefficients, pure numbers
        beta: its coefficients, pure numbers
        eta: softens r^2 to r^2 + eta^2 h^2; 0 means the usual 0.1, a negative number none
        delta: its strength; 0 means the usual 0.1, a negative number none
        share: A pair has the factor share_i share_j: 1 for the liquid, 0 for walls and other fluids. Null:
        all take part.
        gradient: of the density, from sph_gradient_cspm: antuono only
        gravity: fourtakas only
        """
        return self._call("density_diffusion_fourtakas", locals())

    def density_diffusion_rows_molteni(
        self,
        m: Scalars = None,
        rho: Scalars = None,
        p: Scalars = None,
        c: Scalars = None,
        v: Vectors = None,
        viscosity: int = 0,
        alpha: float = 0.0,
        beta: float = 0.0,
        eta: float = 0.0,
        delta: float = 0.0,
        rho0: float = 0.0,
        tait_c: float = 0.0,
        gamma: float = 0.0,
        p0: float = 0.0,
        share: Scalars = None,
        gradient: Vectors = None,
        gravity: Sequence[float] = (),
    ) -> Any:
        """sph_density_diffusion_rows_molteni.

        The D of Molteni & Colagrossi as rows: D_i = sum_p row[p] (rho_j - rho_i), row[p] >= 0, factor 1 and
        conditioning 1. The rates of sph_density_diffusion_molteni without v agree to round-off. A row that
        overflows is 0, with SPH_NOT_FINITE.

        m: mass, density, pressure, sound speed >= 0 (for artificial viscosity)
        rho: mass, density, pressure, sound speed >= 0 (for artificial viscosity)
        p: mass, density, pressure, sound speed >= 0 (for artificial viscosity)
        c: mass, density, pressure, sound speed >= 0 (for artificial viscosity)
        v: velocity
        viscosity: the artificial viscosity: an sph_viscosity
        alpha: its coefficients, pure numbers
        beta: its coefficients, pure numbers
        eta: softens r^2 to r^2 + eta^2 h^2; 0 means the usual 0.1, a negative number none
        delta: its strength; 0 means the usual 0.1, a negative number none
        share: A pair has the factor share_i share_j: 1 for the liquid, 0 for walls and other fluids. Null:
        all take part.
        gradient: of the density, from sph_gradient_cspm: antuono only
        gravity: fourtakas only
        """
        return self._call("density_diffusion_rows_molteni", locals())

    def free_surface(self) -> Any:
        """sph_free_surface: div r, lambda, normal

        div r, lambda and the normal of the targets, in one pass. A target needs neighbours as for
        sph_gradient_cspm. Else it is SPH_TOO_FEW or SPH_SINGULAR, with the normal 0; div r and lambda are
        computed (without neighbours they are 0). The normal is also 0 where no side is emptier than another.
        On a disc of particles that are moved by up to 0.3 spacings it is off by 8 degrees in the mean for h =
        1.33 spacings, and by 3 degrees for h = 2. Returns the number of targets that are not SPH_OK, or a
        negative sph_error.
        """
        return self._call("free_surface", locals())

    def free_surface_cone(self, eigenvalue: Scalars, normal: Vectors) -> Any:
        """sph_free_surface_cone: which particles are the surface

        flag[i] = 1 for the targets at the surface, else 0, from the eigenvalue lambda and the normal of the
        targets by sph_free_surface. Only the band of sph_surface_of is scanned, until a neighbour covers the
        target (sph_surface_covers). In the band, a target without a normal is at the surface. h is that of
        the target; lists must hold every source with r < 2 h. Returns the number of targets at the surface,
        or a negative sph_error.
        """
        return self._call("free_surface_cone", locals())

    def shift_displacement(
        self,
        strength: Scalars = None,
        tensile: float = 0.0,
        spacing: float = 0.0,
        eigenvalue: Scalars = None,
        normal: Vectors = None,
        longest: float = 0.0,
    ) -> Array:
        """sph_shift_displacement: keeps particles even

        The shift dx_i = -strength_i G_i of the targets, less what the surface forbids, and no longer than
        `longest`. The host adds it to the positions; for a velocity of shifting it divides by dt (Sun et al.
        2019: longest = dt v_max / 2). A pair uses (h_i + h_j) / 2 (lists by SPH_MEAN). With the same strength
        for all, no surface and no limit, sum_i V_i dx_i = 0 to round-off. What it costs stands above. Returns
        the number of targets whose shift overflowed (it is 0 then), or a negative sph_error. Atlas: keeps the
        centre of volume.

        strength: an area, of each particle or of all. There is no default
        tensile: R; 0: no such term
        spacing: dx / h, of the particles as they should lie; is read if R is not 0
        eigenvalue: lambda of sph_free_surface. Null: there is no free surface
        normal: of sph_free_surface; is read with lambda
        longest: the longest shift, a length; 0 means 0.2 h, a negative number no limit
        """
        return self._call("shift_displacement", locals())

    def shift_rates(
        self,
        shift: Vectors,
        m: Scalars = None,
        rho: Scalars = None,
        p: Scalars = None,
        c: Scalars = None,
        v: Vectors = None,
        viscosity: int = 0,
        alpha: float = 0.0,
        beta: float = 0.0,
        eta: float = 0.0,
    ) -> Any:
        """sph_shift_rates: what particles that are shifted carry

        What particles that move with v + u instead of v, where u = shift is a velocity, add to their
        acceleration and density rate: u . grad v and u . grad rho, by sph_shift_rate_pair. Sun et al. 2019.
        Of fluid, the members rho and v are read; out.heating is not written. A pair uses (h_i + h_j) / 2
        (lists by SPH_MEAN). For a constant f the rate is 2 f u_i . sum_j V_j grad_i W_ij: not 0 in disorder,
        so that it depends on the frame, and momentum is not conserved. (sum_i V_i of the part div(rho u) is 0
        to round-off.) u . grad f with sph_gradient_cspm is exact for linear f instead, and conserves nothing.
        Returns the number of targets of which a result overflowed (it is 0 then), or a negative sph_error.

        m: mass, density, pressure, sound speed >= 0 (for artificial viscosity)
        rho: mass, density, pressure, sound speed >= 0 (for artificial viscosity)
        p: mass, density, pressure, sound speed >= 0 (for artificial viscosity)
        c: mass, density, pressure, sound speed >= 0 (for artificial viscosity)
        v: velocity
        viscosity: the artificial viscosity: an sph_viscosity
        alpha: its coefficients, pure numbers
        beta: its coefficients, pure numbers
        eta: softens r^2 to r^2 + eta^2 h^2; 0 means the usual 0.1, a negative number none
        """
        return self._call("shift_rates", locals())

    def transport_adami(
        self,
        transport: Vectors,
        background: float,
        m: Scalars = None,
        rho: Scalars = None,
        p: Scalars = None,
        c: Scalars = None,
        v: Vectors = None,
        viscosity: int = 0,
        alpha: float = 0.0,
        beta: float = 0.0,
        eta: float = 0.0,
    ) -> Any:
        """sph_transport_adami.

        The two accelerations of a scheme whose particles move with a transport velocity u, which is nearly v
        but keeps the particles even: background  -(p_b / m_i) sum_j (V_i^2 + V_j^2) grad_i W_ij, from the
        pressure `background` = p_b, stress      (1 / m_i) sum_j (V_i^2 + V_j^2) (A_i + A_j) / 2 . grad_i
        W_ij,   A = rho v (u - v)^T. A step: v += dt (a + stress) with the other accelerations a, u = v + dt /
        2 background (of a half step), x += dt u, and rho from sph_density_summation or sph_density_number.
        p_b = rho0 c^2 is usual, and the pressure in a is then close to 0 (Tait with p0 = 0). For flows
        without a free surface only: a background pressure throws particles out of one. Both conserve linear
        momentum to round-off. Adami, Hu & Adams 2013, JCP 241, 292. Of fluid, the members m, rho and v are
        read. A pair uses (h_i + h_j) / 2 (lists by SPH_MEAN). Pairs closer than 1e-12 h exert no force on
        each other. Returns the number of targets of which a result overflowed (it is 0 then), or a negative
        sph_error.

        m: mass, density, pressure, sound speed >= 0 (for artificial viscosity)
        rho: mass, density, pressure, sound speed >= 0 (for artificial viscosity)
        p: mass, density, pressure, sound speed >= 0 (for artificial viscosity)
        c: mass, density, pressure, sound speed >= 0 (for artificial viscosity)
        v: velocity
        viscosity: the artificial viscosity: an sph_viscosity
        alpha: its coefficients, pure numbers
        beta: its coefficients, pure numbers
        eta: softens r^2 to r^2 + eta^2 h^2; 0 means the usual 0.1, a negative number none
        """
        return self._call("transport_adami", locals())

    def pressure_factor_dfsph(
        self,
        moves: Scalars,
        m: Scalars = None,
        rho: Scalars = None,
        p: Scalars = None,
        c: Scalars = None,
        v: Vectors = None,
        viscosity: int = 0,
        alpha: float = 0.0,
        beta: float = 0.0,
        eta: float = 0.0,
    ) -> Array:
        """sph_pressure_factor_dfsph: alpha of DFSPH

        The factor alpha of DFSPH, see above. Of fluid, m is read, and rho of the targets. moves: 1 for
        particles that pressure moves, 0 for walls; null: all move. The targets are particles that move. A
        pair uses (h_i + h_j) / 2 (lists by SPH_MEAN). A target that no neighbour can push has the factor 0
        and SPH_TOO_FEW. Returns the number of targets that are not SPH_OK, or a negative sph_error.

        m: mass, density, pressure, sound speed >= 0 (for artificial viscosity)
        rho: mass, density, pressure, sound speed >= 0 (for artificial viscosity)
        p: mass, density, pressure, sound speed >= 0 (for artificial viscosity)
        c: mass, density, pressure, sound speed >= 0 (for artificial viscosity)
        v: velocity
        viscosity: the artificial viscosity: an sph_viscosity
        alpha: its coefficients, pure numbers
        beta: its coefficients, pure numbers
        eta: softens r^2 to r^2 + eta^2 h^2; 0 means the usual 0.1, a negative number none
        """
        return self._call("pressure_factor_dfsph", locals())

    def fluid_rates_riemann(
        self,
        m: Scalars = None,
        rho: Scalars = None,
        p: Scalars = None,
        c: Scalars = None,
        v: Vectors = None,
        viscosity: int = 0,
        alpha: float = 0.0,
        beta: float = 0.0,
        eta: float = 0.0,
        limiter: float = 0.0,
        gravity: Sequence[float] = (),
    ) -> Any:
        """sph_fluid_rates_riemann: fluid rates with the dissipation of a Riemann solver

        Acceleration, density rate and viscous heating of the targets by the Riemann solver, in one pass: the
        sums of sph_fluid_pair_riemann. Zhang, Hu & Adams 2017, JCP 335, 605. Of fluid, the members m, rho, p,
        c and v are read; c is positive. Neither viscosity nor alpha, beta and eta are read: the solver has a
        dissipation of its own. Physical viscosity is added by sph_viscosity_mu_morris. A pair uses (h_i +
        h_j) / 2 (lists by SPH_MEAN). It conserves momentum to round-off, also where the density jumps.
        Without gravity in options, energy never grows; give gravity where a fluid stands or pours under it.
        Gravity itself is not contained in the acceleration. Wall particles are sources like all others, with
        pressure and velocity from sph_wall_adami. out.rate, out.heating and out.status may be null. out.rate
        is that of the velocities given: for the order of a step that the chapter above tells, call it again
        with the new velocities. Returns the number of targets of which a result overflowed (it is 0 then), or
        a negative sph_error: SPH_ERROR_VALUE also for masses, densities and sound speeds that are not
        positive. Atlas: gradient exact for nothing, inside lattices for constants; order 0 inside lattices,
        -1 in disorder, -1 at boundaries. Atlas: keeps momentum and angular momentum; energy never grows.

        m: mass, density, pressure, sound speed >= 0 (for artificial viscosity)
        rho: mass, density, pressure, sound speed >= 0 (for artificial viscosity)
        p: mass, density, pressure, sound speed >= 0 (for artificial viscosity)
        c: mass, density, pressure, sound speed >= 0 (for artificial viscosity)
        v: velocity
        viscosity: the artificial viscosity: an sph_viscosity
        alpha: its coefficients, pure numbers
        beta: its coefficients, pure numbers
        eta: softens r^2 to r^2 + eta^2 h^2; 0 means the usual 0.1, a negative number none
        """
        return self._call("fluid_rates_riemann", locals())

    def tension_css(
        self,
        rho: Scalars = None,
        normal: Vectors = None,
        sigma: float = 0.0,
        least: float = 0.0,
    ) -> Array:
        """sph_tension_css: by the stress: keeps momentum

        a_i = (1 / rho_i) sum_j V_j (T_i + T_j) grad_i W_ij, surface tension by the stress (CSS; see above). A
        pair uses (h_i + h_j) / 2 (lists by SPH_MEAN). sum rho V a is 0 to round-off. Hu & Adams 2006. Of
        tension, least is not read. Returns the number of targets whose result overflowed (it is 0 then), or a
        negative sph_error.

        normal: grad c, in 1 / length, and not of unit length
        sigma: tension, force / length
        least: CSF: normals shorter than least / h do not count. 0 means the usual 0.01, a negative number 0.
        """
        return self._call("tension_css", locals())

    def tension_csf(
        self,
        rho: Scalars = None,
        normal: Vectors = None,
        sigma: float = 0.0,
        least: float = 0.0,
    ) -> Any:
        """sph_tension_csf: by the curvature, and the curvature

        a_i = sigma kappa_i n_i / rho_i, surface tension by the curvature (CSF; see above), and kappa. W has
        the h of the target. Where n is shorter than least / h, both are 0. Where it is not, but no neighbour
        has a normal that counts, both are 0 with SPH_TOO_FEW; where one overflows, it is 0 with
        SPH_NOT_FINITE. Brackbill et al. 1992; Morris 2000. The direction of each neighbour's normal takes a
        root and a division: the time is 1.3 to 1.7 times that of sph_divergence_difference, and 2.1 times
        where the compiler does not vectorise. Returns the number of targets that are not SPH_OK, or a
        negative sph_error.

        normal: grad c, in 1 / length, and not of unit length
        sigma: tension, force / length
        least: CSF: normals shorter than least / h do not count. 0 means the usual 0.01, a negative number 0.
        """
        return self._call("tension_csf", locals())

    def wall_gradient(
        self,
        f: Scalars,
        gamma: Scalars = None,
        gradient: Vectors = None,
        value: Scalars = None,
        slope: Vectors = None,
    ) -> Array:
        """sph_wall_gradient: in sum form

        grad f_i = (sum_j V_j f_j grad_i W_ij - f_w grad gamma_i) / gamma_i, the particles of the fluid being
        all sources, with wall.value the f_w of each target. Ferrand et al. 2013. W has the h of the target.
        For its error see above. SPH_ERROR_VALUE for a gamma that is not positive. Returns the number of
        targets whose result overflowed (it is 0 then), or a negative sph_error. Atlas: gradient exact for
        nothing, inside lattices for constants; order 0 inside lattices, -1 in disorder, -1 at boundaries.
        """
        return self._call("wall_gradient", locals())

    def wall_gradient_rows(
        self,
        gamma: Scalars = None,
        gradient: Vectors = None,
        value: Scalars = None,
        slope: Vectors = None,
    ) -> Any:
        """sph_wall_gradient_rows: the same as rows

        The same gradient as rows, for an f that is not known yet: grad f_i = sum_p (x[p], y[p], z[p]) f_j +
        source_i, with the weights V_j F_ij x_ij / gamma_i, and source_i = -f_w grad gamma_i / gamma_i. In
        contrast to sph_gradient_rows_cspm they multiply f_j, not f_j - f_i: this is the sum form. The
        conditioning of out is 1. The weight of f_w itself is the source for wall.value = 1. Where a row or
        its source overflows, both are 0, with SPH_NOT_FINITE. Returns the number of these targets, or a
        negative sph_error.

        (What is the same: see wall_gradient.)
        """
        return self._call("wall_gradient_rows", locals())

    def wall_laplacian(
        self,
        f: Scalars,
        gamma: Scalars = None,
        gradient: Vectors = None,
        value: Scalars = None,
        slope: Vectors = None,
    ) -> Array:
        """sph_wall_laplacian: BIM in more than one dimension

        lap f_i = (sum_j 2 V_j (f_i - f_j) F_ij - 2 g_w . grad gamma_i) / gamma_i, with wall.slope the g_w of
        each target: the gradient of f at the wall, of which the part along the normal counts. Where f_w is
        given instead, at the distance d in front of one wall, g_w = (f_w - f_i) / d n. Macia et al. 2012;
        Ferrand et al. 2013, who take the mean of the gradients on both sides. Errors and answer as above.
        Atlas: Laplacian exact for constants, inside lattices for linear fields; order 0 inside lattices, -1
        in disorder, -1 at boundaries.
        """
        return self._call("wall_laplacian", locals())

    def wall_laplacian_rows(
        self,
        gamma: Scalars = None,
        gradient: Vectors = None,
        value: Scalars = None,
        slope: Vectors = None,
    ) -> Any:
        """sph_wall_laplacian_rows.

        The same Laplacian as rows, for an f that is not known yet: lap f_i = sum_p row[p] (f_j - f_i) +
        source_i, with row[p] = -2 V_j F_ij / gamma_i >= 0, factor 1 and conditioning 1, and source_i = -2 g_w
        . grad gamma_i / gamma_i. Answers as above; the status of out is written, that of source is not.

        (What is the same: see wall_laplacian.)
        """
        return self._call("wall_laplacian_rows", locals())

    def collision_sequential(
        self,
        velocity: Vectors,
        distance: float = 0.0,
        restitution: float = 0.0,
        inverse_mass: Scalars = None,
    ) -> Any:
        """sph_collision_sequential.

        Collisions one after the other, in the order of rows and lists. Each takes the velocities that the one
        before left. This is the only sweep that writes beyond its targets: it changes the velocities of
        sources, too, if they are not walls. So never run it on two ranges at once. Each pair collides once,
        also if both rows name it. Full lists, or lists with j > i only. Momentum and angular momentum are
        conserved to round-off, and the energy never grows for restitution <= 1. out may be null. Returns the
        number of pairs whose velocities or energy would overflow (they exchange nothing; 0: none), or a
        negative sph_error. Atlas: keeps momentum and angular momentum; energy never grows.

        velocity: is changed in place
        distance: Particles that approach within `distance` collide. restitution: C_R (0 inelastic, 1
        elastic).
        restitution: Particles that approach within `distance` collide. restitution: C_R (0 inelastic, 1
        elastic).
        inverse_mass: 1/m of each particle; 0 for walls
        """
        return self._call("collision_sequential", locals())

    def collision_count(
        self,
        v: Vectors,
        distance: float = 0.0,
        restitution: float = 0.0,
        inverse_mass: Scalars = None,
    ) -> Any:
        """sph_collision_count.

        count[i] is the number of collisions of target i: the first half of the simultaneous form. Full lists.
        A host with halo particles exchanges these numbers before the second half. Returns the number of
        targets that coincide with a neighbour (they do not collide with it), or a negative sph_error.

        distance: Particles that approach within `distance` collide. restitution: C_R (0 inelastic, 1
        elastic).
        restitution: Particles that approach within `distance` collide. restitution: C_R (0 inelastic, 1
        elastic).
        inverse_mass: 1/m of each particle; 0 for walls
        """
        return self._call("collision_count", locals())

    def collision_change_weighted(
        self,
        v: Vectors,
        count: Indices,
        distance: float = 0.0,
        restitution: float = 0.0,
        inverse_mass: Scalars = None,
    ) -> Array:
        """sph_collision_change_weighted.

        The change of velocity of each target by all its collisions at once, each with the weight 1 / max(n_i,
        n_j): the second half. The host adds it to v. count comes from sph_collision_count, for the targets
        and for the sources that are not walls. Full lists. The result does not depend on the order, and
        ranges may run in parallel. Momentum and angular momentum are conserved to round-off, and the energy
        never grows for restitution <= 1 (a particle in n > 1 collisions loses some energy also at 1). Returns
        the number of targets whose result overflowed (it is 0 then), or a negative sph_error. Atlas: keeps
        momentum and angular momentum; energy never grows.

        distance: Particles that approach within `distance` collide. restitution: C_R (0 inelastic, 1
        elastic).
        restitution: Particles that approach within `distance` collide. restitution: C_R (0 inelastic, 1
        elastic).
        inverse_mass: 1/m of each particle; 0 for walls
        """
        return self._call("collision_change_weighted", locals())

    def gas_rates(
        self,
        m: Scalars = None,
        rho: Scalars = None,
        omega: Scalars = None,
        p: Scalars = None,
        u: Scalars = None,
        cs: Scalars = None,
        alpha: Scalars = None,
        v: Vectors = None,
        beta: float = 0.0,
        alpha_u: float = 0.0,
        conductivity: int = 0,
    ) -> Any:
        """sph_gas_rates: momentum, energy, div v, v_sig

        Acceleration and du/dt of a gas in one pass, with div v and the largest signal speed: the sums of
        sph_gas_pair. For the equations, their sources and the order of a step see the beginning of this
        chapter. The density comes from sph_density_adaptive; its rate is -rho div v. sum m a = 0, sum m x
        cross a = 0 and sum m (v . a + du/dt) = 0 to round-off, for any h and Omega. v_sig is the largest
        signal speed of a target with its neighbours within the larger of the two supports, for time steps and
        switches: dt = 0.3 h / v_sig is usual. It is not below the target's own sound speed. Gravity is not
        contained (sph_gravity_direct and sph_gravity_correction). The same as sph_mhd_rates with B = 0 and
        Price's conductivity, in half of its time, and in 1.3 to 1.5 times that of sph_fluid_rates_monaghan
        (tests/bench/README.md).

        p: pressure, thermal energy per mass, sound speed >= 0
        u: pressure, thermal energy per mass, sound speed >= 0
        cs: pressure, thermal energy per mass, sound speed >= 0
        alpha: coefficient of viscosity, 0 (none) to 1 or more. A pair takes the mean
        beta: of signal speed and conductivity; 2 and 1 are usual
        alpha_u: of signal speed and conductivity; 2 and 1 are usual
        conductivity: which: an sph_conductivity. With SPH_CONDUCTIVITY_NONE alpha_u is not read
        """
        return self._call("gas_rates", locals())

    def velocity_gradient_difference(
        self,
        v: Vectors,
        m: Scalars = None,
        rho: Scalars = None,
        omega: Scalars = None,
    ) -> Any:
        """sph_velocity_gradient_difference: div v, |curl v|, shear

        grad v in difference form, (1 / (Omega_i rho_i)) sum_j m_j (v_j - v_i)_a grad_i W_ij(h_i) for the
        component a, and div v, |curl v|, S : S and tr((grad v)^2) from it. div is that of sph_gas_rates.
        Exact for constant v; the error is O(h^2) in the interior where the particles are regular, down to
        what h / dx leaves, and does not fall in disorder. Price 2012.
        """
        return self._call("velocity_gradient_difference", locals())

    def velocity_gradient_cspm(self, v: Vectors) -> Any:
        """sph_velocity_gradient_cspm: the same, exact for linear v

        The same, renormalised: the gradients of sph_gradient_cspm of each component, by one sum. Exact for
        linear v at any particle. The cloud's volumes m / rho are read. A target needs dim neighbours inside
        its support, in 2D not all on one line with it, in 3D not all in one plane: else its results are 0,
        with SPH_TOO_FEW or SPH_SINGULAR. Cullen & Dehnen 2010 take this one. Returns the number of targets
        that are not SPH_OK, or a negative sph_error. Atlas: divergence exact for linear fields, inside
        lattices for quadratic fields; order 2 inside lattices, 1 in disorder, 1 at boundaries.

        (What is the same: see velocity_gradient_difference.)
        """
        return self._call("velocity_gradient_cspm", locals())

    def shock_indicator(
        self,
        div_v: Scalars,
        m: Scalars = None,
        rho: Scalars = None,
        omega: Scalars = None,
        p: Scalars = None,
        u: Scalars = None,
        cs: Scalars = None,
        alpha: Scalars = None,
        v: Vectors = None,
        beta: float = 0.0,
        alpha_u: float = 0.0,
        conductivity: int = 0,
    ) -> Any:
        """sph_shock_indicator: for switches of viscosity

        What Cullen & Dehnen's switch needs of the neighbours: R_i = (1 / rho_i) sum_j sign(div v_j) m_j
        W_ij(h_i), with the particle itself, and v_sig = max over j of (c_i + c_j) / 2 + max(-w, 0), which is
        not below c_i. Of state, medium, cs and v are read; div_v is that of all sources. Cullen & Dehnen
        2010.

        p: pressure, thermal energy per mass, sound speed >= 0
        u: pressure, thermal energy per mass, sound speed >= 0
        cs: pressure, thermal energy per mass, sound speed >= 0
        alpha: coefficient of viscosity, 0 (none) to 1 or more. A pair takes the mean
        beta: of signal speed and conductivity; 2 and 1 are usual
        alpha_u: of signal speed and conductivity; 2 and 1 are usual
        conductivity: which: an sph_conductivity. With SPH_CONDUCTIVITY_NONE alpha_u is not read
        """
        return self._call("shock_indicator", locals())

    def divergence_difference(
        self,
        field: Vectors,
        m: Scalars = None,
        rho: Scalars = None,
        omega: Scalars = None,
    ) -> Array:
        """sph_divergence_difference.

        div A_i = -(1 / (Omega_i rho_i)) sum_j m_j (A_i - A_j) . grad_i W_ij(h_i), the difference form (20).
        Exact for constants. For A = v it is -(drho/dt) / rho. Atlas: divergence exact for constants; order 0
        inside lattices, 0 in disorder, 0 at boundaries.
        """
        return self._call("divergence_difference", locals())

    def divergence_symmetric(
        self,
        field: Vectors,
        m: Scalars = None,
        rho: Scalars = None,
        omega: Scalars = None,
    ) -> Array:
        """sph_divergence_symmetric.

        div A_i = rho_i sum_j m_j (A_i g_i + A_j g_j) . x_ij, the symmetric form, which (9) subtracts. It also
        measures the disorder of the particles, and is not 0 for constant A. Atlas: divergence exact for
        nothing, inside lattices for constants; order 0 inside lattices, -1 in disorder, -1 at boundaries.
        """
        return self._call("divergence_symmetric", locals())

    def gradient_symmetric(
        self,
        f: Scalars,
        m: Scalars = None,
        rho: Scalars = None,
        omega: Scalars = None,
    ) -> Array:
        """sph_gradient_symmetric.

        grad f_i = rho_i sum_j m_j (f_i g_i + f_j g_j) x_ij, the symmetric form (23). It is the conjugate of
        the difference form of the divergence, and not 0 for constant f. Atlas: gradient exact for nothing,
        inside lattices for constants; order 0 inside lattices, -1 in disorder, -1 at boundaries.
        """
        return self._call("gradient_symmetric", locals())

    def curl_difference(
        self,
        field: Vectors,
        m: Scalars = None,
        rho: Scalars = None,
        omega: Scalars = None,
    ) -> Array:
        """sph_curl_difference.

        curl A_i = (1 / (Omega_i rho_i)) sum_j m_j (A_i - A_j) x grad_i W_ij(h_i), the difference form. Exact
        for constants. Price 2012, (79). The result has three components, of which only the third is not 0 in
        2D if A has two components; `out` must have three arrays. Atlas: curl exact for constants; order 0
        inside lattices, 0 in disorder, 0 at boundaries.
        """
        return self._call("curl_difference", locals())

    def cleaning_rates(
        self,
        m: Scalars = None,
        rho: Scalars = None,
        omega: Scalars = None,
        field: Vectors = None,
        psi: Scalars = None,
        div_v: Scalars = None,
        ch: float = 0.0,
        sigma: float = 0.0,
    ) -> Any:
        """sph_cleaning_rates: conservative cleaning of B alone

        Divergence cleaning alone, for a host that has the rest of its MHD: dB/dt   = -grad psi   in symmetric
        form, (23), dpsi/dt = -ch^2 div B - sigma ch psi / h - psi div v / 2   with div B in difference form,
        (20), (25). ch is one speed for all particles: the largest fast speed of the cloud (times a factor of
        over-cleaning, if the time step is divided by this factor). sigma is usually sph_cleaning_sigma(dim).
        Cleaning conserves sum m (B^2 + psi^2/ch^2) / (2 rho) for any h and Omega, except for the damping,
        which only takes energy away. Where rho changes, the term with div v is needed for this. It also
        conserves sum m B / rho, to round-off. Atlas: gradient exact for nothing, inside lattices for
        constants; order 0 inside lattices, -1 in disorder, -1 at boundaries. Atlas: divergence exact for
        constants; order 0 inside lattices, 0 in disorder, 0 at boundaries.

        field: B, of dim components
        psi: div_v: of the targets; sph_scalars_none(): div v = 0
        div_v: div_v: of the targets; sph_scalars_none(): div v = 0
        ch: speed and damping of the cleaning waves; see sph_cleaning_sigma
        sigma: speed and damping of the cleaning waves; see sph_cleaning_sigma
        """
        return self._call("cleaning_rates", locals())

    def resistivity_ohmic(
        self,
        m: Scalars = None,
        rho: Scalars = None,
        omega: Scalars = None,
        eta: Scalars = None,
        field: Vectors = None,
    ) -> Any:
        """sph_resistivity_ohmic: physical resistivity, with its heat

        dB/dt and du/dt by physical resistivity, (11): the sums of sph_resistivity_pair_ohmic and its heat, to
        be added to those of sph_mhd_rates, whose resistivity is artificial. For constant eta it is eta lap B.
        Heat is never negative; sum m B / rho, and sum m (u + B^2 / (2 rho)) with it, do not change, to
        round-off, for any h and Omega. Explicit steps are limited by sph_time_step_resistivity. Atlas:
        Laplacian exact for constants, inside lattices for linear fields; order 0 inside lattices, -1 in
        disorder, -1 at boundaries.

        eta: resistivity >= 0 in length^2 / time, with mu_0 = 1: 1 / conductivity
        field: B: three components if field.z has an array, else dim
        """
        return self._call("resistivity_ohmic", locals())

    def mhd_rates(
        self,
        m: Scalars = None,
        rho: Scalars = None,
        omega: Scalars = None,
        p: Scalars = None,
        u: Scalars = None,
        cs: Scalars = None,
        alpha: Scalars = None,
        alpha_B: Scalars = None,
        v: Vectors = None,
        field: Vectors = None,
        psi: Scalars = None,
        ch: float = 0.0,
        sigma: float = 0.0,
        beta: float = 0.0,
        alpha_u: float = 0.0,
        tensile: float = 0.0,
    ) -> Any:
        """sph_mhd_rates: momentum, induction, energy, psi, div B, v_sig

        All rates of a magnetised gas in one pass: dv/dt    (6), less `tensile` times (9); artificial
        viscosity alpha v_sig where particles approach. dB/dt    (7), for B itself; -grad psi, (23);
        artificial resistivity, (10). du/dt    P / (Omega rho^2) sum_j m_j v_ij . grad_i W_ij; heating by
        viscosity and resistivity (both >= 0); conductivity. dpsi/dt  (2), (25). div B    the difference form
        (20); so is div v. The density comes from sph_density_adaptive; its rate is -rho div v. With tensile =
        0 the energy sum m (v^2/2 + u + B^2 / (2 rho) + psi^2 / (2 rho ch^2)) changes by the damping of psi
        only, and the momentum does not change, both to round-off. With (9) the momentum changes at the rate
        -tensile sum (m / rho) B (div B), with div B in symmetric form. v_sig is the largest signal speed of a
        target with its neighbours within the larger of the two supports, for time steps and switches. It is
        not below the target's own fast speed across the field.

        p: pressure, thermal energy per mass, sound speed
        u: pressure, thermal energy per mass, sound speed
        cs: pressure, thermal energy per mass, sound speed
        alpha: Coefficients of viscosity and resistivity of each particle, 0 (none) to 1. A pair takes the
        mean.
        alpha_B: Coefficients of viscosity and resistivity of each particle, 0 (none) to 1. A pair takes the
        mean.
        v: velocity and B: three components each if v.z has an array, else dim
        field: velocity and B: three components each if v.z has an array, else dim
        psi: sph_scalars_none(): no cleaning
        ch: speed and damping of the cleaning waves; see sph_cleaning_rates
        sigma: speed and damping of the cleaning waves; see sph_cleaning_rates
        beta: of signal speed and conductivity; 2 and 1 are usual; alpha_u = 0: none
        alpha_u: of signal speed and conductivity; 2 and 1 are usual; alpha_u = 0: none
        tensile: The part of (9) that is subtracted. 1: all of it. 0: none; momentum is then conserved, but
        particles attract each other and form pairs where B^2/2 > P.
        """
        return self._call("mhd_rates", locals())

    def rk_correction(self) -> Any:
        """sph_rk_correction: makes kernels exact

        A, B and their gradients for the targets (see the beginning of this chapter). The kernel of a particle
        has its own h_i. A target whose m2 is singular (its neighbours are on one line with it, in 3D in one
        plane, or it has none) is SPH_FELL_BACK: B = 0 and A = 1 / m0, exact for constants only. It is
        SPH_TOO_FEW, and all is 0, where m0 is not positive. conditioning: see sph_rk_solve. Where a number
        overflows, it is 0 with SPH_NOT_FINITE.
        """
        return self._call("rk_correction", locals())

    def interpolate_rk(
        self,
        f: Scalars,
        scale: Scalars = None,
        slope: Vectors = None,
        scale_gradient: Vectors = None,
        slope_gradient: Matrices = None,
    ) -> Array:
        """sph_interpolate_rk: for linear fields, everywhere

        f_i = sum_j V_j f_j W^R_ij, the particle itself included: exact for linear fields, error O(h^2), at
        boundaries, too. rk holds what sph_rk_correction wrote for the targets, of which A and B are read;
        those of the other sources are not. The result is 0 where A is 0 (SPH_TOO_FEW) or the sum overflows
        (SPH_NOT_FINITE). Atlas: value exact for linear fields; order 2 inside lattices, 2 in disorder, 2 at
        boundaries.
        """
        return self._call("interpolate_rk", locals())

    def interpolate_rows_rk(
        self,
        scale: Scalars = None,
        slope: Vectors = None,
        scale_gradient: Vectors = None,
        slope_gradient: Matrices = None,
    ) -> Any:
        """sph_interpolate_rows_rk.

        The same as rows: f_i = diagonal[i] f_i + sum_p row[p] f_j. diagonal[i] is what the particle itself
        adds; its sum with the row is 1. factor and conditioning are 1. Rows of targets without answer are 0.

        (What is the same: see interpolate_rk.)
        """
        return self._call("interpolate_rows_rk", locals())

    def gradient_rk(
        self,
        f: Scalars,
        scale: Scalars = None,
        slope: Vectors = None,
        scale_gradient: Vectors = None,
        slope_gradient: Matrices = None,
    ) -> Array:
        """sph_gradient_rk: likewise

        grad f_i = sum_j V_j (f_j - f_i) grad W^R_ij: exact for linear fields, error O(h^2) in the interior of
        a regular cloud and O(h) elsewhere. f_i drops out, because sum_j V_j grad W^R = 0. rk: as for
        sph_interpolate_rk. Where a component overflows, the gradient is 0 and the target counts as failed.
        Atlas: gradient exact for linear fields, inside lattices for quadratic fields; order 2 inside
        lattices, 1 in disorder, 1 at boundaries.
        """
        return self._call("gradient_rk", locals())

    def gradient_rows_rk(
        self,
        scale: Scalars = None,
        slope: Vectors = None,
        scale_gradient: Vectors = None,
        slope_gradient: Matrices = None,
    ) -> Any:
        """sph_gradient_rows_rk.

        The same as rows: grad f_i = sum_p (x[p], y[p], z[p]) (f_j - f_i). conditioning is 1.

        (What is the same: see gradient_rk.)
        """
        return self._call("gradient_rows_rk", locals())

    def gas_rates_crk(
        self,
        m: Scalars = None,
        rho: Scalars = None,
        p: Scalars = None,
        c: Scalars = None,
        v: Vectors = None,
        viscosity: int = 0,
        alpha: float = 0.0,
        beta: float = 0.0,
        eta: float = 0.0,
        scale: Scalars = None,
        slope: Vectors = None,
        scale_gradient: Vectors = None,
        slope_gradient: Matrices = None,
    ) -> Any:
        """sph_gas_rates_crk: forces that conserve (CRKSPH)

        Acceleration and du/dt of a gas by reproducing kernels (CRKSPH): the sums of sph_gas_pair_crk.
        Frontiere, Raskin & Owen 2017, JCP 332, 160, without their limiter of the viscosity. Momentum, and the
        energy sum m (v^2/2 + u), do not change, to round-off. What that costs: see the beginning of this
        chapter. Of fluid all members are read (m of the targets); c only with artificial viscosity, whose
        kind and coefficients are those of fluid. Its heating may be negative for single pairs, where the
        difference of the gradients is far from the line between the particles. Volumes are those that
        sph_rk_correction saw (1 / sum W, or m / rho), and rk holds its results for all sources. Lists hold
        all pairs with r < support ratio * max(h_i, h_j) (SPH_LARGER). out.rate_u and out.status may be null.
        Returns the number of targets of which a result overflowed (it is 0 then), or a negative sph_error:
        SPH_ERROR_VALUE also for masses, densities and volumes that are not positive. Atlas: gradient exact
        for nothing, inside lattices for quadratic fields; order 2 inside lattices, -1 in disorder, -1 at
        boundaries.

        m: mass, density, pressure, sound speed >= 0 (for artificial viscosity)
        rho: mass, density, pressure, sound speed >= 0 (for artificial viscosity)
        p: mass, density, pressure, sound speed >= 0 (for artificial viscosity)
        c: mass, density, pressure, sound speed >= 0 (for artificial viscosity)
        v: velocity
        viscosity: the artificial viscosity: an sph_viscosity
        alpha: its coefficients, pure numbers
        beta: its coefficients, pure numbers
        eta: softens r^2 to r^2 + eta^2 h^2; 0 means the usual 0.1, a negative number none
        """
        return self._call("gas_rates_crk", locals())

    def gas_rates_iad(
        self,
        inverse: Matrices,
        m: Scalars = None,
        rho: Scalars = None,
        p: Scalars = None,
        c: Scalars = None,
        v: Vectors = None,
        viscosity: int = 0,
        alpha: float = 0.0,
        beta: float = 0.0,
        eta: float = 0.0,
    ) -> Any:
        """sph_gas_rates_iad: by the integral approach

        The same by the integral approach (IAD): the sums of sph_gas_pair_iad. Garcia-Senz, Cabezon & Escartin
        2012, A&A 538, A9. inverse: C of all sources, by sph_gradient_correction_iad. With h that follows the
        density, give p / Omega for the pressure (the papers on IAD set Omega aside). Volumes are not read. On
        particles without order its error is larger than that of plain SPH. Atlas: gradient exact for nothing,
        inside lattices for quadratic fields; order 2 inside lattices, -1 in disorder, -1 at boundaries.

        (What is the same: see gas_rates_crk.)

        m: mass, density, pressure, sound speed >= 0 (for artificial viscosity)
        rho: mass, density, pressure, sound speed >= 0 (for artificial viscosity)
        p: mass, density, pressure, sound speed >= 0 (for artificial viscosity)
        c: mass, density, pressure, sound speed >= 0 (for artificial viscosity)
        v: velocity
        viscosity: the artificial viscosity: an sph_viscosity
        alpha: its coefficients, pure numbers
        beta: its coefficients, pure numbers
        eta: softens r^2 to r^2 + eta^2 h^2; 0 means the usual 0.1, a negative number none
        """
        return self._call("gas_rates_iad", locals())

    def gravity_direct(self, m: Scalars, newton: float) -> Any:
        """sph_gravity_direct: all pairs

        Acceleration -G sum_j m_j sph_gravity_pair x_ij and potential G sum_j m_j (phi(r, h_i) + phi(r, h_j))
        / 2 of the targets. newton is G. The sums run over all sources, with the particle itself: n^2 steps,
        for small clouds and to measure trees against. No list is read. The cloud is isolated: the lengths of
        the box are not used. Momentum is conserved to round-off. potential may be without an array. Returns
        the number of targets of which a result overflowed (it is 0 then), or a negative sph_error. Atlas:
        keeps momentum and angular momentum; energy is kept.
        """
        return self._call("gravity_direct", locals())

    def gravity_zeta(self, m: Scalars, rho: Scalars) -> Array:
        """sph_gravity_zeta.

        zeta_i = dh_i/drho_i sum_j m_j dphi/dh(r, h_i) with dh/drho = -h / (3 rho): Price & Monaghan 2007,
        (22). The sum contains the particle itself; rho is of the targets. Lists as for the density: r <
        support ratio * h_i. Returns the number of targets whose result overflowed (it is 0 then), or a
        negative sph_error.
        """
        return self._call("gravity_zeta", locals())

    def gravity_correction(
        self,
        zeta: Scalars,
        newton: float,
        m: Scalars = None,
        rho: Scalars = None,
        omega: Scalars = None,
    ) -> Array:
        """sph_gravity_correction: where h follows the density

        What gravity adds to the acceleration where h follows the density: -(G/2) sum_j m_j (zeta_i F_i /
        Omega_i + zeta_j F_j / Omega_j) x_ij, antisymmetric for each pair. newton is G; zeta comes from
        sph_gravity_zeta; rho is not read. Lists of all pairs within the larger support (SPH_LARGER). Returns
        the number of targets whose result overflowed (it is 0 then), or a negative sph_error.
        """
        return self._call("gravity_correction", locals())

    def deformation_gradient(self, x: Vectors, inverse: Matrices) -> Array:
        """sph_deformation_gradient: exact for affine maps

        The deformation gradient F of the targets (see the beginning of this chapter). x: the current
        positions; in a box that repeats they have the box of their own, and pairs are those of the nearest
        images. inverse: L of the targets; where it is 0, F = 1. Exact for affine maps, also at boundaries;
        for other maps the error is O(h) there and in disorder, O(h^2) in the interior of a lattice. Where an
        entry overflows, the matrix is 0 and the target counts as failed.
        """
        return self._call("deformation_gradient", locals())

    def solid_acceleration(
        self,
        inverse: Matrices = None,
        stress: Matrices = None,
        density: Scalars = None,
        hourglass: float = 0.0,
        x: Vectors = None,
        gradient: Matrices = None,
        modulus: Scalars = None,
    ) -> Array:
        """sph_solid_acceleration: by stress and hourglass control: keeps both momenta

        The acceleration of the targets by stress, and by hourglass control if solid.hourglass is not 0 (see
        the beginning of this chapter). Momentum and angular momentum are kept to round-off, if stress is the
        law of F. Lists hold all pairs with r < support ratio * max(h_i, h_j) in the reference state
        (SPH_LARGER). A particle whose L is 0 exerts no stress. Returns the number of targets whose
        acceleration overflowed (it is 0 then), or a negative sph_error: SPH_ERROR_VALUE also for densities
        that are not positive.

        inverse: L of sph_gradient_correction_cspm, and P
        stress: L of sph_gradient_correction_cspm, and P
        density: of the reference state, of the targets
        hourglass: For hourglass control: its coefficient alpha (0: none; 1 is usual), and what else it reads:
        the current positions, F, and Young's modulus, not negative.
        """
        return self._call("solid_acceleration", locals())

    def nearest_distance(self, sources: Vectors) -> Array:
        """sph_nearest_distance.

        The distance from each target to its nearest source in the list. Where the list is empty it is 0, with
        SPH_TOO_FEW. Targets and sources may be the same points, or probes and particles (lists by
        SPH_LIST_FOREIGN). In the second case the fraction of probes without a particle within some distance
        is the void fraction. The box is that of the sources. Returns the number of targets that are not
        SPH_OK, or a negative sph_error.
        """
        return self._call("nearest_distance", locals())

    def hexatic_order(self) -> Array:
        """sph_hexatic_order.

        The hexatic order in 2D: |sum exp(6 i theta)| / 6 over the six nearest neighbours in the list. It is 1
        on a hexagonal lattice, and about 0.36 for random particles. Nelson & Halperin 1979, PRB 19, 2457.
        Where there are fewer than six neighbours (coincident ones do not count), it is 0, with SPH_TOO_FEW.
        Returns the number of targets that are not SPH_OK, or a negative sph_error.
        """
        return self._call("hexatic_order", locals())

    def radial_distribution(self, farthest: float, number_density: float, bins: int) -> Any:
        """sph_radial_distribution.

        The radial distribution function: g[b] is the number of pairs with b <= r / width < b + 1, width =
        farthest / bins, divided by the number that is expected at the number_density (particles per
        length^dim). In a large cloud it is 1 far from a particle. Full lists that hold every pair with r <
        farthest. Without targets g is not changed. Returns the number of shells that are so small or large
        that g overflows (it is 0 there), or a negative sph_error.
        """
        return self._call("radial_distribution", locals())

    def coincident_count(self, distance: float) -> int:
        """sph_coincident_count.

        The number of targets that have another source within `distance`. With 1e-12 h these are the particles
        that exert no force on each other. Returns this number, or a negative sph_error.
        """
        return self._call("coincident_count", locals())

    def coincident_separate(self, within: float, distance: float, position: Vectors) -> Any:
        """sph_coincident_separate.

        Separates targets from the sources that they coincide with, within the distance `within`: neither
        forces, nor kernels, nor collisions do so, because such a pair has no direction. A target that
        coincides with another moves by `distance` in a direction that depends on its index only: in 2D and 3D
        by the golden angle, so that close indices get different directions; in 1D to the left if its index is
        even, else to the right, so that two of the same parity stay together. The new positions of all
        targets are written; those that coincide with none keep theirs. The host wraps and stores them.
        Returns the number of targets that coincide, or a negative sph_error.

        position: is changed in place
        """
        return self._call("coincident_separate", locals())

    def conserved_sums(self, m: Scalars, v: Vectors) -> Any:
        """sph_conserved_sums: mass, momentum, angular momentum, kinetic energy

        Mass, momentum, angular momentum and kinetic energy of the targets first ... last - 1. x and v are
        taken as they are: the angular momentum has a meaning only if the positions of a periodic box were
        never wrapped. Returns 0; or 1 if a sum overflowed (all sums are 0 then); or a negative sph_error.
        """
        return self._call("conserved_sums", locals())


def _number(name: str, *values: Any) -> Any:
    from . import _number as call

    return call(name, values)


def kernel_support_ratio(kernel: Union[str, int]) -> float:
    """sph_kernel_support_ratio: support radius / h

    Support radius / h.
    """
    return _number("kernel_support_ratio", kernel)


def kernel_h_over_dx(kernel: Union[str, int]) -> float:
    """sph_kernel_h_over_dx: recommended h / particle spacing

    Recommended h / particle spacing: a default for programs, not a law. Even on a perfect lattice, the
    density that is summed up with it, dx^dim sum W, is not exactly 1. Of the kernels without a cusp it is
    right within 1.6 %. A kernel with a cusp gives a particle itself too large a share, so that the density is
    too high: 1D     2D     3D                            1D     2D     3D schuessler-schmitt   1.106  1.041
    1.006    convex-wendland-c2   1.134  1.118  1.083 johnson-beissel      1.056  1.034  1.019
    convex-wendland-c4   1.174  1.176  1.142 convex               1.063  1.042  1.023    core-triangle
    1.051  1.034  1.018 convex-cubic-spline  1.108  1.088  1.058    spiky                1.250  1.274  1.236
    examples/hello_kernel.c prints this table for all kernels (-l). A density that is integrated from its
    right value is free of this error; one that is summed up is not, and an equation of state turns it into a
    pressure. Larger h reduces it.
    """
    return _number("kernel_h_over_dx", kernel)


def kernel_h_from_support(kernel: Union[str, int], support: float) -> float:
    """sph_kernel_h_from_support: the h of a kernel whose support has this radius

    The h of a kernel that ends at the radius `support`. Needs support > 0.
    """
    return _number("kernel_h_from_support", kernel, support)


def kernel_support(kernel: Union[str, int], h: float) -> float:
    """sph_kernel_support: support radius

    The radius at which a kernel ends.
    """
    return _number("kernel_support", kernel, h)


def kernel_sigma(kernel: Union[str, int], dim: int) -> float:
    """sph_kernel_sigma: normalisation

    sigma = 1 / (S_dim integral_0^support w(q) q^(dim-1) dq) with S_dim = 2, 2 pi, 4 pi. The comments give the
    exact values for 1, 2 and 3 dimensions; tests/known/derive_kernels.py derives them.
    """
    return _number("kernel_sigma", kernel, dim)


def kernel_shape(kernel: Union[str, int], dim: int, q: float) -> float:
    """sph_kernel_shape: w(q) = W h^dim / sigma

    w(q): the kernel without its normalisation; 0 for q >= support. The sources stand above. Needs q >= 0.
    """
    return _number("kernel_shape", kernel, dim, q)


def kernel_shape_f(kernel: Union[str, int], dim: int, q: float) -> float:
    """sph_kernel_shape_f: (1/q) dw/dq

    (1/q) dw/dq; 0 for q >= support. At q = 0 it is the limit, or 0 for a kernel with a cusp. Needs q >= 0.
    Splines: let q0 be the knot next to the origin, t = min(q, q0) and s = max(q, q0), so that q = t + s - q0.
    Then f(q) = [f(t) - f(q0)] + f(s). The first part is written without a division by q, the second without
    the inner piece, so that nothing branches and nothing cancels. schuessler-schmitt: for q < 1e-6 the slope
    is kept at its value at q = 1e-6, because the true slope is infinite at the origin.
    """
    return _number("kernel_shape_f", kernel, dim, q)


def kernel_shape_d2(kernel: Union[str, int], dim: int, q: float) -> float:
    """sph_kernel_shape_d2: d2w/dq2

    d2w/dq2; 0 for q >= support, where it jumps for liu-quartic, hermite, schuessler-schmitt, johnson-beissel
    and the Gaussians. At q = 0 of a kernel with a cusp it is the limit from q > 0. Needs q >= 0.
    """
    return _number("kernel_shape_d2", kernel, dim, q)


def kernel_w(kernel: Union[str, int], dim: int, r: float, h: float) -> float:
    """sph_kernel_w: W

    W = sigma / h^dim w(r/h).
    """
    return _number("kernel_w", kernel, dim, r, h)


def kernel_f(kernel: Union[str, int], dim: int, r: float, h: float) -> float:
    """sph_kernel_f: F = (1/r) dW/dr. At r = 0: its limit where that is finite, else 0

    F = (1/r) dW/dr, so that grad_i W = F x_ij. F <= 0 for every kernel that falls monotonically: all but
    liu-quartic and super-gaussian.
    """
    return _number("kernel_f", kernel, dim, r, h)


def kernel_dwdr(kernel: Union[str, int], dim: int, r: float, h: float) -> float:
    """sph_kernel_dwdr: dW/dr

    dW/dr = r F. It is 0 at r = 0, also for a kernel with a cusp.
    """
    return _number("kernel_dwdr", kernel, dim, r, h)


def kernel_d2wdr2(kernel: Union[str, int], dim: int, r: float, h: float) -> float:
    """sph_kernel_d2wdr2: d2W/dr2

    d2W/dr2. The Laplacian of W is d2W/dr2 + (dim - 1) F.
    """
    return _number("kernel_d2wdr2", kernel, dim, r, h)


def kernel_dwdh(kernel: Union[str, int], dim: int, r: float, h: float) -> float:
    """sph_kernel_dwdh: dW/dh at fixed r

    dW/dh = -(dim W + r dW/dr) / h at fixed r, because W is h^-dim times a function of r/h.
    """
    return _number("kernel_dwdh", kernel, dim, r, h)


def kernel_has_cusp(kernel: Union[str, int]) -> int:
    """sph_kernel_has_cusp: 1 if the slope at the origin is not 0 (F = 0 there, by convention)

    1 for the kernels whose slope at the origin is not zero. Their gradient has no direction at r = 0, and F
    is 0 there.
    """
    return _number("kernel_has_cusp", kernel)


def kernel_may_convexify(kernel: Union[str, int], dim: int) -> int:
    """sph_kernel_may_convexify: 1 if W >= 0 and W' <= 0, so that the integral of its tail is a convex kernel

    1 if K(q) = integral_q^support w dq is again a kernel. It decreases where w >= 0, and is convex where w'
    <= 0. Both are tested at the ends of 1024 equal intervals of the support. The clustering paper says that
    'the result will always be decreasing'; this is not so for liu-quartic and super-gaussian, which have
    negative lobes.
    """
    return _number("kernel_may_convexify", kernel, dim)


def cohesion_kernel_akinci(r: float, support: float) -> float:
    """sph_cohesion_kernel_akinci: C(r): pushes apart below 0.27 support, pulls beyond it

    C(r), in 1/length^3. Below r = 0.2729 support it is negative: there the force pushes apart.
    """
    return _number("cohesion_kernel_akinci", r, support)


def adhesion_kernel_akinci(r: float, support: float) -> float:
    """sph_adhesion_kernel_akinci: A(r): pulls towards a wall beyond half of the support

    A(r) >= 0, in 1/length^3.
    """
    return _number("adhesion_kernel_akinci", r, support)


def kernel_has_gravity(kernel: Union[str, int]) -> int:
    """sph_kernel_has_gravity: 1 for the kernels that the following functions know

    1 for cubic-spline, wendland-c2, wendland-c4 and wendland-c6.
    """
    return _number("kernel_has_gravity", kernel)


def gravity_shape_f(kernel: Union[str, int], q: float) -> float:
    """sph_gravity_shape_f: h^3 (1/r) dphi/dr

    (1/q) dphi^/dq = h^3 (1/r) dphi/dr. It is Newton's 1/q^3 beyond the support, and for kernels that have no
    gravity. Needs q >= 0, and q > 0 for the latter.
    """
    return _number("gravity_shape_f", kernel, q)


def gravity_shape(kernel: Union[str, int], q: float) -> float:
    """sph_gravity_shape: h phi

    phi^ = h phi, which is negative. It is Newton's -1/q beyond the support, and for kernels that have no
    gravity. Needs q >= 0, and q > 0 for the latter.
    """
    return _number("gravity_shape", kernel, q)


def gravity_potential(kernel: Union[str, int], r: float, h: float) -> float:
    """sph_gravity_potential: phi of a unit mass that is spread out like the kernel, with G = 1 in 3D; it is
    -1/r beyond the support

    phi = phi^(r/h) / h. This and the next two need a kernel with sph_kernel_has_gravity.
    """
    return _number("gravity_potential", kernel, r, h)


def gravity_force(kernel: Union[str, int], r: float, h: float) -> float:
    """sph_gravity_force: (1/r) dphi/dr: the acceleration is -G m x_ij times it

    (1/r) dphi/dr: the acceleration is -G m x_ij times it.
    """
    return _number("gravity_force", kernel, r, h)


def gravity_dphidh(kernel: Union[str, int], r: float, h: float) -> float:
    """sph_gravity_dphidh: dphi/dh at fixed r

    dphi/dh = -(phi^ + q dphi^/dq) / h^2 at fixed r, because phi = phi^(r/h) / h. It is 0 beyond the support.
    """
    return _number("gravity_dphidh", kernel, r, h)


def laplacian_weight_brookshaw(kernel: Union[str, int], dim: int, r: float, h: float, V_j: float) -> float:
    """sph_laplacian_weight_brookshaw.

    The weight of (f_j - f_i) in Brookshaw's Laplacian: -2 V_j F_ij >= 0, so that L f_i = sum_j weight (f_j -
    f_i) = sum_j 2 V_j (f_i - f_j) F_ij. It is exact for constants. The error is O(h^2) in the interior of a
    regular cloud, down to what h / dx leaves (0.1 % for wendland-c2 and h = 2 dx in 2D), and O(1/h) at a
    boundary and in disorder. Source: Brookshaw 1985, Proc. ASA 6, 207.
    """
    return _number("laplacian_weight_brookshaw", kernel, dim, r, h, V_j)


def moment_weight_gradient(kernel: Union[str, int], dim: int, r: float, h: float, V_j: float) -> float:
    """sph_moment_weight_gradient.

    The weight -V_j F_ij >= 0 of CSPM's gradient: K = sum_j weight e e^T, grad f_i = K^-1 sum_j weight e df
    with e = x_j - x_i and df = f_j - f_i. Here e is not divided by h, because h cancels.
    """
    return _number("moment_weight_gradient", kernel, dim, r, h, V_j)


def moment_weight_iad(kernel: Union[str, int], dim: int, r: float, h: float, V_j: float) -> float:
    """sph_moment_weight_iad.

    The weight V_j W_ij of the integral approach to derivatives (IAD), in the place of -V_j F_ij of CSPM. It
    needs no derivative of the kernel. Garcia-Senz, Cabezon & Escartin 2012, A&A 538, A9.
    """
    return _number("moment_weight_iad", kernel, dim, r, h, V_j)


def boundary_weight_bim(kernel: Union[str, int], e: float, normal: float, h: float) -> float:
    """sph_boundary_weight_bim.

    The weight of (f_b - f_i) for the end b of the domain at x_b, before the division by gamma_i: 2 normal
    W(x_i - x_b) / (x_b - x_i)   with   e = x_b - x_i. The outer normal is +1 at the right end and -1 at the
    left end, so that the weight is positive inside. Sources: Macia, Gonzalez, Cercos-Pita & Souto-Iglesias
    2012, Prog. Theor. Phys. 128, 439; (4.9) of the ICSPM paper, where the braces are lost in print: the
    factor 2 / gamma multiplies the boundary terms, too. Needs normal = 1 and e > 0, or normal = -1 and e < 0:
    at the end itself (e = 0) the term is undefined.
    """
    return _number("boundary_weight_bim", kernel, e, normal, h)


def mobility_pair(mean: int, m_i: float, m_j: float, upstream: float) -> float:
    """sph_mobility_pair.

    mu_ij, which is twice the mean of the mobilities. upstream = potential_i - potential_j; it is read for
    SPH_MOBILITY_UPWIND only. Needs one of the three means, m_i >= 0 and m_j >= 0.
    """
    return _number("mobility_pair", mean, m_i, m_j, upstream)


def signal_speed(c_i: float, c_j: float, beta_w: float) -> float:
    """sph_signal_speed.

    The signal speed of a pair, v_sig = (c_i + c_j + beta |w|) / 2 with w = v_ij . x_ij / r; beta_w = beta
    |w|. c is the sound speed, or sph_mhd_fast_speed in a magnetised gas. Monaghan 1997, JCP 136, 298; Price
    2012, JCP 231, 759, (105). Needs c_i >= 0 and c_j >= 0.
    """
    return _number("signal_speed", c_i, c_j, beta_w)


def viscosity_signal(alpha_speed: float, w: float, per_rho: float) -> float:
    """sph_viscosity_signal.

    Pi_ij = alpha v_sig |w| / rho where particles approach (w < 0), else 0. alpha_speed = alpha v_sig, per_rho
    = 1 / rho. Needs per_rho >= 0.
    """
    return _number("viscosity_signal", alpha_speed, w, per_rho)


def kernel_f_apart(kernel: Union[str, int], dim: int, r: float, h: float) -> float:
    """sph_kernel_f_apart.

    F of a pair, but 0 for particles that coincide (closer than 1e-12 h): their direction consists of rounding
    errors. It is written with copysign, because a comparison would keep loops from vectorising.
    """
    return _number("kernel_f_apart", kernel, dim, r, h)


def time_step_sound(h: float, c: float, speed: float) -> float:
    """sph_time_step_sound.

    The longest step of an explicit scheme for one particle, by sound (Courant): 0.25 h / (c + |v|); speed =
    |v|. Source of this and the next two functions: Monaghan 1992; Morris, Fox & Zhu 1997, (33)-(35). Take the
    least of all particles. Where nothing limits the step the answer is 1/SPHI_TINY, or for the force 0.25
    sqrt(1/SPHI_TINY). Needs c >= 0 and speed >= 0.
    """
    return _number("time_step_sound", h, c, speed)


def time_step_force(h: float, acceleration: float) -> float:
    """sph_time_step_force.

    The longest step by the force: 0.25 sqrt(h / |a|); acceleration = |a|. Needs acceleration >= 0.
    """
    return _number("time_step_force", h, acceleration)


def time_step_viscous_nu(h: float, nu: float) -> float:
    """sph_time_step_viscous_nu.

    The longest step by viscosity: 0.125 h^2 / nu, with the kinematic viscosity nu. A form that resists
    compression with more than it resists shear needs the larger of the two: 3 nu for Monaghan & Cleary, (2 -
    2 / dim) nu plus the bulk viscosity for Espanol & Revenga. Needs nu >= 0.
    """
    return _number("time_step_viscous_nu", h, nu)


def density_diffusion_weight(V_j: float, strength: float, f_ij: float) -> float:
    """sph_density_diffusion_weight.

    The weight of psi: delta c h V_j (-F) >= 0. strength = delta c h, and f_ij = F_ij with the h of the pair.
    """
    return _number("density_diffusion_weight", V_j, strength, f_ij)


def time_step_density_diffusion(kernel: Union[str, int], dim: int, h: float, delta: float, c: float) -> float:
    """sph_time_step_density_diffusion.

    The longest step in which density diffusion makes no new extreme: h / (S delta c), with S = h^2 sum_j 2
    V_j |F_ij| in the limit of many neighbours. In 2D S = 4 pi h^2 W(0), 7 for the C2 kernel of Wendland.
    Twice that step is the limit of stability. With delta = 0.1 it is longer than that of sound
    (sph_time_step_sound). Where nothing limits the step the answer is 1/SPHI_TINY. Needs h > 0, delta >= 0
    and c >= 0.
    """
    return _number("time_step_density_diffusion", kernel, dim, h, delta, c)


def shift_strength_skillen(factor: float, h: float, path: float) -> float:
    """sph_shift_strength_skillen.

    A h |v| dt of Skillen et al.; factor = A, 1 ... 6, and path = |v| dt.
    """
    return _number("shift_strength_skillen", factor, h, path)


def shift_strength_sun(h: float, path: float, length: float) -> float:
    """sph_shift_strength_sun.

    dt v_max (2 h)^2 / (2 length) of Sun et al.; path = v_max dt with the largest speed of the flow. In the
    paper length = h; TrixiParticles takes 2 dx, because the shift then scales with the spacing. At h = 2 dx
    they are the same. Needs length > 0.
    """
    return _number("shift_strength_sun", h, path, length)


def conductivity_speed(P_i: float, P_j: float, per_rho: float) -> float:
    """sph_conductivity_speed.

    The signal speed of the artificial conductivity: sqrt(|P_i - P_j| / rho). per_rho is 1 over the mean
    density. Price 2008, JCP 227, 10040. Needs per_rho >= 0.
    """
    return _number("conductivity_speed", P_i, P_j, per_rho)


def shock_pair(m_j: float, div_j: float, w_ij: float) -> float:
    """sph_shock_pair.

    What j adds to the sum of R: sign(div_j) m_j W_ij, div_j being div v there; sign(0) = 0.
    """
    return _number("shock_pair", m_j, div_j, w_ij)


def shock_value(sum: float, rho: float) -> float:
    """sph_shock_value.

    R = sum / rho, in [-1, 1] if rho is the sum of m_j W_ij: -1 where all around is compressed, which a noisy
    div v is not. Needs rho > 0.
    """
    return _number("shock_value", sum, rho)


def cleaning_sigma(dim: int) -> float:
    """sph_cleaning_sigma.

    A usual damping sigma of cleaning waves: 0.3 in 1D and 2D, 1 in 3D.
    """
    return _number("cleaning_sigma", dim)


def resistivity_switch(h: float, change: float, strength: float) -> float:
    """sph_resistivity_switch.

    alpha_B / alpha_max = min(1, h change / B), which lets resistivity act only where the field changes within
    h. strength: B = |B|. change: |grad B|, the root of the sum of the squares of all its components (Tricco &
    Price 2013, MNRAS 436, 2810, with alpha_max = 1), or |curl B|, which leaves the divergence to the
    cleaning. It is 0 where nothing changes, and 1 where B = 0 but change is not. Needs change >= 0 and
    strength >= 0.
    """
    return _number("resistivity_switch", h, change, strength)


def resistivity_pair(weight: float, alpha_speed: float, per_rho: float) -> float:
    """sph_resistivity_pair.

    Artificial resistivity, (10), for shocks (sph_resistivity_pair_ohmic is the physical one): weight
    alpha_speed per_rho^2 <= 0, the coefficient b of B_ij in dB_i/dt = rho_i sum_j b B_ij. Here weight = m_j G
    r, alpha_speed = alpha_B v_sig, and per_rho is 1 over the mean density. (Its square is what (10) lacks.)
    """
    return _number("resistivity_pair", weight, alpha_speed, per_rho)


def time_step_resistivity(h: float, eta: float) -> float:
    """sph_time_step_resistivity.

    The longest explicit step by resistivity, 0.125 h^2 / eta: that of sph_time_step_viscous_nu. Needs eta >=
    0.
    """
    return _number("time_step_resistivity", h, eta)


def gravity_pair(kernel: Union[str, int], r: float, h_i: float, h_j: float) -> float:
    """sph_gravity_pair.

    The mean of (1/r) dphi/dr with h_i and with h_j, >= 0: a_i = -G sum_j m_j sph_gravity_pair x_ij. Beyond
    both supports it is Newton's 1/r^3. Coincident particles feel no force, because x_ij = 0. Needs a kernel
    with sph_kernel_has_gravity.
    """
    return _number("gravity_pair", kernel, r, h_i, h_j)


def gravity_zeta_value(h: float, rho: float, sum: float) -> float:
    """sph_gravity_zeta_value.

    zeta_i = dh_i/drho_i sum_j m_j dphi/dh(r, h_i) with dh/drho = -h / (3 rho): Price & Monaghan 2007, (22).
    The sum contains the particle itself. Needs rho > 0.
    """
    return _number("gravity_zeta_value", h, rho, sum)


__all__ = [
    "kernel_support_ratio",
    "kernel_h_over_dx",
    "kernel_h_from_support",
    "kernel_support",
    "kernel_sigma",
    "kernel_shape",
    "kernel_shape_f",
    "kernel_shape_d2",
    "kernel_w",
    "kernel_f",
    "kernel_dwdr",
    "kernel_d2wdr2",
    "kernel_dwdh",
    "kernel_has_cusp",
    "kernel_may_convexify",
    "cohesion_kernel_akinci",
    "adhesion_kernel_akinci",
    "kernel_has_gravity",
    "gravity_shape_f",
    "gravity_shape",
    "gravity_potential",
    "gravity_force",
    "gravity_dphidh",
    "laplacian_weight_brookshaw",
    "moment_weight_gradient",
    "moment_weight_iad",
    "boundary_weight_bim",
    "mobility_pair",
    "signal_speed",
    "viscosity_signal",
    "kernel_f_apart",
    "time_step_sound",
    "time_step_force",
    "time_step_viscous_nu",
    "density_diffusion_weight",
    "time_step_density_diffusion",
    "shift_strength_skillen",
    "shift_strength_sun",
    "conductivity_speed",
    "shock_pair",
    "shock_value",
    "cleaning_sigma",
    "resistivity_switch",
    "resistivity_pair",
    "time_step_resistivity",
    "gravity_pair",
    "gravity_zeta_value",
]
