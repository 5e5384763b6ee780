! SPDX-License-Identifier: MIT
!
! sph.f90 - the operators of sph.h for Fortran (2008), through the shim (sph_shim.h).
!
!     cc -O2 -c -I. examples/hosts/sph_shim.c
!     cd examples/hosts && gfortran -O2 sph_c.f90 sph.f90 your_code.f90 ../../sph_shim.o -lm
!
!     use sph
!     type(sph_cloud) :: cloud
!     call cloud%init('wendland-c2', n, sph_scalars(h), sph_scalars(V), sph_scalars(x), sph_scalars(y), &
!                     not_ok=error)
!     call cloud%find_lists(error)                                neighbour lists: cloud%start, cloud%index
!     call cloud%gradient(sph_scalars(f), gx, gy, not_ok=error)
!     if (error < 0) print '(a)', sph_error_text(error)
!
! Every operator of the headers can be called, under its name and with its arguments in C, on a cloud's view.
! Options begin with zeros, which are the defaults, and outputs with null, which is not wanted:
!     type(sph_density_options) :: options
!     type(sph_density_out) :: out
!     options%list_radius = sph_scalars(radius)
!     out%h = sph_address(h)
!     out%rho = sph_address(rho)
!     error = sph_density_adaptive(cloud%kernel, cloud%dim, cloud%view, sph_scalars(m), options, out)
!
! A view says where the numbers of the particles are; nothing is copied:
!     sph_scalars(a)                     one number of each particle: an array, or a section of it such as
!                                        xyzh(1, :); it may be empty
!     sph_scalars(p(1)%a, p(2)%a)        a component of an array of a derived type, by its first two (p%a
!                                        itself would be copied, and the copy gone after the call)
!     sph_scalars(h)                     a scalar: one value for all
!     sph_vectors(x, y, z)               vectors in one, two or three such arrays
!     sph_vectors(v)                     in one array v(component, particle)
!     sph_scalar_out(a, status)          where results go; status(:) is of the kind sph_state, and optional
!     sph_vector_out(x, y, z), sph_vector_out(v)
!     sph_address(a)                     for a component of an out struct whose stride is 0: a contiguous
!                                        array; sph_address(a, out%stride) stops if a has another stride
! Give them the attribute target, and keep them as long as the cloud, which must not be copied (its copy would
! look at the lists of the first).
!
! In loops over pairs, sph_kernel_w(kernel, dim, r, h), sph_kernel_f, sph_kernel_d2wdr2 and the like are pure,
! and may stand in do concurrent.
!
! not_ok: the number of targets that are not ok (0: all well), or a negative error, which
! sph_error_text(error) puts in words, with the argument and the first particle at fault;
! sph_status_text(status) has those of a status.
! Lists begin with 0, as in C: the neighbours of particle i are cloud%index(p) + 1
! for p = cloud%start(i) + 1, cloud%start(i + 1).
! What is computed, and what it is exact for: sph_ops.h, under the same names. Double precision; for a shim of
! another one change the kinds at the top of sph_c.f90.

