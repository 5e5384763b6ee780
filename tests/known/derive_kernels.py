# SPDX-License-Identifier: MIT
"""Reference values of the SPH kernels, derived from their definitions alone.

    python3 tests/known/derive_kernels.py > tests/known/kernels.csv
    python3 tests/known/derive_kernels.py --sigma       the normalisations
    python3 tests/known/derive_kernels.py --check FILE  exit 1 if FILE differs

A kernel of smoothing length h in dim dimensions is

    W(r, h) = sigma / h^dim * w(q),   q = r / h,   W = 0 for q >= support,
    sigma = 1 / (S_dim * integral_0^support w(q) q^(dim-1) dq),
    S_1 = 2, S_2 = 2 pi, S_3 = 4 pi.

Nothing here shares code with the library: polynomials are handled in exact
rational arithmetic, and only the last step (multiplying by pi, erf(3),
exp(-q^2), sqrt(2)) is done in decimal, with far more digits than are printed.
Every run first checks itself against published constants and closed forms,
and raises if one of them fails.
"""

import sys
from decimal import Decimal, getcontext
from fractions import Fraction
from math import pi as FLOAT_PI

getcontext().prec = 90
DIGITS = 30        # significant digits in the CSV
SIGMA_DIGITS = 25  # significant digits printed by --sigma
DIMS = (1, 2, 3)


# --- constants -------------------------------------------------------------

def decimal(x):
    """A Fraction (or int, or Decimal) as a Decimal of full working precision."""
    if isinstance(x, Fraction):
        return Decimal(x.numerator) / Decimal(x.denominator)
    return Decimal(x)


def arctan_inverse(n):
    """arctan(1/n) by its Taylor series."""
    tiny = Decimal(10) ** -(getcontext().prec + 5)
    power = Decimal(1) / n
    total, k = Decimal(0), 0
    while power > tiny:
        total += (-1) ** k * power / (2 * k + 1)
        power /= n * n
        k += 1
    return total


PI = 16 * arctan_inverse(5) - 4 * arctan_inverse(239)  # Machin's formula
SQRT2 = Decimal(2).sqrt()
EXP_M9 = Decimal(-9).exp()


def sqrt_pi_erf(z):
    """sqrt(pi) erf(z) = 2 exp(-z^2) sum_n 2^n z^(2n+1) / (2n+1)!!.

    All terms of this series are positive, so no digits cancel.
    """
    z = Decimal(z)
    tiny = Decimal(10) ** -(getcontext().prec + 5)
    term, total, n = z, Decimal(0), 0
    while term > tiny:
        total += term
        n += 1
        term *= 2 * z * z / (2 * n + 1)
    return 2 * (-z * z).exp() * total


SQRT_PI_ERF3 = sqrt_pi_erf(3)


# --- polynomials -----------------------------------------------------------

class Poly:
    """Polynomial in q with Fraction coefficients, lowest power first."""

    def __init__(self, coefficients):
        c = [Fraction(a) for a in coefficients]
        while len(c) > 1 and c[-1] == 0:
            c.pop()
        self.c = c

    @staticmethod
    def of(a):
        return a if isinstance(a, Poly) else Poly([a])

    def __add__(self, other):
        a, b = self.c, Poly.of(other).c
        n = max(len(a), len(b))
        a, b = a + [0] * (n - len(a)), b + [0] * (n - len(b))
        return Poly([s + t for s, t in zip(a, b)])

    def __mul__(self, other):
        b = Poly.of(other).c
        product = [Fraction(0)] * (len(self.c) + len(b) - 1)
        for i, s in enumerate(self.c):
            for j, t in enumerate(b):
                product[i + j] += s * t
        return Poly(product)

    def __pow__(self, n):
        result = Poly([1])
        for _ in range(n):
            result = result * self
        return result

    def __truediv__(self, number):
        return self * (1 / Fraction(number))

    def __neg__(self):
        return self * -1

    def __sub__(self, other):
        return self + -Poly.of(other)

    def __rsub__(self, other):
        return Poly.of(other) - self

    __radd__ = __add__
    __rmul__ = __mul__

    def __eq__(self, other):
        return self.c == Poly.of(other).c

    def __call__(self, q):
        value = Fraction(0)
        for a in reversed(self.c):
            value = value * q + a
        return value

    def derivative(self):
        return Poly([k * a for k, a in enumerate(self.c)][1:] or [0])

    def antiderivative(self):
        return Poly([0] + [a / (k + 1) for k, a in enumerate(self.c)])

    def integral(self, lo, hi):
        primitive = self.antiderivative()
        return primitive(hi) - primitive(lo)


