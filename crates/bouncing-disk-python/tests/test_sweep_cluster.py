"""What a cluster is asked and told, without one."""

from __future__ import annotations

import pickle
from typing import Any

import pytest

import bouncing_disk as bd
from bouncing_disk._sweep.runners import check_versions, unlike
from bouncing_disk._sweep.folder import PACKAGES, VERSIONS as OWN


class Answers:
    """A client whose workers give these answers."""

    def __init__(self, **answers: Any) -> None:
        self.answers = answers

    def run(self, function: Any, packages: tuple[str, ...], on_error: str) -> dict[str, Any]:
        assert function(packages) == OWN and packages == PACKAGES and on_error == "return"
        return self.answers


def test_workers_of_the_same_versions_pass() -> None:
    check_versions(Answers())
    check_versions(Answers(one=OWN, other=dict(OWN), dead=OSError("gone")))


@pytest.mark.parametrize(
    ("answer", "message"),
    [
        ({**OWN, "numpy": "1.0.0"}, "two has numpy 1.0.0 instead of"),
        ({**OWN, "bouncing-disk": "unknown"}, "two has no bouncing-disk:"),
        ({}, "two has bouncing-disk of an older kind instead of .* and numpy of an older kind"),
    ],
)
def test_workers_of_other_versions_are_named(answer: dict[str, str], message: str) -> None:
    with pytest.raises(bd.SweepClusterError, match=message) as refused:
        check_versions(Answers(one=OWN, two=answer))
    assert refused.value.workers == {"two": answer} and refused.value.kind == "versions"
    again = pickle.loads(pickle.dumps(refused.value))
    assert str(again) == str(refused.value) and again.workers == refused.value.workers


def test_more_workers_are_counted() -> None:
    assert "and 2 more have others" in str(unlike({name: {**OWN, "numpy": "1"} for name in "abc"}))
