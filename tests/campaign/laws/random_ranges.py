# SPDX-License-Identifier: LGPL-2.1-or-later
"""What random scenes are drawn from. Pairs are ranges; those called logarithmic are drawn evenly in the logarithm."""

BODIES = ("free block", "clamped sheet", "two sheets", "bar between walls")
FLUID_DENSITY = 1000.0  # kg/m^3
DENSITY_RATIO = (1e-3, 1e3)  # of a body's density to the fluid's, logarithmic
MODULUS = (1e2, 1e9)  # Young's, logarithmic [Pa]
POISSON = (0.0, 0.45)
THICKNESS = (1e-2, 2.0)  # of sheets and bars, logarithmic [cells of the grid]
STEPS = (15, 30, 60, 120, 240)  # in a second

GRID = (16, 40)  # cells in each direction of the box, 1 m x 1 m
STEPS_OF_A_RUN = (20, 60)
CELLS_ALONG = (8, 20)  # of a sheet or bar
BLOCK_CELLS = (2, 6)  # of a block in each direction
BLOCK_SIZE = (0.1, 0.35)  # [m]
SHEET_LENGTH = (0.3, 0.7)  # [m]
BAR_HEIGHT = (0.3, 0.7)  # [m]
SHEETS_AT = (0.25, 0.45)  # where the first of two, or the only one, stands [m]
SHEETS_APART = (0.15, 0.3)  # between two that may touch, [m]; others stand 0.35 m apart and are pushed the same way
FAR_APART = 0.35
LESS_LOAD = 1 / 3  # on them

# Loads over what strains a body by one, or moves it by its length.
LOAD = (3e-3, 0.3)  # logarithmic
MOST_GRAVITY = 9.81  # m/s^2
MOST_WAY = 0.2  # that a free body falls or rises at most, roughly [m]

DAMPING = (1e-4, 1e-2)  # stiffness coefficient, logarithmic [s]

# Shares of scenes.
ON_PLANES = 0.5  # bodies that begin with a face in a plane of the grid
WITH_DAMPING = 0.5
WITH_CONTACT = 0.5
TURNED = 0.5  # blocks that are off planes and rotated
LOADS = ("gravity", "load", "gravity and load")  # of held bodies; free ones have gravity
