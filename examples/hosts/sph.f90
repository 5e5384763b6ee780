! SPDX-License-Identifier: MIT
!
! sph.f90 - the operators of sph.h for Fortran (2018), through the shim (sph_shim.h).
!
!     cc -O2 -c -I. examples/hosts/sph_shim.c
!     gfortran -O2 examples/hosts/sph.f90 your_code.f90 sph_shim.o -lm          (from the repository's root)
!
!     use sph
!     type(sph_cloud) :: cloud
!     call cloud%init('wendland-c2', n, sph_field(h), sph_field(V), sph_field(x), sph_field(y), not_ok=error)
!     call cloud%find_lists(error)                                neighbour lists: cloud%start, cloud%index
!     call cloud%gradient(sph_field(f), gx, gy, not_ok=error)
!     if (error < 0) print '(a)', sph_error_text(error)
!
! An sph_field is where the numbers of the particles are; nothing is copied:
!     sph_field(a)                  an array, or a section of it; it may be empty
!     sph_field(p(1)%a, p(2)%a)     a component of an array of a derived type, by its first two (p%a itself
!                                   would be copied, and the copy gone after the call)
!     sph_field(h)                  a scalar: one value for all
! Give them the attribute target, and keep them as long as the cloud, which must not be copied (its copy would
! look at the lists of the first).
! not_ok: the number of targets that are not ok (0: all well), or a negative error, which
! sph_error_text(error) puts in words, with the argument and the first particle at fault;
! sph_status_text(status) has those of a status.
! Lists begin with 0, as in C: the neighbours of particle i are cloud%index(p) + 1
! for p = cloud%start(i) + 1, cloud%start(i + 1).
! What is computed, and what it is exact for: sph_ops.h, under the C names of the interfaces below. Double
! precision; for a shim that is compiled with -DSPH_SINGLE=1 change sph_real.

module sph
    use, intrinsic :: iso_c_binding
    implicit none
    private
    public :: sph_real, sph_index, sph_field, sph_cloud, sph_kernel_wf, sph_status_text, sph_error_text

    integer, parameter :: sph_real = c_double, sph_index = c_int32_t

    type :: sph_field
        private
        type(c_ptr) :: p = c_null_ptr
        integer(c_size_t) :: stride = 0 ! from one number to the next, in sph_real
    end type
    interface sph_field
        procedure field_of_array, field_of_component, field_of_scalar
    end interface

    type :: sph_cloud
        integer :: dim = 0, kernel = -1
        integer(sph_index) :: n = 0
        integer(sph_index), allocatable :: start(:), index(:) ! of find_lists
        type(sph_field), private :: h
        integer(c_int64_t), allocatable, private :: c(:) ! what the shim keeps
    contains
        procedure :: init, range, periodic, find_lists, use_lists, check
        procedure :: density, gradient, laplacian_brookshaw, derivatives, rows_msph, apply
    end type

    interface
        function c_real_size() bind(c, name='sph_shim_real_size') result(size)
            import
            integer(c_int) :: size
        end function
        function c_kernel_from_name(name) bind(c, name='sph_shim_kernel_from_name') result(kernel)
            import
            character(kind=c_char), intent(in) :: name(*)
            integer(c_int) :: kernel
        end function
        function c_status_text(status) bind(c, name='sph_shim_status_text') result(text)
            import
            integer(c_int), value :: status
            type(c_ptr) :: text
        end function
        function c_refused(error, particle) bind(c, name='sph_shim_refused') result(argument)
            import
            integer(c_int), value :: error
            integer(sph_index), intent(out) :: particle
            type(c_ptr) :: argument
        end function
        function c_cloud_check(c) bind(c, name='sph_shim_cloud_check') result(error)
            import
            integer(c_int64_t), intent(inout) :: c(*)
            integer(c_int) :: error
        end function
        function c_strlen(text) bind(c, name='strlen') result(length)
            import
            type(c_ptr), value :: text
            integer(c_size_t) :: length
        end function
        function c_kernel_support(kernel) bind(c, name='sph_shim_kernel_support') result(support)
            import
            integer(c_int), value :: kernel
            real(sph_real) :: support
        end function
        function c_kernel_wf(kernel, dim, n, r, h, w, f) bind(c, name='sph_shim_kernel_wf') result(error)
            import
            integer(c_int), value :: kernel, dim
            integer(sph_index), value :: n
            real(sph_real), value :: h
            real(sph_real), intent(in) :: r(*)
            real(sph_real), intent(out) :: w(*), f(*)
            integer(c_int) :: error
        end function
        function c_cloud_size() bind(c, name='sph_shim_cloud_size') result(size)
            import
            integer(c_size_t) :: size
        end function
        function c_cloud_init(c, kernel, dim, n, x, y, z, stride) &
            bind(c, name='sph_shim_cloud_init') result(error)
            import
            integer(c_int64_t), intent(inout) :: c(*)
            integer(c_int), value :: kernel, dim
            integer(sph_index), value :: n
            type(c_ptr), value :: x, y, z
            integer(c_size_t), value :: stride
            integer(c_int) :: error
        end function
        subroutine c_cloud_volumes(c, h, h_stride, V, V_stride) bind(c, name='sph_shim_cloud_volumes')
            import
            integer(c_int64_t), intent(inout) :: c(*)
            type(c_ptr), value :: h, V
            integer(c_size_t), value :: h_stride, V_stride
        end subroutine
        subroutine c_cloud_lists(c, start, index) bind(c, name='sph_shim_cloud_lists')
            import
            integer(c_int64_t), intent(inout) :: c(*)
            type(c_ptr), value :: start, index
        end subroutine
        subroutine c_cloud_periodic(c, lx, ly, lz) bind(c, name='sph_shim_cloud_periodic')
            import
            integer(c_int64_t), intent(inout) :: c(*)
            real(sph_real), value :: lx, ly, lz
        end subroutine
        subroutine c_cloud_range(c, first, last) bind(c, name='sph_shim_cloud_range')
            import
            integer(c_int64_t), intent(inout) :: c(*)
            integer(sph_index), value :: first, last
        end subroutine
        function c_grid_workspace(dim, n) bind(c, name='sph_shim_grid_workspace') result(size)
            import
            integer(c_int), value :: dim
            integer(sph_index), value :: n
            integer(c_size_t) :: size
        end function
        function c_grid_lists(c, criterion, radius, radius_stride, work, work_size, start, index, capacity, &
                              pairs) &
            bind(c, name='sph_shim_grid_lists') result(error)
            import
            integer(c_int64_t), intent(in) :: c(*)
            integer(c_int), value :: criterion
            real(sph_real), intent(in) :: radius(*)
            integer(c_size_t), value :: radius_stride, work_size, capacity
            integer(c_int64_t), intent(inout) :: work(*)
            integer(sph_index), intent(inout) :: start(*)
            type(c_ptr), value :: index
            integer(c_int64_t), intent(out) :: pairs
            integer(sph_index) :: error
        end function
        function c_density_summation(c, m, m_stride, rho) &
            bind(c, name='sph_shim_density_summation') result(not_ok)
            import
            integer(c_int64_t), intent(in) :: c(*)
            type(c_ptr), value :: m
            integer(c_size_t), value :: m_stride
            real(sph_real), intent(inout) :: rho(*)
            integer(sph_index) :: not_ok
        end function
        function c_gradient_cspm(c, f, f_stride, gx, gy, gz, status) &
            bind(c, name='sph_shim_gradient_cspm') result(not_ok)
            import
            integer(c_int64_t), intent(in) :: c(*)
            type(c_ptr), value :: f, status
            integer(c_size_t), value :: f_stride
            real(sph_real), intent(inout) :: gx(*)
            real(sph_real), intent(inout), optional :: gy(*), gz(*)
            integer(sph_index) :: not_ok
        end function
        function c_laplacian_brookshaw(c, f, f_stride, out) &
            bind(c, name='sph_shim_laplacian_brookshaw') result(not_ok)
            import
            integer(c_int64_t), intent(in) :: c(*)
            type(c_ptr), value :: f
            integer(c_size_t), value :: f_stride
            real(sph_real), intent(inout) :: out(*)
            integer(sph_index) :: not_ok
        end function
        function c_derivatives_icspm(c, f, f_stride, conditioning_min, fallback_wls, out, status) &
            bind(c, name='sph_shim_derivatives_icspm') result(not_ok)
            import
            integer(c_int64_t), intent(in) :: c(*)
            type(c_ptr), value :: f, status
            integer(c_size_t), value :: f_stride
            real(sph_real), value :: conditioning_min
            integer(c_int), value :: fallback_wls
            real(sph_real), intent(inout) :: out(*)
            integer(sph_index) :: not_ok
        end function
        function c_elliptic_rows_msph(c, m, m_stride, trace, row, diagonal, status) &
            bind(c, name='sph_shim_elliptic_rows_msph') result(not_ok)
            import
            integer(c_int64_t), intent(in) :: c(*)
            type(c_ptr), value :: m, status
            integer(c_size_t), value :: m_stride
            integer(c_int), value :: trace
            real(sph_real), intent(inout) :: row(*), diagonal(*)
            integer(sph_index) :: not_ok
        end function
        function c_rows_apply(c, row, diagonal, u, u_stride, out) &
            bind(c, name='sph_shim_rows_apply') result(not_ok)
            import
            integer(c_int64_t), intent(in) :: c(*)
            real(sph_real), intent(in) :: row(*), diagonal(*)
            type(c_ptr), value :: u
            integer(c_size_t), value :: u_stride
            real(sph_real), intent(inout) :: out(*)
            integer(sph_index) :: not_ok
        end function
    end interface

contains

    ! W and F = (1/r) dW/dr of the distances r
    subroutine sph_kernel_wf(kernel, dim, r, h, w, f, error)
        character(*), intent(in) :: kernel
        integer, intent(in) :: dim
        real(sph_real), intent(in) :: r(:), h
        real(sph_real), intent(out) :: w(size(r)), f(size(r))
        integer, intent(out) :: error
        integer(sph_index) :: n
        n = size(r, kind=sph_index)
        error = c_kernel_wf(c_kernel_from_name(trim(kernel)//c_null_char), dim, n, r, h, w, f)
    end subroutine

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

    function sph_status_text(status) result(text)
        integer, intent(in) :: status
        character(:), allocatable :: text
        text = text_of(c_status_text(status))
    end function

    ! The error that was just answered: 'h: h must be finite and positive, first at particle 18', which counts
    ! from 1.
    function sph_error_text(error) result(text)
        integer, intent(in) :: error
        character(:), allocatable :: text
        character(20) :: number
        integer(sph_index) :: particle
        text = text_of(c_refused(error, particle))
        if (len(text) > 0) text = text//': '
        text = text//sph_status_text(error)
        write (number, '(i0)') particle + 1
        if (particle >= 0) text = text//', first at particle '//trim(number)
    end function

    function field_of_array(a) result(field)
        real(sph_real), intent(in), target :: a(:)
        type(sph_field) :: field
        field%stride = 1
        if (size(a) > 0) field%p = c_loc(a(1))
        if (size(a) > 1) field = field_of_component(a(1), a(2))
    end function
    function field_of_component(a, b) result(field)
        real(sph_real), intent(in), target :: a, b
        type(sph_field) :: field
        field%p = c_loc(a)
        field%stride = transfer(c_loc(b), field%stride) - transfer(c_loc(a), field%stride)
        field%stride = field%stride / (storage_size(a) / 8)
    end function
    function field_of_scalar(a) result(field)
        real(sph_real), intent(in), target :: a
        type(sph_field) :: field
        field%p = c_loc(a)
    end function

    ! n particles: smoothing length h, volumes V, positions x (y, z), which must have the same stride.
    subroutine init(self, kernel, n, h, V, x, y, z, not_ok)
        class(sph_cloud), intent(inout) :: self
        character(*), intent(in) :: kernel
        integer, intent(in) :: n
        type(sph_field), intent(in) :: h, V, x
        type(sph_field), intent(in), optional :: y, z
        integer, intent(out) :: not_ok
        type(c_ptr) :: py, pz
        if (c_real_size() /= storage_size(1.0_sph_real) / 8) &
            error stop 'sph.f90 and the shim are of different precision'
        self%dim = 1
        py = c_null_ptr
        pz = c_null_ptr
        if (present(y)) then
            self%dim = 2
            py = y%p
            if (y%stride /= x%stride) error stop 'sph: x and y must have the same stride'
        end if
        if (present(z)) then
            self%dim = 3
            pz = z%p
            if (z%stride /= x%stride) error stop 'sph: x and z must have the same stride'
        end if
        if (allocated(self%c)) deallocate (self%c)
        allocate (self%c((c_cloud_size() + 7) / 8))
        self%n = n
        self%h = h
        self%kernel = c_kernel_from_name(trim(kernel)//c_null_char)
        not_ok = c_cloud_init(self%c, self%kernel, self%dim, self%n, x%p, py, pz, x%stride)
        if (not_ok == 0) call c_cloud_volumes(self%c, h%p, h%stride, V%p, V%stride)
    end subroutine

    ! The sweeps to come treat the particles first to last, counted from 1.
    subroutine range(self, first, last)
        class(sph_cloud), intent(inout) :: self
        integer, intent(in) :: first, last
        call c_cloud_range(self%c, first - 1, last)
    end subroutine

    subroutine periodic(self, lx, ly, lz)
        class(sph_cloud), intent(inout) :: self
        real(sph_real), intent(in) :: lx, ly, lz
        call c_cloud_periodic(self%c, lx, ly, lz)
    end subroutine

    ! Lists within the support radius: every j with |x_i - x_j| < support h_i.
    subroutine find_lists(self, not_ok)
        class(sph_cloud), intent(inout), target :: self
        integer, intent(out) :: not_ok
        integer(c_int64_t), allocatable :: work(:)
        real(sph_real), pointer :: h(:)
        real(sph_real), allocatable :: radius(:)
        integer(c_int64_t) :: pairs
        integer(c_size_t) :: step, work_size, radius_stride
        if (allocated(self%start)) deallocate (self%start, self%index)
        allocate (self%start(self%n + 1), source=0_sph_index)
        if (self%n == 0) then
            allocate (self%index(1))
            call c_cloud_lists(self%c, c_loc(self%start), c_loc(self%index))
            not_ok = 0
            return
        end if
        step = max(self%h%stride, 1_c_size_t)
        radius_stride = min(self%h%stride, 1_c_size_t)
        call c_f_pointer(self%h%p, h, [self%h%stride * (self%n - 1) + 1])
        allocate (radius, source=c_kernel_support(self%kernel) * h(::step))
        work_size = c_grid_workspace(self%dim, self%n)
        allocate (work((work_size + 7) / 8))
        not_ok = c_grid_lists(self%c, 0, radius, radius_stride, work, work_size, self%start, c_null_ptr, &
                              0_c_size_t, pairs) ! counts
        if (not_ok /= 0) pairs = 0
        allocate (self%index(max(pairs, 1_c_int64_t)))
        if (not_ok /= 0) return
        not_ok = c_grid_lists(self%c, 0, radius, radius_stride, work, work_size, self%start, &
                              c_loc(self%index), size(self%index, kind=c_size_t), pairs)
        call c_cloud_lists(self%c, c_loc(self%start), c_loc(self%index))
    end subroutine

    ! The host's own lists, which begin with 0 and leave out the particle itself.
    subroutine use_lists(self, start, index)
        class(sph_cloud), intent(inout) :: self
        integer(sph_index), intent(in), target, contiguous :: start(:), index(:)
        call c_cloud_lists(self%c, c_loc(start), c_loc(index))
    end subroutine

    ! Scans positions, lists, h and V once, and no more in each sweep until one of them is set anew.
    subroutine check(self, not_ok)
        class(sph_cloud), intent(inout) :: self
        integer, intent(out) :: not_ok
        not_ok = c_cloud_check(self%c)
    end subroutine

    ! The sweeps. Each comment names the C function.

    subroutine density(self, m, rho, not_ok) ! sph_density_summation
        class(sph_cloud), intent(in) :: self
        type(sph_field), intent(in) :: m
        real(sph_real), intent(inout), contiguous :: rho(:)
        integer, intent(out) :: not_ok
        not_ok = c_density_summation(self%c, m%p, m%stride, rho)
    end subroutine

    subroutine gradient(self, f, gx, gy, gz, not_ok) ! sph_gradient_cspm
        class(sph_cloud), intent(in) :: self
        type(sph_field), intent(in) :: f
        real(sph_real), intent(inout), contiguous :: gx(:)
        real(sph_real), intent(inout), contiguous, optional :: gy(:), gz(:)
        integer, intent(out) :: not_ok
        not_ok = c_gradient_cspm(self%c, f%p, f%stride, gx, gy, gz, c_null_ptr)
    end subroutine

    subroutine laplacian_brookshaw(self, f, out, not_ok) ! sph_laplacian_brookshaw
        class(sph_cloud), intent(in) :: self
        type(sph_field), intent(in) :: f
        real(sph_real), intent(inout), contiguous :: out(:)
        integer, intent(out) :: not_ok
        not_ok = c_laplacian_brookshaw(self%c, f%p, f%stride, out)
    end subroutine

    ! sph_derivatives_icspm; out(:, i): gx, xx in 1D; gx, gy, xx, xy, yy in 2D;
    ! gx, gy, gz, xx, xy, yy, xz, yz, zz in 3D
    subroutine derivatives(self, f, conditioning_min, out, not_ok)
        class(sph_cloud), intent(in) :: self
        type(sph_field), intent(in) :: f
        real(sph_real), intent(in) :: conditioning_min
        real(sph_real), intent(inout), contiguous :: out(:, :)
        integer, intent(out) :: not_ok
        not_ok = c_derivatives_icspm(self%c, f%p, f%stride, conditioning_min, 1, out, c_null_ptr)
    end subroutine

    ! sph_elliptic_rows_msph: div(m grad u) of i is diagonal(i) u(i) + the sum of row(p) u(index(p) + 1)
    subroutine rows_msph(self, m, trace, row, diagonal, not_ok)
        class(sph_cloud), intent(in) :: self
        type(sph_field), intent(in) :: m
        logical, intent(in) :: trace
        real(sph_real), intent(inout), contiguous :: row(:), diagonal(:)
        integer, intent(out) :: not_ok
        not_ok = c_elliptic_rows_msph(self%c, m%p, m%stride, merge(1, 0, trace), row, diagonal, c_null_ptr)
    end subroutine

    subroutine apply(self, row, diagonal, u, out, not_ok) ! sph_rows_apply
        class(sph_cloud), intent(in) :: self
        real(sph_real), intent(in), contiguous :: row(:), diagonal(:)
        type(sph_field), intent(in) :: u
        real(sph_real), intent(inout), contiguous :: out(:)
        integer, intent(out) :: not_ok
        not_ok = c_rows_apply(self%c, row, diagonal, u%p, u%stride, out)
    end subroutine

end module
