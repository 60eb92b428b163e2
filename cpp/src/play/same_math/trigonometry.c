/* SPDX-License-Identifier: MIT */
/* Sine, cosine and tangent from musl's kernels: zig's copy of musl has those, and not the functions themselves. */
/* For |x| <= pi/4. They are compiled into what calls them: that takes half the time of two calls. */
__attribute__((always_inline)) static inline double __sin(double x, double tail, int has_tail);
__attribute__((always_inline)) static inline double __cos(double x, double tail);

#include "__cos.c"
#include "__sin.c"

int __rem_pio2(double x, double rest[2]); /* quarter turns; in rest, what is left of x */
double __tan(double x, double tail, int is_after_a_quarter);

static int reduce(double x, double rest[2]) {
  rest[0] = x;
  rest[1] = 0;
  return fabs(x) <= 0.78539816339744830962 ? 0 : __rem_pio2(x, rest);
}

__attribute__((noinline)) static double sine_after(int quarters, const double rest[2]) {
  const double value = quarters & 1 ? __cos(rest[0], rest[1]) : __sin(rest[0], rest[1], 1);
  return quarters & 2 ? -value : value;
}

double sin(double x) {
  double rest[2];
  const int quarters = reduce(x, rest);
  return sine_after(quarters, rest);
}

double cos(double x) {
  double rest[2];
  const int quarters = reduce(x, rest);
  return sine_after(quarters + 1, rest);
}

double tan(double x) {
  double rest[2];
  const int quarters = reduce(x, rest);
  return __tan(rest[0], rest[1], quarters & 1);
}

/* To the bit as sin() and cos(). */
void sine_and_cosine(double x, double* sine, double* cosine);
void sine_and_cosine(double x, double* sine, double* cosine) {
  double rest[2];
  const int quarters = reduce(x, rest);
  const double s = __sin(rest[0], rest[1], 1), c = __cos(rest[0], rest[1]);
  const double along = quarters & 1 ? c : s, across = quarters & 1 ? s : c;
  *sine = quarters & 2 ? -along : along;
  *cosine = (quarters + 1) & 2 ? -across : across;
}

/* What compilers call where they see a sine and a cosine of one angle. */
void sincos(double x, double* sine, double* cosine) { sine_and_cosine(x, sine, cosine); }

#ifdef __APPLE__
struct both_of {
  double sine, cosine;
};

struct both_of __sincos_stret(double x);
struct both_of __sincos_stret(double x) {
  struct both_of both;
  sincos(x, &both.sine, &both.cosine);
  return both;
}
#endif
