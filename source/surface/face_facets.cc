// SPDX-License-Identifier: LGPL-2.1-or-later
#include <undine/fluid/grid/index_box.h>
#include <undine/surface/face_facets.h>
#include <undine/surface/simplex.h>

namespace undine
{
  namespace
  {
    /// One square of a face as facets; corner c is at bit d of c in the d-th direction of the face.
    /// An odd square has the other diagonal. @{
    std::vector<std::array<unsigned int, 2>>
    simplices(const std::array<unsigned int, 2> &corners, const int)
    {
      return {corners};
    }

    std::vector<std::array<unsigned int, 3>>
    simplices(const std::array<unsigned int, 4> &c, const int square)
    {
      if (square % 2 == 0)
        return {{{c[0], c[1], c[3]}}, {{c[0], c[3], c[2]}}};
      return {{{c[0], c[1], c[2]}}, {{c[1], c[3], c[2]}}};
    }
    /// @}


    /// The box of a cell's nodes.
    template <int dim>
    IndexBox<dim>
    nodes_of_cell(const unsigned int degree)
    {
      return {{}, all_directions<dim>(degree + 1)};
    }


    /// Whether a facet of the face at `end` of `axis` points into the cell.
    template <int dim>
    bool
    points_inwards(const std::array<unsigned int, dim> &facet,
                   const unsigned int                   degree,
                   const unsigned int                   axis,
                   const int                            end)
    {
      std::array<dealii::Point<dim>, dim> places;
      for (unsigned int k = 0; k < dim; ++k)
        for (unsigned int d = 0, rest = facet[k]; d < dim; ++d, rest /= degree + 1)
          places[k][d] = rest % (degree + 1);
      return area_vector(places)[axis] * (end == 0 ? -1 : 1) < 0;
    }
  } // namespace


  template <int dim>
  std::array<std::vector<std::array<unsigned int, dim>>, 2 * dim>
  face_facets(const unsigned int degree)
  {
    const auto nodes = nodes_of_cell<dim>(degree);
    std::array<std::vector<std::array<unsigned int, dim>>, 2 * dim> result;
    for (unsigned int axis = 0; axis < dim; ++axis)
      for (const int end : {0, 1})
        {
          IndexBox<dim> squares{{}, all_directions<dim>(degree)};
          squares.upper[axis] = 1;
          for_each(squares, [&](const GridIndex<dim> &square) {
            std::array<unsigned int, 1 << (dim - 1)> corners;
            for (unsigned int c = 0; c < corners.size(); ++c)
              {
                GridIndex<dim> node = square;
                node[axis]          = end * degree;
                for (unsigned int d = 0, bit = 0; d < dim; ++d)
                  if (d != axis)
                    node[d] += (c >> bit++) & 1;
                corners[c] = nodes.position(node);
              }
            int sum = 0;
            for (unsigned int d = 0; d < dim; ++d)
              sum += square[d];
            for (auto facet : simplices(corners, sum))
              {
                if (points_inwards<dim>(facet, degree, axis, end))
                  std::swap(facet[0], facet[1]);
                result[2 * axis + end].push_back(facet);
              }
          });
        }
    return result;
  }


  template std::array<std::vector<std::array<unsigned int, 2>>, 4>
  face_facets<2>(const unsigned int);
  template std::array<std::vector<std::array<unsigned int, 3>>, 6>
  face_facets<3>(const unsigned int);
} // namespace undine
