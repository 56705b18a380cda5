// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef undine_operators_mean_distance_h
#define undine_operators_mean_distance_h

#include <undine/cutting/fragment_at_plane.h>

#include <optional>
#include <vector>

namespace undine
{
  /// How far the part of a piece that is in front of one of its chords is from the line of that
  /// chord in the mean [m]. `boundary`: all straight parts of the boundary of the piece, its chords
  /// and rims, with normals out of it of their length; nothing if they do not close around it. That
  /// of a convex piece is the distance of its centroid; of a piece around a corner that centroid
  /// may lie beside a chord or behind it.
  template <int dim>
  std::optional<double>
  mean_distance_in_front(const PlaneChord<dim>              &chord,
                         const std::vector<PlaneChord<dim>> &boundary);
} // namespace undine

#endif
