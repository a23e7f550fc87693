# %% [markdown]
# # Your own motion capture
#
# Any BVH file: the server finds out which joint is which, what the unit is and where the floor is, and says so. Set
# `SINEW_BVH` to the path of your file.

# %%
import os
from pathlib import Path

import numpy as np

import sinew

path = Path(os.environ.get("SINEW_BVH", "my-capture.bvh"))
SECONDS = float(os.environ.get("SINEW_EXAMPLE_S", "5"))

# %% [markdown]
# ## Offline: what would it take?
#
# `simulate` tracks the whole file faster than real time.

# %%
with sinew.serve() as client:
    recording = client.simulate(path, body="adult-woman", duration_s=SECONDS)

report = recording.report
assert report is not None and recording.summary is not None
print(f"{len(report.mapped)} bones found; 1 unit is {report.unit_m:.4g} m; {report.up_axis} is up")
print(f"{report.source_rate_hz:.4g} Hz; a person of {report.stature_m:.2f} m, scaled by {report.scale:.3f}")
before_mm, after_mm = report.foot_slide_before_m * 1e3, report.foot_slide_after_m * 1e3
print(f"feet slid {before_mm:.0f} mm, now {after_mm:.0f} mm")
for warning in report.warnings:
    print("note:", warning)
outcome = "fell" if recording.fell_at_s else "stood"
error_deg = np.rad2deg(recording.summary.tracking_joint_rms_rad)
print(f"tracking error {error_deg:.2f}° RMS; {outcome}")

# %%
strip = recording.strip(6, title=path.stem)

# %%
plot = recording.plot_torques(title=f"Hardest joints of {path.stem}")

# %% [markdown]
# ## Live: as a capture system would
#
# `stream` sends the frames at their own pace into a running world; a jitter buffer evens out the connection. Frames of
# your own go the same way: `with figure.drive() as drive: drive.send(angles)`.

# %%
with sinew.serve() as client, client.create_world(paused=False) as world:
    anna = world.add_figure("anna", body="adult-woman")
    clip = client.upload_bvh(path, body="adult-woman")
    motion = clip.motion(body="adult-woman")
    few = int(min(SECONDS, 2.0) * motion.rate_hz)
    feedback = anna.stream(sinew.Motion(motion.angles[:few], motion.root[:few], motion.rate_hz))
    buffer = feedback.figures[0]
    print(f"{feedback.received_sequence + 1} frames arrived; {buffer.late_count} late")
    print(f"delay {buffer.playout_delay_ms:.0f} ms, jitter {buffer.jitter_ms:.1f} ms")
