// SPDX-License-Identifier: LGPL-2.1-or-later
#include <undine/cutting/chord_splitter.h>
#include <undine/cutting/fragment_integrals.h>

namespace undine
{
  namespace
  {
    /// A corner of a fragment.
    struct Point
    {
      dealii::Point<3>      place;       ///< relative to the cell [m]
      std::array<double, 3> coordinates; ///< barycentric
    };


    /// Area-weighted sums of barycentric coordinates over a fan of triangles.
    struct Means
    {
      double                area = 0;
      std::array<double, 3> mean{}, products{}; ///< products of 01, 02, 12

      void
      add(const double triangle, const Point &a, const Point &b, const Point &c)
      {
        area += triangle;
        std::array<double, 3> sums;
        for (unsigned int k = 0; k < 3; ++k)
          {
            sums[k] = a.coordinates[k] + b.coordinates[k] + c.coordinates[k];
            mean[k] += triangle * sums[k] / 3;
          }
        for (unsigned int i = 0; i < 2; ++i)
          for (unsigned int j = i + 1; j < 3; ++j)
            products[i + j - 1] +=
              triangle *
              (sums[i] * sums[j] + a.coordinates[i] * a.coordinates[j] +
               b.coordinates[i] * b.coordinates[j] + c.coordinates[i] * c.coordinates[j]) /
              12;
      }

      /// The means of a fragment; `plain_mean` if it has no area.
      CutCells<3>::Fragment
      fragment(const std::array<double, 3> &plain_mean) const
      {
        CutCells<3>::Fragment result;
        result.component = CutCells<3>::no_component;
        for (unsigned int k = 0; k < 3; ++k)
          result.mean[k] = area > 0 ? mean[k] / area : plain_mean[k];
        for (unsigned int i = 0; i < 2; ++i)
          for (unsigned int j = i + 1; j < 3; ++j)
            result.products[i + j - 1] =
              area > 0 ? products[i + j - 1] / area : result.mean[i] * result.mean[j];
        return result;
      }
    };
  } // namespace


  FragmentIntegrals
  integrate_fragment(const SplitSurface<3>::Fragment &fragment,
                     const SplitSurface<3>           &split,
                     const PlacedSurface<3>          &placed,
                     const dealii::Point<3>          &origin)
  {
    FragmentIntegrals result;
    const auto        corner = [&](const int i) {
      const int   number = split.corners[i].vertex;
      const auto &vertex = split.vertices[number];
      Point       point{dealii::Point<3>(vertex.position - origin),
                  barycentric(placed.surface, fragment.facet, vertex, number)};
      result.sums.include(point.place);
      return point;
    };

    // The snapped vertices are only nearly in one plane: their fan of triangles is what counts.
    const auto            normal   = area_vector(placed.surface, fragment.facet, placed.positions);
    const Point           first    = corner(fragment.begin);
    Point                 previous = corner(fragment.begin + 1);
    dealii::Tensor<1, 3>  area;
    Means                 means;
    std::array<double, 3> plain_mean = first.coordinates;
    for (unsigned int k = 0; k < 3; ++k)
      plain_mean[k] += previous.coordinates[k];
    for (int i = fragment.begin + 2; i < fragment.end; ++i)
      {
        const Point next = corner(i);
        const auto  triangle =
          0.5 * dealii::cross_product_3d(previous.place - first.place, next.place - first.place);
        area += triangle;
        const auto &x = first.place, &y = previous.place, &z = next.place;
        for (unsigned int d = 0; d < 3; ++d)
          {
            // The fluid's normal is the opposite one: integrals of x_d n_d / 3 and x_d^2 n_d / 2.
            result.sums.volume -= triangle[d] * x[d] / 3;
            result.sums.moment[d] -=
              triangle[d] * (x[d] * (x[d] + y[d] + z[d]) + y[d] * (y[d] + z[d]) + z[d] * z[d]) / 12;
            plain_mean[d] += next.coordinates[d];
          }
        if (const double size = triangle * normal; size > 0)
          means.add(size, first, previous, next);
        previous = next;
      }

    for (double &coordinate : plain_mean)
      coordinate /= fragment.end - fragment.begin;
    result.fragment             = means.fragment(plain_mean);
    result.fragment.facet       = fragment.facet;
    result.fragment.area_vector = -area;
    return result;
  }
} // namespace undine
