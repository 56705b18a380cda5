// SPDX-License-Identifier: LGPL-2.1-or-later
#include <undine/fluid/grid/mac_grid.h>

#include <algorithm>
#include <string>

namespace undine
{
  namespace
  {
    /// lower + (upper - lower) g(i / n); throws if g does not map [0,1] to itself, ascending.
    std::vector<double>
    graded_planes(const Options       &domain,
                  const std::string   &key,
                  const Expression<1> &grading,
                  const double         lower,
                  const double         upper,
                  const unsigned int   n_cells)
    {
      std::vector<double> planes;
      for (unsigned int i = 0; i <= n_cells; ++i)
        planes.push_back(grading.value(dealii::Point<1>(double(i) / n_cells), 0));
      // What is not a number is not ascending.
      const bool ascending =
        std::adjacent_find(planes.begin(), planes.end(), [](const double a, const double b) {
          return !(a < b);
        }) == planes.end();
      if (!ascending || std::abs(planes.front()) > 1e-12 || std::abs(planes.back() - 1) > 1e-12)
        throw domain.error(key,
                           "the expression '" + grading.text() +
                             "' is not an ascending map of [0, 1] onto itself",
                           "Try: x, x^2, (1-cos(pi*x))/2");
      for (double &plane : planes)
        plane = lower + (upper - lower) * plane;
      planes.front() = lower;
      planes.back()  = upper;
      return planes;
    }


    /// A list of planes by the user.
    void
    check_planes(const Options &domain, const std::string &key, const std::vector<double> &planes)
    {
      if (planes.size() < 2 ||
          std::adjacent_find(planes.begin(), planes.end(), std::greater_equal<double>()) !=
            planes.end())
        throw domain.error(key,
                           "needs at least two numbers in ascending order",
                           "Give the position of every plane between cells and of both ends.");
    }
  } // namespace


  template <int dim>
  typename MacGrid<dim>::Planes
  read_planes(const Options &domain)
  {
    dealii::Tensor<1, dim>        lower, upper;
    std::array<unsigned int, dim> n_cells;
    n_cells.fill(16);
    for (unsigned int d = 0; d < dim; ++d)
      upper[d] = 1;
    domain.add("Lower corner", lower, "m", Allowed::anything(), "Lower end in each direction.");
    domain.add("Upper corner", upper, "m", Allowed::anything(), "Upper end in each direction.");
    domain.add("Cells", n_cells, "", Allowed::between(1, 1e6), "Grid cells in each direction.");

    typename MacGrid<dim>::Planes planes;
    for (unsigned int d = 0; d < dim; ++d)
      {
        const std::string axis(1, "xyz"[d]);
        Expression<1>     grading("x");
        domain.add("Grading " + axis,
                   grading,
                   "",
                   Allowed::constant_in_time(),
                   "Ascending map of [0, 1] onto itself, which takes the positions of equally "
                   "spaced planes normal to " +
                     axis + " to those used; its variable is named x for every direction.");
        domain.add("Planes " + axis,
                   planes[d],
                   "m",
                   Allowed::anything(),
                   "Positions of all planes normal to " + axis +
                     ". If given, corners, cells and grading are not used in this direction.");
        if (domain.given("Planes " + axis))
          {
            check_planes(domain, "Planes " + axis, planes[d]);
            continue;
          }
        if (!domain.is_reference() && !domain.given("Cells"))
          throw domain.error("Cells",
                             "must be given",
                             "Allowed: " + std::to_string(dim) + " whole numbers, or 'Planes'.");
        if (upper[d] <= lower[d])
          throw domain.error("Upper corner",
                             "is not above 'Lower corner' along " + axis,
                             "Allowed: larger numbers in every direction.");
        planes[d] =
          graded_planes(domain, "Grading " + axis, grading, lower[d], upper[d], n_cells[d]);
      }
    return planes;
  }


  template MacGrid<2>::Planes
  read_planes<2>(const Options &);
  template MacGrid<3>::Planes
  read_planes<3>(const Options &);
} // namespace undine
