# %% [markdown]
# # Lift the same crate
#
# A man, a woman and a child of ten do the same: they squat, take a crate in both hands and stand up. Nothing is tuned
# for anyone. What differs is how long their bones are, how heavy they are, and what their muscles can do.

# %%
import os

import sinew

CRATE_KG = 15.0
SECONDS = float(os.environ.get("SINEW_EXAMPLE_S", "4"))

# %% [markdown]
# A world that is paused moves only when we record, as fast as it computes, and always to the same bits. All three get
# the same clip (`lift`, prepared for each body) and the same crate, at the moment when their hands are down.

# %%
with sinew.serve() as client, client.create_world("crate", replace=True) as world:
    for place, body in enumerate(["adult-man", "adult-woman", "child"]):
        figure = world.add_figure(body.removeprefix("adult-"), body=body, position=(0.0, 1.5 * place))
        figure.play("lift", reset=True)
        figure.carry(CRATE_KG, "r_hand", "l_hand", start_s=1.7)
    recordings = world.record(SECONDS)

# %% [markdown]
# ## What they do
#
# The pale ghost is what was asked. Red rings are joints at the limit of their strength.

# %%
strip = recordings.strip(6, title=f"The same {CRATE_KG:g} kg")

# %% [markdown]
# ## What it takes
#
# The shaded band is what the muscles could give at that angle and speed. It is narrower for the child.

# %%
plot = recordings.plot_torques(
    ["waist_flexion", "r_shoulder_flexion", "r_elbow_flexion", "r_knee_flexion"],
    title=f"Torques with {CRATE_KG:g} kg",
)

# %%
for name, r in recordings.items():
    at_limit = sum(s.end_s - s.start_s for s in r.saturations())
    fate = "stands" if r.fell_at_s is None else f"falls at {r.fell_at_s:.1f} s"
    hardest = ", ".join(r.hardest(3))
    print(f"{name:6} {r.body.mass_kg:5.1f} kg: {fate}; joints at their limit for {at_limit:.1f} s; hardest: {hardest}")