module sph
    use sph_c, sph_cloud_view => sph_cloud
    use, intrinsic :: iso_fortran_env, only: output_unit
    implicit none
    public
    private :: c_kernel_name, c_kernel_from_name, c_kernel_wf, c_status_text, c_finding_text, c_refused, &
        c_struct_size
    private :: output_unit, c_strlen, text_of, apart, put
    private :: scalars_of_array, scalars_of_component, scalars_of_value, vectors_of_arrays, vectors_of_matrix
    private :: out_of_array, out_of_arrays, out_of_matrix, address_of_reals, address_of_states
    private :: init, range, periodic, find_lists, use_lists, check, examine
    private :: density, gradient, laplacian_brookshaw, derivatives, rows_msph, apply

    interface sph_scalars
        procedure scalars_of_array, scalars_of_component, scalars_of_value
    end interface
    interface sph_vectors
        procedure vectors_of_arrays, vectors_of_matrix
    end interface
    interface sph_scalar_out
        procedure out_of_array
    end interface
    interface sph_vector_out
        procedure out_of_arrays, out_of_matrix
    end interface
    interface sph_address
        procedure address_of_reals, address_of_states
    end interface

    type :: sph_cloud
        integer(c_int) :: kernel = -1, dim = 0
        type(sph_cloud_view) :: view ! what the functions of sph_c take
        integer(sph_index), pointer, contiguous :: start(:) => null(), index(:) => null()
        integer(c_int64_t), allocatable, private :: memory(:) ! of find_lists
    contains
        procedure :: init, range, periodic, find_lists, use_lists, check, examine
        procedure :: density, gradient, laplacian_brookshaw, derivatives, rows_msph, apply
    end type

    interface
        function c_strlen(text) bind(c, name='strlen') result(length)
            import
            type(c_ptr), value :: text
            integer(c_size_t) :: length
        end function
    end interface

