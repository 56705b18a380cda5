# SPDX-License-Identifier: LGPL-2.1-or-later
"""One page about a run, report.html, made of the files in its folder alone: see doc/report.md."""
