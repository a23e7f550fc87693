"""Client of Sinew, a server of physically simulated human figures.

    import sinew
    with sinew.serve() as client:                       # or sinew.Client("host:7463")
        recording = client.simulate("lift", disturbances=[sinew.Load(mass_kg=12, start_s=1.7)])
    recording.plot_torques("torques.png")

SI units; x forward, y left, z up; quaternions x, y, z, w. `sinew.aio` is the same for asyncio; `sinew.v1` has the messages.
"""

from sinew.body import Body, Segment
from sinew.calls import Feedback, ServerInfo
from sinew.client import Client, Drive, Figure, World
from sinew.errors import (
    AbortedError,
    AlreadyExistsError,
    DeadlineError,
    ExpiredError,
    InvalidArgumentError,
    LimitError,
    NotFoundError,
    PreconditionError,
    SinewError,
    UnavailableError,
    UnimplementedError,
)
from sinew.frame import Audit, Balance, CarriedLoad, Contacts, Desired, Event, FigureFrame, Frame
from sinew.motion import Clip, Motion
from sinew.recording import Recording
from sinew.serving import serve
from sinew.values import Force, Load, Profile, Push, Strength

__version__ = "0.1.0"

__all__ = [
    "AbortedError",
    "AlreadyExistsError",
    "Audit",
    "Balance",
    "Body",
    "CarriedLoad",
    "Client",
    "Clip",
    "Contacts",
    "DeadlineError",
    "Desired",
    "Drive",
    "Event",
    "ExpiredError",
    "Feedback",
    "Figure",
    "FigureFrame",
    "Force",
    "Frame",
    "InvalidArgumentError",
    "LimitError",
    "Load",
    "Motion",
    "NotFoundError",
    "PreconditionError",
    "Profile",
    "Push",
    "Recording",
    "Segment",
    "ServerInfo",
    "SinewError",
    "Strength",
    "UnavailableError",
    "UnimplementedError",
    "World",
    "serve",
]
