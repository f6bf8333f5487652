# SPDX-License-Identifier: MIT
# %% [markdown]
# # Lesson 6: branching
#
# A crack in glass that is pulled hard enough speeds up, and splits in two. Nothing in the equation says so: there is only
#
# $$\rho\, a_i = \sum_j c\, s\, \mu\, n\, V_j + b_i, \qquad \mu = 0 \text{ for good once } s > s_c .$$
#
# The scene is that of many papers: a pane of soda-lime glass, 100 x 40 mm, notched from its left edge to the middle, pulled up and down by
# 2 MPa on its long edges from $t = 0$ on. `record_breaks` keeps when bonds break, so that the library can tell how fast a tip runs.

# %%
import matplotlib.pyplot as plt
import numpy as np

import peri

E, rho, G0, nu = 72e9, 2440.0, 3.8, 1 / 3
dx = 0.5e-3
pane = peri.Body(space="plane_stress", horizon=3 * dx)
pane.add_material("bond_based", young=E, density=rho, fracture_energy=G0)
pane.add_box([0, 0], [0.1, 0.04], dx)
pane.build()
pane.cut_segment([0, 0.02], [0.05, 0.02])
pane.record_breaks(1)
for name, y, up in (("top", 0.04 - dx, 2e6), ("bottom", 0, -2e6)):
    rows = pane.select_box([0, y], [0.1, y + dx], name)
    pane.apply_layer_traction(rows, area=0.1, value=[0, up])
    pane.set_no_fail(rows, 1)

# %% [markdown]
# Waves from the long edges need $0.02\,\text{m}/c_1 \approx 3.5$ µs to the notch. `animate` advances the body and keeps its frames.

# %%
ledger = []
pane.animate("out/lessons/6_branching.gif", duration=42e-6, frames=21, dpi=70, title="damage",
             on_frame=lambda body: ledger.append((body.time, body.broken_count, body.get_energy().asdict())))

# %% [markdown]
# How fast does a crack run? No faster than Rayleigh waves along its faces, $c_R \approx c_s\,(0.862 + 1.14\nu)/(1 + \nu)$, with
# $c_s = \sqrt{\mu/\rho}$; in experiments glass branches at about half of that or a little more. We take the rightmost point that the crack
# has
# reached at each time, from the times at which bonds broke.

# %%
cracks = pane.cracks(initial=0)
start, vertex, when, tips = cracks.get()
grown = np.flatnonzero(np.isfinite(when))
order = grown[np.argsort(when[grown])]
t, x = when[order], np.maximum.accumulate(vertex[order, 0])
times = np.linspace(t[0], t[-1], 12)
reached = np.interp(times, t, x)
speed = np.diff(reached) / np.diff(times)
cs = np.sqrt(E / (2 * (1 + nu)) / rho)
cR = cs * (0.862 + 1.14 * nu) / (1 + nu)
print("the crack starts after %.1f µs; its speed is %.0f m/s at most, Rayleigh waves' %.0f m/s: ratio %.2f" % (
    1e6 * t[0], speed.max(), cR, speed.max() / cR))

# %% [markdown]
# Where does it split? Broken bonds near $y = 0.02$ alone are one crack. Take at each $x$ the least and the greatest $y$ of the crack:
# where they are
# more than two horizons apart, there are two branches.

# %%
columns = np.arange(0.05, 0.1, 2 * dx)
spread = np.array([np.ptp(vertex[grown, 1][abs(vertex[grown, 0] - c) < 2 * dx]) if np.any(abs(vertex[grown, 0] - c) < 2 * dx) else 0
                   for c in columns])
split = columns[np.argmax(spread > 6 * dx)]
below = vertex[grown][(vertex[grown, 0] > split) & (vertex[grown, 1] < 0.02)]
above = vertex[grown][(vertex[grown, 0] > split) & (vertex[grown, 1] > 0.02)]
print("it splits at x = %.3f m; %d vertices below, %d above; %d fragments" % (split, len(below), len(above), pane.find_fragments()[0]))

fig, (left, right) = plt.subplots(1, 2, figsize=(10, 4), layout="constrained")
left.plot(1e6 * (times[1:] + times[:-1]) / 2, speed, "o-")
left.axhline(cR, color="k", lw=0.8)
left.text(1e6 * times[1], cR, "Rayleigh", va="bottom")
left.set(xlabel="time [µs]", ylabel="speed of the crack [m/s]", ylim=(0, 1.15 * cR), title="It speeds up, and splits")
for name in ("kinetic", "elastic", "fracture"):
    right.plot([1e6 * e[0] for e in ledger], [e[2][name] for e in ledger], label=name)
right.set(xlabel="time [µs]", ylabel="energy [J/m]", title="Where the energy goes")
right.legend()
fig.savefig("out/lessons/6_speed.png")
pane.plot("damage", cracks=True, title="42 µs: two branches").figure.savefig("out/lessons/6_branching.png")

# %% [markdown]
# What work the edges did is kinetic, elastic, or went with broken bonds. The ledger says what is missing.

# %%
e = pane.get_energy()
print("work %.3f J/m = kinetic %.3f + elastic %.3f + fracture %.3f + error %.4f" % (e.external, e.kinetic, e.elastic, e.fracture, e.error))

# %% [markdown]
# **What you should have seen.** A crack that starts after some ten microseconds, runs at no more than Rayleigh's speed, and splits; the
# two branches
# are mirror images, for nothing in the scene is not. The ledger closes to a percent.
#
# **Try.** 1 MPa, and 4 MPa. Half the spacing: does the crack split at the same place? `precision="single"` is twice as fast.

# %%
assert 5e-6 < t[0] < 20e-6 and 0.3 < speed.max() / cR < 1.1
assert 0.055 < split < 0.085 and len(below) > 20 and abs(len(below) - len(above)) < 0.1 * len(above)
assert abs(e.error) < 0.01 * e.external
