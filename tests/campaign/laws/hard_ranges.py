# SPDX-License-Identifier: LGPL-2.1-or-later
"""What hard random scenes are drawn from. Pairs are ranges; those called logarithmic are drawn evenly in the logarithm."""

FLUIDS = (1.2, 1000.0)  # density [kg/m^dim]
DENSITY_RATIO = (1e-3, 1e3)  # of a body's density to the fluid's, logarithmic, of every body anew
MODULUS = (1e2, 1e9)  # Young's, logarithmic, of every body anew [Pa]
POISSON = (0.0, 0.45)
NEARLY_INCOMPRESSIBLE = 0.4999
THICKNESS = (1e-2, 2.0)  # of sheets and plates, logarithmic [cells of the grid]
STEPS = (15, 30, 60, 120, 240)  # in a second

# By the number of space dimensions.
GRID = {2: (16, 62), 3: (10, 30)}  # cells of the domain, 1 m a side (streams: 1.5 m long), along each axis
MOST_CELLS = {2: 4000, 3: 30000}
STEPS_OF_A_RUN = {2: (20, 120), 3: (10, 30)}
SLOTS = {2: 3, 3: 2}  # along each axis, for a body each
MOST_BODIES = {2: 9, 3: 6}
CELLS_ALONG = {2: (6, 24), 3: (3, 8)}  # of a sheet or plate along each edge
BLOCK_CELLS = {2: (1, 6), 3: (1, 3)}

BLOCK_SIZE = (0.4, 0.75)  # of its slot
SHEET_LENGTH = (0.3, 0.7)  # [m]
SHEET_WIDTH = (0.2, 1.2)  # in space; more than 0.95: from side to side [m]
SHEETS_AT = (0.3, 0.45)  # where the first of several, or the only one, stands [m]
SHEETS_APART = (0.15, 0.3)  # [m]
MOST_SHEETS = 3
PLATE_HEIGHT = (0.25, 0.7)  # [m]
BLOCK_AT = (0.02, 0.3)  # above the floor on which it falls [m]
FILLING = (0.02, 0.2)  # what flows into a chamber, of the cube of a metre
COLUMN = (0.5, 3.0)  # load of a column over that which makes it buckle

# Loads over what strains a body by one, or moves it by its length.
LOAD = (3e-3, 0.3)  # logarithmic
MOST_GRAVITY = 981.0  # m/s^2
MOST_SQUEEZE = 0.1  # pressure at the floor over the least modulus of bodies
MOST_WAY = 0.3  # that a free body falls or rises at most, roughly [m]
MOST_CELLS_A_STEP = 2.0  # that a stream goes

DAMPING = (1e-4, 1e-2)  # stiffness coefficient, logarithmic [s]
FRICTION = (1e-6, 1e-1)  # h nu / (1 m)^2, logarithmic

# Shares of scenes.
ON_PLANES = 0.5  # bodies that begin with a face in a plane of the grid
WITH_DAMPING = 0.5
WITH_CONVECTION = 0.6
WITH_FRICTION = 0.3
ALL_NEARLY_INCOMPRESSIBLE = 0.15
TURNED = 0.5  # blocks that are off planes and rotated
SUDDEN = 0.5  # streams and loads that set in at once; the others do within a third of the run
SWITCHED_OFF = 0.3  # loads that end in the middle of the run
