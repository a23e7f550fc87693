"""A small client: a man lifts 6 kg, and we see what that asks of his shoulder.

`python client.py [ADDRESS]`, with a server running.
"""

import sys

import sinew

with sinew.Client(*sys.argv[1:2]) as client:
    crate = sinew.Load(mass_kg=6.0, segment="r_hand", start_s=1.7)
    recording = client.simulate("lift", disturbances=[crate], fields=["torque", "torque_limits"], rate_divisor=30)
    shoulder = recording.body.dof("r_shoulder_flexion")
    for time, torque, most in zip(recording.time_s, recording.torque[:, shoulder], recording.torque_upper[:, shoulder]):
        print(f"{time:.2f} s  right shoulder {torque:.1f} of {most:.1f} N·m")
    print(f"state {recording.summary.state_hash % 2**64:016x}")
