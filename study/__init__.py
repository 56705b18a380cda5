# SPDX-License-Identifier: LGPL-2.1-or-later
"""What accuracy costs: runs a scene with many settings and compares errors with seconds."""
