# %% [markdown]
# # Push-recovery map
#
# How hard can one push a standing person, from each side, before they fall? For every direction we look for the largest
# push at the chest that the figure survives, by halving the interval. Each try is one call of `simulate`: no world, no
# state, nothing to clean up.

# %%
import os
from concurrent.futures import ThreadPoolExecutor

import matplotlib.pyplot as plt
import numpy as np

import sinew

DIRECTIONS = int(os.environ.get("SINEW_EXAMPLE_DIRECTIONS", "12"))
TRIES = 5
MOST_NS = 100.0


# %%
def survives(client: sinew.Client, body: str, angle: float, impulse_newton_seconds: float) -> bool:
    """Whether a standing figure that is pushed towards `angle` still stands three seconds later."""
    push = sinew.Push(
        impulse_newton_seconds=(impulse_newton_seconds * np.cos(angle), impulse_newton_seconds * np.sin(angle), 0.0),
        start_s=0.3,
    )
    r = client.simulate("idle", body=body, disturbances=[push], duration_s=3.3, fields=())
    assert r.summary is not None
    return not r.summary.HasField("fell_at_s")


def largest(client: sinew.Client, body: str, angle: float) -> float:
    """The largest push that it survives, N·s, to 1/32 of the range."""
    stands, falls = 0.0, MOST_NS
    for _ in range(TRIES):
        middle = (stands + falls) / 2
        if survives(client, body, angle, middle):
            stands = middle
        else:
            falls = middle
    return stands


# %% [markdown]
# The server computes several simulations at once, so we ask from several threads.

# %%
angles = np.arange(DIRECTIONS) * 2 * np.pi / DIRECTIONS
limits = {}
with sinew.serve() as client, ThreadPoolExecutor(2) as pool:
    for body in ("adult-man", "child"):
        found = pool.map(lambda a: largest(client, body, a), angles)
        limits[body] = np.array(list(found))

# %% [markdown]
# Forward is up. Pushes to the front and back meet a long foot, pushes to the side two feet apart.

# %%
drawing, ax = plt.subplots(figsize=(6, 6), subplot_kw={"projection": "polar"})
ax.set_theta_zero_location("N")
for (body, values), colour in zip(limits.items(), ("#1f5fa8", "#f09345")):
    closed = np.append(values, values[0])
    ax.plot(np.append(angles, angles[0]), closed, color=colour, lw=2, marker="o", ms=4, label=body)
    ax.fill(np.append(angles, angles[0]), closed, color=colour, alpha=0.12)
ax.set_xticks(np.arange(4) * np.pi / 2, ["forward", "left", "back", "right"])
ax.set_title("Largest push at the chest that is survived, N·s", pad=24)
ax.legend(loc="lower right", bbox_to_anchor=(1.08, -0.08), frameon=False)
drawing.tight_layout()

# %%
for body, values in limits.items():
    print(f"{body:10} " + "  ".join(f"{np.degrees(a):3.0f}°: {v:4.1f}" for a, v in zip(angles, values)))
