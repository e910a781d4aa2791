"""What stands above every compiled loop: functions that a compiler can work out for many poses at once."""

HEAD = '''"""Made by linkage; safe to delete."""

from math import atan2, exp, floor, inf, log, nan, sqrt, tan

import numpy as np
from numba import njit


@njit(inline="always")
def minimum(a, b):
    return a if a <= b or a != a else b


@njit(inline="always")
def maximum(a, b):
    return a if a >= b or a != a else b


@njit()  # not inlined where Numba sees branches, which a program of many choices has too many of
def pick(a, b, x, y):
    return x if a <= b else y


@njit(inline="always")
def sign(a):
    return a if a != a or a == 0.0 else (1.0 if a > 0.0 else -1.0)


# Sine and cosine, exact to a unit in the last place: the angle less quarter turns, in three parts (Cody and Waite, 1980), then
# the polynomials of fdlibm (Sun Microsystems, 1993). Nothing may be reordered here.

@njit(fastmath={"contract"})
def turned_back(a):
    k = floor(a * 0.6366197723675814 + 0.5)
    return k, ((a - k * 1.5707963267341256) - k * 6.077100506303966e-11) - k * 2.0222662487959506e-21


@njit(fastmath={"contract"})
def small_sine(r):
    z = r * r
    p = -2.50507602534068634195e-08 + z * 1.58969099521155010221e-10
    p = -1.98412698298579493134e-04 + z * (2.75573137070700676789e-06 + z * p)
    return r + r * z * (-1.66666666666666324348e-01 + z * (8.33333333332248946124e-03 + z * p))


@njit(fastmath={"contract"})
def small_cosine(r):
    z = r * r
    p = 2.08757232129817482790e-09 + z * -1.13596475577881948265e-11
    p = 2.48015872894767294178e-05 + z * (-2.75573143513906633035e-07 + z * p)
    return 1.0 - 0.5 * z + z * z * (4.16666666666666019037e-02 + z * (-1.38888888888741095749e-03 + z * p))


@njit(fastmath={"contract"})
def sine(a):
    k, r = turned_back(a)
    half = floor(k * 0.5)
    size = small_sine(r) if k - 2.0 * half == 0.0 else small_cosine(r)
    return size if half - 2.0 * floor(half * 0.5) == 0.0 else -size


@njit(fastmath={"contract"})
def cosine(a):
    k, r = turned_back(a)
    half = floor(k * 0.5)
    size = small_cosine(r) if k - 2.0 * half == 0.0 else -small_sine(r)
    return size if half - 2.0 * floor(half * 0.5) == 0.0 else -size


'''
