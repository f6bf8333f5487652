# SPDX-License-Identifier: MIT
# %% [markdown]
# # Lesson 2: waves
#
# Forces give accelerations, and accelerations move the points. The lecture takes the central difference of the displacement in time:
#
# $$\rho\, \frac{u^{t+1} - 2u^t + u^{t-1}}{\Delta t^2} = \sum_j f_{ij} V_j + b \quad\Rightarrow\quad
#   u^{t+1} = 2u^t - u^{t-1} + \frac{\Delta t^2}{\rho} \Big( \sum_j f_{ij} V_j + b \Big)$$
#
# (On the lecture's slide the density is left out.) We strike the bar of lesson 1 at its left and watch the pulse.

# %%
import matplotlib.pyplot as plt
import numpy as np

E, rho, L, A = 200e9, 7800.0, 1.0, 1e-4
n, m = 400, 3
dx = L / n
delta = m * dx
c = 2 * E / (A * delta**2)
X = (np.arange(n) + 0.5) * dx


def force(u):
    f = np.zeros(n)
    for k in range(1, m + 1):
        s = (u[k:] - u[:-k]) / (k * dx)
        V = A * dx * (0.5 if k == m else 1.0)
        f[:-k] += c * s * V
        f[k:] -= c * s * V
    return f


# %% [markdown]
# How long may the step be? Each point hangs on springs, of stiffness $c V_j/|\xi|$. The fastest motion is that of neighbours against each
# other; the frequency is at most $\omega^2 = \frac{2}{\rho}\sum_j c V_j/|\xi_j|$, and the central difference is stable for
# $\Delta t < 2/\omega$. A longer step blows up: try it.

# %%
sums = 2 * sum(c * A * dx * (0.5 if k == m else 1.0) / (k * dx) for k in range(1, m + 1))
dt = 0.8 * 2 / np.sqrt(2 * sums / rho)
print("stable step %.3g s; a wave passes a cell in %.3g s" % (dt / 0.8, dx / np.sqrt(E / rho)))

# %% [markdown]
# A smooth push at the left end, 40 µs long. The speed of a long wave in a bar is $\sqrt{E/\rho}$. Where is the pulse after 150 µs?

# %%
u, before, shots = np.zeros(n), np.zeros(n), []
where = {}
for step in range(1, int(170e-6 / dt)):
    t = step * dt
    b = np.zeros(n)
    if t < 40e-6:
        b[:m] = 1e10 * np.sin(np.pi * t / 40e-6)**2
    u, before = 2 * u - before + dt**2 / rho * (force(u) + b), u   # the formula above
    for wanted in (80e-6, 120e-6, 160e-6):
        if t <= wanted < t + dt:
            velocity = (u - before) / dt
            where[t] = np.sum(X * velocity**2) / np.sum(velocity**2)  # the middle of the pulse
            shots.append((t, velocity))
times = np.array(list(where))
speed = np.polyfit(times, list(where.values()), 1)[0]
print("speed %.0f m/s, sqrt(E/rho) %.0f m/s" % (speed, np.sqrt(E / rho)))

fig, ax = plt.subplots(layout="constrained")
for t, velocity in shots:
    ax.plot(X, velocity, label="%.0f µs" % (1e6 * t))
ax.set(xlabel="x [m]", ylabel="velocity [m/s]", title="A pulse runs along the bar")
ax.legend()
fig.savefig("out/lessons/2_bar.png")

# %% [markdown]
# In a wide plate the middle cannot give way sideways before it hears of the edges, and the wave is faster: $c_1 = \sqrt{E / (\rho (1 -
# \nu^2))}$ in plane stress, with $\nu = 1/3$. With the
# library: a plate of glass, struck for 5 µs along its left edge. `advance` finds the stable step. We follow the pulse along the middle
# line, where
# it is ahead of all that comes from the upper and lower edge.

# %%
import peri  # noqa: E402

E, rho, nu = 72e9, 2440.0, 1 / 3
plate = peri.Body(space="plane_stress", horizon=3e-3, quadrature="partial")
plate.add_material("bond_based", young=E, density=rho)
plate.add_box([0, 0], [0.2, 0.2], spacing=1e-3)
plate.build()
left = plate.select_box([0, 0], [3e-3, 0.2])


def push(time, points, value):
    value[:, 0] = 2e11 * np.sin(np.pi * time / 5e-6)**2 if time < 5e-6 else 0


plate.apply_body_force(left, [0, 0], push)
axis = np.flatnonzero(abs(plate.position[:, 1] - 0.1) < 0.6e-3)
x = plate.position[axis, 0]
places = []
for stop in (10e-6, 14e-6, 18e-6, 22e-6):
    plate.advance(duration=stop - plate.time)
    v = plate.velocity[axis, 0]
    front = v > 0.5 * v.max()
    places.append((plate.time, np.sum(x[front] * v[front]) / np.sum(v[front])))
speed_plate = np.polyfit(*np.array(places).T, 1)[0]
c1 = np.sqrt(E / (rho * (1 - nu**2)))
print("plate: speed %.0f m/s, c1 %.0f m/s, stable step %.3g s" % (speed_plate, c1, plate.stable_step))
plate.plot("velocity", component="x", title="A pulse in a plate; its edges send waves of their own").figure.savefig("out/lessons/2_plate.png")

# %% [markdown]
# **What you should have seen.** Both speeds agree with the formulas to 2 %.
#
# **Try.** `dt = 1.3 * ...` in the loop. In the plate: `plate.animate("plate.gif", field="velocity", component="x", duration=60e-6)`.

# %%
assert abs(speed / np.sqrt(200e9 / 7800) - 1) < 0.02
assert abs(speed_plate / c1 - 1) < 0.02
