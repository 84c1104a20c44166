"""Names of axles, wheels and of what they are described by, in their order."""

AXLES = ("front", "rear")
WHEELS = ("front_outer", "front_inner", "rear_outer", "rear_inner")
AXLE_OF_WHEEL = (0, 0, 1, 1)
SIDE = (-1.0, 1.0, -1.0, 1.0)  # the curve goes to the left: outer wheels are right
# What a contact sees of its wheel, and what it does to it.
LOCAL = ("y", "z", "roll", "yaw", "vx", "vy", "vz", "roll_rate", "spin_rate", "yaw_rate", "x")
FORCES = ("x", "y", "z", "roll", "spin", "yaw")
ENERGY_CLASSES = (
    "symmetric_bending", "antisymmetric_bending", "lateral_bending", "axle_torsion", "primary",
    "secondary", "resilient_wheel", "car_support", "absorber",
)  # fmt: skip
