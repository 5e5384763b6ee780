! SPDX-License-Identifier: MIT
!
! host.f90 - a Fortran code with its own particles, an array of a derived type whose components are read in
! place.
!
!     cc -O2 -c -I. examples/hosts/sph_shim.c
!     gfortran -O2 examples/hosts/sph_c.f90 examples/hosts/sph.f90 examples/hosts/host.f90 sph_shim.o -o host
!     ./host                                                                     (from the repository's root)
!
! A corrected gradient of a linear field and a row of the M-SPH Laplacian, both exact on a disordered cloud; a
! density by a loop over pairs of the host's own, and by the sweep; and the kernels against the known answers.
! Exit status 0 if all is right.

program host
    use sph
    implicit none
    integer, parameter :: side = 21, n = side * side, middle = (n + 1) / 2
    real(sph_real), parameter :: dx = 1.0_sph_real / side

    type :: particle_t ! whatever the code has
        real(sph_real) :: x, y, velocity(2), temperature
    end type
    type(particle_t), target :: particle(n)
    type(sph_scalars) :: temperature
    type(sph_cloud) :: cloud
    real(sph_real), target :: h = 1.3_sph_real * dx, V = dx * dx, mobility = 0.5_sph_real
    real(sph_real), target :: gx(n), gy(n), Lu(n), diagonal(n), rho(n)
    real(sph_real), allocatable, target :: row(:)
    real(sph_real) :: square, density(n)
    integer :: i, j, p, not_ok, failures = 0

    do i = 1, n
        particle(i)%x = dx * (mod(i - 1, side) + 0.5_sph_real + 0.2_sph_real * sin(37.0_sph_real * (i - 1)))
        particle(i)%y = dx * ((i - 1) / side + 0.5_sph_real + 0.2_sph_real * cos(53.0_sph_real * (i - 1)))
        particle(i)%temperature = 0.7_sph_real + 1.3_sph_real * particle(i)%x - 0.8_sph_real * particle(i)%y
    end do

    temperature = sph_scalars(particle(1)%temperature, particle(2)%temperature)
    call cloud%init('wendland-c2', n, sph_scalars(h), sph_scalars(V), &
                    sph_scalars(particle(1)%x, particle(2)%x), &
                    sph_scalars(particle(1)%y, particle(2)%y), not_ok=not_ok)
    if (not_ok == 0) call cloud%find_lists(not_ok)
    if (not_ok == 0) call cloud%check(not_ok)
    if (not_ok == 0) call cloud%gradient(temperature, gx, gy, not_ok=not_ok)
    call all_well(not_ok)
    call expect('gradient at a corner, x', gx(1), 1.3_sph_real, 1e-12_sph_real)
    call expect('gradient at a corner, y', gy(1), -0.8_sph_real, 1e-12_sph_real)
    call expect('gradient in the middle, x', gx(middle), 1.3_sph_real, 1e-12_sph_real)
    call expect('gradient in the middle, y', gy(middle), -0.8_sph_real, 1e-12_sph_real)

    ! sum_j m W_ij, with itself; the mass of each is that of a fluid of density 1
    do concurrent (i = 1:n)
        density(i) = V * density_of(i)
    end do
    call cloud%density(sph_scalars(V), rho, not_ok)
    call all_well(not_ok)
    call expect('density, largest difference of both', maxval(abs(density - rho)), 0.0_sph_real, &
                1e-12_sph_real)

    ! one row of div(m grad u): with trace exact for a linear u and for |x|^2
    allocate (row(size(cloud%index)))
    call cloud%range(middle, middle)
    call cloud%rows_msph(sph_scalars(mobility), .true., row, diagonal, not_ok)
    if (not_ok == 0) call cloud%apply(row, diagonal, temperature, Lu, not_ok)
    call all_well(not_ok)
    square = 0
    do p = cloud%start(middle) + 1, cloud%start(middle + 1)
        j = cloud%index(p) + 1
        square = square + row(p) * (particle(j)%x**2 + particle(j)%y**2 &
                                    - particle(middle)%x**2 - particle(middle)%y**2)
    end do
    associate (first => cloud%start(middle) + 1, last => cloud%start(middle + 1))
        print '(a, i0, a, i0, a, f0.6)', 'M-SPH row of particle ', middle, ': ', last - first + 1, &
            ' neighbours, diagonal ', diagonal(middle)
        call expect('M-SPH, sum of the row', diagonal(middle) + sum(row(first:last)), 0.0_sph_real, &
                    1e-9_sph_real)
    end associate
    call expect('M-SPH, div(m grad u) of a linear u', Lu(middle), 0.0_sph_real, 1e-9_sph_real)
    call expect('M-SPH, div(m grad u) of u = x^2 + y^2', square, 4 * mobility, 1e-9_sph_real)

    call known_answers('tests/known/kernels.csv')
    if (failures > 0) error stop 1

contains

    pure function density_of(i) result(sum_w)
        integer, intent(in) :: i
        real(sph_real) :: sum_w, r
        integer :: p, j
        sum_w = sph_kernel_w(SPH_WENDLAND_C2, 2, 0.0_sph_real, h)
        do p = cloud%start(i) + 1, cloud%start(i + 1)
            j = cloud%index(p) + 1
            r = hypot(particle(i)%x - particle(j)%x, particle(i)%y - particle(j)%y)
            sum_w = sum_w + sph_kernel_w(SPH_WENDLAND_C2, 2, r, h)
        end do
    end function

    subroutine all_well(not_ok)
        integer, intent(in) :: not_ok
        if (not_ok < 0) print '(a)', sph_error_text(not_ok)
        if (not_ok /= 0) error stop 1
    end subroutine

    subroutine expect(what, value, exact, tolerance)
        character(*), intent(in) :: what
        real(sph_real), intent(in) :: value, exact, tolerance
        character(52) :: text
        logical :: right
        text = what
        right = abs(value - exact) <= tolerance
        print '(a, f19.12, a, f0.1, a)', text, value, '  exact ', exact, merge('       ', '  WRONG', right)
        if (.not. right) failures = failures + 1
    end subroutine

    ! W and F of every kernel; the rows of a kernel, dimension and h stand together, and what is allowed is
    ! relative to the largest of them
    subroutine known_answers(path)
        character(*), intent(in) :: path
        integer, parameter :: most = 4096
        character(1024) :: line
        character(32), save :: kernel(most)
        integer, save :: dim(most)
        integer :: rows, first, last, off, unit, status
        real(sph_real), save :: length(most), r(most), W(most), F(most), gotW(most), gotF(most)
        real(sph_real) :: sigma, dWdr, allowed
        rows = 0
        off = 0
        open (newunit=unit, file=path, status='old', action='read', iostat=status)
        do while (status == 0 .and. rows < most)
            read (unit, '(a)', iostat=status) line
            if (status /= 0 .or. line(1:1) == '#' .or. line(1:7) == 'kernel,') cycle
            rows = rows + 1
            read (line, *) kernel(rows), dim(rows), length(rows), r(rows), sigma, W(rows), dWdr, F(rows)
        end do
        first = 1
        do while (first <= rows)
            last = first
            do while (last < rows)
                if (kernel(last + 1) /= kernel(first) .or. dim(last + 1) /= dim(first)) exit
                if (abs(length(last + 1) - length(first)) > 0) exit
                last = last + 1
            end do
            call sph_kernel_wf(kernel(first), dim(first), r(first:last), length(first), &
                               gotW(first:last), gotF(first:last), status)
            call all_well(status)
            allowed = 8 * epsilon(1.0_sph_real)
            off = off + count(.not. abs(gotW(first:last) - W(first:last)) <= &
                              allowed * maxval(abs(W(first:last))))
            off = off + count(.not. abs(gotF(first:last) - F(first:last)) <= &
                              allowed * maxval(abs(F(first:last))))
            first = last + 1
        end do
        print '(a, i0, a, i0, a)', 'known answers: ', rows, ' rows, ', off, ' off'
        if (off > 0 .or. rows == 0) failures = failures + 1
    end subroutine

end program