# --- text of exact numbers -------------------------------------------------

def quotient_text(value, root="", pi=False):
    """'10/(7 pi)', '1/pi', '2/3', '3 sqrt2/8': value, times root, over pi."""
    top = [str(value.numerator)] if value.numerator != 1 or not root else []
    top = " ".join(top + ([root] if root else []))
    bottom = [str(value.denominator)] if value.denominator != 1 else []
    bottom += ["pi"] if pi else []
    if not bottom:
        return top
    joined = " ".join(bottom)
    return top + "/" + (joined if len(bottom) == 1 else "(" + joined + ")")


def sum_text(terms):
    """'1 + 8 exp(-9)' from [(1, ''), (8, 'exp(-9)')]; zero terms drop out."""
    text = ""
    for factor, name in terms:
        if factor == 0:
            continue
        size = abs(factor)
        body = name if size == 1 and name else (str(size) + " " + name).strip()
        if text:
            text += (" - " if factor < 0 else " + ") + body
        else:
            text = ("-" if factor < 0 else "") + body
    return text


# --- the three families of kernels -----------------------------------------
#
# Each class offers
#   support
#   slope_at_origin    w'(0), None where it is infinite
#   derivatives(q)     (w, w', w'') and one Decimal factor common to them;
#                      keeping the factor apart lets exact zeros stay exact
#   sigma(dim)         (closed form as text, Decimal)

SPHERE = {1: Fraction(2), 2: Fraction(2), 3: Fraction(4)}  # S_dim without pi


def with_pi(dim, value):
    """Put back the pi which SPHERE leaves out."""
    return value if dim == 1 else value * PI


class Piecewise:
    """Piecewise polynomial: [(end of piece, Poly), ...], starting at q = 0."""

    def __init__(self, *pieces):
        self.pieces = [(Fraction(end), Poly.of(p)) for end, p in pieces]
        self.support = self.pieces[-1][0]
        self.slope_at_origin = self.pieces[0][1].derivative()(0)

    def intervals(self):
        lo = Fraction(0)
        for hi, poly in self.pieces:
            yield lo, hi, poly
            lo = hi

    def moment(self, n):
        """integral_0^support w(q) q^n dq, exactly."""
        return sum((p * q**n).integral(lo, hi) for lo, hi, p in self.intervals())

    def derivatives(self, at):
        # At an interior knot this picks the piece to the right.
        poly = next(p for end, p in self.pieces if at < end)
        first = poly.derivative()
        return (poly(at), first(at), first.derivative()(at)), Decimal(1)

    def sigma(self, dim):
        value = 1 / (SPHERE[dim] * self.moment(dim - 1))
        number = decimal(value) if dim == 1 else decimal(value) / PI
        return quotient_text(value, pi=dim > 1), number


class Gaussian:
    """Polynomial times exp(-q^2), truncated at q = 3.

    Its moments are combinations a + b exp(-9) + c sqrt(pi) erf(3) with
    rational a, b, c, from integrating by parts:
        I_0 = sqrt(pi) erf(3) / 2,  I_1 = (1 - exp(-9)) / 2,
        I_n = (n-1)/2 I_(n-2) - 3^(n-1)/2 exp(-9).
    """

    support = Fraction(3)

    def __init__(self, poly):
        self.w = Poly.of(poly)
        self.dw = self.slope(self.w)
        self.d2w = self.slope(self.dw)
        self.slope_at_origin = self.dw(0)

    @staticmethod
    def slope(poly):
        """p' - 2 q p, the polynomial in front of exp(-q^2) after one d/dq."""
        return poly.derivative() - 2 * q * poly

    @staticmethod
    def power_moment(n):
        half = Fraction(1, 2)
        if n == 0:
            return (Fraction(0), Fraction(0), half)
        if n == 1:
            return (half, -half, Fraction(0))
        a, b, c = (half * (n - 1) * m for m in Gaussian.power_moment(n - 2))
        return (a, b - half * 3 ** (n - 1), c)

    def moment(self, n):
        """(a, b, c) of integral_0^3 w(q) q^n dq."""
        total = [Fraction(0)] * 3
        for k, coefficient in enumerate(self.w.c):
            for i, m in enumerate(self.power_moment(n + k)):
                total[i] += coefficient * m
        return total

    def derivatives(self, at):
        return (self.w(at), self.dw(at), self.d2w(at)), decimal(-at * at).exp()

    def sigma(self, dim):
        a, b, c = (SPHERE[dim] * m for m in self.moment(dim - 1))
        total = decimal(a) + decimal(b) * EXP_M9 + decimal(c) * SQRT_PI_ERF3
        text = sum_text([(c, "sqrt(pi) erf(3)"), (a, ""), (b, "exp(-9)")])
        text = text if dim == 1 else "pi (" + text + ")"
        return "1/(" + text + ")", 1 / with_pi(dim, total)


