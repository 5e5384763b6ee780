/* SPDX-License-Identifier: MIT
 *
 * sph_kernels.h - smoothing kernels of smoothed particle hydrodynamics (SPH), as functions of numbers.
 *
 * This is the lowest of three headers: sph_kernels.h (this one), sph_ops.h (operators) and sph.h (neighbour
 * search; it includes the other two). Nothing is allocated, nothing is global and nothing is printed. The
 * code is C99, C++11, OpenCL C 1.2 and CUDA at the same time.
 *
 *     double w  = sph_kernel_w(SPH_WENDLAND_C2, 3, r, h);         W(r, h)
 *     double f  = sph_kernel_f(SPH_WENDLAND_C2, 3, r, h);         F = (1/r) dW/dr, grad_i W = F (x_i - x_j)
 *
 * The file is a book of four chapters: kernels, cohesion and adhesion, gravity, names and texts. Each begins
 * with its mathematics and sources; then come its types and its functions, in the order of the index below.
 * Before the chapters stands what adapts the code to the compiler.
 *
 * CONVENTIONS, here and in the headers above
 *   x_ij = x_i - x_j and r = |x_ij|. Gradients are taken at x_i:
 *       grad_i W(|x_i - x_j|, h) = F x_ij  with  F = (1/r) dW/dr.
 *   h is the smoothing length. It is a length scale of the kernel, NOT the radius of its support: W = 0 for
 *   r >= sph_kernel_support_ratio(k) * h. This radius is 2 h for most kernels, n/2 h for a spline Mn, and 3 h
 *   for the Gaussians. A host whose "h" is the support radius, as in most codes of computer graphics,
 *   converts it once, by sph_kernel_h_from_support. What h is in other codes: chapter names and texts.
 *       W(r, h) = sigma / h^dim * w(q)  with  q = r / h.
 *   The integral of W over the space of dim dimensions is 1. sigma is exact (see sph_kernel_sigma).
 *   Exactly on the edge of the support, the rounding of r/h decides what is inside. This matters only for
 *   the functions that jump there: those of the Gaussians (W by less than 1e-3 W(0)), F of
 *   schuessler-schmitt, and d2W/dr2 of the kernels that sph_kernel_shape_d2 names.
 *   The unit of W is 1/length^dim, that of F is 1/length^(dim+2). dim is 1, 2 or 3.
 *   Kernel and dimension come first in every call. Pass them as constants: the call then becomes a few
 *   multiplications.
 *
 * INDEX   (k: kernel, dim: dimension)
 *   kernels
 *   SPH_KERNELS(each, context)                        the table of all kernels
 *   sph_kernel                                        which kernel
 *   SPH_SWITCH_KERNEL(k, CALL)                        turns a kernel of run time into a constant
 *   sph_wf                                            W and F
 *   sph_real  sph_kernel_support_ratio(k)             support radius / h
 *   sph_real  sph_kernel_h_over_dx(k)                 recommended h / particle spacing
 *   sph_real  sph_kernel_h_from_support(k, support)   the h of a kernel whose support has this radius
 *   sph_real  sph_kernel_support(k, h)                support radius
 *   sph_real  sph_kernel_sigma(k, dim)                normalisation
 *   sph_real  sph_kernel_shape(k, dim, q)             w(q) = W h^dim / sigma
 *   sph_real  sph_kernel_shape_f(k, dim, q)           (1/q) dw/dq
 *   sph_real  sph_kernel_shape_d2(k, dim, q)          d2w/dq2
 *   sph_real  sph_kernel_w(k, dim, r, h)              W
 *   sph_real  sph_kernel_f(k, dim, r, h)              F = (1/r) dW/dr. At r = 0: its limit where that is
 *                                                     finite, else 0
 *   sph_wf    sph_kernel_wf(k, dim, r, h)             W and F at once
 *   sph_real  sph_kernel_dwdr(k, dim, r, h)           dW/dr
 *   sph_real  sph_kernel_d2wdr2(k, dim, r, h)         d2W/dr2
 *   sph_real  sph_kernel_dwdh(k, dim, r, h)           dW/dh at fixed r
 *   int       sph_kernel_has_cusp(k)                  1 if the slope at the origin is not 0 (F = 0 there, by
 *                                                     convention)
 *   int       sph_kernel_may_convexify(k, dim)        1 if W >= 0 and W' <= 0, so that the integral of its
 *                                                     tail is a convex kernel
 *   cohesion and adhesion
 *   sph_real  sph_cohesion_kernel_akinci(r, support)  C(r): pushes apart below 0.27 support, pulls beyond it
 *   sph_real  sph_adhesion_kernel_akinci(r, support)  A(r): pulls towards a wall beyond half of the support
 *   gravity
 *   int       sph_kernel_has_gravity(k)               1 for the kernels that the following functions know
 *   sph_real  sph_gravity_shape_f(k, q)               h^3 (1/r) dphi/dr
 *   sph_real  sph_gravity_shape(k, q)                 h phi
 *   sph_real  sph_gravity_potential(k, r, h)          phi of a unit mass that is spread out like the kernel,
 *                                                     with G = 1 in 3D; it is -1/r beyond the support
 *   sph_real  sph_gravity_force(k, r, h)              (1/r) dphi/dr: the acceleration is -G m x_ij times it
 *   sph_real  sph_gravity_dphidh(k, r, h)             dphi/dh at fixed r
 *   names and texts   (the functions are not there in OpenCL)
 *   sph_error                                         what an array-level function answers
 *   sph_status                                        what it answers for each particle
 *   const char *sph_kernel_name(k)                    "wendland-c2"
 *   int       sph_kernel_from_name(name)              the kernel, or -1. It also knows aliases (m4, cubic,
 *                                                     w2, lucy, ...) and the names of other codes
 *   const char *sph_status_text(status)               the meaning of an error or status, in words
 *
 * OPTIONS (0 or 1 and no other number or word, unless a type or macro is asked for. Set them with -D, or
 * before the first inclusion of any of the headers. What is not allowed does not compile, nor does what has
 * changed since the first inclusion: the error names the option. Each source file of a program has options
 * of its own, so that one may be in float and another in double.)
 *   SPH_SINGLE      0, but 1 where double is no wider than float, as on AVR.
 *                   1: sph_real is float.
 *   SPH_SIMD        1 under OpenMP 4 or later, else 0.
 *                   1: the compiler obeys "omp simd". It needs -fopenmp, or -fopenmp-simd -DSPH_SIMD=1.
 *                   clang, and gcc from version 12 on, vectorise the sweeps without it.
 *   SPH_PURE_SQRT   1 on gcc and clang, else 0.
 *                   1: the compiler is told that sqrt has no side effect. sqrt then no longer sets errno in
 *                   the files that include this header. Without this option, or -fno-math-errno, no loop with
 *                   a square root vectorises.
 *   SPH_CHECK       1.
 *                   1: array-level functions scan positions, h, values and lists before they touch anything.
 *                   0: they check their arguments only.
 *   SPH_INDEX       int32_t (in OpenCL int). The type of particle indices and list indices: a signed integer
 *                   type of 2 to 8 bytes, such as int16_t or int64_t (in OpenCL short or long).
 *   SPH_ASSERT(x)   nothing. It is called with the precondition of each scalar function, which stands above
 *                   the function after "Needs". All functions need a kernel and a dimension that exist,
 *                   r >= 0, h > 0 and support > 0, where they take them. Define it as assert to find a fault
 *                   of the caller. A result that overflows is no such fault, and is infinite or NaN: that of
 *                   a kernel where 1 / h^(dim + 2) overflows, or where r/h is above 1e9. (The sweeps of
 *                   sph_ops.h report what is not finite.)
 *   SPH_REFUSED(argument, particle, error)
 *                   nothing. It is called where an array-level function refuses an argument, with the name
 *                   of the argument, the first particle at fault (-1: no particle) and the negative
 *                   sph_error. Define it to print them ("rho: a value is not finite and positive, first at
 *                   particle 17"), or to keep them.
 */
#ifndef SPH_KERNELS_H
#define SPH_KERNELS_H

#define SPH_VERSION_MAJOR 0
#define SPH_VERSION_MINOR 2
#define SPH_VERSION_PATCH 0
/* 10000 major + 100 minor + patch. The headers above refuse to be mixed with another release. */
#define SPH_VERSION 200

/* ================================================================ portability */

/* clang-format off */
#if defined(__OPENCL_VERSION__) || defined(__OPENCL_C_VERSION__)
#  define SPH_OPENCL 1
#  define SPH_GLOBAL __global
#else
#  define SPH_OPENCL 0
#  define SPH_GLOBAL
#  include <math.h>
#  include <stddef.h>
#  include <stdint.h>
#endif

/* 1 if an option is 0 or 1, else 0: also if it is another word, or empty. */
#define SPHI_PASTE(a, b) a##b
#define SPHI_IS_FLAG(option) SPHI_PASTE(SPHI_FLAG_, option)
#define SPHI_FLAG_0 1
#define SPHI_FLAG_1 1
/* The length of the text to which a macro expands. */
#define SPHI_LENGTH(text) SPHI_LENGTH_OF(text)
#define SPHI_LENGTH_OF(text) sizeof(#text)

#if defined(__SIZEOF_DOUBLE__) && __SIZEOF_DOUBLE__ < 8
#  define SPHI_SINGLE_ONLY 1
#else
#  define SPHI_SINGLE_ONLY 0
#endif
#ifndef SPH_SINGLE
#  define SPH_SINGLE SPHI_SINGLE_ONLY
#endif
#if !SPHI_IS_FLAG(SPH_SINGLE)
#  error "SPH_SINGLE must be 0 or 1"
#endif
#if SPHI_SINGLE_ONLY && !SPH_SINGLE
#  error "double is no wider than float here: SPH_SINGLE must be 1"
#endif
#ifndef SPH_CHECK
#  define SPH_CHECK 1
#endif
#if !SPHI_IS_FLAG(SPH_CHECK)
#  error "SPH_CHECK must be 0 or 1"
#endif
#ifndef SPH_ASSERT
#  define SPH_ASSERT(x) ((void)0)
#  define SPHI_NO_ASSERT
#endif
#ifndef SPH_REFUSED
#  define SPH_REFUSED(argument, particle, error) ((void)0)
#  define SPHI_NO_REFUSED
#endif
#ifndef SPH_INDEX
#  if SPH_OPENCL
#    define SPH_INDEX int
#  else
#    define SPH_INDEX int32_t
#  endif
#endif
#ifndef SPH_SIMD
#  if defined(_OPENMP) && _OPENMP >= 201307
#    define SPH_SIMD 1
#  else
#    define SPH_SIMD 0
#  endif
#endif
#if !SPHI_IS_FLAG(SPH_SIMD)
#  error "SPH_SIMD must be 0 or 1"
#endif
#if (defined(__GNUC__) || defined(__clang__)) && !SPH_OPENCL && !defined(__CUDACC__)
#  define SPHI_HAS_PURE_SQRT 1
#else
#  define SPHI_HAS_PURE_SQRT 0
#endif
#ifndef SPH_PURE_SQRT
#  define SPH_PURE_SQRT SPHI_HAS_PURE_SQRT
#endif
#if !SPHI_IS_FLAG(SPH_PURE_SQRT)
#  error "SPH_PURE_SQRT must be 0 or 1"
#endif
#if SPH_PURE_SQRT && !SPHI_HAS_PURE_SQRT
#  error "SPH_PURE_SQRT must be 0 here: only gcc and clang know how to declare it, in C and C++"
#endif

#if SPH_OPENCL
#  define SPHI_TEXT __constant const char
#else
#  define SPHI_TEXT const char
#endif

