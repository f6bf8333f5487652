# SPDX-License-Identifier: MIT
# %% [markdown]
# # Lesson 1: a bar
#
# A body is a cloud of points. Each has a position $X_i$, a volume $V_i$, and a family: the points within its horizon $\delta$. A bond joins
# it to each of them. The equation of motion is Newton's second law for each point (the lecture's "Principle II"):
#
# $$\rho\, a_i = \sum_{j} f_{ij} V_j + b_i, \qquad f_{ij} = c\, s\, \mu\, n, \qquad s = \frac{|x_j - x_i| - |X_j - X_i|}{|X_j - X_i|}$$
#
# $s$ is the stretch of the bond, $n$ the direction from $i$ to $j$, $c$ the stiffness, $\mu$ is 1 until the bond breaks. There are no
# strains and no derivatives: only points that pull at each other. How do we find $c$ so that the bar is as stiff as Hooke's law says?

# %%
import matplotlib.pyplot as plt
import numpy as np

E, rho, L, A = 200e9, 7800.0, 1.0, 1e-4  # a steel bar: Young's modulus [Pa], density [kg/m^3], length [m], section [m^2]
n, m = 100, 3                            # points along the bar, and points within the horizon on each side
dx = L / n
delta = m * dx

# %% [markdown]
# Stretch the whole bar by $s$. Each bond stores $\frac12 c s^2 |\xi| \cdot \frac12$ for each end, and a point has bonds to both sides:
#
# $$W = \frac12 \int_{-\delta}^{\delta} \frac12 c\, s^2 |\xi|\, A\, d\xi = \frac14 c\, s^2 A\, \delta^2$$
#
# Hooke's law has $W = \frac12 E s^2$. They are equal where $c = 2E/(A\delta^2)$.

# %%
c = 2 * E / (A * delta**2)

# %% [markdown]
# The sum over the family is a loop over the distance $k$ in points. A cell whose centre is just at the horizon lies half within: its volume
# counts half. Displacements are small, so $n$ is along the bar and $s = (u_j - u_i)/|\xi|$.


# %%
X = (np.arange(n) + 0.5) * dx


def force(u):
    """Force density of the bonds [N/m^3] at each point."""
    f = np.zeros(n)
    for k in range(1, m + 1):
        s = (u[k:] - u[:-k]) / (k * dx)             # stretch of all bonds of this length
        V = A * dx * (0.5 if k == m else 1.0)       # volume of the neighbour within the horizon
        f[:-k] += c * s * V                         # each pulls its two ends together
        f[k:] -= c * s * V
    return f


# %% [markdown]
# Hold the left end, pull the right one by 1 kN. The equilibrium is where all forces vanish: $\sum_j f_{ij} V_j + b_i = 0$. The force is
# linear
# in $u$, so we get its matrix column by column, and solve. The load and the grip act over one horizon at each end.

# %%
K = -np.array([force(e) for e in np.eye(n)]).T
b = np.zeros(n)
b[-m:] = 1000.0 / (m * A * dx)                      # body force density: 1 kN spread over the last points
free = np.arange(m, n)                              # the first are held
u = np.zeros(n)
u[free] = np.linalg.solve(K[np.ix_(free, free)], b[free])
middle = slice(n // 4, 3 * n // 4)
strain = np.polyfit(X[middle], u[middle], 1)[0]
hooke = 1000.0 / (A * E)
print("strain in the middle: %.4e, Hooke's law F/(AE): %.4e, error %.2f %%" % (strain, hooke, 100 * abs(strain / hooke - 1)))

# %% [markdown]
# In the middle it is Hooke's law. Near the ends it is not: points there lack the neighbours beyond the end, so the bar is softer there.
# This
# is the surface effect, of which lesson 3 has more.
#
# Now the same with the library, as a strip in the plane. Bonds in the plane fix Poisson's ratio at 1/3; the stress along the strip is
# uniaxial,
# so again strain is $F/(A E)$. The library finds $c$ by itself, and `correction="moment"` gives points at surfaces their stiffness back.

# %%
import peri  # noqa: E402

with peri.Body(space="plane_stress", horizon=3 * 0.02, quadrature="partial", correction="moment") as bar:
    bar.add_material("bond_based", young=E, density=rho)
    bar.add_box([0, 0], [1, 0.2], spacing=0.02)
    bar.build()
    held = bar.select_box([0, 0], [0.06, 0.2])
    end = bar.select_box([0.94, 0], [1, 0.2])
    bar.prescribe_displacement(held, "x")
    bar.prescribe_displacement(bar.select_box([0, 0.1], [0.02, 0.12]), "y")
    bar.apply_layer_traction(end, area=0.2, value=[1000.0 / A, 0])
    report = bar.solve()
    x, v = bar.position.copy(), bar.displacement.copy()
    inner = (x[:, 0] > 0.25) & (x[:, 0] < 0.75)
    strain_library = np.polyfit(x[inner, 0], v[inner, 0], 1)[0]
    lateral = np.polyfit(x[inner, 1], v[inner, 1], 1)[0]
    print("the library: %.4e, Poisson's ratio %.3f, in %d iterations" % (strain_library, -lateral / strain_library, report.iterations))
    ax = bar.plot("displacement", component="x", deformed="auto", title="A strip, pulled: displacement along it, enlarged")
    ax.figure.savefig("out/lessons/1_strip.png")

fig, ax = plt.subplots(layout="constrained")
ax.plot(X, 1e6 * u, "o", ms=3, label="points")
ax.plot(X, 1e6 * hooke * np.maximum(X - m * dx, 0), "k-", lw=1, label="Hooke's law")
ax.set(xlabel="x [m]", ylabel="displacement [µm]", title="A bar of points, pulled by 1 kN")
ax.legend()
fig.savefig("out/lessons/1_bar.png")

# %% [markdown]
# **What you should have seen.** The strain in the middle is Hooke's to a percent, for the loop and for the library; Poisson's ratio is 1/3.
#
# **Try.** Leave the half of the outermost cell away (`V = A * dx`). Set `m = 1`: what are the bonds then? Make the bar of 10 points.

# %%
assert abs(strain / hooke - 1) < 0.01
assert abs(strain_library / hooke - 1) < 0.01 and abs(-lateral / strain_library - 1 / 3) < 0.02
