"""A hostile client in a process of its own, for mixed.spec.ts: many calls at a time, and bodies that are no message.
Prints what it was answered, as JSON. Those who drive are on a clock and share no processor time with it but the
machine's.
"""

import argparse
import json
from concurrent.futures import ThreadPoolExecutor

import grpc
import sinew
from sinew.v1 import world_pb2

parser = argparse.ArgumentParser()
parser.add_argument("address")
parser.add_argument("world")
parser.add_argument("--token", required=True)
parser.add_argument("--ca", required=True)
args = parser.parse_args()


def call(client: sinew.Client, _: int) -> str:
    try:
        client.worlds_stub.GetWorld(world_pb2.GetWorldRequest(name=args.world))
    except sinew.SinewError as error:
        return f"{error.code.name} {error.reason}"
    except grpc.RpcError as error:
        return error.code().name
    return "nothing"


with sinew.Client(args.address, token=args.token, ca=args.ca) as client, ThreadPoolExecutor(8) as threads:
    print(json.dumps(sorted(set(threads.map(lambda i: call(client, i), range(2000))))), flush=True)
