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


    /// The same around the middle of the square; a segment is its own. @{
    std::vector<std::array<unsigned int, 2>>
    around_middle(const std::array<unsigned int, 2> &corners, const unsigned int)
    {
      return {corners};
    }

    std::vector<std::array<unsigned int, 3>>
    around_middle(const std::array<unsigned int, 4> &c, const unsigned int middle)
    {
      return {{{c[0], c[1], middle}},
              {{c[1], c[3], middle}},
              {{c[3], c[2], middle}},
              {{c[2], c[0], middle}}};
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


    /// The corners of a square of a face at `end` of `axis`, `size` nodes wide, whose lowest corner
    /// is `square`.
    template <int dim>
    std::array<unsigned int, 1 << (dim - 1)>
    corners_of_square(const GridIndex<dim> &square,
                      const unsigned int    axis,
                      const int             end,
                      const int             size,
                      const unsigned int    degree)
    {
      std::array<unsigned int, 1 << (dim - 1)> result;
      for (unsigned int c = 0; c < result.size(); ++c)
        {
          GridIndex<dim> node = square;
          node[axis]          = end * degree;
          for (unsigned int d = 0, bit = 0; d < dim; ++d)
            if (d != axis)
              node[d] += size * ((c >> bit++) & 1);
          result[c] = nodes_of_cell<dim>(degree).position(node);
        }
      return result;
    }


    /// `more`, turned so that they point out of the cell, go to `facets`.
    template <int dim>
    void
    append(std::vector<std::array<unsigned int, dim>>       &facets,
           const std::vector<std::array<unsigned int, dim>> &more,
           const unsigned int                                degree,
           const unsigned int                                axis,
           const int                                         end)
    {
      for (auto facet : more)
        {
          if (points_inwards<dim>(facet, degree, axis, end))
            std::swap(facet[0], facet[1]);
          facets.push_back(facet);
        }
    }
  } // namespace


  template <int dim>
  std::array<std::vector<std::array<unsigned int, dim>>, 2 * dim>
  face_facets(const unsigned int degree)
  {
    std::array<std::vector<std::array<unsigned int, dim>>, 2 * dim> result;
    for (unsigned int axis = 0; axis < dim; ++axis)
      for (const int end : {0, 1})
        {
          IndexBox<dim> squares{{}, all_directions<dim>(degree)};
          squares.upper[axis] = 1;
          for_each(squares, [&](const GridIndex<dim> &square) {
            int sum = 0;
            for (unsigned int d = 0; d < dim; ++d)
              sum += square[d];
            append<dim>(result[2 * axis + end],
                        simplices(corners_of_square(square, axis, end, 1, degree), sum),
                        degree,
                        axis,
                        end);
          });
        }
    return result;
  }


  template <int dim>
  std::array<std::vector<std::array<unsigned int, dim>>, 2 * dim>
  facets_of_element(const unsigned int degree)
  {
    if (degree == 2)
      return face_facets<dim>(2);
    std::array<std::vector<std::array<unsigned int, dim>>, 2 * dim> result;
    for (unsigned int axis = 0; axis < dim; ++axis)
      for (const int end : {0, 1})
        {
          auto middle  = all_directions<dim>(1);
          middle[axis] = 2 * end;
          append<dim>(result[2 * axis + end],
                      around_middle(corners_of_square(GridIndex<dim>{}, axis, end, 2, 2),
                                    nodes_of_cell<dim>(2).position(middle)),
                      2,
                      axis,
                      end);
        }
    return result;
  }


#define UNDINE_INSTANTIATE(dim)                                                                    \
  template std::array<std::vector<std::array<unsigned int, dim>>, 2 * dim> face_facets<dim>(       \
    const unsigned int);                                                                           \
  template std::array<std::vector<std::array<unsigned int, dim>>, 2 * dim> facets_of_element<dim>( \
    const unsigned int);

  UNDINE_INSTANTIATE(2)
  UNDINE_INSTANTIATE(3)
#undef UNDINE_INSTANTIATE
} // namespace undine