/* The last line of a struct of 12 bytes that functions return. tcc writes 16 bytes where it stores such a
   result, so that the variable beside it would be lost. */
#ifdef __TINYC__
#  define SPHI_TCC_PAD float sphi_unused;
#else
#  define SPHI_TCC_PAD
#endif

/* Functions are inlined by force. With a plain `static inline`, neither gcc nor clang folds the kernel and
   the dimension once a program uses several of them. */
#ifndef SPH_FN
#  if defined(__CUDACC__)
#    define SPH_FN static __host__ __device__ __forceinline__
#  elif defined(__GNUC__) || defined(__clang__)
#    define SPH_FN static inline __attribute__((always_inline, unused))
#  elif defined(_MSC_VER)
#    define SPH_FN static __forceinline
#  else
#    define SPH_FN static inline
#  endif
#endif
/* For functions that are long and called once a sweep at most, such as the scans of arguments: inlined, they
   would cost the compiler so much that it gives up on the loops that matter. Without optimisation they are
   marked inline all the same: nothing is inlined then, but gcc would keep a static function that is never
   called. */
#if defined(__CUDACC__)
#  define SPHI_LARGE static __host__ __device__ __noinline__
#elif SPH_OPENCL
#  define SPHI_LARGE SPH_FN
#elif (defined(__GNUC__) || defined(__clang__)) && defined(__OPTIMIZE__)
#  define SPHI_LARGE static __attribute__((unused, noinline))
#elif defined(__GNUC__) || defined(__clang__)
#  define SPHI_LARGE static inline __attribute__((unused))
#else
#  define SPHI_LARGE static
#endif
#ifndef SPH_RESTRICT
#  if defined(__GNUC__) || defined(__clang__) || defined(_MSC_VER)
#    define SPH_RESTRICT __restrict
#  else
#    define SPH_RESTRICT
#  endif
#endif

/* Loops over neighbours. Both are for (p = from; p < to; p++), where p is a variable of the caller's:
       SPH_SUM(p, from, to, a, b) { ... }   adds to a and b, in any order; at most 16 names
       SPH_EACH(p, from, to) { ... }        has passes that are independent of each other
   The body must not leave the loop, and must not read the sums. clang obeys its own pragma without a flag
   (and warns about omp simd at -Os). gcc knows no word for "in any order" but omp simd, which needs a flag.
   Without the flag it may not reorder a sum, and at -O2 vectorises loops of constant length only. So pairs go
   SPHI_ABREAST at a time, and each of them has its own sum, which are added at the end. gcc obeys omp simd
   where it has been told to. Its older versions cannot gather neighbours without hardware for that. */
#define SPHI_PRAGMA(x) _Pragma(#x)
#if defined(__clang__) && !SPH_OPENCL
#  ifdef __AVX__ /* Several vectors abreast would be half a row, and the other half would go pair by pair. */
#    define SPHI_ANY_ORDER SPHI_PRAGMA(clang loop vectorize(assume_safety) interleave_count(1))
#  else
#    define SPHI_ANY_ORDER SPHI_PRAGMA(clang loop vectorize(assume_safety))
#  endif
#  define SPH_SUM(p, from, to, ...) SPHI_ANY_ORDER SPHI_LOOP(p, from, to)
#  define SPH_EACH(p, from, to) SPHI_ANY_ORDER SPHI_LOOP(p, from, to)
#elif SPH_SIMD
#  define SPH_SUM(p, from, to, ...) SPHI_PRAGMA(omp simd reduction(+ : __VA_ARGS__)) SPHI_LOOP(p, from, to)
#  define SPH_EACH(p, from, to) SPHI_PRAGMA(omp simd) SPHI_LOOP(p, from, to)
#elif defined(__GNUC__) && __GNUC__ >= 12 && defined(__OPTIMIZE__) && !defined(__OPTIMIZE_SIZE__) && \
    (defined(__SSE2__) || defined(__aarch64__) || defined(__VSX__)) && \
    !(defined(__CUDACC__) || defined(__INTEL_COMPILER) || defined(__NVCOMPILER))
