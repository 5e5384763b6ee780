! SPDX-License-Identifier: MIT
!
! test_fortran.f90 - what examples/hosts/sph.f90 adds to the functions of C: views, lists, ranges, texts, and
! the kernels in loops of the host's own; and the functions that need more than a cloud. All others are
! compared with C by calls.f90, which fortran_calls.py writes.

program test_fortran
    use sph
    implicit none
    integer, parameter :: side = 12, n = side * side
    real(sph_real), parameter :: dx = 1.0_sph_real / side, tiny_error = 1e-12_sph_real
    real(sph_real), target :: xyh(3, n), V(n), volume, f(n), gradient(2, n), rho(2 * n), jet(5, n), h
    integer(sph_state), target :: status(n)
    type(sph_cloud), target :: cloud
    integer :: i, not_ok, failures = 0, passed = 0

    do i = 1, n
        xyh(1, i) = dx * (mod(i - 1, side) + 0.5_sph_real + 0.2_sph_real * sin(37.0_sph_real * i))
        xyh(2, i) = dx * ((i - 1) / side + 0.5_sph_real + 0.2_sph_real * cos(53.0_sph_real * i))
        xyh(3, i) = dx * (1.4_sph_real + 0.3_sph_real * sin(29.0_sph_real * i))
        f(i) = 0.7_sph_real + 1.3_sph_real * xyh(1, i) - 0.8_sph_real * xyh(2, i)
    end do
    h = 1.4_sph_real * dx
    volume = dx * dx
    V = volume
    call expect('library and module agree', sph_agrees())
    call views()
    call lists()
    call sweeps()
    call kernels()
    call refusals()
    call nothing()
    call searches()
    print '(a, i0, a, i0, a)', 'test_fortran: ', passed, ' passed, ', failures, ' failed'
    if (failures > 0) error stop 1

