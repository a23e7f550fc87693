"""Every public name says what it is, in which unit, in which frame and of which shape."""

from __future__ import annotations

import inspect
import re
from collections.abc import Iterator
from typing import Any

import pytest

import sinew

UNIT = re.compile(
    r"(?<![\w])(m|m/s|m/s²|metres|seconds|rad|rad/s|rad/s²|s|ms|ns|Hz|kg|N|N·m|N·s|degrees|factor|ticks?|bits"
    r"|coefficient|counts?|share|0 to 1|relative)(?![\w])"
)
SHAPE = re.compile(r"\(\s*(n|\d+)(, ?(n|m|\d+))*,?\s*\)")
# Numbers whose names end in their unit.
SUFFIX = re.compile(r"_(s|m|ms|ns|hz|kg|newtons|newton_seconds|deg|mps)$")
# Numbers that count something or choose rows.
COUNTS = {"count", "row", "tick", "resume_tick", "rate_divisor", "tick_count", "substeps", "state_hash"}


def members() -> Iterator[tuple[str, Any]]:
    """Public classes and functions, and what is public of the classes."""
    for name in sinew.__all__:
        value = getattr(sinew, name)
        if not (inspect.isclass(value) or inspect.isfunction(value)) or name in ("aio",):
            continue
        yield name, value
        if inspect.isclass(value) and not issubclass(value, BaseException):
            for inner, member in vars(value).items():
                if not inner.startswith("_") and (callable(member) or hasattr(member, "__get__")):
                    yield f"{name}.{inner}", member


def is_documented(m: Any) -> bool:
    """A class, a function, a property or a cached one; not a constant."""
    return inspect.isclass(m) or inspect.isfunction(m) or isinstance(m, property) or hasattr(m, "func")


MEMBERS = {name: m for name, m in members() if is_documented(m)}
VALUES = ["Load", "Push", "Force", "Constraint", "Profile", "Strength", "Sphere", "Capsule", "Box", "Pose", "Motion"]


def function(member: Any) -> Any:
    """The function behind a property, cached property or method."""
    return getattr(member, "fget", None) or getattr(member, "func", None) or member


@pytest.mark.parametrize("name", MEMBERS)
def test_it_has_a_docstring(name: str) -> None:
    assert inspect.getdoc(function(MEMBERS[name])), name


@pytest.mark.parametrize("name", [n for n, m in MEMBERS.items() if not inspect.isclass(m)])
def test_arrays_have_a_unit_and_a_shape(name: str) -> None:
    f = function(MEMBERS[name])
    if re.search("Floats|float64", str(inspect.signature(f).return_annotation)):
        text = " ".join((inspect.getdoc(f) or "").split())
        assert SHAPE.search(text), text
        assert UNIT.search(text) or "quaternion" in text.lower(), text


@pytest.mark.parametrize("name", [n for n, m in MEMBERS.items() if not inspect.isclass(m)])
def test_numbers_that_go_in_have_a_unit(name: str) -> None:
    """Of every parameter that is a number or a vector, unless it counts something, the docstring tells the unit by
    name.
    """
    f = function(MEMBERS[name])
    text = inspect.getdoc(f) or ""
    for key, parameter in inspect.signature(f).parameters.items():
        kind = str(parameter.annotation)
        if not re.search(r"\bfloat\b|Vector|ArrayLike|Floats", kind) or key in COUNTS:
            continue
        # A call may refer to another one, which is checked itself.
        elsewhere = re.search(r"as (in )?`", text, re.IGNORECASE)
        assert UNIT.search(text) or elsewhere, f"{name}({key}): {text}"
        assert SUFFIX.search(key) or f"`{key}`" in text or key == "pose" or elsewhere, f"{name}({key}): {text}"


@pytest.mark.parametrize("name", VALUES)
def test_values_explain_every_number(name: str) -> None:
    """Fields of the values that calls take: named in the docstring of the class, which has units, or documented
    themselves.
    """
    value = getattr(sinew, name)
    text = inspect.getdoc(value) or ""
    source = inspect.getsource(value)
    for key, kind in value.__annotations__.items():
        if not re.search(r"float|Vector|ArrayLike|Floats", str(kind)):
            continue
        documented = re.search(rf"^    {key}: .*\n    \"\"\"", source, re.MULTILINE)
        assert documented or f"`{key}`" in text or SUFFIX.search(key), f"{name}.{key}"
    assert UNIT.search(text), text


@pytest.mark.parametrize(
    ("name", "says"),
    [
        ("Figure.push", "N·s"),
        ("Figure.push", "world axes"),
        ("Figure.carry", "palm"),
        ("Figure.carry", "kg"),
        ("World.add_figure", "rad"),
        ("World.add_obstacle", "quaternion x, y, z, w"),
        ("Client.create_world", "m/s²"),
        ("Client.upload_bvh", "Hz"),
        ("FigureState.velocity", "world axes"),
        ("FigureState.root_pose", "(7,)"),
        ("Body.angle_limits", "rad"),
    ],
)
def test_what_users_asked_for(name: str, says: str) -> None:
    assert says in (inspect.getdoc(function(MEMBERS[name])) or "")