class SquareRoot:
    """sqrt(2) - sqrt(q).  With q = s^2 its moments are polynomial in s:

    integral_0^sqrt2 (sqrt2 - s) s^(2n) 2 s ds
        = 2 sqrt2^(2n+3) (1/(2n+2) - 1/(2n+3)) = rational * sqrt2.
    """

    support = Fraction(2)
    slope_at_origin = None

    def moment(self, n):
        """The integral of w(q) q^n, divided by sqrt2."""
        return 2 * Fraction(2) ** (n + 1) / ((2 * n + 2) * (2 * n + 3))

    def derivatives(self, at):
        s = decimal(at).sqrt()
        return (SQRT2 - s, -1 / (2 * s), 1 / (4 * s**3)), Decimal(1)

    def sigma(self, dim):
        # 1/(m sqrt2) = sqrt2/(2 m)
        value = 1 / (2 * SPHERE[dim] * self.moment(dim - 1))
        number = decimal(value) * SQRT2
        return (quotient_text(value, root="sqrt2", pi=dim > 1),
                number if dim == 1 else number / PI)


# --- building blocks of the definitions ------------------------------------

q = Poly([0, 1])
x = q / 2  # many kernels are published on the unit support
HALF, THIRD = Fraction(1, 2), Fraction(1, 3)


def truncated_powers(power, *terms):
    """Sum of factor * max(knot - q, 0)^power over the terms (factor, knot)."""
    def sum_beyond(end):
        return sum(((f * (k - q) ** power) for f, k in terms if k >= end), Poly([0]))
    knots = sorted(Fraction(k) for _, k in terms)
    return Piecewise(*((end, sum_beyond(end)) for end in knots))


def convexified(w):
    """K(q) = integral_q^support w(s) ds, divided by K(0)."""
    beyond, pieces = Fraction(0), []  # beyond: the integral past this piece
    for lo, hi, poly in reversed(list(w.intervals())):
        primitive = poly.antiderivative()
        pieces.insert(0, (hi, beyond + primitive(hi) - primitive))
        beyond += poly.integral(lo, hi)
    return Piecewise(*((end, p / beyond) for end, p in pieces))


def core_triangle(a):
    """Linear core up to x = a, the cubic spline beyond (Read et al. 2010)."""
    return Piecewise((2 * a, (-12 * a + 18 * a**2) * x + 1 + 6 * a**2 - 12 * a**3),
                     (1, 1 - 6 * x**2 + 6 * x**3),
                     (2, 2 * (1 - x) ** 3))


# --- the kernels -----------------------------------------------------------

CUBIC = Piecewise((1, 1 - 3 * q**2 / 2 + 3 * q**3 / 4), (2, (2 - q) ** 3 / 4))
WENDLAND_C2 = Piecewise((2, (1 - x) ** 4 * (1 + 4 * x)))
WENDLAND_C4 = Piecewise((2, (1 - x) ** 6 * (1 + 6 * x + 35 * x**2 / 3)))

