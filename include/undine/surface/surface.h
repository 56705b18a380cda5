// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef undine_surface_surface_h
#define undine_surface_surface_h

#include <deal.II/base/point.h>
#include <deal.II/base/tensor.h>

#include <array>
#include <string>
#include <vector>

namespace undine
{
  /// The boundaries of all bodies, cut into simplices: which nodes make which facets, and which
  /// facets which body. Built once; the nodes' positions change every step and are passed along.
  ///
  /// A facet has dim nodes: a segment with the solid on its left in 2D, a triangle whose nodes run
  /// counter-clockwise seen from outside the solid in 3D. Its normal points out of the solid.
  ///
  /// Ranks may hold only the facets near their cells: then nodes and facets must be listed in the
  /// same order on all ranks, others left out, so that all compute the same to the bit.
  template <int dim>
  class Surface
  {
  public:
    using Facet = std::array<unsigned int, dim>;
    using Ridge = std::array<unsigned int, dim - 1>;

    /// `body_of_facet` [facets] counts in `body_names`. Throws InputError if a facet names a node
    /// twice or one that there is not.
    Surface(const unsigned int               n_nodes,
            const std::vector<Facet>        &facets,
            const std::vector<unsigned int> &body_of_facet,
            const std::vector<std::string>  &body_names);

    /// Number of nodes, those that no facet uses included.
    unsigned int
    n_nodes() const
    {
      return number_of_nodes;
    }

    /// The numbers of the nodes of each facet.
    const std::vector<Facet> &
    facets() const
    {
      return all_facets;
    }

    /// The body that a facet belongs to, counted in body_names().
    unsigned int
    body(const unsigned int facet) const
    {
      return bodies[facet];
    }

    /// Names of all bodies, in the order of their numbers.
    const std::vector<std::string> &
    body_names() const
    {
      return names;
    }

    /// Where facets meet: edges in 3D (lower node first), nodes in 2D.
    const std::vector<Ridge> &
    ridges() const
    {
      return all_ridges;
    }

    /// The ridges of a facet: ridge k leads from node k to the next one, in 2D it is node k.
    const std::array<unsigned int, dim> &
    ridges(const unsigned int facet) const
    {
      return ridges_of_facet[facet];
    }

  private:
    void
    find_ridges();

    unsigned int                               number_of_nodes;
    std::vector<Facet>                         all_facets;
    std::vector<unsigned int>                  bodies;
    std::vector<std::string>                   names;
    std::vector<Ridge>                         all_ridges;
    std::vector<std::array<unsigned int, dim>> ridges_of_facet;
  };


  /// Throws InputError unless every ridge joins exactly two facets of one body that agree on which
  /// side the solid is; names body and place. For whole surfaces only, not for a rank's part.
  template <int dim>
  void
  check_closed(const Surface<dim> &surface, const std::vector<dealii::Point<dim>> &positions);

  /// Area times unit normal of facet `facet`, out of the solid [m^(dim-1)].
  template <int dim>
  dealii::Tensor<1, dim>
  area_vector(const Surface<dim>                    &surface,
              const unsigned int                     facet,
              const std::vector<dealii::Point<dim>> &positions);

  /// Its mean while all nodes move straight from `before` to `after` [m^(dim-1)], exactly: the area
  /// vector is linear in time in 2D, quadratic in 3D.
  template <int dim>
  dealii::Tensor<1, dim>
  mean_area_vector(const Surface<dim>                    &surface,
                   const unsigned int                     facet,
                   const std::vector<dealii::Point<dim>> &before,
                   const std::vector<dealii::Point<dim>> &after);

  /// Volume of each body [m^dim] by the divergence theorem; negative if it is inside out.
  template <int dim>
  std::vector<double>
  body_volumes(const Surface<dim> &surface, const std::vector<dealii::Point<dim>> &positions);

  /// A message about positions that are impossible, naming the body: one that is not finite, or a
  /// volume that is not positive. Empty if there is none.
  template <int dim>
  std::string
  positions_complaint(const Surface<dim>                    &surface,
                      const std::vector<dealii::Point<dim>> &positions);

  /// Throws SolveError with this complaint.
  template <int dim>
  void
  check_positions(const Surface<dim> &surface, const std::vector<dealii::Point<dim>> &positions);
} // namespace undine

#endif
