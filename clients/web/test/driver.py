"""A driver in Python, for mixed.spec.ts: takes the lease of a figure, lets it walk, and offers it to someone else in
the middle of a step. What it does and what it is told, it prints as JSON, a line each.
"""

import argparse
import json
import time

from google.protobuf import json_format

import sinew
from sinew.v1 import control_pb2

parser = argparse.ArgumentParser()
parser.add_argument("address")
parser.add_argument("world")
parser.add_argument("figure")
parser.add_argument("recording", help="a BVH file of somebody who walks")
parser.add_argument("--token", required=True)
parser.add_argument("--ca", required=True)
parser.add_argument("--to", required=True, help="who gets the lease")
parser.add_argument("--after", type=float, required=True, help="when it is offered, s")
parser.add_argument("--window-ms", type=float, required=True)
parser.add_argument("--playout-ms", type=float, required=True)
parser.add_argument("--frames", required=True, help="file that the motion is written to, as the other driver sends it")
args = parser.parse_args()


def say(**what: object) -> None:
    print(json.dumps(what), flush=True)


with sinew.Client(args.address, token=args.token, ca=args.ca) as client:
    motion = client.upload_bvh(args.recording, name="cleo-walk").motion()
    with open(args.frames, "w") as file:
        json.dump([json_format.MessageToDict(motion.pose(i).message()) for i in range(len(motion))], file)
    world = client.world(args.world)
    figure = f"{world.resource}/figures/{args.figure}"
    lease = client.control_stub.AcquireControl(control_pb2.AcquireControlRequest(figure=figure))
    say(lease=lease.lease.holder)
    offered = False
    try:
        with world.drive(
            args.figure,
            rate_hz=motion.rate_hz,
            window_ms=args.window_ms,
            playout_delay_ms=args.playout_ms,
            reset=True,
            control_tokens=[lease.control_token],
        ) as drive:
            # From now on frames leave when they are due: who takes over reckons by it where the walk is.
            began = time.monotonic()
            say(began=time.time())
            for i in range(len(motion)):
                t = i / motion.rate_hz
                time.sleep(max(began + t - time.monotonic(), 0.0))
                drive.send(motion.pose(i), time_s=t)
                if not offered and t >= args.after:
                    offered = True
                    offer = control_pb2.TransferControlRequest(
                        figure=figure, control_token=lease.control_token, to=args.to
                    )
                    say(offer=client.control_stub.TransferControl(offer).offer_token)
    except sinew.SinewError as error:
        say(ended=error.reason)
    else:
        say(ended="")