contains

    ! ---------------------------------------------------------------- texts and kernels

    function text_of(address) result(text)
        type(c_ptr), intent(in) :: address
        character(:), allocatable :: text
        character(kind=c_char), pointer :: letter(:)
        integer :: i
        call c_f_pointer(address, letter, [c_strlen(address)])
        allocate (character(size(letter)) :: text)
        do i = 1, size(letter)
            text(i:i) = letter(i)
        end do
    end function

    ! 'wendland-c2'
    function sph_kernel_name(kernel) result(text)
        integer(c_int), intent(in) :: kernel
        character(:), allocatable :: text
        text = text_of(c_kernel_name(kernel))
    end function

    ! SPH_WENDLAND_C2, or -1
    function sph_kernel_from_name(name) result(kernel)
        character(*), intent(in) :: name
        integer(c_int) :: kernel
        kernel = c_kernel_from_name(trim(name)//c_null_char)
    end function

    function sph_status_text(status) result(text)
        integer, intent(in) :: status
        character(:), allocatable :: text
        text = text_of(c_status_text(int(status, c_int)))
    end function

    function sph_finding_text(finding) result(text)
        integer, intent(in) :: finding
        character(:), allocatable :: text
        text = text_of(c_finding_text(int(finding, c_int)))
    end function

    ! The error that was just answered: 'h: ... is not finite and positive, first at particle 18', which counts
    ! from 1.
    function sph_error_text(error) result(text)
        integer, intent(in) :: error
        character(:), allocatable :: text
        character(20) :: number
        integer(sph_index) :: particle
        text = text_of(c_refused(int(error, c_int), particle))
        if (len(text) > 0) text = text//': '
        text = text//sph_status_text(error)
        write (number, '(i0)') particle + 1
        if (particle >= 0) text = text//', first at particle '//trim(number)
    end function

    ! W and F = (1/r) dW/dr of the distances r
    subroutine sph_kernel_wf(kernel, dim, r, h, w, f, error)
        character(*), intent(in) :: kernel
        integer, intent(in) :: dim
        real(sph_real), intent(in) :: r(:), h
        real(sph_real), intent(out) :: w(size(r)), f(size(r))
        integer, intent(out) :: error
        integer(sph_index) :: n
        n = size(r, kind=sph_index)
        error = c_kernel_wf(sph_kernel_from_name(kernel), int(dim, c_int), n, r, h, w, f)
    end subroutine

    ! ---------------------------------------------------------------- views

    ! how many numbers lie from a to b
    function apart(a, b) result(stride)
        real(sph_real), intent(in), target :: a, b
        integer(c_size_t) :: stride
        stride = transfer(c_loc(b), stride) - transfer(c_loc(a), stride)
        stride = stride / (storage_size(a) / 8)
    end function

    function scalars_of_array(a) result(view)
        real(sph_real), intent(in), target :: a(:)
        type(sph_scalars) :: view
        view%stride = 1
        if (size(a) > 0) view%p = c_loc(a(1))
        if (size(a) > 1) view%stride = apart(a(1), a(2))
    end function
    function scalars_of_component(a, b) result(view)
        real(sph_real), intent(in), target :: a, b
        type(sph_scalars) :: view
        view%p = c_loc(a)
        view%stride = apart(a, b)
    end function
    function scalars_of_value(a) result(view)
        real(sph_real), intent(in), target :: a
        type(sph_scalars) :: view
        view%p = c_loc(a)
    end function

    function vectors_of_arrays(x, y, z) result(view)
        real(sph_real), intent(in), target :: x(:)
        real(sph_real), intent(in), target, optional :: y(:), z(:)
        type(sph_vectors) :: view
        view%x = sph_scalars(x)
        if (present(y)) view%y = sph_scalars(y)
        if (present(z)) view%z = sph_scalars(z)
    end function
    function vectors_of_matrix(v) result(view)
        real(sph_real), intent(in), target :: v(:, :)
        type(sph_vectors) :: view
        view%x = sph_scalars(v(1, :))
        if (size(v, 1) > 1) view%y = sph_scalars(v(2, :))
        if (size(v, 1) > 2) view%z = sph_scalars(v(3, :))
    end function

    function out_of_array(a, status) result(view)
        real(sph_real), intent(in), target :: a(:)
        integer(sph_state), intent(in), target, optional :: status(:)
        type(sph_scalar_out) :: view
        type(sph_scalars) :: at
        at = sph_scalars(a)
        view%p = at%p
        view%stride = at%stride
        if (present(status)) view%status = sph_address(status)
    end function

    function out_of_arrays(x, y, z) result(view)
        real(sph_real), intent(in), target :: x(:)
        real(sph_real), intent(in), target, optional :: y(:), z(:)
        type(sph_vector_out) :: view
        call put(sph_vectors(x, y, z), view)
    end function
    function out_of_matrix(v) result(view)
        real(sph_real), intent(in), target :: v(:, :)
        type(sph_vector_out) :: view
        call put(sph_vectors(v), view)
    end function
    subroutine put(from, view)
        type(sph_vectors), intent(in) :: from
        type(sph_vector_out), intent(out) :: view
        view%x = from%x%p
        view%y = from%y%p
        view%z = from%z%p
        view%stride = from%x%stride
        if (c_associated(view%y) .and. from%y%stride /= view%stride) &
            error stop 'sph: x and y must have the same stride'
        if (c_associated(view%z) .and. from%z%stride /= view%stride) &
            error stop 'sph: x and z must have the same stride'
    end subroutine

    ! The first number of an array that is contiguous, or has the stride that is given.
    function address_of_reals(a, stride) result(address)
        real(sph_real), intent(in), target :: a(:)
        integer(c_size_t), intent(in), optional :: stride
        type(c_ptr) :: address
        type(sph_scalars) :: view
        integer(c_size_t) :: wanted
        view = sph_scalars(a)
        wanted = 1
        if (present(stride)) wanted = max(stride, 1_c_size_t)
        if (size(a) > 1 .and. view%stride /= wanted) &
            error stop 'sph: an array has another stride than its output'
        address = view%p
    end function
    function address_of_states(a) result(address)
        integer(sph_state), intent(in), target :: a(:)
        type(c_ptr) :: address
        if (.not. is_contiguous(a)) error stop 'sph: status must be contiguous'
        address = c_null_ptr
        if (size(a) > 0) address = c_loc(a(1))
    end function

    ! ---------------------------------------------------------------- clouds

    ! n particles: smoothing length h, volumes V, positions x (y, z), which must have the same stride.
    ! sph_scalars() stands for what the operators to come do not need.
    subroutine init(self, kernel, n, h, V, x, y, z, not_ok)
        class(sph_cloud), intent(inout) :: self
        character(*), intent(in) :: kernel
        integer, intent(in) :: n
        type(sph_scalars), intent(in) :: h, V, x
        type(sph_scalars), intent(in), optional :: y, z
        integer, intent(out) :: not_ok
        type(sph_cloud_view) :: empty
        if (.not. sph_agrees()) error stop 'sph_c.f90 and the shim are of different headers or precision'
        self%kernel = sph_kernel_from_name(kernel)
        self%dim = 1
        self%view = empty
        self%view%points%n = int(n, sph_index)
        self%view%points%stride = x%stride
        self%view%points%x = x%p
        if (present(y)) then
            self%dim = 2
            self%view%points%y = y%p
            if (y%stride /= x%stride) error stop 'sph: x and y must have the same stride'
        end if
        if (present(z)) then
            self%dim = 3
            self%view%points%z = z%p
            if (z%stride /= x%stride) error stop 'sph: x and z must have the same stride'
        end if
        self%view%h = h
        self%view%volume = V
        self%view%last = self%view%points%n
        self%start => null()
        self%index => null()
        not_ok = 0
        if (self%kernel < 0) not_ok = SPH_ERROR_KERNEL
    end subroutine

    ! The sweeps to come treat the particles first to last, counted from 1.
    subroutine range(self, first, last)
        class(sph_cloud), intent(inout) :: self
        integer, intent(in) :: first, last
        call sph_cloud_range(self%view, int(first - 1, sph_index), int(last, sph_index))
    end subroutine

    ! lengths of a box that repeats itself; 0 leaves an axis open
    subroutine periodic(self, lx, ly, lz)
        class(sph_cloud), intent(inout) :: self
        real(sph_real), intent(in) :: lx, ly, lz
        self%view%points%box = sph_vec(lx, ly, lz)
        self%view%checked = 0
    end subroutine

    ! Lists of all j with |x_i - x_j| < R, without i. R is the support radius of i; with the criterion
    ! SPH_SCATTER that of j, with SPH_LARGER the larger of both, and with SPH_MEAN their mean, which M-SPH
    ! needs where h varies. radius: others than the kernel's support times h.
    subroutine find_lists(self, not_ok, criterion, radius)
        class(sph_cloud), intent(inout), target :: self
        integer, intent(out) :: not_ok
        integer(c_int), intent(in), optional :: criterion
        type(sph_scalars), intent(in), optional :: radius
        real(sph_real), pointer :: h(:)
        real(sph_real), allocatable, target :: support(:)
        type(sph_scalars) :: reach
        type(sph_neighbors) :: found
        integer(c_int) :: by
        integer(c_size_t) :: bytes
        by = SPH_GATHER
        if (present(criterion)) by = criterion
        self%start => null()
        self%index => null()
        self%view%list = found%list
        self%view%checked = 0
        associate (n => self%view%points%n, step => self%view%h%stride)
            if (present(radius)) then
                reach = radius
            else if (n > 0 .and. c_associated(self%view%h%p)) then
                call c_f_pointer(self%view%h%p, h, [step * (n - 1) + 1])
                allocate (support, source=sph_kernel_support_ratio(self%kernel) * h(::max(step, 1_c_size_t)))
                reach%p = c_loc(support)
                reach%stride = min(step, 1_c_size_t)
            end if
            if (.not. allocated(self%memory)) allocate (self%memory(1))
            do
                bytes = 8 * size(self%memory, kind=c_size_t)
                not_ok = sph_search(self%dim, self%view%points, reach, by, c_loc(self%memory), bytes, found)
                if (not_ok /= SPH_ERROR_CAPACITY) exit
                bytes = sph_search_size(self%dim, n, found%pairs)
                deallocate (self%memory)
                allocate (self%memory((bytes + 7) / 8))
            end do
            if (not_ok < 0) return
            if (n == 0) then ! no list is found, but rows begin with 0 all the same
                self%memory = 0
                found%list = sph_list(c_loc(self%memory), c_loc(self%memory))
            end if
            call c_f_pointer(found%list%start, self%start, [n + 1])
            call c_f_pointer(found%list%index, self%index, [found%pairs])
            self%view%list = found%list
        end associate
    end subroutine

    ! The host's own lists, which begin with 0 and leave out the particle itself.
    subroutine use_lists(self, start, index)
        class(sph_cloud), intent(inout) :: self
        integer(sph_index), intent(in), target, contiguous :: start(:), index(:)
        self%start => start
        self%index => index
        self%view%list = sph_list(c_loc(start), c_loc(index))
        self%view%checked = 0
    end subroutine

    ! Scans positions, lists, h and V once, and no more in each sweep until one of them is set anew.
    subroutine check(self, not_ok)
        class(sph_cloud), intent(inout) :: self
        integer, intent(out) :: not_ok
        not_ok = sph_cloud_checked(self%dim, self%view)
    end subroutine

    ! Looks for the likely mistakes in a new cloud, and prints each in words (to unit); not_ok is their
    ! number. pairs: the operators to come sum over pairs, and need both of their supports. See
    ! sph_cloud_examine.
    subroutine examine(self, not_ok, pairs, unit)
        class(sph_cloud), intent(in) :: self
        integer, intent(out) :: not_ok
        logical, intent(in), optional :: pairs
        integer, intent(in), optional :: unit
        type(sph_findings) :: found
        integer(c_int) :: both_sides
        integer :: finding, to
        both_sides = 0
        if (present(pairs)) both_sides = merge(1_c_int, 0_c_int, pairs)
        to = output_unit
        if (present(unit)) to = unit
        not_ok = sph_cloud_examine(self%kernel, self%dim, self%view, both_sides, 0_sph_index, found)
        do finding = 0, SPH_FINDING_COUNT - 1
            if (not_ok < 0 .or. .not. btest(found%set, finding)) cycle
            associate (at => found%at(finding + 1))
                write (to, '(a, i0, a, i0, 2a)') 'particle ', at%particle + 1, ', neighbour ', &
                    at%neighbour + 1, ': ', sph_finding_text(finding)
            end associate
        end do
    end subroutine

    ! ---------------------------------------------------------------- the sweeps that are called most
    ! Each comment names the C function. Outputs are of the length n; status (a sph_status of each target) may
    ! be absent.

    subroutine density(self, m, rho, not_ok, status) ! sph_density_summation
        class(sph_cloud), intent(in) :: self
        type(sph_scalars), intent(in) :: m
        real(sph_real), intent(inout), target :: rho(:)
        integer, intent(out) :: not_ok
        integer(sph_state), intent(inout), target, optional :: status(:)
        not_ok = sph_density_summation(self%kernel, self%dim, self%view, m, sph_scalar_out(rho, status))
    end subroutine

    subroutine gradient(self, f, gx, gy, gz, not_ok, status) ! sph_gradient_cspm
        class(sph_cloud), intent(in) :: self
        type(sph_scalars), intent(in) :: f
        real(sph_real), intent(inout), target :: gx(:)
        real(sph_real), intent(inout), target, optional :: gy(:), gz(:)
        integer, intent(out) :: not_ok
        integer(sph_state), intent(inout), target, optional :: status(:)
        type(sph_vector_out) :: to
        type(sph_derivatives_out) :: out
        to = sph_vector_out(gx, gy, gz)
        out%gx = to%x
        out%gy = to%y
        out%gz = to%z
        out%stride = to%stride
        if (present(status)) out%status = sph_address(status)
        not_ok = sph_gradient_cspm(self%kernel, self%dim, self%view, f, out)
    end subroutine

    subroutine laplacian_brookshaw(self, f, out, not_ok, status) ! sph_laplacian_brookshaw
        class(sph_cloud), intent(in) :: self
        type(sph_scalars), intent(in) :: f
        real(sph_real), intent(inout), target :: out(:)
        integer, intent(out) :: not_ok
        integer(sph_state), intent(inout), target, optional :: status(:)
        not_ok = sph_laplacian_brookshaw(self%kernel, self%dim, self%view, f, sph_scalar_out(out, status))
    end subroutine

    ! sph_derivatives_icspm, with WLS where it fails; out(:, i): gx, xx in 1D; gx, gy, xx, xy, yy in 2D;
    ! gx, gy, gz, xx, xy, yy, xz, yz, zz in 3D
    subroutine derivatives(self, f, conditioning_min, out, not_ok, status)
        class(sph_cloud), intent(in) :: self
        type(sph_scalars), intent(in) :: f
        real(sph_real), intent(in) :: conditioning_min
        real(sph_real), intent(inout), target :: out(:, :)
        integer, intent(out) :: not_ok
        integer(sph_state), intent(inout), target, optional :: status(:)
        type(c_ptr) :: at(9)
        type(sph_scalars) :: component
        type(sph_derivatives_out) :: to
        type(sph_derivatives_options) :: options
        integer :: i, numbers
        numbers = self%dim * (self%dim + 3) / 2
        if (size(out, 1) < numbers) error stop 'sph: out must have 2, 5 or 9 rows'
        at = c_null_ptr
        do i = 1, numbers
            component = sph_scalars(out(i, :))
            at(i) = component%p
        end do
        to%stride = component%stride
        to%gx = at(1)
        if (self%dim > 1) to%gy = at(2)
        if (self%dim > 2) to%gz = at(3)
        to%hxx = at(self%dim + 1)
        if (self%dim > 1) to%hxy = at(self%dim + 2)
        if (self%dim > 1) to%hyy = at(self%dim + 3)
        if (self%dim > 2) to%hxz = at(self%dim + 4)
        if (self%dim > 2) to%hyz = at(self%dim + 5)
        if (self%dim > 2) to%hzz = at(self%dim + 6)
        if (present(status)) to%status = sph_address(status)
        options%conditioning_min = conditioning_min
        options%fallback_wls = 1
        not_ok = sph_derivatives_icspm(self%kernel, self%dim, self%view, f, options, to)
    end subroutine

    ! sph_elliptic_rows_msph: div(m grad u) of i is diagonal(i) u(i) + the sum of row(p) u(index(p) + 1)
    subroutine rows_msph(self, m, trace, row, diagonal, not_ok, status)
        class(sph_cloud), intent(in) :: self
        type(sph_scalars), intent(in) :: m
        logical, intent(in) :: trace
        real(sph_real), intent(inout), target :: row(:), diagonal(:)
        integer, intent(out) :: not_ok
        integer(sph_state), intent(inout), target, optional :: status(:)
        type(sph_elliptic_options) :: options
        type(sph_rows_out) :: out
        options%trace = merge(1_c_int, 0_c_int, trace)
        out%row = sph_address(row)
        out%diagonal = sph_address(diagonal)
        if (present(status)) out%status = sph_address(status)
        not_ok = sph_elliptic_rows_msph(self%kernel, self%dim, self%view, m, options, out)
    end subroutine

    subroutine apply(self, row, diagonal, u, out, not_ok, status) ! sph_rows_apply
        class(sph_cloud), intent(in) :: self
        real(sph_real), intent(in), contiguous :: row(:)
        real(sph_real), intent(in), target :: diagonal(:)
        type(sph_scalars), intent(in) :: u
        real(sph_real), intent(inout), target :: out(:)
        integer, intent(out) :: not_ok
        integer(sph_state), intent(inout), target, optional :: status(:)
        not_ok = sph_rows_apply(self%view, row, sph_scalars(diagonal), u, sph_scalar_out(out, status))
    end subroutine

end module