# name, and the kernel as a function of dim (only super-gaussian depends on it)
KERNELS = [
    ("cubic-spline", lambda dim: CUBIC),
    ("quartic-spline", lambda dim: truncated_powers(4, (1, 5 * HALF), (-5, 3 * HALF), (10, HALF))),
    ("quintic-spline", lambda dim: truncated_powers(5, (1, 3), (-6, 2), (15, 1))),
    ("wendland-c2", lambda dim: WENDLAND_C2),
    ("wendland-c4", lambda dim: WENDLAND_C4),
    ("wendland-c6", lambda dim: Piecewise((2, (1 - x) ** 8 * (1 + 8 * x + 25 * x**2 + 32 * x**3)))),
    ("wendland-c2-1d", lambda dim: Piecewise((2, (1 - x) ** 3 * (1 + 3 * x)))),
    ("wendland-c4-1d", lambda dim: Piecewise((2, (1 - x) ** 5 * (1 + 5 * x + 8 * x**2)))),
    ("wendland-c6-1d", lambda dim: Piecewise((2, (1 - x) ** 7 * (1 + 7 * x + 19 * x**2 + 21 * x**3)))),
    ("gaussian", lambda dim: Gaussian(1)),
    ("super-gaussian", lambda dim: Gaussian(dim * HALF + 1 - q**2)),
    ("liu-quartic", lambda dim: Piecewise((2, 2 * THIRD - 9 * q**2 / 8 + 19 * q**3 / 24 - 5 * q**4 / 32))),
    ("hermite", lambda dim: Piecewise((2, (2 - q) ** 2 * (q + 1)))),
    ("schuessler-schmitt", lambda dim: SquareRoot()),
    ("johnson-beissel", lambda dim: Piecewise((2, (1 - x) ** 2))),
    ("convex", lambda dim: Piecewise((2, (2 - q) ** 3 * (q / 2 + 1)))),
    ("convex-cubic-spline", lambda dim: convexified(CUBIC)),
    ("convex-wendland-c2", lambda dim: convexified(WENDLAND_C2)),
    ("convex-wendland-c4", lambda dim: convexified(WENDLAND_C4)),
    ("core-triangle", lambda dim: core_triangle(THIRD)),
    ("sextic-spline", lambda dim: truncated_powers(6, (1, 7 * HALF), (-7, 5 * HALF), (21, 3 * HALF), (-35, HALF))),
    ("heptic-spline", lambda dim: truncated_powers(7, (1, 4), (-8, 3), (28, 2), (-56, 1))),
    ("poly6", lambda dim: Piecewise((2, (1 - x**2) ** 3))),
    ("spiky", lambda dim: Piecewise((2, (1 - x) ** 3))),
]


# --- self-checks -----------------------------------------------------------

# Constants as printed in the literature, converted to this file's q = r/h.
PUBLISHED_SIGMA = {
    "cubic-spline": ("2/3", "10/(7 pi)", "1/pi"),
    "quartic-spline": ("1/24", "96/(1199 pi)", "1/(20 pi)"),
    "quintic-spline": ("1/120", "7/(478 pi)", "1/(120 pi)"),
    "wendland-c2": (None, "7/(4 pi)", "21/(16 pi)"),
    "wendland-c4": (None, "9/(4 pi)", "495/(256 pi)"),
    "wendland-c6": (None, "39/(14 pi)", "1365/(512 pi)"),
    "wendland-c2-1d": ("5/8", "5/(4 pi)", "105/(128 pi)"),
    "wendland-c4-1d": ("3/4", None, None),
    "wendland-c6-1d": ("55/64", None, None),
    "gaussian": ("1/(sqrt(pi) erf(3))", "1/(pi (1 - exp(-9)))", None),
    "liu-quartic": ("1", "15/(7 pi)", "315/(208 pi)"),
    "convex": ("5/48", "15/(64 pi)", "21/(128 pi)"),
    "convex-cubic-spline": ("15/14", "3/pi", "315/(124 pi)"),
    "sextic-spline": ("1/720", "256/(113149 pi)", "1/(840 pi)"),
    "heptic-spline": ("1/5040", "9/(29740 pi)", "1/(6720 pi)"),
    "poly6": (None, "1/pi", "315/(512 pi)"),
    "spiky": (None, "5/(2 pi)", "15/(8 pi)"),
}

SLOPED_AT_ORIGIN = {"schuessler-schmitt", "johnson-beissel", "convex",
                    "convex-cubic-spline", "convex-wendland-c2",
                    "convex-wendland-c4", "core-triangle", "spiky"}


def require(truth, what):
    if not truth:
        raise ValueError("self-check failed: " + what)


def check_constants():
    # A second arctangent formula (Stormer's) guards against a slip in the first.
    stormer = (176 * arctan_inverse(57) + 28 * arctan_inverse(239)
               - 48 * arctan_inverse(682) + 96 * arctan_inverse(12943))
    require(abs(stormer - PI) < Decimal("1e-80"), "pi")
    erf3 = SQRT_PI_ERF3 / PI.sqrt()
    require(str(erf3).startswith("0.9999779095030014145586272238704"), "erf(3)")


