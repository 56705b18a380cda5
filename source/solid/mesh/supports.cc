// SPDX-License-Identifier: LGPL-2.1-or-later
#include <undine/solid/mesh/supports.h>

#include <deal.II/base/bounding_box.h>
#include <deal.II/lac/full_matrix.h>
#include <deal.II/lac/lapack_full_matrix.h>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <string>

namespace undine
{
  namespace
  {
    /// Middle [m] and greatest half width [m] of a body at rest.
    template <int dim>
    struct Extent
    {
      dealii::Point<dim> middle;
      double             size;
    };


    template <int dim>
    Extent<dim>
    extent(const SolidModel<dim> &model, const unsigned int body)
    {
      dealii::BoundingBox<dim> box;
      bool                     empty = true;
      for (const auto &cell : model.triangulation().active_cell_iterators())
        if (cell->material_id() == body)
          {
            if (empty)
              box = cell->bounding_box();
            else
              box.merge_with(cell->bounding_box());
            empty = false;
          }
      double size = 0;
      for (unsigned int axis = 0; axis < dim; ++axis)
        size = std::max(size, box.side_length(axis) / 2);
      return {box.center(), size};
    }


    /// The displacements along `axis` of all rigid motions of small angle at `place`, relative to
    /// the middle of the body in units of its size: translations, then rotations in each plane.
    template <int dim>
    std::vector<double>
    rigid_displacements(const dealii::Tensor<1, dim> &place, const unsigned int axis)
    {
      std::vector<double> result;
      for (unsigned int a = 0; a < dim; ++a)
        result.push_back(a == axis ? 1 : 0);
      for (unsigned int a = 0; a < dim; ++a)
        for (unsigned int b = a + 1; b < dim; ++b)
          result.push_back(axis == b ? place[a] : (axis == a ? -place[b] : 0));
      return result;
    }


    /// Number of singular values of a square matrix that are more than rounding.
    unsigned int
    rank(const dealii::FullMatrix<double> &A)
    {
      dealii::LAPACKFullMatrix<double> factors(A.m());
      factors = A;
      factors.compute_svd();
      unsigned int result = 0;
      for (unsigned int i = 0; i < A.m(); ++i)
        result += factors.singular_value(i) > 1e-10 * A.linfty_norm();
      return result;
    }


    template <int dim>
    void
    assert_held(const SolidModel<dim>       &model,
                const std::vector<FixedDof> &fixed,
                const unsigned int           body)
    {
      const unsigned int         n_motions = dim * (dim + 1) / 2;
      const auto                 shape     = extent(model, body);
      dealii::FullMatrix<double> held(n_motions);
      for (const auto &entry : fixed)
        if (entry.body == body)
          {
            const dealii::Tensor<1, dim> place =
              (model.rest_position(entry.dof) - shape.middle) / shape.size;
            const auto motions = rigid_displacements(place, entry.axis);
            for (unsigned int i = 0; i < n_motions; ++i)
              for (unsigned int j = 0; j < n_motions; ++j)
                held(i, j) += motions[i] * motions[j];
          }
      const unsigned int n_held = rank(held);
      if (n_held == n_motions)
        return;
      const auto       &scene = model.bodies()[body];
      const std::string what =
        n_held == 0 ? "nothing holds the body"
                    : fmt::format("the supports leave {} of the {} rigid motions of the body free",
                                  n_motions - n_held,
                                  n_motions);
      throw scene.options.error("Boundaries",
                                what + ", but without inertia there is no balance of forces then",
                                "Try: clamps that hold body '" + scene.name +
                                  "', or another 'Time/Integrator' than static.");
    }


    template <int dim>
    void
    assert_holding(const SolidModel<dim> &model, const std::vector<FixedDof> &fixed)
    {
      for (unsigned int body = 0; body < model.bodies().size(); ++body)
        for (unsigned int b = 0; b < model.bodies()[body].boundaries.size(); ++b)
          {
            const auto &boundary = model.bodies()[body].boundaries[b];
            if (boundary.fixes_displacement() &&
                std::none_of(fixed.begin(), fixed.end(), [&](const FixedDof &entry) {
                  return entry.body == body && entry.boundary == b;
                }))
              throw boundary.options.error("Sides",
                                           "selects nothing that boundaries named before it do "
                                           "not hold already",
                                           "Try: other 'Sides', 'Where' or 'Components', or remove "
                                           "this boundary.");
          }
    }


    template <int dim>
    void
    assert_continuous(const SolidModel<dim> &model, const std::vector<FixedDof> &fixed)
    {
      std::vector<double> sizes;
      for (unsigned int body = 0; body < model.bodies().size(); ++body)
        sizes.push_back(extent(model, body).size);
      for (const auto &entry : fixed)
        {
          const auto  &body     = model.bodies()[entry.body];
          const auto  &position = model.rest_position(entry.dof);
          const double start    = body.displacement.value(position, 0., entry.axis);
          const double motion   = model.prescribed_displacement(entry, 0);
          if (std::abs(motion - start) <= 1e-9 * (sizes[entry.body] + std::abs(start)))
            continue;
          throw body.boundaries[entry.boundary].options.error(
            "Displacement",
            fmt::format("is {:.6g} m at t = 0 along {} where the body rests at ({:.4g}), but its "
                        "'Initial displacement' there is {:.6g} m",
                        motion,
                        "xyz"[entry.axis],
                        fmt::join(position.begin_raw(), position.end_raw(), ", "),
                        start),
            "Try: a motion that starts at the 'Initial displacement' of body '" + body.name +
              "'; a jump would be an infinite velocity.");
        }
    }
  } // namespace


  template <int dim>
  void
  check_supports(const SolidModel<dim> &model, const std::vector<FixedDof> &fixed)
  {
    const bool has_inertia = model.numerics().integrator->coefficients(1).mass != 0;
    assert_holding(model, fixed);
    if (has_inertia)
      assert_continuous(model, fixed);
    else
      for (unsigned int body = 0; body < model.bodies().size(); ++body)
        assert_held(model, fixed, body);
  }


  template void
  check_supports(const SolidModel<2> &, const std::vector<FixedDof> &);
  template void
  check_supports(const SolidModel<3> &, const std::vector<FixedDof> &);
} // namespace undine
