"""Imports for checkers of types alone are no part of the code that a stage reaches."""

import textwrap

from tramdva.running.parsed_code import parsed


def test_what_only_checkers_of_types_read_is_not_reached(tmp_path) -> None:
    path = tmp_path / "vehicle.py"
    code = """
        from typing import TYPE_CHECKING
        from tramdva.axle import beam
        if TYPE_CHECKING:
            from tramdva.parameters import Bogie
        else:
            Bogie = None
    """
    path.write_text(textwrap.dedent(code), encoding="utf-8")
    assert parsed(path).imports == ("tramdva.axle.beam",)
