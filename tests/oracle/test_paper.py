"""Support ratios (2) and impacts of §3 of the paper, computed again from what they say.

Ratios on planes of any slope: by the cosines of the angles that the paper draws. Impacts: the velocity after one is the
closest to the one before, in the metric of the inertia matrix, that none of the conditions forbids; whatever satisfies
the conditions of Karush, Kuhn and Tucker is that velocity. The momentum books close, and no energy is made.
"""

from __future__ import annotations

import json
import math
import subprocess

import numpy as np
import pytest
from conftest import build, target

ROUNDING = 1e-9
# Rows of one face depend on each other: a ridge of 1e-10 keeps the system solvable; what it leaves, m/s.
SPEED = 1e-8


@pytest.fixture(scope="module")
def cases(tmp_path_factory: pytest.TempPathFactory) -> dict:
    build()
    file = tmp_path_factory.mktemp("paper") / "paper.json"
    subprocess.run([target() / "dump_paper", file, "40"], check=True)
    return json.loads(file.read_text())


def angle(a: np.ndarray, b: np.ndarray) -> float:
    return math.atan2(float(np.linalg.norm(np.cross(a, b))), float(a @ b))


def test_ratios_on_tilted_planes(cases: dict) -> None:
    """Equation (2) of the paper."""
    worst = 0.0
    for case in cases["supports"]:
        com, pull = np.array(case["com"]), np.array(case["pull"])
        alpha: dict[int, float] = {}
        for support in {c["support"] for c in case["contacts"]}:
            mine = [c for c in case["contacts"] if c["support"] == support]
            arm = com - np.mean([c["position"] for c in mine], axis=0)
            normal = np.mean([c["normal"] for c in mine], axis=0)
            lean = math.cos(angle(pull, arm)) * math.cos(angle(normal, arm))
            alpha[support] = max(0.0, float(np.linalg.norm(pull)) * lean)
        total = sum(alpha.values())
        for support, a in alpha.items():
            expected = a / total if total > 1e-9 else 1.0 / len(alpha)
            worst = max(worst, abs(case["ratio"][support] - expected))
        assert abs(sum(case["ratio"]) - 1.0) < 1e-12
    assert worst < ROUNDING, worst


def test_impacts_close_the_books_and_make_no_energy(cases: dict) -> None:
    """Section 3 of the paper."""
    pushed = 0
    for case in cases["impacts"]:
        bodies, rows = case["bodies"], case["rows"]
        mass = [np.array(b["mass_matrix"]) for b in bodies]
        before = [np.array(b["before"]) for b in bodies]
        after = [np.array(b["after"]) for b in bodies]
        given = [m @ (a - b) for m, a, b in zip(mass, after, before)]
        for row in rows:
            for body, jacobian in zip(row["bodies"], row["jacobian"]):
                if body is not None:
                    given[body] = given[body] - row["impulse"] * np.array(jacobian)
        scale = max(float(np.abs(m @ b).max()) for m, b in zip(mass, before))
        assert max(float(np.abs(g).max()) for g in given) < ROUNDING * max(1.0, scale)
        # Linear momentum and angular momentum about the world origin: rows of the pelvis, moved there.
        books = np.zeros(6)
        for m, a, b, body in zip(mass, after, before, bodies):
            wrench = (m @ (a - b))[:6]
            books[3:] += wrench[3:]
            books[:3] += wrench[:3] + np.cross(body["root"], wrench[3:])
        for row in rows:
            if None in row["bodies"]:
                force = row["impulse"] * np.array(row["normal"])
                books[3:] -= force
                books[:3] -= np.cross(row["position"], force)
        assert float(np.abs(books).max()) < ROUNDING * max(1.0, scale), books
        energy = [sum(0.5 * v @ m @ v for m, v in zip(mass, vs)) for vs in (before, after)]
        assert energy[1] <= energy[0] * (1.0 + 1e-12)
        for row in rows:
            speed = sum(np.array(j) @ after[b] for b, j in zip(row["bodies"], row["jacobian"]) if b is not None)
            if row["one_sided"]:
                assert row["impulse"] >= 0.0 and speed > -SPEED
                assert abs(row["impulse"] * speed) < 1e-6 * max(1.0, energy[0])
                pushed += row["impulse"] > 0.0
            else:
                assert abs(speed) < SPEED
    assert pushed > len(cases["impacts"]) // 2
