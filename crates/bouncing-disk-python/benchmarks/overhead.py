"""What Python adds: a basin of 1,000 x 1,000 starts beside the same in Rust, and one toss.

    cargo build --release -p bouncing-disk-python --example overhead
    python crates/bouncing-disk-python/benchmarks/overhead.py target/release/examples/overhead

Both run alternately, 20 rounds; the least times are compared. It counts as slower only where it exceeds what
the Rust program shows against itself in the same way.
"""

from __future__ import annotations

import subprocess
import sys
import time
import timeit
from pathlib import Path

import bouncing_disk as bd

ROUNDS = 20


def in_rust(program: Path) -> float:
    """The least of five basins in a process of its own (s)."""
    return float(subprocess.run([program], check=True, capture_output=True, text=True).stdout)


def in_python() -> float:
    """The least of five basins here (s)."""
    bouncing = bd.ImpactMap(axial_forcing=0.45, restitution=0.5)
    orbit = bouncing.settled_orbit(impact_phase=1.2, normalised_speed=1.3)
    assert orbit is not None
    radius = orbit.trapping_radius(bouncing)
    times = []
    for _ in range(5):
        began = time.perf_counter()
        bd.basins(bouncing, phases=1000, speeds=1000, speed_range=(0.0, 3.0), known_orbits=[(orbit, radius)])
        times.append(time.perf_counter() - began)
    return min(times)


def main() -> None:
    """Compares and prints."""
    program = Path(sys.argv[1])
    rust, again, python = [], [], []
    for _ in range(ROUNDS):
        rust.append(in_rust(program))
        python.append(in_python())
        again.append(in_rust(program))
    print(f"basin of 1,000 x 1,000: Rust {min(rust) * 1e3:.1f} ms, Python {min(python) * 1e3:.1f} ms")
    print(f"ratio {min(python) / min(rust):.3f}; Rust against itself {min(again) / min(rust):.3f}")
    toss = bd.System.pizza_toss()
    number = 20_000
    least = min(timeit.repeat(lambda: bd.single_toss(toss), number=number, repeat=20)) / number
    print(f"one toss: {least * 1e6:.2f} us")


if __name__ == "__main__":
    main()