contains

    subroutine expect(what, right)
        character(*), intent(in) :: what
        logical, intent(in) :: right
        if (right) then
            passed = passed + 1
        else
            failures = failures + 1
            print '(2a)', 'failed: ', what
        end if
    end subroutine

    ! gfortran 12 fails inside if c_loc is an argument of c_associated
    logical function same(p, q)
        type(c_ptr), intent(in) :: p, q
        same = c_associated(p, q)
    end function

    subroutine make(criterion)
        integer(c_int), intent(in) :: criterion
        call cloud%init('wendland-c2', n, sph_scalars(xyh(3, :)), sph_scalars(V), sph_scalars(xyh(1, :)), &
                        sph_scalars(xyh(2, :)), not_ok=not_ok)
        if (not_ok == 0) call cloud%find_lists(not_ok, criterion)
        call expect('a cloud', not_ok == 0)
    end subroutine

    ! where numbers are, and how far apart
    subroutine views()
        type(sph_scalars) :: a
        type(sph_vectors) :: b
        type(sph_vector_out) :: c
        type(sph_scalar_out) :: d
        type(c_ptr) :: at
        a = sph_scalars(f)
        call expect('an array', same(a%p, c_loc(f(1))) .and. a%stride == 1)
        a = sph_scalars(xyh(2, 3:))
        call expect('a section', same(a%p, c_loc(xyh(2, 3))) .and. a%stride == 3)
        a = sph_scalars(f(2::5))
        call expect('a section with a step', same(a%p, c_loc(f(2))) .and. a%stride == 5)
        a = sph_scalars(f(1:0))
        call expect('an empty array', .not. c_associated(a%p))
        a = sph_scalars(h)
        call expect('one value', same(a%p, c_loc(h)) .and. a%stride == 0)
        a = sph_scalars(xyh(1, 1), xyh(1, 2))
        call expect('a component', same(a%p, c_loc(xyh(1, 1))) .and. a%stride == 3)
        a = sph_scalars()
        call expect('none', .not. c_associated(a%p))
        b = sph_vectors(xyh)
        call expect('vectors in a matrix', same(b%y%p, c_loc(xyh(2, 1))) .and. b%z%stride == 3)
        b = sph_vectors(f, V)
        call expect('vectors in arrays', same(b%y%p, c_loc(V(1))) .and. .not. c_associated(b%z%p))
        c = sph_vector_out(gradient)
        call expect('a matrix for results', same(c%y, c_loc(gradient(2, 1))) .and. c%stride == 2 &
                    .and. .not. c_associated(c%z))
        d = sph_scalar_out(rho(2::2), status)
        call expect('an array for results', same(d%p, c_loc(rho(2))) .and. d%stride == 2 &
                    .and. same(d%status, c_loc(status(1))))
        at = sph_address(f)
        call expect('an address', same(at, c_loc(f(1))))
        at = sph_address(gradient(2, :), 2_c_size_t)
        call expect('an address with a stride', same(at, c_loc(gradient(2, 1))))
    end subroutine

    ! by each criterion, against all pairs
    subroutine lists()
        integer(c_int) :: criterion
        integer :: i, j, p, pairs
        real(sph_real) :: R(n), reach, d
        logical :: listed(n), right
        R = sph_kernel_support_ratio(SPH_WENDLAND_C2) * xyh(3, :)
        do criterion = SPH_GATHER, SPH_MEAN
            call make(criterion)
            right = size(cloud%start) == n + 1
            pairs = 0
            do i = 1, n
                listed = .false.
                do p = cloud%start(i) + 1, cloud%start(i + 1)
                    listed(cloud%index(p) + 1) = .true.
                end do
                do j = 1, n
                    select case (criterion)
                    case (SPH_GATHER)
                        reach = R(i)
                    case (SPH_SCATTER)
                        reach = R(j)
                    case (SPH_LARGER)
                        reach = max(R(i), R(j))
                    case default
                        reach = (R(i) + R(j)) / 2
                    end select
                    d = hypot(xyh(1, i) - xyh(1, j), xyh(2, i) - xyh(2, j))
                    right = right .and. (listed(j) .eqv. (i /= j .and. d < reach))
                    pairs = pairs + merge(1, 0, listed(j))
                end do
            end do
            call expect('lists by a criterion', right .and. size(cloud%index) == pairs)
        end do
        call cloud%find_lists(not_ok, radius=sph_scalars(h))
        call expect('lists of another radius', not_ok == 0 .and. size(cloud%index) < pairs)
        call cloud%find_lists(not_ok)
        pairs = size(cloud%index)
        call cloud%periodic(1.0_sph_real, 1.0_sph_real, 0.0_sph_real)
        call cloud%find_lists(not_ok)
        call expect('lists of a periodic box', not_ok == 0 .and. size(cloud%index) > pairs)
    end subroutine

    ! what is exact, to round-off, in place and with statuses
    subroutine sweeps()
        type(sph_density_options) :: options
        type(sph_density_out) :: out
        real(sph_real), target :: g(3, n), Lu(n), diagonal(n), adapted(n), radius(n), square(n), eta
        real(sph_real), allocatable, target :: row(:)
        integer(sph_index), allocatable, target :: start(:), index(:)
        call make(SPH_MEAN)
        call cloud%check(not_ok)
        call expect('the cloud is sound', not_ok == 0 .and. cloud%view%checked == 1)
        g = -7
        status = 77
        call cloud%gradient(sph_scalars(f), g(1, :), g(3, :), not_ok=not_ok, status=status)
        call expect('gradient', not_ok == 0 .and. all(abs(g(1, :) - 1.3_sph_real) < tiny_error) .and. &
                    all(abs(g(3, :) + 0.8_sph_real) < tiny_error) .and. all(status == SPH_OK))
        call expect('what lies between is left alone', all(abs(g(2, :) + 7) < tiny_error))
        call cloud%range(3, 4)
        g = -7
        call cloud%gradient(sph_scalars(f), g(1, :), g(3, :), not_ok=not_ok)
        call expect('a range', count(g(1, :) > 0) == 2 .and. all(g(1, 3:4) > 0))
        call cloud%range(1, n)

        square = xyh(1, :)**2 + 3 * xyh(1, :) * xyh(2, :) - 2 * xyh(2, :)**2
        call cloud%derivatives(sph_scalars(square), 0.0_sph_real, jet, not_ok, status)
        i = side * side / 2 + side / 2
        call expect('derivatives of a quadratic function', not_ok == 0 .and. &
                    all(abs(jet(3:5, i) - [2, 3, -4]) < 1e-9_sph_real) .and. &
                    abs(jet(1, i) - 2 * xyh(1, i) - 3 * xyh(2, i)) < 1e-9_sph_real .and. &
                    abs(jet(2, i) - 3 * xyh(1, i) + 4 * xyh(2, i)) < 1e-9_sph_real)

        allocate (row(size(cloud%index)))
        call cloud%rows_msph(sph_scalars(volume), .false., row, diagonal, not_ok)
        call cloud%apply(row, diagonal, sph_scalars(f), Lu, not_ok)
        call expect('M-SPH of a linear function', not_ok == 0 .and. all(abs(Lu) < 1e-10_sph_real))

        call cloud%rows_msph(sph_scalars(volume), .true., row, diagonal, not_ok, status)
        call expect('it falls back in corners only', not_ok <= 4 .and. &
                    count(status == SPH_FELL_BACK) == not_ok)
        square = xyh(1, :)**2 + xyh(2, :)**2
        call cloud%apply(row, diagonal, sph_scalars(square), Lu, not_ok)
        call expect('M-SPH of |x|^2', not_ok == 0 .and. &
                    all(status == SPH_FELL_BACK .or. abs(Lu - 4 * volume) < 1e-10_sph_real))

        call cloud%density(sph_scalars(V), rho(1::2), not_ok)
        call cloud%laplacian_brookshaw(sph_scalars(rho(1::2)), rho(2::2), not_ok)
        call expect('density and Laplacian in place', not_ok == 0 .and. all(abs(rho(2::2)) > 0))

        ! by its C name: the h that belongs to the density
        radius = 4 * h
        adapted = h
        call cloud%find_lists(not_ok, radius=sph_scalars(radius))
        options%list_radius = sph_scalars(radius)
        options%tolerance = 1e-10_sph_real
        out%h = sph_address(adapted)
        out%rho = sph_address(Lu)
        not_ok = sph_density_adaptive(cloud%kernel, cloud%dim, cloud%view, sph_scalars(V), options, out)
        eta = sph_kernel_h_over_dx(cloud%kernel)
        call expect('adaptive density', not_ok == 0 .and. &
                    all(abs(adapted / (eta * sqrt(V / Lu)) - 1) < 1e-8_sph_real))

        start = cloud%start
        index = cloud%index
        call cloud%density(sph_scalars(V), rho(1::2), not_ok)
        call cloud%use_lists(start, index)
        call cloud%density(sph_scalars(V), rho(2::2), not_ok)
        call expect('lists of the host', not_ok == 0 .and. all(abs(rho(1::2) - rho(2::2)) < tiny_error))
        call cloud%check(not_ok)
        index(2) = n
        call cloud%use_lists(start, index)
        call cloud%density(sph_scalars(V), rho(2::2), not_ok)
        call expect('what is set anew is scanned again', not_ok == SPH_ERROR_LIST)
        call cloud%find_lists(not_ok, SPH_LARGER)
        call cloud%examine(not_ok, pairs=.true.)
        call expect('a healthy cloud', not_ok == 0)
        call cloud%find_lists(not_ok, radius=sph_scalars(h))
        open (newunit=i, status='scratch', action='readwrite')
        call cloud%examine(not_ok, unit=i)
        close (i)
        call expect('a sick cloud', not_ok > 0)
    end subroutine

    ! scalars in a loop over pairs, and how they belong together
    subroutine kernels()
        real(sph_real) :: sum_w(n), r(3), w(3), slope(3), step
        integer(c_int) :: k, dim
        call make(SPH_GATHER)
        do concurrent (i = 1:n)
            sum_w(i) = sum_of_w(i)
        end do
        call cloud%density(sph_scalars(V), rho(:n), not_ok)
        call expect('W in do concurrent', not_ok == 0 .and. all(abs(sum_w / rho(:n) - 1) < tiny_error))
        step = 1e-6_sph_real
        do k = 0, SPH_KERNEL_COUNT - 1
            do dim = 1, 3
                r = [0.41_sph_real, 0.83_sph_real, 1.37_sph_real] * h
                do i = 1, 3
                    w(i) = (sph_kernel_w(k, dim, r(i) + step * h, h) - &
                            sph_kernel_w(k, dim, r(i) - step * h, h)) / (2 * step * h)
                    slope(i) = (sph_kernel_dwdr(k, dim, r(i) + step * h, h) - &
                                sph_kernel_dwdr(k, dim, r(i) - step * h, h)) / (2 * step * h)
                end do
                call expect('F of '//sph_kernel_name(k), all(abs(w - &
                    [(r(i) * sph_kernel_f(k, dim, r(i), h), i=1, 3)]) < 1e-7_sph_real / h**(dim + 1)))
                call expect('d2W of '//sph_kernel_name(k), all(abs(slope - &
                    [(sph_kernel_d2wdr2(k, dim, r(i), h), i=1, 3)]) < 1e-7_sph_real / h**(dim + 2)))
            end do
            call expect('a name and back', sph_kernel_from_name(sph_kernel_name(k)) == k)
        end do
        r = [0.0_sph_real, h, 3 * h]
        call sph_kernel_wf('wendland-c2', 2, r, h, w, slope, not_ok)
        call expect('W of an array', not_ok == 0 .and. all(abs(w - &
            [(sph_kernel_w(SPH_WENDLAND_C2, 2, r(i), h), i=1, 3)]) < tiny_error * w(1)))
    end subroutine

    pure function sum_of_w(i) result(total)
        integer, intent(in) :: i
        real(sph_real) :: total
        integer :: p, j
        real(sph_real) :: r
        total = V(i) * sph_kernel_w(SPH_WENDLAND_C2, 2, 0.0_sph_real, xyh(3, i))
        do p = cloud%start(i) + 1, cloud%start(i + 1)
            j = cloud%index(p) + 1
            r = hypot(xyh(1, i) - xyh(1, j), xyh(2, i) - xyh(2, j))
            total = total + V(j) * sph_kernel_w(SPH_WENDLAND_C2, 2, r, xyh(3, i))
        end do
    end function

    subroutine refusals()
        character(:), allocatable :: text
        call cloud%init('no-kernel', n, sph_scalars(h), sph_scalars(V), sph_scalars(xyh(1, :)), not_ok=not_ok)
        call expect('no such kernel', not_ok == SPH_ERROR_KERNEL)
        call make(SPH_GATHER)
        xyh(3, 18) = -1
        call cloud%density(sph_scalars(V), rho(:n), not_ok)
        text = sph_error_text(not_ok)
        call expect('a bad h: '//text, not_ok == SPH_ERROR_H .and. index(text, 'h: ') == 1 .and. &
                    index(text, 'first at particle 18') > 0)
        xyh(3, 18) = h
        call cloud%density(sph_scalars(), rho(:n), not_ok)
        call expect('nothing given', not_ok == SPH_ERROR_NULL)
        call cloud%find_lists(not_ok, 17_c_int)
        call expect('no such criterion', not_ok == SPH_ERROR_VALUE)
        call expect('a status in words', len(sph_status_text(int(SPH_TOO_FEW))) > 5)
        call expect('a finding in words', len(sph_finding_text(int(SPH_FINDING_BOX))) > 5)
    end subroutine

    subroutine nothing()
        real(sph_real), target :: none(0), out(0)
        call cloud%init('cubic-spline', 0, sph_scalars(none), sph_scalars(none), sph_scalars(none), &
                        sph_scalars(none), sph_scalars(none), not_ok)
        if (not_ok == 0) call cloud%find_lists(not_ok)
        call expect('an empty cloud', not_ok == 0 .and. size(cloud%start) == 1 .and. size(cloud%index) == 0)
        call cloud%check(not_ok)
        if (not_ok == 0) call cloud%density(sph_scalars(none), out, not_ok)
        call expect('its density', not_ok == 0 .and. all(cloud%start == 0))
    end subroutine

    ! the search in parts, and orders
    subroutine searches()
        type(sph_neighbors) :: found
        type(sph_grid) :: grid
        type(sph_query) :: query
        integer(c_int64_t), allocatable, target :: work(:)
        integer(c_int64_t) :: pairs, counted
        integer(c_size_t) :: bytes
        integer(sph_index) :: start(n + 1), rows(n + 1), inverse(n)
        integer(sph_index), allocatable :: index(:)
        integer(sph_index), pointer :: permutation(:)
        real(sph_real), target :: reach, ordered(n)
        type(sph_points) :: moved
        type(sph_part) :: part
        integer(c_int64_t) :: key(n)
        call make(SPH_GATHER)
        associate (points => cloud%view%points)
            reach = 3 * h
            bytes = sph_grid_workspace(2, int(n, sph_index))
            allocate (work(bytes / 8 + 1))
            not_ok = sph_grid_build(2, points, sph_scalars(reach), c_loc(work), bytes, grid)
            call expect('a grid', not_ok == 0 .and. grid%n == n)
            query%targets = points
            query%criterion = SPH_GATHER
            query%radius = sph_scalars(reach)
            not_ok = sph_grid_count(2, grid, query, rows, counted)
            allocate (index(counted))
            not_ok = not_ok + sph_grid_lists(2, grid, query, start, index, size(index, kind=c_int64_t), pairs)
            call expect('lists of a grid', not_ok == 0 .and. pairs == counted .and. all(start == rows))
            call cloud%find_lists(not_ok, radius=sph_scalars(reach))
            call expect('are those of the search', not_ok == 0 .and. all(cloud%start == start))
            not_ok = sph_search(2, points, sph_scalars(reach), SPH_GATHER, c_null_ptr, 0_c_size_t, found)
            call expect('a search without memory', not_ok == SPH_ERROR_CAPACITY .and. found%pairs > 0)

            call c_f_pointer(sph_grid_permutation(grid), permutation, [n])
            not_ok = sph_permute_inverse(int(n, sph_index), permutation, inverse)
            call expect('an inverse', not_ok == 0 .and. all(inverse(permutation + 1) == [(i, i=0, n - 1)]))
            not_ok = sph_permute(int(n, sph_index), permutation, f, 1_c_size_t, ordered)
            call expect('an order', not_ok == 0 .and. all(abs(ordered - f(permutation + 1)) < tiny_error))
            not_ok = sph_grid_renumber(grid)
            call expect('a grid in that order', not_ok == 0 .and. all(permutation == [(i, i=0, n - 1)]))
            not_ok = sph_grid_permutation_own(grid, int(n, sph_index), inverse)
            call expect('own particles in that order', not_ok == 0 .and. all(inverse == permutation))
            not_ok = sph_grid_renumber_own(grid, int(n, sph_index))
            call expect('and their numbers', not_ok == 0 .and. all(permutation == [(i, i=0, n - 1)]))
            not_ok = sph_part_of(2, points, sph_scalars(reach), part)
            call expect('a part', not_ok == 0 .and. part%reach_low%x < part%low%x)
            not_ok = sph_select_near(2, points, sph_scalars(reach), SPH_GATHER, part, inverse, counted)
            call expect('is near itself', not_ok == 0 .and. counted == n)
            key = [(n - i, i=1, n)]
            not_ok = sph_list_sort(int(n, sph_index), int(n, sph_index), start, index, key)
            call expect('rows by falling numbers', not_ok == 0 .and. index(1) > index(2))
            not_ok = sph_list_prune(int(n, sph_index), int(n, sph_index), start, index, inverse, counted)
            call expect('of which all stay', not_ok == 0 .and. counted == n)
            moved = points
            call expect('nothing has moved', sph_rebuild_due(2, points, moved, 0.1_sph_real * h) == 0)
            moved%x = c_loc(f)
            moved%stride = 1
            moved%y = c_loc(f)
            call expect('all has moved', sph_rebuild_due(2, points, moved, 0.1_sph_real * h) == 1)
        end associate
    end subroutine
end program
