"""The client for asyncio: the same classes and methods as in `sinew`, awaited.

    async with sinew.aio.Client() as client, await client.create_world() as world:
        anna = await world.add_figure("anna")
        await anna.play("wave")
        async with world.frames() as frames: ...

The arguments are the same, too.
"""

from sinew._async_client import Client, Clip, Drive, Events, Figure, Frames, Obstacle, Operation, ServerInfo, World

__all__ = ["Client", "Clip", "Drive", "Events", "Figure", "Frames", "Obstacle", "Operation", "ServerInfo", "World"]
