# SPDX-License-Identifier: MIT
# %% [markdown]
# # Lesson 3: the horizon
#
# The horizon $\delta$ is a length that classical mechanics does not have. What is much longer than $\delta$ moves as in the classical
# theory. What is shorter does not: short waves are slower. This is called dispersion. Let a plane wave $u = \sin(\kappa x)$ run through a
# plate.
# A bond of length $r$ in the direction $\theta$ has the stretch $(u_j - u_i)\cos\theta / r$, and pulls by $c$ times that, along
# itself. Summed over the family, and with $\cos\kappa r \cos\theta$ from the sum of both sides,
#
# $$\omega^2 = \frac{c}{\rho} \int_0^{2\pi} \int_0^{\delta} \frac{\cos^2\theta\,\big(1 - \cos(\kappa r \cos\theta)\big)}{r}\; r\, dr\,
# d\theta,
#   \qquad c = \frac{9E}{\pi\delta^3}$$
#
# (plane stress, thickness 1; the constant is found as in lesson 1).

# %%
import matplotlib.pyplot as plt
import numpy as np

import peri

E, rho, nu, delta = 72e9, 2440.0, 1 / 3, 1.0
c = 9 * E / (np.pi * delta**3)


def speed(kappa):
    """omega / kappa [m/s], by the integral above: midpoints of 200 x 200 pieces."""
    r = (np.arange(200) + 0.5) / 200 * delta
    theta = (np.arange(200)[:, None] + 0.5) / 200 * 2 * np.pi
    integrand = np.cos(theta)**2 * (1 - np.cos(kappa * r * np.cos(theta)))
    return np.sqrt(c / rho * integrand.sum() * delta / 200 * 2 * np.pi / 200) / kappa


# %% [markdown]
# The library tells the forces at any displacement: `evaluate`. In a wave the force density is $-\rho\,\omega^2 u$. We read it at the
# middle of a
# plate, more than a horizon away from the edges.

# %%
plate = peri.Body(space="plane_stress", horizon=delta, quadrature="partial", geometry="linear", threads=1)
glass = plate.add_material("bond_based", young=E, density=rho)
plate.add_box([-2, -2], [2, 2], spacing=delta / 6)
plate.build()
print("c by the formula %.6g, by the library %.6g" % (c, plate.get_bond_constants(glass, glass)[0]))
x = plate.position.copy()
middle = np.flatnonzero(np.abs(x).max(axis=1) < 0.2)
force = np.zeros_like(x)


def speed_of_points(kappa):
    u = np.zeros_like(x)
    u[:, 0] = np.cos(kappa * x[:, 0])
    plate.evaluate(displacement=u, force=force)
    omega2 = -(force[middle, 0] @ u[middle, 0]) / (rho * (u[middle, 0] @ u[middle, 0]))
    return np.sqrt(omega2) / kappa


c1 = np.sqrt(E / (rho * (1 - nu**2)))   # of the classical plate
waves = np.array([1.5, 2, 3, 4, 6, 8, 12, 20, 40])
integral = np.array([speed(2 * np.pi / w) for w in waves])
points = np.array([speed_of_points(2 * np.pi / w) for w in waves])
for w, a, b in zip(waves, integral, points):
    print("wavelength %4.1f horizons: %.3f of c1 by the integral, %.3f by points" % (w, a / c1, b / c1))
fig, ax = plt.subplots(layout="constrained")
fine = np.geomspace(1.2, 40, 80)
ax.semilogx(fine, [speed(2 * np.pi / w) / c1 for w in fine], "k-", label="integral")
ax.semilogx(waves, points / c1, "o", label="points, 6 to a horizon")
ax.axhline(1, color="grey", lw=0.8)
ax.set(xlabel="wavelength / horizon", ylabel="speed / c1", title="Waves shorter than a few horizons are slow")
ax.legend()
fig.savefig("out/lessons/3_dispersion.png")

# %% [markdown]
# The other thing that a length does: edges have a thickness. A point at an edge lacks half of its family. Stretch the plate by the same
# strain
# everywhere, $u_x = 10^{-3} x$. The energy density should be the same everywhere. It is not, in a layer one horizon deep; at the very edge
# half of it is missing. `correction="moment"` gives the bonds that are there more weight, as little as makes the plate as a whole as stiff
# as it is.


# %%
def energies(**options):
    body = peri.Body(space="plane_stress", horizon=delta, quadrature="partial", geometry="linear", threads=1, **options)
    body.add_material("bond_based", young=E, density=rho)
    body.add_box([0, 0], [4, 4], spacing=delta / 6)
    body.build()
    body.displacement = 1e-3 * body.position[:, [0, 0]] * [1, 0]
    row = np.flatnonzero(abs(body.position[:, 1] - 2 - delta / 12) < 0.01)   # from the left edge to the right one
    return body.position[row, 0], body.energy_density[row]


whole = 0.5 * E / (1 - nu**2) * 1e-6           # of the classical plate, eps_yy = 0
depth, raw = energies()
_, weighed = energies(correction="moment")
fig, ax = plt.subplots(layout="constrained")
ax.plot(depth, raw / whole, "o-", ms=3, label="as summed")
ax.plot(depth, weighed / whole, "s-", ms=3, label='correction="moment"')
ax.set(xlabel="distance from the left edge / horizon", ylabel="energy density / classical", title="The surface effect")
ax.legend()
fig.savefig("out/lessons/3_surface.png")
print("energy density over the classical one: middle %.3f, first point %.3f; mean from edge to edge %.3f as summed, %.3f weighed" % (
    raw[len(raw) // 2] / whole, raw[0] / whole, raw.mean() / whole, weighed.mean() / whole))

# %% [markdown]
# **What you should have seen.** Points follow the integral, and it tends to 1 for long waves; at a wavelength of two horizons some tenth
# or more of the speed is
# lost. At the edge half of the energy is missing. The correction brings it back: not point by point, but from edge to edge.
#
# **Try.** `influence="linear"` gives far neighbours less weight: is there more dispersion, or less?

# %%
assert np.all(np.abs(points / integral - 1)[waves >= 2] < 0.02) and abs(points[-1] / c1 - 1) < 0.02
assert points[1] / c1 < 0.9
assert abs(raw[len(raw) // 2] / whole - 1) < 0.02 and 0.45 < raw[0] / whole < 0.6
assert raw.mean() / whole < 0.9 and abs(weighed.mean() / whole - 1) < 0.01
