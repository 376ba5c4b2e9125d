// Elementary functions that give the same bits on every x86-64 processor. Those of the C library do not: it
// selects code by the processor, with or without fused products. Here only the four operations and
// roots of extended precision (64 bits of mantissa) are used, and the result is rounded once: within 0.51
// units in the last place, of pow within 0.9. Slower than the C library: for what is computed once or
// seldom. (cbrt and hypot of the GNU C library have one code for all processors.)
#pragma once

namespace platen::portable {

double exp(double x);
double log(double x);           // -inf of 0, NaN below
double pow(double x, double y); // x >= 0; NaN below
// rad. An |angle| above 1e7 is first reduced by 2 pi in double precision: bounded, but not accurate.
double sin(double angle);
double cos(double angle);
double tan(double angle);
double acos(double x);            // NaN outside [-1, 1]
double atan2(double y, double x); // 0 for (0, 0)
double gamma(double x);           // x >= 1; NaN below, infinite above 171.7

} // namespace platen::portable
