"""Variables of `wear.nc`."""

from __future__ import annotations

from tramdva.variables.kinds import Stage, flag, real, text, truth
from tramdva.variables.shared import WAVE_STATUS

VARIABLES = Stage(
    "wear",
    "KTH wear of the wheels by the contacts of one order",
    {
        "absorber": text("", "absorber of the bogie"),
        "order": real("", "1", "waves around the wheel"),
        "frequency": real("", "Hz", "frequency of the waves"),
        "wheel": text("wheel", "wheel out of round"),
        "amplitude": real("", "m", "amplitude of the waves"),
        "angle": real("angle", "rad", "wheel angle of the material point"),
        "radius_deviation": real("wheel angle", "m", "radius deviation, crest positive"),
        "largest_radius_deviation": real("wheel", "m", "its largest absolute value"),
        "wear_depth": real("wheel angle", "m", "depth worn away per revolution, mean width"),
        "wear_depth_variation": real("wheel", "m", "largest depth beyond or below its mean"),
        "patch_width": real("wheel", "m", "mean width over which the wear is averaged"),
        "mean_wear_depth": real("wheel", "m", "mean depth per revolution"),
        "wear_amplitude": real("wheel", "m", "amplitude of the depth at the order"),
        "wear_phase": real("wheel", "rad", "its phase against the crest"),
        "harmonic_distortion": real(
            "wheel", "1", "effective value of twice, three ... times the order over its own"
        ),
        "region": text("region", "region of the wear chart, adhesion last"),
        "region_share": real("wheel region", "1", "share of time and patch in the region"),
        "region_share_range": real("wheel region", "1", "largest less smallest share of patch"),
        "region_changes": truth(
            "wheel", "whether the largest region of the sliding patch changes in a period"
        ),
        "status": flag("", WAVE_STATUS, "status of the simulation"),
    },
)
