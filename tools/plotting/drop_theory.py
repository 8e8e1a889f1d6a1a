# SPDX-License-Identifier: BSD-3-Clause
"""Small oscillations of a viscous drop in vacuum: the exact dispersion relation of the mode l.

exp(-sigma t), q^2 = sigma R^2/nu, Q = J_{l+3/2}(q) / J_{l+1/2}(q), Oh = mu/sqrt(rho gamma R):

    l (l-1) (l+2) / (Oh^2 q^4) = 2 (l^2-1)/(q^2 - 2 q Q) - 1 + 2 l (l-1)/q^2 [1 - (l+1) Q/(q/2 - Q)]

(RKPM note 7).
"""

import cmath
import math


def bessel_ratio(order, q):
    """J_{order+1}(q) / J_order(q) by its continued fraction, from the tail up."""
    terms = int(abs(q)) + 40
    ratio = 0
    for k in range(terms, 0, -1):
        ratio = 1 / (2 * (order + k) / q - ratio)
    return ratio


def mismatch(x, ohnesorge, mode):
    """Left minus right side of the relation, times q^4, at x = sigma R^2/nu = q^2."""
    q = cmath.sqrt(x)
    Q = bessel_ratio(mode + 0.5, q)
    right = 2 * (mode**2 - 1) / (x - 2 * q * Q) - 1
    right += 2 * mode * (mode - 1) / x * (1 - (mode + 1) * Q / (q / 2 - Q))
    return mode * (mode - 1) * (mode + 2) / ohnesorge**2 - x * x * right


def secant(f, a, b):
    """A root near a and b; real if a, b and the values of f are real."""
    fa, fb = f(a), f(b)
    for _ in range(100):
        if fa == fb or abs(b - a) <= 1e-15 * abs(b):
            break
        a, b = b, b - fb * (b - a) / (fb - fa)
        fa, fb = fb, f(b)
    return b


def slow_real_root(ohnesorge, mode):
    """The smallest real root, by bisection; None if the drop is underdamped."""

    def f(x):
        return mismatch(x, ohnesorge, mode).real

    # The root lies below the first pole, at q of about l + 3.
    places = [1e-9 + 4 * mode**2 * k / 4000 for k in range(4000)]
    bracket = next(((a, b) for a, b in zip(places, places[1:]) if f(a) > 0 >= f(b)), None)
    if bracket is None:
        return None
    low, high = bracket
    for _ in range(200):
        middle = (low + high) / 2
        if middle in (low, high):
            break
        low, high = (middle, high) if f(middle) > 0 else (low, middle)
    return high


def slow_rate(ohnesorge, mode=2):
    """sigma T with T = sqrt(rho R^3/gamma): real if overdamped, otherwise the root with Im > 0."""
    root = slow_real_root(ohnesorge, mode)
    if root is None:
        root = oscillating_root(ohnesorge, mode)
    return root * ohnesorge


def oscillating_root(ohnesorge, mode):
    """Follows the root from weak damping, where Lamb's formulas hold, up to `ohnesorge`."""
    omega = math.sqrt(mode * (mode - 1) * (mode + 2))
    damping = (mode - 1) * (2 * mode + 1)
    current = min(0.02, ohnesorge)
    x = complex(damping, omega / current)
    while True:
        x = secant(lambda y: mismatch(y, current, mode), x, x * (1 + 1e-4))
        if current >= ohnesorge:
            return x
        following = min(1.03 * current, ohnesorge)
        x = complex(x.real, x.imag * current / following)
        current = following