#  ifdef __AVX2__
#    define SPHI_ABREAST 8 /* as many as a vector of 32-bit indices holds */
#    define SPHI_SUM_END(a) \
        a = ((sphi_##a[0] + sphi_##a[1]) + (sphi_##a[2] + sphi_##a[3])) + \
            ((sphi_##a[4] + sphi_##a[5]) + (sphi_##a[6] + sphi_##a[7]))
#  else
#    define SPHI_ABREAST 4
#    define SPHI_SUM_END(a) a = (sphi_##a[0] + sphi_##a[1]) + (sphi_##a[2] + sphi_##a[3])
#  endif
#  define SPHI_SUM_BEGIN(a) sphi_##a[SPHI_ABREAST] = {a}
#  define SPHI_SUM_PAIR(a) a = SPH_R(-0.0) /* x + -0 is x, and costs nothing; x + 0 is not, where x is -0 */
#  define SPHI_SUM_ADD(a) sphi_##a[sphi_lane] += a
#  define SPH_SUM(p, from, to, ...) \
    for (sph_real SPHI_NAMES(SPHI_SUM_BEGIN, __VA_ARGS__), sphi_open = SPH_R(1); sphi_open > SPH_R(0); \
         sphi_open = SPH_R(0), SPHI_NAMES(SPHI_SUM_END, __VA_ARGS__)) \
    SPHI_LANES_LOOP(p, from, to, SPHI_NAMES(SPHI_SUM_PAIR, __VA_ARGS__), \
                    SPHI_NAMES(SPHI_SUM_ADD, __VA_ARGS__))
#  define SPH_EACH(p, from, to) SPHI_LANES_LOOP(p, from, to, (void)0, (void)0)
/* First the whole blocks, then the rest. The first pragma unrolls that, so that the length of a whole block
   is constant. The last one keeps the lanes a loop, because it is loops that gcc vectorises. */
#  define SPHI_LANES_LOOP(p, from, to, before, after) \
    SPHI_PRAGMA(GCC unroll 2) \
    for (int sphi_rest = 0; sphi_rest < 2; sphi_rest++) \
        for (sph_index sphi_p = sphi_rest ? (sph_index)((to) - ((to) - (from)) % SPHI_ABREAST) : (from), \
                       sphi_least = sphi_rest ? 1 : SPHI_ABREAST; \
             (to) - sphi_p >= sphi_least; sphi_p = (sph_index)(sphi_p + SPHI_ABREAST)) \
            SPHI_PRAGMA(GCC ivdep) SPHI_PRAGMA(GCC unroll 1) \
            for (int sphi_lane = 0, sphi_n = sphi_rest ? (int)((to) - sphi_p) : SPHI_ABREAST; \
                 sphi_lane < sphi_n; sphi_lane++) \
                for (int sphi_once = (p = (sph_index)(sphi_p + sphi_lane), before, 1); sphi_once; \
                     sphi_once = (after, 0))
/* each(a), each(b), ... */
#  define SPHI_NAMES(each, ...) SPHI_NAMES_OF(SPHI_COUNT(__VA_ARGS__), each, __VA_ARGS__)
#  define SPHI_NAMES_OF(count, each, ...) SPHI_PASTE(SPHI_NAMES_, count)(each, __VA_ARGS__)
#  define SPHI_COUNT(...) SPHI_COUNT_OF(__VA_ARGS__, 16, 15, 14, 13, 12, 11, 10, 9, 8, 7, 6, 5, 4, 3, 2, 1, 0)
#  define SPHI_COUNT_OF(a, b, c, d, e, f, g, h, i, j, k, l, m, n, o, p, count, ...) count
#  define SPHI_NAMES_1(each, a) each(a)
#  define SPHI_NAMES_2(each, a, ...) each(a), SPHI_NAMES_1(each, __VA_ARGS__)
#  define SPHI_NAMES_3(each, a, ...) each(a), SPHI_NAMES_2(each, __VA_ARGS__)
#  define SPHI_NAMES_4(each, a, ...) each(a), SPHI_NAMES_3(each, __VA_ARGS__)
#  define SPHI_NAMES_5(each, a, ...) each(a), SPHI_NAMES_4(each, __VA_ARGS__)
#  define SPHI_NAMES_6(each, a, ...) each(a), SPHI_NAMES_5(each, __VA_ARGS__)
#  define SPHI_NAMES_7(each, a, ...) each(a), SPHI_NAMES_6(each, __VA_ARGS__)
#  define SPHI_NAMES_8(each, a, ...) each(a), SPHI_NAMES_7(each, __VA_ARGS__)
#  define SPHI_NAMES_9(each, a, ...) each(a), SPHI_NAMES_8(each, __VA_ARGS__)
#  define SPHI_NAMES_10(each, a, ...) each(a), SPHI_NAMES_9(each, __VA_ARGS__)
#  define SPHI_NAMES_11(each, a, ...) each(a), SPHI_NAMES_10(each, __VA_ARGS__)
#  define SPHI_NAMES_12(each, a, ...) each(a), SPHI_NAMES_11(each, __VA_ARGS__)
#  define SPHI_NAMES_13(each, a, ...) each(a), SPHI_NAMES_12(each, __VA_ARGS__)
#  define SPHI_NAMES_14(each, a, ...) each(a), SPHI_NAMES_13(each, __VA_ARGS__)
#  define SPHI_NAMES_15(each, a, ...) each(a), SPHI_NAMES_14(each, __VA_ARGS__)
#  define SPHI_NAMES_16(each, a, ...) each(a), SPHI_NAMES_15(each, __VA_ARGS__)
#else
#  define SPH_SUM(p, from, to, ...) SPHI_LOOP(p, from, to)
#  define SPH_EACH(p, from, to) SPHI_LOOP(p, from, to)
#endif
#define SPHI_LOOP(p, from, to) for (p = (from); p < (to); p++)

#if SPH_PURE_SQRT
#  pragma GCC diagnostic push
#  pragma GCC diagnostic ignored "-Wredundant-decls"
#  ifdef __cplusplus
extern "C" {
#  endif
extern double(sqrt)(double) __attribute__((const));
extern float(sqrtf)(float) __attribute__((const));
#  ifdef __cplusplus
}
#  endif
#  pragma GCC diagnostic pop
#endif

/* In C++ a type that depends on the precision has a name that does, too, here and in the headers above. So
   parts of both precisions can be linked to one program (with -flto, compilers look at that). */
#ifndef __cplusplus
#  define SPHI_BEGIN
#  define SPHI_END
#else
#  define SPHI_END }
#  if SPH_SINGLE
#    define SPHI_BEGIN inline namespace sph_float {
#  else
#    define SPHI_BEGIN inline namespace sph_double {
#  endif
#endif
SPHI_BEGIN

#if SPH_SINGLE
typedef float sph_real;
#else
typedef double sph_real;
#endif
typedef SPH_INDEX sph_index;
typedef char sphi_SPH_INDEX_must_be_a_signed_integer_of_2_to_8_bytes
    [2 * ((SPH_INDEX)0.5f == 0) * ((SPH_INDEX)-1 < 0) * (sizeof(SPH_INDEX) >= 2) * (sizeof(SPH_INDEX) <= 8) -
     1];
#if SPH_OPENCL
typedef int sphi_int32;
#else
typedef int32_t sphi_int32; /* because int may have 16 bits */
#endif
#define SPH_R(x) ((sph_real)(x))

#if SPH_SINGLE && !SPH_OPENCL
#  define SPHI_SQRT(x) sqrtf(x)
#  define SPHI_ABS(x) fabsf(x)
#  define SPHI_EXP(x) expf(x)
#else
#  define SPHI_SQRT(x) sqrt(x)
#  define SPHI_ABS(x) fabs(x)
#  define SPHI_EXP(x) exp(x)
#endif
/* clang-format on */

/* The unit round-off, and a ratio of lengths so small that nothing nearer to a particle matters, while its
   square is still a normal number. */
#if SPH_SINGLE
#define SPH_EPSILON SPH_R(1.1920928955078125e-7)
#define SPHI_TINY SPH_R(1e-18)
#else
#define SPH_EPSILON SPH_R(2.220446049250313e-16)
#define SPHI_TINY SPH_R(1e-150)
#endif

/* ================================================================ kernels
 *
 * With q = r / h, a kernel is a shape w(q), a support beyond which w = 0, and a normalisation sigma:
 *     W       = sigma / h^dim w(q)
 *     sigma   = 1 / (S_dim integral_0^support w(q) q^(dim-1) dq),   S_1 = 2, S_2 = 2 pi, S_3 = 4 pi
 *     F       = (1/r) dW/dr = sigma / h^(dim+2) (1/q) dw/dq,        grad_i W = F x_ij
 *     d2W/dr2 = sigma / h^(dim+2) d2w/dq2,                          lap W = d2W/dr2 + (dim - 1) F
 *     dW/dh   = -(dim W + r dW/dr) / h                              at fixed r
 *
 * Sources. "Clustering paper": Korzilius et al., 'two remedies for particle clustering'. "ICSPM paper":
 * Korzilius, Schilders & Anthonissen 2017, J. Appl. Math. Phys. 5, 168.
 *   cubic-, quartic-, quintic-, sextic-, heptic-spline (M4, M5, M6, M7, M8)
 *       Schoenberg 1946, Quart. Appl. Math. 4, 45. In SPH: Monaghan & Lattanzio 1985, A&A 149, 135 (M4).
 *   wendland-c2, -c4, -c6; wendland-c2-1d, -c4-1d, -c6-1d
 *       Wendland 1995, Adv. Comput. Math. 4, 389; Dehnen & Aly 2012, MNRAS 425, 1068, table 1. The first
 *       three are his functions psi_{3,1}, psi_{4,2}, psi_{5,3} of two and three dimensions, the others his
 *       functions psi_{2,1}, psi_{3,2}, psi_{4,3} of one dimension. A kernel named -1d is positive definite
 *       in one dimension only, but it is normalised in all three. wendland-c2-1d is (1.1) of the clustering
 *       paper, and the kernel of Lucy 1977, AJ 82, 1013. wendland-c4-1d is the kernel of the ICSPM paper.
 *   gaussian, super-gaussian
 *       Gingold & Monaghan 1977, MNRAS 181, 375; Monaghan & Gingold 1983, JCP 52, 374. Both are cut at 3 h,
 *       and normalised for the cut. The super-Gaussian is negative for q^2 > dim/2 + 1.
 *   liu-quartic
 *       Liu & Liu 2003, Smoothed Particle Hydrodynamics. It is negative for 1.6957 < q < 2.
 *   hermite, schuessler-schmitt, johnson-beissel, convex
 *       (3.7), (3.5), (3.6) and (3.9) of the clustering paper. Schuessler & Schmitt 1981, A&A 97, 373;
 *       Johnson & Beissel 1996, IJNME 39, 2725.
 *   convex-cubic-spline, convex-wendland-c2, convex-wendland-c4
 *       The recipe of the clustering paper, K(q) = integral_q^2 w dq, scaled to K(0) = 1. (The kernel named
 *       convex is this recipe applied to hermite.)
 *   core-triangle
 *       Read, Hayfield & Agertz 2010, MNRAS 405, 1513, with alpha = 1/3. Its slope is constant for q < 2/3.
 *   poly6, spiky
 *       Mueller, Charypar & Gross 2003, Symposium on Computer Animation, 154, (20) and (21). Their h is the
 *       support radius H, so that h = H/2 here, for instance by sph_kernel_h_from_support: with it, all
 *       kernels of 2 h can share a list. In 3D W is then 315/(64 pi H^9) (H^2 - r^2)^3 of poly6 and
 *       15/(pi H^6) (H - r)^3 of spiky. The slope of poly6 vanishes towards r = 0, so that its pressure does
 *       not keep particles apart; they took it for the density, and spiky, which has a cusp, for gradients.
 *       (W of their third kernel, for viscosity, is infinite at r = 0. It is not here.)
 * The recommended h / dx of M4, M5, M6 and the Wendland family are those of Phantom (Price et al. 2018,
 * PASA 35, e031), those of M7 and M8 the default of Shamrock. Those of the clustering kernels come from the
 * papers that propose these kernels. Those of poly6 and spiky are the support of 2 dx that is usual in
 * computer graphics, with 4 pi/3 2^3 = 33 neighbours in 3D.
 */

/* -------- kernels: types */

/* All kernels, one each(context, identifier, name, support / h, recommended h / dx) for each. `each` is a
   macro of yours, which also gets the context that you give. */
/* clang-format off */
#define SPH_KERNELS(each, context) \
    each(context, SPH_CUBIC_SPLINE, "cubic-spline", 2.0, 1.2) \
    each(context, SPH_QUARTIC_SPLINE, "quartic-spline", 2.5, 1.1) \
    each(context, SPH_QUINTIC_SPLINE, "quintic-spline", 3.0, 1.0) \
    each(context, SPH_WENDLAND_C2, "wendland-c2", 2.0, 1.3) \
    each(context, SPH_WENDLAND_C4, "wendland-c4", 2.0, 1.5) \
    each(context, SPH_WENDLAND_C6, "wendland-c6", 2.0, 1.6) \
    each(context, SPH_WENDLAND_C2_1D, "wendland-c2-1d", 2.0, 1.3) \
    each(context, SPH_WENDLAND_C4_1D, "wendland-c4-1d", 2.0, 1.5) \
    each(context, SPH_WENDLAND_C6_1D, "wendland-c6-1d", 2.0, 1.6) \
    each(context, SPH_GAUSSIAN, "gaussian", 3.0, 1.0) \
    each(context, SPH_SUPER_GAUSSIAN, "super-gaussian", 3.0, 1.0) \
    each(context, SPH_LIU_QUARTIC, "liu-quartic", 2.0, 1.2) \
    each(context, SPH_HERMITE, "hermite", 2.0, 1.5) \
    each(context, SPH_SCHUESSLER_SCHMITT, "schuessler-schmitt", 2.0, 1.5) \
    each(context, SPH_JOHNSON_BEISSEL, "johnson-beissel", 2.0, 1.5) \
    each(context, SPH_CONVEX, "convex", 2.0, 1.5) \
    each(context, SPH_CONVEX_CUBIC_SPLINE, "convex-cubic-spline", 2.0, 1.5) \
    each(context, SPH_CONVEX_WENDLAND_C2, "convex-wendland-c2", 2.0, 1.5) \
    each(context, SPH_CONVEX_WENDLAND_C4, "convex-wendland-c4", 2.0, 1.5) \
    each(context, SPH_CORE_TRIANGLE, "core-triangle", 2.0, 1.5) \
    each(context, SPH_SEXTIC_SPLINE, "sextic-spline", 3.5, 1.0) \
    each(context, SPH_HEPTIC_SPLINE, "heptic-spline", 4.0, 1.0) \
    each(context, SPH_POLY6, "poly6", 2.0, 1.0) \
    each(context, SPH_SPIKY, "spiky", 2.0, 1.0)
/* clang-format on */

/* clang-format off */
#define SPHI_KERNEL_ENUM(unused, id, name, support, h_over_dx) id,
typedef enum sph_kernel {
    SPH_KERNELS(SPHI_KERNEL_ENUM, 0) SPH_KERNEL_COUNT,
    SPH_LUCY = SPH_WENDLAND_C2_1D /* the same function */
} sph_kernel;
/* clang-format on */

/* For a kernel that is chosen at run time: one switch around the whole sweep. CALL is a macro (or a function)
   of one argument; it is given the kernel as a constant. */
/* clang-format off */
#define SPHI_KERNEL_CASE(CALL, id, name, support, h_over_dx) case id: CALL(id); break;
#define SPH_SWITCH_KERNEL(k, CALL) \
    switch (k) { \
    SPH_KERNELS(SPHI_KERNEL_CASE, CALL) \
    case SPH_KERNEL_COUNT: default: break; \
    }
/* clang-format on */

/* W and F = (1/r) dW/dr of one pair */
typedef struct sph_wf {
    sph_real w, f;
} sph_wf;

/* -------- kernels: functions */

/* What SPH_ASSERT is called with, where it takes more than a line. */
#define SPHI_IS_KERNEL(k) ((unsigned)(k) < (unsigned)SPH_KERNEL_COUNT)
#define SPHI_IS_DIM(dim) ((dim) >= 1 && (dim) <= 3)
/* q = r/h may be NaN: sweeps accept an h whose inverse overflows, and then report a result that is not
   finite. */
#define SPHI_IS_Q(q) (!((q) < SPH_R(0)))

/* The positive part of x, without a branch: for `x > 0 ? x : 0` gcc leaves control flow in a loop, and then
   does not vectorise it. Exact for finite x. */
SPH_FN sph_real sphi_pos(sph_real x) { return SPH_R(0.5) * (x + SPHI_ABS(x)); }
SPH_FN sph_real sphi_by_dim(int dim, sph_real one, sph_real two, sph_real three)
{
    return dim == 1 ? one : dim == 2 ? two : three;
}
SPH_FN sph_real sphi_power(sph_real x, int dim) { return sphi_by_dim(dim, x, x * x, x * x * x); }

/* slope / q, for kernels with a slope at the origin. It is 0 at q = 0, where the direction is undefined. It
   has no branch, and never divides by zero. */
SPH_FN sph_real sphi_over_q(sph_real slope, sph_real q)
{
    const sph_real p = q + SPHI_TINY;
    return slope * q / (p * p);
}

/* Support radius / h. */
SPH_FN sph_real sph_kernel_support_ratio(sph_kernel k)
{
#define SPHI_KERNEL_SUPPORT(unused, id, name, support, h_over_dx) \
    case id: \
        return SPH_R(support);
    SPH_ASSERT(SPHI_IS_KERNEL(k));
    switch (k) {
        SPH_KERNELS(SPHI_KERNEL_SUPPORT, 0)
    case SPH_KERNEL_COUNT:
    default:
        return SPH_R(0);
    }
#undef SPHI_KERNEL_SUPPORT
}

/* Recommended h / particle spacing: a default for programs, not a law.
   Even on a perfect lattice, the density that is summed up with it, dx^dim sum W, is not exactly 1. Of the
   kernels without a cusp it is right within 1.6 %. A kernel with a cusp gives a particle itself too large a
   share, so that the density is too high:
                              1D     2D     3D                            1D     2D     3D
       schuessler-schmitt   1.106  1.041  1.006    convex-wendland-c2   1.134  1.118  1.083
       johnson-beissel      1.056  1.034  1.019    convex-wendland-c4   1.174  1.176  1.142
       convex               1.063  1.042  1.023    core-triangle        1.051  1.034  1.018
       convex-cubic-spline  1.108  1.088  1.058    spiky                1.250  1.274  1.236
   examples/hello_kernel.c prints this table for all kernels (-l). A density that is integrated from its right
   value is free of this error; one that is summed up is not, and an equation of state turns it into a
   pressure. Larger h reduces it. */
SPH_FN sph_real sph_kernel_h_over_dx(sph_kernel k)
{
#define SPHI_KERNEL_H_OVER_DX(unused, id, name, support, h_over_dx) \
    case id: \
        return SPH_R(h_over_dx);
    SPH_ASSERT(SPHI_IS_KERNEL(k));
    switch (k) {
        SPH_KERNELS(SPHI_KERNEL_H_OVER_DX, 0)
    case SPH_KERNEL_COUNT:
    default:
        return SPH_R(0);
    }
#undef SPHI_KERNEL_H_OVER_DX
}

/* The h of a kernel that ends at the radius `support`. Needs support > 0. */
SPH_FN sph_real sph_kernel_h_from_support(sph_kernel k, sph_real support)
{
    SPH_ASSERT(support > SPH_R(0));
    return support / sph_kernel_support_ratio(k);
}
/* The radius at which a kernel ends. */
SPH_FN sph_real sph_kernel_support(sph_kernel k, sph_real h)
{
    SPH_ASSERT(h > SPH_R(0));
    return h * sph_kernel_support_ratio(k);
}

/* sigma = 1 / (S_dim integral_0^support w(q) q^(dim-1) dq) with S_dim = 2, 2 pi, 4 pi. The comments give the
   exact values for 1, 2 and 3 dimensions; tests/known/derive_kernels.py derives them. */
SPH_FN sph_real sph_kernel_sigma(sph_kernel k, int dim)
{
    SPH_ASSERT(SPHI_IS_KERNEL(k) && SPHI_IS_DIM(dim));
    switch (k) {
    case SPH_CUBIC_SPLINE: /* 2/3, 10/(7 pi), 1/pi */
        return sphi_by_dim(dim, SPH_R(0.66666666666666666667), SPH_R(0.45472840883398667363),
                           SPH_R(0.31830988618379067154));
    case SPH_QUARTIC_SPLINE: /* 1/24, 96/(1199 pi), 1/(20 pi) */
        return sphi_by_dim(dim, SPH_R(0.041666666666666666667), SPH_R(0.025486029252413598388),
                           SPH_R(0.015915494309189533577));
    case SPH_QUINTIC_SPLINE: /* 1/120, 7/(478 pi), 1/(120 pi) */
        return sphi_by_dim(dim, SPH_R(0.0083333333333333333333), SPH_R(0.0046614418478797797087),
                           SPH_R(0.0026525823848649222628));
    case SPH_WENDLAND_C2: /* 3/4, 7/(4 pi), 21/(16 pi) */
        return sphi_by_dim(dim, SPH_R(0.75), SPH_R(0.55704230082163367519), SPH_R(0.41778172561622525639));
    case SPH_WENDLAND_C4: /* 27/32, 9/(4 pi), 495/(256 pi) */
        return sphi_by_dim(dim, SPH_R(0.84375), SPH_R(0.71619724391352901096), SPH_R(0.61548200648818899379));
    case SPH_WENDLAND_C6: /* 15/16, 39/(14 pi), 1365/(512 pi) */
        return sphi_by_dim(dim, SPH_R(0.9375), SPH_R(0.88672039722627401357), SPH_R(0.84861913015795755205));
    case SPH_WENDLAND_C2_1D: /* 5/8, 5/(4 pi), 105/(128 pi) */
        return sphi_by_dim(dim, SPH_R(0.625), SPH_R(0.39788735772973833942), SPH_R(0.26111357851014078525));
    case SPH_WENDLAND_C4_1D: /* 3/4, 9/(5 pi), 45/(32 pi) */
        return sphi_by_dim(dim, SPH_R(0.75), SPH_R(0.57295779513082320877), SPH_R(0.44762327744595563185));
    case SPH_WENDLAND_C6_1D: /* 55/64, 33/(14 pi), 2145/(1024 pi) */
        return sphi_by_dim(dim, SPH_R(0.859375), SPH_R(0.75030187457607801148),
                           SPH_R(0.66677217369553807661));
    case SPH_GAUSSIAN: /* 1/(sqrt(pi) erf(3)), 1/(pi (1 - exp(-9))), 1/(pi (sqrt(pi) erf(3) - 6 exp(-9))) */
        return sphi_by_dim(dim, SPH_R(0.56420204705138327129), SPH_R(0.31834917359293493198),
                           SPH_R(0.17966614821808717693));
    case SPH_SUPER_GAUSSIAN:
        /* 1/(sqrt(pi) erf(3) + 3 exp(-9)), 1/(pi (1 + 8 exp(-9))), 1/(pi (sqrt(pi) erf(3) + 48 exp(-9))) */
        return sphi_by_dim(dim, SPH_R(0.56408421877496896766), SPH_R(0.3179959356548344837),
                           SPH_R(0.17899286888813445964));
    case SPH_LIU_QUARTIC: /* 1, 15/(7 pi), 315/(208 pi) */
        return sphi_by_dim(dim, SPH_R(1.0), SPH_R(0.68209261325098001044), SPH_R(0.48205583724949068045));
    case SPH_HERMITE: /* 1/8, 5/(24 pi), 15/(128 pi) */
        return sphi_by_dim(dim, SPH_R(0.125), SPH_R(0.06631455962162305657), SPH_R(0.037301939787162969321));
    case SPH_SCHUESSLER_SCHMITT: /* 3 sqrt2/8, 5 sqrt2/(8 pi), 21 sqrt2/(64 pi) */
        return sphi_by_dim(dim, SPH_R(0.5303300858899106433), SPH_R(0.28134884879909564674),
                           SPH_R(0.14770814561952521454));
    case SPH_JOHNSON_BEISSEL: /* 3/4, 3/(2 pi), 15/(16 pi) */
        return sphi_by_dim(dim, SPH_R(0.75), SPH_R(0.47746482927568600731), SPH_R(0.29841551829730375457));
    case SPH_CONVEX: /* 5/48, 15/(64 pi), 21/(128 pi) */
        return sphi_by_dim(dim, SPH_R(0.10416666666666666667), SPH_R(0.074603879574325938642),
                           SPH_R(0.052222715702028157049));
    case SPH_CONVEX_CUBIC_SPLINE: /* 15/14, 3/pi, 315/(124 pi) */
        return sphi_by_dim(dim, SPH_R(1.0714285714285714286), SPH_R(0.95492965855137201461),
                           SPH_R(0.80860979151527468979));
    case SPH_CONVEX_WENDLAND_C2: /* 7/6, 7/(2 pi), 63/(20 pi) */
        return sphi_by_dim(dim, SPH_R(1.1666666666666666667), SPH_R(1.1140846016432673504),
                           SPH_R(1.0026761414789406153));
    case SPH_CONVEX_WENDLAND_C4: /* 4/3, 55/(12 pi), 33/(7 pi) */
        return sphi_by_dim(dim, SPH_R(1.3333333333333333333), SPH_R(1.4589203116757072445),
                           SPH_R(1.500603749152156023));
    case SPH_CORE_TRIANGLE: /* 54/85, 162/(115 pi), 3645/(3661 pi) */
        return sphi_by_dim(dim, SPH_R(0.63529411764705882353), SPH_R(0.44840175271107903295),
                           SPH_R(0.31691874764816088439));
    case SPH_SEXTIC_SPLINE: /* 1/720, 256/(113149 pi), 1/(840 pi) */
        return sphi_by_dim(dim, SPH_R(0.0013888888888888888889), SPH_R(0.00072017720760281055876),
                           SPH_R(0.00037894034069498889469));
    case SPH_HEPTIC_SPLINE: /* 1/5040, 9/(29740 pi), 1/(6720 pi) */
        return sphi_by_dim(dim, SPH_R(0.0001984126984126984127), SPH_R(0.000096327806847818293337),
                           SPH_R(0.000047367542586873611836));
    case SPH_POLY6: /* 35/64, 1/pi, 315/(512 pi) */
        return sphi_by_dim(dim, SPH_R(0.546875), SPH_R(0.31830988618379067154),
                           SPH_R(0.19583518388260558893));
    case SPH_SPIKY: /* 1, 5/(2 pi), 15/(8 pi) */
        return sphi_by_dim(dim, SPH_R(1.0), SPH_R(0.79577471545947667884), SPH_R(0.59683103659460750913));
    case SPH_KERNEL_COUNT:
    default:
        return SPH_R(0);
    }
}

/* w(q): the kernel without its normalisation; 0 for q >= support. The sources stand above. Needs q >= 0. */
SPH_FN sph_real sph_kernel_shape(sph_kernel k, int dim, sph_real q)
{
    const sph_real a = sphi_pos(SPH_R(2) - q), b = SPH_R(0.5) * a, c = sphi_pos(SPH_R(1) - q);
    const sph_real b2 = b * b, b4 = b2 * b2;
    SPH_ASSERT(SPHI_IS_KERNEL(k) && SPHI_IS_DIM(dim) && SPHI_IS_Q(q));
    switch (k) {
    case SPH_CUBIC_SPLINE:
        return SPH_R(0.25) * a * a * a - c * c * c;
    case SPH_QUARTIC_SPLINE: {
        const sph_real u = sphi_pos(SPH_R(2.5) - q), v = sphi_pos(SPH_R(1.5) - q),
                       s = sphi_pos(SPH_R(0.5) - q);
        return u * u * u * u - SPH_R(5) * (v * v * v * v) + SPH_R(10) * (s * s * s * s);
    }
    case SPH_QUINTIC_SPLINE: {
        const sph_real u = sphi_pos(SPH_R(3) - q), u2 = u * u, a2 = a * a, c2 = c * c;
        return u2 * u2 * u - SPH_R(6) * (a2 * a2 * a) + SPH_R(15) * (c2 * c2 * c);
    }
    case SPH_WENDLAND_C2:
        return b4 * (SPH_R(1) + SPH_R(2) * q);
    case SPH_WENDLAND_C4:
        return b4 * b2 * (SPH_R(1) + q * (SPH_R(3) + SPH_R(2.91666666666666667) * q));
    case SPH_WENDLAND_C6:
        return b4 * b4 * (SPH_R(1) + q * (SPH_R(4) + q * (SPH_R(6.25) + SPH_R(4) * q)));
    case SPH_WENDLAND_C2_1D:
        return b2 * b * (SPH_R(1) + SPH_R(1.5) * q);
    case SPH_WENDLAND_C4_1D:
        return b4 * b * (SPH_R(1) + q * (SPH_R(2.5) + SPH_R(2) * q));
    case SPH_WENDLAND_C6_1D:
        return b4 * b2 * b * (SPH_R(1) + q * (SPH_R(3.5) + q * (SPH_R(4.75) + SPH_R(2.625) * q)));
    case SPH_GAUSSIAN:
        return q < SPH_R(3) ? SPHI_EXP(-q * q) : SPH_R(0);
    case SPH_SUPER_GAUSSIAN:
        return q < SPH_R(3) ? (SPH_R(0.5) * SPH_R(dim) + SPH_R(1) - q * q) * SPHI_EXP(-q * q) : SPH_R(0);
    case SPH_LIU_QUARTIC: /* 2/3 - 9/8 q^2 + 19/24 q^3 - 5/32 q^4 */
        return a * a * (SPH_R(0.166666666666666667) * (SPH_R(1) + q) - SPH_R(0.15625) * q * q);
    case SPH_HERMITE:
        return a * a * (q + SPH_R(1));
    case SPH_SCHUESSLER_SCHMITT: /* sqrt(2) - sqrt(q), without cancellation at q = 2 */
        return a / (SPH_R(1.41421356237309505) + SPHI_SQRT(q));
    case SPH_JOHNSON_BEISSEL:
        return b2;
    case SPH_CONVEX:
        return a * a * a * (SPH_R(0.5) * q + SPH_R(1));
    case SPH_CONVEX_CUBIC_SPLINE:
        return SPH_R(0.0833333333333333333) * (a * a) * (a * a) -
               SPH_R(0.333333333333333333) * (c * c) * (c * c);
    case SPH_CONVEX_WENDLAND_C2:
        return b4 * b * (SPH_R(1) + q);
    case SPH_CONVEX_WENDLAND_C4:
        return b4 * b2 * b * (SPH_R(1) + q * (SPH_R(1.8125) + SPH_R(1.09375) * q));
    case SPH_CORE_TRIANGLE: {
        const sph_real e = sphi_pos(SPH_R(0.666666666666666667) - q);
        return SPH_R(0.25) * a * a * a - c * c * c + SPH_R(0.75) * e * e * e;
    }
    case SPH_SEXTIC_SPLINE: {
        const sph_real e = sphi_pos(SPH_R(0.5) - q), s = q + e, u = sphi_pos(SPH_R(3.5) - s),
                       v = sphi_pos(SPH_R(2.5) - s), t = sphi_pos(SPH_R(1.5) - s), u3 = u * u * u,
                       v3 = v * v * v, t3 = t * t * t;
        return u3 * u3 - SPH_R(7) * (v3 * v3) + SPH_R(21) * (t3 * t3) +
               e * (SPH_R(240) -
                    e * (SPH_R(150) + e * (SPH_R(160) - e * (SPH_R(30) + e * (SPH_R(60) - SPH_R(20) * e)))));
    }
    case SPH_HEPTIC_SPLINE: {
        const sph_real s = q + c, u = sphi_pos(SPH_R(4) - s), v = sphi_pos(SPH_R(3) - s),
                       t = sphi_pos(SPH_R(2) - s), u3 = u * u * u, v3 = v * v * v, t3 = t * t * t;
        return u3 * u3 * u - SPH_R(8) * (v3 * v3 * v) + SPH_R(28) * (t3 * t3 * t) +
               c * (SPH_R(1715) +
                    c * (SPH_R(315) +
                         c * (SPH_R(-665) +
                              c * (SPH_R(-315) + c * (SPH_R(105) + c * (SPH_R(105) - SPH_R(35) * c))))));
    }
    case SPH_POLY6: { /* (1 - q^2/4)^3, without cancellation at q = 2 */
        const sph_real p = b * (SPH_R(1) + SPH_R(0.5) * q);
        return p * p * p;
    }
    case SPH_SPIKY:
        return b2 * b;
    case SPH_KERNEL_COUNT:
    default:
        return SPH_R(0);
    }
}

/* (1/q) dw/dq; 0 for q >= support. At q = 0 it is the limit, or 0 for a kernel with a cusp. Needs q >= 0.
   Splines: let q0 be the knot next to the origin, t = min(q, q0) and s = max(q, q0), so that q = t + s - q0.
   Then f(q) = [f(t) - f(q0)] + f(s). The first part is written without a division by q, the second without
   the inner piece, so that nothing branches and nothing cancels.
   schuessler-schmitt: for q < 1e-6 the slope is kept at its value at q = 1e-6, because the true slope is
   infinite at the origin. */
SPH_FN sph_real sph_kernel_shape_f(sph_kernel k, int dim, sph_real q)
{
    const sph_real a = sphi_pos(SPH_R(2) - q), b = SPH_R(0.5) * a, c = sphi_pos(SPH_R(1) - q);
    const sph_real b2 = b * b, b4 = b2 * b2;
    SPH_ASSERT(SPHI_IS_KERNEL(k) && SPHI_IS_DIM(dim) && SPHI_IS_Q(q));
    switch (k) {
    case SPH_CUBIC_SPLINE: {
        const sph_real s = q + c, u = sphi_pos(SPH_R(2) - s);
        return SPH_R(-0.75) * u * u / s - SPH_R(2.25) * c;
    }
    case SPH_QUARTIC_SPLINE: {
        const sph_real e = sphi_pos(SPH_R(0.5) - q), s = q + e, u = sphi_pos(SPH_R(2.5) - s),
                       v = sphi_pos(SPH_R(1.5) - s);
        return SPH_R(-4) * (u * u * u - SPH_R(5) * (v * v * v)) / s - SPH_R(24) * e * (SPH_R(1) - e);
    }
    case SPH_QUINTIC_SPLINE: {
        const sph_real s = q + c, u = sphi_pos(SPH_R(3) - s), v = sphi_pos(SPH_R(2) - s), u2 = u * u,
                       v2 = v * v;
        return SPH_R(-5) * (u2 * u2 - SPH_R(6) * (v2 * v2)) / s -
               c * (SPH_R(90) + c * (SPH_R(30) - SPH_R(50) * c));
    }
    case SPH_WENDLAND_C2:
        return SPH_R(-5) * b2 * b;
    case SPH_WENDLAND_C4:
        return SPH_R(-4.66666666666666667) * b4 * b * (SPH_R(1) + SPH_R(2.5) * q);
    case SPH_WENDLAND_C6:
        return SPH_R(-5.5) * b4 * b2 * b * (SPH_R(1) + q * (SPH_R(3.5) + SPH_R(4) * q));
    case SPH_WENDLAND_C2_1D:
        return SPH_R(-3) * b2;
    case SPH_WENDLAND_C4_1D:
        return SPH_R(-3.5) * b4 * (SPH_R(1) + SPH_R(2) * q);
    case SPH_WENDLAND_C6_1D:
        return SPH_R(-1.5) * b4 * b2 * (SPH_R(3) + q * (SPH_R(9) + SPH_R(8.75) * q));
    case SPH_GAUSSIAN:
        return q < SPH_R(3) ? SPH_R(-2) * SPHI_EXP(-q * q) : SPH_R(0);
    case SPH_SUPER_GAUSSIAN:
        return q < SPH_R(3) ? SPH_R(-2) * (SPH_R(0.5) * SPH_R(dim) + SPH_R(2) - q * q) * SPHI_EXP(-q * q)
                            : SPH_R(0);
    case SPH_LIU_QUARTIC:
        return a * (SPH_R(0.625) * q - SPH_R(1.125));
    case SPH_HERMITE:
        return SPH_R(-3) * a;
    case SPH_SCHUESSLER_SCHMITT: {
        const sph_real p = SPH_R(1e-6) + sphi_pos(q - SPH_R(1e-6)),
                       inside = q < SPH_R(2) ? SPH_R(1) : SPH_R(0);
        return inside * sphi_over_q(SPH_R(-0.5) / SPHI_SQRT(p), q);
    }
    case SPH_JOHNSON_BEISSEL:
        return sphi_over_q(-b, q);
    case SPH_CONVEX:
        return sphi_over_q(SPH_R(-2) * a * a * (q + SPH_R(1)), q);
    case SPH_CONVEX_CUBIC_SPLINE:
        return sphi_over_q(SPH_R(-1.33333333333333333) * sph_kernel_shape(SPH_CUBIC_SPLINE, dim, q), q);
    case SPH_CONVEX_WENDLAND_C2:
        return sphi_over_q(SPH_R(-1.5) * sph_kernel_shape(SPH_WENDLAND_C2, dim, q), q);
    case SPH_CONVEX_WENDLAND_C4:
        return sphi_over_q(SPH_R(-1.6875) * sph_kernel_shape(SPH_WENDLAND_C4, dim, q), q);
    case SPH_CORE_TRIANGLE: {
        const sph_real e = sphi_pos(SPH_R(0.666666666666666667) - q);
        return sphi_over_q(SPH_R(3) * c * c - SPH_R(0.75) * a * a - SPH_R(2.25) * e * e, q);
    }
    case SPH_SEXTIC_SPLINE: {
        const sph_real e = sphi_pos(SPH_R(0.5) - q), s = q + e, u = sphi_pos(SPH_R(3.5) - s),
                       v = sphi_pos(SPH_R(2.5) - s), t = sphi_pos(SPH_R(1.5) - s), u2 = u * u, v2 = v * v,
                       t2 = t * t;
        return SPH_R(-6) * (u2 * u2 * u - SPH_R(7) * (v2 * v2 * v) + SPH_R(21) * (t2 * t2 * t)) / s -
               e * (SPH_R(360) - e * (SPH_R(240) + e * (SPH_R(240) - SPH_R(120) * e)));
    }
    case SPH_HEPTIC_SPLINE: {
        const sph_real s = q + c, u = sphi_pos(SPH_R(4) - s), v = sphi_pos(SPH_R(3) - s),
                       t = sphi_pos(SPH_R(2) - s), u3 = u * u * u, v3 = v * v * v, t3 = t * t * t;
        return SPH_R(-7) * (u3 * u3 - SPH_R(8) * (v3 * v3) + SPH_R(28) * (t3 * t3)) / s -
               c * (SPH_R(2345) + c * (SPH_R(350) - c * (SPH_R(910) + c * (SPH_R(385) - SPH_R(245) * c))));
    }
    case SPH_POLY6: {
        const sph_real p = b * (SPH_R(1) + SPH_R(0.5) * q);
        return SPH_R(-1.5) * p * p;
    }
    case SPH_SPIKY:
        return sphi_over_q(SPH_R(-1.5) * b2, q);
    case SPH_KERNEL_COUNT:
    default:
        return SPH_R(0);
    }
}

/* d2w/dq2; 0 for q >= support, where it jumps for liu-quartic, hermite, schuessler-schmitt, johnson-beissel
   and the Gaussians. At q = 0 of a kernel with a cusp it is the limit from q > 0. Needs q >= 0. */
SPH_FN sph_real sph_kernel_shape_d2(sph_kernel k, int dim, sph_real q)
{
    const sph_real a = sphi_pos(SPH_R(2) - q), b = SPH_R(0.5) * a, c = sphi_pos(SPH_R(1) - q);
    const sph_real b2 = b * b, b4 = b2 * b2, inside = q < sph_kernel_support_ratio(k) ? SPH_R(1) : SPH_R(0);
    SPH_ASSERT(SPHI_IS_KERNEL(k) && SPHI_IS_DIM(dim) && SPHI_IS_Q(q));
    switch (k) {
    case SPH_CUBIC_SPLINE:
        return SPH_R(1.5) * a - SPH_R(6) * c;
    case SPH_QUARTIC_SPLINE: {
        const sph_real u = sphi_pos(SPH_R(2.5) - q), v = sphi_pos(SPH_R(1.5) - q),
                       s = sphi_pos(SPH_R(0.5) - q);
        return SPH_R(12) * (u * u - SPH_R(5) * (v * v) + SPH_R(10) * (s * s));
    }
    case SPH_QUINTIC_SPLINE: {
        const sph_real u = sphi_pos(SPH_R(3) - q);
        return SPH_R(20) * (u * u * u - SPH_R(6) * (a * a * a) + SPH_R(15) * (c * c * c));
    }
    case SPH_WENDLAND_C2:
        return SPH_R(-5) * b2 * (SPH_R(1) - SPH_R(2) * q);
    case SPH_WENDLAND_C4:
        return SPH_R(-4.66666666666666667) * b4 * (SPH_R(1) + q * (SPH_R(2) - SPH_R(8.75) * q));
    case SPH_WENDLAND_C6:
        return SPH_R(-5.5) * b4 * b2 * (SPH_R(1) + q * (SPH_R(3) - q * (SPH_R(3.75) + SPH_R(20) * q)));
    case SPH_WENDLAND_C2_1D:
        return SPH_R(-3) * b * (SPH_R(1) - SPH_R(1.5) * q);
    case SPH_WENDLAND_C4_1D:
        return SPH_R(-3.5) * b2 * b * (SPH_R(1) + q * (SPH_R(1.5) - SPH_R(6) * q));
    case SPH_WENDLAND_C6_1D:
        return SPH_R(-1.5) * b4 * b * (SPH_R(3) + q * (SPH_R(7.5) - q * (SPH_R(9.75) + SPH_R(39.375) * q)));
    case SPH_GAUSSIAN:
        return inside * (SPH_R(4) * q * q - SPH_R(2)) * SPHI_EXP(-q * q);
    case SPH_SUPER_GAUSSIAN: {
        const sph_real g = SPH_R(0.5) * SPH_R(dim) + SPH_R(2), q2 = q * q;
        return inside * (SPH_R(-2) * g + q2 * (SPH_R(6) + SPH_R(4) * g - SPH_R(4) * q2)) * SPHI_EXP(-q2);
    }
    case SPH_LIU_QUARTIC:
        return inside * (SPH_R(-2.25) + q * (SPH_R(4.75) - SPH_R(1.875) * q));
    case SPH_HERMITE:
        return inside * SPH_R(6) * (q - SPH_R(1));
    case SPH_SCHUESSLER_SCHMITT: {
        const sph_real p = SPH_R(1e-6) + sphi_pos(q - SPH_R(1e-6));
        return inside * SPH_R(0.25) / (p * SPHI_SQRT(p));
    }
    case SPH_JOHNSON_BEISSEL:
        return inside * SPH_R(0.5);
    case SPH_CONVEX:
        return SPH_R(6) * q * a;
    case SPH_CONVEX_CUBIC_SPLINE:
        return SPH_R(-1.33333333333333333) * q * sph_kernel_shape_f(SPH_CUBIC_SPLINE, dim, q);
    case SPH_CONVEX_WENDLAND_C2:
        return SPH_R(-1.5) * q * sph_kernel_shape_f(SPH_WENDLAND_C2, dim, q);
    case SPH_CONVEX_WENDLAND_C4:
        return SPH_R(-1.6875) * q * sph_kernel_shape_f(SPH_WENDLAND_C4, dim, q);
    case SPH_CORE_TRIANGLE:
        return SPH_R(1.5) * a - SPH_R(6) * c + SPH_R(4.5) * sphi_pos(SPH_R(0.666666666666666667) - q);
    case SPH_SEXTIC_SPLINE: {
        const sph_real e = sphi_pos(SPH_R(0.5) - q), s = q + e, u = sphi_pos(SPH_R(3.5) - s),
                       v = sphi_pos(SPH_R(2.5) - s), t = sphi_pos(SPH_R(1.5) - s), u2 = u * u, v2 = v * v,
                       t2 = t * t;
        return SPH_R(30) * (u2 * u2 - SPH_R(7) * (v2 * v2) + SPH_R(21) * (t2 * t2)) -
               e * (SPH_R(960) - e * (SPH_R(360) + e * (SPH_R(1200) - SPH_R(600) * e)));
    }
    case SPH_HEPTIC_SPLINE: {
        const sph_real s = q + c, u = sphi_pos(SPH_R(4) - s), v = sphi_pos(SPH_R(3) - s),
                       t = sphi_pos(SPH_R(2) - s), u2 = u * u, v2 = v * v, t2 = t * t;
        return SPH_R(42) * (u2 * u2 * u - SPH_R(8) * (v2 * v2 * v) + SPH_R(28) * (t2 * t2 * t)) -
               c * (SPH_R(3990) +
                    c * (SPH_R(3780) - c * (SPH_R(2100) + c * (SPH_R(3150) - SPH_R(1470) * c))));
    }
    case SPH_POLY6:
        return SPH_R(-1.5) * b * (SPH_R(1) + SPH_R(0.5) * q) * (SPH_R(1) - SPH_R(1.25) * q * q);
    case SPH_SPIKY:
        return SPH_R(1.5) * b;
    case SPH_KERNEL_COUNT:
    default:
        return SPH_R(0);
    }
}

/* W = sigma / h^dim w(r/h). */
SPH_FN sph_real sph_kernel_w(sph_kernel k, int dim, sph_real r, sph_real h)
{
    const sph_real u = SPH_R(1) / h;
    SPH_ASSERT(r >= SPH_R(0) && h > SPH_R(0));
    return sph_kernel_sigma(k, dim) * sphi_power(u, dim) * sph_kernel_shape(k, dim, r * u);
}

/* F = (1/r) dW/dr, so that grad_i W = F x_ij. F <= 0 for every kernel that falls monotonically: all but
   liu-quartic and super-gaussian. */
SPH_FN sph_real sph_kernel_f(sph_kernel k, int dim, sph_real r, sph_real h)
{
    const sph_real u = SPH_R(1) / h;
    SPH_ASSERT(r >= SPH_R(0) && h > SPH_R(0));
    return sph_kernel_sigma(k, dim) * sphi_power(u, dim) * u * u * sph_kernel_shape_f(k, dim, r * u);
}

/* W and F in one call. */
SPH_FN sph_wf sph_kernel_wf(sph_kernel k, int dim, sph_real r, sph_real h)
{
    const sph_real u = SPH_R(1) / h, scale = sph_kernel_sigma(k, dim) * sphi_power(u, dim), q = r * u;
    sph_wf v;
    SPH_ASSERT(r >= SPH_R(0) && h > SPH_R(0));
    v.w = scale * sph_kernel_shape(k, dim, q);
    v.f = scale * u * u * sph_kernel_shape_f(k, dim, q);
    return v;
}

/* dW/dr = r F. It is 0 at r = 0, also for a kernel with a cusp. */
SPH_FN sph_real sph_kernel_dwdr(sph_kernel k, int dim, sph_real r, sph_real h)
{
    return r * sph_kernel_f(k, dim, r, h);
}

/* d2W/dr2. The Laplacian of W is d2W/dr2 + (dim - 1) F. */
SPH_FN sph_real sph_kernel_d2wdr2(sph_kernel k, int dim, sph_real r, sph_real h)
{
    const sph_real u = SPH_R(1) / h;
    SPH_ASSERT(r >= SPH_R(0) && h > SPH_R(0));
    return sph_kernel_sigma(k, dim) * sphi_power(u, dim) * u * u * sph_kernel_shape_d2(k, dim, r * u);
}

/* dW/dh = -(dim W + r dW/dr) / h at fixed r, because W is h^-dim times a function of r/h. */
SPH_FN sph_real sph_kernel_dwdh(sph_kernel k, int dim, sph_real r, sph_real h)
{
    const sph_wf v = sph_kernel_wf(k, dim, r, h);
    return -(SPH_R(dim) * v.w + r * r * v.f) / h;
}

/* 1 for the kernels whose slope at the origin is not zero. Their gradient has no direction at r = 0, and F is
   0 there. */
SPH_FN int sph_kernel_has_cusp(sph_kernel k)
{
    switch (k) {
    case SPH_SCHUESSLER_SCHMITT:
    case SPH_JOHNSON_BEISSEL:
    case SPH_CONVEX:
    case SPH_CONVEX_CUBIC_SPLINE:
    case SPH_CONVEX_WENDLAND_C2:
    case SPH_CONVEX_WENDLAND_C4:
    case SPH_CORE_TRIANGLE:
    case SPH_SPIKY:
        return 1;
    default:
        return 0;
    }
}

/* 1 if K(q) = integral_q^support w dq is again a kernel. It decreases where w >= 0, and is convex where
   w' <= 0. Both are tested at the ends of 1024 equal intervals of the support. The clustering paper says that
   'the result will always be decreasing'; this is not so for liu-quartic and super-gaussian, which have
   negative lobes. */
SPH_FN int sph_kernel_may_convexify(sph_kernel k, int dim)
{
    int i;
    SPH_ASSERT(SPHI_IS_KERNEL(k) && SPHI_IS_DIM(dim));
    for (i = 0; i <= 1024; i++) {
        const sph_real q = sph_kernel_support_ratio(k) * SPH_R(i) / SPH_R(1024);
        if (sph_kernel_shape(k, dim, q) < SPH_R(0) || sph_kernel_shape_f(k, dim, q) > SPH_R(0)) return 0;
    }
    return 1;
}

/* ================================================================ cohesion and adhesion
 *
 * The kernels of a force between particles that holds a drop together, and of one that makes it stick to a
 * wall. They are no smoothing kernels: their integral is not 1, and they have no h but the support radius H,
 * that is sph_kernel_support(k, h). With x = r / H, in three dimensions,
 *     C = 32 / (pi H^3) { (1 - x)^3 x^3 for 1/2 < x < 1;  2 (1 - x)^3 x^3 - 1/64 for x <= 1/2 }
 *     A = 0.007 / H^3 (-4 x^2 + 6 x - 2)^(1/4) for 1/2 < x < 1,
 * and 0 elsewhere. The force on particle i, with x_ij = x_i - x_j and r = |x_ij|, is
 *     -gamma m_i m_j C x_ij / r of a particle j,   -beta m_i psi_j A x_ij / r of a particle j of the wall,
 * where psi_j = rho0 V_j. gamma and beta are found by trial: they are not a surface tension, and depend on H.
 *     C rises from -1/(2 pi H^3) at r = 0, is 0 at 0.2729 H, 1/(2 pi H^3) at H/2, 0 at H. Its integral over
 *     space is 79/336. C is smooth but at H/2, where its curvature jumps.
 *     A is largest, 0.00495 / H^3, at 3 H/4. Its slope is infinite at H/2 and at H. Its integral over space
 *     is 0.01578.
 *
 * Source: Akinci, Akinci & Teschner 2013, ACM Trans. Graph. 32(6), 182, (1), (2), (6), (7). The paper writes
 * h for H. The 1/64 belongs inside the bracket that 32/(pi H^3) multiplies: only then is C continuous.
 */

/* -------- cohesion and adhesion: functions */

/* C(r), in 1/length^3. Below r = 0.2729 support it is negative: there the force pushes apart. */
SPH_FN sph_real sph_cohesion_kernel_akinci(sph_real r, sph_real support)
{
    /* t = min(x, 1/2) and s = max(x, 1/2) share 1/64 at 1/2; t (1 - t) = 1/4 - e^2 */
    const sph_real u = SPH_R(1) / support, x = r * u, e = sphi_pos(SPH_R(0.5) - x), s = x + e;
    const sph_real outer = s * sphi_pos(SPH_R(1) - s), inner = SPH_R(0.25) - e * e;
    SPH_ASSERT(r >= SPH_R(0) && support > SPH_R(0));
    return SPH_R(10.185916357881301489) * (u * u * u) *
           (outer * outer * outer + SPH_R(2) * (inner * inner * inner) - SPH_R(0.03125));
}

/* A(r) >= 0, in 1/length^3. */
SPH_FN sph_real sph_adhesion_kernel_akinci(sph_real r, sph_real support)
{
    const sph_real u = SPH_R(1) / support, x = r * u;
    SPH_ASSERT(r >= SPH_R(0) && support > SPH_R(0));
    return SPH_R(0.007) * (u * u * u) *
           SPHI_SQRT(SPHI_SQRT(SPH_R(4) * sphi_pos(x - SPH_R(0.5)) * sphi_pos(SPH_R(1) - x)));
}

/* ================================================================ gravity
 *
 * Softening by the kernel, in three dimensions: the potential phi of a unit mass that is spread out like W,
 * with G = 1. With q = r / h, Poisson's equation lap phi = 4 pi W gives phi = phi^(q) / h, where
 *     (1/q) dphi^/dq = 4 pi sigma / q^3 integral_0^q w(s) s^2 ds,   phi^(q) = -integral_q^inf (dphi^/ds) ds.
 * Beyond the support phi^ = -1/q and dphi^/dq = 1/q^2. At r = 0 the potential is finite and smooth. The
 * acceleration of particle i by a mass m at x_j is -G m (1/r) dphi/dr x_ij.
 *
 * Source: Price & Monaghan 2007, MNRAS 374, 1347, (A1)-(A7) in appendix A, for the cubic spline. The others
 * come from the same integrals, in exact rational numbers.
 * Errors are rounding errors alone. Towards the edge of the Wendland kernels, terms that alternate in sign
 * make them as large as some hundred units in the last place; in float three to four digits are right there.
 */

/* -------- gravity: functions */

/* 1 for cubic-spline, wendland-c2, wendland-c4 and wendland-c6. */
SPH_FN int sph_kernel_has_gravity(sph_kernel k)
{
    return k == SPH_CUBIC_SPLINE || k == SPH_WENDLAND_C2 || k == SPH_WENDLAND_C4 || k == SPH_WENDLAND_C6;
}

/* (1/q) dphi^/dq = h^3 (1/r) dphi/dr. It is Newton's 1/q^3 beyond the support, and for kernels that have no
   gravity. Needs q >= 0, and q > 0 for the latter. */
SPH_FN sph_real sph_gravity_shape_f(sph_kernel k, sph_real q)
{
    const sph_real a = q * q;
    SPH_ASSERT(q > SPH_R(0) || (q >= SPH_R(0) && sph_kernel_has_gravity(k)));
    if (!(q < SPH_R(2)) || !sph_kernel_has_gravity(k)) return SPH_R(1) / (a * q);
    switch (k) {
    case SPH_WENDLAND_C2:
        return SPH_R(1.75) +
               a * (SPH_R(-2.625) + q * (SPH_R(2.1875) + q * (SPH_R(-0.703125) + q * SPH_R(0.08203125))));
    case SPH_WENDLAND_C4:
        return SPH_R(2.578125) +
               a * (SPH_R(-3.609375) +
                    a * (SPH_R(4.833984375) +
                         q * (SPH_R(-4.51171875) +
                              q * (SPH_R(1.8798828125) +
                                   q * (SPH_R(-0.38671875) + q * SPH_R(0.03204345703125))))));
    case SPH_WENDLAND_C6:
        return SPH_R(3.5546875) +
               a * (SPH_R(-5.865234375) +
                    a * (SPH_R(6.2841796875) +
                         a * (SPH_R(-8.553466796875) +
                              q * (SPH_R(8.7978515625) +
                                   q * (SPH_R(-4.373931884765625) +
                                        q * (SPH_R(1.221923828125) + q * (SPH_R(-0.18505096435546875) +
                                                                          q * SPH_R(0.01190185546875))))))));
    default: /* cubic spline */
        if (q < SPH_R(1)) return SPH_R(4) / SPH_R(3) + a * (SPH_R(-1.2) + q * SPH_R(0.5));
        return SPH_R(8) / SPH_R(3) + q * (SPH_R(-3) + q * (SPH_R(1.2) - q / SPH_R(6))) -
               SPH_R(1) / (SPH_R(15) * a * q);
    }
}

/* phi^ = h phi, which is negative. It is Newton's -1/q beyond the support, and for kernels that have no
   gravity. Needs q >= 0, and q > 0 for the latter. */
SPH_FN sph_real sph_gravity_shape(sph_kernel k, sph_real q)
{
    const sph_real a = q * q;
    SPH_ASSERT(q > SPH_R(0) || (q >= SPH_R(0) && sph_kernel_has_gravity(k)));
    if (!(q < SPH_R(2)) || !sph_kernel_has_gravity(k)) return SPH_R(-1) / q;
    switch (k) {
    case SPH_WENDLAND_C2:
        return SPH_R(-1.5) +
               a * (SPH_R(0.875) + a * (SPH_R(-0.65625) + q * (SPH_R(0.4375) + q * (SPH_R(-0.1171875) +
                                                                                    q * SPH_R(0.01171875)))));
    case SPH_WENDLAND_C4:
        return SPH_R(-1.71875) +
               a * (SPH_R(1.2890625) +
                    a * (SPH_R(-0.90234375) +
                         a * (SPH_R(0.8056640625) +
                              q * (SPH_R(-0.64453125) +
                                   q * (SPH_R(0.2349853515625) +
                                        q * (SPH_R(-0.04296875) + q * SPH_R(0.003204345703125)))))));
    case SPH_WENDLAND_C6:
        return SPH_R(-1.9140625) +
               a * (SPH_R(1.77734375) +
                    a * (SPH_R(-1.46630859375) +
                         a * (SPH_R(1.04736328125) +
                              a * (SPH_R(-1.069183349609375) +
                                   q * (SPH_R(0.9775390625) +
                                        q * (SPH_R(-0.4373931884765625) +
                                             q * (SPH_R(0.111083984375) +
                                                  q * (SPH_R(-0.015420913696289062) +
                                                       q * SPH_R(0.00091552734375)))))))));
    default:
        if (q < SPH_R(1)) return SPH_R(-1.4) + a * (SPH_R(2) / SPH_R(3) + a * (SPH_R(-0.3) + q * SPH_R(0.1)));
        return SPH_R(-1.6) + a * (SPH_R(4) / SPH_R(3) + q * (SPH_R(-1) + q * (SPH_R(0.3) - q / SPH_R(30)))) +
               SPH_R(1) / (SPH_R(15) * q);
    }
}

/* phi = phi^(r/h) / h. This and the next two need a kernel with sph_kernel_has_gravity. */
SPH_FN sph_real sph_gravity_potential(sph_kernel k, sph_real r, sph_real h)
{
    SPH_ASSERT(r >= SPH_R(0) && h > SPH_R(0) && sph_kernel_has_gravity(k));
    return sph_gravity_shape(k, r / h) / h;
}

/* (1/r) dphi/dr: the acceleration is -G m x_ij times it. */
SPH_FN sph_real sph_gravity_force(sph_kernel k, sph_real r, sph_real h)
{
    SPH_ASSERT(r >= SPH_R(0) && h > SPH_R(0) && sph_kernel_has_gravity(k));
    return sph_gravity_shape_f(k, r / h) / (h * h * h);
}

/* dphi/dh = -(phi^ + q dphi^/dq) / h^2 at fixed r, because phi = phi^(r/h) / h. It is 0 beyond the
   support. */
SPH_FN sph_real sph_gravity_dphidh(sph_kernel k, sph_real r, sph_real h)
{
    const sph_real q = r / h;
    SPH_ASSERT(r >= SPH_R(0) && h > SPH_R(0) && sph_kernel_has_gravity(k));
    if (!(q < SPH_R(2))) return SPH_R(0);
    return -(sph_gravity_shape(k, q) + q * q * sph_gravity_shape_f(k, q)) / (h * h);
}

/* ================================================================ names and texts
 *
 * The names of the kernels, for programs that take them from the command line, and the codes that functions
 * answer, with their meaning in words. There is no mathematics here, and there are no sources. OpenCL has the
 * codes only.
 *
 * sph_kernel_from_name also knows what other codes call these kernels. A name stands for a shape. What h
 * means differs from code to code: where it is not the h of this file, convert it first.
 *   code           its names                                                 its h
 *   Phantom        cubic, quartic, quintic, WendlandC2, -C4, -C6             h
 *   Shamrock       M4 to M8, C2, C4, C6                                      h
 *   SWIFT          cubic-, quartic-, quintic-spline, wendland-C2, -C4, -C6   support / gamma; gamma depends
 *                                                                            on kernel and dim
 *   PySPH          CubicSpline, QuinticSpline, Gaussian, SuperGaussian,      h
 *                  WendlandQuintic, -C4, -C6, and with _1D
 *   SPHinXsys      CubicBSpline, Wendland2CKernel, KernelWendlandC2,         h
 *                  QuadraticKernel (johnson-beissel)
 *   DualSPHysics   Cubic, Wendland                                           h
 *   TrixiParticles SchoenbergCubicSplineKernel, -Quartic-, -Quintic-,        h; of Poly6 and Spiky the
 *                  WendlandC2Kernel, -C4-, -C6-, GaussianKernel,             support radius
 *                  Poly6Kernel, SpikyKernel
 *   OpenSPH        cubic_spline, fourth_order_spline (M5), gaussian,         h; of Poly6 and Spiky the
 *                  core_triangle, wendland_c2, -c4, -c6, Poly6, SpikyKernel  support radius
 *   SPlisHSPlasH   Cubic spline, Wendland quintic C2, Poly6, Spiky, also     the support radius
 *                  with 2D or Precomputed, and its classes
 *   Spheral        BSplineKernel, QuinticSplineKernel, GaussianKernel,       h; of QuinticSplineKernel the
 *                  SuperGaussianKernel, WendlandC2Kernel, -C4-, -C6-         support radius
 * Some names mean different kernels in different places. Of these,
 *   quintic          is M6. Wendland's C2, of degree 5 too, is wendland-quintic.
 *   quartic          is M5, as in Phantom and SWIFT, and not the quartic of Liu & Liu.
 *   w4               is Wendland's C4, and not the W4 of Monaghan (1985, JCP 60, 253).
 *   QuarticSplineKernel is refused: in Spheral it is wendland-c2-1d. quartic-spline is M5.
 *   W4SplineKernel   is refused: in Spheral it is the W4 of Monaghan, which is not here.
 *   gaussian         is cut at 3 h and normalised for it. Codes that cut elsewhere, or normalise for no cut,
 *                    differ by up to 1e-4 W(0), and as much in the normalisation.
 */

/* -------- names and texts: types */

/* What array-level functions answer: 0, or the number of particles that are not ok, or one of these codes.
   After one of these codes nothing was written. */
typedef enum sph_error {
    SPH_ERROR_NULL = -1,     /* a pointer is null */
    SPH_ERROR_DIM = -2,      /* dim is not 1, 2 or 3, or not that of the grid */
    SPH_ERROR_KERNEL = -3,   /* no such kernel, or none for this function (gravity) */
    SPH_ERROR_COUNT = -4,    /* a number of particles that cannot be; a stride or number of bins below 1 */
    SPH_ERROR_RANGE = -5,    /* not 0 <= first <= last <= n; an end or a target that is not a particle */
    SPH_ERROR_H = -6,        /* h, a radius or a distance is not finite and positive, or extreme */
    SPH_ERROR_POSITION = -7, /* a position is not finite, or so large that the difference of two may not be;
                                ends in the wrong order */
    SPH_ERROR_VALUE = -8,    /* a value, parameter or option is not finite, or not allowed */
    SPH_ERROR_LIST = -9,     /* list rows do not ascend, or an entry is not a particle */
    SPH_ERROR_SELF = -10,    /* a row holds its own particle */
    SPH_ERROR_CAPACITY = -11, /* the caller's memory is too small: see the function for what is needed */
    SPH_ERROR_BOX = -12,    /* a box length that cannot be; a support beyond half of it; far positions */
    SPH_ERROR_PAIRS = -13   /* more pairs than sph_index can count, or memory can hold */
} sph_error;

/* What they answer for each particle, where an array of such answers is asked for. The outputs of a particle
   are 0 if it is SPH_TOO_FEW, SPH_SINGULAR, SPH_NOT_AVAILABLE or SPH_NOT_FINITE. */
typedef enum sph_status {
    SPH_OK = 0,
    SPH_TOO_FEW = 1,         /* fewer neighbours inside the support than unknowns, or too little weight */
    SPH_SINGULAR = 2,        /* the neighbours (collinear, coincident, ...) do not determine the answer */
    SPH_ILL_CONDITIONED = 3, /* computed, but the conditioning is below the caller's limit; or no h fits */
    SPH_FELL_BACK = 4,       /* computed by the fallback that the caller allowed */
    SPH_NOT_AVAILABLE = 5,   /* the operator is not defined at this particle */
    SPH_NOT_FINITE = 6,      /* the result overflowed */
    SPH_LIST_TOO_SHORT = 7   /* the list is too short for the answer; the operator says what it returns */
} sph_status;

#if !SPH_OPENCL

/* -------- names and texts: functions */

/* The name of a kernel, as "wendland-c2". */
SPH_FN const char *sph_kernel_name(sph_kernel k)
{
#define SPHI_KERNEL_NAME(unused, id, name, support, h_over_dx) \
    case id: \
        return name;
    switch (k) {
        SPH_KERNELS(SPHI_KERNEL_NAME, 0)
    case SPH_KERNEL_COUNT:
    default:
        return "unknown kernel";
    }
#undef SPHI_KERNEL_NAME
}

/* What follows in a after the name b, or null if a does not begin with it. a may have capital letters, and
   nothing, '_' or ' ' in the place of '-'. */
SPHI_LARGE const char *sphi_after_name(const char *a, const char *b)
{
    for (;; a++, b++) {
        char c = *a;
        if (c >= 'A' && c <= 'Z') c = (char)(c - 'A' + 'a');
        if (c == '_' || c == ' ') c = '-';
        if (*b == '-' && c != '-') b++;
        if (*b == '\0') return a;
        if (c != *b) return NULL;
    }
}

/* 1 if two names are equal, where a may end in "kernel". */
SPHI_LARGE int sphi_same_name(const char *a, const char *b)
{
    const char *const rest = sphi_after_name(a, b);
    const char *const end = rest && *rest != '\0' ? sphi_after_name(rest, "-kernel") : rest;
    return end && *end == '\0';
}

/* clang-format off */
#define SPHI_KERNEL_ALIASES(each) \
    each("m4", SPH_CUBIC_SPLINE) each("cubic", SPH_CUBIC_SPLINE) each("m-4-cubic", SPH_CUBIC_SPLINE) \
    each("b-spline", SPH_CUBIC_SPLINE) each("cubic-b-spline", SPH_CUBIC_SPLINE) \
    each("schoenberg-cubic-spline", SPH_CUBIC_SPLINE) each("cubic-spline-2d", SPH_CUBIC_SPLINE) \
    each("precomputed-cubic-spline", SPH_CUBIC_SPLINE) each("cubic-kernel-2d", SPH_CUBIC_SPLINE) \
    each("m5", SPH_QUARTIC_SPLINE) each("quartic", SPH_QUARTIC_SPLINE) \
    each("m-5-quartic", SPH_QUARTIC_SPLINE) each("schoenberg-quartic-spline", SPH_QUARTIC_SPLINE) \
    each("fourth-order-spline", SPH_QUARTIC_SPLINE) \
    each("m6", SPH_QUINTIC_SPLINE) each("quintic", SPH_QUINTIC_SPLINE) \
    each("m-6-quintic", SPH_QUINTIC_SPLINE) each("schoenberg-quintic-spline", SPH_QUINTIC_SPLINE) \
    each("m7", SPH_SEXTIC_SPLINE) each("sextic", SPH_SEXTIC_SPLINE) \
    each("m8", SPH_HEPTIC_SPLINE) each("heptic", SPH_HEPTIC_SPLINE) each("septic", SPH_HEPTIC_SPLINE) \
    each("septic-spline", SPH_HEPTIC_SPLINE) each("m-8-heptic", SPH_HEPTIC_SPLINE) \
    each("w2", SPH_WENDLAND_C2) each("c2", SPH_WENDLAND_C2) each("wendland", SPH_WENDLAND_C2) \
    each("wendland-2c", SPH_WENDLAND_C2) each("wendland-quintic", SPH_WENDLAND_C2) \
    each("wendland-quintic-c2", SPH_WENDLAND_C2) each("wendland-quintic-c2-2d", SPH_WENDLAND_C2) \
    each("wendland-quintic-c2-kernel-2d", SPH_WENDLAND_C2) \
    each("w4", SPH_WENDLAND_C4) each("c4", SPH_WENDLAND_C4) each("wendland-quintic-c4", SPH_WENDLAND_C4) \
    each("w6", SPH_WENDLAND_C6) each("c6", SPH_WENDLAND_C6) each("wendland-quintic-c6", SPH_WENDLAND_C6) \
    each("lucy", SPH_WENDLAND_C2_1D) each("w2-1d", SPH_WENDLAND_C2_1D) each("w4-1d", SPH_WENDLAND_C4_1D) \
    each("w6-1d", SPH_WENDLAND_C6_1D) each("wendland-quintic-c2-1d", SPH_WENDLAND_C2_1D) \
    each("wendland-quintic-c4-1d", SPH_WENDLAND_C4_1D) each("wendland-quintic-c6-1d", SPH_WENDLAND_C6_1D) \
    each("gauss", SPH_GAUSSIAN) each("liu", SPH_LIU_QUARTIC) each("quadratic", SPH_JOHNSON_BEISSEL) \
    each("read", SPH_CORE_TRIANGLE) each("ct", SPH_CORE_TRIANGLE)
/* clang-format on */

/* The kernel of a name or alias, or -1 if there is none, or name is null. Capital letters count as small
   ones, '_' and ' ' as '-', and a '-' may be left out: Wendland_C2 and WendlandC2 are wendland-c2, too.
   "kernel" before or after a name is skipped. The names of other codes stand above. */
SPH_FN int sph_kernel_from_name(const char *name)
{
#define SPHI_KERNEL_MATCH(unused, id, text, support, h_over_dx) \
    if (sphi_same_name(bare, text)) return (int)id;
#define SPHI_ALIAS_MATCH(text, id) \
    if (sphi_same_name(bare, text)) return (int)id;
    const char *bare = name ? sphi_after_name(name, "kernel-") : NULL;
    if (!bare) bare = name;
    if (!bare || sphi_same_name(bare, "quartic-spline-kernel")) return -1; /* which one is not certain */
    SPH_KERNELS(SPHI_KERNEL_MATCH, 0)
    SPHI_KERNEL_ALIASES(SPHI_ALIAS_MATCH)
    return -1;
#undef SPHI_KERNEL_MATCH
#undef SPHI_ALIAS_MATCH
}

/* What an sph_error (negative) or an sph_status (0 or positive) means. */
SPH_FN const char *sph_status_text(int status)
{
    switch (status) {
    case SPH_ERROR_NULL:
        return "a pointer is null";
    case SPH_ERROR_DIM:
        return "dim must be 1, 2 or 3, and that of the grid";
    case SPH_ERROR_KERNEL:
        return "no such kernel, or none that this function knows";
    case SPH_ERROR_COUNT:
        return "a count is negative, too large or not that of another argument, or a stride or the number "
               "of bins is below 1";
    case SPH_ERROR_RANGE:
        return "the range must obey 0 <= first <= last <= n, ends must be particles, and targets sources";
    case SPH_ERROR_H:
        return "h, a radius or a distance is not finite and positive, or too small or too large to be "
               "squared safely";
    case SPH_ERROR_POSITION:
        return "a position is not finite or too large, or the left end is not to the left of the right one";
    case SPH_ERROR_VALUE:
        return "a value or option is not finite, or not allowed";
    case SPH_ERROR_LIST:
        return "the rows of a list descend or begin below 0, or an entry of a list or permutation is no "
               "particle";
    case SPH_ERROR_SELF:
        return "a row of the list holds its own particle, and the lists of this function must not";
    case SPH_ERROR_CAPACITY:
        return "the memory is too small: a size query, or the number that was reported, says what is needed";
    case SPH_ERROR_BOX:
        return "a box length is negative, not finite or too short, a support reaches beyond half of it, a "
               "position lies more than 2^20 lengths out, or the axis must be open";
    case SPH_ERROR_PAIRS:
        return "there are more pairs than sph_index can count or memory can hold: take smaller radii, or a "
               "wider SPH_INDEX";
    case SPH_OK:
        return "ok";
    case SPH_TOO_FEW:
        return "too few neighbours, or too little weight in all of them";
    case SPH_SINGULAR:
        return "singular: the neighbours do not determine the answer";
    case SPH_ILL_CONDITIONED:
        return "ill-conditioned: computed, but the conditioning is below the limit, or no h fits exactly";
    case SPH_FELL_BACK:
        return "computed by the fallback, because what was asked for is singular, ill-conditioned or not "
               "definite";
    case SPH_NOT_AVAILABLE:
        return "the operator is not available at this particle";
    case SPH_NOT_FINITE:
        return "a result overflowed";
    case SPH_LIST_TOO_SHORT:
        return "the neighbour list does not reach far enough";
    default:
        return "unknown status";
    }
}

#endif /* !SPH_OPENCL */

SPHI_END
#endif /* SPH_KERNELS_H */

/* -------- the options are still those of the first inclusion
 *
 * Nobody calls these functions. Their types say which options this inclusion finds, so that the compiler
 * refuses the second declaration of one whose option has changed. Of the macros it is known only that they
 * were not defined. */
/* clang-format off */
#ifdef __GNUC__
#  pragma GCC diagnostic push
#  pragma GCC diagnostic ignored "-Wredundant-decls"
#endif
#ifdef __cplusplus
extern "C" {
#endif
char (*sphi_SPH_SINGLE_must_not_change_between_inclusions(void))[1 + SPH_SINGLE];
char (*sphi_SPH_SIMD_must_not_change_between_inclusions(void))[1 + SPH_SIMD];
char (*sphi_SPH_PURE_SQRT_must_not_change_between_inclusions(void))[1 + SPH_PURE_SQRT];
char (*sphi_SPH_CHECK_must_not_change_between_inclusions(void))[1 + SPH_CHECK];
SPH_INDEX sphi_SPH_INDEX_must_not_change_between_inclusions(void);
#ifdef SPHI_NO_ASSERT
char (*sphi_SPH_ASSERT_must_not_change_between_inclusions(void))[SPHI_LENGTH(SPH_ASSERT(condition))];
#endif
#ifdef SPHI_NO_REFUSED
char (*sphi_SPH_REFUSED_must_not_change_between_inclusions(void))[SPHI_LENGTH(SPH_REFUSED(a, p, e))];
#endif
#ifdef __cplusplus
}
#endif
#ifdef __GNUC__
#  pragma GCC diagnostic pop
#endif
/* clang-format on */

/*
 * MIT License
 *
 * Copyright (c) 2026 the sph.h authors
 *
 * Permission is hereby granted, free of charge, to any person obtaining a copy
 * of this software and associated documentation files (the "Software"), to deal
 * in the Software without restriction, including without limitation the rights
 * to use, copy, modify, merge, publish, distribute, sublicense, and/or sell
 * copies of the Software, and to permit persons to whom the Software is
 * furnished to do so, subject to the following conditions:
 *
 * The above copyright notice and this permission notice shall be included in all
 * copies or substantial portions of the Software.
 *
 * THE SOFTWARE IS PROVIDED "AS IS", WITHOUT WARRANTY OF ANY KIND, EXPRESS OR
 * IMPLIED, INCLUDING BUT NOT LIMITED TO THE WARRANTIES OF MERCHANTABILITY,
 * FITNESS FOR A PARTICULAR PURPOSE AND NONINFRINGEMENT. IN NO EVENT SHALL THE
 * AUTHORS OR COPYRIGHT HOLDERS BE LIABLE FOR ANY CLAIM, DAMAGES OR OTHER
 * LIABILITY, WHETHER IN AN ACTION OF CONTRACT, TORT OR OTHERWISE, ARISING FROM,
 * OUT OF OR IN CONNECTION WITH THE SOFTWARE OR THE USE OR OTHER DEALINGS IN THE
 * SOFTWARE.
 */
