"""The package as such: what it exports."""

import bouncing_disk


def test_what_is_promised_is_there() -> None:
    for name in bouncing_disk.__all__:
        assert hasattr(bouncing_disk, name), name
