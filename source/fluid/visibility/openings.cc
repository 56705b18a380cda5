// SPDX-License-Identifier: LGPL-2.1-or-later
#include <undine/fluid/visibility/openings.h>

#include <algorithm>
#include <limits>
#include <vector>

namespace undine
{
  namespace
  {
    constexpr double rounding = 1e-9; ///< of distances that count as equal

    /// The numbers of those that `are_joined` to a place and are nearest to it.
    template <int dim, class Condition>
    std::vector<std::size_t>
    nearest(const std::vector<Opening<dim>> &among,
            const dealii::Point<dim>        &place,
            const Condition                 &are_joined)
    {
      std::vector<std::size_t> joined, result;
      double                   least = std::numeric_limits<double>::infinity();
      for (std::size_t k = 0; k < among.size(); ++k)
        if (are_joined(among[k]))
          {
            joined.push_back(k);
            least = std::min(least, among[k].centre.point.distance(place));
          }
      for (const auto k : joined)
        if (among[k].centre.point.distance(place) <= (1 + rounding) * least)
          result.push_back(k);
      return result;
    }
  } // namespace


  template <int dim>
  std::vector<Succession>
  successions(const std::vector<Opening<dim>> &before,
              const std::vector<Opening<dim>> &now,
              const double                     whole,
              const BodyVicinity<dim>         &vicinity)
  {
    const auto become = [&](const Opening<dim> &one, const Opening<dim> &other) {
      // The only ones are the same if they overlap and no surface has passed between: their
      // centroids may lie in a body.
      return (before.size() == 1 && now.size() == 1 && one.measure + other.measure > whole &&
              !vicinity.parts(one.centre.point, other.centre.point)) ||
             vicinity.leads_to(one.centre, other.centre);
    };
    std::vector<Succession> result;
    std::vector<double>     taken(before.size(), 0.);
    for (std::size_t j = 0; j < now.size(); ++j)
      {
        const auto sources = nearest(before, now[j].centre.point, [&](const Opening<dim> &one) {
          return become(one, now[j]);
        });
        for (const auto k : sources)
          if (const double part = now[j].measure / sources.size(); part > 0)
            {
              result.push_back({k, j, part});
              taken[k] += part;
            }
      }
    for (auto &one : result)
      one.share /= taken[one.before];
    for (std::size_t k = 0; k < before.size(); ++k)
      if (!(taken[k] > 0))
        {
          const auto heirs = nearest(now, before[k].centre.point, [&](const Opening<dim> &other) {
            return become(before[k], other);
          });
          for (const auto j : heirs)
            result.push_back({k, j, 1. / heirs.size()});
        }
    return result;
  }


  template std::vector<Succession>
  successions(const std::vector<Opening<2>> &,
              const std::vector<Opening<2>> &,
              const double,
              const BodyVicinity<2> &);
  template std::vector<Succession>
  successions(const std::vector<Opening<3>> &,
              const std::vector<Opening<3>> &,
              const double,
              const BodyVicinity<3> &);
} // namespace undine
