"""Sinew from Python: physically simulated people, their motion and their joint torques as NumPy arrays.

    import sinew

    with sinew.Client("127.0.0.1:7463") as client, client.create_world() as world:
        anna = world.add_figure("anna", body="adult-woman")
        anna.play("lift", reset=True)
        anna.carry(6.0, "r_hand", start_s=1.7)
        recording = anna.record(4.0)
    recording.plot_torques().savefig("torques.png")

`sinew.aio` has the same for asyncio, `sinew.v1` the messages and stubs as they are. SI units throughout; x forward,
y left, z up; quaternions x, y, z, w.
"""

from sinew import aio
from sinew._client import Client, Clip, Drive, Events, Figure, Frames, Obstacle, Operation, ServerInfo, World
from sinew.body import Body, Mesh
from sinew.errors import (
    AbortedError,
    AlreadyExistsError,
    DeadlineError,
    ExpiredError,
    InvalidArgumentError,
    LimitError,
    NotFoundError,
    PermissionDeniedError,
    PreconditionError,
    SinewError,
    UnauthenticatedError,
    UnavailableError,
    UnimplementedError,
    WorldPausedError,
)
from sinew.frames import Beginning, Contact, Event, FigureState, Frame, ObstacleState, Touch
from sinew.local import serve
from sinew.motion import Motion, Pose
from sinew.recording import RECORDED, Recording, Recordings, Saturation
from sinew.values import (
    Box,
    Capsule,
    Constraint,
    Controller,
    Disturbance,
    Encoding,
    Follow,
    Force,
    Load,
    Mobility,
    Paper,
    Plane,
    Profile,
    Push,
    Shape,
    Sphere,
    Stepper,
    Strength,
)

__version__ = "0.1.0"

__all__ = [
    "RECORDED",
    "AbortedError",
    "AlreadyExistsError",
    "Beginning",
    "Body",
    "Box",
    "Capsule",
    "Client",
    "Clip",
    "Constraint",
    "Contact",
    "Controller",
    "DeadlineError",
    "Disturbance",
    "Drive",
    "Encoding",
    "Event",
    "Events",
    "ExpiredError",
    "Figure",
    "FigureState",
    "Follow",
    "Force",
    "Frame",
    "Frames",
    "InvalidArgumentError",
    "LimitError",
    "Load",
    "Mesh",
    "Mobility",
    "Motion",
    "NotFoundError",
    "Obstacle",
    "ObstacleState",
    "Operation",
    "Paper",
    "PermissionDeniedError",
    "Plane",
    "Pose",
    "PreconditionError",
    "Profile",
    "Push",
    "Recording",
    "Recordings",
    "Saturation",
    "ServerInfo",
    "Shape",
    "SinewError",
    "Sphere",
    "Stepper",
    "Strength",
    "Touch",
    "UnauthenticatedError",
    "UnavailableError",
    "UnimplementedError",
    "World",
    "WorldPausedError",
    "aio",
    "serve",
]
