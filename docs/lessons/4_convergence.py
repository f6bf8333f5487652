# SPDX-License-Identifier: MIT
# %% [markdown]
# # Lesson 4: two ways to converge
#
# There are two lengths: the spacing $\Delta x$ of the points and the horizon $\delta$. Their ratio is $m = \delta/\Delta x$. So there are
# two ways
# to refine:
#
# - **m-convergence**: $\delta$ stays, $\Delta x \to 0$. The sum over the family tends to its integral: to the nonlocal theory.
# - **$\delta$-convergence**: $m$ stays, $\delta \to 0$. The nonlocal theory tends to the classical one. What $m$ leaves open stays.
#
# The test is a displacement $u_x = \cos(\kappa x)$ with the wavelength 1. The classical force density at its crest is
#
# $$f = -\frac{E}{1 - \nu^2}\, \kappa^2 u, \qquad\text{and the nonlocal one}\qquad
#   f_\delta = -c \int_0^{2\pi}\!\!\int_0^\delta \cos^2\theta\, \big(1 - \cos(\kappa r\cos\theta)\big)\, dr\, d\theta .$$

# %%
import matplotlib.pyplot as plt
import numpy as np

import peri

E, nu, kappa = 1.0, 1 / 3, 2 * np.pi
classical = E / (1 - nu**2) * kappa**2


def nonlocal_force(delta):
    r = (np.arange(300) + 0.5) / 300 * delta
    theta = (np.arange(300)[:, None] + 0.5) / 300 * 2 * np.pi
    integrand = np.cos(theta)**2 * (1 - np.cos(kappa * r * np.cos(theta)))
    return 9 * E / (np.pi * delta**3) * integrand.sum() * delta / 300 * 2 * np.pi / 300


# %% [markdown]
# A patch of a few horizons around the crest is enough: no point there hears of the rest. The family holds cells that the horizon cuts: with
# `quadrature="full"` a cell counts whole if its centre is within, else not at all; with `"partial"` its part within counts.


# %%
def force(delta, m, quadrature):
    """Minus the force density at the crest."""
    dx = delta / m
    body = peri.Body(space="plane_stress", horizon=delta * (1 + 1e-9), quadrature=quadrature, geometry="linear", threads=1)
    body.add_material("bond_based", young=E, density=1)
    half = (int(1.5 * m) + 0.5) * dx                     # an odd number of cells: one has its centre at 0
    body.add_box([-half, -half], [half, half], spacing=dx)
    body.build()
    u = np.cos(kappa * body.position[:, [0, 0]]) * [1, 0]
    f = np.zeros_like(u)
    body.evaluate(displacement=u, force=f)
    return -f[body.find_point([0, 0]), 0]


delta = 0.25
ms = np.array([2, 3, 4, 6, 8, 12, 16])
m_error = {q: np.array([abs(force(delta, m, q) / nonlocal_force(delta) - 1) for m in ms]) for q in ("full", "partial")}
deltas = 0.5 / 2.0**np.arange(6)
d_error = {m: np.array([abs(force(d, m, "partial") / classical - 1) for d in deltas]) for m in (3, 6)}
exact = np.array([abs(nonlocal_force(d) / classical - 1) for d in deltas])
for m, a, b in zip(ms, m_error["full"], m_error["partial"]):
    print("m = %2d: against the nonlocal force %.2e (full), %.2e (partial)" % (m, a, b))
for d, a, b, e in zip(deltas, d_error[3], d_error[6], exact):
    print("delta = %.4f: against the classical force %.2e (m = 3), %.2e (m = 6), %.2e (integral)" % (d, a, b, e))

fig, (left, right) = plt.subplots(1, 2, figsize=(9, 4), layout="constrained")
for q, errors in m_error.items():
    left.loglog(ms, errors, "o-", label=q)
left.set(xlabel="m", ylabel="error against the nonlocal force", title="m-convergence, horizon 1/4")
left.legend(title="quadrature")
right.loglog(deltas, exact, "k-", label="integral")
for m, errors in d_error.items():
    right.loglog(deltas, errors, "o-", label="m = %d" % m)
right.set(xlabel="horizon", ylabel="error against the classical force", title="delta-convergence")
right.legend()
fig.savefig("out/lessons/4_convergence.png")

# %% [markdown]
# The integral converges as $\delta^2$. This can be read from $1 - \cos z = z^2/2 - z^4/24$: the first term is the classical force, the
# second one is
# $\kappa^2\delta^2$ smaller.

# %%
order = np.log2(exact[:-1] / exact[1:])
print("order of the integral in delta:", np.round(order, 2))

# %% [markdown]
# **What you should have seen.** With whole cells the error jumps up and down with $m$, for cells enter and leave the family as wholes; with
# partial cells it falls. In $\delta$ the error first falls as $\delta^2$; the sum with this $m$ is a little too stiff, so it passes zero,
# and stays at what that sum is wrong by. A small horizon is no
# help if $m$ is too small: this is why 3 to 4 spacings are usual, with partial cells.
#
# **Try.** Another influence function: `influence="linear"` in `peri.Body` needs another $c$; the library finds it.

# %%
assert abs(order[-1] - 2) < 0.1
assert m_error["partial"][-1] < 0.25 * m_error["partial"][0] and m_error["partial"][-1] < 0.005
assert d_error[6][-1] < d_error[6][0] / 10 and d_error[6][-1] < 0.02
