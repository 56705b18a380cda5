// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef undine_surface_face_facets_h
#define undine_surface_face_facets_h

#include <array>
#include <vector>

namespace undine
{
  /// How the faces of a mesh cell are cut into facets: for each of the 2 dim faces, in deal.II's
  /// order, facets of nodes of the cell's lattice of (degree + 1)^dim nodes, numbered with the
  /// first direction running fastest. Facets point out of a cell whose volume is positive.
  ///
  /// Per face degree segments in 2D, 2 degree^2 triangles in 3D. Of degree 2, all diagonals meet in
  /// the middle of the face, so that a symmetric face has symmetric facets.
  template <int dim>
  std::array<std::vector<std::array<unsigned int, dim>>, 2 * dim>
  face_facets(const unsigned int degree);

  /// The facets that stand for the faces of a finite element of degree 1 or 2, of nodes of the
  /// lattice of a quadratic one, 3^dim: for degree 2 those of face_facets(); for degree 1 its faces
  /// in 2D, and in 3D four triangles around the middle of each, so that the load of a uniform
  /// pressure does not depend on a diagonal.
  template <int dim>
  std::array<std::vector<std::array<unsigned int, dim>>, 2 * dim>
  facets_of_element(const unsigned int degree);
} // namespace undine

#endif
