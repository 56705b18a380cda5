// SPDX-License-Identifier: LGPL-2.1-or-later
#include <undine/coupled/step/misplacement.h>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>

namespace undine
{
  namespace
  {
    /// The name of the body or obstacle that a node belongs to.
    template <int dim>
    std::string
    owner(const Surface<dim> &surface, const unsigned int node)
    {
      for (unsigned int facet = 0; facet < surface.facets().size(); ++facet)
        for (const unsigned int corner : surface.facets()[facet])
          if (corner == node)
            return surface.body_names()[surface.body(facet)];
      return "";
    }


    /// What to try for a node of the surface of `name`.
    template <int dim>
    std::string
    advice(const Models<dim> &models, const std::string &name)
    {
      const double fluid = models.fluid->density();
      if (models.solid)
        for (const auto &body : models.solid->bodies())
          if (body.name == name && body.density <= fluid)
            return fmt::format("It has {:.3g} of the fluid's density: bodies that light can shake "
                               "from stage to stage, and a smaller step may make that worse as "
                               "well as better. Try: 'Time / Integrator = theta' with 'Theta = 1', "
                               "which damps it, or another 'Time / Step' from the start.",
                               body.density / fluid);
      return "Try: a smaller 'Time / Step'. Where steps resolve the motion, this distance shrinks "
             "with their square; if it does not, try 'Time / Integrator = theta' with 'Theta = 1'.";
    }
  } // namespace


  template <int dim>
  std::string
  misplacement_complaint(const Models<dim>                     &models,
                         const std::vector<dealii::Point<dim>> &places,
                         const std::vector<Misplacement>       &rounds)
  {
    const auto          node = rounds.back().node;
    const auto          name = owner(models.surface->surface(), node);
    std::vector<double> cells(rounds.size()), place(dim);
    std::transform(
      rounds.begin(), rounds.end(), cells.begin(), [](const auto &round) { return round.cells; });
    for (unsigned int d = 0; d < dim; ++d)
      place[d] = places[node][d];
    return fmt::format("the grid cannot be cut where '{}' comes to: it ends the step {:.2g} cells "
                       "from where the grid was cut for it, near ({:.4g}), however often that is "
                       "cut again. {}",
                       name,
                       fmt::join(cells, ", then "),
                       fmt::join(place, ", "),
                       advice(models, name));
  }


  template std::string
  misplacement_complaint(const Models<2> &,
                         const std::vector<dealii::Point<2>> &,
                         const std::vector<Misplacement> &);
  template std::string
  misplacement_complaint(const Models<3> &,
                         const std::vector<dealii::Point<3>> &,
                         const std::vector<Misplacement> &);
} // namespace undine