def check_closed_forms():
    def pieces(kernel):
        return [p for _, p in kernel.pieces]
    require(pieces(convexified(CUBIC)) ==
            [1 - 4 * q / 3 + 2 * q**3 / 3 - q**4 / 4, (2 - q) ** 4 / 12],
            "closed form of convex-cubic-spline")
    require(pieces(convexified(WENDLAND_C2)) == [(1 - x) ** 5 * (1 + 2 * x)],
            "closed form of convex-wendland-c2")
    require(pieces(convexified(WENDLAND_C4)) ==
            [(1 - x) ** 7 * (1 + 29 * x / 8 + 35 * x**2 / 8)],
            "closed form of convex-wendland-c4")
    m4 = truncated_powers(3, (1, 2), (-4, 1))
    require([p / 4 for p in pieces(m4)] == pieces(CUBIC), "M4 as truncated powers")


def check_convex_moments(name, base):
    """By parts: moment_n(K) = moment_(n+1)(w) / ((n+1) moment_0(w))."""
    for n in range(3):
        require(convexified(base).moment(n) ==
                base.moment(n + 1) / ((n + 1) * base.moment(0)),
                "moment of " + name)


def check_normalisation(name, dim, kernel):
    """sigma against Simpson's rule in floating point, in t = sqrt(q)."""
    n = 240
    step = float(kernel.support) ** 0.5 / n

    def integrand(i):
        t = i * step
        # An end point would be past the cut-off: take the inside limit there.
        at = kernel.support if i == n else Fraction(round(t * t * 2**40), 2**40)
        return value_inside(kernel, at) * 2.0 * t ** (2 * dim - 1)

    total = sum((4 if i % 2 else 2) * integrand(i) for i in range(1, n))
    total += integrand(n)  # the integrand is 0 at the other end, t = 0
    sphere = {1: 2.0, 2: 2.0 * FLOAT_PI, 3: 4.0 * FLOAT_PI}[dim]
    error = total * step / 3.0 * sphere * float(kernel.sigma(dim)[1]) - 1.0
    require(abs(error) < 1e-5, "normalisation of %s in %d-D" % (name, dim))


def value_inside(kernel, at):
    """w as a float; only the truncated Gaussians do not reach 0 at the end."""
    if at == kernel.support and not isinstance(kernel, Gaussian):
        return 0.0
    values, factor = kernel.derivatives(at)
    return float(values[0]) * float(factor)


def check_continuity(name, kernel):
    """w, w' and w'' join at every interior knot, and w vanishes at the end."""
    if not isinstance(kernel, Piecewise):
        return
    for (knot, left), (_, right) in zip(kernel.pieces, kernel.pieces[1:]):
        for _ in range(3):
            require(left(knot) == right(knot), "continuity of " + name)
            left, right = left.derivative(), right.derivative()
    require(kernel.pieces[-1][1](kernel.support) == 0, "end of " + name)


def check_kernels():
    for name, make in KERNELS:
        for dim in DIMS:
            kernel = make(dim)
            check_continuity(name, kernel)
            check_normalisation(name, dim, kernel)
            require((kernel.slope_at_origin != 0) == (name in SLOPED_AT_ORIGIN),
                    "slope at the origin of " + name)
            known = PUBLISHED_SIGMA.get(name, (None,) * 3)[dim - 1]
            require(known in (None, kernel.sigma(dim)[0]),
                    "published sigma of %s in %d-D" % (name, dim))


def check_everything():
    check_constants()
    check_closed_forms()
    check_convex_moments("convex-cubic-spline", CUBIC)
    check_convex_moments("convex-wendland-c2", WENDLAND_C2)
    check_convex_moments("convex-wendland-c4", WENDLAND_C4)
    check_kernels()


# --- output ----------------------------------------------------------------

HEADER = """\
# Reference values of the SPH kernels, generated, not edited:
#   python3 tests/known/derive_kernels.py > tests/known/kernels.csv
# W = sigma / h^dim * w(r/h);  F = (1/r) dW/dr;  dWdh = -(dim W + r dW/dr) / h.
# h and r are exact (and exactly representable in binary32); all other columns
# are rounded to 30 significant digits, exact zeros being written as 0.
# r/h >= support: W, dWdr, F, d2Wdr2 and dWdh are 0, also on the edge itself.
# r = 0: dWdr = 0 and F is its finite limit where the slope vanishes at the
#   origin. Where it does not (johnson-beissel, convex, convex-*, spiky,
#   core-triangle) dWdr and F are 0 by convention and d2Wdr2 is the limit from
#   r > 0; schuessler-schmitt, whose slope is infinite there, has no such row.
# Interior knots: W and its first two derivatives are continuous.
kernel,dim,h,r,sigma,W,dWdr,F,d2Wdr2,dWdh"""

