# SPDX-License-Identifier: MIT
# ---
# jupyter:
#   jupytext:
#     text_representation:
#       extension: .py
#       format_name: percent
#   kernelspec:
#     display_name: Python 3
#     language: python
#     name: python3
# ---

# %% [markdown]
# # From a cloud of points to a Laplacian
#
# Points in disorder, a field on them, and its Laplacian by four methods, with what each is worth. The module
# `sph` is that of `examples/hosts`: `python3 -m pip install .` in the root of the repository installs it.

# %%
import sys

import matplotlib.pyplot as plt
import numpy as np

import sph

# as a program with FILE.png it saves the picture there
show = len(sys.argv) < 2 or not sys.argv[1].endswith(".png")

# %% [markdown]
# ## 1. Particles
#
# SPH needs four things of you: positions, a smoothing length `h`, the volume of each particle, and who is
# near whom. On a lattice of the spacing `dx` that is moved a little, `h = 1.6 dx` and `volume = dx^2` are
# right. In your own code the volume is `m / rho`.


# %%
def cloud_of(side, jitter=0.2, kernel="wendland-c2", h_over_dx=1.6):
    """side x side particles in the unit square, displaced by up to `jitter` spacings"""
    dx = 1.0 / side
    i = np.arange(side * side)
    place = np.stack((i % side, i // side), axis=1) + 0.5
    place = place + jitter * np.random.default_rng(3).uniform(-1, 1, place.shape)
    cloud = sph.Cloud(kernel, place * dx, h=h_over_dx * dx, volume=dx * dx)
    cloud.find_lists()  # again, whenever particles have moved
    return cloud


cloud = cloud_of(24)
x, y = cloud.positions[:, 0], cloud.positions[:, 1]
print(len(x), "particles")

# %% [markdown]
# ## 2. Ask the doctor
#
# `examine` finds the mistakes that no sweep can see: a list that is too short, masses given for volumes, a
# forgotten period. It answers sentences, and none if all is well. The second cloud was never given its
# volumes:

# %%
print("findings:", cloud.examine())
mistaken = sph.Cloud("wendland-c2", cloud.positions, h=1.6 / 24, volume=1.0)
mistaken.find_lists()
for sentence in mistaken.examine():
    print("of volumes of 1:", sentence)

# %% [markdown]
# ## 3. A gradient and a Laplacian

# %%
f = np.sin(np.pi * x) * np.sin(np.pi * y)
exact = -2 * np.pi**2 * f
gradient = cloud.gradient(f)  # corrected (CSPM): exact for linear fields, also at the edge
sx, sy, cx, cy = np.sin(np.pi * x), np.sin(np.pi * y), np.cos(np.pi * x), np.cos(np.pi * y)
slope = np.pi * np.stack((cx * sy, sx * cy), axis=1)
print("largest error of the gradient: %.3f of the largest" % (abs(gradient - slope).max() / abs(slope).max()))

methods = {
    "Brookshaw": lambda c, u: c.laplacian_brookshaw(u),
    "CSPM": lambda c, u: c.derivatives_cspm(u).laplacian,
    "ICSPM": lambda c, u: c.derivatives_icspm(u, conditioning_min=0.02, fallback_wls=1).laplacian,
    "least squares": lambda c, u: c.derivatives_wls(u).laplacian,
}
inside = (abs(x - 0.5) < 0.3) & (abs(y - 0.5) < 0.3)
for name, laplacian in methods.items():
    off = abs(laplacian(cloud, f) - exact) / (2 * np.pi**2)
    print("%-14s largest error: inside %.3f, everywhere %.3f" % (name, off[inside].max(), off.max()))

# %% [markdown]
# The plain sum (Brookshaw) needs neighbours on all sides, in good order: at the edge it is wrong at any
# resolution, and in disorder it does not converge at all. Those that are exact for quadratic fields do:

# %%
sides = [12, 24, 48]
errors = {name: [] for name in methods}
for side in sides:
    finer = cloud_of(side)
    px, py = finer.positions[:, 0], finer.positions[:, 1]
    u = np.sin(np.pi * px) * np.sin(np.pi * py)
    for name, laplacian in methods.items():
        errors[name].append(np.sqrt(np.mean((laplacian(finer, u) / (2 * np.pi**2) + u) ** 2)))
for name, values in errors.items():
    order = np.log(values[1] / values[2]) / np.log(2)
    print("%-14s rms error %.3f %.3f %.3f   order %.1f" % (name, *values, order))
assert errors["ICSPM"][2] < 0.6 * errors["ICSPM"][1] < 0.36 * errors["ICSPM"][0], errors
assert errors["ICSPM"][2] < 0.2 * errors["Brookshaw"][2], errors

# %% [markdown]
# ## 4. A picture

# %%
figure, axes = plt.subplots(1, 3, figsize=(12, 3.6), constrained_layout=True)
for axis, name in zip(axes, ("Brookshaw", "ICSPM")):
    off = methods[name](cloud, f) - exact
    points = axis.scatter(x, y, c=off, s=30, cmap="RdBu", vmin=-10, vmax=10)
    axis.set_title("error of the Laplacian, " + name)
    axis.set_aspect("equal")
figure.colorbar(points, ax=axes[1])
for name, values in errors.items():
    axes[2].loglog([1 / side for side in sides], values, "o-", label=name)
axes[2].set_xlabel("spacing")
axes[2].set_ylabel("rms error / largest")
axes[2].legend()
if show:
    plt.show()
else:
    figure.savefig(sys.argv[1], dpi=80)
