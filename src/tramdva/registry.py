"""The variables of every result file: name, dimensions, unit and meaning.

Others read the files by these names. A variable that bears the name of its only dimension is the
coordinate of this dimension. Texts are fixed-length strings, flags are int8 with `flag_values`
and `flag_meanings`; a truth is the flag `false true`.
"""

from __future__ import annotations

from tramdva import (
    bogie_variables,
    design_sheet_variables,
    design_variables,
    evolution_variables,
    wheelset_variables,
)
from tramdva.result_variables import Stage

STAGES: dict[str, Stage] = {
    **wheelset_variables.STAGES,
    **bogie_variables.STAGES,
    **evolution_variables.STAGES,
    **design_variables.STAGES,
    **design_sheet_variables.STAGES,
}