# Values of q for the rows with h = 1, and for those with h = 0.75.
Q_UNIT_H = [Fraction(n, 16) for n in
            (0, 1, 4, 8, 12, 16, 18, 24, 28, 31, 32, 36, 40, 44, 47, 48, 52,
             55, 56, 60, 63, 64, 68)]
Q_OTHER_H = [Fraction(n, 8) for n in (1, 5, 10, 15, 19, 23, 27, 31)]


def points(kernel):
    """(h, q) of the rows of one kernel."""
    reach = kernel.support + Fraction(1, 4)
    rows = [(Fraction(1), at) for at in Q_UNIT_H if at <= reach]
    rows += [(Fraction(3, 4), at) for at in Q_OTHER_H if at < kernel.support]
    if kernel.slope_at_origin is None:
        rows = [(h, at) for h, at in rows if at > 0]
    return rows


def scientific(value, digits):
    """'1.234e-01' with the given number of significant digits; exact zero '0'."""
    if value == 0:
        return "0"
    # A wreck of two cancelling numbers would show up as a tiny leftover.
    require(abs(value) > Decimal("1e-40"), "cancellation in an output value")
    mantissa, exponent = "{:.{}e}".format(value, digits - 1).split("e")
    return "%se%+03d" % (mantissa, int(exponent))


def short(value):
    """An exact decimal of a dyadic fraction, without trailing zeros."""
    text = "{:f}".format(decimal(value))
    return text.rstrip("0").rstrip(".") if "." in text else text


def columns(kernel, dim, h, at):
    """[W, dWdr, F, d2Wdr2, dWdh] at q = at, as Decimals."""
    if at >= kernel.support:
        return [Decimal(0)] * 5
    (w, dw, d2w), factor = kernel.derivatives(at)
    if isinstance(w, Decimal):  # otherwise stay exact, so that 0 is exactly 0
        at = decimal(at)
    if at > 0:
        f = dw / at
    elif kernel.slope_at_origin == 0:
        f = d2w
    else:
        dw = f = Fraction(0)
    spread = -(dim * w + at * dw)
    scale = kernel.sigma(dim)[1] * factor / decimal(h) ** dim
    h = decimal(h)
    return [scale * decimal(w),
            scale * decimal(dw) / h,
            scale * decimal(f) / h**2,
            scale * decimal(d2w) / h**2,
            scale * decimal(spread) / h]


def csv_text():
    lines = [HEADER]
    for name, make in KERNELS:
        for dim in DIMS:
            kernel = make(dim)
            sigma = kernel.sigma(dim)[1]
            for h, at in points(kernel):
                numbers = [sigma] + columns(kernel, dim, h, at)
                lines.append(",".join([name, str(dim), short(h), short(h * at)]
                                      + [scientific(v, DIGITS) for v in numbers]))
    return "\n".join(lines) + "\n"


def sigma_text():
    lines = []
    for name, make in KERNELS:
        for dim in DIMS:
            text, number = make(dim).sigma(dim)
            lines.append("%-20s %d  %-40s %s" % (
                name, dim, text, scientific(number, SIGMA_DIGITS)))
    return "\n".join(lines) + "\n"


def same_as_file(path):
    with open(path, encoding="ascii") as file:
        found = file.read().splitlines()
    wanted = csv_text().splitlines()
    if found == wanted:
        return True
    pairs = enumerate(zip(found, wanted), 1)
    line = next((i for i, (a, b) in pairs if a != b),
                min(len(found), len(wanted)) + 1)
    print("%s:%d: differs from what the definitions give" % (path, line),
          file=sys.stderr)
    return False


def main(arguments):
    check_everything()
    if not arguments:
        sys.stdout.write(csv_text())
    elif arguments == ["--sigma"]:
        sys.stdout.write(sigma_text())
    elif len(arguments) == 2 and arguments[0] == "--check":
        return 0 if same_as_file(arguments[1]) else 1
    else:
        print("usage: derive_kernels.py [--sigma | --check FILE]", file=sys.stderr)
        return 2
    return 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
